// Records the bottom trace of a running simulation.
#pragma once

#include "launchsafe/mpm/simulation.hpp"
#include "launchsafe/trace/bottom_trace.hpp"

#include <array>
#include <vector>

namespace launchsafe::run {

/// Stations tile the charge's bottom by the width that the scene states, down to the depth that it states;
/// the scene's observation points come after them. A scene without a charge has none, and its trace holds the
/// chamber pressure only.
class TraceRecorder {
 public:
  TraceRecorder(mpm::Simulation& simulation, const scene::Scene& scene);

  /// Takes over what another recorder of the same mechanics has seen so far.
  void continue_from(const TraceRecorder& other);
  /// Takes in the step that has just been done (its end state; dt in s).
  void accumulate(const mpm::Simulation& simulation, double dt);
  /// Appends a sample of the present state and starts the next interval.
  void sample(const mpm::Simulation& simulation);

  double bottom_pressure() const { return bottom_pressure_; }  ///< Pa, at the present state
  /// Friction energy since the start at a station, J/m3, by closure index.
  double friction(std::size_t closure, std::size_t station) const { return heat_[closure][station]; }
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
  void add_bottom_row(const Charge& charge, bool axisymmetric);
  void add_stations(const scene::Scene& scene);
  void add_observation_point(const scene::ObservationPoint& point);
  void heat_stations();
  double measure_bottom_pressure(const mpm::Simulation& simulation) const;

  trace::BottomTrace trace_;
  std::vector<const Charge*> charges_;
  std::vector<Share> bottom_;                                     ///< weights sum to 1
  std::vector<std::vector<Share>> shares_;                        ///< by station
  std::array<std::vector<double>, trace::traced_closures> heat_;  ///< by closure and station, J/m3
  double floor_ = 0;                                              ///< Pa: the air's initial pressure
  double bottom_pressure_ = 0, chamber_pressure_ = 0;             ///< Pa, at the present state
  double bottom_integral_ = 0, chamber_integral_ = 0;             ///< Pa s, over the present interval
  double interval_begin_ = 0;                                     ///< s
  double steps_ = 0;
};

}  // namespace launchsafe::run
