// The fit of a calibration: launches with trial values, least squares, the ignition temperature, and what the
// launch with the constants gives for every published number.
#include "calibration_parts.hpp"

namespace launchsafe::kinds {
namespace {

/// Why there are no constants, a clause.
struct FitFailed {
  std::string why;
};

/// Step of the forward differences, in the logarithms of the unknowns.
constexpr double difference_step = 5e-3;

/// Residual of every number for values that no scene may have, such as a load that is over before the muzzle
/// exit: far from the published ones, so that the search turns back.
constexpr double impossible = 1e3;

/// A published number beside the computed one, which the fit uses.
struct WeightedNumber {
  FittedNumber number;
  double weight = 1;  ///< in its unit, standard deviation of the published one
  double residual() const { return number.misfit() / weight; }
};

/// Without the trigger: nothing happens at T1, and self-heating that runs away ends at T2.
SkinModel untriggered(SkinModel model) {
  model.kinetics.ignition_temperature = model.kinetics.burnt_temperature;
  return model;
}

/// K by which the station nearest to a published place is colder at a time (s) than the hottest one.
double place_misfit(const surface::SkinHistory& history, const BottomTrace& trace, const std::string& place,
                    double time) {
  const trace::Station* published = keys::find_named(trace.stations, place);
  if (published == nullptr) return not_a_number;
  double nearest = math::infinity, there = not_a_number;
  for (std::size_t station = 0; station < trace.stations.size(); ++station) {
    const trace::Station& each = trace.stations[station];
    if (each.observation || !(std::abs(each.r - published->r) < nearest)) continue;
    nearest = std::abs(each.r - published->r);
    there = surface::temperature_at_time(history, trace, station, time);
  }
  return surface::maximum_at_time(history, trace, time).temperature - there;
}

/// The published numbers of one row that the fit uses, without a trigger.
struct RowNumbers {
  const StudyFile& study;
  const Reference& row;
  const BottomTrace& trace;
  const surface::SkinHistory history;
  std::vector<WeightedNumber> all = {};

  void add(const std::string& quantity, double time, double published, double computed, double weight) {
    if (!std::isfinite(published)) return;
    const std::string name = quantity + " at " + report::milliseconds(time);
    all.push_back({{name, row.gap, published, computed, "K", true}, weight});
  }
  void add_temperatures(double end, double early) {
    const double weight = settings_of<CalibrationSettings>(study).temperature_weight;
    if (!row.ignited())
      add("T", end, row.maximum_temperature, surface::maximum_until(history, trace, end).temperature, weight);
    add("T", early, row.early_temperature, surface::maximum_at_time(history, trace, early).temperature,
        weight);
  }
  void add_field(double time, double spread, const std::string& place) {
    const auto& settings = settings_of<CalibrationSettings>(study);
    add("spread", time, spread, surface::spread_at_time(history, trace, time), settings.spread_weight);
    if (!place.empty())
      add("place", time, 0.0, place_misfit(history, trace, place, time), settings.place_weight);
  }
};

std::vector<WeightedNumber> fitted_numbers(const StudyFile& study, const Scene& scene,
                                           const BottomTrace& trace) {
  const double end = scene::read_time(scene.load), early = study.study.early_time;
  const SkinModel model = untriggered(surface::skin_model(scene));
  std::vector<WeightedNumber> all;
  for (const Reference& row : study.study.references) {
    RowNumbers numbers{study, row, trace, surface::integrate_skin(model, trace, row.gap)};
    numbers.add_temperatures(end, early);
    if (row.gap == 0.0) {
      numbers.add_field(end, row.spread, row.point);
      numbers.add_field(early, row.early_spread, row.early_point);
    }
    std::ranges::move(numbers.all, std::back_inserter(all));
  }
  return all;
}

/// Scenes with trial values, whose launches are run the first time that they are asked for.
struct Trials {
  const StudyOptions& options;
  CalibrationResult& result;
  study::ProgressTracker tracker{options.progress};
  std::map<std::string, FinishedRun> finished = {};  ///< by the hash of their run
  std::size_t count = 0;                             ///< numbers that are fitted; known from the start on

  scene::Expected<SceneFile> at(const std::vector<double>& logarithms) const {
    std::vector<scene::KeyChange> changes;
    for (std::size_t i = 0; i < logarithms.size(); ++i) {
      const FittedKey& key = result.fitted[i];
      changes.push_back({key.description.name, key.start * std::exp(logarithms[i]), {}});
    }
    return scene::caught([&] { return scene::with_keys(result.study.scene, changes); });
  }

