// Every number that `launchsafe verify` prints.
#include "launchsafe/verify/check.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>

namespace {

using launchsafe::verify::Check, launchsafe::verify::Computation, launchsafe::verify::Tolerance;

class Verification : public testing::TestWithParam<Computation> {};

TEST_P(Verification, ComputesTheExpectedNumbers) {
  const std::vector<Check> checks = GetParam().run();
  EXPECT_FALSE(checks.empty());
  for (const Check& check : checks)
    EXPECT_TRUE(check.pass()) << check.group << ": " << check.name << ": computed "
                              << testing::PrintToString(check.computed) << ", expected "
                              << testing::PrintToString(check.expected) << " " << check.unit << " ("
                              << check.source << "), error " << check.error() << ", tolerance "
                              << check.tolerance;
}

/// "bar_wave_11": the group in letters, and the number, as some groups are of several computations.
std::string test_name(const testing::TestParamInfo<Computation>& info) {
  std::string name = info.param.group + "_" + std::to_string(info.index);
  for (char& letter : name)
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Closed, Verification, testing::ValuesIn(launchsafe::verify::computations()),
                         test_name);

TEST(Check, NotANumberNeverPasses) {
  const double nan = std::nan("");
  for (const Tolerance measure : {Tolerance::absolute, Tolerance::relative}) {
    EXPECT_FALSE((Check{"", nan, 1.0, 1e9, "", "", measure}.pass()));
    EXPECT_FALSE((Check{"", 1.0, nan, 1e9, "", "", measure}.pass()));
    EXPECT_FALSE((Check{"", 1.0, 1.0, nan, "", "", measure}.pass()));
  }
}

}  // namespace
