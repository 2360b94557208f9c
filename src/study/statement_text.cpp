#include "launchsafe/scene/plausibility.hpp"
#include "launchsafe/study/verdict.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace launchsafe::study {
namespace {

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

/// Of a rule its name in files, and its words where they are always the same.
struct RuleWords {
  const char *name, *text = "";
};
/// In the order of ReasonCode.
constexpr std::array<RuleWords, 23> rules{{
    {"not-judged", "nothing was judged"},
    {"failed"},
    {"no-temperature", "the temperature is not a number"},
    {"validity-warning"},
    {"ignition"},
    {"closing-ignition", "ignition where the gap closes"},
    {"unaccepted"},
    {"no-margin", "no margin to the ignition temperature"},
    {"optimistic"},
    {"beyond-firings",
     "no round with a gap as thick was fired without ignition at such a pressure and temperature"},
    {"critical-gap-indeterminate"},
    {"several-crossings"},
    {"smaller-gaps-ignite", "no ignition here, but at smaller gaps"},
    {"margin-within-uncertainty"},
    {"calibrated-margin-within-uncertainty",
     "with the constants of the surface as calibrated the margin is within the uncertainty"},
    {"margin-over-uncertainty"},
    {"no-lower-bound", "the critical gap has no lower bound"},
    {"may-ignite-without-gap", "the launch may ignite without a gap"},
    {"not-below-bound"},
    {"closing-unknown", "what this gap does where it closes is not known"},
    {"closing-without-corner",
     "the worst terms on which the gap may close (insulated base, smoothest faces, worst release) were not "
     "computed, as in no study of many cases"},
    {"closing-corner"},
    {"below-bound"},
}};
const RuleWords& words_of(ReasonCode code) { return rules.at(static_cast<std::size_t>(code)); }

}  // namespace

std::string to_string(ReasonCode code) { return words_of(code).name; }

std::string cause_text(const Evidence& evidence, const Judgement& judgement) {
  switch (judgement.code) {
    case ReasonCode::failed:
      return evidence.of_case->failure.empty() ? "the run failed" : evidence.of_case->failure;
    case ReasonCode::validity_warning: {
      const std::string unaccepted = unaccepted_text(evidence.of_case->input);
      return fmt::format("validity warning: {}{}{}", validity_warnings_text(evidence),
                         unaccepted.empty() ? "" : "; ", unaccepted);
    }
    case ReasonCode::ignition: {
      const std::string unaccepted = unaccepted_text(evidence.of_case->input);
      return unaccepted.empty() ? "ignition" : "ignition; validity warning: " + unaccepted;
    }
    case ReasonCode::unaccepted:
      return "validity warning: " + unaccepted_text(evidence.of_case->input);
    case ReasonCode::optimistic:
      return to_string(evidence.of_case->input.optimistic
                           ? evidence.of_case->input.optimistic
                           : optimistic_by_run(evidence.of_case->friction_rise));
    case ReasonCode::critical_gap_indeterminate:
      return "the critical gap is indeterminate: " + to_string(judgement.critical_gap);
    case ReasonCode::several_crossings:
      return "ignition comes and goes with the gap: " + to_string(judgement.critical_gap);
    case ReasonCode::margin_within_uncertainty:
      return margin_text("within the uncertainty,", evidence);
    case ReasonCode::margin_over_uncertainty:
      return margin_text("over uncertainty", evidence);
    case ReasonCode::not_below_bound:
      return "the critical gap may be as small as " + bound_text(judgement.at_least);
    case ReasonCode::closing_corner:
      return "where the gap closes on the worst terms (insulated base, smoothest faces, worst release) " +
             (std::isfinite(evidence.closing.corner_margin)
                  ? fmt::format("the margin is {:.1f} K, and the uncertainty {:.2g} K",
                                evidence.closing.corner_margin, evidence.closing_uncertainty())
                  : std::string("it ignites"));
    case ReasonCode::below_bound:
      return "below the lower bound of the critical gap, " + bound_text(judgement.at_least);
    default:
      return words_of(judgement.code).text;
  }
}

std::string validity_warnings_text(const Evidence& evidence) {
  if (evidence.of_case == nullptr) return {};
  std::string text = fmt::format("{}", fmt::join(evidence.of_case->validity_warnings, "; "));
  if (std::isfinite(evidence.when_over))
    text += fmt::format("; when it is over T max is {:.1f} K, and the ignition temperature is {:.1f} K",
                        evidence.when_over, evidence.maximum_temperature + evidence.margin);
  return text;
}

std::string unaccepted_text(const CaseStatements& input) {
  std::vector<std::string> warnings, foreign;
  for (const scene::Implausible& each : input.implausible)
    if (!each.accepted()) warnings.push_back(scene::validity_warning(each));
  for (const scene::Implausible& each : input.distance.foreign)
    if (!each.accepted()) foreign.push_back(scene::value_text(each));
  if (!foreign.empty())
    warnings.push_back(fmt::format(
        "extrapolated: the constants were calibrated on another launch ({}), and nothing says how wrong they "
        "are here",
        fmt::join(foreign, ", ")));
  return fmt::format("{}", fmt::join(warnings, "; "));
}

