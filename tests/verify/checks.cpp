// Every number that `launchsafe verify` prints, as a test of its own.
#include "launchsafe/verify/check.hpp"
#include "launchsafe/verify/material_checks.hpp"
#include "launchsafe/verify/surface_checks.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>

namespace {

using launchsafe::verify::Check;

class Verification : public testing::TestWithParam<Check> {};

TEST_P(Verification, ComputesTheExpectedNumber) {
  const Check& check = GetParam();
  EXPECT_TRUE(check.pass()) << check.group << ": " << check.name << ": computed "
                            << testing::PrintToString(check.computed) << ", expected "
                            << testing::PrintToString(check.expected) << " " << check.unit << " ("
                            << check.source << "), error " << check.error() << ", tolerance "
                            << check.tolerance;
}

/// "induction_from_600_K": the group and the name in letters and digits.
std::string test_name(const testing::TestParamInfo<Check>& info) {
  std::string name;
  for (const char letter : info.param.group + " " + info.param.name) {
    const bool plain = std::isalnum(static_cast<unsigned char>(letter)) != 0;
    if (plain) name += letter;
    if (!plain && !name.empty() && name.back() != '_') name += '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Materials, Verification, testing::ValuesIn(launchsafe::verify::material_checks()),
                         test_name);
INSTANTIATE_TEST_SUITE_P(Surface, Verification, testing::ValuesIn(launchsafe::verify::surface_checks()),
                         test_name);

TEST(Check, NotANumberNeverPasses) {
  const double nan = std::nan("");
  for (const bool absolute : {true, false}) {
    EXPECT_FALSE((Check{"", "", nan, 1.0, 1e9, "", "", absolute}.pass()));
    EXPECT_FALSE((Check{"", "", 1.0, nan, 1e9, "", "", absolute}.pass()));
    EXPECT_FALSE((Check{"", "", 1.0, 1.0, nan, "", "", absolute}.pass()));
  }
}

}  // namespace
