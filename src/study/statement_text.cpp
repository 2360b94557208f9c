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

/// Of a rule its name in files, and its words, which cause_text fills.
struct RuleWords {
  const char *name, *text;
};
/// In the order of ReasonCode.
constexpr std::array<RuleWords, 23> rules{{
    {"not-judged", "nothing was judged"},
    {"failed", "{failure}"},
    {"no-temperature", "the temperature is not a number"},
    {"validity-warning", "validity warning: {warnings}{and_unaccepted}"},
    {"ignition", "ignition{with_unaccepted}"},
    {"closing-ignition", "ignition where the gap closes"},
    {"unaccepted", "validity warning: {unaccepted}"},
    {"no-margin", "no margin to the ignition temperature"},
    {"optimistic", "{optimistic}"},
    {"beyond-firings",
     "no round with a gap as thick was fired without ignition at such a pressure and temperature"},
    {"critical-gap-indeterminate", "the critical gap is indeterminate: {critical_gap}"},
    {"several-crossings", "ignition comes and goes with the gap: {critical_gap}"},
    {"smaller-gaps-ignite", "no ignition here, but at smaller gaps"},
    {"margin-within-uncertainty", "margin {margin} within the uncertainty, {uncertainty}"},
    {"calibrated-margin-within-uncertainty",
     "with the constants of the surface as calibrated the margin is within the uncertainty"},
    {"margin-over-uncertainty", "margin {margin} over uncertainty {uncertainty}"},
    {"no-lower-bound", "the critical gap has no lower bound"},
    {"may-ignite-without-gap", "the launch may ignite without a gap"},
    {"not-below-bound", "the critical gap may be as small as {at_least:.3g} cm"},
    {"closing-unknown", "what this gap does where it closes is not known"},
    {"closing-without-corner",
     "the worst terms on which the gap may close (insulated base, smoothest faces, worst release) were not "
     "computed, as in no study of many cases"},
    {"closing-corner",
     "where the gap closes on the worst terms (insulated base, smoothest faces, worst release) {corner}"},
    {"below-bound", "below the lower bound of the critical gap, {at_least:.3g} cm"},
}};
const RuleWords& words_of(ReasonCode code) { return rules.at(static_cast<std::size_t>(code)); }

}  // namespace

std::string to_string(ReasonCode code) { return words_of(code).name; }

std::string cause_text(const Evidence& evidence, const Judgement& judgement) {
  const char* text = words_of(judgement.code).text;
  if (evidence.of_case == nullptr) return text;
  const CaseEvidence& of_case = *evidence.of_case;
  const std::string unaccepted = unaccepted_text(of_case.input);
  const std::string& optimistic = of_case.input.optimistic;
  const std::string corner = std::isfinite(evidence.closing.corner_margin)
                                 ? fmt::format("the margin is {:.1f} K, and the uncertainty {:.2g} K",
                                               evidence.closing.corner_margin, evidence.closing_uncertainty())
                                 : "it ignites";
  return fmt::format(
      fmt::runtime(text), fmt::arg("failure", of_case.failure.empty() ? "the run failed" : of_case.failure),
      fmt::arg("warnings", validity_warnings_text(evidence)), fmt::arg("unaccepted", unaccepted),
      fmt::arg("and_unaccepted", unaccepted.empty() ? "" : "; " + unaccepted),
      fmt::arg("with_unaccepted", unaccepted.empty() ? "" : "; validity warning: " + unaccepted),
      fmt::arg("optimistic", optimistic.empty() ? optimistic_by_run(of_case.friction_rise) : optimistic),
      fmt::arg("critical_gap", judgement.critical_gap), fmt::arg("margin", kelvin(evidence.margin, 3)),
      fmt::arg("uncertainty", kelvin(evidence.uncertainty, 2)),
      fmt::arg("at_least", 100.0 * judgement.at_least), fmt::arg("corner", corner));
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

std::string why_no_critical_gap(const CaseEvidence& of_case) {
  if (!of_case.completed) return of_case.failure;
  const std::string warnings = of_case.validity_warnings.empty()
                                   ? unaccepted_text(of_case.input)
                                   : fmt::format("{}", fmt::join(of_case.validity_warnings, "; "));
  return warnings.empty() ? warnings : "validity warning: " + warnings;
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
