// What every law that there is must pass, by the interface that the mechanics uses alone: it answers nothing
// to nothing, turns with the material, is continuous along any path, takes back no energy that it dissipated,
// stays finite, and is the same in a Pack, whatever its neighbours do. A new law is covered by being one of
// materials::Law.
#include "launchsafe/materials/laws.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace {

using namespace launchsafe::materials;
using launchsafe::math::Deviator;
using launchsafe::math::Pack;
namespace math = launchsafe::math;

template <class Laws>
struct TypesOf;
template <class... One>
struct TypesOf<std::variant<One...>> {
  using type = testing::Types<One...>;
};

template <class Law>
struct AnyLaw : testing::Test {};
TYPED_TEST_SUITE(AnyLaw, TypesOf<Law>::type);

constexpr double start_temperature = 300.0;  // K

template <class Real>
struct Strain {
  Deviator<Real> deviator{};
  Real spin{0.0}, volumetric{0.0};
};

/// One particle, or eight.
template <class Law, class Real>
struct Particle {
  Law law;
  typename Law::Integrator integrator{law};
  State<Law, Real> state = load_state<Law>(
      [start = law.initial_state(start_temperature)](std::size_t field) { return Real(start[field]); });
  Real volume{1.0}, pressure{0.0}, temperature{start_temperature};

  Response<Real> step(const Strain<Real>& strain, double dt) {
    integrator.set_step(dt);
    const Real after =
        volume * (Real(1.0) + Real(0.5) * strain.volumetric) / (Real(1.0) - Real(0.5) * strain.volumetric);
    const Response<Real> response = integrator.update(
        {strain.deviator, math::rotation_of(strain.spin), volume, after}, state, pressure, temperature);
    volume = after;
    pressure = response.pressure;
    return response;
  }
};

/// Stress in which a strain of this size shows: the law's stiffness times it.
template <class Law>
double stress_of(double strain) {
  const Law law;
  return (law.bulk_modulus() + 2.0 * law.shear_modulus()) * strain;
}

/// A smooth random way through strain space that comes and goes, from rest: sums of waves over `duration`.
class Path {
 public:
  Path(std::uint64_t seed, double shear, double volume, double turn) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    const double sizes[] = {shear, shear, shear, turn, volume};
    for (std::size_t part = 0; part < amplitude_.size(); ++part)
      for (double& amplitude : amplitude_[part]) amplitude = sizes[part] * share(random);
  }
  /// What happens between two shares of the duration.
  Strain<double> between(double begin, double end) const {
    const auto change = [&](std::size_t part) { return value(part, end) - value(part, begin); };
    return {{change(0), change(1), change(2)}, change(3), change(4)};
  }

 private:
  double value(std::size_t part, double share) const {
    double sum = 0.0;
    for (std::size_t wave = 0; wave < amplitude_[part].size(); ++wave)
      sum += amplitude_[part][wave] * std::sin(3.1 * static_cast<double>(wave + 1) * share);
    return sum;
  }
  std::array<std::array<double, 4>, 5> amplitude_{};
};

constexpr double duration = 1e-3;  // s

double largest_component(const Deviator<double>& a) {
  return std::max({std::abs(a.rr), std::abs(a.xx), std::abs(a.rx)});
}

/// Largest change of a stress component or the pressure in one of `steps` steps along the path.
template <class Law>
double largest_jump(const Path& path, int steps) {
  Particle<Law, double> particle;
  Deviator<double> before{};
  double largest = 0.0;
  for (int k = 0; k < steps; ++k) {
    const double pressure = particle.pressure;
    const auto response =
        particle.step(path.between(double(k) / steps, double(k + 1) / steps), duration / steps);
    largest = std::max(
        {largest, largest_component(response.deviator - before), std::abs(response.pressure - pressure)});
    before = response.deviator;
  }
  return largest;
}

TYPED_TEST(AnyLaw, RestStaysRest) {
  for (const double dt : {1e-12, 1e-7, 1e-3}) {
    Particle<TypeParam, double> particle;
    const auto before = particle.state;
    for (int k = 0; k < 100; ++k) {
      const auto response = particle.step({}, dt);
      ASSERT_EQ(largest_component(response.deviator), 0.0);
      ASSERT_EQ(response.pressure, 0.0);
      ASSERT_EQ(response.plastic + response.viscous + response.crack, 0.0);
    }
    EXPECT_EQ(particle.state, before);
    EXPECT_EQ(particle.temperature, start_temperature);
  }
}

