#include "launchsafe/study/verdict.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using namespace launchsafe::study;

TEST(GapFit, GivesTheNumbersOfThePrintedTable) {
  const auto fit =
      fit_gaps({0.0, 1e-4, 2e-4, 3e-4, 3.9e-4}, {416.1, 442.2, 467.7, 492.9, 523.3}, {}, {2702.1, 416.1});
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(fit->ordinary.slope, 2702.061, 5e-4);
  EXPECT_NEAR(fit->ordinary.intercept, 414.939, 5e-4);
  EXPECT_GT(fit->least_squares.r_squared, 0.99);
  ASSERT_TRUE(fit->mixed.has_value());
  EXPECT_EQ(fit->mixed->intercept, 416.1);
  EXPECT_EQ(fit->mixed->slope, fit->ordinary.slope);
  EXPECT_EQ(fit->mixed->residuals[0], 0.0);
  ASSERT_TRUE(fit->published.has_value());
  EXPECT_NEAR(fit->published->residuals[4], 523.3 - (416.1 + 2702.1 * 0.039), 1e-9);
  EXPECT_LE(fit->ordinary.root_mean_square, fit->mixed->root_mean_square);
}

TEST(GapFit, HasNoMixedFormWithoutAZeroGap) {
  const auto fit = fit_gaps({1e-4, 2e-4, 3e-4}, {442.2, 467.7, 492.9}, {});
  ASSERT_TRUE(fit.has_value());
  EXPECT_FALSE(fit->mixed.has_value());
  EXPECT_FALSE(fit->published.has_value());
}

// What is left out is fitted anew, without the formula of leverage.
TEST(GapFit, TellsWhatEachRowIsOffTheLineThroughTheOthers) {
  const std::vector<double> gaps{0.0, 1e-4, 2e-4, 3e-4, 3.9e-4};
  const std::vector<double> temperatures{416.1, 442.2, 467.7, 492.9, 523.3};
  const auto fit = fit_gaps(gaps, temperatures, {});
  ASSERT_TRUE(fit.has_value());
  double sum = 0;
  for (std::size_t out = 0; out < gaps.size(); ++out) {
    std::vector<double> others = gaps, warm = temperatures;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(out));
    warm.erase(warm.begin() + static_cast<std::ptrdiff_t>(out));
    const auto without = fit_gaps(others, warm, {});
    ASSERT_TRUE(without.has_value());
    const double error =
        temperatures[out] - (without->ordinary.intercept + without->ordinary.slope * 100.0 * gaps[out]);
    EXPECT_NEAR(fit->left_out[out], error, 1e-9);
    sum += error * error;
  }
  ASSERT_EQ(fit->curves.size(), 3u);
  EXPECT_NEAR(fit->curves[0].left_out, std::sqrt(sum / 5), 1e-9);
  EXPECT_GT(fit->curves[0].left_out, fit->curves[0].root_mean_square);
}

// The line through rows that lie on one reaches 526.784 K where it does by hand, without a band.
TEST(GapFit, TellsWhereTheLineReachesIgnitionAndAParabolaThatFitsBetter) {
  const auto line = fit_gaps({0.0, 1e-4, 2e-4, 3e-4}, {400.0, 420.0, 440.0, 460.0}, {});
  ASSERT_TRUE(line.has_value());
  EXPECT_NEAR(line->reaches_ignition, 126.784 / 2000.0 * 0.01, 1e-12);
  EXPECT_NEAR(line->reaches_ignition_half_width, 0.0, 1e-12);
  const auto bent = fit_gaps({0.0, 1e-4, 2e-4, 3e-4, 4e-4}, {400.0, 421.0, 444.0, 469.0, 496.0}, {});
  ASSERT_TRUE(bent.has_value());
  EXPECT_NEAR(bent->curves[1].left_out, 0.0, 1e-9) << "400 + 20 x + x^2";
  EXPECT_GT(bent->curves[0].left_out, 1.0);
}

TEST(GapFit, ComparesNoCurvesOfTwoRows) {
  const auto fit = fit_gaps({0.0, 1e-4}, {400.0, 420.0}, {});
  ASSERT_TRUE(fit.has_value());
  EXPECT_TRUE(fit->curves.empty());
  EXPECT_TRUE(std::isnan(fit->left_out[0]));
  EXPECT_TRUE(std::isnan(fit->reaches_ignition_half_width));
}

TEST(GapFit, IsNotMadeFromOneRow) { EXPECT_FALSE(fit_gaps({0.0}, {416.1}, {}).has_value()); }

}  // namespace
