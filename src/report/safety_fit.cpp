// The fit of T max against gap: coefficients, residuals, what each row says of the others, and what curves
// other than a straight line would change.
#include "launchsafe/math/statistics.hpp"
#include "launchsafe/report/number.hpp"
#include "safety_facts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace launchsafe::report::safety {
namespace {

/// A curve by its regressors at a gap (cm), and where its misfit stands among those of all cases.
struct Curve {
  const char *name, *key;
  std::function<std::vector<double>(double)> regressors;
};

/// Nothing for a number that is none.
Row told(double value) { return std::isfinite(value) ? Row(value) : Row(); }

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// K; of a curve with as many coefficients as rows what remains is round-off.
double misfit(const math::LeastSquares& fit) {
  return fit.degrees_of_freedom > 0 ? root_mean_square(fit.residuals) : std::nan("");
}

/// K, each row less what the others predict for it; NaN where they are too few.
std::vector<double> left_out_errors(const math::LeastSquares& fit, const Curve& curve,
                                    const std::vector<double>& gaps) {
  std::vector<double> errors(gaps.size(), std::nan(""));
  for (std::size_t i = 0; fit.degrees_of_freedom > 0 && i < gaps.size(); ++i)
    errors[i] = fit.residuals[i] / (1.0 - fit.leverage(curve.regressors(gaps[i])));
  return errors;
}

/// Hurvich & Tsai, Biometrika 76 (1989); NaN where there are too few rows for it.
double corrected_akaike(const math::LeastSquares& fit) {
  const double n = static_cast<double>(fit.residuals.size());
  const double k = static_cast<double>(fit.coefficients.size()) + 1;
  const double rms = root_mean_square(fit.residuals);
  return n - k - 1 > 0 ? n * std::log(rms * rms) + 2 * k + 2 * k * (k + 1) / (n - k - 1) : std::nan("");
}

}  // namespace

Row fit_facts(const CaseEvidence& judged) {
  constexpr std::size_t fewest_rows = 3;  // of which a line is told
  std::vector<double> gaps, temperatures;
  for (const Row* row : judged.verdicts) {
    const double temperature = number_of(*row, "temperature_max_K");
    if (!judged.completed() || !text_of(*row, "ignition_cause").empty() || std::isnan(temperature)) continue;
    gaps.push_back(number_of(*row, "gap_cm"));
    temperatures.push_back(temperature);
  }
  const auto line = math::fit_line(gaps, temperatures);
  const bool few = !line || gaps.size() < fewest_rows;
  Row left_out{{"case", judged.label}, {"rows", gaps.size()}, {"few", few}};
  if (few) return {{"left_out", left_out}};
  const auto& kinetics = judged.study->scene.scene.charge().kinetics;
  const double ignition = kinetics.ignition_temperature, slope = line->coefficients[1];
  // The gap at which the line reaches the ignition temperature.
  const double gap = (ignition - line->coefficients[0]) / slope;
  const double half = line->degrees_of_freedom > 0
                          ? line->prediction_half_width(math::polynomial_row(gap, 1), 0.95) / slope
                          : 0.0;
  if (slope > 0)
    left_out["reaches_ignition_at"] =
        half > 0 ? measured(gap, half, half).text("cm") : significant(gap, 3) + " cm";
  left_out["slope_K_per_cm"] = slope;
  left_out["rms_K"] = told(misfit(*line));
  // The straight line, a parabola, and the line with the heat of reaction of a skin at the line's
  // temperature, relative to that at ignition.
  const auto straight = [](double at) { return math::polynomial_row(at, 1); };
  const Curve curves[] = {
      {"straight line", "left_out_rms_K", straight},
      {"parabola", "left_out_rms_parabola_K", [](double at) { return math::polynomial_row(at, 2); }},
      {"line and Arrhenius term", "left_out_rms_arrhenius_K", [&](double at) {
         std::vector<double> row = straight(at);
         row.push_back(std::exp(kinetics.activation_temperature * (1.0 / ignition - 1.0 / line->at(row))));
         return row;
       }}};
  Row compared = Row::array(), residuals = Row::array();
  for (const Curve& curve : curves) {
    std::vector<std::vector<double>> rows;
    for (const double each : gaps) rows.push_back(curve.regressors(each));
    const auto made = math::least_squares(rows, temperatures);
    const double off = made ? root_mean_square(left_out_errors(*made, curve, gaps)) : std::nan("");
    left_out[curve.key] = told(off);
    if (made)
      compared.push_back({{"curve", curve.name},
                          {"coefficients", made->coefficients.size()},
                          {"rms_K", told(misfit(*made))},
                          {"left_out_rms_K", told(off)},
                          {"aicc", told(corrected_akaike(*made))}});
  }
  const std::vector<double> errors = left_out_errors(*line, curves[0], gaps);
  for (std::size_t i = 0; i < gaps.size(); ++i)
    residuals.push_back({{"gap_cm", gaps[i]},
                         {"temperature_max_K", temperatures[i]},
                         {"line_K", temperatures[i] - line->residuals[i]},
                         {"residual_K", line->residuals[i]},
                         {"left_out_K", told(errors[i])}});
  left_out["left_out_largest_K"] =
      told(std::abs(std::ranges::max(errors, {}, [](double each) { return std::abs(each); })));
  return {{"residuals", residuals}, {"curves", compared}, {"left_out", left_out}};
}

}  // namespace launchsafe::report::safety
