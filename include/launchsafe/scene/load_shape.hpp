// When the rise of temperature under the analytic load turns fast and slow, and which exponent makes it do
// so.
#pragma once

#include <optional>

namespace launchsafe::scene {

/// Instants (s) of the heating under (p - p0) = (p_max - p0) ((t/t_m) exp(1 - t/t_m))^n. Friction heats with
/// the square of the pressure, in loading as in unloading: its rate is |d(p - p0)^2/dt|.
struct TurningTimes {
  double fast = 0;  ///< before the peak, where the rate of heating grows fastest
  double slow = 0;  ///< after the peak, where it falls fastest
  double between() const { return slow - fast; }
};

/// Both are where d^2(p - p0)^2/dt^2 is largest on their side of the peak, in closed form: with N = 2n and
/// t = t_m (1 - w/N) they are the outer roots of w^3 - 3 N w + 2 N = 0. `peak_time` t_m > 0 in s, exponent
/// n >= 1. `fast` is 0 where the rate grows fastest at the very beginning (n = 1).
TurningTimes turning_times(double peak_time, double exponent);

/// The exponent with which the two instants lie `between` (s) apart; none for a distance that no exponent
/// from 1 to 1000 gives.
std::optional<double> exponent_for(double peak_time, double between);

}  // namespace launchsafe::scene
