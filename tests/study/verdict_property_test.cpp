// The verdict's order: more margin never makes a gap less safe, more uncertainty or a validity warning never
// safer.
#include "launchsafe/study/verdict.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <utility>
#include <vector>

#ifdef LAUNCHSAFE_HAVE_RAPIDCHECK
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

namespace {

using namespace launchsafe::study;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// How much a verdict allows.
int rank_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::unsafe:
      return 0;
    case Verdict::indeterminate:
      return 1;
    case Verdict::safe:
      return 2;
  }
  return -1;
}

int rank_of(const GapVerdict& evidence, const CriticalGap& critical) {
  return rank_of(judge(evidence, critical).verdict);
}

/// Any sign, from thousandths to hundreds of K; 0 among them.
double kelvin() { return *rc::gen::inRange(-300000, 300001) / 1000.0; }
double positive_kelvin() { return *rc::gen::inRange(0, 100001) / 1000.0; }
double gap() { return *rc::gen::inRange(0, 1001) * 1e-6; }

using Change = void (*)(CaseEvidence& of_case);

/// The same evidence on other terms of its case.
GapVerdict with(GapVerdict evidence, Change change) {
  CaseEvidence of_case = *evidence.of_case;
  change(of_case);
  evidence.of_case = std::make_shared<const CaseEvidence>(std::move(of_case));
  return evidence;
}

GapVerdict any_evidence() {
  CaseEvidence of_case;
  of_case.failure = *rc::gen::inRange(0, 8) > 0 ? "" : "the run failed";
  of_case.validity_warnings.resize(*rc::gen::inRange(0, 4) == 0 ? 1 : 0, "the air was not resolved");
  of_case.limited.crack_at_bound = *rc::gen::element(0, 12);
  GapVerdict evidence;
  evidence.of_case = std::make_shared<const CaseEvidence>(std::move(of_case));
  if (*rc::gen::inRange(0, 4) == 0) evidence.ignition.emplace();
  evidence.gap = gap();
  evidence.margin = kelvin();
  evidence.maximum.temperature = 525.0 - evidence.margin;
  evidence.uncertainty.input = positive_kelvin();
  return evidence;
}

GapShare any_share() {
  GapShare share;
  share.kind = static_cast<ShareKind>(*rc::gen::inRange(0, static_cast<int>(share_kinds)));
  share.raised = *rc::gen::inRange(0, 6) == 0 ? no_ignition : gap();
  share.lowered = *rc::gen::inRange(0, 6) == 0 ? no_ignition : gap();
  return share;
}

CriticalGap any_critical_gap() {
  CriticalGap critical;
  critical.kind = *rc::gen::element(CriticalGapKind::value, CriticalGapKind::value, CriticalGapKind::all_safe,
                                    CriticalGapKind::all_ignite, CriticalGapKind::indeterminate);
  critical.lower = critical.value = critical.upper = gap();
  std::vector<GapShare> shares;
  for (int count = *rc::gen::inRange(0, 5); count > 0; --count) shares.push_back(any_share());
  set_shares(critical, std::move(shares));
  return critical;
}

RC_GTEST_PROP(VerdictProperty, RisesWithTheMargin, ()) {
  const CriticalGap critical = any_critical_gap();
  const GapVerdict less = any_evidence();
  GapVerdict more = less;
  more.margin += positive_kelvin();
  more.maximum.temperature = 525.0 - more.margin;
  RC_ASSERT(rank_of(more, critical) >= rank_of(less, critical));
}

RC_GTEST_PROP(VerdictProperty, NeverRisesWithTheGap, ()) {
  const CriticalGap critical = any_critical_gap();
  const GapVerdict thin = any_evidence();
  GapVerdict thick = thin;
  thick.gap += gap();
  RC_ASSERT(rank_of(thick, critical) <= rank_of(thin, critical));
}

