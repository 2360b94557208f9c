// The battery that every law of deviator or pressure must pass: it stays at rest when unloaded, turns with
// the material, never gives energy back that it dissipated, converges with the step at its stated order, and
// is the same in a Pack.
#include "launchsafe/materials/johnson_cook.hpp"
#include "launchsafe/materials/jwl.hpp"
#include "launchsafe/materials/mie_gruneisen.hpp"
#include "launchsafe/materials/visco_scram.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace {

using namespace launchsafe::materials;
using launchsafe::math::Deviator;
using launchsafe::math::Pack;
using launchsafe::math::Rotation;
namespace math = launchsafe::math;

/// One particle of each law. `step` takes a deviatoric and a volumetric strain increment over dt and returns
/// what was dissipated (J/m3).
struct SteelStrength {
  static constexpr double strain_rate = 2000.0, duration = 1e-5, stress_scale = 1e9;
  static constexpr double order = 0.9;  // implicit Euler in the plastic strain
  static constexpr double floor = 0.0;  ///< of the stress scale: errors below it need no order
  template <class Real>
  struct Point {
    JohnsonCookParameters law;
    Deviator<Real> stress{};
    Real plastic_strain{0.0}, temperature{300.0}, pressure{0.0};

    Real step(Deviator<Real> de, Real, double dt) {
      const Deviator<Real> trial = stress + Real(2.0 * law.shear_modulus) * de;
      const auto result = johnson_cook_return(law, trial, plastic_strain, temperature, Real(dt));
      stress = result.stress;
      plastic_strain += result.plastic_strain_increment;
      temperature += Real(law.taylor_quinney / (7830.0 * law.specific_heat)) * result.plastic_work;
      return result.plastic_work;
    }
    void rotate(Rotation<Real> q) { stress = math::rotate(stress, q); }
  };
};

template <bool cracks_grow>
struct ChargeStrength {
  static constexpr double strain_rate = 2000.0, duration = 1e-5, stress_scale = 2e7;
  static constexpr double order = 1.9;
  static constexpr double floor = cracks_grow ? 1e-4 : 0.0;  // sub-steps of a fixed share of c leave this
  template <class Real>
  struct Point {
    ViscoScramParameters law;
    ViscoScramState<Real> state{};
    Deviator<Real> stress{};
    Real pressure{0.0};

    Point() {
      law.growth = cracks_grow;
      law.face_friction = 0.0;
      state.crack_radius = Real(cracks_grow ? law.initial_crack_radius : 0.5e-3);
    }
    Real step(Deviator<Real> de, Real, double dt) {
      const auto lost = visco_scram_update(law, relaxation(law, dt), state, de, pressure);
      stress = total_deviator(state);
      return lost.viscous + lost.crack;
    }
    void rotate(Rotation<Real> q) {
      for (auto& element : state.elements) element = math::rotate(element, q);
      stress = total_deviator(state);
    }
  };
};

struct ChargePressure {
  static constexpr double strain_rate = 2000.0, duration = 1e-5, stress_scale = 1e8, order = 1.9, floor = 0.0;
  template <class Real>
  struct Point {
    JwlParameters law = unreacted_composition_b();
    Deviator<Real> stress{};
    Real volume{1.0}, pressure{0.0}, energy{law.initial_energy};

    Real step(Deviator<Real>, Real dv, double) {
      const Real next = volume + dv;
      const auto state = jwl_compress(law, volume, pressure, energy, next);
      volume = next;
      pressure = state.pressure;
      energy = state.energy;
      return Real(0.0);
    }
    void rotate(Rotation<Real>) {}
  };
};

struct SteelPressure {
  static constexpr double strain_rate = 2000.0, duration = 1e-5, stress_scale = 1e9, order = 1.9, floor = 0.0;
  template <class Real>
  struct Point {
    MieGruneisenParameters law;
    Deviator<Real> stress{};
    Real density{law.density}, pressure{0.0}, energy{0.0};

    Real step(Deviator<Real>, Real dv, double) {
      const Real next = density - Real(law.density) * dv;
      const Real per(1.0 / law.density), one(1.0);
      const auto state =
          mie_gruneisen_compress(law, density * per - one, pressure, energy, next * per - one, Real(0.0));
      density = next;
      pressure = state.pressure;
      energy = state.energy;
      return Real(0.0);
    }
    void rotate(Rotation<Real>) {}
  };
};

/// Strain increments of a smooth path that turns in strain space, between the times t and t + dt, with the
/// given size.
template <class Law>
Deviator<double> increment(double t, double dt, double size) {
  const double phase = t / Law::duration;
  const double width = size * Law::strain_rate * dt;
  return {width * std::cos(3.0 * phase), -0.3 * width * (1.0 + phase), width * std::sin(2.0 * phase)};
}
template <class Law>
double volume_increment(double t, double dt, double size) {
  return -size * Law::strain_rate * dt * (0.5 + t / Law::duration);
}

template <class Law>
struct MaterialLaw : testing::Test {};

using Laws =
    testing::Types<SteelStrength, ChargeStrength<false>, ChargeStrength<true>, ChargePressure, SteelPressure>;
TYPED_TEST_SUITE(MaterialLaw, Laws);

