#include "launchsafe/report/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace launchsafe::report {
namespace {

// Expected texts follow from the rule by hand: two significant digits of the uncertainty, the value down, the
// uncertainty up.
TEST(Measured, AValueHasTheDigitsOfItsUncertainty) {
  const auto measured = [](double value, double minus, double plus) {
    return between_bounds(value, value - minus, value + plus, "cm");
  };
  EXPECT_EQ(measured(0.0395058, 0.0083, 0.0083), "0.0395 ± 0.0083 cm");
  EXPECT_EQ(measured(0.0395058, 0.00938, 0.00938), "0.0395 ± 0.0094 cm");
  EXPECT_EQ(measured(0.03, 0.002, 0.002), "0.0300 ± 0.0020 cm");
  EXPECT_EQ(measured(0.152, 0.083, 0.054), "0.152 +0.054 −0.083 cm") << "shares with a sign";
  EXPECT_EQ(between_bounds(0.0439, 0.0, 0.1, "cm"), "0.043 +0.057 −0.043 cm") << "no gap is below 0";
  EXPECT_EQ(between_bounds(0.04, 0.02, std::nan(""), "cm"), "") << "a bound is not known";
}

TEST(Measured, RoundingNeverCrossesTheNumber) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> decade(-5, 1);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::pow(10.0, decade(random));
    EXPECT_LE(rounded(value, 3, Rounding::down), value * (1.0 + 1e-9));
    EXPECT_GE(rounded(value, 3, Rounding::up), value * (1.0 - 1e-9));
  }
}

TEST(Measured, DecimalNumbersStayWhatTheyAre) {
  for (int i = 0; i < 1000; ++i)
    for (const Rounding side : {Rounding::down, Rounding::nearest, Rounding::up})
      EXPECT_EQ(rounded(i / 1000.0, 3, side), i / 1000.0);
  EXPECT_EQ(rounded(0.0299, 2, Rounding::down), 0.02);
  EXPECT_EQ(rounded(-0.0001, 0, Rounding::down), -1.0);
}

}  // namespace
}  // namespace launchsafe::report
