// A study of kind calibration as a file: its keys, its cases, and which published rows it fits to.
#include "answer_tables.hpp"
#include "calibration_parts.hpp"
#include "launchsafe/kinds/calibration.hpp"
#include "launchsafe/study/study_cases.hpp"
#include "study_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using study::Fault, study::fitted_keys, study::StudyFile;

namespace {

scene::InputError missing(const StudyFile& study, std::string found, std::string allowed) {
  const auto first = study.places.find("reference.0.gap");
  const auto kind = study.places.find("kind");
  const scene::Place place = first != study.places.end()  ? first->second
                             : kind != study.places.end() ? kind->second
                                                          : scene::Place{study.file};
  return scene::error_at(place, "reference", std::move(found), std::move(allowed));
}

/// What a fit of the load needs besides: a bell, and no fewer numbers than unknowns.
Fault check_fit_of_load(const StudyFile& study, const CalibrationTargets& targets) {
  constexpr const char* key = "load_fitted";
  const scene::Load& load = study.scene.scene.load;
  if (!load.curve_time.empty())
    return fault_at(study, key, "a load to be fitted beside a measured curve",
                    "load_fitted = false, or a scene without load.curve");
  if (load.shape != scene::LoadShape::bell)
    return fault_at(study, key, fmt::format("a load of shape \"{}\"", word_of(load.shape)),
                    "load.shape = \"bell\", whose peak time, width and steepness are fitted");
  const std::size_t numbers = fitted_numbers(targets.zero_gap) + fitted_numbers(targets.wide_gap);
  if (numbers >= fitted_keys.size()) return std::nullopt;
  return fault_at(
      study, key,
      fmt::format("{} numbers in the calibrated rows for {} unknowns", numbers, fitted_keys.size()),
      fmt::format("at least {} of maximum_temperature, early_temperature, rise_begins and rise_ends in the "
                  "two rows together",
                  fitted_keys.size()));
}

}  // namespace

scene::Expected<CalibrationTargets> calibration_targets(const StudyFile& study) {
  CalibrationTargets targets;
  double safe = -1.0, igniting = 1e300;
  int zero = 0, wide = 0;
  for (const study::Reference& row : study.study.references) {
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
      return missing(study, "a calibrated row without maximum_temperature", "one with it");
  }
  if (zero != 1 || wide != 1) {
    return missing(study, fmt::format("{} calibrated rows at gap 0 and {} at other gaps", zero, wide),
                   "one calibrated row at gap 0 (sets the localisation) and one at another gap that does not "
                   "ignite (sets the exchange time)");
  }
  if (igniting > 1.0 || !(safe < igniting)) {
    return missing(study,
                   igniting > 1.0 ? "no row that ignites" : "a row that ignites below one that does not",
                   "rows with an ignition_time, all at larger gaps than the rows without");
  }
  targets.safe_gap = safe;
  targets.igniting_gap = igniting;
  targets.load_fitted = settings_of<CalibrationSettings>(study.study).load_fitted;
  targets.early_time = study.study.early_time;
  if (targets.load_fitted)
    if (Fault fault = check_fit_of_load(study, targets)) return *fault;
  return targets;
}

namespace {

using scene::Dimension;

std::vector<scene::Key<CalibrationSettings>> calibration_keys() {
  return {
      assumed_list("meshes", Dimension::length, scene::between(1e-5, 1),
                   "Cell sizes, each a mechanical run; the scene's if absent.", &CalibrationSettings::meshes),
      scene::flag_key("compare_kinetics", scene::Standing::assumed,
                      "Calibrate with every named kinetics rather than with the scene's alone.",
                      &CalibrationSettings::compare_kinetics),
      scene::range_key("ignition_bracket", Dimension::temperature, scene::between(0, 5000),
                       scene::Standing::paper,
                       "Published bracket of the ignition temperature, a check on the calibrated one.",
                       &CalibrationSettings::ignition_lowest, &CalibrationSettings::ignition_highest),
      scene::flag_key("load_fitted", scene::Standing::assumed,
                      "Fit peak time, width and steepness of the load's bell too, with the constants by "
                      "least squares, to the highest temperatures over the launch and at early_time (0.5 K) "
                      "and to the two instants of the fast rise (0.5 ms) of the calibrated rows.",
                      &CalibrationSettings::load_fitted),
      scene::text_key(
          "frozen_at", scene::Standing::input,
          "Where rule and weights of the calibration were settled before its fit, for the report.", "1fd14b4",
          &CalibrationSettings::frozen_at),
  };
}

/// Firings stand alone, with what is only of them; they start from a calibration on published results.
Fault check_firings(const StudyFile& study) {
  const bool any = has_firings(study.study);
  for (const auto& [key, place] : study.places) {
    const bool of_firings = key.starts_with("prior.") || key == "next_gaps" || key == "calibration";
    const bool of_rows = key.starts_with("reference") || key == "meshes" || key == "load_fitted" ||
                         key == "compare_kinetics" || key == "ignition_bracket";
    if (any ? of_rows : of_firings)
      return fault_at(
          study, key,
          any ? "a key of published rows beside [[firing]]" : "a key of firings without [[firing]]",
          any ? "either [[firing]] or published rows" : "at least one [[firing]]");
  }
  return std::nullopt;
}

Fault read_calibration(const StudySource& source, StudyFile& study) {
  if (Fault fault = read_firings(source.root, study)) return fault;
  if (Fault fault = check_firings(study)) return fault;
  if (Fault fault = read_references(source, study)) return fault;
  const auto& own = settings_of<CalibrationSettings>(study.study);
  return add_axis(study, "numerics.cell_size", "meshes", own.meshes);
}

std::string mesh_label(const study::StudyCase& made) {
  return fmt::format("{:.6g} mm", 1e3 * made.cell_size);
}

Fault make_calibration_cases(const StudySource&, StudyFile& study) {
  if (has_firings(study.study)) return make_firing_cases(study);
  if (const auto targets = calibration_targets(study); !targets) return targets.error();
  return make_factorial(study, mesh_label);
}

/// Of the launches that a result has in `runs`.
template <auto runs>
std::vector<Failure> failed_runs(const auto& result) {
  std::vector<Failure> failures;
  for (const auto& run : result.*runs) add_failure(failures, run.input.label, run.outcome, run.failure);
  return failures;
}

StudyOutcome run(const StudyFile& study, const study::StudyOptions& options) {
  if (has_firings(study.study))
    return outcome_of<run_firings, failed_runs<&FiringResult::conditions, FiringResult>>(study, options);
  return outcome_of<run_calibration, failed_runs<&CalibrationResult::runs, CalibrationResult>>(study,
                                                                                               options);
}

}  // namespace

Kind calibration_kind() {
  return {
      .traits = {.name = "calibration",
                 .judges_gaps = false,
                 .gives_verdicts = false,
                 .bounds_critical_gaps = false},
      .keys =
          joined({reference_keys(), calibration_record_keys(), own_keys(calibration_keys()), firing_keys()}),
      .tables = {reference_table(), firing_table()},
      .read = read_calibration,
      .make_cases = make_calibration_cases,
      .run = run,
      // Reports of older programs had hold-outs and files of cases too.
      .files = {{"calibration.json"}, {"hold_outs.csv"}, {"case_", ".h5"}, {"case_", ".xdmf"}},
      .results = calibration_results,
  };
}

}  // namespace launchsafe::kinds
