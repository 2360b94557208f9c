// A study of kind calibration as a file: its keys, its cases, and which published rows it fits to.
#include "calibration_parts.hpp"

namespace launchsafe::kinds {

using study::Firing, study::fitted_keys;

namespace {

[[noreturn]] void refuse_rows(const StudyFile& study, std::string found, std::string allowed) {
  const char* at = study.places.contains("reference.0.gap") ? "reference.0.gap" : "kind";
  throw error_at(place_of_key(study, at), "reference", std::move(found), std::move(allowed));
}

/// What a fit of the load needs besides: a bell, and no fewer numbers than unknowns.
void check_fit_of_load(const StudyFile& study, const CalibrationTargets& targets) {
  constexpr const char* key = "load_fitted";
  const Load& load = study.scene.scene.load;
  const bool is_measured = !load.curve_time.empty();
  if (is_measured || load.shape != scene::LoadShape::bell)
    refuse_at(study, key,
              is_measured ? "a measured curve" : fmt::format("a load of shape \"{}\"", word_of(load.shape)),
              "load.shape = \"bell\" without load.curve, whose peak time, width and steepness are fitted");
  const std::size_t numbers = fitted_numbers(targets.zero_gap) + fitted_numbers(targets.wide_gap);
  if (numbers < fitted_keys.size())
    refuse_at(study, key,
              fmt::format("{} numbers in the calibrated rows for {} unknowns", numbers, fitted_keys.size()),
              "no fewer of maximum_temperature, early_temperature, rise_begins and rise_ends in both rows "
              "together");
}

const std::vector<Key<CalibrationSettings>> calibration_keys{
    list_key("meshes", Dimension::length, between(1e-5, 1), Standing::assumed,
             "Cell sizes, each a mechanical run; the scene's if absent.", &CalibrationSettings::meshes),
    flag_key("compare_kinetics", Standing::assumed,
             "Calibrate with every named kinetics rather than with the scene's alone.",
             &CalibrationSettings::compare_kinetics),
    range_key("ignition_bracket", Dimension::temperature, between(0, 5000), Standing::paper,
              "Published bracket of the ignition temperature, a check on the calibrated one.",
              &CalibrationSettings::ignition_lowest, &CalibrationSettings::ignition_highest),
    flag_key("load_fitted", Standing::assumed,
             "Fit peak time, width and steepness of the load's bell too, with the constants by least "
             "squares, to the highest temperatures over the launch and at early_time (0.5 K) and to the two "
             "instants of the fast rise (0.5 ms) of the calibrated rows.",
             &CalibrationSettings::load_fitted),
    text_key("frozen_at", Standing::input,
             "Where rule and weights of the calibration were settled before its fit, for the report.",
             "1fd14b4", &CalibrationSettings::frozen_at),
};

const std::vector<Firing>& firings_of(const StudyFile& study) {
  return settings_of<CalibrationSettings>(study).firings.firings;
}

const std::vector<Key<Firing>> firing_row_keys{
    text_key("name", Standing::input, "What the rounds are called.", "series of March", &Firing::name),
    word_key("outcome", Standing::input, "How the rounds ended, all of them.",
             {{"no ignition", false}, {"ignition", true}}, &Firing::ignited) |
        required(),
    number_key("rounds", Dimension::count, between(1, study::most_rounds), Standing::input,
               "How many rounds.", &Firing::rounds),
    number_key("pressure", Dimension::pressure, above_to(0, 10e9), Standing::input,
               "Their mean peak pressure.", &Firing::pressure) |
        usually("that of the scene file"),
    number_key("pressure_spread", Dimension::pressure, between(0, 1e9), Standing::input,
               "Its standard deviation from round to round.", &Firing::pressure_spread) |
        usually("2 % of it"),
    number_key("temperature", Dimension::temperature, between(200, 400), Standing::input,
               "Mean temperature of charge and air.", &Firing::temperature) |
        usually("that of the scene file"),
    number_key("temperature_spread", Dimension::temperature_difference, between(0, 100), Standing::input,
               "Its standard deviation from round to round.", &Firing::temperature_spread) |
        usually("6 K"),
    range_key("gap", Dimension::length, between(0, 0.01), Standing::input,
              "The gap of the rounds, or between which lengths it was; then the smaller counts.",
              &Firing::gap, &Firing::most_gap) |
        scene::value_or_range() | required(),
};

/// What a firing leaves out is as the scene file states it, or a spread that is assumed. Neither [set] nor a
/// default tells how rounds were fired. The peak of a measured curve is its own, unless it is scaled.
void complete(Firing& firing, const StudyFile& study, std::size_t place) {
  const SceneFile& file = study.scene;
  const Load& load = file.scene.load;
  const auto fill = [&](double& number, double usual, const char* name = "", const char* key = "") {
    if (!std::isnan(number)) return;
    number = usual;
    if (*key && !(file.given.contains(key) && scene::place_of_key(file, key).file == file.file))
      throw error_at(place_of_key(study, fmt::format("firing.{}.gap", place)), fmt::format("firing.{}", name),
                     fmt::format("nothing, and {} is of [set] or a default", key),
                     fmt::format("{} in [[firing]], or {} in the scene file alone", name, key));
  };
  const char* const of_curve = load.curve_file.empty() ? "load.curve_pressure" : "load.curve";
  const bool has_own_peak = !load.curve_time.empty() && !load.rescale_to_peak;
  const double peak = study::fired_pressure(load);
  fill(firing.pressure, peak, "pressure", has_own_peak ? of_curve : "load.peak");
  if (has_own_peak && !study::same_number(firing.pressure, peak))
    refuse_at(study, fmt::format("firing.{}.pressure", place),
              fmt::format("{} beside a measured curve with a peak of {}",
                          format_quantity(firing.pressure, Dimension::pressure),
                          format_quantity(peak, Dimension::pressure)),
              "that of the curve, or load.rescale_to_peak = true in the scene");
  fill(firing.pressure_spread, study::assumed_load_spread / study::coverage_factor * firing.pressure);
  fill(firing.temperature, file.scene.initial_temperature, "temperature", "initial_temperature");
  fill(firing.temperature_spread, study::assumed_temperature_spread / study::coverage_factor);
}

SceneFile scene_of(const StudyFile& study, const Firing& firing, std::size_t place) {
  const Scene& own = study.scene.scene;
  std::vector<Change> changes;
  for (const auto& [key, of_firing, value, in_scene] :
       {std::tuple{"load.peak", "pressure", firing.pressure, study::fired_pressure(own.load)},
        {"initial_temperature", "temperature", firing.temperature, own.initial_temperature}}) {
    if (study::same_number(value, in_scene)) continue;
    const std::string named = fmt::format("firing.{}.{}", place, of_firing);
    changes.push_back({key, value, place_of_key(study, named), named});
  }
  return taken(study::with_changes(study.scene, changes));
}

/// Rounds that are listed twice would prove twice as much.
void check_counted_once(const StudyFile& study, const std::vector<Firing>& firings, std::size_t place) {
  if (std::ranges::count(firings.begin(), firings.begin() + place + 1, firings[place]) > 1)
    refuse_at(study, fmt::format("firing.{}.gap", place), "the same firing a second time",
              "each series of rounds once; two that are alike in all else have a name each");
}

std::vector<Key<Study>> firing_keys() {
  const std::vector<Key<FiringSettings>> keys{
      number_key("prior.localisation", Dimension::number, between(1.5, 4), Standing::assumed,
                 "With firings: by which factor the localisation may be more or less than the calibration's, "
                 "one standard deviation.",
                 &FiringSettings::localisation_factor),
      number_key("prior.exchange_time", Dimension::number, between(2, 4), Standing::assumed,
                 "The same of the exchange time.", &FiringSettings::exchange_time_factor),
      number_key("prior.ignition_temperature", Dimension::temperature_difference, between(30, 40),
                 Standing::assumed, "Likewise by how much the ignition temperature may be more or less.",
                 &FiringSettings::ignition_temperature),
      number_key("prior.scatter", Dimension::number, between(0.05, 0.5), Standing::assumed,
                 "By which share the heat of rounds that are fired alike differs, one standard deviation, at "
                 "a guess.",
                 &FiringSettings::scatter),
      list_key("next_gaps", Dimension::length, between(0, 0.01), Standing::assumed,
               "Gaps among which the round that would tell most is sought; if absent half of, one, one and a "
               "half and two times the largest that was fired.",
               &FiringSettings::next_gaps)};
  return own_keys(keys::keys_of_part("", &CalibrationSettings::firings, keys));
}

void read_firings(const toml::table& root, StudyFile& study) {
  std::vector<Firing>& firings = settings_of<CalibrationSettings>(study.study).firings.firings;
  study::read_rows(root, "firing", firing_row_keys, study.file, study, firings);
  for (std::size_t place = 0; place < firings.size(); ++place) {
    complete(firings[place], study, place);
    check_counted_once(study, firings, place);
  }
  for (std::size_t place = 0; place < firings.size(); ++place)
    if (firings[place].name.empty()) firings[place].name = fmt::format("those of [[firing]] {}", place + 1);
}

void make_firing_cases(StudyFile& study) {
  const std::vector<Firing>& firings = firings_of(study);
  const std::vector<std::size_t> conditions = conditions_of(firings);
  for (std::size_t i = 0; i < firings.size(); ++i)
    if (conditions[i] >= study.cases.size())
      study.cases.add(
          study::case_of(fmt::format("{}, {}", format_quantity(firings[i].pressure, Dimension::pressure),
                                     format_quantity(firings[i].temperature, Dimension::temperature)),
                         scene_of(study, firings[i], i)));
}

/// Firings stand alone, with what is only of them. They start from a calibration on published results: about
/// constants at a guess a few rounds would seem to prove what nobody has shown.
void check_firings(const StudyFile& study) {
  const bool any = !firings_of(study).empty();
  if (any && !study.places.contains("calibration"))
    refuse_at(
        study, "firing.0.gap", "[[firing]] without calibration",
        "calibration = \"...\", the record of a calibration on published results, about whose constants "
        "those of the firings are sought");
  for (const auto& [key, place] : study.places) {
    const bool of_firings = key.starts_with("prior.") || key == "next_gaps" || key == "calibration";
    const bool of_rows = key.starts_with("reference") || key == "meshes" || key == "load_fitted" ||
                         key == "compare_kinetics" || key == "ignition_bracket";
    if (any ? of_rows : of_firings)
      refuse_at(study, key,
                any ? "a key of published rows beside [[firing]]" : "a key of firings without [[firing]]",
                any ? "either [[firing]] or published rows" : "at least one [[firing]]");
  }
  if (!any) return;
  for (const scene::Implausible& each : scene::implausible_values(study.scene.scene))
    if (scene::role_of(each.key).part == keys::Part::calibrated)
      refuse_at(study, "calibration", validity_warning(each),
                "a record of plausible constants, about which those of the firings are sought");
}

/// Constants that were fitted to the rows of another launch would pass as those of this one. A model of the
/// launch is free, and what is fitted.
void check_launch_of_rows(const StudyFile& study) {
  using enum keys::Part;
  const bool load_fitted = settings_of<CalibrationSettings>(study).load_fitted;
  for (std::size_t i = 0; i < study.study.references.size(); ++i) {
    const std::string& name = study.study.references[i].scene;
    if (name.empty()) refuse_rows(study, "a row without scene", "the scene of its launch in each row");
    const Place place = place_of_key(study, fmt::format("reference.{}.scene", i));
    const auto folder = std::filesystem::path(place.file).parent_path();
    const Scene of_row =
        taken(scene::read_scene(scene::named_file(folder, name, place, "reference.scene", "a scene file")))
            .scene;
    for (const study::Difference& each : study::differences(study.scene.scene, of_row)) {
      const keys::Part part = each.key.role().part;
      const bool is_fitted = load_fitted && std::ranges::count(fitted_keys, each.key.name) > 0;
      if (part == constant || part == range || (part == load_shape && !is_fitted))
        throw error_at(place, "reference.scene",
                       fmt::format("\"{}\" with {} = {}, and {} in the scene of the study", name,
                                   each.key.name, scene::format_value(each.key, each.recorded),
                                   scene::format_value(each.key, each.value)),
                       "rows of the launch that is calibrated, or a scene of theirs in the study");
    }
  }
}

void make_calibration_cases(const StudySource& source, StudyFile& study) {
  read_firings(source.root, study);
  check_firings(study);
  read_references(source, study);
  add_axis(study, "numerics.cell_size", "meshes", settings_of<CalibrationSettings>(study.study).meshes);
  if (!firings_of(study).empty()) return make_firing_cases(study);
  calibration_targets(study);
  check_launch_of_rows(study);
  make_factorial(study);
  for (std::size_t i = 0; i < study.cases.size(); ++i)
    study.cases.relabel(i, fmt::format("{:.6g} mm", 1e3 * study.cases[i].cell_size()));
}

/// Of the launches that a result has in `runs`.
template <class Result, std::vector<CalibrationRun> Result::*runs>
std::vector<Failure> failed_runs(const Result& result) {
  std::vector<Failure> failures;
  for (const CalibrationRun& run : result.*runs) add_failure(failures, run.input.label, run);
  return failures;
}

StudyOutcome run(const StudyFile& study, const StudyOptions& options) {
  if (!firings_of(study).empty())
    return outcome_of<run_firings, failed_runs<FiringResult, &FiringResult::conditions>>(study, options);
  return outcome_of<run_calibration, failed_runs<CalibrationResult, &CalibrationResult::runs>>(study,
                                                                                               options);
}

}  // namespace

CalibrationTargets calibration_targets(const StudyFile& study) {
  CalibrationTargets targets;
  double safe = -1.0, igniting = 1e300;
  int zero = 0, wide = 0;
  for (const Reference& row : study.study.references) {
    if (row.ignited()) {
      igniting = std::min(igniting, row.gap);
      continue;
    }
    safe = std::max(safe, row.gap);
    if (!row.calibrated) continue;
    const bool is_zero = row.gap == 0.0;
    ++(is_zero ? zero : wide);
    (is_zero ? targets.zero_gap : targets.wide_gap) = row;
    if (!std::isfinite(row.maximum_temperature))
      refuse_rows(study, "a calibrated row without maximum_temperature", "one with it");
  }
  if (zero != 1 || wide != 1)
    refuse_rows(study, fmt::format("{} calibrated rows at gap 0 and {} at other gaps", zero, wide),
                "one calibrated row at gap 0 (sets the localisation) and one at another gap that does not "
                "ignite (sets the exchange time)");
  if (igniting > 1.0 || !(safe < igniting))
    refuse_rows(study, igniting > 1.0 ? "no row that ignites" : "a row that ignites below one that does not",
                "rows with an ignition_time, all at larger gaps than the rows without");
  targets.safe_gap = safe;
  targets.igniting_gap = igniting;
  targets.load_fitted = settings_of<CalibrationSettings>(study).load_fitted;
  targets.early_time = study.study.early_time;
  if (targets.load_fitted) check_fit_of_load(study, targets);
  return targets;
}

Kind calibration_kind() {
  return {
      .traits = {.name = "calibration",
                 .judges_gaps = false,
                 .gives_verdicts = false,
                 .bounds_critical_gaps = false},
      .keys =
          joined({reference_keys(), calibration_record_keys(), own_keys(calibration_keys), firing_keys()}),
      .tables = {reference_table(), study_table_of("firing", firing_row_keys)},
      .make_cases = make_calibration_cases,
      .run = run,
      .files = {"calibration.json"},
      .results = calibration_results,
  };
}

study::FiringPrior FiringSettings::prior_about(const SurfaceConstants& centre) const {
  return {.centre = centre,
          .log_localisation = std::log(localisation_factor),
          .log_exchange_time = std::log(exchange_time_factor),
          .ignition_temperature = ignition_temperature,
          .scatter = scatter};
}

std::vector<std::size_t> conditions_of(const std::vector<Firing>& firings) {
  std::map<std::pair<double, double>, std::size_t> places;
  return of_each(firings, [&](const Firing& each) {
    return places.try_emplace({each.pressure, each.temperature}, places.size()).first->second;
  });
}

}  // namespace launchsafe::kinds
