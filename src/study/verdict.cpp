#include "launchsafe/study/verdict.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace launchsafe::study {

std::string to_string(Verdict verdict) {
  constexpr std::array words{"SAFE", "UNSAFE", "INDETERMINATE"};
  return words.at(static_cast<std::size_t>(verdict));
}

std::string to_string(ReasonCode code) {
  constexpr std::array words{"failed",
                             "no temperature",
                             "validity warning",
                             "ignition",
                             "not accepted",
                             "no margin",
                             "optimistic",
                             "critical gap indeterminate",
                             "several crossings",
                             "ignites at smaller gaps",
                             "no lower bound",
                             "above lower bound",
                             "below lower bound",
                             "within uncertainty",
                             "within uncertainty as calibrated",
                             "over uncertainty"};
  return words.at(static_cast<std::size_t>(code));
}

namespace {

Judgement judged(Verdict verdict, ReasonCode code, const std::string& cause) {
  return {verdict, cause, code, cause};
}
Judgement indeterminate(ReasonCode code, const std::string& cause) {
  return judged(Verdict::indeterminate, code, cause);
}

/// A difference of temperatures (K) to the digits that count, never as a power of ten.
std::string kelvin(double value, int digits) {
  return std::abs(value) < std::pow(10.0, digits) ? fmt::format("{:.{}g} K", value, digits)
                                                  : fmt::format("{:.0f} K", value);
}

std::string margin_text(const char* relation, const Evidence& evidence) {
  return fmt::format("margin {} {} {}", kelvin(evidence.margin, 3), relation,
                     kelvin(evidence.uncertainty, 2));
}

/// A bound of the critical gap (m), to the digits that count.
std::string bound_text(double length) { return fmt::format("{:.3g} cm", 100.0 * length); }

/// Where nothing ignites up to the end of the search, which a gap may lie at.
Judgement judge_margin(const Evidence& evidence, const CriticalGap& critical) {
  // Written so that NaN is never safe.
  if (!(evidence.margin > evidence.uncertainty))
    return indeterminate(ReasonCode::within_uncertainty, margin_text("within the uncertainty,", evidence));
  if (!(evidence.calibrated_margin > evidence.uncertainty))
    return indeterminate(
        ReasonCode::within_uncertainty_as_calibrated,
        "with the constants of the surface as calibrated the margin is within the uncertainty");
  if (!(evidence.gap <= critical.bounds.at_least))
    return indeterminate(ReasonCode::above_lower_bound,
                         "the critical gap may be as small as " + bound_text(critical.bounds.at_least));
  return judged(Verdict::safe, ReasonCode::over_uncertainty, margin_text("over uncertainty", evidence));
}

Judgement judge_in_gap(const Evidence& evidence, const CriticalGap& critical) {
  const double at_least = critical.bounds.at_least;
  switch (critical.kind) {
    case CriticalGapKind::indeterminate:
      return indeterminate(ReasonCode::critical_gap_indeterminate,
                           "the critical gap is indeterminate: " + critical.reason);
    case CriticalGapKind::several_crossings:
      return indeterminate(ReasonCode::several_crossings,
                           "ignition comes and goes with the gap: " + critical.reason);
    case CriticalGapKind::all_ignite:
      return indeterminate(ReasonCode::ignites_at_smaller_gaps, "no ignition here, but at smaller gaps");
    case CriticalGapKind::all_safe:
      return judge_margin(evidence, critical);
    case CriticalGapKind::value:
      break;
  }
  if (std::isnan(at_least))
    return indeterminate(ReasonCode::no_lower_bound, "the critical gap has no lower bound");
  if (!(evidence.gap < at_least))
    return indeterminate(ReasonCode::above_lower_bound,
                         at_least > 0.0 ? "the critical gap may be as small as " + bound_text(at_least)
                                        : std::string("the launch may ignite without a gap"));
  return judged(Verdict::safe, ReasonCode::below_lower_bound,
                fmt::format("below {}, the least that the critical gap can be", bound_text(at_least)));
}

Judgement judge_sound(const Evidence& evidence, const CriticalGap& critical) {
  const std::string& unaccepted = evidence.unaccepted;
  if (evidence.ignited)
    return judged(Verdict::unsafe, ReasonCode::ignition,
                  unaccepted.empty() ? "ignition" : "ignition; validity warning: " + unaccepted);
  if (!unaccepted.empty()) return indeterminate(ReasonCode::not_accepted, "validity warning: " + unaccepted);
  // Written so that NaN is never safe.
  if (!(evidence.margin > 0.0))
    return indeterminate(ReasonCode::no_margin, "no margin to the ignition temperature");
  if (!evidence.optimistic.empty()) return indeterminate(ReasonCode::optimistic, evidence.optimistic);
  return judge_in_gap(evidence, critical);
}

}  // namespace

Judgement judge(const Evidence& evidence, const CriticalGap& critical) {
  if (!evidence.completed)
    return indeterminate(ReasonCode::failed, evidence.failure.empty() ? "the run failed" : evidence.failure);
  if (!std::isfinite(evidence.maximum_temperature))
    return indeterminate(ReasonCode::no_temperature, "the temperature is not a number");
  if (!evidence.validity_warnings.empty())
    return indeterminate(ReasonCode::validity_warning,
                         "validity warning: " + evidence.validity_warnings +
                             (evidence.unaccepted.empty() ? "" : "; " + evidence.unaccepted));
  Judgement judgement = judge_sound(evidence, critical);
  if (!evidence.limited.empty()) judgement.reason += "; limiters acted: " + evidence.limited;
  if (!evidence.noise.empty()) judgement.reason += "; " + evidence.noise;
  if (!evidence.ring.empty()) judgement.reason += "; " + evidence.ring;
  if (!evidence.model_form.empty()) judgement.reason += "; " + evidence.model_form;
  if (!evidence.extrapolated.empty()) judgement.reason += "; " + evidence.extrapolated;
  // The user's words come last: what the program says stands before them, whatever they are.
  if (!evidence.accepted.empty()) judgement.reason += "; " + evidence.accepted;
  return judgement;
}

}  // namespace launchsafe::study
