// The laws of pressure far from rest: JWL from V = 0.3 to 5, steel up to the Hugoniot's pole, the virial gas
// where it has no meaning, the adiabat of the air at any ratio.
#include "first_of.hpp"
#include "launchsafe/materials/charge.hpp"
#include "launchsafe/materials/ideal_gas.hpp"
#include "launchsafe/materials/jwl.hpp"
#include "launchsafe/materials/mie_gruneisen.hpp"
#include "launchsafe/materials/vlw.hpp"
#include "support/jwl_energy_form.hpp"
#include "support/mie_gruneisen_pressure.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

using namespace launchsafe::materials;
using launchsafe::math::Pack;
using launchsafe::test_support::composition_b_products, launchsafe::test_support::first_of,
    launchsafe::test_support::jwl_pressure, launchsafe::test_support::mie_gruneisen_pressure;

const double not_a_number = std::nan("");
constexpr double infinity = std::numeric_limits<double>::infinity();

// ---- JWL ----

/// Energy on the isentrope through (V = 1, E0): p = A e^(-R1 V) + B e^(-R2 V) + C V^(-1-w), E its integral.
double isentrope_energy(const JwlParameters& m, double v) {
  const auto cold = [&](double x) {
    return m.a / m.r1 * std::exp(-m.r1 * x) + m.b / m.r2 * std::exp(-m.r2 * x);
  };
  return cold(v) + (m.initial_energy - cold(1.0)) * std::pow(v, -m.omega);
}
double isentrope_pressure(const JwlParameters& m, double v) {
  const double constant =
      m.omega * (isentrope_energy(m, 1.0) - m.a / m.r1 * std::exp(-m.r1) - m.b / m.r2 * std::exp(-m.r2));
  return m.a * std::exp(-m.r1 * v) + m.b * std::exp(-m.r2 * v) + constant * std::pow(v, -1.0 - m.omega);
}

TEST(Jwl, IsentropeFarFromRestIsTheClosedFormAndTheLawItself) {
  for (const JwlParameters& m : {unreacted_composition_b(), composition_b_products()})
    for (const double v : {0.3, 0.31, 0.5, 0.95, 1.05, 2.0, 5.0}) {
      const double closed = isentrope_pressure(m, v), scale = std::abs(closed) + 1.7e6;
      EXPECT_NEAR(jwl_isentropic_pressure(m, v), closed, 1e-12 * scale) << v;
      EXPECT_NEAR(first_of(jwl_isentropic_pressure(m, Pack(v))), closed, 1e-12 * scale) << v;
      EXPECT_NEAR(jwl_pressure(m, v, isentrope_energy(m, v)), closed, 1e-9 * scale) << v;
    }
}

TEST(Jwl, TensionCutOffActsBeforeTheSoundSpeedCeasesToBeReal) {
  // Along the isentrope from rest to V = 5; runs count where the cut-off acts.
  const JwlParameters m = unreacted_composition_b();
  double acted_at = infinity, soft_at = infinity;
  for (int k = 1; k <= 4000; ++k) {
    const double v = 1.0 + 1e-3 * k, modulus = jwl_isentropic_bulk_modulus(m, v);
    ASSERT_TRUE(std::isfinite(modulus)) << v;
    if (jwl_isentropic_pressure(m, v) < -Charge{}.tension_cutoff) acted_at = std::min(acted_at, v);
    if (modulus <= 0.0) soft_at = std::min(soft_at, v);
  }
  EXPECT_LT(soft_at, 5.0);
  EXPECT_LT(acted_at, soft_at);
}

TEST(Jwl, VolumeThatIsNoneGivesNoPressure) {
  for (const JwlParameters& m : {unreacted_composition_b(), composition_b_products()})
    for (const double v : {0.0, -0.0, -1e-310, -0.3, -5.0, not_a_number}) {
      EXPECT_FALSE(std::isfinite(jwl_isentropic_pressure(m, v))) << v;
      EXPECT_FALSE(std::isfinite(first_of(jwl_isentropic_pressure(m, Pack(v))))) << v;
    }
}

// ---- steel ----

