// Gather and scatter of eight particles against a scalar reference on the published shape functions, and with
// known fields.
#include "launchsafe/mpm/transfer.hpp"

#include "published_shapes.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

namespace {

using namespace launchsafe;
using math::Pack;

struct Layout {
  int particles_per_cell;
  bool crossing;  ///< lanes lie in any cells, not in consecutive ones
};

void PrintTo(const Layout& layout, std::ostream* stream) {
  *stream << layout.particles_per_cell << " per cell" << (layout.crossing ? ", crossing" : "");
}

class Transfer : public testing::TestWithParam<Layout> {
 protected:
  Transfer() : grid_(mpm::make_grid(test_support::steel_bar(0.1, 0.02, 2.5e-3))), random_(11) {
    half_x_ = 0.5 * grid_.dx / GetParam().particles_per_cell;
    half_r_ = 0.5 * grid_.dr / GetParam().particles_per_cell;
  }

  double uniform(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }
  Pack eight(double from, double to) {
    Pack pack(0.0);
    for (std::size_t lane = 0; lane < math::pack_width; ++lane) pack.set(lane, uniform(from, to));
    return pack;
  }
  /// Eight particles in one row, in consecutive cells or anywhere.
  void place() {
    const double row = uniform(half_r_, 0.02 - half_r_);
    const double begin = uniform(0.001, 0.05);
    for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
      x_.set(lane,
             GetParam().crossing ? uniform(0.001, 0.099) : begin + grid_.dx * static_cast<double>(lane));
      r_.set(lane, GetParam().crossing ? uniform(half_r_, 0.019) : row);
    }
  }
  mpm::StencilContext context() const { return {grid_, grid_.origin_x, half_x_, half_r_}; }
  double node_x(int i) const { return grid_.origin_x + i * grid_.dx; }
  double node_r(int j) const { return (j - mpm::Grid::radial_padding) * grid_.dr; }

  /// Calls f(node, S_x, G_x, S_r, G_r, T) for every node of the grid.
  template <class F>
  void for_each_node(double x, double r, F&& f) const {
    for (int j = 0; j < grid_.nodes_r; ++j)
      for (int i = 0; i < grid_.nodes_x; ++i) {
        const auto axial = test_support::planar_shape(x - node_x(i), half_x_, grid_.dx);
        const double from_node = r - node_r(j);
        const auto radial = test_support::axisymmetric_shape(from_node, half_r_, grid_.dr, r);
        const double hoop = test_support::hoop_shape(from_node, half_r_, grid_.dr, r);
        f(grid_.index(i, j), axial.value, axial.gradient, radial.value, radial.gradient, hoop);
      }
  }

  /// Nodal values of a function of (x, r).
  template <class F>
  void fill(math::AlignedArray& field, F&& f) {
    for (int j = 0; j < grid_.nodes_r; ++j)
      for (int i = 0; i < grid_.nodes_x; ++i) field[grid_.index(i, j)] = f(node_x(i), node_r(j));
  }

  mpm::Grid grid_;
  std::mt19937_64 random_;
  double half_x_ = 0, half_r_ = 0;
  Pack x_{0.0}, r_{0.0};
};

const mpm::Mask everyone = mpm::Pack(0.0) <= mpm::Pack(0.0);

TEST_P(Transfer, GathersWhatAScalarReferenceGathers) {
  for (auto* field :
       {&grid_.velocity_x, &grid_.velocity_r, &grid_.velocity_increment_x, &grid_.velocity_increment_r})
    fill(*field, [&](double, double) { return uniform(-1.0, 1.0); });
  for (int trial = 0; trial < 20; ++trial) {
    place();
    const mpm::GridToParticle g = mpm::grid_to_particle(grid_, mpm::stencil_of(context(), x_, r_), everyone);
    for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
      std::array<double, 9> expected{};
      for_each_node(x_[lane], r_[lane],
                    [&](std::size_t n, double sx, double gx, double sr, double gr, double t) {
                      const double vx = grid_.velocity_x[n], vr = grid_.velocity_r[n];
                      const std::array<double, 9> terms{sx * sr * vx,
                                                        sx * sr * vr,
                                                        sx * sr * grid_.velocity_increment_x[n],
                                                        sx * sr * grid_.velocity_increment_r[n],
                                                        sx * gr * vr * grid_.dr,
                                                        gx * sr * vx * grid_.dr,
                                                        sx * t * vr * grid_.dr,
                                                        gx * sr * vr * grid_.dr,
                                                        sx * gr * vx * grid_.dr};
                      for (std::size_t k = 0; k < terms.size(); ++k) expected[k] += terms[k];
                    });
      const std::array<Pack, 9> found{g.velocity_x,           g.velocity_r,         g.velocity_increment_x,
                                      g.velocity_increment_r, g.rate_rr * grid_.dr, g.rate_xx * grid_.dr,
                                      g.rate_tt * grid_.dr,   g.vr_by_x * grid_.dr, g.vx_by_r * grid_.dr};
      for (std::size_t k = 0; k < found.size(); ++k)
        EXPECT_NEAR(found[k][lane], expected[k], 1e-12) << "quantity " << k << ", lane " << lane;
    }
  }
}

