#include "launchsafe/study/bracket.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace launchsafe::study;

TEST(CriticalGapSearch, BracketsAThresholdToTheTolerance) {
  for (const double truth : {1e-7, 3.95e-4, 3.125e-5, 9.9999e-4}) {
    const CriticalGap found = find_critical_gap([truth](double gap) { return gap >= truth; }, 1e-3, 1e-6);
    ASSERT_EQ(found.kind, CriticalGapKind::value) << truth;
    EXPECT_LT(found.lower, truth);
    EXPECT_GE(found.upper, truth);
    EXPECT_LE(found.upper - found.lower, 1e-6);
    EXPECT_GE(found.value, found.lower);
    EXPECT_LE(found.value, found.upper);
    EXPECT_EQ(found.reason.code, GapReasonCode::none);
  }
}

TEST(CriticalGapSearch, CentresTheBracketSoThatBothSidesStandClear) {
  const double truth = 3.9512e-4;
  const CriticalGap found = find_critical_gap([truth](double gap) { return gap >= truth; }, 1e-3, 1e-6);
  EXPECT_GT(truth - found.lower, 0.45e-6);
  EXPECT_GT(found.upper - truth, 0.45e-6);
}

TEST(CriticalGapSearch, AllSafeIsABoundAndNotANumber) {
  const CriticalGap found = find_critical_gap([](double) { return false; }, 1e-3, 1e-6);
  EXPECT_EQ(found.kind, CriticalGapKind::all_safe);
  EXPECT_TRUE(std::isnan(found.value));
  EXPECT_TRUE(std::isnan(found.upper));
  EXPECT_EQ(found.lower, 1e-3);
  EXPECT_EQ(found.reason.code, GapReasonCode::end_of_search);
  EXPECT_NE(text_of(found.reason).find("0.1 cm"), std::string::npos);
}

TEST(CriticalGapSearch, AllIgniteIsABoundAndNotANumber) {
  const CriticalGap found = find_critical_gap([](double) { return true; }, 1e-3, 1e-6);
  EXPECT_EQ(found.kind, CriticalGapKind::all_ignite);
  EXPECT_TRUE(std::isnan(found.value));
  EXPECT_TRUE(std::isnan(found.lower));
  EXPECT_EQ(found.upper, 0.0);
}

TEST(CriticalGapSearch, AnUndefinedGapMakesItIndeterminate) {
  for (const double bad : {1e-3, 3.95e-4}) {
    const CriticalGap found = find_critical_gap(
        [bad](double gap) {
          if (std::abs(gap - bad) < 1e-5) return std::optional<bool>();
          return std::optional(gap >= 3.95e-4);
        },
        1e-3, 1e-6);
    EXPECT_EQ(found.kind, CriticalGapKind::indeterminate) << bad;
    EXPECT_TRUE(std::isnan(found.value));
    EXPECT_EQ(found.reason.code, GapReasonCode::undefined);
  }
}

TEST(CriticalGapSearch, SafeGapsBeyondTheFirstIgnitionMakeItSeveralCrossings) {
  const CriticalGap found =
      find_critical_gap([](double gap) { return gap > 2e-4 && gap < 6e-4; }, 1e-3, 1e-6);
  EXPECT_EQ(found.kind, CriticalGapKind::several_crossings);
  EXPECT_TRUE(std::isnan(found.value));
  EXPECT_NEAR(found.lower, 2e-4, 1e-6);
  EXPECT_NEAR(found.upper, 2e-4, 1e-6);
  EXPECT_EQ(found.reason.code, GapReasonCode::not_monotone);
  EXPECT_NE(text_of(found.reason).find("0.0625 cm"), std::string::npos);
}

}  // namespace
