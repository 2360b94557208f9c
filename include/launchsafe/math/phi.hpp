// The phi functions of exponential integrators: phi_0(z) = e^z, phi_k(z) = (phi_{k-1}(z) - 1/(k-1)!)/z.
#pragma once

#include "launchsafe/math/pack.hpp"

#include <array>

namespace launchsafe::math {
namespace detail {

/// Below it (of |z|) six terms are enough.
inline constexpr double small = 1.0 / 256.0;

/// phi_4 = sum_n z^n / (n + 4)!, where the first term that is left out has n = `terms` + 2: with 22 and |z| <
/// 2 below 2^24 / 28! = 6e-23, with 6 and |z| < `small` below small^8 / 12! = 1e-28.
template <int terms, class Real>
std::array<Real, 5> phi_by_series(Real z) {
  Real series = 1.0 / (terms + 5.0);
  for (int n = terms; n >= 1; --n) series = (1.0 + z * series) / (n + 4.0);
  std::array<Real, 5> phi{};
  phi[4] = (1.0 + z * series) / 24.0;
  phi[3] = z * phi[4] + 1.0 / 6.0;
  phi[2] = z * phi[3] + 0.5;
  phi[1] = z * phi[2] + 1.0;
  phi[0] = z * phi[1] + 1.0;
  return phi;
}

/// Beyond.
template <class Real>
std::array<Real, 5> phi_by_recursion(Real z) {
  std::array<Real, 5> phi{};
  phi[0] = exp(z);
  phi[1] = (phi[0] - 1.0) / z;
  phi[2] = (phi[1] - 1.0) / z;
  phi[3] = (phi[2] - 0.5) / z;
  phi[4] = (phi[3] - 1.0 / 6.0) / z;
  return phi;
}

}  // namespace detail

/// phi_0 .. phi_4 at any real z (infinity where e^z overflows), to about 1e-14 relative: a Taylor series for
/// phi_4 and the recursion downward for |z| < 2, the recursion upward beyond, where it no longer cancels.
inline std::array<double, 5> phi_functions(double z) {
  if (std::abs(z) < detail::small) return detail::phi_by_series<6>(z);
  return std::abs(z) < 2.0 ? detail::phi_by_series<22>(z) : detail::phi_by_recursion(z);
}
inline std::array<Pack, 5> phi_functions(Pack z) {
  if (!any(!(abs(z) < Pack(detail::small)))) return detail::phi_by_series<6>(z);
  const Mask converges = abs(z) < Pack(2.0);
  std::array<Pack, 5> phi = detail::phi_by_series<22>(z);
  if (!any(!converges)) return phi;
  const std::array<Pack, 5> large = detail::phi_by_recursion(z);
  for (std::size_t k = 0; k < phi.size(); ++k) phi[k] = select(converges, phi[k], large[k]);
  return phi;
}

}  // namespace launchsafe::math
