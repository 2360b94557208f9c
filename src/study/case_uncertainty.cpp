#include "launchsafe/study/case_uncertainty.hpp"

#include "launchsafe/scene/launch_end.hpp"
#include "launchsafe/scene/load_roughness.hpp"
#include "launchsafe/scene/plausibility.hpp"
#include "launchsafe/study/study_uncertainty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace launchsafe::study {
namespace {

/// Peak pressure of a case over that of the launch that the constants were calibrated on.
double ratio_to_calibration(const Study& study, const StudyCase& input) {
  return scene::PressureHistory(input.scene.scene.load).stated_peak() /
         scene::PressureHistory(study.calibration.scene.load).stated_peak();
}

/// A peak pressure at which no other model of the launch was looked at: how wrong the one is there nobody
/// knows, whatever is assumed or stated of it.
std::optional<scene::Implausible> pressure_beyond_models(const Study& study, const StudyCase& input) {
  const scene::Scene& scene = input.scene.scene;
  const scene::Limits compared = compared_pressures(study.model_form);
  constexpr double round_off = 1e-9;
  const double peak = scene::PressureHistory(scene.load).stated_peak();
  if (peak >= compared.lowest * (1.0 - round_off) && peak <= compared.highest * (1.0 + round_off))
    return std::nullopt;
  return scene::implausible(
      scene.accepted, {.kind = keys::KeyKind::number, .dimension = scene::Dimension::pressure},
      scene::pressure_of_models, keys::Value(peak),
      fmt::format("{} to {}, because other models of the launch were compared only there",
                  scene::pressure_text(compared.lowest), scene::pressure_text(compared.highest)));
}

/// What is not plausible of a case and of what its study states, accepted or not.
std::vector<scene::Implausible> implausible_in(const Study& study, const StudyCase& input) {
  std::vector<scene::Implausible> values = study.implausible;
  if (auto beyond = pressure_beyond_models(study, input)) values.push_back(std::move(*beyond));
  for (scene::Implausible& each : scene::implausible_values(input.scene.scene))
    values.push_back(std::move(each));
  return values;
}

/// What lies beyond the calibration's domain for a case, by name: first what is foreign to it.
std::vector<std::string> extrapolated_in(const Study& study, const StudyCase& input, double gap) {
  std::vector<std::string> beyond = distance_to_calibration(input.scene.scene, study.calibration).names();
  if (input.scene.scene.load.smoothing > 0.0) {
    beyond.push_back("load smoothed over " +
                     scene::format_quantity(input.scene.scene.load.smoothing, scene::Dimension::time));
  }
  if (gap > study.calibration.evidence.largest_gap * (1.0 + 1e-9)) beyond.emplace_back("gap");
  return beyond;
}

/// What only averages or removes heat: no ignition under it shows nothing.
std::vector<std::string> cooling_in(const scene::Scene& scene, const scene::Scene& calibrated) {
  constexpr double deepest_station = 10e-3, widest_station = 20e-3, thickest_skin = 0.3e-3;  // m
  constexpr double least_share = 0.5, slack = 1e-9;
  const scene::Surface &ours = scene.surface, &theirs = calibrated.surface;
  std::vector<std::string> found;
  const auto add = [&found](bool cools, std::string name) {
    if (cools) found.push_back(std::move(name));
  };
  add(ours.station_depth > deepest_station + slack, "stations deeper than 10 mm");
  add(ours.station_width > widest_station + slack, "stations wider than 20 mm");
  add(ours.skin_thickness > thickest_skin + slack, "a skin above 0.3 mm");
  add(ours.friction == scene::FrictionClosure::none, "no friction heat");
  add(ours.localisation * scene.charge().sliding_friction <
          least_share * theirs.localisation * calibrated.charge().sliding_friction,
      "sliding friction times localisation below half the calibrated product");
  add(ours.exchange_time * least_share > theirs.exchange_time,
      "an exchange slower than half the calibrated one");
  return found;
}

/// The alternatives of a record that count, or those that do not.
std::string names_of(const ModelFormRecord& record, bool counted) {
  std::vector<std::string> names;
  for (const ModelAlternative& each : record.alternatives) {
    if (each.not_counted.empty() == counted) names.push_back(each.name);
  }
  return names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "));
}

}  // namespace

bool propagates_spread(const Study& study) {
  return study.kind.gives_verdicts && study.kind.bounds_critical_gaps &&
         !std::isfinite(study.input_uncertainty);
}

std::string label_of_raised(const StudyCase& input) {
  return fmt::format("{}, load +{:.3g} %", input.label, 100.0 * assumed_load_spread);
}

scene::Scene with_raised_load(const scene::Scene& scene) {
  scene::Scene raised = scene;
  const double factor = 1.0 + assumed_load_spread;
  scene::Load& load = raised.load;
  load.peak *= factor;
  if (!load.rescale_to_peak) {
    for (double& pressure : load.curve_pressure) pressure *= factor;
  }
  return raised;
}

