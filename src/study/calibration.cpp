#include "launchsafe/study/calibration.hpp"

#include "case_runs.hpp"
#include "hold_outs.hpp"
#include "launchsafe/store/manifest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace launchsafe::study {

std::string to_string(scene::FrictionClosure closure) {
  switch (closure) {
    case scene::FrictionClosure::literal:
      return "literal";
    case scene::FrictionClosure::inelastic:
      return "inelastic";
    case scene::FrictionClosure::none:
      return "none";
  }
  return "none";
}

bool CalibrationResult::any_failed() const {
  return std::any_of(runs.begin(), runs.end(), [](const auto& run) { return !run.failure.empty(); });
}

namespace {

using scene::FrictionClosure;

constexpr FrictionClosure closures[] = {FrictionClosure::literal, FrictionClosure::inelastic,
                                        FrictionClosure::none};

/// A kinetics to calibrate with.
struct NamedKinetics {
  std::string name;
  materials::KineticsParameters parameters;
};

std::vector<NamedKinetics> kinetics_of(const StudyFile& study) {
  const materials::KineticsParameters& own = study.scene.scene.charge().kinetics;
  std::vector<NamedKinetics> all{{own.name, own}};
  if (!study.study.compare_kinetics) return all;
  const auto key = scene::describe_key(study.scene, "kinetics.set", {});
  if (!key) return all;
  for (const std::string& word : key->words) {
    const auto changed = scene::with_written_key(study.scene, "kinetics.set", word, {});
    if (changed && word != own.name && word != "custom")
      all.push_back({word, changed->scene.charge().kinetics});
  }
  return all;
}

detail::NeededRun needed_by(const CalibrationRun& run) {
  return {&run.input.scene.scene, run.input.label, std::nullopt};
}

void run_meshes(CalibrationResult& result, const StudyOptions& options) {
  ProgressTracker tracker(options.progress);
  const std::vector<bool> ours = detail::cases_of_shard(result.study, options.shard);
  std::vector<Task> tasks;
  std::vector<CalibrationRun*> running;
  for (std::size_t i = 0; i < result.runs.size(); ++i) {
    CalibrationRun& run = result.runs[i];
    if (!ours[i]) {
      run.failure = foreign_shard;
      continue;
    }
    const detail::NeededRun needed = needed_by(run);
    running.push_back(&run);
    tasks.push_back(detail::task_of(needed, options, [&, needed](const Allotment& allotment) {
      run.start_time = store::utc_now();
      detail::ObtainedRun obtained = detail::obtain(needed, options, allotment);
      run.reused = obtained.reused;
      run.mechanics = std::move(obtained.result.mechanics);
    }));
    tracker.expect(1, tasks.back().cost);
  }
  const auto outcomes = run_tasks(tasks, detail::resources_of(options), tracker, options.stop);
  for (std::size_t task = 0; task < tasks.size(); ++task) {
    CalibrationRun& run = *running[task];
    detail::note_refusal(needed_by(run), outcomes[task], options);
    run.failure = detail::failure_of(run.mechanics, outcomes[task]);
    detail::add_run(result.timing, run.mechanics, run.reused, outcomes[task]);
  }
}

CalibrationRow row_of(const StudyFile& study, const CalibrationRun& run, FrictionClosure closure,
                      const NamedKinetics& kinetics, const CalibrationTargets& targets) {
  CalibrationRow row;
  row.cell_size = run.input.cell_size;
  row.closure = closure;
  row.kinetics = kinetics.name;
  row.calibratable = closure != FrictionClosure::none;
  row.failure = run.failure;
  if (!row.failure.empty()) return row;
  surface::SkinModel model = surface::skin_model(run.input.scene.scene);
  model.surface.friction = closure;
  model.kinetics = kinetics.parameters;
  if (row.calibratable) {
    row.calibrated = calibrate(model, run.mechanics.trace, targets);
    row.failure = row.calibrated.failure;
    if (!row.failure.empty()) return row;
    model.surface.localisation = row.calibrated.constants.localisation;
    model.surface.exchange_time = row.calibrated.constants.exchange_time;
    model.kinetics.ignition_temperature = row.calibrated.constants.ignition_temperature;
  }
  detail::predict(study.study, model, run.mechanics.trace, row);
  return row;
}

const CalibrationRow* find_row(const CalibrationResult& result, double cell_size, FrictionClosure closure,
                               const std::string& kinetics) {
  for (const CalibrationRow& row : result.rows) {
    if (row.cell_size == cell_size && row.closure == closure && row.kinetics == kinetics) return &row;
  }
  return nullptr;
}

/// Finest and coarsest mesh that were run, m.
std::pair<double, double> mesh_range(const CalibrationResult& result) {
  double finest = 1e300, coarsest = 0;
  for (const CalibrationRun& run : result.runs) {
    finest = std::min(finest, run.input.cell_size);
    coarsest = std::max(coarsest, run.input.cell_size);
  }
  return {finest, coarsest};
}

void compare_meshes(CalibrationResult& result, const std::vector<NamedKinetics>& kinetics) {
  const auto [finest, coarsest] = mesh_range(result);
  if (!(finest < coarsest)) return;
  for (const NamedKinetics& set : kinetics) {
    for (const FrictionClosure closure : {FrictionClosure::literal, FrictionClosure::inelastic}) {
      const CalibrationRow* fine = find_row(result, finest, closure, set.name);
      const CalibrationRow* coarse = find_row(result, coarsest, closure, set.name);
      Convergence convergence{closure, set.name};
      if (fine && coarse) {
        const Constants &a = fine->calibrated.constants, &b = coarse->calibrated.constants;
        convergence.localisation_change = (a.localisation - b.localisation) / a.localisation;
        convergence.exchange_time_change = (a.exchange_time - b.exchange_time) / a.exchange_time;
      }
      result.convergence.push_back(convergence);
    }
  }
}

double change_of(const CalibrationResult& result, FrictionClosure closure, const std::string& kinetics) {
  for (const Convergence& each : result.convergence) {
    if (each.closure == closure && each.kinetics == kinetics) return std::abs(each.localisation_change);
  }
  return not_a_number;
}

/// The mesh that the scene's constants belong to: its own where it was run, else the finest.
double recommended_mesh(const CalibrationResult& result) {
  const double own = result.study.scene.scene.numerics.cell_size;
  for (const CalibrationRun& run : result.runs) {
    if (run.input.cell_size == own) return own;
  }
  return mesh_range(result).first;
}

/// K. Closures whose misfits differ by less predict equally well: the misfits themselves are of tens of
/// kelvin.
constexpr double distinguishable_rms = 0.5;

FrictionClosure study_closure(const CalibrationResult& result) {
  return result.study.scene.scene.surface.friction;
}

/// What the hold-outs and the meshes say of the two closures with the scene's own kinetics.
void recommend(CalibrationResult& result) {
  const std::string kinetics = result.study.scene.scene.charge().kinetics.name;
  const double finest = mesh_range(result).first, mesh = recommended_mesh(result);
  const CalibrationRow* literal = find_row(result, finest, FrictionClosure::literal, kinetics);
  const CalibrationRow* inelastic = find_row(result, finest, FrictionClosure::inelastic, kinetics);
  const auto usable = [](const CalibrationRow* row) { return row && std::isfinite(row->root_mean_square); };
  Recommendation& said = result.recommendation;
  if (!usable(literal) || !usable(inelastic)) {
    said.reason = "no closure is recommended: not both could be calibrated on the finest mesh";
    return;
  }
  const double gain = std::abs(literal->root_mean_square - inelastic->root_mean_square);
  const bool separates = gain > distinguishable_rms;
  // Where the hold-outs do not separate the closures, the scene keeps the one it has (if it has one).
  const bool keep_inelastic = study_closure(result) == FrictionClosure::inelastic;
  const bool choose_inelastic =
      separates ? inelastic->root_mean_square < literal->root_mean_square : keep_inelastic;
  const CalibrationRow* better = choose_inelastic ? inelastic : literal;
  const CalibrationRow* other = choose_inelastic ? literal : inelastic;
  said.reason = fmt::format(
      "On the finest mesh ({:.6g} mm) \"{}\" misses the temperature hold-outs by {:.4g} K (RMS), \"{}\" by "
      "{:.4g} K; the spreads by {:.4g} K and {:.4g} K. {}",
      1e3 * finest, to_string(better->closure), better->root_mean_square, to_string(other->closure),
      other->root_mean_square, better->spread_root_mean_square, other->spread_root_mean_square,
      separates ? "The hold-outs separate them."
                : fmt::format("A difference below {} K does not separate them, and the scene keeps \"{}\".",
                              distinguishable_rms, to_string(better->closure)));
  const double change = change_of(result, better->closure, kinetics);
  const double other_change = change_of(result, other->closure, kinetics);
  if (std::isfinite(change) && std::isfinite(other_change)) {
    said.reason += fmt::format(
        " From the coarsest to the finest mesh its localisation changes by {:.3g} %, the other's by {:.3g} "
        "%.",
        100.0 * change, 100.0 * other_change);
  } else {
    said.reason += " With one mesh nothing is known about convergence.";
  }
  const CalibrationRow* chosen = find_row(result, mesh, better->closure, kinetics);
  if (chosen && chosen->failure.empty()) said.row = static_cast<std::size_t>(chosen - result.rows.data());
}

}  // namespace

CalibrationResult run_calibration(const StudyFile& study, const StudyOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  CalibrationResult result;
  result.study = study;
  result.timing.jobs = detail::jobs_of(options);
  const scene::Scene& scene = study.scene.scene;
  result.in_scene = {scene.surface.localisation, scene.surface.exchange_time,
                     scene.charge().kinetics.ignition_temperature};
  for (const StudyCase& input : study.cases) {
    CalibrationRun run;
    run.input = input;
    result.runs.push_back(std::move(run));
  }
  run_meshes(result, options);
  const auto targets = calibration_targets(study);
  const auto kinetics = kinetics_of(study);
  for (const CalibrationRun& run : result.runs) {
    for (const NamedKinetics& set : kinetics) {
      for (const FrictionClosure closure : closures) {
        if (targets) result.rows.push_back(row_of(study, run, closure, set, *targets));
      }
    }
  }
  compare_meshes(result, kinetics);
  if (!result.rows.empty()) recommend(result);
  result.interrupted = detail::stop_requested(options);
  result.timing.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace launchsafe::study