/// The point after the whole path in `steps` midpoint increments, followed by `after(point)` for every step.
template <class Law>
typename Law::template Point<double> driven(int steps, double size = 1.0) {
  typename Law::template Point<double> point;
  const double dt = Law::duration / steps;
  for (int k = 0; k < steps; ++k) {
    const double middle = (k + 0.5) * dt;
    point.step(increment<Law>(middle, dt, size), volume_increment<Law>(middle, dt, size), dt);
  }
  return point;
}

template <class Point>
double difference(const Point& a, const Point& b) {
  return math::von_mises(a.stress - b.stress) + std::abs(a.pressure - b.pressure);
}

TYPED_TEST(MaterialLaw, UnloadedStateStaysUnloaded) {
  typename TypeParam::template Point<double> point;
  for (int k = 0; k < 1000; ++k) {
    EXPECT_EQ(point.step({}, 0.0, 1e-7), 0.0);
    EXPECT_EQ(math::von_mises(point.stress), 0.0);
    EXPECT_NEAR(point.pressure, 0.0, 1e-6);  // round-off of the JWL terms, 1e8 Pa
  }
}

TYPED_TEST(MaterialLaw, ResponseTurnsWithTheMaterial) {
  const auto q = math::rotation_of(0.9);
  typename TypeParam::template Point<double> straight, turned;
  const double dt = TypeParam::duration / 200;
  for (int k = 0; k < 200; ++k) {
    const double dv = volume_increment<TypeParam>(k * dt, dt, 1.0);
    const auto de = increment<TypeParam>(k * dt, dt, 1.0);
    straight.step(de, dv, dt);
    turned.step(math::rotate(de, q), dv, dt);
  }
  EXPECT_LE(math::von_mises(math::rotate(straight.stress, q) - turned.stress),
            1e-10 * TypeParam::stress_scale);
  EXPECT_NEAR(straight.pressure, turned.pressure, 1e-10 * TypeParam::stress_scale);
  straight.rotate(q);
  EXPECT_LE(math::von_mises(straight.stress - turned.stress), 1e-10 * TypeParam::stress_scale);
}

TYPED_TEST(MaterialLaw, DissipationIsNeverNegative) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (const double dt : {1e-9, 1e-7, 1e-5}) {
    typename TypeParam::template Point<double> point;
    for (int k = 0; k < 2000; ++k) {
      // A random walk with a wave on top, so that the path unloads and reloads.
      const double size = 2e-4 * std::cos(0.01 * k);
      const Deviator<double> de{size * normal(random), size * normal(random), size * normal(random)};
      const double lost = point.step(de, 0.0, dt);
      EXPECT_GE(lost, -1e-12 * TypeParam::stress_scale) << "step " << k << " of " << dt;
    }
  }
}

TYPED_TEST(MaterialLaw, ConvergesWithTheStepAtItsOrder) {
  const auto reference = driven<TypeParam>(25600);
  const double coarse = difference(driven<TypeParam>(200), reference);
  const double fine = difference(driven<TypeParam>(800), reference);
  const double order = std::log2(coarse / fine) / 2.0;
  this->RecordProperty("order", std::to_string(order));
  const double floor = TypeParam::floor * TypeParam::stress_scale;
  EXPECT_TRUE(order >= TypeParam::order || std::max(coarse, fine) <= floor)
      << "order " << order << " from errors " << coarse << " and " << fine << " Pa";
  EXPECT_LE(coarse, 1e-2 * TypeParam::stress_scale);
}

TYPED_TEST(MaterialLaw, DoubleAndPackAgree) {
  typename TypeParam::template Point<Pack> packed;
  const int steps = 100;
  const double dt = TypeParam::duration / steps;
  const auto size = [](std::size_t lane) { return 0.1 + 0.2 * static_cast<double>(lane); };
  for (int k = 0; k < steps; ++k) {
    Deviator<Pack> de{};
    Pack dv(0.0);
    for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
      const auto one = increment<TypeParam>((k + 0.5) * dt, dt, size(lane));
      de.rr.set(lane, one.rr);
      de.xx.set(lane, one.xx);
      de.rx.set(lane, one.rx);
      dv.set(lane, volume_increment<TypeParam>((k + 0.5) * dt, dt, size(lane)));
    }
    packed.step(de, dv, dt);
  }
  for (std::size_t lane = 0; lane < math::pack_width; ++lane) {
    const auto single = driven<TypeParam>(steps, size(lane));
    // 100 steps of a few ulp each; growing cracks share sub-steps with their neighbours and amplify the
    // difference.
    const double tolerance = std::is_same_v<TypeParam, ChargeStrength<true>> ? 1e-3 : 1e-12;
    const double scale = TypeParam::stress_scale;
    EXPECT_NEAR(packed.stress.rr[lane], single.stress.rr, tolerance * scale) << lane;
    EXPECT_NEAR(packed.stress.xx[lane], single.stress.xx, tolerance * scale) << lane;
    EXPECT_NEAR(packed.stress.rx[lane], single.stress.rx, tolerance * scale) << lane;
    EXPECT_NEAR(packed.pressure[lane], single.pressure, tolerance * scale) << lane;
  }
}

}  // namespace
