#include "launchsafe/study/rows.hpp"

#include <gtest/gtest.h>

namespace {

using namespace launchsafe::study;

TEST(GapFit, GivesTheNumbersOfThePrintedTable) {
  const auto lines = fit_gaps({0.0, 1e-4, 2e-4, 3e-4, 3.9e-4}, {416.1, 442.2, 467.7, 492.9, 523.3});
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NEAR(lines[0].slope, 2702.061, 5e-4);
  EXPECT_NEAR(lines[0].intercept, 414.939, 5e-4);
  // By the textbook's formulas, apart from the program.
  EXPECT_NEAR(lines[0].slope_error, 86.45403, 1e-4);
  EXPECT_NEAR(lines[0].intercept_error, 2.089614, 1e-5);
  EXPECT_EQ(lines[1].intercept, 416.1);
  EXPECT_EQ(lines[1].slope, lines[0].slope);
  EXPECT_LE(lines[0].root_mean_square, lines[1].root_mean_square);
}

TEST(GapFit, HasNoPublishedFormWithoutAZeroGap) {
  EXPECT_EQ(fit_gaps({1e-4, 2e-4, 3e-4}, {442.2, 467.7, 492.9}).size(), 1u);
}

TEST(GapFit, IsNotMadeFromOneRow) { EXPECT_TRUE(fit_gaps({0.0}, {416.1}).empty()); }

}  // namespace
