#include "calibration_load.hpp"

#include "launchsafe/run/validity_warnings.hpp"
#include "launchsafe/scene/load_shape.hpp"
#include "launchsafe/scene/plausibility.hpp"
#include "launchsafe/study/run_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

constexpr double close_enough = 1e-3;  ///< K, of the early temperature
constexpr int most_loads = 40;
constexpr double first_stride = 0.06;  ///< of the peak time, in search of a bracket

scene::SceneFile with_shape(const scene::SceneFile& scene, double peak_time, double exponent) {
  scene::SceneFile changed = scene;
  changed.scene.load.peak_time = peak_time;
  changed.scene.load.exponent = exponent;
  return changed;
}

/// Tries loads of one peak time after another.
class LoadTrial {
 public:
  LoadTrial(const StudyFile& study, const CalibrationTargets& targets, const StudyOptions& options,
            Timing& timing)
      : study_(study), targets_(targets), options_(options), timing_(timing) {}

  /// The early temperature without a gap minus the published one, K; NaN with `failure` where there is none.
  double misfit(double peak_time) {
    result.peak_time = peak_time;
    result.early_misfit = not_a_number;
    const std::vector<double>& rise = settings_of<CalibrationSettings>(study_.study).fast_rise;
    const auto exponent = scene::exponent_for(peak_time, rise[1] - rise[0]);
    if (!exponent)
      return fail(fmt::format("no exponent makes a load with its peak at {:.4g} ms rise fast for {:.4g} ms",
                              1e3 * peak_time, 1e3 * (rise[1] - rise[0])));
    if (stop_requested(options_)) return fail("interrupted");
    if (++tried_ > most_loads) return fail("the search for a peak time does not settle");
    result.exponent = *exponent;
    result.turning = scene::turning_times(peak_time, *exponent);
    const scene::Scene scene = with_shape(study_.scene, peak_time, *exponent).scene;
    const FinishedRun run = run_with(scene);
    const run::MechanicsResult& mechanics = run.result.mechanics;
    if (!run.failure.empty())
      return fail(fmt::format("the run with its peak at {:.4g} ms: {}", 1e3 * peak_time, run.failure));
    if (std::string warnings = calibration_validity_warnings(scene, mechanics); !warnings.empty())
      return fail(std::move(warnings));
    return misfit_of(mechanics.trace, scene);
  }

  FittedLoad result;

 private:
  double fail(std::string why) {
    if (result.failure.empty()) result.failure = std::move(why);
    return not_a_number;
  }

  /// With all cores: one run after the other.
  FinishedRun run_with(const scene::Scene& scene) {
    CaseRuns trial{{},
                   {mechanics_run(scene, fmt::format("peak at {:.6g} ms", 1e3 * scene.load.peak_time))},
                   options_.shard.index};
    FinishedRun finished;
    ProgressTracker untold({});
    run_cases({trial}, options_, untold, timing_,
              [&](std::size_t, std::vector<FinishedRun>& runs) { finished = std::move(runs.front()); });
    return finished;
  }

  double misfit_of(const trace::BottomTrace& trace, const scene::Scene& scene) {
    surface::SkinModel model = surface::skin_model(scene);
    const CalibratedConstants fitted = calibrate(model, trace, targets_);
    if (!fitted.failure.empty()) return fail(fitted.failure);
    fitted.constants.put_into(model.surface, model.kinetics);
    const auto history = surface::integrate_skin(model, trace, targets_.zero_gap.gap);
    const double early = surface::maximum_at_time(history, trace, study_.study.early_time).temperature;
    result.early_misfit = early - targets_.zero_gap.early_temperature;
    return result.early_misfit;
  }

  const StudyFile& study_;
  const CalibrationTargets& targets_;
  const StudyOptions& options_;
  Timing& timing_;
  int tried_ = 0;
};

struct Tried {
  double peak_time = 0;  ///< s
  double misfit = 0;     ///< K
};

/// A later peak leaves less heat by the early instant: strides towards the other sign.
bool find_bracket(LoadTrial& trial, Tried& early, Tried& late) {
  double stride = first_stride;
  while (early.misfit * late.misfit > 0.0) {
    const bool later = late.misfit > 0.0;
    const double next = later ? late.peak_time * (1.0 + stride) : early.peak_time * (1.0 - stride);
    const double misfit = trial.misfit(next);
    if (std::isnan(misfit)) return false;
    if (later) {
      early = late;
      late = {next, misfit};
    } else {
      late = early;
      early = {next, misfit};
    }
    stride *= 1.5;
  }
  return true;
}

/// The Illinois variant of regula falsi: a mechanical run a step, and none of them far from the root.
void close_in(LoadTrial& trial, Tried early, Tried late) {
  int side = 0;
  while (!(std::abs(trial.result.early_misfit) <= close_enough)) {
    const double next =
        (early.peak_time * late.misfit - late.peak_time * early.misfit) / (late.misfit - early.misfit);
    const double misfit = trial.misfit(next);
    if (std::isnan(misfit)) return;
    if (misfit * late.misfit > 0.0) {
      late = {next, misfit};
      if (side == 1) early.misfit *= 0.5;
      side = 1;
    } else {
      early = {next, misfit};
      if (side == -1) late.misfit *= 0.5;
      side = -1;
    }
  }
}

}  // namespace

std::string calibration_validity_warnings(const scene::Scene& scene, const run::MechanicsResult& mechanics) {
  std::vector<std::string> warnings = run::validity_warnings(scene, mechanics);
  for (const scene::Implausible& each : scene::implausible_values(scene)) {
    // What the calibration settles is no input to it.
    constexpr std::array settled{"friction.localisation", "gap.exchange_time",
                                 "kinetics.ignition_temperature", "load.peak_time", "load.exponent"};
    if (!each.accepted() && std::find(settled.begin(), settled.end(), each.key) == settled.end())
      warnings.push_back(scene::validity_warning(each));
  }
  return warnings.empty() ? std::string{} : fmt::format("validity warning: {}", fmt::join(warnings, "; "));
}

FittedLoad fit_load(const StudyFile& study, const CalibrationTargets& targets, const StudyOptions& options,
                    Timing& timing) {
  LoadTrial trial(study, targets, options, timing);
  const double start = study.scene.scene.load.peak_time;
  const double at_start = trial.misfit(start);
  if (!std::isnan(at_start) && std::abs(at_start) > close_enough) {
    Tried early{start, at_start}, late = early;
    if (find_bracket(trial, early, late)) close_in(trial, early, late);
  }
  return trial.result;
}

scene::SceneFile with_load(const scene::SceneFile& scene, const FittedLoad& load) {
  return with_shape(scene, load.peak_time, load.exponent);
}

}  // namespace launchsafe::kinds