std::string accepted_text(const CaseStatements& input) {
  return scene::accepted_text(input.to_be_accepted());
}

std::string to_string(const Optimistic& optimistic) {
  switch (optimistic.why) {
    case Optimistic::Why::nothing:
      return {};
    case Optimistic::Why::film:
      return "no ignition under gap.air = \"film\", which gives what compression supplies alone, shows "
             "nothing";
    case Optimistic::Why::cooling:
      return fmt::format(
          "no ignition with {} shows nothing: that only averages or removes heat, accepted or not",
          fmt::join(optimistic.cooling, ", "));
    case Optimistic::Why::short_travel:
      return fmt::format(
          "no ignition within {:.3g} calibres of travel shows nothing: no barrel is shorter than {:g}",
          optimistic.number, fewest_calibres);
    case Optimistic::Why::unheated:
      return fmt::format(
          "friction heats the charge's bottom by {:.2g} K over the launch, less than {:g} K: no ignition "
          "shows nothing",
          optimistic.number, least_friction_rise);
  }
  return {};
}

std::string limiters_text(const Evidence& evidence) {
  return evidence.of_case == nullptr ? std::string{} : run::to_string(evidence.of_case->limited);
}

std::string noise_text(const Evidence& evidence) {
  constexpr double least_told = 0.1;  // K
  if (!(evidence.noise >= least_told)) return {};
  return fmt::format("noise and smoothing of the measured curve count {:.2g} K", evidence.noise);
}

std::string models_text(const Evidence& evidence) {
  if (evidence.models.empty()) return {};
  return fmt::format("{}\"{}\"",
                     evidence.ignited ? "no ignition, or none known, under " : "ignition not excluded under ",
                     fmt::join(evidence.models, "\", \""));
}

std::string extrapolated_text(const Evidence& evidence) {
  if (evidence.of_case == nullptr) return {};
  const CaseStatements& input = evidence.of_case->input;
  std::vector<std::string> beyond = input.extrapolated;
  if (input.is_beyond(evidence.gap)) beyond.emplace_back("gap");
  return beyond.empty() ? std::string{} : fmt::format("extrapolated: {}", fmt::join(beyond, ", "));
}

std::string to_string(const GapReason& reason) {
  using Code = GapReason::Code;
  const std::string gap = fmt::format("{:.6g} cm", 100.0 * reason.gap);
  const auto unconfirmed = [&](const std::string& what) {
    return fmt::format("the coupled run at {} {} (traced bracket {:.6g} to {:.6g} cm)", gap, what,
                       100.0 * reason.lower, 100.0 * reason.upper);
  };
  const CaseEvidence* of_case = reason.of_case.get();
  switch (reason.code) {
    case Code::nothing:
      return {};
    case Code::none_ignites:
      return fmt::format("no ignition up to {}, where the search ended", gap);
    case Code::none_of_gaps:
      return fmt::format("none of {} gaps up to {} ignites", reason.gaps, gap);
    case Code::all_ignite:
      return "ignition at every gap, also without one";
    case Code::not_monotone:
      return fmt::format("not monotone: no ignition at {} again", gap);
    case Code::undefined:
      return fmt::format("the temperature at a gap of {} is not a number", gap);
    case Code::failed:
      return of_case == nullptr ? "the run failed" : of_case->failure;
    case Code::validity_warning:
      return fmt::format(
          "validity warning: {}",
          of_case == nullptr ? "" : fmt::format("{}", fmt::join(of_case->validity_warnings, "; ")));
    case Code::unaccepted:
      return "validity warning: " + (of_case == nullptr ? "" : unaccepted_text(of_case->input));
    case Code::coupled_run_failed:
      return unconfirmed("did not complete: " + reason.detail);
    case Code::coupled_run_ignites:
      return unconfirmed("ignites, the traced temperatures do not");
    case Code::coupled_run_does_not_ignite:
      return unconfirmed("does not ignite, the traced temperatures do");
    case Code::longer_launch_failed:
      return "the run of the longer launch: " + reason.detail;
  }
  return {};
}

std::string reason_text(const Evidence& evidence, const Judgement& judgement) {
  std::string text = cause_text(evidence, judgement);
  // Of these nothing but the fault of the run is said.
  using enum ReasonCode;
  for (const ReasonCode alone : {not_judged, failed, no_temperature, validity_warning})
    if (judgement.code == alone) return text;
  const auto add = [&text](const std::string& clause) {
    if (!clause.empty()) text += "; " + clause;
  };
  const CaseEvidence& of_case = *evidence.of_case;
  const std::string limiters = limiters_text(evidence);
  add(limiters.empty() ? limiters : "limiters acted: " + limiters);
  add(noise_text(evidence));
  add(of_case.input.ring);
  add(models_text(evidence));
  add(extrapolated_text(evidence));
  if (of_case.input.demonstration) add("a demonstration, with an invented shell or invented firings");
  // The user's words come last: what the program says stands before them, whatever they are.
  add(accepted_text(of_case.input));
  return text;
}

}  // namespace launchsafe::study
