#include "launchsafe/study/verdict.hpp"

namespace launchsafe::study {
namespace {

using keys::ActsOn;

/// A curve by its regressors at a gap in cm.
using Regressors = std::function<std::vector<double>(double)>;

double root_mean_square(const std::vector<double>& values) {
  return std::sqrt(math::sum_of_squares(values) / static_cast<double>(values.size()));
}

Line line_through(double intercept, double slope, const std::vector<double>& gaps_cm,
                  const std::vector<double>& temperatures) {
  Line line{intercept, slope, {}, 0};
  for (std::size_t i = 0; i < gaps_cm.size(); ++i)
    line.residuals.push_back(temperatures[i] - (intercept + slope * gaps_cm[i]));
  line.root_mean_square = root_mean_square(line.residuals);
  return line;
}

std::vector<double> straight(double gap_cm) { return math::polynomial_row(gap_cm, 1); }

/// K, each row less what the others predict for it; NaN where they are too few.
std::vector<double> left_out_errors(const math::LeastSquares& fit, const Regressors& regressors,
                                    const std::vector<double>& gaps_cm) {
  std::vector<double> errors(gaps_cm.size(), not_a_number);
  for (std::size_t i = 0; fit.degrees_of_freedom > 0 && i < gaps_cm.size(); ++i)
    errors[i] = fit.residuals[i] / (1.0 - fit.leverage(regressors(gaps_cm[i])));
  return errors;
}

double corrected_akaike(double misfit, double rows, double coefficients) {
  const double unknowns = coefficients + 1, spare = rows - unknowns - 1;
  return spare > 0 ? rows * std::log(misfit * misfit) + 2 * unknowns + 2 * unknowns * (unknowns + 1) / spare
                   : not_a_number;
}

/// Nothing where the regressors depend on each other, or there are fewer rows than coefficients.
std::optional<FittedCurve> fit_curve(const char* name, const Regressors& regressors,
                                     const std::vector<double>& gaps_cm,
                                     const std::vector<double>& temperatures) {
  const auto fit = math::least_squares(of_each(gaps_cm, regressors), temperatures);
  if (!fit) return std::nullopt;
  FittedCurve curve{name, static_cast<int>(fit->coefficients.size())};
  curve.left_out = root_mean_square(left_out_errors(*fit, regressors, gaps_cm));
  // Of a curve with as many coefficients as rows what remains is round-off.
  if (fit->degrees_of_freedom > 0) curve.root_mean_square = root_mean_square(fit->residuals);
  curve.corrected_akaike =
      corrected_akaike(root_mean_square(fit->residuals), static_cast<double>(gaps_cm.size()),
                       static_cast<double>(curve.coefficients));
  return curve;
}

/// Whether a key acts on the skin of a given trace, or in proportion to what the trace holds.
bool is_of_skin(const std::string& key) {
  constexpr std::array felt{ActsOn::trace, ActsOn::heat, ActsOn::conduction, ActsOn::surface};
  return std::ranges::find(felt, scene::role_of(key).acts_on) != felt.end();
}

}  // namespace

std::optional<GapFit> fit_gaps(const std::vector<double>& gaps, const std::vector<double>& temperatures,
                               const materials::KineticsParameters& kinetics,
                               const ReferenceLine& published) {
  const auto gaps_cm = of_each(gaps, [](double gap) { return 100.0 * gap; });
  const auto fitted = math::fit_line(gaps_cm, temperatures);
  if (!fitted) return std::nullopt;
  GapFit fit;
  fit.gaps = gaps;
  fit.temperatures = temperatures;
  fit.least_squares = *fitted;
  const double slope = fitted->coefficients[1];
  fit.ordinary = line_through(fitted->coefficients[0], slope, gaps_cm, temperatures);
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (gaps[i] == 0.0) fit.mixed = line_through(temperatures[i], slope, gaps_cm, temperatures);
  }
  if (published.given())
    fit.published = line_through(published.intercept, published.slope, gaps_cm, temperatures);
  fit.left_out = left_out_errors(*fitted, straight, gaps_cm);
  if (fitted->degrees_of_freedom < 1) return fit;
  const double ignition = kinetics.ignition_temperature;
  if (slope > 0.0) {
    const double gap_cm = (ignition - fitted->coefficients[0]) / slope;
    fit.reaches_ignition = 0.01 * gap_cm;
    fit.reaches_ignition_half_width = 0.01 * fitted->prediction_half_width(straight(gap_cm), 0.95) / slope;
  }
  const std::pair<const char*, Regressors> curves[] = {
      {"straight line", straight},
      {"parabola", [](double at) { return math::polynomial_row(at, 2); }},
      // Relative to the heat of reaction at ignition.
      {"line and Arrhenius term", [&](double at) {
         std::vector<double> row = straight(at);
         row.push_back(std::exp(kinetics.activation_temperature * (1.0 / ignition - 1.0 / fitted->at(row))));
         return row;
       }}};
  for (const auto& [name, regressors] : curves)
    if (auto curve = fit_curve(name, regressors, gaps_cm, temperatures))
      fit.curves.push_back(std::move(*curve));
  return fit;
}

