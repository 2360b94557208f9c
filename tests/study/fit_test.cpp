#include "launchsafe/study/fit.hpp"

#include <gtest/gtest.h>

namespace {

using namespace launchsafe::study;

TEST(GapFit, GivesTheNumbersOfThePrintedTable) {
  const auto fit =
      fit_gaps({0.0, 1e-4, 2e-4, 3e-4, 3.9e-4}, {416.1, 442.2, 467.7, 492.9, 523.3}, {2702.1, 416.1});
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
  const auto fit = fit_gaps({1e-4, 2e-4, 3e-4}, {442.2, 467.7, 492.9});
  ASSERT_TRUE(fit.has_value());
  EXPECT_FALSE(fit->mixed.has_value());
  EXPECT_FALSE(fit->published.has_value());
}

TEST(GapFit, IsNotMadeFromOneRow) { EXPECT_FALSE(fit_gaps({0.0}, {416.1}).has_value()); }

}  // namespace
