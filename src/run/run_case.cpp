#include "launchsafe/run/run_case.hpp"

#include "bulk_heat.hpp"
#include "burning_bottom.hpp"
#include "flush_denormals.hpp"
#include "launchsafe/run/judged_energy.hpp"
#include "launchsafe/run/processor_time.hpp"
#include "launchsafe/run/stable_factor.hpp"
#include "monitor.hpp"
#include "stepped_skin.hpp"
#include "trace_recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

namespace launchsafe::run {
namespace {

/// Steps between two checks of the stable time step, the stop flag and the energy balance.
constexpr std::uint64_t steps_per_check = 16;
/// A step shorter than this share of the first one means that the state has blown up.
constexpr double collapse_share = 1e-3;
constexpr std::uint64_t monitor_samples = 500;

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<double> sorted(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values;
}

}  // namespace

namespace detail {
class Runner;
}

class Checkpoints {
 public:
  std::vector<std::unique_ptr<detail::Runner>> runs;  ///< in order of time
};

namespace detail {

/// One mechanical run; with a gap (m), the skin is integrated at every step, and with two-way coupling it
/// goes on through combustion.
class Runner {
 public:
  Runner(const scene::Scene& scene, const RunOptions& options, std::optional<double> skin_gap)
      : options_(options),
        simulation_(scene, options.threads),
        recorder_(simulation_, simulation_.scene()),
        heat_(simulation_),
        skin_gap_(skin_gap) {
    if (skin_gap) surface_.emplace(simulation_.scene(), *skin_gap, recorder_);
    couples_back_ = skin_gap && scene.coupling == scene::Coupling::two_way;
    result_.particles = simulation_.particles();
    simulation_.for_each_body([&](const mpm::ParticleFields& p) {
      add_mass(result_.masses, scene.bodies[static_cast<std::size_t>(p.body)].material,
               mpm::mass_of(p, scene.symmetry));
    });
  }

  /// Takes over the state of a run without skin, which stands at a sample of its trace.
  void continue_from(const Runner& other) {
    simulation_.continue_from(other.simulation_);
    recorder_.continue_from(other.recorder_);
    heat_.continue_from(other.heat_);
    result_ = other.result_;
    result_.steps_before = result_.steps;
    first_step_ = other.first_step_;
    time_step_ = other.time_step_;
    next_sample_ = other.next_sample_;
    next_monitor_ = other.next_monitor_;
    next_snapshot_ = other.next_snapshot_;
    largest_energy_ = other.largest_energy_;
    if (!surface_) return;
    const scene::Scene& scene = simulation_.scene();
    surface_->continue_from(
        surface::integrate_skin(surface::skin_model(scene), recorder_.trace(), *skin_gap_), recorder_,
        simulation_.chamber_pressure());
  }

  /// Keeps copies of this run at the first samples of its trace from `time_of_checkpoint` on; ends with the
  /// last of `enough` of them.
  void keep_checkpoints(std::size_t enough = std::numeric_limits<std::size_t>::max()) {
    checkpoints_ = std::make_shared<Checkpoints>();
    enough_checkpoints_ = enough;
  }
  /// Of the checkpoint with that index, s: they divide the launch evenly.
  static double time_of_checkpoint(std::size_t index, double duration) {
    constexpr double parts = 16.0;
    return duration * static_cast<double>(index + 1) / parts;
  }
  std::shared_ptr<const Checkpoints> take_checkpoints() { return std::move(checkpoints_); }

  MechanicsResult run() {
    const FlushDenormals flush;
    const double processor_start = thread_processor_time();
    if (result_.steps == 0) begin();
    while (!finished() && !has_enough_checkpoints() && result_.status == RunStatus::completed) {
      if (burning_ || result_.steps % steps_per_check == 0) {
        time_step_ = simulation_.stable_time_step();
        check(time_step_, first_step_);
        if (result_.status != RunStatus::completed) break;
      }
      // The last step ends on the duration; the one before shares what is left, so that neither is tiny.
      const double longest = burning_ ? std::min(time_step_, burning_->longest_step()) : time_step_;
      const double remaining = end_ - simulation_.time();
      const double dt = remaining <= longest ? remaining : std::min(longest, 0.5 * remaining);
      check_step(dt);
      if (result_.status == RunStatus::completed) advance(dt);
    }
    take_monitor_sample(time_step_);
    if (result_.status == RunStatus::completed) check_energy(energy_of(simulation_));
    result_.end_time = simulation_.time();
    result_.limiters = count_limited(simulation_);
    result_.interfaces = interfaces_of(simulation_);
    result_.wall_time = seconds_since(start_);
    result_.processor_time = thread_processor_time() - processor_start;
    if (const mpm::TotalLagrangian* form = simulation_.total_lagrangian())
      result_.processor_time += form->helpers_processor_time();
    result_.trace = recorder_.take();
    return std::move(result_);
  }

