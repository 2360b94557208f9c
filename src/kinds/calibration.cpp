#include "calibration_parts.hpp"

namespace launchsafe::kinds {
namespace {

void run_meshes(CalibrationResult& result, const StudyOptions& options) {
  StudyFile study = result.study;
  for (std::size_t i = 0; i < result.runs.size(); ++i) study.cases.replace(i, result.runs[i].input);
  run_every_case(study, options, result.timing, [&](std::size_t i, std::vector<FinishedRun>& finished) {
    CalibrationRun& run = result.runs[i];
    static_cast<FinishedRun&>(run) = finished.front();
    BottomTrace& trace = run.result.mechanics.trace;
    trace = trace::until(trace, scene::read_time(run.input.scene.scene.load));
  });
}

CalibrationRow row_of(const StudyFile& study, const CalibrationRun& run, const CalibrationTargets& targets) {
  CalibrationRow row;
  row.cell_size = run.input.cell_size();
  row.closure = run.input.scene.scene.surface.friction;
  row.failure = run.failure;
  if (row.failure.empty())
    row.failure = calibration_validity_warnings(run.input.scene.scene, run.mechanics());
  if (!row.failure.empty()) return row;
  SkinModel model = surface::skin_model(run.input.scene.scene);
  row.calibrated = calibrate(model, run.mechanics().trace, targets);
  row.failure = row.calibrated.failure;
  if (!row.failure.empty()) return row;
  put(row.calibrated.constants, model.surface, model.kinetics);
  compare(study.study, model, run.mechanics().trace, row);
  return row;
}

/// The place of the row of a mesh that was run.
std::size_t row_place(const CalibrationResult& result, double cell_size) {
  const auto found = std::ranges::find(result.rows, cell_size, &CalibrationRow::cell_size);
  assert(found != result.rows.end());
  return static_cast<std::size_t>(found - result.rows.begin());
}

/// The row of the mesh that the scene's constants belong to: its own where it was run, else the finest.
void recommend(CalibrationResult& result) {
  const double own_mesh = result.study.scene.scene.numerics.cell_size;
  const auto meshes = of_each(result.rows, &CalibrationRow::cell_size);
  const bool has_own = std::ranges::count(meshes, own_mesh) > 0;
  const double mesh = has_own ? own_mesh : std::ranges::min(meshes);
  const std::size_t place = row_place(result, mesh);
  const CalibrationRow& own = result.rows[place];
  if (!own.failure.empty()) {
    result.reason = "no constants are recommended: " + own.failure;
    return;
  }
  result.recommended_row = place;
  result.reason = fmt::format("{} of closure \"{}\" were fitted on cells of {:.6g} mm.",
                              result.load ? "The load and the constants" : "The constants",
                              study::to_string(own.closure), 1e3 * mesh);
}

/// End temperature (K) of every station without a gap, with constants.
std::vector<double> end_temperatures(const CalibrationRun& run, const CalibrationRow& constants) {
  SkinModel model = surface::skin_model(run.input.scene.scene);
  put(constants.calibrated.constants, model.surface, model.kinetics);
  const BottomTrace& trace = run.mechanics().trace;
  const auto history = surface::integrate_skin(model, trace, 0.0);
  std::vector<double> temperatures;
  for (std::size_t station = 0; station < trace.stations.size(); ++station)
    if (!trace.stations[station].observation)
      temperatures.push_back(surface::temperature_at_time(history, trace, station, trace.time.back()));
  return temperatures;
}

/// NaN where the runs do not have the same stations.
double largest_change(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) return not_a_number;
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = study::larger_bound(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// The run of the next finer or coarser mesh; nullptr without one.
const CalibrationRun* neighbour(const CalibrationResult& result, double mesh, bool finer) {
  const CalibrationRun* next = nullptr;
  for (const CalibrationRun& run : result.runs) {
    const double cell = run.input.cell_size();
    if (!run.failure.empty() || cell == mesh || (cell < mesh) != finer) continue;
    if (next == nullptr || (cell < next->input.cell_size()) != finer) next = &run;
  }
  return next;
}

const CalibrationRun& run_of(const CalibrationResult& result, const CalibrationRow& row) {
  return *std::ranges::find(result.runs, row.cell_size,
                            [](const CalibrationRun& run) { return run.input.cell_size(); });
}

void compare_stations(CalibrationResult& result) {
  if (!result.recommended()) return;
  const CalibrationRow& row = *result.recommended();
  const auto temperatures = end_temperatures(run_of(result, row), row);
  const auto change_to = [&](bool finer) {
    const CalibrationRun* other = neighbour(result, row.cell_size, finer);
    return other == nullptr ? not_a_number : largest_change(temperatures, end_temperatures(*other, row));
  };
  result.stations = {change_to(true), change_to(false)};
}

/// Runs, fits, compares and recommends; all but what an interruption is told by.
void calibrate_study(CalibrationResult& result, const StudyOptions& options) {
  const StudyFile& study = result.study;
  const Scene& own = study.scene.scene;
  result.in_scene = {own.surface.localisation, own.surface.exchange_time,
                     own.charge().kinetics.ignition_temperature};
  const CalibrationTargets targets = calibration_targets(study);  // reading refuses a study without them
  if (targets.load_fitted) result.load = fit_load(study, targets, options, result.timing);
  for (const StudyCase& input : study.cases) {
    CalibrationRun& run = result.runs.emplace_back(input);
    if (result.load && result.load->bell) run.input.scene.scene.load = *result.load->bell;
    if (result.load) run.failure = result.load->failure;
  }
  if (!result.load || result.load->failure.empty()) run_meshes(result, options);
  for (const CalibrationRun& run : result.runs) result.rows.push_back(row_of(study, run, targets));
  recommend(result);
  if (result.load && !result.load->failure.empty())
    result.reason = "no load is recommended: " + result.load->failure;
  compare_stations(result);
}

/// The scene of the recommended row, with its constants.
Scene calibrated_scene(const CalibrationResult& result, const CalibrationRow& row) {
  Scene scene = run_of(result, row).input.scene.scene;
  put(row.calibrated.constants, scene.surface, scene.charge().kinetics);
  scene.accepted.clear();
  return scene;
}

}  // namespace

CalibrationResult run_calibration(const StudyFile& study, const StudyOptions& options) {
  return run_timed<CalibrationResult>(study, options,
                                      [&](CalibrationResult& result) { calibrate_study(result, options); });
}

std::optional<CalibrationRecord> record_of(const CalibrationResult& result) {
  const auto targets = scene::caught([&] { return calibration_targets(result.study); });
  if (!targets || result.interrupted) return std::nullopt;
  CalibrationRecord record;
  record.title = result.study.study.title;
  record.load_fitted = result.load.has_value();
  if (!result.recommended_row) {
    record.failure = result.reason;
    record.calibration = {result.study.scene.scene, study::no_evidence};
    return record;
  }
  const CalibrationRow& row = *result.recommended();
  record.calibration.scene = calibrated_scene(result, row);
  study::CalibrationEvidence& evidence = record.calibration.evidence;
  evidence.friction_rise =
      targets->zero_gap.maximum_temperature - record.calibration.scene.initial_temperature;
  evidence.air_rise = targets->wide_gap.maximum_temperature - targets->zero_gap.maximum_temperature;
  evidence.largest_gap = targets->igniting_gap;
  const MisfitBound misfits = misfit_bound(row);
  record.misfits = misfits.count;
  record.misfit_bound = misfits.bound();
  if (result.load) record.covariance = result.load->covariance;
  record.ignition_lowest = row.calibrated.ignition_lowest;
  record.ignition_highest = row.calibrated.ignition_highest;
  const double half = 0.5 * (record.ignition_highest - record.ignition_lowest);
  // Without a misfit that tells, that of the shipped calibration stays.
  evidence.fit_uncertainty =
      std::max(half, misfits.count > 0 ? misfits.bound() : study::CalibrationEvidence{}.fit_uncertainty);
  record.selection_root_mean_square = row.selection_root_mean_square;
  record.stations = result.stations;
  return record;
}

}  // namespace launchsafe::kinds
