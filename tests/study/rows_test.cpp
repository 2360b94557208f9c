// Bounds and verdicts from rows of plain numbers: by hand, and as properties of random rows.
#include "launchsafe/study/rows.hpp"

#include "facts_in_text.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>

#ifdef LAUNCHSAFE_HAVE_RAPIDCHECK
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>
#endif

namespace {

using namespace launchsafe;
using namespace launchsafe::study;

CriticalGap gap_at(double gap) { return {CriticalGapKind::value, gap}; }

// --- bounds ---

/// Random shares of 3 and 4 um are 5 um together; bounds of 1 and 2 um are added.
TEST(Bounds, TakeRandomCausesAsARootOfSquaresAndAddTheOthers) {
  const GapBounds bounds = bounds_of(gap_at(100e-6), {{Cause::peak_pressure, 3e-6, 8e-6},
                                                      {Cause::initial_temperature, 4e-6, 6e-6},
                                                      {Cause::numerics, 1e-6, 2e-6},
                                                      {Cause::after_launch, 2e-6, 0.0}});
  EXPECT_NEAR(bounds.at_least, 92e-6, 1e-12);
  EXPECT_NEAR(bounds.at_most, 112e-6, 1e-12);
}

TEST(Bounds, AreNotNegative) {
  EXPECT_EQ(bounds_of(gap_at(100e-6), {{Cause::models, 101e-6, 0.0}}).at_least, 0.0);
}

TEST(Bounds, OfAnUnknownShareOrCriticalGapAreUnknown) {
  const GapBounds downwards = bounds_of(gap_at(100e-6), {{Cause::after_launch, not_a_number, 1e-6}});
  EXPECT_TRUE(std::isnan(downwards.at_least));
  EXPECT_NEAR(downwards.at_most, 101e-6, 1e-12);
  EXPECT_TRUE(std::isnan(bounds_of(gap_at(1e-4), {{Cause::peak_pressure, 0.0, not_a_number}}).at_most));
  EXPECT_TRUE(std::isnan(bounds_of({}, {}).at_least));
}

/// Without ignition up to 10 mm: half of that, or less by the causes.
TEST(Bounds, WithoutIgnitionAreHalfOfTheSearchAtTheMost) {
  const CriticalGap none{CriticalGapKind::all_safe, 1e-2};
  EXPECT_EQ(bounds_of(none, {{Cause::numerics, 1e-3, 1e-3}}).at_least, 5e-3);
  EXPECT_NEAR(bounds_of(none, {{Cause::numerics, 7e-3, 1e-3}}).at_least, 3e-3, 1e-12);
  EXPECT_EQ(bounds_of(none, {}).at_most, no_ignition);
}

TEST(Bounds, OfIgnitionWithoutAGapBeginAtZero) {
  const GapBounds bounds = bounds_of({CriticalGapKind::all_ignite, 0.0}, {{Cause::numerics, 1e-6, 2e-6}});
  EXPECT_EQ(bounds.at_least, 0.0);
  EXPECT_EQ(bounds.at_most, 2e-6);
}

// --- verdicts ---

/// A critical gap of 0.04 cm that may be 0.02 cm, and a cool gap of 0.01 cm.
struct Judged {
  CaseRow of_case;
  GapRow gap;

