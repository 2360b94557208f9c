// The skin of one gap, advanced with every step of the mechanics.
#pragma once

#include "launchsafe/mpm/simulation.hpp"
#include "launchsafe/run/case_result.hpp"
#include "trace_recorder.hpp"

#include <vector>

namespace launchsafe::run {

/// Under the reservoir. A station that ignites is at T2 from then on; with two-way coupling its unburnt part
/// is followed on: it is heated as before, reacts by the Arrhenius law, and has burnt as a whole at T2.
class SteppedSkin {
 public:
  /// `gap` in m.
  SteppedSkin(const scene::Scene& scene, double gap, const TraceRecorder& recorder);

  /// Goes on from a skin that was integrated on the recorder's trace, whose last sample is the present state.
  void continue_from(const surface::SkinHistory& traced, const TraceRecorder& recorder,
                     double chamber_pressure);

  /// Takes in the step of dt (s) that has just been done.
  void advance(const mpm::Simulation& simulation, const TraceRecorder& recorder, double dt);
  /// Appends the present temperatures to the history.
  void record(const TraceRecorder& recorder);

  /// One that tiles the bottom has ignited.
  bool ignited() const { return history_.ignition.has_value(); }
  double ignition_time() const { return history_.ignition->time; }  ///< s, of the first
  bool ignited(std::size_t station) const { return points_[station].ignited; }
  /// Temperature (K) of what has not burnt of a station's skin: T2 where all of it has.
  double unburnt_temperature(std::size_t station) const { return unburnt_[station].temperature; }
  double temperature(std::size_t station) const {
    return points_[station].temperature;
  }  ///< K, with the burnt part
  const surface::SkinModel& model() const { return model_; }

  surface::SkinHistory take() { return std::move(history_); }

 private:
  double pressure_of(const TraceRecorder& recorder, double chamber) const;
  double heating(const TraceRecorder& recorder, std::size_t station, double dt);
  void note_ignition(const TraceRecorder& recorder, std::size_t station, double time);

  surface::SkinModel model_;
  surface::SkinModel after_ignition_;  ///< of what has not burnt
  std::size_t closure_;
  surface::SkinHistory history_;
  std::vector<surface::SkinPoint> points_, unburnt_;  ///< by station
  std::vector<double> friction_;
  double air_gap_ = 0;  ///< m; a gap that would close and is not wider than its roughness has no air
  double air_pressure_ = 0;
};

}  // namespace launchsafe::run
