// Skin temperatures of the charge bottom for one gap, integrated on a bottom trace (model section 6).
#pragma once

#include "launchsafe/math/numbers.hpp"
#include "launchsafe/scene/scene.hpp"
#include "launchsafe/trace/bottom_trace.hpp"

namespace launchsafe::surface {

namespace detail {
class Intervals;
}

enum class IgnitionCause { trigger, arrhenius };  ///< T1 reached by outside heating, or self-heating ran away

struct Ignition {
  double time = 0;  ///< s
  std::size_t station = 0;
  IgnitionCause cause = IgnitionCause::trigger;
  double chemical_share = 0;  ///< share of the heating rate at T1 that is Arrhenius heat
};

/// The skin of one gap over the whole launch.
struct SkinHistory {
  double gap = 0;                       ///< m
  std::vector<double> time;             ///< s, those of the trace
  std::vector<double> air_temperature;  ///< K; of a film the mean over its mass and over the stations' areas
  std::vector<double> temperature;      ///< K, [sample * stations + station]; under a film the surface's,
  /// in a gap that closes the highest at any depth since the sample before.
  /// K, at any depth and time of a station that tiles the bottom; under a film, whose base cools the surface.
  /// 0 elsewhere.
  double hottest_depth = 0;
  std::optional<Ignition> ignition;  ///< the first over the stations that tile the bottom
  /// Energy made or lost by a film, relative to all that passed at the worst station (FilmEnergy::residual).
  /// 0 under AirModel::reservoir.
  double energy_residual = 0;

  /// Takes in the ignition of a station that tiles the bottom, at `time` (s), if it is the first so far.
  void note_ignition(std::size_t station, double time, double chemical_share);
};

/// All that the skin equation needs from a scene.
struct SkinModel {
  scene::Surface surface;
  materials::KineticsParameters kinetics;
  double charge_density = 1717.0;      ///< kg/m3
  double specific_heat = 1780.0;       ///< J/(kg K)
  double charge_conductivity = 0.246;  ///< W/(m K); this and the base count under AirModel::film only
  double base_density = 7830.0;        ///< kg/m3, of the body under the charge
  double base_specific_heat = 460.0;   ///< J/(kg K)
  double base_conductivity = 38.0;     ///< W/(m K)
  double initial_temperature = 300.0;  ///< K
  double melting_temperature = 353.0;  ///< K, of the charge; this and its heat where scene::Surface::melts
  double heat_of_melting = 0.0;        ///< J/kg
  double relative_tolerance = 1e-8;    ///< of the time integration
};
SkinModel skin_model(const scene::Scene& scene);

/// kappa h = rho_a0 h c_a/(rho h_ex c), dimensionless; h is the gap in m.
double heat_capacity_ratio(const SkinModel& model, double gap);

/// Integrates dT/dt = (kappa h/tau_ex)(T_air - T) + friction/(rho c) + (Q Z/c)(1 - lambda) exp(-(E/R)/T) at
/// every station. The exchange is stiff for small tau_ex and the reaction runs away: an L-stable Rosenbrock
/// method with step control follows both. At T1 the station ignites and goes to T2; from there only the
/// exchange acts. Under AirModel::film it is integrate_film (film.hpp) instead; without a gap friction acts
/// alone under every model of the air. Of a gap that closes in the mechanics (scene::closes) the trace of
/// another launch says nothing, and the temperatures are NaN.
SkinHistory integrate_skin(const SkinModel& model, const trace::BottomTrace& trace, double gap);

/// Whether gaps ignite on one trace, as integrate_skin finds, sooner: a skin is followed up to ignition,
/// first at as many stations as a register holds, those which friction heats most, and at others where none
/// of these ignites. Observation points are left out, and so are stations which friction heats in no interval
/// more than another, as they are nowhere hotter. What does not depend on the gap is found once.
class IgnitionOfGaps {
 public:
  /// Both outlive it.
  IgnitionOfGaps(const SkinModel& model, const trace::BottomTrace& trace);
  /// Whether any station that tiles the bottom ignites under a gap (m); nothing where a temperature is not a
  /// number.
  std::optional<bool> operator()(double gap) const;

 private:
  struct Interval {
    double air = 0, air_slope = 0;  ///< K at its begin, K/s
    std::vector<double> heating;    ///< K/s, of the stations that count
  };
  /// Of so many of the stations that count, from one on.
  std::optional<bool> any_ignites(const detail::Intervals& intervals, std::size_t first,
                                  std::size_t count) const;
  const SkinModel& model_;
  const trace::BottomTrace& trace_;
  std::vector<Interval> intervals_;
  std::size_t stations_ = 0;  ///< that count
  bool all_finite_ = true;    ///< the heating
};

/// The same equation for one station over one interval, for run::run_with_skin and for tests: temperature
/// after `dt` with the air at a temperature that goes linearly from `air_begin` to `air_end` and
/// `friction_heating` K/s.
struct SkinPoint {
  double temperature = 300.0;  ///< K
  bool ignited = false;
  double ignition_time = 0;  ///< s after the begin of the interval in which it ignited
  double chemical_share = 0;
};
SkinPoint advance_skin(const SkinModel& model, double gap, SkinPoint point, double dt, double air_begin,
                       double air_end, double friction_heating);

/// Highest temperature and where it was.
struct Maximum {
  double temperature = 0;  ///< K
  double time = 0;         ///< s
  std::size_t station = 0;
};
/// Over the stations that tile the bottom; over the observation points. NaN without any.
Maximum maximum_at_stations(const SkinHistory& history, const trace::BottomTrace& trace);
Maximum maximum_at_observation_points(const SkinHistory& history, const trace::BottomTrace& trace);
/// Temperature of one station at time t (s), linear between samples.
double temperature_at_time(const SkinHistory& history, const trace::BottomTrace& trace, std::size_t station,
                           double time);
/// Highest up to a time (s), over the stations.
Maximum maximum_until(const SkinHistory& history, const trace::BottomTrace& trace, double time);
/// Highest temperature of the stations at time t (s), and the spread (max - min) over them.
Maximum maximum_at_time(const SkinHistory& history, const trace::BottomTrace& trace, double time);
double spread_at_time(const SkinHistory& history, const trace::BottomTrace& trace, double time);

}  // namespace launchsafe::surface
