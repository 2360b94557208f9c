// The fit of T max against gap: coefficients, residuals, what each row says of the others, and what curves
// other than a straight line would change.
#include "launchsafe/math/statistics.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "safety_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace launchsafe::report::safety {
namespace {

/// Of which a line is told.
constexpr std::size_t fewest_rows = 3;

/// Regressors of a curve at a gap (cm).
struct Curve {
  std::string name;  ///< of its text
  std::function<std::vector<double>(double)> at;
};

std::optional<math::LeastSquares> fitted(const Curve& curve, const InertRows& data,
                                         std::optional<std::size_t> without = {}) {
  std::vector<std::vector<double>> rows;
  std::vector<double> temperatures;
  for (std::size_t i = 0; i < data.gaps.size(); ++i) {
    if (i == without) continue;
    rows.push_back(curve.at(data.gaps[i]));
    temperatures.push_back(data.temperatures[i]);
  }
  return math::least_squares(rows, temperatures);
}

/// K, each row less what the others predict for it; NaN where they are too few.
std::vector<double> left_out_errors(const Curve& curve, const InertRows& data) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < data.gaps.size(); ++i) {
    const auto others = fitted(curve, data, i);
    errors.push_back(others ? data.temperatures[i] - others->at(curve.at(data.gaps[i])) : std::nan(""));
  }
  return errors;
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return values.empty() ? std::nan("") : std::sqrt(sum / static_cast<double>(values.size()));
}

/// K; NaN of a curve with as many coefficients as rows: what remains is round-off.
double misfit(const math::LeastSquares& fit) {
  return fit.residuals.size() > fit.coefficients.size() ? root_mean_square(fit.residuals) : std::nan("");
}

/// Hurvich & Tsai, Biometrika 76 (1989); NaN where there are too few rows for it.
double corrected_akaike(const math::LeastSquares& fit) {
  const double n = static_cast<double>(fit.residuals.size());
  const double k = static_cast<double>(fit.coefficients.size()) + 1;
  double sum = 0;
  for (const double residual : fit.residuals) sum += residual * residual;
  return n - k - 1 > 0 ? n * std::log(sum / n) + 2 * k + 2 * k * (k + 1) / (n - k - 1) : std::nan("");
}

/// The straight line, a parabola, and the line with the heat of reaction of a skin at the line's temperature,
/// relative to that at ignition.
std::vector<Curve> curves_of(const Subject& subject, const math::LeastSquares& line) {
  const double activation = subject.scene().charge().kinetics.activation_temperature;
  const double ignition = subject.scene().charge().kinetics.ignition_temperature;
  return {{"linear", [](double gap) { return math::polynomial_row(gap, 1); }},
          {"quadratic", [](double gap) { return math::polynomial_row(gap, 2); }},
          {"arrhenius", [line, activation, ignition](double gap) {
             std::vector<double> row = math::polynomial_row(gap, 1);
             row.push_back(std::exp(activation * (1.0 / ignition - 1.0 / line.at(row))));
             return row;
           }}};
}

struct Comparison {
  Table table;
  std::string best;
  double best_error = std::nan("");
};

Comparison compare_curves(const std::vector<Curve>& curves, const InertRows& data) {
  Comparison comparison;
  comparison.table.columns = {Column{"curve", "curve"}, Column{"coefficients", "coefficients", count()},
                              Column{"rms", "RMS of residuals", keys::significant(2, kelvin)},
                              Column{"left_out_rms", "RMS left out", keys::significant(2, kelvin)},
                              Column{"aicc", "AICc", keys::significant(3)}};
  for (const Curve& curve : curves) {
    const auto fit = fitted(curve, data);
    if (!fit) continue;
    const double error = root_mean_square(left_out_errors(curve, data));
    comparison.table.rows.push_back({curve.name, static_cast<std::int64_t>(fit->coefficients.size()),
                                     optional_number(misfit(*fit)), optional_number(error),
                                     optional_number(corrected_akaike(*fit))});
    if (std::isfinite(error) && !(error >= comparison.best_error)) {
      comparison.best = curve.name;
      comparison.best_error = error;
    }
  }
  return comparison;
}

Table residual_table(const InertRows& data, const math::LeastSquares& line,
                     const std::vector<double>& left_out) {
  Table table{.columns = {quantity::gap(), Column{"temperature_max", "T max", keys::fixed(1, kelvin)},
                          Column{"line", "on the line", keys::fixed(1, kelvin)},
                          Column{"residual", "residual", keys::fixed(2, kelvin)},
                          Column{"left_out", "less what the others predict", keys::fixed(2, kelvin)}}};
  for (std::size_t i = 0; i < data.gaps.size(); ++i)
    table.rows.push_back({data.gaps[i], data.temperatures[i], data.temperatures[i] - line.residuals[i],
                          line.residuals[i], optional_number(left_out[i])});
  return table;
}

Parts signed_part(double value, double error, const std::string& unit) {
  if (!(error > 0.0)) return part(significant(value, 4) + " " + unit, value, unit);
  const int decimals = decimals_for(error);
  return part(
      fmt::format("{} ± {} {}", fixed(value, decimals), fixed(rounded_up(error, decimals), decimals), unit),
      value, unit);
}

