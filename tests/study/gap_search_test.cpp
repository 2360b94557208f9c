#include "launchsafe/study/gap_search.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace launchsafe;
using namespace launchsafe::study;

Ignites from(double critical) {
  return [critical](double gap) { return gap >= critical; };
}

TEST(GapSearch, FindsAStepToTheAccuracyOfCriticalGaps) {
  for (const double truth : {2e-8, 3.125e-5, 3.95e-4, 9.9999e-4}) {
    const CriticalGap found = find_critical_gap(from(truth), 1e-3);
    EXPECT_EQ(found.kind, CriticalGapKind::value) << truth;
    EXPECT_NEAR(found.value, truth, gap_accuracy) << truth;
    EXPECT_EQ(gap_or_bound(found), found.value) << truth;
  }
}

TEST(GapSearch, WithoutIgnitionHasTheEndOfTheSearch) {
  const CriticalGap found = find_critical_gap(from(no_ignition), 1e-3);
  EXPECT_EQ(found.kind, CriticalGapKind::all_safe);
  EXPECT_EQ(found.value, 1e-3);
  EXPECT_EQ(gap_or_bound(found), no_ignition);
}

TEST(GapSearch, IgnitionWithoutAGapIsACriticalGapOfZero) {
  const CriticalGap found = find_critical_gap(from(0.0), 1e-3);
  EXPECT_EQ(found.kind, CriticalGapKind::all_ignite);
  EXPECT_EQ(found.value, 0.0);
}

TEST(GapSearch, SafeGapsBeyondTheFirstIgnitionAreSeveralCrossings) {
  const CriticalGap found = find_critical_gap([](double gap) { return gap > 2e-4 && gap < 6e-4; }, 1e-3);
  EXPECT_EQ(found.kind, CriticalGapKind::several_crossings);
  EXPECT_NEAR(found.value, 2e-4, gap_accuracy);
  const CriticalGap at_zero = find_critical_gap([](double gap) { return gap < 1e-4; }, 1e-3);
  EXPECT_EQ(at_zero.kind, CriticalGapKind::several_crossings);
  EXPECT_EQ(at_zero.value, 0.0);
}

/// A step at 0.395 mm that is undefined near a gap: one of the scan, and one that bisection alone asks for.
TEST(GapSearch, AnUndefinedGapLeavesTheCriticalGapUnknown) {
  for (const double bad : {1e-3, 3.95e-4}) {
    const Ignites ignites = [bad](double gap) -> std::optional<bool> {
      if (std::abs(gap - bad) < 1e-5) return std::nullopt;
      return gap >= 3.95e-4;
    };
    const CriticalGap found = find_critical_gap(ignites, 1e-3);
    EXPECT_EQ(found.kind, CriticalGapKind::unknown) << bad;
    EXPECT_TRUE(std::isnan(found.value)) << bad;
    EXPECT_TRUE(std::isnan(critical_gap_near(ignites, bad, 1e-3))) << bad;
  }
}

TEST(GapSearch, NearAGuessFindsTheSameFromBothSides) {
  for (const double truth : {2e-8, 3.95e-4, 9.9e-4})
    for (const double guess : {-1.0, 0.0, 3.95e-4, 3.96e-4, 1e-3, 1.0})
      EXPECT_NEAR(critical_gap_near(from(truth), guess, 1e-3), truth, gap_accuracy) << truth << ' ' << guess;
}

TEST(GapSearch, NearAGuessEndsAtNoGapAndAtTheEndOfTheSearch) {
  for (const double guess : {0.0, 3e-4, 1e-3}) {
    EXPECT_EQ(critical_gap_near(from(0.0), guess, 1e-3), 0.0) << guess;
    EXPECT_EQ(critical_gap_near(from(no_ignition), guess, 1e-3), no_ignition) << guess;
  }
}

}  // namespace
