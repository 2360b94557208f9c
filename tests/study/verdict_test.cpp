#include "launchsafe/study/verdict.hpp"

#include "facts_in_text.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <utility>

namespace {

using namespace launchsafe;
using namespace launchsafe::study;

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

/// A critical gap (m) of which one cause of knowledge leaves so much less.
CriticalGap critical_at(double gap, double less) {
  CriticalGap critical;
  critical.kind = CriticalGapKind::value;
  critical.value = gap;
  critical.lower = gap - 5e-7;
  critical.upper = gap + 5e-7;
  set_shares(critical, {{ShareKind::fit, critical.lower - less, critical.upper + less}});
  return critical;
}

CriticalGap none_up_to(double gap, double least_raised) {
  CriticalGap critical;
  critical.kind = CriticalGapKind::all_safe;
  critical.lower = gap;
  set_shares(critical, {{ShareKind::fit, least_raised, no_ignition}});
  return critical;
}

/// A gap of 0.03 cm of such a case, 32 K below ignition, with an uncertainty of 0.1 K.
GapVerdict calm(CaseEvidence of_case = {.failure = {}}) {
  GapVerdict row;
  row.gap = 3e-4;
  row.maximum.temperature = 493.0;
  row.margin = 32.0;
  row.uncertainty.input = 0.1;
  row.of_case = std::make_shared<const CaseEvidence>(std::move(of_case));
  return row;
}

std::string reason_of(GapVerdict row, const CriticalGap& critical) {
  row.judgement = judge(row, critical);
  return reason_text(row);
}

scene::Implausible wide_station() { return {"station.width", "7 mm", "5 mm", {}, {}}; }

TEST(Verdict, SafeIsBelowTheLowerBoundOfTheCriticalGap) {
  EXPECT_EQ(judge(calm(), critical_at(3.95e-4, 1e-6)).verdict, Verdict::safe);
  const Judgement judged = judge(calm(), critical_at(3.95e-4, 1.2e-4));
  EXPECT_EQ(judged.verdict, Verdict::indeterminate);
  EXPECT_EQ(judged.code, ReasonCode::not_below_bound);
  EXPECT_NE(reason_of(calm(), critical_at(3.95e-4, 1.2e-4)).find("0.0275 cm"), std::string::npos);
}

/// 0.03 cm, and a bound of 0.03 cm: the bound is the largest gap that no end of a range ignites, but what
/// lies at it is not below it.
TEST(Verdict, TheLowerBoundItselfIsNotSafe) {
  CriticalGap critical = critical_at(3.95e-4, 0.0);
  critical.bounds.at_least = 3e-4;
  EXPECT_EQ(judge(calm(), critical).verdict, Verdict::indeterminate);
}

TEST(Verdict, KelvinsDoNotDecideWhereThereIsACriticalGap) {
  GapVerdict evidence = calm();
  evidence.uncertainty.input = 40.0;
  EXPECT_EQ(judge(evidence, critical_at(3.95e-4, 1e-6)).verdict, Verdict::safe);
  evidence.margin = -0.1;
  EXPECT_EQ(judge(evidence, critical_at(3.95e-4, 1e-6)).verdict, Verdict::indeterminate);
}

TEST(Verdict, WithoutACriticalGapInReachTheMarginDecidesToo) {
  GapVerdict evidence = calm();
  EXPECT_EQ(judge(evidence, none_up_to(widest_search, no_ignition)).verdict, Verdict::safe);
  EXPECT_EQ(judge(evidence, none_up_to(widest_search, 2e-4)).verdict, Verdict::indeterminate);
  evidence.uncertainty.input = evidence.margin;
  EXPECT_EQ(judge(evidence, none_up_to(widest_search, no_ignition)).verdict, Verdict::indeterminate);
}

// On the 155 mm shell a search that ended at 0.031 cm made 0.03 cm SAFE, of which one up to 0.1 cm found the
// critical gap at 0.0382 cm, and that it may be as small as 0.0273 cm. With uncertainties of 20 K each one up
// to 0.0305 cm made 0.0152 cm SAFE, of which one up to 0.1 cm found that it may be as small as 0.0076 cm.
TEST(Verdict, AnEarlyEndOfTheSearchMakesNoGapSafe) {
  GapVerdict evidence = calm();
  for (const double end : {3e-4, 3.1e-4, 1e-3, 0.99 * widest_search}) {
    const Judgement judged = judge(evidence, none_up_to(end, no_ignition));
    EXPECT_EQ(judged.verdict, Verdict::indeterminate) << end;
    EXPECT_EQ(judged.code, ReasonCode::not_below_bound) << end;
  }
  EXPECT_EQ(judge(evidence, none_up_to(widest_search, no_ignition)).verdict, Verdict::safe);
}

TEST(Verdict, ReasonsHaveNoPowersOfTen) {
  GapVerdict evidence = calm();
  evidence.margin = 1034.5;
  evidence.uncertainty.input = 138.2;
  EXPECT_TRUE(launchsafe::testing::in_order(reason_of(evidence, none_up_to(widest_search, no_ignition)),
                                            {"1034 K", "138 K"}));
}

TEST(Verdict, WhereAnEndIgnitesWithoutAGapNoneIsSafe) {
  GapVerdict evidence = calm();
  evidence.gap = 0.0;
  CriticalGap critical = critical_at(3.95e-4, 0.0);
  set_shares(critical, {{ShareKind::peak_pressure, 0.0, no_ignition}});
  const Judgement judged = judge(evidence, critical);
  EXPECT_EQ(judged.verdict, Verdict::indeterminate);
  EXPECT_EQ(judged.code, ReasonCode::may_ignite_without_gap);
}

TEST(Verdict, IgnitionIsUnsafe) {
  GapVerdict evidence = calm();
  evidence.ignition.emplace();
  evidence.margin = -259.0;
  EXPECT_EQ(judge(evidence, critical_at(2e-4, 1e-6)).verdict, Verdict::unsafe);
}

TEST(Verdict, WhatNobodyAcceptsIsNeverSafeAndUndoesNoIgnition) {
  CaseEvidence of_case{.failure = {}};
  of_case.input.implausible = {wide_station()};
  GapVerdict evidence = calm(of_case);
  EXPECT_EQ(judge(evidence, critical_at(3.95e-4, 1e-6)).verdict, Verdict::indeterminate);
  evidence.ignition.emplace();
  EXPECT_EQ(judge(evidence, critical_at(2e-4, 1e-6)).verdict, Verdict::unsafe);
  EXPECT_TRUE(launchsafe::testing::in_order(reason_of(evidence, critical_at(2e-4, 1e-6)),
                                            {"station.width = 7 mm", "5 mm"}));
  of_case.validity_warnings = {"the load ends above 1 % of its peak"};
  EXPECT_EQ(judge(calm(of_case), critical_at(2e-4, 1e-6)).verdict, Verdict::indeterminate);
}

TEST(Verdict, WithoutTheEvidenceOfItsCaseNothingIsSafe) {
  GapVerdict evidence = calm();
  evidence.of_case.reset();
  EXPECT_EQ(judge(evidence, critical_at(3.95e-4, 1e-6)).verdict, Verdict::indeterminate);
}

TEST(Verdict, NoIgnitionOfWhatOnlyCoolsOrWasNotLaunchedIsSafe) {
  CaseEvidence of_case{.failure = {}};
  of_case.input.optimistic = "no ignition with stations deeper than 10 mm shows nothing";
  EXPECT_EQ(judge(calm(of_case), critical_at(3.95e-4, 1e-6)).code, ReasonCode::optimistic);
  for (const double rise : {0.99, -1.0, nan_value}) {
    const GapVerdict unheated = calm({.failure = {}, .friction_rise = rise});
    EXPECT_EQ(judge(unheated, critical_at(3.95e-4, 1e-6)).verdict, Verdict::indeterminate) << rise;
  }
  const GapVerdict launched = calm({.failure = {}, .friction_rise = 1.0});
  EXPECT_EQ(judge(launched, critical_at(3.95e-4, 1e-6)).verdict, Verdict::safe);
}

TEST(Verdict, WithoutACriticalGapInReachTheMarginOfTheConstantsAsCalibratedDecidesToo) {
  GapVerdict evidence = calm();
  evidence.uncertainty.input = 0.125;  // as margins of it are exact
  for (const double margin : {0.125, 0.05, -1.0, nan_value, -std::numeric_limits<double>::infinity()}) {
    evidence.as_calibrated = {{"", evidence.margin + evidence.maximum.temperature - margin, false}};
    EXPECT_EQ(judge(evidence, none_up_to(widest_search, no_ignition)).verdict, Verdict::indeterminate)
        << margin;
  }
  evidence.as_calibrated = {{"", evidence.margin + evidence.maximum.temperature - 0.2, false}};
  EXPECT_EQ(judge(evidence, none_up_to(widest_search, no_ignition)).verdict, Verdict::safe);
}

TEST(Verdict, WhatIsExtrapolatedStandsInEveryReason) {
  CaseEvidence of_case{.failure = {}};
  of_case.input.extrapolated = {"peak pressure"};
  of_case.input.calibrated_gap = 2e-4;
  GapVerdict evidence = calm(of_case);
  for (const double margin : {32.0, 0.05}) {
    evidence.margin = margin;
    const std::string reason = reason_of(evidence, critical_at(3.95e-4, 1e-6));
    EXPECT_TRUE(reason.ends_with("; extrapolated: peak pressure, gap")) << reason;
  }
}

TEST(Verdict, AFailedRunIsNeitherSafeNorUnsafe) {
  for (const bool ignited : {false, true}) {
    GapVerdict evidence = calm({.failure = "energy drift: at 3 ms"});
    if (ignited) evidence.ignition.emplace();
    EXPECT_EQ(judge(evidence, critical_at(3.95e-4, 1e-6)).verdict, Verdict::indeterminate);
    EXPECT_EQ(reason_of(evidence, critical_at(3.95e-4, 1e-6)), "energy drift: at 3 ms");
  }
}

TEST(Verdict, NotANumberIsNeverSafe) {
  for (int which = 0; which < 3; ++which) {
    GapVerdict evidence = calm();
    CriticalGap critical = critical_at(3.95e-4, 1e-6);
    if (which == 0) evidence.maximum.temperature = nan_value;
    if (which == 1) evidence.margin = nan_value;
    if (which == 2) set_shares(critical, {{ShareKind::fit, nan_value, nan_value}});
    EXPECT_EQ(judge(evidence, critical).verdict, Verdict::indeterminate) << which;
  }
}

TEST(Verdict, AnIndeterminateCriticalGapLeavesNoSafeGap) {
  CriticalGap critical;
  critical.reason.code = GapReasonCode::coupled_ignites;
  EXPECT_EQ(judge(calm(), critical).verdict, Verdict::indeterminate);
}

}  // namespace
