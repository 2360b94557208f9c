#include "launchsafe/report/gap_criterion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace launchsafe::report {
namespace {

/// The rows of the 155 mm shell's main job, rounded.
const std::vector<JudgedGap> main_job{{0.0, true, 103, 22, 0.0394, 0.0094},
                                      {0.01, true, 77, 23, 0.0294, 0.0094},
                                      {0.02, true, 51, 25, 0.0194, 0.0094},
                                      {0.03, false, 26, 28, 0.0094, 0.0094},
                                      {0.04, false, -265, 29, -0.001, 0.0094}};

double largest_under(const std::string& text, const std::vector<JudgedGap>& table = main_job) {
  const auto criterion = parse_criterion(text, "a standard");
  EXPECT_TRUE(criterion) << text;
  const std::size_t row = largest_gap_under(*criterion, table);
  return row < table.size() ? table[row].gap : -1.0;
}

TEST(GapCriterion, TheLargestComputedGapThatMeetsIt) {
  EXPECT_EQ(largest_under("margin >= 2 uncertainty"), 0.02);
  EXPECT_EQ(largest_under("margin >= 3 uncertainty"), 0.01);
  EXPECT_EQ(largest_under("margin >= 90 K"), 0.0);
  EXPECT_EQ(largest_under("margin >= 200 K"), -1.0);
  EXPECT_EQ(largest_under("distance >= 3 uncertainty"), 0.01);
  EXPECT_EQ(largest_under("distance >= 0.2 mm"), 0.01);
  EXPECT_EQ(largest_under("margin >= 1 uncertainty and distance >= 0.03 cm"), 0.0);
}

TEST(GapCriterion, SafeIsAskedForAsWell) {
  EXPECT_EQ(largest_under("margin >= 1 K"), 0.02);  // 0.03 cm has 26 K and is INDETERMINATE
}

TEST(GapCriterion, AGapAboveOneThatFailsIsNotRecommended) {
  std::vector<JudgedGap> table = main_job;
  table[1].safe = false;
  EXPECT_EQ(largest_under("margin >= 2 uncertainty", table), 0.0);
}

TEST(GapCriterion, WithoutACriticalGapNoDistanceIsMet) {
  std::vector<JudgedGap> table = main_job;
  for (JudgedGap& row : table) row.distance = row.distance_uncertainty = std::nan("");
  EXPECT_EQ(largest_under("distance >= 0.001 cm", table), -1.0);
}

TEST(GapCriterion, AnythingElseIsRefused) {
  for (const char* text :
       {"", "margin", "margin > 2 uncertainty", "margin >= 0.5 uncertainty", "margin >= -2 K",
        "margin >= nan K", "margin >= 2", "margin >= 2 cm", "gap <= 0.02 cm", "margin >= 2 uncertainty and",
        "margin >= 2 uncertainty or margin >= 3 K", "margin >= 2,5 K"})
    EXPECT_FALSE(parse_criterion(text, "a standard")) << text;
  EXPECT_FALSE(parse_criterion("margin >= 2 uncertainty", " "));
}

}  // namespace
}  // namespace launchsafe::report
