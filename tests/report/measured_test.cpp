#include "launchsafe/report/table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace launchsafe::report {
namespace {

// Expected texts follow from the rule by hand: two significant digits of the uncertainty, the value down, the
// uncertainty up.
TEST(Measured, AValueHasTheDigitsOfItsUncertainty) {
  EXPECT_EQ(measured(0.0395058, 0.0083, 0.0083).text("cm"), "0.0395 ± 0.0083 cm");
  EXPECT_EQ(measured(0.0395058, 0.00938, 0.00938).text("cm"), "0.0395 ± 0.0094 cm");
  EXPECT_EQ(measured(0.0395058, 0.00012, 0.00012).text("cm"), "0.03950 ± 0.00012 cm");
  EXPECT_EQ(measured(519.44, 2.0, 2.0).text("K"), "519.4 ± 2.0 K");
  EXPECT_EQ(measured(0.03, 0.002, 0.002).text("cm"), "0.0300 ± 0.0020 cm");
  EXPECT_EQ(measured(123.4, 60.0, 60.0).text(""), "123 ± 60");
  EXPECT_EQ(measured(0.0381508, 0.03801, 0.03801).text("cm"), "0.038 ± 0.039 cm");
  EXPECT_EQ(measured(0.0081, 0.038, 0.038).text("cm"), "0.008 ± 0.038 cm");
}

TEST(Measured, SharesWithASignMakeItAsymmetric) {
  EXPECT_EQ(measured(0.0395, 0.012, 0.005).text("cm"), "0.039 +0.006 −0.012 cm");
  EXPECT_EQ(measured(0.152, 0.083, 0.054).text("cm"), "0.152 +0.054 −0.083 cm");
  // No gap is below 0, though the value was cut.
  EXPECT_EQ(measured_gap(0.0439, 0.0, 0.1)->text("cm"), "0.043 +0.057 −0.043 cm");
}

TEST(Measured, RoundingNeverAllowsMoreThanWasComputed) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> decade(-5, 1), share(0.01, 2);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::pow(10.0, decade(random));
    const double minus = value * share(random), plus = i % 2 == 0 ? minus : value * share(random);
    const Measured shown = measured(value, minus, plus);
    const double slack = 1e-9 * (value + minus + plus);
    EXPECT_LE(shown.value, value + slack);
    EXPECT_GE(shown.minus, minus - slack);
    EXPECT_GE(shown.plus, plus - slack);
    EXPECT_LE(shown.lower(), value - minus + slack) << value << " " << minus << " " << plus;
    if (plus != minus) {
      EXPECT_GE(shown.upper(), value + plus - slack) << value << " " << minus << " " << plus;
    }
  }
}

TEST(Measured, DecimalNumbersStayWhatTheyAre) {
  for (int i = 0; i < 1000; ++i) {
    const double number = i / 1000.0;
    EXPECT_EQ(rounded_down(number, 3), number);
    EXPECT_EQ(rounded_up(number, 3), number);
  }
  EXPECT_EQ(allowed_text(0.0299, 2), "0.02");
  EXPECT_EQ(allowed_text(-0.0001, 0), "-1");
}

TEST(Measured, UncertaintiesAreRoundedUp) {
  EXPECT_EQ(uncertain_text(21.55), "22");
  EXPECT_EQ(uncertain_text(1.083), "1.1");
  EXPECT_EQ(uncertain_text(141.0), "150");
  EXPECT_EQ(uncertain_text(0.0), "0");
  EXPECT_EQ(uncertain_text(0.00938, 1), "0.01");
}

}  // namespace
}  // namespace launchsafe::report
