#include "launchsafe/study/case_uncertainty.hpp"

#include "launchsafe/scene/launch_end.hpp"
#include "launchsafe/scene/load_roughness.hpp"
#include "launchsafe/study/firing_posterior.hpp"

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

double heat_factor(const Study& study, const scene::Scene& scene, const trace::BottomTrace& trace,
                   double gap) {
  if (!study.kind.gives_verdicts || !study.calibration.firings) return 1.0;
  const FiringEvidence& evidence = *study.calibration.firings;
  const surface::SkinModel model = surface::skin_model(scene);
  const surface::SurfaceConstants constants = surface::constants_of(model);
  double largest = 1.0;
  for (const double each : {0.0, gap}) {
    for (const Posterior* posterior : {&evidence.posterior, &evidence.of_doubled_prior}) {
      const auto boundary = boundary_for(*posterior, model, trace, each);
      const double factor =
          boundary ? heat_factor(*posterior, *boundary, constants) : std::numeric_limits<double>::infinity();
      largest = std::max(largest, factor);
    }
  }
  return largest;
}

double fit_share(const Study& study, const RecordDistance& distance, const Rises& rises, double heat_factor) {
  if (!study.kind.gives_verdicts) return 0.0;
  const CalibrationEvidence& evidence = study.calibration.evidence;
  double fit = std::isfinite(study.fit_uncertainty) ? study.fit_uncertainty : evidence.fit_uncertainty;
  if (distance.other_load_shape) fit = std::max(fit, assumed_other_load_shape);
  if (study.calibration.firings) {
    // Written so that what is not a number leaves none.
    const double of_firings = (heat_factor - 1.0) * (rises.friction + rises.air);
    fit = of_firings <= fit ? fit : of_firings;
  } else {
    const double growth = std::hypot(rises.friction / evidence.friction_rise, rises.air / evidence.air_rise);
    fit *= growth <= 1.0 ? 1.0 : growth;
  }
  return distance.other_numerics ? std::hypot(fit, assumed_numerical_uncertainty) : fit;
}

double stated_input_share(const Study& study, const StudyCase& input) {
  if (!std::isfinite(study.input_uncertainty)) return 0.0;
  const double growth = std::pow(input.pressure_ratio, heat_exponent);
  return study.input_uncertainty * (growth <= 1.0 ? 1.0 : growth);
}

std::optional<double> stated_model_form_share(const Study& study, const StudyCase& input,
                                              const ModelFormShift& recorded) {
  if (!study.kind.gives_verdicts) return 0.0;
  const bool stated = std::isfinite(study.model_form_uncertainty);
  if (std::isfinite(recorded.gap)) return std::nullopt;
  // What a study states is of its own scene; what is assumed, of the calibrated launch.
  const double ratio = stated ? input.pressure_ratio : ratio_to_calibration(study, input);
  const double growth = std::pow(ratio, heat_exponent);
  return (stated ? study.model_form_uncertainty : assumed_model_form) * (growth <= 1.0 ? 1.0 : growth);
}

std::string assumed_shares(const Study& study, const StudyCase& input, double critical_gap) {
  const auto recorded =
      study.model_form ? model_form_shift(*study.model_form, input.scene.scene) : CaseStatements{}.model_form;
  const bool computation =
      input.numerical_uncertainty_assumed || critical_gap > input.covered_gap * (1.0 + 1e-9);
  const bool models =
      !std::isfinite(study.model_form_uncertainty) && stated_model_form_share(study, input, recorded);
  if (computation) return models ? "computation, model form" : "computation";
  return models ? "model form" : "";
}

LoadCurveErrors load_curve_errors(const scene::Load& load) {
  const double roughness = scene::load_roughness(load);
  const double kept = 1.0 - scene::peak_lost_to_smoothing(load);
  return {roughness / (1.0 + roughness) + scene::work_lost_to_smoothing(load),
          std::pow(kept, -heat_exponent) - 1.0};
}

AcceptancesOfStudy acceptances_of(const StudyFile& study) {
  AcceptancesOfStudy all;
  // Cases that bring constants of their own are held against those, one by one.
  if (!study.study.kind.gives_verdicts || study.study.kind.own_scenes) return all;
  const double largest = study.study.gaps.empty() ? 0.0 : *std::ranges::max_element(study.study.gaps);
  std::set<std::string> seen;
  const auto is_new = [&seen](const std::string& said) { return seen.insert(said).second; };
  for (const StudyCase& input : study.cases) {
    CaseStatements statements = statements_of(study.study, input);
    std::vector<scene::Implausible> to_be_accepted = statements.to_be_accepted();
    if (statements.is_beyond(largest)) statements.extrapolated.emplace_back("gap");
    for (scene::Implausible& each : to_be_accepted) {
      const std::string& value = each.accepted() ? each.accepted_value : each.value;
      if (is_new(fmt::format("{} = {} {}", each.key, value, each.accepted())))
        (each.accepted() ? all.accepted : all.missing).push_back(std::move(each));
    }
    for (std::string& each : statements.extrapolated)
      if (is_new(each)) all.extrapolated.push_back(std::move(each));
  }
  return all;
}

std::string fit_uncertainty_text(const Study& study) {
  if (study.calibration.firings)
    return fmt::format(
        "{:.3g} K at the thickest gap that was fired, and in a case what raises its own heat until it is as "
        "close to ignition as all but {:g} % of the rounds at most, by all that the firings leave open of "
        "the "
        "constants, with the prior or with one twice as wide.",
        study.fit_uncertainty, 100.0 * firing_risk);
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
