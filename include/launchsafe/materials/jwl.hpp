// Jones-Wilkins-Lee equation of state of the unreacted explosive, on its isentrope (paper Eq. 32).
#pragma once

#include "launchsafe/keys/key.hpp"
#include "launchsafe/math/pack.hpp"
#include "launchsafe/math/polynomial.hpp"

#include <limits>

namespace launchsafe::materials {

/// p = A (1 - w/(R1 V)) exp(-R1 V) + B (1 - w/(R2 V)) exp(-R2 V) + w E/V; V relative volume, E per initial
/// volume.
struct JwlParameters {
  double a = 778.1e11;                 ///< A, Pa [P]
  double b = -5.031e9;                 ///< B, Pa [P]
  double r1 = 11.3;                    ///< R1 [P]
  double r2 = 1.13;                    ///< R2 [P]
  double omega = 0.8938;               ///< w [P]
  double initial_energy = -6.11861e8;  ///< E(V = 1), J per m3 of initial volume; makes p(V = 1) vanish [D]
};

/// Unreacted Composition B. The initial energy is computed so that p(V = 1) = 0 to round-off.
JwlParameters unreacted_composition_b();

/// Energy (J per m3 of initial volume) that belongs to the two exponentials of the isentrope, A/R1 exp(-R1 V)
/// + B/R2 exp(-R2 V).
template <class Real>
Real jwl_cold_energy(const JwlParameters& m, Real v) {
  using math::exp;
  return Real(m.a / m.r1) * exp(Real(-m.r1) * v) + Real(m.b / m.r2) * exp(Real(-m.r2) * v);
}

/// Pressure (Pa) on the isentrope through V = 1 with the law's initial energy: with E beyond the cold energy
/// going with V^(-w), p = A exp(-R1 V) + B exp(-R2 V) + w K V^(-1-w), K = E(1) - cold energy(1). NaN for a
/// volume that is none (V <= 0).
template <class Real>
Real jwl_isentropic_pressure(const JwlParameters& m, Real v) {
  using math::exp;
  using math::pow;
  using math::select;
  const double thermal = m.omega * (m.initial_energy - jwl_cold_energy(m, 1.0));
  const Real pressure = Real(m.a) * exp(Real(-m.r1) * v) + Real(m.b) * exp(Real(-m.r2) * v) +
                        Real(thermal) * pow(v, Real(-1.0 - m.omega));
  return select(v > Real(0.0), pressure, Real(std::numeric_limits<double>::quiet_NaN()));
}

/// Bulk modulus -V dp/dV (Pa) on that isentrope.
template <class Real>
Real jwl_isentropic_bulk_modulus(const JwlParameters& m, Real v) {
  using math::exp;
  using math::pow;
  const double thermal = m.omega * (m.initial_energy - jwl_cold_energy(m, 1.0));
  return v * (Real(m.a * m.r1) * exp(Real(-m.r1) * v) + Real(m.b * m.r2) * exp(Real(-m.r2) * v)) +
         Real(thermal * (1.0 + m.omega)) * pow(v, Real(-1.0 - m.omega));
}

/// Energy (J per m3 at rest, from rest) on that isentrope at relative volume V > 0.
double jwl_isentropic_energy(const JwlParameters& m, double volume);

/// Bulk modulus (Pa) at V = 1.
double jwl_bulk_modulus_at_rest(const JwlParameters& m);

/// What a step of the charge pays for its pressure: p(V) of `jwl_isentropic_pressure` near V = 1, where
/// launches are, without exponentials: p(1) + x P(x), x = V - 1. The interval, at most [0.85, 1.1], is as
/// wide as the law's constants allow for the polynomial to be as exact as the closed form can be computed;
/// beyond it the closed form itself is taken. A law whose pressure at V = 1 vanishes but for round-off gives
/// exactly 0 there.
class JwlIsentrope {
 public:
  explicit JwlIsentrope(const JwlParameters& law);

  /// Pressure (Pa, compression positive) at V = 1 + x. NaN for a volume that is none.
  template <class Real>
  Real pressure(Real x) const {
    const Real near = Real(at_rest_) + x * math::polynomial(coefficients_, x);
    const auto inside = (x >= Real(lowest_)) & (x <= Real(highest_));
    if (!math::any(!inside)) [[likely]]
      return near;
    return math::select(inside, near, far_pressure(x));
  }

 private:
  template <class Real>
  [[gnu::noinline, gnu::cold]] Real far_pressure(Real x) const {
    return jwl_isentropic_pressure(law_, Real(1.0) + x);
  }
  /// Fits the interval; true where the fit is as exact as the closed form.
  bool fit();

  JwlParameters law_;
  std::array<double, 16> coefficients_{};
  double at_rest_ = 0, lowest_ = -0.15, highest_ = 0.1;
};

/// What constants must satisfy beyond the range of each.
struct ConstantsFault {
  std::vector<std::string> keys;  ///< that could be meant, the likeliest first; without a prefix
  std::string found, allowed;
};
/// Fault of a law that has not the shape of an unreacted explosive's: R1 above R2, and it resists
/// compression.
std::optional<ConstantsFault> fault_of(const JwlParameters& m);

std::vector<keys::Key<JwlParameters>> jwl_keys();  ///< keys of scene files

}  // namespace launchsafe::materials