  surface::SkinHistory take_skin() { return surface_->take(); }
  /// Of a run with two-way coupling that ignited, and ended as `mechanics` says.
  std::optional<CombustionHistory> take_combustion(const MechanicsResult& mechanics) {
    if (!burning_) return std::nullopt;
    CombustionHistory history = burning_->take();
    history.end = mechanics.status == RunStatus::completed ? combustion_end_ : CombustionEnd::broke_off;
    history.reason = mechanics.reason;
    history.energy_drift = largest_energy_drift(mechanics);
    history.wall_time = mechanics.wall_time;
    return history;
  }

 private:
  void begin() {
    first_step_ = time_step_ = simulation_.stable_time_step();
    take_monitor_sample(time_step_);
    take_due_snapshots();
  }

  void advance(double dt) {
    const scene::Scene& scene = simulation_.scene();
    simulation_.step(dt);
    ++result_.steps;
    if (burning_ && !simulation_.within_gas_law()) return stop_outside_gas_law();
    recorder_.accumulate(simulation_, dt);
    heat_.accumulate(simulation_);
    if (surface_) surface_->advance(simulation_, recorder_, dt);
    if (couples_back_) burn(dt);
    const double time = simulation_.time();
    const bool last = finished();
    const bool samples = time >= next_sample_ || last;
    if (samples) {
      recorder_.sample(simulation_);
      if (surface_) surface_->record(recorder_);
      if (burning_) burning_->record(simulation_, recorder_, *surface_);
      heat_.advance_to(simulation_, time);
      next_sample_ = next_time(next_sample_, scene.output.trace_interval, time);
    }
    take_due_snapshots();
    if (time >= next_monitor_ && !last) take_monitor_sample(dt);
    if (samples && !last && checkpoints_) take_due_checkpoint();
  }

  bool has_enough_checkpoints() const {
    return checkpoints_ && checkpoints_->runs.size() >= enough_checkpoints_;
  }

  void take_due_checkpoint() {
    const double duration = simulation_.scene().load.duration;
    if (simulation_.time() < time_of_checkpoint(checkpoints_->runs.size(), duration)) return;
    auto copy = std::make_unique<Runner>(simulation_.scene(), RunOptions{}, std::nullopt);
    copy->continue_from(*this);
    checkpoints_->runs.push_back(std::move(copy));
  }

  void stop_outside_gas_law() {
    stop(
        {RunStatus::outside_gas_law,
         fmt::format("at t = {:.6g} ms: a burning particle is in a state that the virial law of the gas does "
                     "not cover",
                     1e3 * simulation_.time())});
  }

  /// Lets the charge burn where the skin has ignited. The run ends a stated time after the first ignition,
  /// whether that is before or after the end of the launch, at a stated pressure, or where a flame has no
  /// more charge before it. A flame that outruns sound is none that conduction drives, and ends the run too.
  void burn(double dt) {
    if (!surface_->ignited()) return;
    const scene::Combustion& combustion = simulation_.scene().combustion;
    if (!burning_) {
      burning_.emplace(simulation_, recorder_);
      end_ = surface_->ignition_time() + combustion.duration;
    }
    burning_->advance(simulation_, *surface_, dt);
    const double sound = scene::longitudinal_speed(materials::Law(simulation_.scene().charge()));
    if (!(burning_->fastest_flame() < sound))
      stop({RunStatus::flame_beyond_sound,
            fmt::format("at t = {:.6g} ms: the kinetics give a flame of {:.3g} m/s; sound in the charge has "
                        "{:.3g} m/s",
                        1e3 * simulation_.time(), burning_->fastest_flame(), sound)});
    if (burning_->burnt_through()) end_now(CombustionEnd::burnt_through);
    if (recorder_.bottom_pressure() >= combustion.stop_pressure) end_now(CombustionEnd::pressure);
  }

  void end_now(CombustionEnd end) {
    end_ = simulation_.time();
    combustion_end_ = end;
  }

  /// The first of the times `next`, `next` + `interval`, ... after `time`. Intervals much shorter than a step
  /// are as good as none: then it is `time`, which every later step reaches.
  static double next_time(double next, double interval, double time) {
    constexpr double most_in_a_step = 1000.0;
    if (time - next > most_in_a_step * interval) return time;
    while (next <= time) {
      if (!(next + interval > next)) return time;
      next += interval;
    }
    return next;
  }

  bool finished() const { return end_ - simulation_.time() <= 1e-12 * simulation_.scene().load.duration; }

