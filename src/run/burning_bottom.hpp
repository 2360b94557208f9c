// What a gap does to the mechanics where it acts on them: how much of the charge's skin has burnt at every
// station, what that does to the particles, and the ledger of its energy. A skin that ignites is at T2 from
// then on, where the reaction degree of Eq. 38 is 1: it turns to gas, and by Eq. 40 nothing heats that any
// more. Burning spreads to the sides by the gas alone: its pressure is that of the bottom, which heats the
// air over the other stations.
#pragma once

#include "charge_heat.hpp"

namespace launchsafe::run {

class BurningBottom {
 public:
  BurningBottom(const mpm::Simulation& simulation, const TraceRecorder& recorder);

  /// Lets the skins that have ignited by the step that has just been done burn in the next one.
  void advance(mpm::Simulation& simulation, const SteppedSkin& skin);
  /// Of a station's skin.
  double reaction_degree(std::size_t station) const { return burnt_[station]; }
  /// Appends the present state to the history.
  void record(const mpm::Simulation& simulation, const TraceRecorder& recorder);
  CombustionHistory take() { return std::move(history_); }

 private:
  /// Of a column of particles from the bottom up, the part over one station.
  struct Column {
    int body;
    int row;
    std::vector<std::pair<std::size_t, double>> stations;  ///< and their shares of the column's area
    std::vector<double> burnt;                             ///< share of every particle, from the bottom up
  };
  void burn_column(mpm::Simulation& simulation, Column& column);

  scene::Charge charge_;
  double skin_thickness_;  ///< m
  double brought_heat_;    ///< J/kg, above the initial temperature, of what burns
  double released_heat_;   ///< J/kg, which brings it to T2
  double fresh_energy_;    ///< J/kg, thermal, from 0 K, of its gas
  std::vector<Column> columns_;
  std::vector<double> burnt_;  ///< share of the skin, by station
  std::vector<bool> tiles_;    ///< by station: it tiles the bottom and is no observation point
  double burnt_mass_ = 0;      ///< kg per radian
  CombustionHistory history_;
};

}  // namespace launchsafe::run