double fit_share(const Study& study, const RecordDistance& distance, const Rises& rises) {
  if (!study.kind.gives_verdicts) return 0.0;
  const CalibrationEvidence& evidence = study.calibration.evidence;
  double fit = std::isfinite(study.fit_uncertainty) ? study.fit_uncertainty : evidence.fit_uncertainty;
  if (distance.other_load_shape) fit = std::max(fit, assumed_other_load_shape);
  const double growth = std::hypot(rises.friction / evidence.friction_rise, rises.air / evidence.air_rise);
  // Written so that a rise that is not a number leaves none.
  fit *= growth <= 1.0 ? 1.0 : growth;
  return distance.other_numerics ? std::hypot(fit, assumed_numerical_uncertainty) : fit;
}

double stated_input_share(const Study& study, const StudyCase& input) {
  if (!std::isfinite(study.input_uncertainty)) return 0.0;
  const double growth = std::pow(input.pressure_ratio, heat_exponent);
  return study.input_uncertainty * (growth <= 1.0 ? 1.0 : growth);
}

std::optional<double> stated_model_form_share(const Study& study, const StudyCase& input) {
  if (!study.kind.gives_verdicts) return 0.0;
  const bool stated = std::isfinite(study.model_form_uncertainty);
  if (study.model_form && std::isfinite(model_form_shift(*study.model_form, input.scene.scene).gap))
    return std::nullopt;
  // What a study states is of its own scene; what is assumed, of the calibrated launch.
  const double ratio = stated ? input.pressure_ratio : ratio_to_calibration(study, input);
  const double growth = std::pow(ratio, heat_exponent);
  return (stated ? study.model_form_uncertainty : assumed_model_form) * (growth <= 1.0 ? 1.0 : growth);
}

std::string assumed_shares(const Study& study, const StudyCase& input, double critical_gap) {
  const bool computation =
      input.numerical_uncertainty_assumed || critical_gap > input.covered_gap * (1.0 + 1e-9);
  const bool models = !std::isfinite(study.model_form_uncertainty) && stated_model_form_share(study, input);
  if (computation) return models ? "computation, model form" : "computation";
  return models ? "model form" : "";
}

std::string model_form_text(const Study& study, const StudyCase& input, double gap, bool ignites) {
  if (!study.model_form) return {};
  const scene::Scene& scene = input.scene.scene;
  const std::string names = ignites ? models_without_ignition(*study.model_form, scene, gap)
                                    : models_that_may_ignite(*study.model_form, scene, gap);
  if (names.empty()) return {};
  return (ignites ? "no ignition, or none known, under " : "ignition not excluded under ") + names;
}

LoadCurveErrors load_curve_errors(const scene::Load& load) {
  const double roughness = scene::load_roughness(load);
  const double kept = 1.0 - scene::peak_lost_to_smoothing(load);
  return {roughness / (1.0 + roughness) + scene::work_lost_to_smoothing(load),
          std::pow(kept, -heat_exponent) - 1.0};
}

std::vector<scene::Implausible> to_be_accepted(const Study& study, const StudyCase& input) {
  // No stress case of a stability study may pass because its input is called implausible.
  if (!study.kind.gives_verdicts) return {};
  std::vector<scene::Implausible> values = implausible_in(study, input);
  for (scene::Implausible& each : distance_to_calibration(input.scene.scene, study.calibration).foreign) {
    const bool known = std::ranges::any_of(values, [&](const auto& value) { return value.key == each.key; });
    if (!known) values.push_back(std::move(each));
  }
  return values;
}

std::string unaccepted_text(const Study& study, const StudyCase& input) {
  if (!study.kind.gives_verdicts) return {};
  std::vector<std::string> warnings, foreign;
  for (const scene::Implausible& each : implausible_in(study, input))
    if (!each.accepted()) warnings.push_back(scene::validity_warning(each));
  for (const scene::Implausible& each : distance_to_calibration(input.scene.scene, study.calibration).foreign)
    if (!each.accepted()) foreign.push_back(scene::value_text(each));
  if (!foreign.empty())
    warnings.push_back(fmt::format(
        "extrapolated: the constants were calibrated on another launch ({}), and nothing says how wrong they "
        "are here",
        fmt::join(foreign, ", ")));
  return fmt::format("{}", fmt::join(warnings, "; "));
}

std::string accepted_text(const Study& study, const StudyCase& input) {
  return scene::accepted_text(to_be_accepted(study, input));
}

AcceptancesOfStudy acceptances_of(const StudyFile& study) {
  AcceptancesOfStudy all;
  // Cases that bring constants of their own are held against those, one by one.
  if (!study.study.kind.gives_verdicts || study.study.kind.own_scenes) return all;
  const double largest = study.study.gaps.empty() ? 0.0 : *std::ranges::max_element(study.study.gaps);
  std::set<std::string> seen;
  const auto is_new = [&seen](const std::string& said) { return seen.insert(said).second; };
  for (const StudyCase& input : study.cases) {
    for (scene::Implausible& each : to_be_accepted(study.study, input)) {
      const std::string& value = each.accepted() ? each.accepted_value : each.value;
      if (is_new(fmt::format("{} = {} {}", each.key, value, each.accepted())))
        (each.accepted() ? all.accepted : all.missing).push_back(std::move(each));
    }
    for (std::string& each : extrapolated_in(study.study, input, largest))
      if (is_new(each)) all.extrapolated.push_back(std::move(each));
  }
  return all;
}