  void check(double time_step, double first_step) {
    if (options_.stop != nullptr && options_.stop->load(std::memory_order_relaxed))
      return stop(
          {RunStatus::interrupted, fmt::format("stopped at t = {:.6g} ms", 1e3 * simulation_.time())});
    if (seconds_since(start_) > options_.time_limit)
      return stop({RunStatus::timed_out, fmt::format("not done after {:.3g} s", options_.time_limit)});
    if (std::isfinite(time_step) && time_step < collapse_share * first_step)
      return stop(
          {RunStatus::time_step_collapse,
           fmt::format("at t = {:.6g} ms: the stable time step fell from {:.3g} s to {:.3g} s{}",
                       1e3 * simulation_.time(), first_step, time_step, step_remark(simulation_.scene()))});
    check_energy(energy_of(simulation_));
    if (options_.progress && seconds_since(last_report_) > 0.25) {
      last_report_ = Clock::now();
      options_.progress(simulation_.time() / end_);
    }
  }

  /// Steps so short would not end the launch, or no longer move the time at all.
  void check_step(double dt) {
    constexpr double shortest_share = 1e-15;
    if (dt >= shortest_share * simulation_.scene().load.duration) return;
    stop({std::isnan(dt) ? RunStatus::non_finite : RunStatus::time_step_collapse,
          fmt::format("at t = {:.6g} ms: with steps of {:.3g} s the launch would not end{}",
                      1e3 * simulation_.time(), dt, step_remark(simulation_.scene()))});
  }

  void check_energy(const EnergyBalance& energy) {
    largest_energy_ = std::max(largest_energy_, energy.scale());
    if (const auto reason = reason_to_stop(simulation_, energy, largest_energy_,
                                           simulation_.scene().numerics.energy_drift_limit))
      stop(*reason);
  }

  /// One for every time that has come; at the end of the launch that is all of them, whatever round-off says.
  void take_due_snapshots() {
    while (next_snapshot_ < snapshot_times_.size() &&
           (simulation_.time() >= snapshot_times_[next_snapshot_] || finished())) {
      result_.snapshots.push_back(take_snapshot(simulation_));
      ++next_snapshot_;
    }
  }

  void stop(const Stop& why) {
    result_.status = why.status;
    result_.reason = why.reason;
  }

  void take_monitor_sample(double time_step) {
    result_.monitor.push_back(monitor_sample(simulation_, time_step));
    next_monitor_ =
        simulation_.time() + simulation_.scene().load.duration / static_cast<double>(monitor_samples);
  }

