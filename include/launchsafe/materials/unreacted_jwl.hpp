// JWL equation of state of an explosive before it reacts, on the isentrope through V = 1, where its pressure
// vanishes.
#pragma once

#include "launchsafe/keys/key.hpp"
#include "launchsafe/materials/jwl.hpp"

namespace launchsafe::materials {

/// What constants must satisfy beyond the range of each.
struct ConstantsFault {
  std::vector<std::string> keys;  ///< that could be meant, the likeliest first; without a prefix
  std::string found, allowed;
};

struct UnreactedJwl {
  JwlParameters constants = unreacted_composition_b();  ///< their density is none of the pressure's matter

  using Isentrope = JwlIsentrope;
  Isentrope isentrope() const { return JwlIsentrope(constants); }

  /// Pressure (Pa, compression positive), bulk modulus -V dp/dV (Pa), and energy (J per m3 at rest, from
  /// rest) on the isentrope at relative volume V.
  double pressure(double volume) const { return jwl_isentropic_pressure(constants, volume); }
  template <class Real>
  Real bulk_modulus(Real volume) const {
    return jwl_isentropic_bulk_modulus(constants, volume);
  }
  double energy(double volume) const;
  /// Pa, at rest.
  double bulk_modulus_at_rest() const { return jwl_bulk_modulus(constants, 1.0, constants.initial_energy); }
  /// Grueneisen coefficient: temperature on the isentrope goes with V to its negative.
  double grueneisen() const { return constants.omega; }

  /// It has the shape of an unreacted explosive's: it resists compression.
  std::optional<ConstantsFault> fault() const;
  static std::vector<keys::Key<UnreactedJwl>> parameters();  ///< keys of scene files
};

}  // namespace launchsafe::materials
