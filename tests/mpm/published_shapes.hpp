// uGIMP shape functions as they are printed, branch by branch, one node and one particle at a time: model
// section 2, after Bardenhagen & Kober (2004) and Nairn & Guilkey (2015). The reference for what the program
// computes without branches.
#pragma once

#include <cmath>

namespace launchsafe::test_support {

struct PublishedShape {
  double value = 0;     ///< 1
  double gradient = 0;  ///< 1/m
};

/// Planar weights of a particle of half-length l (m) at x (m) from the node; cell L (m), l <= L/2.
inline PublishedShape planar_shape(double x, double l, double L) {
  const double distance = std::abs(x), s = x < 0.0 ? -1.0 : 1.0;
  if (distance < l) return {1.0 - (x * x + l * l) / (2.0 * L * l), -x / (L * l)};
  if (distance < L - l) return {1.0 - distance / L, -s / L};
  if (distance >= L + l) return {};
  const double reach = L + l - distance;
  return {reach * reach / (4.0 * L * l), -s * reach / (2.0 * L * l)};
}

/// Axisymmetric weights of a particle at radius r_p >= l (m), at x (m) from the node.
inline PublishedShape axisymmetric_shape(double x, double l, double L, double r_p) {
  const PublishedShape planar = planar_shape(x, l, L);
  const double distance = std::abs(x), s = x < 0.0 ? -1.0 : 1.0;
  if (distance <= l)
    return {planar.value + x * (x * x - 3.0 * l * l) / (6.0 * L * l * r_p),
            planar.gradient - (l * l - x * x) / (2.0 * L * l * r_p)};
  if (distance <= L - l) return {planar.value - s * l * l / (3.0 * L * r_p), planar.gradient};
  return {planar.value * (1.0 + s * (L - 2.0 * l - distance) / (3.0 * r_p)),
          planar.gradient * (1.0 + s * (L - l - distance) / (2.0 * r_p))};
}

/// Weight of the hoop rate, 1/m.
inline double hoop_shape(double x, double l, double L, double r_p) {
  return planar_shape(x, l, L).value / r_p;
}

}  // namespace launchsafe::test_support