  RunOptions options_;
  mpm::Simulation simulation_;
  TraceRecorder recorder_;
  BulkHeat heat_;
  std::optional<double> skin_gap_;  ///< m
  std::optional<SteppedSkin> surface_;
  std::optional<BurningBottom> burning_;  ///< from ignition on
  bool couples_back_ = false;
  CombustionEnd combustion_end_ = CombustionEnd::time;
  double end_ = simulation_.scene().load.duration;  ///< s
  MechanicsResult result_;
  Clock::time_point start_ = Clock::now(), last_report_ = start_;
  double first_step_ = 0, time_step_ = 0;  ///< s
  std::shared_ptr<Checkpoints> checkpoints_;
  std::size_t enough_checkpoints_ = 0;
  double next_sample_ = simulation_.scene().output.trace_interval;
  double next_monitor_ = 0;
  std::vector<double> snapshot_times_ = sorted(simulation_.scene().output.snapshot_times);
  std::size_t next_snapshot_ = 0;
  double largest_energy_ = least_judged_energy(simulation_.scene());
};

}  // namespace detail

namespace {

using detail::Runner;

/// By its user or its time limit.
bool was_cut_short(RunStatus status) {
  return status == RunStatus::interrupted || status == RunStatus::timed_out;
}

GapResult gap_result(const surface::SkinModel& model, surface::SkinHistory skin,
                     const trace::BottomTrace& trace) {
  GapResult result;
  result.gap = skin.gap;
  result.at_stations = surface::maximum_at_stations(skin, trace);
  result.at_points = surface::maximum_at_observation_points(skin, trace);
  result.air = surface::audit_air(model, trace, skin);
  result.skin = std::move(skin);
  return result;
}

/// Before this share of the launch the skin of a gap that is near to ignition is integrated on the trace.
constexpr double stepped_share = 0.01;

/// How many checkpoints of a launch lie before a gap ignites, or is hottest.
std::size_t checkpoints_before(const trace::BottomTrace& launch, const GapResult& traced, double duration) {
  const double critical = traced.skin.ignition ? traced.skin.ignition->time : traced.at_stations.time;
  std::size_t count = 0;
  for (const double time : launch.time)
    if (time <= critical - stepped_share * duration && time >= Runner::time_of_checkpoint(count, duration))
      ++count;
  return count;
}

/// A complete run of a gap (m) with two-way coupling, from a checkpoint of its launch where there is one.
CaseResult continue_with_skin(const scene::Scene& scene, double gap, const MechanicsResult& launch,
                              const RunOptions& options) {
  CaseResult result;
  const GapResult traced = evaluate_gap(scene, launch.trace, gap);
  if (launch.status != RunStatus::completed) {
    result.mechanics = launch;
    result.gaps.push_back(traced);
    return result;
  }
  const bool total = scene.numerics.formulation == scene::Formulation::total_lagrangian;
  const std::size_t needed = total ? checkpoints_before(launch.trace, traced, scene.load.duration) : 0;
  Runner runner(scene, options, gap);
  if (needed > 0) {
    // What was stored has none: the launch is computed again as far as needed.
    std::shared_ptr<const Checkpoints> checkpoints = launch.checkpoints;
    if (!checkpoints) {
      Runner again(scene, options, std::nullopt);
      again.keep_checkpoints(needed);
      result.mechanics = again.run();
      checkpoints = again.take_checkpoints();
    }
    if (checkpoints->runs.size() < needed) {  // broken off
      result.gaps.push_back(traced);
      return result;
    }
    runner.continue_from(*checkpoints->runs[needed - 1]);
  }
  result.mechanics = runner.run();
  result.gaps.push_back(gap_result(surface::skin_model(scene), runner.take_skin(), result.mechanics.trace));
  result.gaps.back().combustion = runner.take_combustion(result.mechanics);
  result.gaps.back().with_mechanics = true;
  return result;
}

}  // namespace

MechanicsResult run_mechanics(const scene::Scene& scene, const RunOptions& options) {
  Runner runner(scene, options, std::nullopt);
  if (options.checkpoints && scene.numerics.formulation == scene::Formulation::total_lagrangian)
    runner.keep_checkpoints();
  MechanicsResult result = runner.run();
  result.checkpoints = runner.take_checkpoints();
  return result;
}

GapResult evaluate_gap(const scene::Scene& scene, const trace::BottomTrace& trace, double gap) {
  const surface::SkinModel model = surface::skin_model(scene);
  GapResult result = gap_result(model, surface::integrate_skin(model, trace, gap), trace);
  const trace::BottomTrace coarse = trace::thinned(trace);
  const auto coarse_maximum =
      surface::maximum_at_stations(surface::integrate_skin(model, coarse, gap), coarse);
  result.sampling_error = std::abs(result.at_stations.temperature - coarse_maximum.temperature);
  return result;
}

CaseResult run_case(const scene::Scene& scene, const RunOptions& options) {
  RunOptions own = options;
  own.checkpoints = scene.coupling == scene::Coupling::two_way;
  CaseResult result;
  result.mechanics = run_mechanics(scene, own);
  own.launch = &result.mechanics;
  if (!scene::has_charge(scene)) return result;
  for (const double gap : scene.surface.gaps) {
    result.gaps.push_back(evaluate_gap(scene, result.mechanics.trace, gap));
    GapResult& traced = result.gaps.back();
    if (!own.checkpoints || !traced.skin.ignition || result.mechanics.status != RunStatus::completed)
      continue;
    const CaseResult burnt = run_with_skin(scene, gap, own);
    traced.combustion = burnt.gaps.front().combustion;
    if (!was_cut_short(burnt.mechanics.status)) continue;
    // What is missing of the case says nothing of the launch.
    result.mechanics.status = burnt.mechanics.status;
    result.mechanics.reason =
        fmt::format("after ignition at {:.6g} cm: {}", 100.0 * gap, burnt.mechanics.reason);
  }
  return result;
}

CaseResult run_with_skin(const scene::Scene& scene, double gap, const RunOptions& options) {
  if (scene.coupling == scene::Coupling::two_way) {
    if (options.launch != nullptr) return continue_with_skin(scene, gap, *options.launch, options);
    RunOptions own = options;
    own.checkpoints = true;
    return continue_with_skin(scene, gap, run_mechanics(scene, own), options);
  }
  CaseResult result;
  if (scene.surface.air_model != scene::AirModel::reservoir) {
    // The air's balance couples all stations, and a film has a profile of its own at each: they are
    // integrated on a trace with a sample every few steps.
    scene::Scene fine = scene;
    fine.output.trace_interval = 8.0 * mpm::Simulation(scene).stable_time_step();
    result.mechanics = run_mechanics(fine, options);
    result.gaps.push_back(evaluate_gap(fine, result.mechanics.trace, gap));
  } else {
    Runner runner(scene, options, gap);
    result.mechanics = runner.run();
    result.gaps.push_back(gap_result(surface::skin_model(scene), runner.take_skin(), result.mechanics.trace));
  }
  result.gaps.back().with_mechanics = true;
  return result;
}

}  // namespace launchsafe::run
