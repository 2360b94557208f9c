#include "launchsafe/study/rows.hpp"

#include "launchsafe/math/statistics.hpp"

namespace launchsafe::study {
namespace {

/// Without ignition up to the end of the search a lower bound may lie in this part of it.
constexpr double known_part_of_search = 0.5;

/// All moves in one direction as one, m.
double combined(const std::vector<CauseShare>& causes, double CauseShare::*move) {
  double squares = 0.0, sum = 0.0;
  for (const CauseShare& each : causes)
    if (traits_of(each.cause).random)
      squares += each.*move * each.*move;
    else
      sum += each.*move;
  return std::sqrt(squares) + sum;
}

bool is_final(const Remark& warning) { return warning.is_open() && !warning.acceptable; }

Judgement indeterminate(ReasonCode code) { return {Verdict::indeterminate, code}; }

std::string joined_texts(const std::vector<Remark>& remarks) {
  std::vector<std::string> texts;
  for (const Remark& each : remarks)
    if (each.is_open()) texts.push_back(fmt::format("{}: {}", each.name, each.text));
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::string centimetres_of(double gap) { return fmt::format("{:.3g} cm", 100.0 * gap); }

/// In three digits, rounded to the safe side as tables have it.
std::string lower_bound_text(double bound) {
  const double unit = std::pow(10.0, std::floor(std::log10(bound)) - 2.0);
  return centimetres_of(std::floor(bound / unit + 1e-9) * unit);
}

/// The rule that gave a verdict, with its numbers.
std::string rule_text(const CaseRow& of_case, const GapRow& gap) {
  switch (gap.judgement.code) {
    case ReasonCode::not_judged:
      return "not judged";
    case ReasonCode::failed:
      if (!of_case.failure.empty()) return of_case.failure;
      return of_case.incomplete.empty() ? "the temperature is not a number" : of_case.incomplete;
    case ReasonCode::warning:
      return joined_texts(of_case.warnings);
    case ReasonCode::ignites:
      return "ignition";
    case ReasonCode::no_critical_gap:
      return fmt::format("ignition comes and goes with the gap, first at {}",
                         centimetres_of(of_case.critical.value));
    case ReasonCode::within_bounds:
      if (gap.ignition_after_launch) return "ignition after the launch";
      return of_case.bounds.at_least > 0.0 ? fmt::format("the critical gap may be as small as {}",
                                                         lower_bound_text(of_case.bounds.at_least))
                                           : "the launch may ignite without a gap";
    case ReasonCode::extrapolated:
      return "outside of the range of the constants: " + joined_texts(of_case.extrapolated);
    case ReasonCode::below_bound:
      return "below the lower bound of the critical gap, " + lower_bound_text(of_case.bounds.at_least);
  }
  return {};
}

Line line_through(const char* name, double intercept, double slope, const std::vector<double>& gaps_cm,
                  const std::vector<double>& temperatures) {
  double squares = 0.0;
  for (std::size_t i = 0; i < gaps_cm.size(); ++i)
    squares += std::pow(temperatures[i] - (intercept + slope * gaps_cm[i]), 2);
  Line line;
  line.name = name;
  line.intercept = intercept;
  line.slope = slope;
  line.root_mean_square = std::sqrt(squares / static_cast<double>(gaps_cm.size()));
  return line;
}

}  // namespace

const std::vector<CauseTraits>& all_causes() {
  static const std::vector<CauseTraits> causes{
      {Cause::peak_pressure, "peak_pressure", "peak pressure", true,
       "a measured spread of the peak pressure"},
      {Cause::pulse_length, "pulse_length", "length of the pulse", true, "measured curves of several rounds"},
      {Cause::initial_temperature, "initial_temperature", "initial temperature", true,
       "a narrower range of temperatures"},
      {Cause::measured_curve, "measured_curve", "measured curve", false,
       "a gauge that samples faster, or less smoothing"},
      {Cause::numerics, "numerics", "numerics", false, "finer cells"},
      {Cause::constants, "constants", "constants", false, "more measured temperatures to calibrate on"},
      {Cause::after_launch, "after_launch", "after the launch", false,
       "a measured activation energy of the explosive"},
      {Cause::models, "models", "other models", false, "measurements of how the shell holds the charge"},
  };
  return causes;
}

const CauseTraits& traits_of(Cause cause) {
  return *std::ranges::find(all_causes(), cause, &CauseTraits::cause);
}

GapBounds bounds_of(const CriticalGap& gap, const std::vector<CauseShare>& causes) {
  if (gap.kind == CriticalGapKind::unknown) return {};
  const auto not_negative = [](double length) { return length < 0.0 ? 0.0 : length; };  // NaN stays NaN
  const double at_least = not_negative(gap.value - combined(causes, &CauseShare::shorter));
  if (gap.kind == CriticalGapKind::all_safe)
    return {at_least > known_part_of_search * gap.value ? known_part_of_search * gap.value : at_least,
            no_ignition};
  return {at_least, gap.value + combined(causes, &CauseShare::longer)};
}

Peak peak_of(const surface::Maximum& maximum, const trace::BottomTrace& trace) {
  return {maximum.temperature, maximum.time, trace.name_of(maximum.station)};
}

std::optional<NamedIgnition> named(const std::optional<surface::Ignition>& ignition,
                                   const trace::BottomTrace& trace) {
  if (!ignition) return std::nullopt;
  return NamedIgnition{ignition->cause, ignition->time, trace.name_of(ignition->station),
                       ignition->chemical_share};
}

std::string to_string(surface::IgnitionCause cause) {
  return cause == surface::IgnitionCause::trigger ? "T1" : "Arrhenius";
}

std::string to_string(Verdict verdict) {
  constexpr std::array words{"SAFE", "UNSAFE", "INDETERMINATE"};
  return words.at(static_cast<std::size_t>(verdict));
}

std::string to_string(ReasonCode code) {
  constexpr std::array words{"not-judged",      "failed",        "warning",      "ignites",
                             "no-critical-gap", "within-bounds", "extrapolated", "below-bound"};
  return words.at(static_cast<std::size_t>(code));
}

double GapRow::misfit() const {
  if (!reference || reference->ignited() || ignition) return not_a_number;
  return until_exit.temperature - reference->maximum_temperature;
}

double GapRow::early_misfit() const {
  return reference ? early.temperature - reference->early_temperature : not_a_number;
}

Judgement judge(const CaseRow& of_case, const GapRow& gap) {
  using enum ReasonCode;
  const bool has_bounds = of_case.incomplete.empty() && !std::isnan(of_case.bounds.at_least);
  if (!of_case.completed() || !has_bounds || !std::isfinite(gap.maximum.temperature))
    return indeterminate(failed);
  if (std::ranges::any_of(of_case.warnings, is_final)) return indeterminate(warning);
  if (gap.ignition) return {Verdict::unsafe, ignites};
  if (std::ranges::any_of(of_case.warnings, &Remark::is_open)) return indeterminate(warning);
  if (of_case.critical.kind == CriticalGapKind::several_crossings) return indeterminate(no_critical_gap);
  if (!(gap.gap < of_case.bounds.at_least)) return indeterminate(within_bounds);
  if (std::ranges::any_of(of_case.extrapolated, &Remark::is_open)) return indeterminate(extrapolated);
  return {Verdict::safe, below_bound};
}

double largest_safe_gap(const std::vector<GapRow>& gaps) {
  double largest = not_a_number, first_other = no_ignition;
  for (const GapRow& each : gaps)
    if (each.judgement.verdict != Verdict::safe) first_other = std::min(first_other, each.gap);
  for (const GapRow& each : gaps)
    if (each.gap < first_other && !(each.gap <= largest)) largest = each.gap;
  return largest;
}

std::optional<Cause> costliest(const CaseRow& of_case) {
  const auto largest = std::ranges::max_element(of_case.causes, {}, &CauseShare::shorter);
  if (largest == of_case.causes.end() || !(largest->shorter > 0.0)) return std::nullopt;
  return largest->cause;
}

std::string accepted_text(const CaseRow& of_case) {
  std::vector<std::string> texts;
  for (const auto* remarks : {&of_case.warnings, &of_case.extrapolated})
    for (const Remark& each : *remarks)
      if (!each.is_open()) texts.push_back(fmt::format("{}, because {}", each.name, each.because));
  return fmt::format("{}", fmt::join(texts, "; "));
}

std::string names_text(const std::vector<Remark>& remarks) {
  return fmt::format("{}", fmt::join(of_each(remarks, &Remark::name), ", "));
}

std::string reason_text(const CaseRow& of_case, const GapRow& gap) {
  const std::string accepted = accepted_text(of_case);
  return rule_text(of_case, gap) + (accepted.empty() ? "" : "; accepted: " + accepted);
}

std::vector<Line> fit_gaps(const std::vector<double>& gaps, const std::vector<double>& temperatures) {
  const auto gaps_cm = of_each(gaps, [](double gap) { return 100.0 * gap; });
  const auto fitted = math::fit_line(gaps_cm, temperatures);
  if (!fitted) return {};
  const double slope = fitted->coefficients[1];
  std::vector<Line> lines{
      line_through("least squares", fitted->coefficients[0], slope, gaps_cm, temperatures)};
  if (fitted->degrees_of_freedom > 0) {
    // The diagonal of (X^T X)^-1, of two coefficients.
    lines[0].intercept_error = fitted->residual_deviation * std::sqrt(fitted->inverse_normal[0]);
    lines[0].slope_error = fitted->residual_deviation * std::sqrt(fitted->inverse_normal[3]);
  }
  if (const auto zero = std::ranges::find(gaps, 0.0); zero != gaps.end())
    lines.push_back(line_through("its slope through the zero-gap row (the published form)",
                                 temperatures[static_cast<std::size_t>(zero - gaps.begin())], slope, gaps_cm,
                                 temperatures));
  return lines;
}

}  // namespace launchsafe::study