std::string optimistic_text(const Study& study, const StudyCase& input) {
  constexpr double fewest_calibres = 10.0;
  const scene::Scene& scene = input.scene.scene;
  if (scene.surface.air_model == scene::AirModel::film)
    return "no ignition under gap.air = \"film\", an optimistic bound, shows nothing";
  if (!study.kind.gives_verdicts) return {};
  const std::vector<std::string> cooling = cooling_in(scene, study.calibration.scene);
  if (!cooling.empty())
    return fmt::format(
        "no ignition with {} shows nothing: that only averages or removes heat, accepted or not",
        fmt::join(cooling, ", "));
  const double calibres = scene::calibres_until(scene, scene::read_time(scene.load));
  if (calibres >= fewest_calibres) return {};
  return fmt::format(
      "no ignition within {:.3g} calibres of travel shows nothing: no barrel is shorter than {:g}", calibres,
      fewest_calibres);
}

std::string unheated_text(double friction_rise) {
  constexpr double least_rise = 1.0;  // K
  if (friction_rise >= least_rise) return {};
  return fmt::format(
      "friction heats the charge's bottom by {:.2g} K over the launch, less than {:g} K: no ignition shows "
      "nothing",
      friction_rise, least_rise);
}

std::string extrapolation_text(const Study& study, const StudyCase& input, double gap) {
  if (!study.kind.gives_verdicts) return {};
  const std::vector<std::string> beyond = extrapolated_in(study, input, gap);
  return beyond.empty() ? std::string{} : fmt::format("extrapolated: {}", fmt::join(beyond, ", "));
}

std::string fit_uncertainty_text(const Study& study) {
  const CalibrationEvidence& evidence = study.calibration.evidence;
  const std::string base = std::isfinite(study.fit_uncertainty)
                               ? fmt::format("{:.3g} K, as the study states", study.fit_uncertainty)
                               : fmt::format(
                                     "{:.3g} K, as the study states none: that of the shipped "
                                     "calibration",
                                     evidence.fit_uncertainty);
  const std::string rows = fmt::format(
      "for the rows that the constants were fitted to, where friction heats by {:.4g} K and the air by "
      "{:.4g} K",
      evidence.friction_rise, evidence.air_rise);
  return fmt::format(
      "{}, {}; their relative errors are carried to a case's own heating by friction and air. Under another "
      "load shape it is at least {:.3g} K, and with other numerics {:.3g} K for the mesh error that the "
      "constants absorbed come in.",
      base, rows, assumed_other_load_shape, assumed_numerical_uncertainty);
}

std::string model_form_uncertainty_text(const StudyFile& study) {
  const Study& s = study.study;
  const std::string otherwise = fmt::format(
      "{:.3g} K are assumed, more than any of the models of the 155 mm "
      "shell that count moves T max, growing with the power {:g} of the pressure",
      assumed_model_form, heat_exponent);
  if (std::isfinite(s.model_form_uncertainty))
    return fmt::format("{:.3g} K, as the study states for its own scene.", s.model_form_uncertainty);
  if (!s.model_form) return "the study names no record of other models, so that " + otherwise + ".";
  std::map<std::string, std::size_t> reasons;
  for (const StudyCase& each : study.cases) {
    const ModelFormShift shift = model_form_shift(*s.model_form, each.scene.scene);
    if (!std::isfinite(shift.gap)) ++reasons[shift.reason];
  }
  std::string text = fmt::format(
      "what a gap thicker by as much as the smallest critical gap of another model is below that of the "
      "default changes, by the record `{}` of {} and, counting for nothing, {}; models that only move away "
      "from ignition take nothing from a margin. At {:.4g} MPa all of them were calibrated on the same rows: "
      "there they agree by construction, and the model form is not assessable",
      s.model_form_record, names_of(*s.model_form, true), names_of(*s.model_form, false),
      1e-6 * s.calibration.scene.load.peak);
  if (!reasons.empty())
    text += fmt::format("; where it does not speak of a case, {}, {}",
                        commonest_first(reasons, study.cases.size()), otherwise);
  return text + ".";
}

std::string input_uncertainty_text(const Study& study) {
  const std::string spread =
      std::isfinite(study.input_uncertainty)
          ? fmt::format(
                "{:.3g} K, as the study states for its own scene; at a higher peak it grows with the power "
                "{:g} of the pressure",
                study.input_uncertainty, heat_exponent)
          : fmt::format(
                "the study states none, so that two standard deviations are assumed of each: the load "
                "{:.3g} % higher, by a run of its own, its pulse {:.3g} % longer, and the initial "
                "temperature {:.3g} K higher",
                100.0 * assumed_load_spread, 100.0 * assumed_pulse_spread, assumed_temperature_spread);
  return spread + ". The noise of a measured curve and what smoothing took from its peak come on top.";
}

}  // namespace launchsafe::study
