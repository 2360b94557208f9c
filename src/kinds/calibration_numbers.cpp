// The fits of a calibration: constants on one trace, and the load with them.
#include "calibration_parts.hpp"

#include <boost/math/tools/toms748_solve.hpp>

namespace launchsafe::kinds {

using study::fitted_keys, study::Timing;

namespace {

constexpr double rate_window = 0.5e-3;  ///< s
constexpr double fast_share = 0.15;     ///< of the largest rate

/// Highest temperature of the stations at every sample, K.
std::vector<double> highest_temperatures(const surface::SkinHistory& history, const BottomTrace& trace) {
  std::vector<double> highest(history.time.size(), 0.0);
  const std::size_t stations = trace.stations.size();
  for (std::size_t sample = 0; sample < highest.size(); ++sample)
    for (std::size_t station = 0; station < stations; ++station)
      if (!trace.stations[station].observation)
        highest[sample] = std::max(highest[sample], history.temperature[sample * stations + station]);
  return highest;
}

/// Where the straight line between two samples meets a value.
double crossing(const std::vector<double>& time, const std::vector<double>& rate, std::size_t sample,
                double value) {
  const double share = (value - rate[sample]) / (rate[sample + 1] - rate[sample]);
  return time[sample] + share * (time[sample + 1] - time[sample]);
}

void add_misfits(std::vector<double>& misfits, const SkinModel& model, const BottomTrace& trace,
                 const Reference& row, double early_time) {
  const auto history = surface::integrate_skin(model, trace, row.gap);
  const FastRise rise = fast_rise(history, trace);
  const auto add = [&](double computed, double published, double weight) {
    if (std::isfinite(published)) misfits.push_back((computed - published) / weight);
  };
  add(surface::maximum_at_stations(history, trace).temperature, row.maximum_temperature, temperature_weight);
  add(surface::maximum_at_time(history, trace, early_time).temperature, row.early_temperature,
      temperature_weight);
  add(rise.begins, row.rise_begins, instant_weight);
  add(rise.ends, row.rise_ends, instant_weight);
}

constexpr double tightness = 1e-7;  ///< K, how well the fitted rows are met at least
constexpr int most_rounds = 8;      ///< of the two fits in turn

double maximum_at(const SkinModel& model, const BottomTrace& trace, double gap) {
  return surface::maximum_at_stations(surface::integrate_skin(model, trace, gap), trace).temperature;
}

double misfit_of(const SkinModel& model, const BottomTrace& trace, const Reference& row) {
  return maximum_at(model, trace, row.gap) - row.maximum_temperature;
}

/// Sets a constant to where a misfit, which changes sign once over the positive numbers, is 0, sought from
/// its value by factors of 2 both ways; false where that is nowhere.
bool solve(double& constant, const std::function<double()>& misfit) {
  struct End {
    double factor, x, value;
  };
  const auto misfit_at = [&](double value) {
    constant = value;
    return misfit();
  };
  const double start = constant, at_start = misfit_at(start);
  if (!std::isfinite(at_start) || at_start == 0.0) return at_start == 0.0;
  End ends[] = {{0.5, start, at_start}, {2.0, start, at_start}};
  for (int doubling = 0; doubling < 60; ++doubling)
    for (End& end : ends) {
      const End last = end;
      end.x *= end.factor;
      end.value = misfit_at(end.x);
      if (!(last.value * end.value <= 0.0)) continue;
      const auto& [low, high] = std::minmax(last, end, [](const End& a, const End& b) { return a.x < b.x; });
      std::uintmax_t iterations = 100;
      const auto [left, right] =
          boost::math::tools::toms748_solve(misfit_at, low.x, high.x, low.value, high.value,
                                            boost::math::tools::eps_tolerance<double>(46), iterations);
      constant = 0.5 * (left + right);
      return true;
    }
  return false;
}

/// Why a fit failed, a clause.
struct FitFailed {
  std::string why;
};

/// Alternates the two fits until both rows are met.
void fit_both(SkinModel& model, const BottomTrace& trace, const CalibrationTargets& targets) {
  for (int round = 0; round < most_rounds; ++round) {
    if (model.surface.localisation <= 0) model.surface.localisation = 100.0;
    if (!solve(model.surface.localisation, [&] { return misfit_of(model, trace, targets.zero_gap); }))
      throw FitFailed{
          fmt::format("no localisation gives {:.6g} K without a gap", targets.zero_gap.maximum_temperature)};
    if (!solve(model.surface.exchange_time, [&] { return misfit_of(model, trace, targets.wide_gap); }))
      throw FitFailed{fmt::format("no exchange time gives {:.6g} K at {:.6g} cm",
                                  targets.wide_gap.maximum_temperature, 100.0 * targets.wide_gap.gap)};
    if (std::abs(misfit_of(model, trace, targets.zero_gap)) <= tightness &&
        std::abs(misfit_of(model, trace, targets.wide_gap)) <= tightness)
      return;
  }
  throw FitFailed{"the two fits do not settle"};
}

/// Step of the forward differences, in the logarithms of the unknowns.
constexpr double difference_step = 5e-3;

/// Throws why a fit failed, where it did.
void check(const math::NonlinearFit& fit) {
  using enum math::FitFailure;
  const std::map<math::FitFailure, std::string> reasons{
      {too_few_residuals, "the rows have fewer numbers than are to be fitted"},
      {not_computable, "a number of the rows cannot be computed"},
      {singular, fmt::format("the numbers of the rows do not determine all that is fitted (condition {:.2g})",
                             fit.condition)},
      {does_not_settle, "the least-squares fit does not settle"}};
  if (fit.failure != none) throw FitFailed{reasons.at(fit.failure)};
}

/// Least squares of all numbers of the two rows from there on, with the load held.
void fit_all_numbers(SkinModel& model, const BottomTrace& trace, const CalibrationTargets& targets) {
  const scene::Surface start = model.surface;
  const auto set = [&](const std::vector<double>& logarithms) {
    model.surface.localisation = start.localisation * std::exp(logarithms[0]);
    model.surface.exchange_time = start.exchange_time * std::exp(logarithms[1]);
  };
  const auto misfits = [&](const std::vector<std::vector<double>>& points) {
    return std::optional(of_each(points, [&](const std::vector<double>& point) {
      set(point);
      return weighted_misfits(model, trace, targets);
    }));
  };
  const math::NonlinearFit fit = math::fit_nonlinear(misfits, {0.0, 0.0}, difference_step);
  check(fit);
  set(fit.unknowns);
}

/// Fills the result as far as the fit comes.
void fit_constants(SkinModel& model, const BottomTrace& trace, const CalibrationTargets& targets,
                   CalibratedConstants& result) {
  fit_both(model, trace, targets);
  if (targets.load_fitted) fit_all_numbers(model, trace, targets);
  result.constants.localisation = model.surface.localisation;
  result.constants.exchange_time = model.surface.exchange_time;
  result.ignition_lowest = maximum_at(model, trace, targets.safe_gap);
  result.ignition_highest = maximum_at(model, trace, targets.igniting_gap);
  if (!(result.ignition_lowest < result.ignition_highest))
    throw FitFailed{
        fmt::format("no ignition temperature separates {:.6g} K at {:.6g} cm from {:.6g} K at {:.6g} cm",
                    result.ignition_lowest, 100.0 * targets.safe_gap, result.ignition_highest,
                    100.0 * targets.igniting_gap)};
  constexpr double near = 1.0;  // K
  if (!(result.ignition_highest < model.kinetics.burnt_temperature - near))
    throw FitFailed{
        fmt::format("at {:.6g} cm the reaction runs away by itself, and the rows say of the ignition "
                    "temperature only that it is above {:.6g} K",
                    100.0 * targets.igniting_gap, result.ignition_lowest)};
  result.constants.ignition_temperature = 0.5 * (result.ignition_lowest + result.ignition_highest);
}

// --- the load ---

/// Tries loads with constants, each a scene, whose mechanics is run the first time that it is asked for.
struct LoadTrials {
  const StudyFile& study;
  const CalibrationTargets& targets;
  const StudyOptions& options;
  Timing& timing;
  Scene start = study.scene.scene;
  std::map<std::string, BottomTrace> traces = {};  ///< by the hash of their run