/// Energy (J/kg) at compression mu1 by Runge-Kutta's fourth order in ln(rho): de/dln(rho) = p/rho.
double fine_energy(const MieGruneisenParameters& m, double mu0, double mu1) {
  constexpr int steps = 20000;
  const double h = std::log((1.0 + mu1) / (1.0 + mu0)) / steps;
  const auto slope = [&](double logarithm, double energy) {
    const double density_ratio = (1.0 + mu0) * std::exp(logarithm);
    return mie_gruneisen_pressure(m, density_ratio - 1.0, energy) / (m.density * density_ratio);
  };
  double energy = 0.0;
  for (int k = 0; k < steps; ++k) {
    const double x = k * h;
    const double a = slope(x, energy), b = slope(x + 0.5 * h, energy + 0.5 * h * a),
                 c = slope(x + 0.5 * h, energy + 0.5 * h * b), d = slope(x + h, energy + h * c);
    energy += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return energy;
}

template <class Number>
MieGruneisenState<double> compressed_steel(const MieGruneisenParameters& m, double mu0, double mu1,
                                           int steps) {
  MieGruneisenState<double> state{mie_gruneisen_pressure(m, mu0, 0.0), 0.0};
  const double ratio = std::pow((1.0 + mu1) / (1.0 + mu0), 1.0 / steps);
  double mu = mu0;
  for (int k = 1; k <= steps; ++k) {
    const double next = k == steps ? mu1 : (1.0 + mu) * ratio - 1.0;
    const auto after = mie_gruneisen_compress<Number>(m, Number(mu), Number(state.pressure),
                                                      Number(state.energy), Number(next), Number(0.0));
    state = {first_of(after.pressure), first_of(after.energy)};
    mu = next;
  }
  return state;
}

TEST(MieGruneisen, StepsOfAnySizeGainTheWorkOfThePressure) {
  const MieGruneisenParameters m;
  const struct {
    double from, to;
  } paths[] = {{0.0, 0.5 / 0.73}, {0.0, largest_compression(m)}, {0.0, -0.99}, {-0.9, 1.0}, {1.0, -0.9}};
  for (const auto& path : paths) {
    const double exact = fine_energy(m, path.from, path.to);
    for (const int steps : {1, 10, 100, 10000})
      for (const auto law : {compressed_steel<double>, compressed_steel<Pack>}) {
        const auto state = law(m, path.from, path.to, steps);
        EXPECT_NEAR(state.energy / exact, 1.0, 2e-2) << path.from << " to " << path.to << " in " << steps;
        EXPECT_NEAR(state.pressure / mie_gruneisen_pressure(m, path.to, state.energy), 1.0, 1e-10)
            << path.from << " to " << path.to << " in " << steps;
      }
  }
}

TEST(MieGruneisen, IsValidUpToTheGuardAndNowhereElse) {
  const MieGruneisenParameters m;
  const double bound = largest_compression(m);
  EXPECT_NEAR(bound, 0.9 / 0.73, 1e-14);
  const auto at_rest = [&](double mu) { return mie_gruneisen_compress(m, mu, 0.0, 0.0, mu, 0.0).pressure; };
  EXPECT_DOUBLE_EQ(at_rest(2.0 * bound), at_rest(bound));
  for (const double mu : {-1.0 + 1e-12, -0.5, 0.0, 0.5, bound})
    EXPECT_TRUE(mie_gruneisen_is_valid(m, mu)) << mu;
  for (const double mu :
       {bound * (1.0 + 1e-12), 1.0 / 0.73, 2.0, 1e9, infinity, -1.0, -2.0, -infinity, not_a_number})
    EXPECT_FALSE(mie_gruneisen_is_valid(m, mu)) << mu;
  for (const double mu : {-1.0, -2.0, -infinity})
    EXPECT_TRUE(std::isnan(mie_gruneisen_compress(m, 0.0, 0.0, 0.0, mu, 0.0).pressure)) << mu;
}

// ---- gases ----

TEST(SecondVirial, IsTheIntegralOverTheLennardJonesPotential) {
  using Quadrature = boost::math::quadrature::gauss_kronrod<double, 61>;
  for (const double t : {0.05, 0.1, 0.2, 0.3, 0.5, 1.0, 2.0, 3.418, 10.0, 100.0, 1e3, 1e4}) {
    // -3 integral (exp(-u/T*) - 1) r^2 dr, u = 4 (r^-12 - r^-6), with s = 1/r beyond r = 1.
    const auto mayer = [&](double sixth) { return std::expm1(-4.0 * sixth * (sixth - 1.0) / t); };
    const auto near = [&](double r) { return mayer(std::pow(r, -6.0)) * r * r; };
    const auto far = [&](double s) { return s > 0.0 ? mayer(std::pow(s, 6.0)) / (s * s * s * s) : 0.0; };
    const double exact = -3.0 * (Quadrature::integrate(near, 0.0, 0.5, 15, 1e-12) +
                                 Quadrature::integrate(near, 0.5, 1.0, 15, 1e-12) +
                                 Quadrature::integrate(far, 0.0, 1.0, 15, 1e-12));
    EXPECT_NEAR(reduced_second_virial(t), exact, 1e-9 * (1.0 + std::abs(exact))) << t;
  }
  for (const double t : {0.0, -1.0, not_a_number}) EXPECT_TRUE(std::isnan(reduced_second_virial(t))) << t;
}

TEST(AirAdiabat, IsThePowerOfAnyRatioAboveOne) {
  const AirParameters air;
  const auto at = [&](double ratio) { return adiabatic_temperature(air, ratio * air.initial_pressure); };
  const long double exponent = (static_cast<long double>(air.heat_ratio) - 1.0L) / air.heat_ratio;
  for (int k = 1; k <= 500; ++k) {
    const double ratio = std::pow(10.0, 0.01 * k);
    const long double exact =
        air.initial_temperature * std::exp(exponent * std::log(static_cast<long double>(ratio)));
    EXPECT_NEAR(static_cast<double>(at(ratio) / exact), 1.0, 1e-14) << ratio;
  }
  // A gap that does not open keeps its air: above the adiabat, so on the safe side.
  for (const double ratio : {1.0, 1.0 - 1e-15, 0.5, 1e-5, 1e-310, 0.0, -1.0, -1e5})
    EXPECT_EQ(at(ratio), air.initial_temperature) << ratio;
  EXPECT_TRUE(std::isnan(at(not_a_number)));
}

}  // namespace
