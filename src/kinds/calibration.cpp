#include "calibration_parts.hpp"

namespace launchsafe::kinds {
namespace {

using materials::KineticsParameters, scene::FrictionClosure;

/// A load belongs to the closure that it was fitted with.
std::vector<FrictionClosure> closures_of(const StudyFile& study) {
  if (settings_of<CalibrationSettings>(study).load_fitted) return {study.scene.scene.surface.friction};
  return {materials::all_closures.begin(), materials::all_closures.end()};
}

std::vector<KineticsParameters> kinetics_of(const StudyFile& study) {
  std::vector<KineticsParameters> all{study.scene.scene.charge().kinetics};
  if (!settings_of<CalibrationSettings>(study).compare_kinetics) return all;
  const auto key = scene::describe_key(study.scene, "kinetics.set", {});
  if (!key) return all;
  for (const std::string& word : key->words) {
    const auto changed = scene::with_written_key(study.scene, "kinetics.set", word, {});
    if (changed && word != all.front().name && word != "custom")
      all.push_back(changed->scene.charge().kinetics);
  }
  return all;
}

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

CalibrationRow row_of(const StudyFile& study, const CalibrationRun& run, FrictionClosure closure,
                      const KineticsParameters& kinetics, const CalibrationTargets& targets) {
  CalibrationRow row;
  row.cell_size = run.input.cell_size();
  row.closure = closure;
  row.kinetics = kinetics.name;
  row.calibratable = closure != FrictionClosure::none;
  row.failure = run.failure;
  if (row.failure.empty())
    row.failure = calibration_validity_warnings(run.input.scene.scene, run.mechanics());
  if (!row.failure.empty()) return row;
  SkinModel model = surface::skin_model(run.input.scene.scene);
  model.surface.friction = closure;
  model.kinetics = kinetics;
  if (row.calibratable) {
    row.calibrated = calibrate(model, run.mechanics().trace, targets);
    row.failure = row.calibrated.failure;
    if (!row.failure.empty()) return row;
    put(row.calibrated.constants, model.surface, model.kinetics);
  }
  compare(study.study, model, run.mechanics().trace, row);
  return row;
}

/// The place of the row of a mesh that was run, of a closure and a kinetics that were calibrated with.
std::size_t row_place(const CalibrationResult& result, double cell_size, FrictionClosure closure,
                      const std::string& kinetics) {
  const auto found = std::ranges::find_if(result.rows, [&](const CalibrationRow& row) {
    return row.cell_size == cell_size && row.closure == closure && row.kinetics == kinetics;
  });
  assert(found != result.rows.end());
  return static_cast<std::size_t>(found - result.rows.begin());
}

/// Finest and coarsest mesh that were run, m.
std::pair<double, double> mesh_range(const CalibrationResult& result) {
  const auto cell = [](const CalibrationRun& run) { return run.input.cell_size(); };
  const auto [finest, coarsest] = std::ranges::minmax_element(result.runs, {}, cell);
  return {cell(*finest), cell(*coarsest)};
}

void compare_meshes(CalibrationResult& result, const std::vector<KineticsParameters>& kinetics) {
  const auto [finest, coarsest] = mesh_range(result);
  if (!(finest < coarsest)) return;
  for (const KineticsParameters& set : kinetics)
    for (const FrictionClosure closure : closures_of(result.study)) {
      if (closure == FrictionClosure::none) continue;
      const auto constants_on = [&](double mesh) {
        return result.rows[row_place(result, mesh, closure, set.name)].calibrated.constants;
      };
      const SurfaceConstants a = constants_on(finest), b = constants_on(coarsest);
      result.convergence.push_back({closure, set.name, (a.localisation - b.localisation) / a.localisation,
                                    (a.exchange_time - b.exchange_time) / a.exchange_time});
    }
}

double change_of(const CalibrationResult& result, FrictionClosure closure, const std::string& kinetics) {
  for (const Convergence& each : result.convergence)
    if (each.closure == closure && each.kinetics == kinetics) return std::abs(each.localisation_change);
  return not_a_number;
}

/// K. Closures whose misfits differ by less are equally good: the misfits are of tens of kelvin.
constexpr double distinguishable_rms = 0.5;

/// Of a study that fits the load there is one closure alone.
void recommend_own(CalibrationResult& result, const std::string& kinetics, double mesh) {
  const std::size_t place = row_place(result, mesh, result.study.scene.scene.surface.friction, kinetics);
  const CalibrationRow& own = result.rows[place];
  if (!own.failure.empty()) {
    result.reason = "no constants are recommended: " + own.failure;
    return;
  }
  result.recommended_row = place;
  result.reason =
      fmt::format("The load and the constants of closure \"{}\" were fitted on cells of {:.6g} mm.",
                  study::to_string(own.closure), 1e3 * mesh);
}

/// What the misfits and the meshes say of the closures with the scene's own kinetics.
void recommend(CalibrationResult& result) {
  const std::string kinetics = result.study.scene.scene.charge().kinetics.name;
  const double finest = mesh_range(result).first, own = result.study.scene.scene.numerics.cell_size;
  // The mesh that the scene's constants belong to: its own where it was run, else the finest.
  const bool has_own = std::ranges::any_of(
      result.runs, [own](const CalibrationRun& run) { return run.input.cell_size() == own; });
  const double mesh = has_own ? own : finest;
  if (result.load) return recommend_own(result, kinetics, mesh);
  // The one that the scene has (if it has one) is first, and stays so unless the misfits separate it from the
  // best.
  std::vector<const CalibrationRow*> rows;
  for (const FrictionClosure closure : materials::all_closures) {
    if (closure == FrictionClosure::none) continue;
    const CalibrationRow& row = result.rows[row_place(result, finest, closure, kinetics)];
    rows.insert(closure == result.study.scene.scene.surface.friction ? rows.begin() : rows.end(), &row);
  }
  const auto rms = [](const CalibrationRow* row) { return row->root_mean_square; };
  if (!std::ranges::all_of(
          rows, [](double misfit) { return std::isfinite(misfit); }, rms)) {
    result.reason =
        "no closure is recommended: not all could be calibrated on the finest mesh and compared with "
        "temperatures that nothing was fitted to";
    return;
  }
  const auto best = std::ranges::min_element(rows, {}, rms);
  if (rms(rows.front()) - rms(*best) > distinguishable_rms) std::iter_swap(rows.begin(), best);
  const CalibrationRow* better = rows.front();
  const CalibrationRow* other =
      *std::min_element(rows.begin() + 1, rows.end(), [&](auto* a, auto* b) { return rms(a) < rms(b); });
  const auto change_with = [&](const CalibrationRow* row) {
    return change_of(result, row->closure, kinetics);
  };
  const auto facts_of = [&](const CalibrationRow* row) {
    return Row{{"closure", study::to_string(row->closure)},
               {"rms_K", row->root_mean_square},
               {"spread_K", report::number(row->spread_root_mean_square)},
               {"change_percent", report::number(100.0 * change_with(row))}};
  };
  result.reason = said("calibration.recommendation",
                       {{"finest_mm", 1e3 * finest},
                        {"better", facts_of(better)},
                        {"other", facts_of(other)},
                        {"converge", std::isfinite(change_with(better) + change_with(other))},
                        {"separates", std::abs(rms(better) - rms(other)) > distinguishable_rms},
                        {"distinguishable_K", distinguishable_rms}})
                      .front();
  const std::size_t chosen = row_place(result, mesh, better->closure, kinetics);
  if (result.rows[chosen].failure.empty()) result.recommended_row = chosen;
}

/// End temperature (K) of every station without a gap, with constants.
std::vector<double> end_temperatures(const CalibrationRun& run, const CalibrationRow& constants) {
  SkinModel model = surface::skin_model(run.input.scene.scene);
  model.surface.friction = constants.closure;
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
  const auto kinetics = kinetics_of(study);
  for (const CalibrationRun& run : result.runs)
    for (const KineticsParameters& set : kinetics)
      for (const FrictionClosure closure : closures_of(study))
        result.rows.push_back(row_of(study, run, closure, set, targets));
  compare_meshes(result, kinetics);
  recommend(result);
  if (result.load && !result.load->failure.empty())
    result.reason = "no load is recommended: " + result.load->failure;
  compare_stations(result);
}

std::string digest_of(const std::vector<Reference>& references) {
  std::string text;
  for (const Reference& row : references)
    text += fmt::format("{} {} {} {} {} {} {} {} {} {} {} {}\n", row.gap, row.maximum_temperature, row.point,
                        row.early_temperature, row.early_point, row.spread, row.early_spread,
                        row.ignition_time, row.rise_begins, row.rise_ends, row.calibrated, row.selection);
  return store::sha256(text);
}

/// The scene of the recommended row, with its constants.
Scene calibrated_scene(const CalibrationResult& result, const CalibrationRow& row) {
  Scene scene = run_of(result, row).input.scene.scene;
  scene.surface.friction = row.closure;
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
  record.references_digest = digest_of(result.study.study.references);
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
