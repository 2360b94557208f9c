// Watches a running simulation: energy balance, extremes, whether it can still be believed, and how long a
// time step may be, from theory; and takes snapshots, fields at one instant.
#pragma once

#include "launchsafe/mpm/simulation.hpp"
#include "launchsafe/run/case_result.hpp"

namespace launchsafe::run {

/// A state field of a body by name; null where its law has none of that name.
const math::AlignedArray* field_of(const mpm::AnyBody& any, std::string_view name);

/// The energy balance at the begin of the last step, in J of the whole shell (plane strain: per metre).
EnergyBalance energy_of(const mpm::Simulation& simulation);
MonitorSample monitor_sample(const mpm::Simulation& simulation, double time_step);
/// What became of the faces that can slide.
std::vector<InterfaceResult> interfaces_of(const mpm::Simulation& simulation);

LimiterCounts count_limited(const mpm::Simulation& simulation);

struct Stop {
  RunStatus status;
  std::string what;  ///< for people
};

/// Why the run has to stop now, if it has to. `largest_energy` is the largest energy scale seen so far (J):
/// drift is measured against it, so that the small energies of unloading do not magnify round-off.
std::optional<Stop> reason_to_stop(const mpm::Simulation& simulation, const EnergyBalance& energy,
                                   double largest_energy, double drift_limit);

/// The time step factor up to which a step is proved stable, wherever particles lie in their cells: the
/// smallest over the bodies of the scene.
///
/// Stresses and velocities are half a step apart (leapfrog), so a step is stable up to dt = 2/omega of the
/// fastest mode. A particle with shape functions S and gradients G holds at most the energy
/// V rho c^2 (sum G^2/S)(sum S u^2)/2 in nodal displacements u (Cauchy-Schwarz, both directions, c the
/// longitudinal speed), while its share of the nodal masses holds V rho omega^2 (sum S u^2)/2; hence
/// omega^2 <= c^2 (A_x + A_r), A = sum G^2/S along one direction (Irons and Treharne's theorem with particles
/// for elements).
/// For uGIMP with cell L and half-length l, A <= 2/(L l) + 1/(L (L - l)), reached as a particle leaves the
/// middle of a cell whose far node has no other particle: a free face. With one particle a cell (l = L/2)
/// that is 6/L^2, and on square cells the factor is 2/sqrt(12) = 0.577. A particle in the middle of its cell
/// has A = 4/L^2, as a finite element with one point has: c dt sqrt(1/dx^2 + 1/dr^2) <= 1, or 0.707. The hoop
/// strain adds to A_r about 1/r^2, which next to the axis is less than what the fixed node there takes away.
/// More particles a cell share their nodes, so the true limit is higher than this one. In the
/// total-Lagrangian form particles do not move in their cells: A = (1/S_0 + 1/S_1)/L^2 with the constant
/// weights S of a cell's two nodes, 4/L^2 for one particle a cell but for the row beside the axis, where the
/// weight with r makes it 4.5/L^2; the factor is 0.686. What holds hourglassing back is softer by far.
double proved_time_step_factor(const scene::Scene& scene);

/// "; the time step factor 0.8 is above 0.577, up to which ...": what a run that broke must say of its steps;
/// empty where they are proved stable.
std::string step_remark(const scene::Scene& scene);

/// Fields of all particles, where the stations' part of the charge's bottom is, and the faces that can slide.
Snapshot take_snapshot(const mpm::Simulation& simulation, const std::vector<trace::Station>& stations);

/// Adds the skin of a gap, as it was on the trace: linear between its samples but where a station ignites,
/// which is a jump. There it is that of the sample before, and of the first station from its ignition on that
/// of the sample after. `ignition_temperature` in K.
void add_skin(Snapshot& shot, const GapResult& gap, const trace::BottomTrace& trace,
              double ignition_temperature);

/// Snapshots at the times and events that a scene asks for.
///
/// One at a time is the state at the end of the step that reaches it, and so is the one at the largest
/// chamber pressure, whose time is known beforehand. Growth of cracks, yield and slip are looked for at the
/// samples of the trace: of the first two the state at the first sample that has them is kept, and of the
/// slip that at the sample with the largest, which is known at the end. Ignition and the end of burning are
/// told by the run.
class SnapshotTaker {
 public:
  using Take = std::function<Snapshot()>;
  explicit SnapshotTaker(const scene::Scene& scene);

  /// Whether one of a time is due; then `take_due` is to be called.
  bool is_due(double time) const { return next_ < due_.size() && due_[next_].time - time <= tolerance_; }
  void take_due(double time, const Take& take);
  /// At a sample of the trace.
  void look_for_events(const mpm::Simulation& simulation, const Take& take);
  /// An event has happened; only its first time counts.
  void take_event(scene::Event event, const Take& take);
  /// Nothing is left that has a time.
  bool done() const { return next_ == due_.size(); }

  /// All of them in order of time, one of each instant.
  std::vector<Snapshot> finish();

 private:
  struct Due {
    double time;  ///< s
    std::optional<scene::Event> event;
  };
  bool wants(scene::Event event) const;
  void keep(Snapshot shot, std::vector<scene::Event> events);

  std::vector<Due> due_;  ///< in order of time
  std::size_t next_ = 0;
  double tolerance_;                                    ///< s, round-off of times
  std::vector<scene::Event> wanted_;                    ///< not taken yet
  double largest_slip_ = 0;                             ///< m
  std::vector<std::shared_ptr<const Snapshot>> taken_;  ///< shared with the checkpoints of the run
};

/// Snapshots in order of time, and one with the events of all where several are of one instant.
void merge_instants(std::vector<Snapshot>& snapshots);

}  // namespace launchsafe::run
