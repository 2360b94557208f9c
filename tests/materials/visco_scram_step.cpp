// The charge's step of Visco-SCRAM against the plain form of the same equations.
#include "support/visco_scram_update.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace {

using namespace launchsafe::materials;
using launchsafe::math::Deviator;
using launchsafe::math::Pack;
using launchsafe::test_support::plain_update;
namespace math = launchsafe::math;

struct Solid {
  std::string name;
  ViscoScramParameters parameters;
};

template <class Change>
Solid changed(std::string name, Change change) {
  Solid solid{std::move(name), {}};
  change(solid.parameters);
  return solid;
}

std::vector<Solid> solids() {
  using P = ViscoScramParameters;
  return {{"default", {}},
          changed("no friction of crack faces", [](P& p) { p.face_friction = 0.0; }),
          changed("no flaws", [](P& p) { p.flaw_size = 0.0; }),
          changed("frozen cracks", [](P& p) { p.growth = false; }),
          changed("no cracks yet", [](P& p) { p.initial_crack_radius = 0.0; }),
          changed("cracks at their bound", [](P& p) { p.largest_crack_radius = 40e-6; }),
          changed("odd exponent", [](P& p) { p.growth_exponent = 7.0; }),
          changed("fractional exponent", [](P& p) { p.growth_exponent = 4.6; }),
          changed("small exponent", [](P& p) { p.growth_exponent = 1.0; }),
          changed("large exponent", [](P& p) { p.growth_exponent = 60.0; }),
          changed("small flaws", [](P& p) { p.flaw_size = 2e-4; }),
          changed("first element relaxes", [](P& p) { p.relaxation_rates[0] = 4e4; }),
          changed("nothing relaxes", [](P& p) { p.relaxation_rates = {}; }),
          changed("short times",
                  [](P& p) {
                    p.relaxation_rates = {0.0, 1e5, 1e7, 1e9, 1e12};
                  }),
          changed("an element without stiffness", [](P& p) { p.shear_moduli[3] = 0.0; })};
}

/// A particle in both forms.
struct Twin {
  ViscoScramState<double> plain;
  ViscoScramStep::State<double> lean;

  explicit Twin(const ViscoScramState<double>& state) : plain(state), lean(ViscoScramStep::state_of(state)) {}
};

/// Random states of up to `stress` (Pa) an element, cracks of up to 30 times the initial radius.
Twin random_twin(const ViscoScramParameters& p, double stress, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  ViscoScramState<double> state{};
  for (std::size_t n = 0; n < maxwell_elements; ++n) {
    const double size = p.shear_moduli[n] > 0.0 ? stress : 0.0;
    state.elements[n] = {size * share(random), size * share(random), size * share(random)};
  }
  state.crack_radius = p.initial_crack_radius * std::pow(30.0, std::abs(share(random)));
  return Twin(state);
}

double size_of(const ViscoScramState<double>& s) {
  double size = 0.0;
  for (const auto& element : s.elements) size += math::von_mises(element);
  return size;
}

TEST(ViscoScramStep, IsThePlainFormToRoundOff) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  for (const Solid& solid : solids()) {
    const ViscoScramParameters& p = solid.parameters;
    ViscoScramStep law(p);
    int grown = 0;
    for (const double dt : {1e-9, 2.5e-7, 4e-6}) {
      law.set_step(dt);
      const auto factors = relaxation(p, dt);
      for (int k = 0; k < 3000; ++k) {
        Twin twin = random_twin(p, 3e6 * std::abs(share(random)), random);
        const double strain = 2e-4 * std::pow(share(random), 3.0), pressure = 2e8 * share(random);
        const Deviator<double> de{strain * share(random), strain * share(random), strain * share(random)};
        const auto old = twin.plain;
        const auto lost = plain_update(p, factors, twin.plain, de, pressure);
        const auto end = law.update(twin.lean, vector_of(de), pressure);
        // Of the stresses that came together 1e-12, and of q S, which cancels in the strain applied,
        // round-off.
        const double q = crack_strain_ratio(p, twin.plain.crack_radius);
        const double share_of = 1e-12 + 4.0 * 0x1p-52 * q;
        const double size =
            size_of(old) + size_of(twin.plain) + 2.0 * p.shear_modulus() * math::equivalent_strain(de);
        const std::string where = solid.name + ", dt " + std::to_string(dt) + ", case " + std::to_string(k);
        EXPECT_LE(math::von_mises(deviator_of(end.state.total) - total_deviator(twin.plain)), share_of * size)
            << where;
        for (std::size_t n = 1; n < maxwell_elements; ++n) {
          EXPECT_LE(math::von_mises(deviator_of(end.state.elements[n - 1]) - twin.plain.elements[n]),
                    share_of * size)
              << where;
        }
        EXPECT_NEAR(end.state.crack_radius, twin.plain.crack_radius, 1e-12 * twin.plain.crack_radius)
            << where;
        const double energy = size * size / p.shear_modulus() + lost.crack;
        EXPECT_NEAR(end.viscous, lost.viscous, share_of * energy) << where;
        EXPECT_NEAR(end.crack, lost.crack, share_of * energy) << where;
        if (twin.plain.crack_radius > old.crack_radius) ++grown;
      }
    }
    const bool can_grow = p.growth && p.flaw_size > 0.0 && p.initial_crack_radius > 0.0;
    EXPECT_EQ(grown > 100, can_grow) << solid.name << " " << grown;  // or the comparison would say little
  }
}

}  // namespace
