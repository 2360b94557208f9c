// Symmetric trace-free tensors of an axisymmetric body.
#pragma once

#include "launchsafe/math/pack.hpp"

namespace launchsafe::math {

/// A deviator with the components rr, xx and rx; the hoop component is tt = -(rr + xx). The unit is that of
/// what it holds (Pa, 1/s, or 1).
template <class Real>
struct Deviator {
  Real rr{0.0}, xx{0.0}, rx{0.0};

  Real tt() const { return -(rr + xx); }
  friend Deviator operator+(Deviator a, Deviator b) { return {a.rr + b.rr, a.xx + b.xx, a.rx + b.rx}; }
  friend Deviator operator-(Deviator a, Deviator b) { return {a.rr - b.rr, a.xx - b.xx, a.rx - b.rx}; }
  friend Deviator operator*(Real factor, Deviator a) { return {factor * a.rr, factor * a.xx, factor * a.rx}; }
};

/// Double contraction A : B over all nine components.
template <class Real>
Real contract(Deviator<Real> a, Deviator<Real> b) {
  return a.rr * b.rr + a.xx * b.xx + a.tt() * b.tt() + Real(2.0) * a.rx * b.rx;
}

/// Von Mises equivalent of a stress deviator, sqrt(3/2 S:S).
template <class Real>
Real von_mises(Deviator<Real> stress) {
  return sqrt(Real(1.5) * contract(stress, stress));
}

/// Equivalent of a strain(-rate) deviator, sqrt(2/3 e:e).
template <class Real>
Real equivalent_strain(Deviator<Real> strain) {
  return sqrt(Real(2.0 / 3.0) * contract(strain, strain));
}

/// The in-plane rotation of one step: cosine and sine of the angle, from the spin increment.
template <class Real>
struct Rotation {
  Real cosine{1.0}, sine{0.0};
};

/// Rotation by the angle `spin` = 1/2 (dv_r/dx - dv_x/dr) dt (rad), by the half-angle form (1 - h^2, 2h)/(1 +
/// h^2), h = spin/2: orthogonal to round-off for any angle, and equal to the angle itself to second order, as
/// the Jaumann rate asks (Hughes & Winget 1980).
template <class Real>
Rotation<Real> rotation_of(Real spin) {
  using math::any;
  using math::select;
  const Real half = Real(0.5) * spin, square = half * half;
  Real scale = Real(1.0) - square + square * square;  // 1/(1 + h^2) where h^6 is below round-off
  const auto small = square < Real(1e-6);
  if (any(!small)) [[unlikely]]
    scale = select(small, scale, Real(1.0) / (Real(1.0) + square));
  return {(Real(1.0) - square) * scale, Real(2.0) * half * scale};
}

/// R S R^T for the in-plane rotation with W_rx = 1/2 (dv_r/dx - dv_x/dr).
template <class Real>
Deviator<Real> rotate(Deviator<Real> s, Rotation<Real> q) {
  const Real cc = q.cosine * q.cosine, ss = q.sine * q.sine, cs = q.cosine * q.sine;
  return {cc * s.rr + ss * s.xx + Real(2.0) * cs * s.rx, ss * s.rr + cc * s.xx - Real(2.0) * cs * s.rx,
          cs * (s.xx - s.rr) + (cc - ss) * s.rx};
}

/// A deviator by orthonormal components, so that its double contraction is a sum of three products and the
/// in-plane rotation leaves the first component alone: sqrt(3/2) tt, (rr - xx)/sqrt(2), sqrt(2) rx.
template <class Real>
struct DeviatorVector {
  Real hoop{0.0}, difference{0.0}, shear{0.0};

  friend DeviatorVector operator+(DeviatorVector a, DeviatorVector b) {
    return {a.hoop + b.hoop, a.difference + b.difference, a.shear + b.shear};
  }
  friend DeviatorVector operator-(DeviatorVector a, DeviatorVector b) {
    return {a.hoop - b.hoop, a.difference - b.difference, a.shear - b.shear};
  }
  friend DeviatorVector operator*(Real factor, DeviatorVector a) {
    return {factor * a.hoop, factor * a.difference, factor * a.shear};
  }
};

template <class Real>
DeviatorVector<Real> vector_of(Deviator<Real> a) {
  return {Real(-1.2247448713915890491) * (a.rr + a.xx), Real(0.70710678118654752440) * (a.rr - a.xx),
          Real(1.4142135623730950488) * a.rx};
}

template <class Real>
Deviator<Real> deviator_of(DeviatorVector<Real> a) {
  const Real in_plane = Real(-0.40824829046386301637) * a.hoop;  // (rr + xx)/2
  const Real half = Real(0.70710678118654752440) * a.difference;
  return {in_plane + half, in_plane - half, Real(0.70710678118654752440) * a.shear};
}

/// Double contraction A : B.
template <class Real>
Real contract(DeviatorVector<Real> a, DeviatorVector<Real> b) {
  return a.hoop * b.hoop + a.difference * b.difference + a.shear * b.shear;
}

/// R S R^T, given the rotation by twice the angle of R: difference and shear turn by that.
template <class Real>
DeviatorVector<Real> rotate_by_twice(DeviatorVector<Real> a, Rotation<Real> q) {
  return {a.hoop, q.cosine * a.difference + q.sine * a.shear, q.cosine * a.shear - q.sine * a.difference};
}

/// The rotation by twice the angle.
template <class Real>
Rotation<Real> twice(Rotation<Real> q) {
  return {q.cosine * q.cosine - q.sine * q.sine, Real(2.0) * q.cosine * q.sine};
}

}  // namespace launchsafe::math
