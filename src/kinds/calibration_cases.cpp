// A study of kind calibration as a file: its keys, its cases, and which published rows it fits to.
#include "launchsafe/kinds/calibration.hpp"
#include "launchsafe/study/study_axes.hpp"
#include "launchsafe/study/study_cases.hpp"
#include "study_keys.hpp"
#include "study_outcome.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using namespace study;
namespace {

scene::InputError missing(const StudyFile& study, std::string found, std::string allowed) {
  const auto first = study.places.find("reference.0.gap");
  const auto kind = study.places.find("kind");
  const scene::Place place = first != study.places.end()  ? first->second
                             : kind != study.places.end() ? kind->second
                                                          : scene::Place{study.file};
  return scene::error_at(place, "reference", std::move(found), std::move(allowed));
}

}  // namespace

scene::Expected<CalibrationTargets> calibration_targets(const StudyFile& study) {
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
  const std::vector<double>& rise = settings_of<CalibrationSettings>(study.study).fast_rise;
  if (!rise.empty() && !(rise.size() == 2 && rise[0] < rise[1])) {
    return missing(
        study,
        rise.size() == 2 ? fmt::format("{:.6g} and {:.6g} ms in fast_rise", 1e3 * rise[0], 1e3 * rise[1])
                         : fmt::format("{} instants in fast_rise", rise.size()),
        "two, the earlier one first: when the temperature without a gap begins and ceases to rise fast");
  }
  const bool early = targets.zero_gap.early_calibrated && std::isfinite(targets.zero_gap.early_temperature);
  if (!rise.empty() && (!early || !study.scene.scene.load.curve_time.empty())) {
    return missing(study,
                   early ? "fast_rise beside a measured curve"
                         : "fast_rise without an early temperature to fit the load to",
                   "an analytic load, and early_calibrated = true with early_temperature in the calibrated "
                   "row at gap 0");
  }
  targets.safe_gap = safe;
  targets.igniting_gap = igniting;
  return targets;
}

namespace {

using scene::Dimension;

std::vector<scene::Key<CalibrationSettings>> calibration_keys() {
  return {
      assumed_list("meshes", Dimension::length, scene::between(1e-5, 1),
                   "Cell sizes, each a mechanical run; the scene's if absent.", &CalibrationSettings::meshes),
      scene::flag_key<CalibrationSettings>(
          "compare_kinetics", scene::Standing::assumed,
          "Calibrate with every named kinetics rather than with the scene's alone.",
          &CalibrationSettings::compare_kinetics),
      scene::range_key<CalibrationSettings>(
          "ignition_bracket", Dimension::temperature, scene::between(0, 5000), scene::Standing::paper,
          "Published bracket of the ignition temperature, a check on the calibrated one.",
          &CalibrationSettings::ignition_lowest, &CalibrationSettings::ignition_highest),
      assumed_list(
          "fast_rise", Dimension::time, scene::above_to(0, 1),
          "Two instants between which the published temperature without a gap rises fast. Where given, "
          "load.exponent is fitted to the time between them and load.peak_time to the row without a "
          "gap that has early_calibrated = true.",
          &CalibrationSettings::fast_rise),
  };
}

Fault read_calibration(const StudySource& source, StudyFile& study) {
  if (Fault fault = read_references(source, study)) return fault;
  const auto& own = settings_of<CalibrationSettings>(study.study);
  return add_axis(study, "numerics.cell_size", "meshes", own.meshes);
}

std::string mesh_label(const StudyCase& made, const std::string&) {
  return fmt::format("{:.6g} mm", 1e3 * made.cell_size);
}

Fault make_calibration_cases(const StudySource&, StudyFile& study) {
  if (const auto targets = calibration_targets(study); !targets) return targets.error();
  return make_factorial(study, mesh_label);
}

std::vector<Failure> calibration_failures(const CalibrationResult& result) {
  std::vector<Failure> failures;
  for (const CalibrationRun& run : result.runs)
    add_failure(failures, run.input.label, run.outcome, run.failure);
  return failures;
}

}  // namespace

Kind calibration_kind() {
  return {
      .traits = {.name = "calibration",
                 .gaps_key = {},
                 .gives_verdicts = false,
                 .bounds_critical_gaps = false},
      .keys = joined({reference_keys(), own_keys(calibration_keys())}),
      .tables = {reference_table()},
      .read = read_calibration,
      .make_cases = make_calibration_cases,
      .run = outcome_of<run_calibration, calibration_failures>,
      // Reports of older programs had files of cases too.
      .files = {{"calibration.json"},
                {"calibration.csv"},
                {"hold_outs.csv"},
                {"case_", ".h5"},
                {"case_", ".xdmf"}},
  };
}

}  // namespace launchsafe::kinds