/// The gap at which the line reaches the ignition temperature, beside that of the bisection.
void say_inverse(const Subject& subject, const JudgedCase& each, const math::LeastSquares& line,
                 SafetySection& section) {
  const double slope = line.coefficients[1],
               ignition = subject.scene().charge().kinetics.ignition_temperature;
  if (!(slope > 0.0)) return;
  const double gap = (ignition - line.coefficients[0]) / slope;
  constexpr double level = 0.95;
  const double half = line.degrees_of_freedom > 0
                          ? line.prediction_half_width(math::polynomial_row(gap, 1), level) / slope
                          : std::nan("");
  const double computed = number_of(*each.critical, "critical_gap_cm");
  Parts parts{{"ignition", fixed(ignition, 1) + " K"}};
  parts["gap"] = half > 0 ? part(measured(gap, half, half).text("cm"), gap, "cm")
                          : part(significant(gap, 3) + " cm", gap, "cm");
  if (is_value(*each.critical)) {
    parts["computed"] = part(significant(computed, 4) + " cm", computed, "cm");
    parts["difference"] = part(significant(gap - computed, 2) + " cm", gap - computed, "cm");
  }
  section.say("fit.inverse", parts, subject.origin("fit, cases", each.label));
}

/// Every case with a fit, a row each: how well a row follows from the others, by curve.
Table left_out_table(const Subject& subject) {
  Table table{
      .columns = {quantity::case_name(), Column{"rows", "rows", count()},
                  Column{"slope", "slope", keys::significant(4, kelvin_per_centimetre)},
                  Column{"rms", "RMS of residuals", keys::significant(2, kelvin)},
                  Column{"left_out_largest", "largest left out", keys::significant(2, kelvin)},
                  Column{"left_out_rms", "RMS left out", keys::significant(2, kelvin)},
                  Column{"left_out_rms_quadratic", "of a parabola", keys::significant(2, kelvin)},
                  Column{"left_out_rms_arrhenius", "with an Arrhenius term", keys::significant(2, kelvin)}}};
  for (const JudgedCase& each : subject.cases) {
    const InertRows data = inert_rows(each);
    const auto line = math::fit_line(data.gaps, data.temperatures);
    if (!line || data.gaps.size() < fewest_rows) continue;
    std::vector<Cell>& cells =
        table.rows.emplace_back(std::vector<Cell>{each.label, static_cast<std::int64_t>(data.gaps.size()),
                                                  line->coefficients[1], optional_number(misfit(*line))});
    for (const Curve& curve : curves_of(subject, *line)) {
      const std::vector<double> errors = left_out_errors(curve, data);
      if (curve.name == "linear") {
        double largest = 0;
        for (const double error : errors) largest = std::abs(error) <= largest ? largest : std::abs(error);
        cells.push_back(optional_number(largest));
      }
      cells.push_back(optional_number(root_mean_square(errors)));
    }
  }
  return table;
}

void say_fit(const Subject& subject, const JudgedCase& each, SafetySection& section) {
  const InertRows data = inert_rows(each);
  const auto line = math::fit_line(data.gaps, data.temperatures);
  const Origin origin = subject.origin("verdicts", each.label);
  if (!line || data.gaps.size() < fewest_rows)
    return section.say("fit.too_few", {{"case", each.label}, {"rows", data.gaps.size()}}, origin);
  section.say(
      "fit.line",
      {{"case", each.label},
       {"rows", data.gaps.size()},
       {"slope", signed_part(line->coefficients[1], line->standard_errors[1], "K/cm")},
       {"intercept", signed_part(line->coefficients[0], line->standard_errors[0], "K")},
       {"deviation", part(uncertain_text(line->residual_deviation) + " K", line->residual_deviation, "K")}},
      origin);
  const std::vector<Curve> curves = curves_of(subject, *line);
  const std::vector<double> left_out = left_out_errors(curves.front(), data);
  section.show("residuals", residual_table(data, *line, left_out), origin);
  section.say("fit.lack_of_fit", {}, origin);
  say_inverse(subject, each, *line, section);
  const Comparison comparison = compare_curves(curves, data);
  section.show("curves", comparison.table, origin);
  Parts parts{{"rows", data.gaps.size()}};
  if (!comparison.best.empty()) parts[comparison.best] = true;
  parts["error"] = part(significant(comparison.best_error, 2) + " K", comparison.best_error, "K");
  section.say(comparison.best.empty() ? "fit.no_evidence" : "fit.evidence", parts, origin);
}

}  // namespace

SafetySection fit_section(const Subject& subject) {
  SafetySection section{"fit"};
  if (subject.cases.empty()) section.say("fit.none");
  // The others have the same shape; two tables each would bury the answer.
  if (const JudgedCase* own = subject.own_case()) say_fit(subject, *own, section);
  if (Table others = left_out_table(subject); subject.cases.size() > 1 && !others.rows.empty())
    section.show("left_out_rows", std::move(others), subject.origin("verdicts"));
  return section;
}

}  // namespace launchsafe::report::safety
