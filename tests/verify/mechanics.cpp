// Every simulation of `launchsafe verify`, as a test of its own.
#include "launchsafe/verify/mechanics_checks.hpp"

#include <gtest/gtest.h>

#include <cctype>

namespace {

using launchsafe::verify::Check;
using launchsafe::verify::Computation;

class Mechanics : public testing::TestWithParam<Computation> {};

TEST_P(Mechanics, ComputesTheExpectedNumbers) {
  for (const Check& check : GetParam().run())
    EXPECT_TRUE(check.pass()) << check.group << ": " << check.name << ": computed "
                              << testing::PrintToString(check.computed) << ", expected "
                              << testing::PrintToString(check.expected) << " " << check.unit << " ("
                              << check.source << "), error " << check.error() << ", tolerance "
                              << check.tolerance;
}

std::string computation_name(const testing::TestParamInfo<Computation>& info) {
  std::string name = info.param.name;
  if (info.param.formulation == launchsafe::scene::Formulation::updated_lagrangian) name += " updated";
  for (char& letter : name)
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Closed, Mechanics, testing::ValuesIn(launchsafe::verify::mechanics_computations()),
                         computation_name);

}  // namespace
