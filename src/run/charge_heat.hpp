// What a run follows of the charge's heat: the trace of its bottom, the skin at every step, and the bulk.
#pragma once

#include "launchsafe/mpm/conduction.hpp"
#include "launchsafe/run/case_result.hpp"

namespace launchsafe::run {

/// A place between two neighbouring centres of a lattice: the lower index and the share of the upper one.
/// Beyond the first and the last centre, up to half a cell, the share lies outside of 0 to 1: values are
/// continued by the straight line through the two nearest centres, so that they are of second order
/// everywhere.
struct Bracket {
  int lower;
  double share;
};
template <class Centre>
Bracket bracket_of(double place, int count, Centre&& centre) {
  if (count < 2) return {0, 0.0};
  int lower = 0;
  while (lower + 2 < count && centre(lower + 1) <= place) ++lower;
  return {lower, (place - centre(lower)) / (centre(lower + 1) - centre(lower))};
}

/// Adds a share of what a step did to a recorded particle.
inline void add(materials::SlidingStep& step, const mpm::Body<materials::Charge>& charge, std::size_t slot,
                double weight) {
  const mpm::ParticleFields& p = charge.particles;
  const auto deviator = [slot](const std::array<math::AlignedArray, 3>& change) {
    return math::Deviator<double>{change[0][slot], change[1][slot], change[2][slot]};
  };
  step.pressure += weight * p.pressure[slot];
  step.volume_ratio += weight * p.volume_ratio[slot];
  step.strain = step.strain + weight * deviator(p.strain_change);
}

/// Stations tile the charge's bottom by the width that the scene states, down to the depth that it states;
/// the scene's observation points come after them. A scene without a charge has none, and its trace holds the
/// chamber pressure only.
class TraceRecorder {
 public:
  TraceRecorder(mpm::Simulation& simulation, const scene::Scene& scene);

  /// Takes in the step that has just been done (its end state; dt in s).
  void accumulate(const mpm::Simulation& simulation, double dt);
  /// Appends a sample of the present state and starts the next interval.
  void sample(const mpm::Simulation& simulation);

  double bottom_pressure() const { return bottom_pressure_; }  ///< Pa, at the present state
  /// Friction energy since the start at a station, J/m3.
  double friction(std::size_t station) const { return heat_[station]; }
  const trace::BottomTrace& trace() const { return trace_; }
  trace::BottomTrace take() { return std::move(trace_); }

 private:
  using Charge = mpm::Body<materials::Charge>;
  /// A particle with a weight: its share of what is read at a place, or of the mean over the bottom.
  struct Share {
    const Charge* charge;
    std::size_t slot;
    double weight;
  };
  /// Linear in x and in r between the centres of the four nearest particles, continued to the charge's faces.
  static std::vector<Share> shares_at(const Charge& charge, double x, double r);
  void add_bottom_row(const Charge& charge);
  void add_stations(const scene::Scene& scene);
  void add_observation_point(const scene::ObservationPoint& point);
  void heat_stations();
  double measure_bottom_pressure(const mpm::Simulation& simulation) const;

  std::vector<const Charge*> charges_;
  std::vector<Share> bottom_;               ///< weights sum to 1
  std::vector<std::vector<Share>> shares_;  ///< by station
  double floor_ = 0;                        ///< Pa: the air's initial pressure
  trace::BottomTrace trace_;
  std::vector<double> heat_;                           ///< by station, J/m3
  double bottom_pressure_ = 0, chamber_pressure_ = 0;  ///< Pa, at the present state
  double bottom_integral_ = 0;                         ///< Pa s, over the present interval
  double interval_begin_ = 0;                          ///< s
};

/// A station that ignites is at T2 from then on.
class SteppedSkin {
 public:
  /// `gap` in m.
  SteppedSkin(const scene::Scene& scene, double gap, const TraceRecorder& recorder);

  /// Takes in the step of dt (s) that has just been done.
  void advance(const mpm::Simulation& simulation, const TraceRecorder& recorder, double dt);
  /// Appends the present temperatures to the history.
  void record(const TraceRecorder& recorder);

  /// One that tiles the bottom has ignited.
  bool ignited() const { return history_.ignition.has_value(); }
  double ignition_time() const { return history_.ignition->time; }  ///< s, of the first
  bool ignited(std::size_t station) const { return points_[station].ignited; }
  /// K.
  double temperature(std::size_t station) const { return points_[station].temperature; }
  const surface::SkinModel& model() const { return model_; }

  surface::SkinHistory take() { return std::move(history_); }

 private:
  double heating(const TraceRecorder& recorder, std::size_t station, double dt);

  surface::SkinModel model_;
  surface::SkinHistory history_;
  std::vector<surface::SkinPoint> points_;  ///< by station
  std::vector<double> friction_;
  double air_pressure_ = 0;
};

/// Advances the particle temperatures from one trace sample to the next, with the terms that the scene's plan
/// keeps. The bulk takes friction heat with factor 1; localised heat belongs to the sliding layers (model
/// section 5).
class BulkHeat {
 public:
  explicit BulkHeat(mpm::Simulation& simulation);
  /// Takes in the friction of the step that has just been done.
  void accumulate(const mpm::Simulation& simulation);
  void advance_to(mpm::Simulation& simulation, double time);

 private:
  using Charge = mpm::Body<materials::Charge>;
  void react(Charge& charge, double dt) const;

  scene::Charge charge_;
  bool reaction_;
  std::optional<mpm::Conduction> conduction_;  ///< only where the plan keeps it
  /// J/m3 since the last advance, by charge body; empty where the charge's temperatures are not needed.
  std::vector<math::AlignedArray> friction_;
  double time_ = 0;
};

}  // namespace launchsafe::run