  study::CaseRun run_of(const SceneFile& trial) const {
    std::vector<std::string> values;
    for (const FittedKey& key : result.fitted)
      values.push_back(key.name + " " +
                       scene::format_value(key.description, scene::value_in(trial, key.description.name)));
    return study::mechanics_run(trial.scene, fmt::format("{}", fmt::join(values, ", ")));
  }

  /// The run of a scene that was asked for.
  const FinishedRun& finished_run(const SceneFile& trial) const { return finished.at(run_of(trial).hash); }

  std::vector<std::vector<double>> residuals(const std::vector<std::vector<double>>& points) {
    const auto trials = of_each(points, [&](const auto& point) { return at(point); });
    std::vector<SceneFile> possible;
    for (const auto& trial : trials)
      if (trial) possible.push_back(*trial);
    run_all(possible);
    return of_each(trials, [&](const auto& trial) {
      return trial ? residuals_of(*trial) : std::vector<double>(count, impossible);
    });
  }

  std::vector<double> residuals_of(const SceneFile& trial) {
    const BottomTrace& trace = finished_run(trial).result.mechanics.trace;
    auto residuals = of_each(fitted_numbers(result.study, trial.scene, trace), &WeightedNumber::residual);
    count = residuals.size();
    return residuals;
  }

  /// Runs those that were not run before, all at once.
  void run_all(const std::vector<SceneFile>& trials) {
    std::vector<std::pair<study::CaseRun, const Scene*>> asked;
    for (const SceneFile& trial : trials)
      if (study::CaseRun run = run_of(trial); finished.try_emplace(run.hash).second)
        asked.emplace_back(std::move(run), &trial.scene);
    auto runs = of_each(asked, [](const auto& each) { return planned_run(each.first); });
    run_each(std::move(runs), options, tracker, result.timing, [&](std::size_t i, const FinishedRun& run) {
      FinishedRun& kept = finished.at(asked[i].first.hash);
      kept = run;
      kept.result.mechanics.snapshots.clear();
    });
    for (const auto& [run, scene] : asked) check(run, *scene);
  }

