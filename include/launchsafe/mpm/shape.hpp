// uGIMP shape functions of one particle on the three nodes that it can touch (Bardenhagen & Kober 2004;
// axisymmetric form of Nairn & Guilkey 2015). They are written as integrals of the hat function over the
// particle's interval, which gives the published branches (model section 2) without a branch.
#pragma once

#include "launchsafe/math/pack.hpp"

namespace launchsafe::mpm {

/// Weights on the nodes first, first + 1, first + 2. `value` sums to 1, `gradient` (1/m) to 0.
template <class Real>
struct AxialWeights {
  Real value[3];
  Real gradient[3];
};

/// `position` (m) of the particle from the first node, in [half, cell + half]; half-length `half` <= cell/2
/// (m).
template <class Real>
AxialWeights<Real> axial_weights(Real position, double half, double cell) {
  using math::max;
  const Real xi = position * Real(1.0 / cell);
  const Real overlap =
      max(xi + Real(half / cell - 1.0), Real(0.0));  // part of the interval in the second cell
  const Real third = overlap * overlap * Real(0.25 * cell / half);
  const Real slope = overlap * Real(0.5 / half);
  return {{Real(1.0) - xi + third, xi - Real(2.0) * third, third},
          {slope - Real(1.0 / cell), Real(1.0 / cell) - Real(2.0) * slope, slope}};
}

/// As above with the weight r; `hoop` (1/m) is the mean of N/r. In plane strain `hoop` is 0.
template <class Real>
struct RadialWeights {
  Real value[3];
  Real gradient[3];
  Real hoop[3];
};

/// A particle's interval in r, cut at the axis: [centre - half, centre + half] with centre >= half > 0 (m).
template <class Real>
struct RadialInterval {
  Real centre;
  Real half;
};

template <class Real>
RadialInterval<Real> cut_at_axis(Real r, double half) {
  using math::select;
  const Real cut = Real(0.5) * (r + Real(half));
  const auto crosses = r < Real(half);
  return {select(crosses, cut, r), select(crosses, cut, Real(half))};
}

/// `first_node` (m) is the radius of the first node; the interval must begin in the cell after it.
template <class Real>
RadialWeights<Real> axisymmetric_weights(RadialInterval<Real> interval, Real first_node, double cell) {
  using math::max;
  const Real r = interval.centre, half = interval.half;
  const Real inverse_area = Real(0.5) / (half * r);  // 1 / integral of r dr
  const Real second_node = first_node + Real(cell);
  const Real overlap = max(r + half - second_node, Real(0.0));  // m, in the second cell
  const Real inverse_cell(1.0 / cell);
  const Real second_share = overlap * (second_node + Real(0.5) * overlap) * inverse_area;  // of integral r dr
  const Real third =
      overlap * overlap * (Real(0.5) * second_node + Real(1.0 / 3.0) * overlap) * inverse_area * inverse_cell;
  const Real xi = (r + half * half / (Real(3.0) * r) - first_node) * inverse_cell;
  const Real planar_xi = (r - first_node) * inverse_cell;
  const Real planar_third = Real(0.25) * overlap * overlap * inverse_cell / half;
  const Real inverse_r = Real(1.0) / r;
  return {{Real(1.0) - xi + third, xi - Real(2.0) * third, third},
          {(second_share - Real(1.0)) * inverse_cell, (Real(1.0) - Real(2.0) * second_share) * inverse_cell,
           second_share * inverse_cell},
          {(Real(1.0) - planar_xi + planar_third) * inverse_r,
           (planar_xi - Real(2.0) * planar_third) * inverse_r, planar_third * inverse_r}};
}

}  // namespace launchsafe::mpm
