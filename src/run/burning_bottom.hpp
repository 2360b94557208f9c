// What a gap does to the mechanics where it acts on them: by a flame at the bottom of the charge, or by
// closing.
//
// The flame: how deep the charge has burnt at every station, what that does to the particles, and the ledger
// of its energy. At a station that has ignited the flame stands at the bottom and eats into the charge at the
// speed of the travelling wave (materials/kinetics.hpp): through the skin at the temperature that the skin
// has, then into the charge as the mechanics left it. Skin that reaches T2 ahead of the flame has burnt too.
// Burning spreads to the sides by the gas alone: its pressure is that of the bottom, which heats the air over
// the other stations.
//
// A charge that lets go of nose and wall, and a gap whose air is closed in: the motion of its faces and the
// heat of its air, coupled.
#pragma once

#include "charge_heat.hpp"
#include "launchsafe/surface/gap_columns.hpp"

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

/// What holds a charge where it slides on nose and wall, until it lets go as scene::Surface says; also
/// without a gap, so that one that shrinks to nothing tends to that. Nothing under the reservoir.
class HeldCharge {
 public:
  /// Before the first step.
  explicit HeldCharge(mpm::Simulation& simulation);
  /// After a step.
  void advance(mpm::Simulation& simulation) const;

 private:
  double release_ = 0;   ///< s; 0: nothing holds the charge
  double duration_ = 0;  ///< s, from then on, over which what it bears falls to nothing
};

/// Each node of the charge's bottom has a column of its own in every ring that it lies in, whose air does not
/// mix with that of its neighbours, or flows between all of them (scene::AirFlow). Contact compresses the air
/// by the law of mpm::GapGas; the column follows its heat over every interval in which pressure or volume
/// changed by a few hundredths, and states the law anew. What the law leaves out in an interval is of second
/// order in its length and gone at its end, so that the whole is of second order.
class ClosingGap {
 public:
  /// Parts charge and base by a gap (m) wider than the scene's roughness; before the first step.
  ClosingGap(mpm::Simulation& simulation, const TraceRecorder& recorder, double gap);

  /// Takes in the step of dt (s) that has just been done; `samples`: every column is brought up to now.
  void advance(mpm::Simulation& simulation, const TraceRecorder& recorder, double dt, bool samples);
  /// Appends the present state to the histories.
  void record(const TraceRecorder& recorder);
  /// s, in which no opening falls by more than a part of itself that the gas's law resolves.
  double longest_step() const { return longest_step_; }
  /// A temperature of a column is not finite, or its air has no volume.
  bool failed() const { return failed_; }

  ClosingHistory take_history(mpm::Simulation& simulation);
  surface::SkinHistory take_skin() { return std::move(skin_); }

 private:
  /// A node's part of the bottom within one ring, whose friction heats its column. The air of all columns of
  /// a node has the same volume; the largest states it to contact.
  struct Node {
    std::size_t face = 0, node = 0;  ///< of contact
    std::size_t station = 0;
    double place = 0;  ///< m, at rest, along the bottom
    double area = 0;   ///< m2 per radian or metre
    bool states_gas = false;
    double opening = 0;             ///< m, at present
    double opening_before = 0;      ///< m, at the begin of the interval
    double closing_speed = 0;       ///< m/s, of the last step
    double pressure = 0;            ///< Pa, at present
    double pressure_ratio = 1;      ///< over that of the column which states the gas
    double hottest = 0;             ///< K, since the last sample
    surface::EnclosedAir air = {};  ///< at the begin of the interval
    double begin = 0;               ///< s
    double friction_before = 0;     ///< J/m3, at the begin of the interval
    double pressure_integral = 0;   ///< Pa s, over it
  };

  /// Of what columns have, over the area of the bottom.
  template <class OfColumn>
  double mean(OfColumn of_column) const {
    double sum = 0.0, area = 0.0;
    for (std::size_t column = 0; column < nodes_.size(); ++column) {
      sum += nodes_[column].area * of_column(column);
      area += nodes_[column].area;
    }
    return sum / area;
  }
  std::vector<Node> nodes_of_bottom(mpm::Simulation& simulation, const TraceRecorder& recorder);
  void find_columns_of_stations(const TraceRecorder& recorder);
  double friction_of(const Node& node, const TraceRecorder& recorder) const;
  bool is_due(const Node& node, const mpm::GapGas& gas) const;
  void follow_heat(std::size_t column, const TraceRecorder& recorder, double time);
  void start_interval(std::size_t column, mpm::Contact& contact, double time);
  void share_air(mpm::Contact& contact, double time);
  mpm::GapGas gas_of(const surface::EnclosedAir& air, double covolume) const;
  void note_motion(bool touches, double time);
  void note_pressure(const mpm::Contact& contact, double dt);

  surface::SkinModel model_;
  bool shares_air_;
  std::vector<Node> nodes_;
  std::vector<std::vector<std::size_t>> columns_of_station_;
  double floor_;  ///< m
  double often_;  ///< as scene::Surface::turns
  surface::GapColumns columns_;
  surface::SkinHistory skin_;
  ClosingHistory history_;
  double longest_step_ = math::infinity;
  bool touched_ = false, failed_ = false;
  /// Of the pressure of the charge's bottom, over an interval: what nodes that meet bear in a single step is
  /// a matter of the step.
  struct MeanPressure {
    double length = 0, integral = 0;   ///< s, Pa s, so far
    double last = math::not_a_number;  ///< Pa, of the interval before
  } bottom_;
  double smoothing_time_;  ///< s, length of such intervals
};

}  // namespace launchsafe::run