  /// Constants that meet the highest temperatures under the scene's load.
  void find_start() {
    run_all({start});
    CalibrationTargets highest = targets;
    highest.load_fitted = false;
    const CalibratedConstants found = calibrate(surface::skin_model(start), trace_of(start), highest);
    // An ignition temperature is found at the end, and what stands in its way here may be gone then.
    if (!std::isfinite(found.constants.localisation)) throw FitFailed{found.failure};
    start.surface.localisation = found.constants.localisation;
    start.surface.exchange_time = found.constants.exchange_time;
  }

  /// With the unknowns given as logarithms of their ratios to those of the start.
  std::vector<std::vector<double>> misfits(const std::vector<std::vector<double>>& points) {
    const auto trials = of_each(points, [&](const auto& point) { return trial_at(point); });
    run_all(trials);
    return of_each(trials, [&](const Scene& trial) { return misfits_of(trial); });
  }

  Scene trial_at(const std::vector<double>& point) const {
    Scene trial = start;
    for (std::size_t i = 0; i < fitted_keys.size(); ++i) {
      const auto& key = *scene::find_key(scene::scene_keys(), fitted_keys[i]);
      key.set(trial, std::get<double>(key.get(start)) * std::exp(point[i]));
    }
    return trial;
  }

  static study::CaseRun run_of(const Scene& trial) {
    const Load& load = trial.load;
    return study::mechanics_run(trial, fmt::format("peak at {:.6g} ms, width {:.6g} ms, steepness {:.6g}",
                                                   1e3 * load.peak_time, 1e3 * load.width, load.steepness));
  }

  const BottomTrace& trace_of(const Scene& trial) const { return traces.at(run_of(trial).hash); }