  Judged() {
    of_case.critical = gap_at(4e-4);
    of_case.bounds = {2e-4, 5e-4};
    gap.gap = 1e-4;
    gap.maximum.temperature = 440.0;
  }
  Judgement judgement() const { return judge(of_case, gap); }
  void expect(Verdict verdict, ReasonCode code) const {
    EXPECT_EQ(to_string(judgement().verdict), to_string(verdict)) << to_string(code);
    EXPECT_EQ(to_string(judgement().code), to_string(code));
  }
};

const Remark first_class{"energy", "no history", false, {}}, second_class{"low-velocity", "9 m/s", true, {}},
    beyond{"calibre", "105 mm, fitted 150 to 160 mm", true, {}};

/// All that can be wrong, from the last rule to the first: each time the rule above it takes over.
TEST(Verdict, FollowsTheFirstRuleThatFits) {
  struct Rule {
    ReasonCode code;
    Verdict verdict;
    std::function<void(Judged&)> fits;
  };
  const std::vector<Rule> rules{
      {ReasonCode::below_bound, Verdict::safe, [](Judged&) {}},
      {ReasonCode::extrapolated, Verdict::indeterminate,
       [](Judged& all) { all.of_case.extrapolated = {beyond}; }},
      {ReasonCode::within_bounds, Verdict::indeterminate, [](Judged& all) { all.gap.gap = 2e-4; }},
      {ReasonCode::no_critical_gap, Verdict::indeterminate,
       [](Judged& all) { all.of_case.critical.kind = CriticalGapKind::several_crossings; }},
      {ReasonCode::warning, Verdict::indeterminate,
       [](Judged& all) { all.of_case.warnings = {second_class}; }},
      {ReasonCode::ignites, Verdict::unsafe, [](Judged& all) { all.gap.ignition.emplace(); }},
      {ReasonCode::warning, Verdict::indeterminate,
       [](Judged& all) { all.of_case.warnings.push_back(first_class); }},
      {ReasonCode::failed, Verdict::indeterminate,
       [](Judged& all) { all.of_case.incomplete = "the companion launch did not complete"; }},
  };
  Judged all;
  for (const Rule& rule : rules) {
    rule.fits(all);
    all.expect(rule.verdict, rule.code);
    Judged alone;
    rule.fits(alone);
    alone.expect(rule.verdict, rule.code);
  }
}

TEST(Verdict, IsSafeOnlyBelowTheLowerBound) {
  Judged judged;
  judged.gap.gap = std::nextafter(2e-4, 0.0);
  judged.expect(Verdict::safe, ReasonCode::below_bound);
  judged.gap.gap = 0.0;
  judged.of_case.bounds.at_least = 0.0;
  judged.expect(Verdict::indeterminate, ReasonCode::within_bounds);
}

TEST(Verdict, WithoutANumberFails) {
  const std::vector<std::function<void(Judged&)>> changes{
      [](Judged& all) { all.of_case.failure = "energy drift"; }, [](Judged& all) { all.of_case.bounds = {}; },
      [](Judged& all) { all.gap.maximum.temperature = not_a_number; }};
  for (const auto& change : changes)
    for (const bool ignites : {false, true}) {
      Judged judged;
      change(judged);
      if (ignites) judged.gap.ignition.emplace();
      judged.expect(Verdict::indeterminate, ReasonCode::failed);
    }
}

TEST(Verdict, StandsOnWhatIsAcceptedAndNamesIt) {
  Judged judged;
  judged.of_case.warnings = {second_class};
  judged.of_case.extrapolated = {beyond};
  judged.expect(Verdict::indeterminate, ReasonCode::warning);
  judged.of_case.warnings[0].because = "a mortar has that";
  judged.expect(Verdict::indeterminate, ReasonCode::extrapolated);
  judged.of_case.extrapolated[0].because = "the same wall";
  judged.expect(Verdict::safe, ReasonCode::below_bound);
  EXPECT_EQ(judged.of_case.basis(), "extrapolated");
  EXPECT_TRUE(launchsafe::testing::in_order(accepted_text(judged.of_case),
                                            {"low-velocity", "a mortar", "calibre", "the same wall"}));
  EXPECT_EQ(names_text(judged.of_case.warnings), "low-velocity");
}

TEST(Verdict, HasAReasonWithTheNumbersOfItsRule) {
  Judged judged;
  const auto reason = [&] {
    judged.gap.judgement = judged.judgement();
    return reason_text(judged.of_case, judged.gap);
  };
  EXPECT_NE(reason().find("0.02 cm"), std::string::npos);
  judged.of_case.extrapolated = {beyond};
  EXPECT_NE(reason().find("calibre: 105 mm"), std::string::npos);
  judged.gap.gap = 3e-4;
  EXPECT_NE(reason().find("0.02 cm"), std::string::npos);
  judged.of_case.warnings = {second_class};
  EXPECT_NE(reason().find("low-velocity: 9 m/s"), std::string::npos);
  judged.of_case.failure = "energy drift";
  EXPECT_EQ(reason(), "energy drift");
}

TEST(Verdict, LargestSafeGapHasNoOtherVerdictBelowIt) {
  using enum Verdict;
  const auto largest = [](std::vector<std::pair<double, Verdict>> judged) {
    std::vector<GapRow> rows;
    for (const auto& [gap, verdict] : judged) {
      rows.emplace_back().gap = gap;
      rows.back().judgement.verdict = verdict;
    }
    return largest_safe_gap(rows);
  };
  EXPECT_EQ(largest({{0.0, safe}, {2.0, unsafe}, {1.0, safe}}), 1.0);
  EXPECT_EQ(largest({{0.0, safe}, {1.0, indeterminate}, {2.0, safe}}), 0.0);
  EXPECT_TRUE(std::isnan(largest({{0.0, indeterminate}, {1.0, safe}})));
}

TEST(Verdict, CodesAndCausesHaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (int code = 0; code <= static_cast<int>(ReasonCode::below_bound); ++code)
    names.insert(to_string(static_cast<ReasonCode>(code)));
  EXPECT_EQ(names.size(), 8u);
  for (const CauseTraits& each : all_causes()) {
    names.insert(each.name);
    EXPECT_EQ(traits_of(each.cause).name, each.name);
  }
  EXPECT_EQ(names.size(), 16u);
}

#ifdef LAUNCHSAFE_HAVE_RAPIDCHECK

/// How much a verdict allows.
int rank_of(const Judged& judged) {
  const Verdict verdict = judged.judgement().verdict;
  return verdict == Verdict::unsafe ? 0 : verdict == Verdict::indeterminate ? 1 : 2;
}

double length() { return *rc::gen::inRange(0, 1001) * 1e-6; }
bool one_in(int count) { return *rc::gen::inRange(0, count) == 0; }

CauseShare any_share() {
  const CauseTraits cause = *rc::gen::elementOf(all_causes());
  return {cause.cause, 0.3 * length(), 0.3 * length()};
}

Remark any_remark() { return {"name", "text", !one_in(3), one_in(2) ? "a reason in words" : ""}; }

void set_bounds(Judged& judged) {
  judged.of_case.bounds = bounds_of(judged.of_case.critical, judged.of_case.causes);
}

Judged any_judged() {
  Judged judged;
  CaseRow& of_case = judged.of_case;
  of_case.critical.kind =
      *rc::gen::element(CriticalGapKind::value, CriticalGapKind::value, CriticalGapKind::all_safe,
                        CriticalGapKind::all_ignite, CriticalGapKind::several_crossings);
  of_case.critical.value = of_case.critical.kind == CriticalGapKind::all_ignite ? 0.0 : length();
  for (int count = *rc::gen::inRange(0, 4); count > 0; --count) of_case.causes.push_back(any_share());
  set_bounds(judged);
  if (one_in(8)) of_case.failure = "the run failed";
  if (one_in(4)) of_case.warnings.push_back(any_remark());
  if (one_in(4)) of_case.extrapolated.push_back(any_remark());
  judged.gap.gap = length();
  if (one_in(4)) judged.gap.ignition.emplace();
  return judged;
}

RC_GTEST_PROP(VerdictProperty, NeverRisesWithAShare, ()) {
  const Judged judged = any_judged();
  Judged more = judged;
  more.of_case.causes.push_back(any_share());
  set_bounds(more);
  RC_ASSERT(rank_of(more) <= rank_of(judged));
  Judged larger = more;
  larger.of_case.causes.back().shorter += length();
  set_bounds(larger);
  RC_ASSERT(rank_of(larger) <= rank_of(more));
  larger.of_case.causes.back().shorter = not_a_number;
  set_bounds(larger);
  RC_ASSERT(rank_of(larger) <= 1);
}

RC_GTEST_PROP(VerdictProperty, NeverRisesWithTheGap, ()) {
  const Judged thin = any_judged();
  Judged thick = thin;
  thick.gap.gap += length();
  RC_ASSERT(rank_of(thick) <= rank_of(thin));
  thick.gap.ignition.emplace();
  RC_ASSERT(rank_of(thick) <= rank_of(thin));
}

/// A warning may take UNSAFE back, and nothing makes it SAFE.
RC_GTEST_PROP(VerdictProperty, NeverRisesTowardsSafeWithARemark, ()) {
  const Judged judged = any_judged();
  Judged warned = judged, beyond_range = judged;
  warned.of_case.warnings.push_back(any_remark());
  beyond_range.of_case.extrapolated.push_back(any_remark());
  RC_ASSERT(rank_of(warned) <= std::max(1, rank_of(judged)));
  RC_ASSERT(rank_of(beyond_range) <= rank_of(judged));
  for (auto* remarks : {&warned.of_case.warnings, &warned.of_case.extrapolated})
    for (Remark& each : *remarks) each.because.clear();
  RC_ASSERT(rank_of(warned) <= 1);
}

RC_GTEST_PROP(VerdictProperty, IsSafeOnlyBelowTheBoundOfASoundCaseWithNothingOpen, ()) {
  const Judged judged = any_judged();
  const CaseRow& of_case = judged.of_case;
  const bool nothing_open = std::ranges::none_of(of_case.warnings, &Remark::is_open) &&
                            std::ranges::none_of(of_case.extrapolated, &Remark::is_open);
  const bool expected = of_case.completed() && nothing_open && !judged.gap.ignition &&
                        of_case.critical.kind != CriticalGapKind::several_crossings &&
                        judged.gap.gap < of_case.bounds.at_least;
  RC_ASSERT((judged.judgement().verdict == Verdict::safe) == expected);
}

#endif

}  // namespace
