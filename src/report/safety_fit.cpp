// The fit of T max against gap: coefficients, residuals, what each row says of the others, and what curves
// other than a straight line would change.
#include "launchsafe/math/statistics.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/study/fit.hpp"
#include "safety_facts.hpp"

#include <cmath>
#include <functional>

namespace launchsafe::report::safety {
namespace {

/// The rows of a case that do not ignite: T max (K) as a function of the gap (cm).
struct InertRows {
  std::vector<double> gaps, temperatures;
};

InertRows inert_rows(const CaseEvidence& judged) {
  InertRows rows;
  for (const Row* row : judged.verdicts) {
    const double temperature = number_of(*row, "temperature_max_K");
    if (!judged.completed() || !text_of(*row, "ignition_cause").empty() || !std::isfinite(temperature))
      continue;
    rows.gaps.push_back(number_of(*row, "gap_cm"));
    rows.temperatures.push_back(temperature);
  }
  return rows;
}

/// Regressors at a gap (cm).
using Curve = std::function<std::vector<double>(double)>;

std::optional<math::LeastSquares> fitted(const Curve& curve, const InertRows& data,
                                         std::optional<std::size_t> without = {}) {
  std::vector<std::vector<double>> rows;
  std::vector<double> temperatures;
  for (std::size_t i = 0; i < data.gaps.size(); ++i) {
    if (i == without) continue;
    rows.push_back(curve(data.gaps[i]));
    temperatures.push_back(data.temperatures[i]);
  }
  return math::least_squares(rows, temperatures);
}

/// K, each row less what the others predict for it; NaN where they are too few.
std::vector<double> left_out_errors(const Curve& curve, const InertRows& data) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < data.gaps.size(); ++i) {
    const auto others = fitted(curve, data, i);
    errors.push_back(others ? data.temperatures[i] - others->at(curve(data.gaps[i])) : std::nan(""));
  }
  return errors;
}

/// Nothing for a number that is none.
Row told(double value) { return std::isfinite(value) ? Row(value) : Row(); }

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Hurvich & Tsai, Biometrika 76 (1989); NaN where there are too few rows for it.
double corrected_akaike(const math::LeastSquares& fit) {
  const double n = static_cast<double>(fit.residuals.size());
  const double k = static_cast<double>(fit.coefficients.size()) + 1;
  const double rms = root_mean_square(fit.residuals);
  return n - k - 1 > 0 ? n * std::log(rms * rms) + 2 * k + 2 * k * (k + 1) / (n - k - 1) : std::nan("");
}

}  // namespace

Row fit_facts(const StudyEvidence& study, const CaseEvidence& judged) {
  constexpr std::size_t fewest_rows = 3;  // of which a line is told
  const InertRows data = inert_rows(judged);
  const auto line = math::fit_line(data.gaps, data.temperatures);
  if (!line || data.gaps.size() < fewest_rows) return {{"fit", {{"rows", data.gaps.size()}, {"few", true}}}};
  const auto& kinetics = study.scene.scene.charge().kinetics;
  const double ignition = kinetics.ignition_temperature, slope = line->coefficients[1],
               slope_error = line->standard_errors[1], intercept_error = line->standard_errors[0];
  Row fit{{"rows", data.gaps.size()},
          {"few", false},
          {"intercept_K", line->coefficients[0]},
          {"intercept_error_K", intercept_error > 0 ? Row(intercept_error) : Row()},
          {"intercept_decimals", intercept_error > 0 ? decimals_for(intercept_error) : 1},
          {"slope_K_per_cm", slope},
          {"slope_error_K_per_cm", slope_error > 0 ? Row(slope_error) : Row()},
          {"slope_decimals", slope_error > 0 ? decimals_for(slope_error) : 0},
          {"deviation_K", line->residual_deviation},
          {"inverse", slope > 0}};
  // The gap at which the line reaches the ignition temperature.
  const double gap = (ignition - line->coefficients[0]) / slope;
  const double half = line->degrees_of_freedom > 0
                          ? line->prediction_half_width(math::polynomial_row(gap, 1), 0.95) / slope
                          : 0.0;
  fit["at"] = half > 0 ? measured(gap, half, half).text("cm") : significant(gap, 3) + " cm";
  // The straight line, a parabola, and the line with the heat of reaction of a skin at the line's
  // temperature, relative to that at ignition.
  const Curve straight = [](double at) { return math::polynomial_row(at, 1); };
  struct NamedCurve {
    const char *name, *key;
    Curve at;
  };
  const NamedCurve curves[] = {
      {"straight line", "left_out_rms_K", straight},
      {"parabola", "left_out_rms_parabola_K", [](double at) { return math::polynomial_row(at, 2); }},
      {"line and Arrhenius term", "left_out_rms_arrhenius_K", [&](double at) {
         std::vector<double> row = straight(at);
         row.push_back(std::exp(kinetics.activation_temperature * (1.0 / ignition - 1.0 / line->at(row))));
         return row;
       }}};
  // Of a curve with as many coefficients as rows what remains is round-off.
  const auto misfit = [](const math::LeastSquares& made) {
    return made.residuals.size() > made.coefficients.size() ? root_mean_square(made.residuals) : std::nan("");
  };
  Row left_out{{"case", judged.label},
               {"rows", data.gaps.size()},
               {"slope_K_per_cm", slope},
               {"rms_K", told(misfit(*line))}};
  Row residuals = Row::array(), compared = Row::array();
  for (const auto& [name, key, curve] : curves) {
    const std::vector<double> errors = left_out_errors(curve, data);
    left_out[key] = told(root_mean_square(errors));
    if (compared.empty()) {
      double largest = 0;
      for (std::size_t i = 0; i < data.gaps.size(); ++i) {
        largest = std::abs(errors[i]) <= largest ? largest : std::abs(errors[i]);
        residuals.push_back({{"gap_cm", data.gaps[i]},
                             {"temperature_max_K", data.temperatures[i]},
                             {"line_K", data.temperatures[i] - line->residuals[i]},
                             {"residual_K", line->residuals[i]},
                             {"left_out_K", told(errors[i])}});
      }
      left_out["left_out_largest_K"] = told(largest);
    }
    if (const auto made = fitted(curve, data))
      compared.push_back({{"curve", name},
                          {"coefficients", made->coefficients.size()},
                          {"rms_K", told(misfit(*made))},
                          {"left_out_rms_K", told(root_mean_square(errors))},
                          {"aicc", told(corrected_akaike(*made))}});
  }
  return {{"fit", fit}, {"residuals", residuals}, {"curves", compared}, {"left_out", left_out}};
}

}  // namespace launchsafe::report::safety
