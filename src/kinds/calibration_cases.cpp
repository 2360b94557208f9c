// A study of kind calibration as a file: its keys, its cases, and which published rows it fits to.
#include "calibration_parts.hpp"

namespace launchsafe::kinds {

using study::fitted_keys;

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
    flag_key("load_fitted", Standing::assumed,
             "Fit peak time, width and steepness of the load's bell too, with the constants by least "
             "squares, to the highest temperatures over the launch and at early_time (0.5 K) and to the two "
             "instants of the fast rise (0.5 ms) of the calibrated rows.",
             &CalibrationSettings::load_fitted),
    text_key("frozen_at", Standing::input,
             "Where rule and weights of the calibration were settled before its fit, for the report.",
             "1fd14b4", &CalibrationSettings::frozen_at),
};

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
  read_references(source, study);
  add_axis(study, "numerics.cell_size", "meshes", settings_of<CalibrationSettings>(study.study).meshes);
  calibration_targets(study);
  check_launch_of_rows(study);
  make_factorial(study);
  for (std::size_t i = 0; i < study.cases.size(); ++i)
    study.cases.relabel(i, fmt::format("{:.6g} mm", 1e3 * study.cases[i].cell_size()));
}

std::vector<Failure> failed_runs(const CalibrationResult& result) {
  std::vector<Failure> failures;
  for (const CalibrationRun& run : result.runs) add_failure(failures, run.input.label, run);
  return failures;
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
      .keys = joined({reference_keys(), own_keys(calibration_keys)}),
      .tables = {reference_table()},
      .make_cases = make_calibration_cases,
      .run = outcome_of<run_calibration, failed_runs>,
      .results = calibration_results,
  };
}

}  // namespace launchsafe::kinds
