#include "launchsafe/study/verdict.hpp"

#include "launchsafe/study/cases.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace launchsafe::study {

std::string to_string(Verdict verdict) {
  constexpr std::array words{"SAFE", "UNSAFE", "INDETERMINATE"};
  return words.at(static_cast<std::size_t>(verdict));
}

std::string to_string(ReasonCode code) {
  constexpr std::array words{"not-judged",
                             "failed",
                             "no-temperature",
                             "validity-warning",
                             "ignition",
                             "closing-ignition",
                             "unaccepted",
                             "no-margin",
                             "optimistic",
                             "beyond-firings",
                             "critical-gap-indeterminate",
                             "several-crossings",
                             "smaller-gaps-ignite",
                             "margin-within-uncertainty",
                             "calibrated-margin-within-uncertainty",
                             "margin-over-uncertainty",
                             "no-lower-bound",
                             "may-ignite-without-gap",
                             "not-below-bound",
                             "closing-unknown",
                             "closing-without-corner",
                             "closing-corner",
                             "below-bound"};
  return words.at(static_cast<std::size_t>(code));
}

namespace {

Judgement indeterminate(ReasonCode code, const CriticalGap& critical, GapReason why = {}) {
  return {Verdict::indeterminate, code, critical.bounds.at_least, std::move(why)};
}

/// Where nothing ignites up to the end of the search, which a gap may lie at.
Judgement judge_margin(const Evidence& evidence, const CriticalGap& critical) {
  // Written so that NaN is never safe.
  if (!(evidence.margin > evidence.uncertainty))
    return indeterminate(ReasonCode::margin_within_uncertainty, critical);
  if (!(evidence.calibrated_margin > evidence.uncertainty))
    return indeterminate(ReasonCode::calibrated_margin_within_uncertainty, critical);
  if (!(evidence.gap <= critical.bounds.at_least))
    return indeterminate(ReasonCode::not_below_bound, critical);
  return {Verdict::safe, ReasonCode::margin_over_uncertainty, critical.bounds.at_least};
}

Judgement judge_in_gap(const Evidence& evidence, const CriticalGap& critical) {
  const double at_least = critical.bounds.at_least;
  switch (critical.kind) {
    case CriticalGapKind::indeterminate:
      return indeterminate(ReasonCode::critical_gap_indeterminate, critical, critical.reason);
    case CriticalGapKind::several_crossings:
      return indeterminate(ReasonCode::several_crossings, critical, critical.reason);
    case CriticalGapKind::all_ignite:
      return indeterminate(ReasonCode::smaller_gaps_ignite, critical);
    case CriticalGapKind::all_safe:
      return judge_margin(evidence, critical);
    case CriticalGapKind::value:
      break;
  }
  if (std::isnan(at_least)) return indeterminate(ReasonCode::no_lower_bound, critical);
  if (!(evidence.gap < at_least))
    return indeterminate(at_least > 0.0 ? ReasonCode::not_below_bound : ReasonCode::may_ignite_without_gap,
                         critical);
  return {Verdict::safe, ReasonCode::below_bound, at_least};
}

/// A gap that is SAFE by the reservoir, where it closes. Nobody has measured how wrong a closing gap is, so
/// that no less than what is assumed without a record has to be left.
Judgement judge_closing(const Evidence& evidence, const CriticalGap& critical, Judgement by_reservoir) {
  if (by_reservoir.verdict != Verdict::safe) return by_reservoir;
  if (!evidence.closing.known) return indeterminate(ReasonCode::closing_unknown, critical);
  if (std::isnan(evidence.closing.corner_margin))
    return indeterminate(ReasonCode::closing_without_corner, critical);
  // Written so that NaN is never safe.
  if (!(evidence.closing.corner_margin > std::max(evidence.uncertainty, assumed_numerical_uncertainty)))
    return indeterminate(ReasonCode::closing_corner, critical);
  return by_reservoir;
}

}  // namespace

Judgement judge(const Evidence& evidence, const CriticalGap& critical) {
  if (evidence.of_case == nullptr) return {};
  const CaseEvidence& of_case = *evidence.of_case;
  if (!of_case.completed) return indeterminate(ReasonCode::failed, critical);
  if (!std::isfinite(evidence.maximum_temperature))
    return indeterminate(ReasonCode::no_temperature, critical);
  if (!of_case.validity_warnings.empty() || std::isfinite(evidence.when_over))
    return indeterminate(ReasonCode::validity_warning, critical);
  if (evidence.ignited) return {Verdict::unsafe, ReasonCode::ignition};
  if (of_case.input.closes && evidence.closing.ignited)
    return {Verdict::unsafe, ReasonCode::closing_ignition};
  if (of_case.input.has_unaccepted()) return indeterminate(ReasonCode::unaccepted, critical);
  // Written so that NaN is never safe.
  if (!(evidence.margin > 0.0)) return indeterminate(ReasonCode::no_margin, critical);
  if (of_case.input.optimistic || optimistic_by_run(of_case.friction_rise))
    return indeterminate(ReasonCode::optimistic, critical);
  if (of_case.input.calibrated_by_firings && of_case.input.is_beyond(evidence.gap))
    return indeterminate(ReasonCode::beyond_firings, critical);
  const Judgement by_reservoir = judge_in_gap(evidence, critical);
  return of_case.input.closes ? judge_closing(evidence, critical, by_reservoir) : by_reservoir;
}

}  // namespace launchsafe::study