  std::vector<double> misfits_of(const Scene& trial) const {
    return weighted_misfits(surface::skin_model(trial), trace_of(trial), targets);
  }

  /// Runs those that were not run before.
  void run_all(const std::vector<Scene>& trials) {
    if (stop_requested(options)) throw FitFailed{"interrupted"};
    std::map<std::string, study::CaseRun> untried;
    for (study::CaseRun& run : of_each(trials, run_of))
      if (!traces.contains(run.hash)) untried.emplace(run.hash, std::move(run));
    const auto runs = of_each(untried, [](const auto& each) { return planned_run(each.second); });
    std::vector<FinishedRun> finished(runs.size());
    study::ProgressTracker untold({});
    run_each(runs, options, untold, timing,
             [&](std::size_t i, const FinishedRun& run) { finished[i] = run; });
    for (std::size_t i = 0; const auto& [hash, asked] : untried) {
      const FinishedRun& run = finished[i++];
      if (!run.failure.empty())
        throw FitFailed{fmt::format("the run with its {}: {}", asked.label, run.failure)};
      traces[hash] = trace::until(run.result.mechanics.trace, scene::read_time(asked.scene.load));
    }
  }
};

void describe(FittedLoad& load, const math::NonlinearFit& fit, LoadTrials& trials) {
  load.bell = trials.trial_at(fit.unknowns).load;
  load.numbers = fit.residuals.size();
  load.sum_of_squares = fit.sum_of_squares();
  load.condition = fit.condition;
  const std::size_t left = load.numbers - fit.unknowns.size();
  const double variance = left == 0 ? 1.0 : std::max(1.0, load.sum_of_squares / static_cast<double>(left));
  load.covariance = fit.covariance;
  for (double& entry : load.covariance) entry *= variance;
}

}  // namespace

FastRise fast_rise(const surface::SkinHistory& history, const BottomTrace& trace) {
  const std::vector<double> highest = highest_temperatures(history, trace);
  std::vector<double> time, rate;
  for (const double middle : history.time) {
    const double before = middle - 0.5 * rate_window, after = middle + 0.5 * rate_window;
    if (before < history.time.front() || after > history.time.back()) continue;
    time.push_back(middle);
    rate.push_back((trace::interpolate(history.time, highest, after) -
                    trace::interpolate(history.time, highest, before)) /
                   rate_window);
  }
  FastRise rise;
  if (rate.empty()) return rise;
  const double threshold = fast_share * *std::ranges::max_element(rate);
  const auto fast = [threshold](double value) { return value > threshold; };
  const auto first = std::ranges::find_if(rate, fast);
  if (first == rate.end()) return rise;
  const auto begin = static_cast<std::size_t>(first - rate.begin());
  const auto end =
      static_cast<std::size_t>(std::find_if(rate.rbegin(), rate.rend(), fast).base() - rate.begin());
  rise.begins = begin == 0 ? time.front() : crossing(time, rate, begin - 1, threshold);
  rise.unfinished = end == rate.size();
  rise.ends = rise.unfinished ? time.back() : crossing(time, rate, end - 1, threshold);
  return rise;
}

SkinModel untriggered(SkinModel model) {
  model.kinetics.ignition_temperature = model.kinetics.burnt_temperature;
  return model;
}

std::size_t fitted_numbers(const Reference& row) {
  const auto numbers = {row.maximum_temperature, row.early_temperature, row.rise_begins, row.rise_ends};
  return static_cast<std::size_t>(std::ranges::count_if(numbers, [](double x) { return std::isfinite(x); }));
}

std::vector<double> weighted_misfits(const SkinModel& model, const BottomTrace& trace,
                                     const CalibrationTargets& targets) {
  std::vector<double> misfits;
  for (const Reference* row : {&targets.zero_gap, &targets.wide_gap})
    add_misfits(misfits, untriggered(model), trace, *row, targets.early_time);
  return misfits;
}

void put(const SurfaceConstants& constants, scene::Surface& surface,
         materials::KineticsParameters& kinetics) {
  surface.localisation = constants.localisation;
  surface.exchange_time = constants.exchange_time;
  kinetics.ignition_temperature = constants.ignition_temperature;
}

CalibratedConstants calibrate(const SkinModel& given, const BottomTrace& trace,
                              const CalibrationTargets& targets) {
  CalibratedConstants result;
  SkinModel model = untriggered(given);
  try {
    fit_constants(model, trace, targets, result);
  } catch (const FitFailed& failed) {
    result.failure = failed.why;
  }
  return result;
}

std::string calibration_validity_warnings(const Scene& scene, const MechanicsResult& mechanics) {
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
  try {
    trials.find_start();
    const auto fit =
        math::fit_nonlinear([&](const auto& points) { return std::optional(trials.misfits(points)); },
                            std::vector<double>(fitted_keys.size(), 0.0), difference_step);
    check(fit);
    describe(load, fit, trials);
  } catch (const FitFailed& failed) {
    load.failure = failed.why;
  }
  load.runs = trials.traces.size();
  return load;
}

}  // namespace launchsafe::kinds
