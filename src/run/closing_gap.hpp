// A charge that lets go of nose and wall, and a gap whose air is closed in: the motion of its faces and the
// heat of its air, coupled.
#pragma once

#include "charge_heat.hpp"
#include "launchsafe/surface/gap_columns.hpp"

namespace launchsafe::run {

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
