// What a gap does to the mechanics where it acts on them, by a flame at the bottom of the charge: how deep
// the charge has burnt at every station, what that does to the particles, and the ledger of its energy. At a
// station that has ignited the flame stands at the bottom and eats into the charge at the speed of the
// travelling wave (materials/kinetics.hpp): through the skin at the temperature that the skin has, then into
// the charge as the mechanics left it. Skin that reaches T2 ahead of the flame has burnt too. Burning spreads
// to the sides by the gas alone: its pressure is that of the bottom, which heats the air over the other
// stations.
#pragma once

#include "charge_heat.hpp"

namespace launchsafe::run {

class BurningBottom {
 public:
  BurningBottom(const mpm::Simulation& simulation, const TraceRecorder& recorder);

  /// Advances the flames over the step of dt (s) that has just been done, and lets the particles burn in the
  /// next one.
  void advance(mpm::Simulation& simulation, const SteppedSkin& skin, double dt);
  /// Longest step (s) in which no flame passes more than a twentieth of the skin, or of a twentieth of the
  /// thinnest cell at the bottom where that is more.
  double longest_step() const;
  /// Largest speed (m/s) of a flame.
  double fastest_flame() const { return fastest_; }
  /// A flame has come to the end of the body that it began in: what lies beyond, it does not enter.
  bool burnt_through() const { return burnt_through_; }
  /// The skin of some station has burnt.
  bool skin_has_burnt() const { return !std::isnan(history_.complete_time); }
  /// Of a station's skin.
  double reaction_degree(const SteppedSkin& skin, std::size_t station) const;
  /// Appends the present state to the history.
  void record(const mpm::Simulation& simulation, const TraceRecorder& recorder, const SteppedSkin& skin);
  CombustionHistory take() { return std::move(history_); }

 private:
  /// Of a column of particles from the bottom up, the part over one station.
  struct Column {
    int body;
    int row;
    std::vector<std::pair<std::size_t, double>> stations;  ///< and their shares of the column's area
    std::vector<double> burnt;                             ///< share of every particle, from the bottom up
  };
  /// A station's flame.
  struct Flame {
    bool burns = false;
    double room = 0;              ///< m, of charge over the station in bodies that reach the bottom
    double depth = 0;             ///< m
    double skin_speed = 0;        ///< m/s
    double bulk_speed = 0;        ///< m/s
    double bulk_temperature = 0;  ///< K, of the charge behind the skin at ignition
  };
  /// What has burnt at a station in a step: depth (m) and thermal energy per area over density (J m/kg) of
  /// the gas, and what of that was released and was there before.
  struct Burnt {
    double depth = 0, fresh = 0, released = 0, kept_back = 0, brought = 0;
  };
  void ignite(const mpm::Simulation& simulation, const SteppedSkin& skin, std::size_t station);
  Burnt burn(Flame& flame, double unburnt_temperature, double dt) const;
  void burn_column(mpm::Simulation& simulation, Column& column, const std::vector<Burnt>& burnt);

  scene::Charge charge_;
  materials::KineticsParameters flame_kinetics_;  ///< that the flame lives on
  scene::HeatRelease release_;
  double skin_thickness_;       ///< m
  double initial_temperature_;  ///< K
  bool reads_bulk_;             ///< the plan follows the temperature of the bulk
  double whole_;                ///< 2 pi, or 1 in plane strain
  std::vector<Column> columns_;
  std::vector<Flame> flames_;              ///< by station
  std::vector<bool> tiles_;                ///< by station: it tiles the bottom and is no observation point
  std::vector<double> rooms_;              ///< by station, m: see Flame::room
  double thinnest_cell_ = math::infinity;  ///< m, of bodies at the bottom
  double fastest_ = 0;                     ///< m/s
  bool burnt_through_ = false;
  double released_ = 0, kept_back_ = 0, brought_ = 0;  ///< J
  CombustionHistory history_;
};

}  // namespace launchsafe::run