std::vector<std::string> skin_keys(const std::vector<scene::Implausible>& to_be_accepted) {
  std::vector<std::string> keys;
  for (const scene::Implausible& each : to_be_accepted) {
    if (is_of_skin(each.key)) keys.push_back(each.key);
    // Any of the three may be the one that is wrong.
    if (each.key == "gap.gas_law")
      keys.insert(keys.end(), {"gap.air_temperature", "gap.air_pressure", "gap.air_density"});
  }
  return keys;
}

std::vector<std::string> keys_as_calibrated(const std::vector<scene::Implausible>& to_be_accepted) {
  std::vector<std::string> keys = skin_keys(to_be_accepted);
  if (!keys.empty()) keys.insert(keys.begin(), "");
  for (const scene::Implausible& each : to_be_accepted)
    if (scene::role_of(each.key).acts_on == ActsOn::chemistry) keys.push_back(each.key);
  return keys;
}

scene::Scene with_calibrated(const scene::Scene& scene, const scene::Scene& calibrated,
                             const std::vector<std::string>& keys) {
  scene::Scene changed = scene;
  for (const std::string& name : keys) {
    const auto& key = *scene::find_key(scene::scene_keys(), name);
    key.set(changed, key.get(calibrated));
  }
  if (std::ranges::find(keys, "charge.sliding_friction") != keys.end())
    changed.surface.localisation *= calibrated.charge().sliding_friction / scene.charge().sliding_friction;
  return changed;
}

std::vector<AsCalibrated> as_calibrated(const scene::Scene& scene, const scene::Scene& calibrated,
                                        const std::vector<scene::Implausible>& to_be_accepted,
                                        const trace::BottomTrace& trace, double gap) {
  std::vector<AsCalibrated> all;
  for (const std::string& key : keys_as_calibrated(to_be_accepted)) {
    const std::vector<std::string> keys = key.empty() ? skin_keys(to_be_accepted) : std::vector{key};
    const scene::Scene changed = with_calibrated(scene, calibrated, keys);
    const auto skin = surface::integrate_skin(surface::skin_model(changed), trace, gap);
    all.push_back({key, surface::maximum_at_stations(skin, trace).temperature, skin.ignition.has_value()});
  }
  return all;
}

std::string to_string(surface::IgnitionCause cause) {
  return cause == surface::IgnitionCause::trigger ? "T1" : "Arrhenius";
}

double GapVerdict::misfit() const {
  if (!reference || reference->ignited() || ignition) return not_a_number;
  return until_exit.temperature - reference->maximum_temperature;
}

double GapVerdict::calibrated_margin() const {
  for (const AsCalibrated& each : as_calibrated)
    if (each.key.empty())
      return each.ignites ? -math::infinity : margin + maximum.temperature - each.temperature;
  return math::infinity;
}

double GapVerdict::early_misfit() const {
  return reference ? early.temperature - reference->early_temperature : not_a_number;
}

void judge_rows(const Study& study, const std::shared_ptr<const CaseEvidence>& of_case,
                const CriticalGap& critical, std::vector<GapVerdict>& rows) {
  const std::optional<PressureInterval>& around = of_case->input.model_form.around;
  for (GapVerdict& row : rows) {
    row.of_case = of_case;
    if (around)
      row.models = models_that_differ(*study.model_form, *around, row.gap, row.ignition.has_value());
    row.judgement = judge(row, critical);
  }
}

double largest_safe_gap(const std::vector<GapVerdict>& rows) {
  double largest = not_a_number, first_other = no_ignition;
  for (const GapVerdict& each : rows)
    if (each.judgement.verdict != Verdict::safe) first_other = std::min(first_other, each.gap);
  for (const GapVerdict& each : rows)
    if (each.gap < first_other && !(each.gap <= largest)) largest = each.gap;
  return largest;
}

}  // namespace launchsafe::study
