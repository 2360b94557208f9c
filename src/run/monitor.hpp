// Watches a running simulation: energy balance, extremes, whether it can still be believed; and takes
// snapshots, fields at one instant.
#pragma once

#include "launchsafe/mpm/simulation.hpp"
#include "launchsafe/run/case_result.hpp"

namespace launchsafe::run {

/// A state field of a body by name; null where its law has none of that name.
const math::AlignedArray* field_of(const mpm::AnyBody& any, std::string_view name);

/// The energy balance at the begin of the last step, in J of the whole shell.
EnergyBalance energy_of(const mpm::Simulation& simulation);
MonitorSample monitor_sample(const mpm::Simulation& simulation, double time_step);
/// What became of the faces that can slide.
std::vector<InterfaceResult> interfaces_of(const mpm::Simulation& simulation);

/// Axial length at rest (m) of the wall where some particle's plastic strain exceeds `yield_of_wall`.
double yielded_wall(const mpm::Simulation& simulation);

LimiterCounts count_limited(const mpm::Simulation& simulation);

struct Stop {
  RunStatus status;
  std::string what;  ///< for people
};

/// Why the run has to stop now, if it has to. `largest_energy` is the largest energy scale seen so far (J):
/// drift is measured against it, so that the small energies of unloading do not magnify round-off.
std::optional<Stop> reason_to_stop(const mpm::Simulation& simulation, const EnergyBalance& energy,
                                   double largest_energy, double drift_limit);

/// Fields of all particles, where the stations' part of the charge's bottom is, and the faces that can slide.
Snapshot take_snapshot(const mpm::Simulation& simulation, const std::vector<trace::Station>& stations);

/// Adds the skin of a gap, as it was on the trace: linear between its samples but where a station ignites,
/// which is a jump. There it is that of the sample before, and of the first station from its ignition on that
/// of the sample after. `ignition_temperature` in K.
void add_skin(Snapshot& shot, const GapResult& gap, const trace::BottomTrace& trace,
              double ignition_temperature);

/// Snapshots at the times and events that a scene asks for: each is the state at the end of the step that
/// reaches its time, and so is the one at the largest chamber pressure, whose time is known beforehand.
class SnapshotTaker {
 public:
  using Take = std::function<Snapshot()>;
  explicit SnapshotTaker(const scene::Scene& scene);

  /// Whether one of a time is due; then `take_due` is to be called.
  bool is_due(double time) const { return next_ < due_.size() && due_[next_].time - time <= tolerance_; }
  void take_due(double time, const Take& take);
  /// The skin has ignited; only the first call counts.
  void take_ignition(const Take& take);
  /// Nothing is left that has a time.
  bool done() const { return next_ == due_.size(); }

  /// All of them in order of time, one of each instant.
  std::vector<Snapshot> finish();

 private:
  struct Due {
    double time;  ///< s
    std::optional<scene::Event> event;
  };
  void keep(Snapshot shot, std::vector<scene::Event> events);

  std::vector<Due> due_;  ///< in order of time
  std::size_t next_ = 0;
  double tolerance_;  ///< s, round-off of times
  bool wants_ignition_;
  std::vector<Snapshot> taken_;
};

/// Snapshots in order of time, and one with the events of all where several are of one instant.
void merge_instants(std::vector<Snapshot>& snapshots);

}  // namespace launchsafe::run