  /// Throws why a launch is no basis for constants.
  void check(const study::CaseRun& asked, const Scene& scene) {
    FinishedRun& run = finished.at(asked.hash);
    std::vector<std::string> warnings;
    if (run.failure.empty())
      for (const run::Warning& each : run::validity_warnings(scene, run.result.mechanics))
        if (!run::is_acceptable(each.name)) warnings.push_back(each.text);
    if (!warnings.empty()) run.failure = fmt::format("validity warning: {}", fmt::join(warnings, "; "));
    if (run.failure.empty()) return;
    result.label = asked.label;
    result.run = run;
    throw FitFailed{fmt::format("the launch with {}: {}", asked.label, run.failure)};
  }
};

/// Throws why a fit failed, where it did.
void check(const math::NonlinearFit& fit) {
  using enum math::FitFailure;
  const std::map<math::FitFailure, std::string> reasons{
      {too_few_residuals, "the rows have fewer numbers than are to be fitted"},
      {not_computable, "a number of the rows cannot be computed"},
      {singular,
       fmt::format("the rows do not determine all that is fitted (condition {:.2g})", fit.condition)},
      {does_not_settle, "the least-squares fit does not settle"}};
  if (fit.failure != none) throw FitFailed{reasons.at(fit.failure)};
}

/// The covariance of the logarithms. The weights count as standard deviations, and larger ones where the fit
/// leaves more than them.
std::vector<double> covariance_of(const math::NonlinearFit& fit) {
  const std::size_t left = fit.residuals.size() - fit.unknowns.size();
  const double variance = left == 0 ? 1.0 : std::max(1.0, fit.sum_of_squares() / static_cast<double>(left));
  std::vector<double> covariance = fit.covariance;
  for (double& entry : covariance) entry *= variance;
  return covariance;
}

/// Sets the temperatures between which the ignition temperature lies; throws where there is none between.
void bracket_ignition(const StudyFile& study, const Scene& scene, const BottomTrace& trace,
                      Constants& constants) {
  const Reference &safe = largest_safe(study), &igniting = smallest_igniting(study);
  const SkinModel model = untriggered(surface::skin_model(scene));
  const auto history_of = [&](const Reference& row) {
    return surface::integrate_skin(model, trace, row.gap);
  };
  const double lowest = surface::maximum_at_stations(history_of(safe), trace).temperature;
  const double highest =
      surface::maximum_at_time(history_of(igniting), trace, igniting.ignition_time).temperature;
  constexpr double near = 1.0;  // K; at T2 the reaction has run away by itself
  if (!(lowest < highest && highest < model.kinetics.burnt_temperature - near))
    throw FitFailed{
        fmt::format("no ignition temperature separates {:.6g} K, the highest at {}, from {:.6g} K at {} "
                    "when that ignited",
                    lowest, report::centimetres(safe.gap), highest, report::centimetres(igniting.gap))};
  constants.ignition_lowest = lowest;
  constants.ignition_highest = highest;
}

/// How the faces of the charge are held, by face.
void add_faces(const SceneFile& file, std::map<std::string, Value>& values) {
  for (const std::string face : {"interface.front", "interface.side", "interface.bottom"}) {
    const std::string condition = face + ".condition", friction = face + ".friction";
    const std::string in_scene = scene::key_in_scene(file.scene, condition);
    if (in_scene.empty()) continue;
    values[condition] = scene::value_in(file, in_scene);
    if (values[condition] == Value(std::string("sliding")))
      values[friction] = scene::value_in(file, scene::key_in_scene(file.scene, friction));
  }
}

std::map<std::string, Value> values_of(const SceneFile& file, const std::vector<FittedKey>& fitted) {
  std::map<std::string, Value> values;
  for (const std::string& name : constant_keys()) {
    // A measured curve takes the place of the load's numbers.
    const auto& is_replaced = scene::find_key(scene::scene_keys(), name)->is_replaced;
    if (!is_replaced || !is_replaced(file.scene)) values[name] = scene::value_in(file, name);
  }
  add_faces(file, values);
  for (const FittedKey& key : fitted) values[key.name] = scene::value_in(file, key.description.name);
  return values;
}

/// Highest temperature (K) of the stations at every sample.
std::vector<double> highest_temperatures(const surface::SkinHistory& history, const BottomTrace& trace) {
  std::vector<double> highest(history.time.size(), 0.0);
  const std::size_t stations = trace.stations.size();
  for (std::size_t sample = 0; sample < highest.size(); ++sample)
    for (std::size_t station = 0; station < stations; ++station)
      if (!trace.stations[station].observation)
        highest[sample] = std::max(highest[sample], history.temperature[sample * stations + station]);
  return highest;
}

/// Instants (s) between which the highest temperature rises fast: its rate, over half a millisecond, is more
/// than 15 % of its largest. NaN where it has no rate.
std::pair<double, double> fast_rise(const surface::SkinHistory& history, const BottomTrace& trace) {
  constexpr double window = 0.5e-3, fast_share = 0.15;  // s
  const std::vector<double> highest = highest_temperatures(history, trace);
  const auto rate_at = [&](double time) {
    return trace::interpolate(history.time, highest, time + 0.5 * window) -
           trace::interpolate(history.time, highest, time - 0.5 * window);
  };
  std::vector<double> times = history.time;
  std::erase_if(times, [&](double time) {
    return time - 0.5 * window < history.time.front() || time + 0.5 * window > history.time.back();
  });
  if (times.empty()) return {not_a_number, not_a_number};
  const std::vector<double> rates = of_each(times, rate_at);
  const double threshold = fast_share * std::ranges::max(rates);
  const auto crossing = [&](std::size_t below, std::size_t above) {
    const double share = (threshold - rates[below]) / (rates[above] - rates[below]);
    return times[below] + share * (times[above] - times[below]);
  };
  std::size_t first = 0, last = times.size() - 1;
  while (rates[first] < threshold) ++first;
  while (rates[last] < threshold) --last;
  return {first == 0 ? times[0] : crossing(first - 1, first),
          last + 1 == times.size() ? times[last] : crossing(last + 1, last)};
}

/// Published instants between which the temperature rises fast, beside the computed ones without a trigger.
void add_instants(const StudyFile& study, const Scene& scene, const BottomTrace& trace,
                  std::vector<FittedNumber>& numbers) {
  const SkinModel model = untriggered(surface::skin_model(scene));
  for (const Reference& row : study.study.references) {
    const auto [begins, ends] = fast_rise(surface::integrate_skin(model, trace, row.gap), trace);
    if (std::isfinite(row.rise_begins))
      numbers.push_back({"fast rise begins", row.gap, 1e3 * row.rise_begins, 1e3 * begins, "ms"});
    if (std::isfinite(row.rise_ends))
      numbers.push_back({"fast rise ends", row.gap, 1e3 * row.rise_ends, 1e3 * ends, "ms"});
  }
}

/// Numbers that the fit did not use: of the launch with the constants and the trigger, at the two gaps around
/// the published critical one.
std::vector<FittedNumber> checked_numbers(const StudyFile& study, const Scene& scene,
                                          const BottomTrace& trace) {
  const SkinModel model = surface::skin_model(scene);
  const Reference &safe = largest_safe(study), &igniting = smallest_igniting(study);
  const auto below = surface::integrate_skin(model, trace, safe.gap);
  const auto above = surface::integrate_skin(model, trace, igniting.gap);
  const double time = above.ignition ? above.ignition->time : trace.time.back();
  const double largest = below.ignition ? model.kinetics.burnt_temperature
                                        : surface::maximum_at_stations(below, trace).temperature;
  std::vector<FittedNumber> numbers{
      {"ignition time", igniting.gap, 1e3 * igniting.ignition_time, 1e3 * time, "ms"},
      {"largest T", safe.gap, safe.maximum_temperature, largest, "K"}};
  add_instants(study, scene, trace, numbers);
  return numbers;
}

/// The constants of a fit that settled; `trial`: the scene with its values.
Constants constants_of(const CalibrationResult& result, const SceneFile& trial) {
  const StudyFile& study = result.study;
  const BottomTrace& trace = result.run.result.mechanics.trace;
  const auto& settings = settings_of<CalibrationSettings>(study);
  Constants constants{.name = settings.file,
                      .title = study.study.title,
                      .command = report::remaking_command(study),
                      .model_version = scene::model_version};
  bracket_ignition(study, trial.scene, trace, constants);
  const double middle = 0.5 * (constants.ignition_lowest + constants.ignition_highest);
  const SceneFile file = scene::with_keys(trial, {{"kinetics.ignition_temperature", middle, {}}});
  constants.values = values_of(file, result.fitted);
  constants.fitted_keys = of_each(result.fitted, &FittedKey::name);
  constants.covariance = covariance_of(result.fit);
  constants.rows = of_each(fitted_numbers(study, file.scene, trace), &WeightedNumber::number);
  std::ranges::move(checked_numbers(study, file.scene, trace), std::back_inserter(constants.rows));
  constants.range = settings.range;
  std::erase_if(constants.range, [](const auto& interval) { return interval.second.empty(); });
  constants.scene = file.scene;
  return constants;
}

void calibrate(CalibrationResult& result, const StudyOptions& options) {
  if (options.shard.index > 1) return;  // a fit cannot be divided: the first shard makes it
  Trials trials{options, result};
  result.fitted = keys_to_fit(result.study);
  try {
    result.fit =
        math::fit_nonlinear([&](const auto& points) { return std::optional(trials.residuals(points)); },
                            std::vector<double>(result.fitted.size(), 0.0), difference_step);
    check(result.fit);
    const SceneFile trial = trials.at(result.fit.unknowns).or_throw();
    result.label = trials.run_of(trial).label;
    result.run = trials.finished_run(trial);
    result.constants = constants_of(result, trial);
  } catch (const FitFailed& failed) {
    result.failure = failed.why;
  } catch (const scene::InputError& error) {
    result.failure = "the fit came to a scene that cannot be: " + error.message();
  }
}

}  // namespace

const std::vector<std::string>& constant_keys() {
  static const std::vector<std::string> keys{
      "friction.closure",   "friction.localisation", "gap.exchange_time",
      "gap.skin_thickness", "gap.air_specific_heat", "gap.air_heat_ratio",
      "station.width",      "station.depth",         "kinetics.ignition_temperature",
      "load.shape",         "load.peak_time",        "load.width",
      "load.steepness",     "steel.yield_stress"};
  return keys;
}

CalibrationResult run_calibration(const StudyFile& study, const StudyOptions& options) {
  return run_timed<CalibrationResult>(study, options,
                                      [&](CalibrationResult& result) { calibrate(result, options); });
}

}  // namespace launchsafe::kinds
