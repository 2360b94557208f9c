// The branchless shape functions against the published branches, and against quadrature where a particle is
// cut at the axis.
#include "launchsafe/mpm/transfer.hpp"
#include "published_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>

namespace {

using namespace launchsafe;
using test_support::PublishedShape;

constexpr double round_off = 1e-13;

/// A particle and the three nodes it may touch: half-length over cell in (0, 1/2], place of its begin in the
/// first cell in [0, 1).
struct Case {
  double cell, half, first_node, position;
};

std::vector<Case> cases(double first_node_least) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<Case> all;
  for (const double share : {0.5, 0.49999, 1.0 / 3.0, 0.25, 1.0 / 6.0, 0.01})
    for (int trial = 0; trial < 200; ++trial) {
      const double cell = 1e-3 + 0.01 * unit(random);
      const double half = share * cell;
      const double first_node = cell * std::floor(first_node_least + 20.0 * unit(random));
      const double begin = trial == 0 ? 0.0 : trial == 1 ? 1.0 - 2.0 * share : unit(random);
      all.push_back({cell, half, first_node, first_node + begin * cell + half});
    }
  return all;
}

TEST(AxialWeights, AreThePublishedBranches) {
  for (const Case& c : cases(-10.0)) {
    const auto weights = mpm::axial_weights(c.position - c.first_node, c.half, c.cell);
    for (int k = 0; k < 3; ++k) {
      const PublishedShape published =
          test_support::planar_shape(c.position - c.first_node - k * c.cell, c.half, c.cell);
      EXPECT_NEAR(weights.value[k], published.value, round_off);
      EXPECT_NEAR(weights.gradient[k] * c.cell, published.gradient * c.cell, round_off);
    }
  }
}

TEST(RadialWeights, AreThePublishedBranches) {
  for (const Case& c : cases(1.0)) {
    const auto weights =
        mpm::axisymmetric_weights(mpm::cut_at_axis(c.position, c.half), c.first_node, c.cell);
    for (int k = 0; k < 3; ++k) {
      const double x = c.position - c.first_node - k * c.cell;
      const PublishedShape published = test_support::axisymmetric_shape(x, c.half, c.cell, c.position);
      const double hoop = test_support::hoop_shape(x, c.half, c.cell, c.position);
      EXPECT_NEAR(weights.value[k], published.value, 20.0 * round_off);
      EXPECT_NEAR(weights.gradient[k] * c.cell, published.gradient * c.cell, 20.0 * round_off);
      EXPECT_NEAR(weights.hoop[k] * c.cell, hoop * c.cell, round_off);
    }
  }
}

TEST(RadialWeights, GiveTheModelsSampleNumber) {
  // Model section 10: L = 1, l = 0.25, r_i = 5, r_p = 5.1.
  const auto weights = mpm::axisymmetric_weights(mpm::cut_at_axis(5.1, 0.25), 4.0, 1.0);
  EXPECT_NEAR(weights.value[1], 0.85267974, 5e-9);
  EXPECT_NEAR(weights.gradient[1], -0.42058824, 5e-9);
  EXPECT_NEAR(weights.hoop[1], 0.16764706, 5e-9);
}

/// Means of the hat function of `node`, its slope, and hat/r over [begin, end] with the weight r, by
/// Simpson's rule on the pieces between kinks, which is exact for the cubics in question.
struct Means {
  double value, gradient, hoop;
};
Means quadrature(double node, double cell, double begin, double end) {
  std::array<double, 5> marks{begin, std::clamp(node - cell, begin, end), std::clamp(node, begin, end),
                              std::clamp(node + cell, begin, end), end};
  Means means{0.0, 0.0, 0.0};
  double weight = 0.0;
  for (std::size_t piece = 0; piece + 1 < marks.size(); ++piece) {
    const double a = marks[piece], b = marks[piece + 1], middle = 0.5 * (a + b);
    const double slope = std::abs(middle - node) >= cell ? 0.0 : (middle < node ? 1.0 / cell : -1.0 / cell);
    const auto hat = [&](double r) { return std::max(0.0, 1.0 - std::abs(r - node) / cell); };
    for (const auto& [r, share] : {std::pair{a, 1.0}, {middle, 4.0}, {b, 1.0}}) {
      const double w = share * (b - a) / 6.0;
      means.value += w * r * hat(r);
      means.gradient += w * r * slope;
      means.hoop += w * hat(r);
      weight += w * r;
    }
  }
  return {means.value / weight, means.gradient / weight, means.hoop / weight};
}

TEST(RadialWeights, OfAParticleCutAtTheAxisAreItsQuadrature) {
  constexpr double cell = 2e-3;
  for (const double half : {1e-3, 5e-4, cell / 6.0})
    for (const double r : {0.05 * half, 0.5 * half, 0.999 * half, half, 1.001 * half, 1.9 * half}) {
      const auto interval = mpm::cut_at_axis(r, half);
      const auto weights = mpm::axisymmetric_weights(interval, 0.0, cell);
      for (int k = 0; k < 3; ++k) {
        const Means means = quadrature(k * cell, cell, std::max(0.0, r - half), r + half);
        EXPECT_NEAR(weights.value[k], means.value, round_off);
        EXPECT_NEAR(weights.gradient[k] * cell, means.gradient * cell, round_off);
        EXPECT_NEAR(weights.hoop[k] * cell, means.hoop * cell, 1e-11);
      }
    }
}

}  // namespace