TEST_P(Transfer, ScattersWhatAScalarReferenceScatters) {
  std::vector<std::array<double, 5>> expected(grid_.nodes());
  for (int trial = 0; trial < 10; ++trial) {
    place();
    const mpm::ParticleToGrid p{eight(1, 2),  eight(-1, 1), eight(-1, 1), eight(1, 2),
                                eight(-1, 1), eight(-1, 1), eight(-1, 1), eight(-1, 1)};
    const mpm::Mask some = trial % 2 == 0 ? everyone : p.velocity_x > Pack(0.0);
    mpm::particle_to_grid(grid_, mpm::stencil_of(context(), x_, r_), p, some);
    for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
      if (some.lanes[lane] == 0) continue;
      for_each_node(x_[lane], r_[lane],
                    [&](std::size_t n, double sx, double gx, double sr, double gr, double t) {
                      const double mass = p.mass[lane] * sx * sr, volume = p.volume[lane];
                      expected[n][0] += mass;
                      expected[n][1] += mass * p.velocity_x[lane];
                      expected[n][2] += mass * p.velocity_r[lane];
                      expected[n][3] -= volume * (p.stress_rx[lane] * gr * sx + p.stress_xx[lane] * sr * gx);
                      expected[n][4] -= volume * (p.stress_rr[lane] * gr * sx + p.stress_rx[lane] * sr * gx +
                                                  p.stress_tt[lane] * t * sx);
                    });
    }
  }
  for (std::size_t n = 0; n < grid_.nodes(); ++n) {
    EXPECT_NEAR(grid_.mass[n], expected[n][0], 1e-12);
    EXPECT_NEAR(grid_.momentum_x[n], expected[n][1], 1e-12);
    EXPECT_NEAR(grid_.momentum_r[n], expected[n][2], 1e-12);
    EXPECT_NEAR(grid_.force_x[n] * grid_.dx, expected[n][3] * grid_.dx, 1e-12);
    EXPECT_NEAR(grid_.force_r[n] * grid_.dx, expected[n][4] * grid_.dx, 1e-12);
  }
}

TEST_P(Transfer, ReadsALinearFieldExactly) {
  // v_x = 3 + 40 x + 50 r, v_r = 70 r + 20 x r.
  fill(grid_.velocity_x, [](double x, double r) { return 3.0 + 40.0 * x + 50.0 * r; });
  fill(grid_.velocity_r, [](double, double r) { return 70.0 * r; });
  fill(grid_.velocity_increment_x, [](double, double) { return 5.0; });
  for (int trial = 0; trial < 20; ++trial) {
    place();
    const mpm::GridToParticle g = mpm::grid_to_particle(grid_, mpm::stencil_of(context(), x_, r_), everyone);
    for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
      const double r = r_[lane];
      // Weighted with r, the particle's mean radius is its centre of area, r + l^2/(3 r).
      const double mean_r = r + half_r_ * half_r_ / (3.0 * r);
      EXPECT_NEAR(g.velocity_x[lane], 3.0 + 40.0 * x_[lane] + 50.0 * mean_r, 1e-12);
      EXPECT_NEAR(g.velocity_r[lane], 70.0 * mean_r, 1e-12);
      EXPECT_NEAR(g.velocity_increment_x[lane], 5.0, 1e-12);
      EXPECT_NEAR(g.rate_xx[lane], 40.0, 1e-9);
      EXPECT_NEAR(g.vx_by_r[lane], 50.0, 1e-9);
      EXPECT_NEAR(g.rate_rr[lane], 70.0, 1e-9);
      EXPECT_NEAR(g.rate_tt[lane], 70.0, 1e-9);
      EXPECT_NEAR(g.vr_by_x[lane], 0.0, 1e-9);
    }
  }
}

TEST_P(Transfer, FlagsParticlesOffTheGrid) {
  place();
  const auto expect_only_lane_1_off = [this](const Pack& x, const Pack& r) {
    const mpm::Stencil stencil = mpm::stencil_of(context(), x, r);
    for (std::size_t lane = 0; lane < math::pack_width; ++lane)
      EXPECT_EQ(stencil.inside.lanes[lane] != 0, lane != 1) << lane;
  };
  for (const double off : {grid_.origin_x - 1.0, std::nan("")}) {
    Pack x = x_;
    x.set(1, off);
    expect_only_lane_1_off(x, r_);
  }
  Pack r = r_;
  r.set(1, 1.0);
  expect_only_lane_1_off(x_, r);
}

INSTANTIATE_TEST_SUITE_P(Layouts, Transfer,
                         testing::Values(Layout{1, false}, Layout{2, false}, Layout{3, false},
                                         Layout{1, true}, Layout{2, true}, Layout{3, true}));

}  // namespace
