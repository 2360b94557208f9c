// One mechanical run from its begin, or from a checkpoint, to its end.
#pragma once

#include "burning_bottom.hpp"
#include "launchsafe/run/run_case.hpp"
#include "monitor.hpp"

#include <chrono>

namespace launchsafe::run {

/// With a gap (m), the skin is integrated at every step, and with two-way coupling the run goes on through
/// combustion.
class Runner {
 public:
  Runner(const scene::Scene& scene, const RunOptions& options, std::optional<double> skin_gap);

  /// Takes over the state of a run without skin, which stands at a sample of its trace.
  void continue_from(const Runner& other);
  /// Keeps copies of this run at the first samples of its trace from `time_of_checkpoint` on; ends with the
  /// last of `enough` of them.
  void keep_checkpoints(std::size_t enough = std::numeric_limits<std::size_t>::max());
  /// Of the checkpoint with that index, s: they divide the launch evenly.
  static double time_of_checkpoint(std::size_t index, double duration);
  /// Takes a snapshot of this time (s) instead of those that the scene asks for, and ends with it.
  void end_with_snapshot(double time);

  double time() const { return simulation_.time(); }  ///< s, reached

  MechanicsResult run();

  std::shared_ptr<const Checkpoints> take_checkpoints() { return std::move(checkpoints_); }
  surface::SkinHistory take_skin() { return surface_->take(); }
  /// Of a run with two-way coupling that ignited, and ended as `mechanics` says.
  std::optional<CombustionHistory> take_combustion(const MechanicsResult& mechanics);

 private:
  using Clock = std::chrono::steady_clock;
  /// Samples over a launch, evenly spread.
  struct Monitor {
    double duration = 0;  ///< s, of the launch
    std::vector<MonitorSample> samples = {};
    double next = 0;  ///< s
    void take(const mpm::Simulation& simulation, double time_step);
  };

  void advance(double dt);
  void take_due_checkpoint();
  void burn(double dt);
  void end_now(CombustionEnd end);
  bool finished() const;
  bool is_done() const;
  void check();
  void check_step(double dt);
  void check_energy(const EnergyBalance& energy);
  void take_due_snapshots();
  void take_snapshots_of_events(bool samples);
  Snapshot snapshot() const;
  void stop(RunStatus status, std::string reason);
  void stop_now(RunStatus status, const std::string& what);

  RunOptions options_;
  mpm::Simulation simulation_;
  TraceRecorder recorder_;
  BulkHeat heat_;
  std::optional<double> skin_gap_;  ///< m
  std::optional<SteppedSkin> surface_;
  std::optional<BurningBottom> burning_;  ///< from ignition on
  bool couples_back_ = false;
  CombustionEnd combustion_end_ = CombustionEnd::time;
  double launch_time_ = scene::end_time(simulation_.scene().load);  ///< s, of the whole launch
  double end_ = launch_time_;                                       ///< s
  MechanicsResult result_;
  Clock::time_point start_ = Clock::now(), last_report_ = start_;
  double first_step_ = 0, time_step_ = 0;  ///< s
  std::shared_ptr<Checkpoints> checkpoints_;
  std::size_t enough_checkpoints_ = 0;
  double next_sample_ = simulation_.scene().output.trace_interval;
  Monitor monitor_{launch_time_};
  /// Of the launch that goes on for longer and may continue from the checkpoints, at other instants; without
  /// a duration where there is none.
  Monitor longer_;
  SnapshotTaker snapshots_{simulation_.scene()};
  bool ends_with_snapshots_ = false;
  double largest_energy_ = least_judged_energy(simulation_.scene());
};

class Checkpoints {
 public:
  std::vector<std::unique_ptr<Runner>> runs;  ///< in order of time
};

}  // namespace launchsafe::run
