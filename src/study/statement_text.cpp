#include "launchsafe/study/verdict.hpp"

namespace launchsafe::study {
namespace {

/// A margin or an uncertainty (K) to the digits that count, never as a power of ten; why it is no number.
std::string kelvin(double value, int digits) {
  if (std::isnan(value)) return "not known";
  if (std::isinf(value)) return "infinite because the launch ignites at an end of its ranges";
  return std::abs(value) < std::pow(10.0, digits) ? fmt::format("{:.{}g} K", value, digits)
                                                  : fmt::format("{:.0f} K", value);
}

/// Of a rule its name in files, and its words, which cause_text fills.
struct RuleWords {
  const char *name, *text;
};
/// In the order of ReasonCode.
constexpr std::array<RuleWords, 18> rules{{
    {"not-judged", "nothing was judged"},
    {"failed", "{failure}"},
    {"no-temperature", "the temperature is not a number"},
    {"validity-warning", "validity warning: {warnings}{and_unaccepted}"},
    {"ignition", "ignition{with_unaccepted}"},
    {"unaccepted", "validity warning: {unaccepted}"},
    {"no-margin", "no margin to the ignition temperature"},
    {"optimistic", "{optimistic}"},
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
    {"below-bound", "below the lower bound of the critical gap, {at_least:.3g} cm"},
}};
/// In the order of GapReasonCode.
constexpr std::array<const char*, 10> gap_reasons{
    "",
    "the temperature at a gap of {gap} is not a number",
    "no ignition up to {gap}, where the search ended",
    "not monotone: no ignition at {gap} again",
    "ignition at every gap, also without one",
    "{because}",
    "validity warning: {because}",
    "the coupled run at {gap} did not complete: {because} {traced}",
    "the coupled run at {gap} ignites, the traced temperatures do not {traced}",
    "the coupled run at {gap} does not ignite, the traced temperatures do {traced}"};

const RuleWords& words_of(ReasonCode code) { return rules.at(static_cast<std::size_t>(code)); }

}  // namespace

std::string to_string(ReasonCode code) { return words_of(code).name; }

std::string cause_text(const GapVerdict& row) {
  const char* text = words_of(row.judgement.code).text;
  if (row.of_case == nullptr) return text;
  const CaseEvidence& of_case = *row.of_case;
  const std::string unaccepted = unaccepted_text(of_case.input);
  const std::string& optimistic = of_case.input.optimistic;
  return fmt::format(
      fmt::runtime(text), fmt::arg("failure", of_case.failure),
      fmt::arg("warnings", validity_warnings_text(row)), fmt::arg("unaccepted", unaccepted),
      fmt::arg("and_unaccepted", unaccepted.empty() ? "" : "; " + unaccepted),
      fmt::arg("with_unaccepted", unaccepted.empty() ? "" : "; validity warning: " + unaccepted),
      fmt::arg("optimistic", optimistic.empty() ? optimistic_by_run(of_case.friction_rise) : optimistic),
      fmt::arg("critical_gap", text_of(row.judgement.critical_gap)),
      fmt::arg("margin", kelvin(row.margin, 3)), fmt::arg("uncertainty", kelvin(row.uncertainty.total(), 2)),
      fmt::arg("at_least", 100.0 * row.judgement.at_least));
}

std::string validity_warnings_text(const GapVerdict& row) {
  if (row.of_case == nullptr) return {};
  return fmt::format("{}", fmt::join(row.of_case->validity_warnings, "; "));
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

std::string limiters_text(const GapVerdict& row) {
  return row.of_case == nullptr ? std::string{} : run::to_string(row.of_case->limited);
}

std::string failed_models(const std::vector<ModelGap>& models) {
  std::vector<std::string> failed;
  for (const ModelGap& each : models)
    if (!each.failure.empty())
      failed.push_back(fmt::format("the launch under constants {} failed: {}", each.name, each.failure));
  return fmt::format("{}", fmt::join(failed, "; "));
}

std::string failed_models_text(const GapVerdict& row) {
  return row.of_case == nullptr ? std::string{} : row.of_case->failed_models;
}

std::string extrapolated_text(const GapVerdict& row) {
  if (row.of_case == nullptr) return {};
  const CaseStatements& input = row.of_case->input;
  std::vector<std::string> beyond = input.extrapolated;
  if (input.is_beyond(row.gap)) beyond.emplace_back("gap");
  return beyond.empty() ? std::string{} : fmt::format("extrapolated: {}", fmt::join(beyond, ", "));
}

std::string text_of(const GapReason& reason) {
  const auto traced =
      fmt::format("(traced bracket {:.6g} to {})", 100.0 * reason.lower, in_centimetres(reason.upper));
  return fmt::format(fmt::runtime(gap_reasons.at(static_cast<std::size_t>(reason.code))),
                     fmt::arg("gap", in_centimetres(reason.gap)), fmt::arg("because", reason.because),
                     fmt::arg("traced", traced));
}

GapReason why_no_critical_gap(const CaseEvidence& of_case) {
  if (!of_case.completed()) return {.code = GapReasonCode::failed, .because = of_case.failure};
  std::string warnings = of_case.validity_warnings.empty()
                             ? unaccepted_text(of_case.input)
                             : fmt::format("{}", fmt::join(of_case.validity_warnings, "; "));
  if (warnings.empty()) return {};
  return {.code = GapReasonCode::validity_warning, .because = std::move(warnings)};
}

std::string reason_text(const GapVerdict& row) {
  std::string text = cause_text(row);
  // Of these nothing but the fault of the run is said.
  using enum ReasonCode;
  for (const ReasonCode alone : {not_judged, failed, no_temperature, validity_warning})
    if (row.judgement.code == alone) return text;
  const auto add = [&text](const std::string& clause) {
    if (!clause.empty()) text += "; " + clause;
  };
  const CaseEvidence& of_case = *row.of_case;
  const std::string limiters = limiters_text(row);
  add(limiters.empty() ? limiters : "limiters acted: " + limiters);
  add(failed_models_text(row));
  add(extrapolated_text(row));
  // The user's words come last: what the program says stands before them, whatever they are.
  add(accepted_text(of_case.input));
  return text;
}

}  // namespace launchsafe::study