/// More uncertainty, a wider range, less evidence: one share more, one that reaches further, one not known.
RC_GTEST_PROP(VerdictProperty, NeverRisesWithAnUncertainty, ()) {
  const CriticalGap critical = any_critical_gap();
  const GapVerdict evidence = any_evidence();
  GapVerdict vaguer = evidence;
  vaguer.uncertainty.input += positive_kelvin();
  RC_ASSERT(rank_of(vaguer, critical) <= rank_of(evidence, critical));
  CriticalGap more = critical;
  std::vector<GapShare> shares = critical.shares;
  shares.push_back(any_share());
  set_shares(more, shares);
  RC_ASSERT(rank_of(evidence, more) <= rank_of(evidence, critical));
  CriticalGap wider = more, unknown = more;
  shares.back().raised *= 0.5;
  set_shares(wider, shares);
  RC_ASSERT(rank_of(evidence, wider) <= rank_of(evidence, more));
  shares.back().raised = not_a_number;
  set_shares(unknown, shares);
  RC_ASSERT(rank_of(evidence, unknown) <= rank_of(evidence, more));
}

/// The verdict and the interval of the critical gap are one.
RC_GTEST_PROP(VerdictProperty, SafeIsBelowTheBoundAndBelowTheBoundNothingIsIndeterminateForItsMargin, ()) {
  CriticalGap critical = any_critical_gap();
  critical.kind = CriticalGapKind::value;
  set_shares(critical, critical.shares);
  GapVerdict evidence = any_evidence();
  const Judgement judged = judge(evidence, critical);
  if (judged.verdict == Verdict::safe) RC_ASSERT(evidence.gap < critical.bounds.at_least);
  evidence = with(evidence, [](CaseEvidence& of_case) { of_case = {.failure = {}}; });
  evidence.ignition.reset();
  evidence.margin = 1e-3 + positive_kelvin();
  evidence.maximum.temperature = 525.0 - evidence.margin;
  if (evidence.gap < critical.bounds.at_least) RC_ASSERT(judge(evidence, critical).verdict == Verdict::safe);
}

RC_GTEST_PROP(VerdictProperty, IsNeverSafeOnAFailureAValidityWarningAnIgnitionOrANumberThatIsNone, ()) {
  const CriticalGap critical = any_critical_gap();
  const GapVerdict sound = any_evidence();
  const GapVerdict failed = with(sound, [](CaseEvidence& of_case) { of_case.failure = "the run failed"; });
  const GapVerdict warned =
      with(sound, [](CaseEvidence& of_case) { of_case.validity_warnings = {"the grid did not fit"}; });
  GapVerdict ignited = sound;
  ignited.ignition.emplace();
  RC_ASSERT(judge(failed, critical).verdict == Verdict::indeterminate);
  RC_ASSERT(judge(warned, critical).verdict == Verdict::indeterminate);
  RC_ASSERT(judge(ignited, critical).verdict != Verdict::safe);
  GapVerdict without_margin = sound, without_temperature = sound;
  without_margin.margin = without_temperature.maximum.temperature = not_a_number;
  RC_ASSERT(judge(without_margin, critical).verdict != Verdict::safe);
  RC_ASSERT(judge(without_temperature, critical).verdict != Verdict::safe);
  CriticalGap undefined = critical;
  undefined.bounds.at_least = not_a_number;
  RC_ASSERT(judge(sound, undefined).verdict != Verdict::safe);
}

RC_GTEST_PROP(VerdictProperty, AlwaysHasAReasonAndNamesTheLimitersOfASoundRun, ()) {
  GapVerdict evidence = any_evidence();
  evidence.judgement = judge(evidence, any_critical_gap());
  const std::string reason = reason_text(evidence);
  const CaseEvidence& of_case = *evidence.of_case;
  RC_ASSERT(!reason.empty());
  if (of_case.completed() && of_case.validity_warnings.empty() && of_case.limited.crack_at_bound > 0)
    RC_ASSERT(reason.find("crack bound 12") != std::string::npos);
}

}  // namespace

#endif
