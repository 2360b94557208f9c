#include "launchsafe/study/verdict.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace launchsafe::study;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

CriticalGap critical_at(double gap, double uncertainty) {
  CriticalGap critical;
  critical.kind = CriticalGapKind::value;
  critical.value = gap;
  critical.lower = gap - 5e-7;
  critical.upper = gap + 5e-7;
  critical.uncertainty = uncertainty;
  return critical;
}

/// A gap of 0.03 cm, 32 K below ignition, with an uncertainty of 0.1 K.
Evidence calm() { return {true, "", false, 3e-4, 493.0, 32.0, 0.1}; }

TEST(Verdict, SafeNeedsAMarginAndADistanceAboveTheirUncertainties) {
  EXPECT_EQ(judge(calm(), critical_at(3.95e-4, 1e-6)).verdict, Verdict::safe);
}

TEST(Verdict, AMarginWithinTheUncertaintyIsIndeterminate) {
  Evidence evidence = calm();
  evidence.uncertainty = 40.0;
  const Judgement judged = judge(evidence, critical_at(3.95e-4, 1e-6));
  EXPECT_EQ(judged.verdict, Verdict::indeterminate);
  EXPECT_NE(judged.reason.find("margin"), std::string::npos);
  evidence.uncertainty = evidence.margin;
  EXPECT_EQ(judge(evidence, critical_at(3.95e-4, 1e-6)).verdict, Verdict::indeterminate);
}

TEST(Verdict, ReasonsHaveNoPowersOfTen) {
  Evidence evidence = calm();
  evidence.margin = 1034.5;
  evidence.uncertainty = 138.2;
  EXPECT_EQ(judge(evidence, critical_at(4e-4, 1e-6)).reason, "margin 1034 K over uncertainty 138 K");
}

TEST(Verdict, ADistanceWithinTheUncertaintyIsIndeterminate) {
  const Judgement judged = judge(calm(), critical_at(3.95e-4, 2e-4));
  EXPECT_EQ(judged.verdict, Verdict::indeterminate);
  EXPECT_NE(judged.reason.find("critical gap"), std::string::npos);
  EXPECT_EQ(judge(calm(), critical_at(2e-4, 1e-6)).verdict, Verdict::indeterminate);
}

TEST(Verdict, IgnitionIsUnsafe) {
  Evidence evidence = calm();
  evidence.ignited = true;
  evidence.margin = -259.0;
  EXPECT_EQ(judge(evidence, critical_at(2e-4, 1e-6)).verdict, Verdict::unsafe);
}

TEST(Verdict, WhatIsExtrapolatedStandsInEveryReason) {
  Evidence evidence = calm();
  evidence.extrapolated = "extrapolated: peak pressure";
  for (const double margin : {32.0, 0.05}) {
    evidence.margin = margin;
    const Judgement judged = judge(evidence, critical_at(3.95e-4, 1e-6));
    EXPECT_NE(judged.reason.find("extrapolated: peak pressure"), std::string::npos) << judged.reason;
  }
}

TEST(Verdict, AFailedRunIsNeitherSafeNorUnsafe) {
  for (const bool ignited : {false, true}) {
    Evidence evidence = calm();
    evidence.completed = false;
    evidence.failure = "energy drift: at 3 ms";
    evidence.ignited = ignited;
    const Judgement judged = judge(evidence, critical_at(3.95e-4, 1e-6));
    EXPECT_EQ(judged.verdict, Verdict::indeterminate);
    EXPECT_EQ(judged.reason, "energy drift: at 3 ms");
  }
}

TEST(Verdict, NotANumberIsNeverSafe) {
  for (int which = 0; which < 4; ++which) {
    Evidence evidence = calm();
    CriticalGap critical = critical_at(3.95e-4, 1e-6);
    if (which == 0) evidence.maximum_temperature = nan_value;
    if (which == 1) evidence.margin = nan_value;
    if (which == 2) evidence.uncertainty = nan_value;
    if (which == 3) critical.uncertainty = nan_value;
    EXPECT_EQ(judge(evidence, critical).verdict, Verdict::indeterminate) << which;
  }
}

TEST(Verdict, AnIndeterminateCriticalGapLeavesNoSafeGap) {
  CriticalGap critical;
  critical.reason = "the run with skin ignites";
  EXPECT_EQ(judge(calm(), critical).verdict, Verdict::indeterminate);
}

TEST(Verdict, WithoutACriticalGapInReachTheMarginDecides) {
  CriticalGap critical;
  critical.kind = CriticalGapKind::all_safe;
  critical.lower = 1e-3;
  EXPECT_EQ(judge(calm(), critical).verdict, Verdict::safe);
}

}  // namespace
