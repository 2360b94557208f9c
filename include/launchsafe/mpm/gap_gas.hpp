// Gas enclosed between two faces, as contact sees it: a pressure that rises as they approach.
#pragma once

#include <cmath>

namespace launchsafe::mpm {

/// Gas of one pair of nodes, per area of the face. It is compressed isentropically,
///
///   p = pressure (volume/(h - covolume))^exponent
///
/// with the opening h of the faces, and its mean temperature comes near to that of the walls at the rate
/// exchange/h: a film whose gas nears its walls by conduction does so, as its mass times its thickness over
/// its conductivity is what the time goes with. Whoever follows the gas's heat in detail states all of that
/// anew in time (surface::GapColumns).
struct GapGas {
  double outside = 0;   ///< Pa, of what surrounds the bodies: only a pressure above it pushes
  double pressure = 0;  ///< Pa, of the state that volume belongs to; 0: there is no gas
  double volume = 0;    ///< m3/m2 without the covolume
  double exponent = 1.4;
  double covolume = 0;         ///< m3/m2, of all its molecules
  double exchange = 0;         ///< m/s
  double energy_at_walls = 0;  ///< Pa m, pressure times volume at the temperature of the walls

  /// Pa, at an opening (m). Infinite at the covolume and below.
  double at(double opening) const {
    const double free = opening - covolume;
    return pressure * std::pow(volume / (free > 0.0 ? free : 0.0), exponent);
  }

  /// Exchanges heat with the walls for dt (s), in which the opening (m) went from `before` to `after`: of
  /// second order in dt.
  void exchange_heat(double before, double after, double dt) {
    if (!(exchange > 0.0)) return;
    const double mean = 0.5 * (before + after);
    const double left = std::exp(-dt * exchange / mean);
    volume *= left + (1.0 - left) * energy_at_walls / (at(mean) * (mean - covolume));
  }
};

}  // namespace launchsafe::mpm
