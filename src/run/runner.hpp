// One mechanical run from its begin to its end.
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

  /// Takes a snapshot of this time (s) instead of those that the scene asks for, and ends with it.
  void end_with_snapshot(double time);

  MechanicsResult run();

  surface::SkinHistory take_skin() { return surface_->take(); }
  /// Of a run with two-way coupling that ignited, and ended as `mechanics` says.
  std::optional<CombustionHistory> take_combustion(const MechanicsResult& mechanics);

 private:
  using Clock = std::chrono::steady_clock;
  void advance(double dt);
  void burn();
  bool finished() const;
  bool is_done() const;
  void check();
  void check_step(double dt);
  void check_energy(const EnergyBalance& energy);
  void take_monitor_sample(double time_step);
  void take_due_snapshots();
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
  double next_sample_ = simulation_.scene().output.trace_interval;
  double next_monitor_ = 0;  ///< s
  SnapshotTaker snapshots_{simulation_.scene()};
  bool ends_with_snapshots_ = false;
  double largest_energy_ = least_judged_energy(simulation_.scene());
};

}  // namespace launchsafe::run