TYPED_TEST(AnyLaw, NothingInNoTimeChangesNothing) {
  // From a loaded state; 1e-20 s is a share of 1e-13 of any relaxation time down to 0.1 us.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Path path(seed, 0.01, 0.003, 0.1);
    Particle<TypeParam, double> particle;
    for (int k = 0; k < 200; ++k) particle.step(path.between(k / 400.0, (k + 1) / 400.0), duration / 400);
    const auto before = TypeParam::deviator(particle.state);
    const double pressure = particle.pressure;
    const auto response = particle.step({}, 1e-20);
    EXPECT_LE(largest_component(response.deviator - before), 1e-12 * stress_of<TypeParam>(0.01)) << seed;
    EXPECT_NEAR(response.pressure, pressure, 1e-12 * stress_of<TypeParam>(0.01)) << seed;
  }
}

TYPED_TEST(AnyLaw, IsContinuousAlongRandomPaths) {
  // Through compression and tension, yield and fracture, with the steps of a launch; a jump of the law itself
  // would not shrink with the step. Twice as many steps: half, and a tenth for the curvature of the path.
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    for (const double shear : {0.001, 0.03}) {
      const Path path(seed, shear, 0.003, 0.1);
      const double coarse = largest_jump<TypeParam>(path, 32000), fine = largest_jump<TypeParam>(path, 64000);
      EXPECT_LE(fine, 0.6 * coarse) << seed << " " << shear;
    }
  }
}

TYPED_TEST(AnyLaw, TurnsWithTheMaterial) {
  // The same path seen from a frame that starts out turned and spins: strains, stresses and pressures are
  // those of the frame at rest, turned.
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Path path(seed, 0.002, 0.003, 0.0), spinning(seed + 100, 0.0, 0.0, 0.5);
    Particle<TypeParam, double> straight, turned;
    double angle = 0.7;
    constexpr int steps = 400;
    for (int k = 0; k < steps; ++k) {
      auto strain = path.between(double(k) / steps, double(k + 1) / steps);
      const auto expected = straight.step(strain, duration / steps);
      const double spin = spinning.between(double(k) / steps, double(k + 1) / steps).spin;
      // rotation_of turns by 2 atan(spin/2).
      angle += 2.0 * std::atan(0.5 * spin);
      const math::Rotation<double> q{std::cos(angle), std::sin(angle)};
      strain.deviator = math::rotate(strain.deviator, q);
      strain.spin = spin;
      const auto found = turned.step(strain, duration / steps);
      ASSERT_LE(largest_component(found.deviator - math::rotate(expected.deviator, q)),
                1e-9 * stress_of<TypeParam>(0.002))
          << seed << " " << k;
      ASSERT_NEAR(found.pressure, expected.pressure, 1e-9 * stress_of<TypeParam>(0.002)) << seed << " " << k;
    }
  }
}

TYPED_TEST(AnyLaw, DissipationIsNeverNegative) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (const double dt : {1e-9, 1e-7, 1e-5}) {
    Particle<TypeParam, double> particle;
    for (int k = 0; k < 5000; ++k) {
      const double size = 2e-4 * std::cos(0.01 * k);
      const auto response = particle.step(
          {{size * normal(random), size * normal(random), size * normal(random)}, size * normal(random), 0.0},
          dt);
      const double round_off = 1e-15 * stress_of<TypeParam>(1.0) * 0.01 * 0.01;  // strains stay below 1 %
      ASSERT_GE(response.plastic, -round_off) << k;
      ASSERT_GE(response.viscous, -round_off) << k;
      ASSERT_GE(response.crack, -round_off) << k;
    }
  }
}

TYPED_TEST(AnyLaw, LargeStrainsStayFinite) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  for (const double dt : {1e-10, 1e-7, 1e-4}) {
    Particle<TypeParam, double> particle;
    for (int k = 0; k < 500; ++k) {
      // Ten per cent a step, and volumes that stay within a third of the one at rest.
      const double volume = std::log(particle.volume);
      const Strain<double> strain{{0.1 * share(random), 0.1 * share(random), 0.1 * share(random)},
                                  share(random),
                                  0.3 * share(random) - volume};
      const auto response = particle.step(strain, dt);
      ASSERT_TRUE(std::isfinite(largest_component(response.deviator) + response.pressure + response.plastic +
                                response.viscous + response.crack + particle.temperature))
          << k << " " << dt;
      for (const double value : particle.state) ASSERT_TRUE(std::isfinite(value)) << k << " " << dt;
      const double modulus =
          particle.integrator.bulk_modulus(particle.state, particle.volume, particle.pressure);
      ASSERT_TRUE(std::isfinite(modulus)) << k;
      ASSERT_GE(modulus, 0.0) << k;  // or there is no speed of sound to set the step by
    }
  }
}

