#include "calibration_parts.hpp"
#include "launchsafe/run/validity_warnings.hpp"
#include "launchsafe/study/run_cases.hpp"

#include <fmt/format.h>

namespace launchsafe::kinds {

using study::FinishedRun, study::fitted_keys, study::StudyFile, study::StudyOptions, study::Timing;

namespace {

/// The load and the constants of one trial.
struct Trial {
  scene::Load load;
  double localisation = 0;
  double exchange_time = 0;  ///< s
};

/// What tells the loads of trials apart: peak time, width, steepness, base.
using LoadNumbers = std::array<double, 4>;
LoadNumbers numbers_of(const scene::Load& load) {
  return {load.peak_time, load.width, load.steepness, load.base};
}

/// Tries loads, each by a mechanical run the first time that it is asked for.
struct LoadTrials {
  const StudyFile& study;
  const CalibrationTargets& targets;
  const StudyOptions& options;
  Timing& timing;
  Trial start{study.scene.scene.load};
  std::map<LoadNumbers, trace::BottomTrace> traces = {};
  std::string failure = {};

  /// Constants that meet the highest temperatures under the scene's load; false with `failure` where none do.
  bool find_start() {
    if (!run_all({start.load})) return false;
    surface::SkinModel model = surface::skin_model(study.scene.scene);
    CalibrationTargets highest = targets;
    highest.load_fitted = false;
    const CalibratedConstants found = calibrate(model, trace_of(start.load), highest);
    // An ignition temperature is found at the end, and what stands in its way here may be gone then.
    if (!std::isfinite(found.constants.localisation)) return fail(found.failure);
    start.localisation = found.constants.localisation;
    start.exchange_time = found.constants.exchange_time;
    return true;
  }

  /// With the unknowns given as logarithms of their ratios to those of the start.
  std::optional<std::vector<std::vector<double>>> misfits(const std::vector<std::vector<double>>& points) {
    std::vector<scene::Load> loads;
    for (const std::vector<double>& point : points) loads.push_back(trial_at(point).load);
    if (!run_all(loads)) return std::nullopt;
    std::vector<std::vector<double>> all;
    for (const std::vector<double>& point : points) all.push_back(misfits_of(trial_at(point)));
    return all;
  }

  /// Derivative of the misfits with respect to the pressure at the start, 1/Pa; empty where its run failed.
  std::vector<double> base_derivative(const math::NonlinearFit& fit) {
    Trial raised = trial_at(fit.unknowns);
    const double change = 2e-3 * raised.load.peak;
    raised.load.base += change;
    if (!run_all({raised.load})) return {};
    std::vector<double> derivative = misfits_of(raised);
    for (std::size_t i = 0; i < derivative.size(); ++i)
      derivative[i] = (derivative[i] - fit.residuals[i]) / change;
    return derivative;
  }

  Trial trial_at(const std::vector<double>& point) const {
    Trial trial = start;
    std::size_t next = 0;
    for (double* number : {&trial.load.peak_time, &trial.load.width, &trial.load.steepness,
                           &trial.localisation, &trial.exchange_time})
      *number *= std::exp(point[next++]);
    return trial;
  }

  bool fail(std::string why) {
    if (failure.empty()) failure = std::move(why);
    return false;
  }

  scene::Scene scene_under(const scene::Load& load) const {
    scene::Scene scene = study.scene.scene;
    scene.load = load;
    return scene;
  }

  const trace::BottomTrace& trace_of(const scene::Load& load) const { return traces.at(numbers_of(load)); }

  std::vector<double> misfits_of(const Trial& trial) const {
    surface::SkinModel model = surface::skin_model(study.scene.scene);
    model.surface.localisation = trial.localisation;
    model.surface.exchange_time = trial.exchange_time;
    return weighted_misfits(model, trace_of(trial.load), targets);
  }

