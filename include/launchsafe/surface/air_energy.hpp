// The energy of the air: what the skin took from it against what compression can supply to it (model section
// 12).
#pragma once

#include "launchsafe/surface/skin.hpp"

namespace launchsafe::surface {

/// Energies per area of the charge's bottom, J/m2, until the end of the history or the first ignition. NaN
/// where nothing was computed; all are 0 without a gap.
struct AirEnergy {
  /// Largest net heat that the exchange had brought to the skin of the hottest station at any time.
  double taken = math::not_a_number;
  /// At the most that a history of this pressure can supply: see compression_supply.
  double supplied = math::not_a_number;
  /// m c_v (T - T0): stored in the air by adiabatic compression to the highest pressure.
  double stored = math::not_a_number;
  /// p0 h ln(p/p0): work of isothermal compression to the highest pressure.
  double isothermal = math::not_a_number;
  /// How many times what can be supplied was taken; above 1 the energy of the air is not conserved. NaN
  /// without a supply.
  double ratio() const { return supplied > 0.0 ? taken / supplied : math::not_a_number; }
};

/// J/m2: rho c h_ex (T - T0) less the heats of friction and reaction, which is rho c h_ex times the integral
/// of (kappa h/tau_ex)(T_air - T), without reference to the air: it holds for every AirModel beside a skin of
/// one temperature and the thickness h_ex, not for one that resolves the charge in depth, whose heat is its
/// own to count. The largest value over time, since a net heat is what the first law bounds; heat that went
/// back to the air can be taken again. Of the station that ignites first, or else of the one where T max is,
/// and until then. Reaction is integrated along straight lines between the samples of the history, which must
/// be those of the trace.
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
/// it. That is gamma times what the adiabat stores, m c_v (T_adiabat - T0), and more than what isothermal
/// compression supplies, p0 h ln(p_peak/p0).
double compression_supply(const SkinModel& model, const trace::BottomTrace& trace, double gap, double end);

/// All of it for a history that was integrated on the trace, or inside the mechanics that recorded it. NaN
/// for one that is not finite or not of this trace.
AirEnergy audit_air(const SkinModel& model, const trace::BottomTrace& trace, const SkinHistory& history);

}  // namespace launchsafe::surface