TYPED_TEST(AnyLaw, BulkModulusIsTheSlopeOfItsPressure) {
  for (const double compression : {0.001, 0.003, 0.01}) {
    const auto compressed = [&](double further) {
      Particle<TypeParam, double> particle;
      for (int k = 0; k < 100; ++k) particle.step({{}, 0.0, -compression / 100}, 1e-7);
      const double modulus =
          particle.integrator.bulk_modulus(particle.state, particle.volume, particle.pressure);
      return std::array<double, 2>{modulus, particle.step({{}, 0.0, further}, 1e-7).pressure};
    };
    const double d = 1e-5;
    const double slope = (compressed(-d)[1] - compressed(d)[1]) / (2.0 * d);
    EXPECT_NEAR(slope / compressed(0.0)[0], 1.0, 1e-6) << compression;
  }
}

/// Eight paths at once.
Strain<Pack> packed(const std::vector<Path>& paths, double begin, double end) {
  Strain<Pack> strain;
  for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
    const auto one = paths[lane].between(begin, end);
    strain.deviator.rr.set(lane, one.deviator.rr);
    strain.deviator.xx.set(lane, one.deviator.xx);
    strain.deviator.rx.set(lane, one.deviator.rx);
    strain.spin.set(lane, one.spin);
    strain.volumetric.set(lane, one.volumetric);
  }
  return strain;
}

/// From hardly strained to beyond yield and fracture.
std::vector<Path> paths_of_all_sizes() {
  std::vector<Path> paths;
  for (std::size_t lane = 0; lane < math::pack_width; ++lane)
    paths.emplace_back(lane + 1, 1e-5 * std::pow(2.5, static_cast<double>(lane)), 0.003, 0.1);
  return paths;
}

TYPED_TEST(AnyLaw, PackAndDoubleAgree) {
  const auto paths = paths_of_all_sizes();
  constexpr int steps = 1000;
  Particle<TypeParam, Pack> eight;
  std::vector<Particle<TypeParam, double>> single(math::pack_width);
  for (int k = 0; k < steps; ++k) {
    const double begin = double(k) / steps, end = double(k + 1) / steps;
    const auto together = eight.step(packed(paths, begin, end), duration / steps);
    for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
      const auto alone = single[lane].step(paths[lane].between(begin, end), duration / steps);
      // Round-off of up to a thousand steps, and 1e-9 of the trial stress by which a return to yield may err.
      const double tolerance = 1e-9 * stress_of<TypeParam>(0.003);
      ASSERT_NEAR(together.deviator.rr[lane], alone.deviator.rr, tolerance) << k << " " << lane;
      ASSERT_NEAR(together.deviator.xx[lane], alone.deviator.xx, tolerance) << k << " " << lane;
      ASSERT_NEAR(together.deviator.rx[lane], alone.deviator.rx, tolerance) << k << " " << lane;
      ASSERT_NEAR(together.pressure[lane], alone.pressure, tolerance) << k << " " << lane;
    }
  }
}

TYPED_TEST(AnyLaw, LaneDoesNotFeelItsNeighbours) {
  // To the bit: each lane beside seven others, and beside seven copies of itself.
  const auto paths = paths_of_all_sizes();
  constexpr int steps = 1000;
  Particle<TypeParam, Pack> mixed;
  std::vector<Particle<TypeParam, Pack>> alike(math::pack_width);
  for (int k = 0; k < steps; ++k) {
    const double begin = double(k) / steps, end = double(k + 1) / steps;
    const auto together = mixed.step(packed(paths, begin, end), duration / steps);
    for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
      const std::vector<Path> same(math::pack_width, paths[lane]);
      const auto alone = alike[lane].step(packed(same, begin, end), duration / steps);
      ASSERT_EQ(together.deviator.rr[lane], alone.deviator.rr[lane]) << k << " " << lane;
      ASSERT_EQ(together.deviator.xx[lane], alone.deviator.xx[lane]) << k << " " << lane;
      ASSERT_EQ(together.deviator.rx[lane], alone.deviator.rx[lane]) << k << " " << lane;
      ASSERT_EQ(together.pressure[lane], alone.pressure[lane]) << k << " " << lane;
      ASSERT_EQ(together.plastic[lane], alone.plastic[lane]) << k << " " << lane;
      ASSERT_EQ(together.viscous[lane], alone.viscous[lane]) << k << " " << lane;
      ASSERT_EQ(together.crack[lane], alone.crack[lane]) << k << " " << lane;
      for (std::size_t field = 0; field < mixed.state.size(); ++field)
        ASSERT_EQ(mixed.state[field][lane], alike[lane].state[field][lane])
            << TypeParam::state[field].name << " " << k << " " << lane;
      ASSERT_EQ(mixed.temperature[lane], alike[lane].temperature[lane]) << k << " " << lane;
    }
  }
}

}  // namespace
