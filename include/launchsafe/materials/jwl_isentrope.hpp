// The JWL isentrope through V = 1 as a polynomial: what a step of the charge pays for its pressure.
#pragma once

#include "launchsafe/materials/jwl.hpp"
#include "launchsafe/math/polynomial.hpp"

#include <array>

namespace launchsafe::materials {

/// p(V) of `jwl_isentropic_pressure` near V = 1, where launches are, without exponentials: p(1) + x P(x), x =
/// V - 1. The interval, at most [0.85, 1.1], is as wide as the law's constants allow for the polynomial to be
/// as exact as the closed form can be computed; beyond it the closed form itself is taken. A law whose
/// pressure at V = 1 vanishes but for round-off gives exactly 0 there.
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

  /// The interval of x, and the largest difference (Pa) from the closed form found in it when this was made.
  double lowest() const { return lowest_; }
  double highest() const { return highest_; }
  double error() const { return error_; }

 private:
  template <class Real>
  [[gnu::noinline, gnu::cold]] Real far_pressure(Real x) const {
    return jwl_isentropic_pressure(law_, Real(1.0) + x);
  }
  /// Fits the interval; true where the fit is as exact as the closed form.
  bool fit();

  JwlParameters law_;
  std::array<double, 16> coefficients_{};
  double at_rest_ = 0, lowest_ = -0.15, highest_ = 0.1, error_ = 0;
};

}  // namespace launchsafe::materials
