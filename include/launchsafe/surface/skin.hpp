// Skin temperatures of the charge bottom for one gap, integrated on a bottom trace (model section 6), and the
// energy of the air: what the skin took from it against what compression can supply to it.
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
  std::vector<double> air_temperature;  ///< K
  std::vector<double> temperature;      ///< K, [sample * stations + station]
  std::optional<Ignition> ignition;     ///< the first over the stations that tile the bottom
  /// Takes in the ignition of a station that tiles the bottom, at `time` (s), if it is the first so far.
  void note_ignition(std::size_t station, double time, double chemical_share);
};

/// All that the skin equation needs from a scene.
struct SkinModel {
  scene::Surface surface;
  materials::KineticsParameters kinetics;
  double charge_density = 1717.0;      ///< kg/m3
  double specific_heat = 1780.0;       ///< J/(kg K)
  double conductivity = 0.246;         ///< W/(m K); counts after the launch only, in after_launch.hpp
  double initial_temperature = 300.0;  ///< K
  double relative_tolerance = 1e-8;    ///< of the time integration
};
SkinModel skin_model(const scene::Scene& scene);

/// kappa h = rho_a0 h c_a/(rho h_ex c), dimensionless; h is the gap in m.
double heat_capacity_ratio(const SkinModel& model, double gap);

/// Integrates dT/dt = (kappa h/tau_ex)(T_air - T) + friction/(rho c) + (Q Z/c)(1 - lambda) exp(-(E/R)/T) at
/// every station. The exchange is stiff for small tau_ex and the reaction runs away: an L-stable Rosenbrock
/// method with step control follows both. At T1 the station ignites and goes to T2; from there only the
/// exchange acts. Without a gap friction acts alone.
SkinHistory integrate_skin(const SkinModel& model, const trace::BottomTrace& trace, double gap);

/// Whether gaps ignite on one trace, as integrate_skin finds, sooner: a skin is followed up to ignition,
/// first at as many stations as a register holds, those which friction heats most, and at others where none
/// of these ignites. Observation points are left out, and so are stations which friction heats in no interval
/// more than another, as they are nowhere hotter. What does not depend on the gap is found once.
class IgnitionOfGaps {
 public:
  /// Keeps a reference to the trace, which must outlive it.
  IgnitionOfGaps(SkinModel model, const trace::BottomTrace& trace);
  IgnitionOfGaps(SkinModel model, const trace::BottomTrace&& trace) = delete;
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
  SkinModel model_;
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

/// Energies per area of the charge's bottom, J/m2, until the end of the history or the first ignition. NaN
/// where nothing was computed; all are 0 without a gap.
struct AirEnergy {
  /// Largest net heat that the exchange had brought to the skin of the hottest station at any time.
  double taken = math::not_a_number;
  /// At the most that a history of this pressure can supply: see compression_supply.
  double supplied = math::not_a_number;
  /// How many times what can be supplied was taken; above 1 the energy of the air is not conserved. NaN
  /// without a supply.
  double ratio() const { return supplied > 0.0 ? taken / supplied : math::not_a_number; }
};

/// J/m2: rho c h_ex (T - T0) less the heats of friction and reaction, which is rho c h_ex times the integral
/// of (kappa h/tau_ex)(T_air - T), without reference to the air. The largest value over time, since a net
/// heat is what the first law bounds; heat that went back to the air can be taken again. Of the station that
/// ignites first, or else of the one where T max is, and until then. Reaction is integrated along straight
/// lines between the samples of the history, which must be those of the trace.
double heat_taken(const SkinModel& model, const trace::BottomTrace& trace, const SkinHistory& history);

/// J/m2, upper bound of the heat that air of m = rho_a0 h kg/m2 can give up under the trace's pressure p(t)
/// until the time `end` (s): m c_a times all rises of the adiabatic temperature, and of what the air is
/// warmer than the charge at first.
///
/// First law of the enclosed air: heat given = work - rise of internal energy = m (integral of v dp - rise of
/// c_p T), v = R T/p. Cooled air is smaller and takes less work to compress, so v is at most that of the
/// adiabat, whose integral of v dp over a rise is c_p times its rise in temperature; an expansion only takes
/// energy out. For a single rise to a peak this is m c_p (T_adiabat(p_peak) - T0): air that is compressed
/// before it gives up heat, and then cools down to T0 under the peak pressure, which goes on doing work on
/// it.
double compression_supply(const SkinModel& model, const trace::BottomTrace& trace, double gap, double end);

/// All of it for a history that was integrated on the trace, or inside the mechanics that recorded it. NaN
/// for one that is not finite or not of this trace.
AirEnergy audit_air(const SkinModel& model, const trace::BottomTrace& trace, const SkinHistory& history);

}  // namespace launchsafe::surface