  /// Runs those loads that were not run before.
  bool run_all(const std::vector<scene::Load>& loads) {
    if (stop_requested(options)) return fail("interrupted");
    std::map<LoadNumbers, scene::Load> untried;
    for (const scene::Load& load : loads)
      if (!traces.contains(numbers_of(load))) untried[numbers_of(load)] = load;
    std::vector<study::PlannedRun> runs;
    std::vector<scene::Load> tried;
    for (const auto& [numbers, load] : untried) {
      runs.push_back(planned_run(study::mechanics_run(scene_under(load), label_of(load))));
      tried.push_back(load);
    }
    std::vector<FinishedRun> finished(tried.size());
    study::ProgressTracker untold({});
    run_each(std::move(runs), options, untold, timing,
             [&](std::size_t i, const FinishedRun& run) { finished[i] = run; });
    for (std::size_t i = 0; i < tried.size(); ++i) {
      const FinishedRun& run = finished[i];
      if (!run.failure.empty())
        return fail(fmt::format("the run with its {}: {}", label_of(tried[i]), run.failure));
      traces[numbers_of(tried[i])] = trace::until(run.result.mechanics.trace, scene::read_time(tried[i]));
    }
    return true;
  }

  static std::string label_of(const scene::Load& load) {
    return fmt::format("peak at {:.6g} ms, width {:.6g} ms, steepness {:.6g}", 1e3 * load.peak_time,
                       1e3 * load.width, load.steepness);
  }
};

/// The fit in the words of the calibration.
void describe(FittedLoad& load, const math::NonlinearFit& fit, LoadTrials& trials) {
  load.bell = trials.trial_at(fit.unknowns).load;
  load.numbers = fit.residuals.size();
  load.sum_of_squares = fit.sum_of_squares();
  load.condition = fit.condition;
  const std::size_t left = load.numbers - fit.unknowns.size();
  const double variance = left == 0 ? 1.0 : std::max(1.0, load.sum_of_squares / static_cast<double>(left));
  load.covariance = fit.covariance;
  for (double& entry : load.covariance) entry *= variance;
  const std::vector<double> derivative = trials.base_derivative(fit);
  if (!derivative.empty()) load.base = math::add_unknown(fit, derivative);
}

}  // namespace

double FittedLoad::deviation(std::size_t i) const {
  return std::sqrt(covariance.at(i * fitted_keys.size() + i));
}

double FittedLoad::correlation(std::size_t i, std::size_t j) const {
  return covariance.at(i * fitted_keys.size() + j) / (deviation(i) * deviation(j));
}

std::string calibration_validity_warnings(const scene::Scene& scene, const run::MechanicsResult& mechanics) {
  std::vector<std::string> warnings = run::validity_warnings(scene, mechanics);
  for (const scene::Implausible& each : scene::implausible_values(scene)) {
    // What the calibration settles is no input to it.
    const bool settled = each.key == "kinetics.ignition_temperature" ||
                         std::ranges::find(fitted_keys, each.key) != fitted_keys.end();
    if (!each.accepted() && !settled) warnings.push_back(scene::validity_warning(each));
  }
  return warnings.empty() ? std::string{} : fmt::format("validity warning: {}", fmt::join(warnings, "; "));
}

FittedLoad fit_load(const StudyFile& study, const CalibrationTargets& targets, const StudyOptions& options,
                    Timing& timing) {
  LoadTrials trials{study, targets, options, timing};
  FittedLoad load;
  if (trials.find_start()) {
    const auto fit = math::fit_nonlinear([&](const auto& points) { return trials.misfits(points); },
                                         std::vector<double>(fitted_keys.size(), 0.0), difference_step);
    load.failure = text_of(fit);
    if (load.failure.empty()) describe(load, fit, trials);
  }
  if (!trials.failure.empty()) load.failure = trials.failure;
  load.runs = trials.traces.size();
  return load;
}

}  // namespace launchsafe::kinds
