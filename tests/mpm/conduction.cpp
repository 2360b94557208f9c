// Heat conduction: conservation, bounds, interfaces, the axisymmetric operator.
#include "launchsafe/mpm/conduction.hpp"

#include "exact_solutions.hpp"
#include "scenes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <tuple>

namespace {

using namespace launchsafe;

void shake(mpm::Simulation& simulation, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> kelvin(300.0, 1300.0);
  const auto set = [&](mpm::ParticleFields& p) {
    for (double& temperature : p.temperature) temperature = kelvin(random);
  };
  for (mpm::Body<materials::Steel>& body : simulation.bodies_of<materials::Steel>()) set(body.particles);
  for (mpm::Body<materials::Charge>& body : simulation.bodies_of<materials::Charge>()) set(body.particles);
}

template <class F>
void for_each_temperature(const mpm::Simulation& simulation, F&& f) {
  simulation.for_each_body([&](const mpm::ParticleFields& p) {
    for (std::size_t i = 0; i < p.mass.size(); ++i)
      if (p.mass[i] > 0.0) f(p.temperature[i]);
  });
}

/// Sum m c T, J per radian.
double heat_in(const mpm::Simulation& simulation) {
  double heat = 0.0;
  for (const mpm::AnyBody& any : simulation.bodies())
    std::visit(
        [&heat](const auto& body) {
          const mpm::ParticleFields& p = body.particles;
          for (std::size_t i = 0; i < p.mass.size(); ++i)
            heat += p.mass[i] * body.law.heat_capacity() * p.temperature[i];
        },
        any);
  return heat;
}

/// Conducts over dt (s) while a flux (W/m2) enters a body of so many J/(m3 K) through its base-side face:
/// what warms the last particles before a step of backward Euler is a source in it.
void advance_under(double flux, double capacity, mpm::ParticleFields& body, mpm::Conduction& conduction,
                   mpm::Simulation& simulation, double dt) {
  const mpm::Lattice& lattice = body.lattice;
  const int last = lattice.columns() - 1;
  for (int j = 0; j < lattice.rows(); ++j)
    body.temperature[lattice.slot(last, j)] += flux * dt / (capacity * lattice.length_x(last));
  conduction.advance(simulation, dt);
}

TEST(Conduction, ConservesHeatOnEveryMesh) {
  for (const double cell : {7e-3, 10e-3, 13e-3})
    for (const double dt : {1e-3, 1.0, 1e5}) {
      mpm::Simulation simulation(test_support::shell_155(cell, 2));
      shake(simulation, 3);
      mpm::Conduction conduction(simulation);
      const double before = heat_in(simulation);
      conduction.advance(simulation, dt);
      EXPECT_NEAR(heat_in(simulation) / before, 1.0, 1e-12) << cell << ' ' << dt;
    }
}

TEST(Conduction, StaysWithinTheInitialExtremesForAnyStep) {
  // Backward Euler with an M-matrix has a discrete maximum principle.
  for (const double dt : {1e-298, 1e-6, 1e-2, 1e2, 1e6, 1e9}) {
    mpm::Simulation simulation(test_support::shell_155(10e-3));
    shake(simulation, 5);
    mpm::Conduction conduction(simulation);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for_each_temperature(simulation, [&](double t) {
      low = std::min(low, t);
      high = std::max(high, t);
    });
    conduction.advance(simulation, dt);
    for_each_temperature(simulation, [&](double t) {
      EXPECT_GE(t, low - 1e-9);
      EXPECT_LE(t, high + 1e-9);
    });
  }
}

TEST(Conduction, EndsAtTheMeanTemperature) {
  mpm::Simulation simulation(test_support::shell_155(10e-3));
  shake(simulation, 7);
  mpm::Conduction conduction(simulation);
  const double heat = heat_in(simulation);
  for (int step = 0; step < 3; ++step) conduction.advance(simulation, 1e9);
  double mean = -1.0;
  for_each_temperature(simulation, [&](double t) {
    if (mean < 0.0) mean = t;
    EXPECT_NEAR(t, mean, 1e-6);
  });
  EXPECT_NEAR(heat_in(simulation) / heat, 1.0, 1e-12);
}

TEST(Conduction, DoesNotLoseATemperatureThatIsNotANumber) {
  mpm::Simulation simulation(test_support::shell_155(10e-3));
  mpm::Conduction conduction(simulation);
  mpm::ParticleFields& p = simulation.bodies_of<materials::Charge>()[0].get().particles;
  p.temperature[p.lattice.slot(1, 1)] = std::nan("");
  conduction.advance(simulation, 1.0);
  EXPECT_TRUE(std::isnan(p.temperature[p.lattice.slot(1, 1)]));
}

TEST(Conduction, WarmsAHalfSpaceUnderAFluxAsTheClosedFormSays) {
  // Carslaw & Jaeger: a face under 1 MW/m2, 2 q sqrt(t/(pi k rho c)). Held hotter: tests/error_of_parts.
  mpm::Simulation simulation(test_support::half_space(0.5e-6));
  const scene::Charge& charge = simulation.scene().charge();
  EXPECT_NEAR(charge.conductivity / (charge.density * charge.specific_heat) / 8.049053e-8, 1.0,
              1e-7);  // m2/s
  mpm::Conduction conduction(simulation);
  mpm::ParticleFields& p = simulation.bodies_of<materials::Charge>()[0].get().particles;
  for (int step = 0; step < 1000; ++step)
    advance_under(1e6, charge.density * charge.specific_heat, p, conduction, simulation,
                  test_support::half_space_duration / 1000);
  const int last = p.lattice.columns() - 1;
  // The face lies half a spacing beyond the last particle; the slope there is q/k.
  const double beyond = 0.5 * p.lattice.length_x(0) * 1e6 / charge.conductivity;
  EXPECT_NEAR((p.temperature[p.lattice.slot(last, 0)] - 300.0 + beyond) / 41.15213, 1.0, 1e-3);
}

TEST(Conduction, DecaysLikeTheFirstRadialMode) {
  // T = 300 + 100 J0(j r/R), j = 3.8317059702075123 the first zero of J1, decays with the rate alpha (j/R)^2.
  constexpr double radius = 0.02, zero = 3.8317059702075123;
  const auto rate_error = [&](double cell) {
    mpm::Simulation simulation(test_support::steel_bar(0.01, radius, cell));
    mpm::ParticleFields& p = simulation.bodies_of<materials::Steel>()[0].get().particles;
    for (std::size_t i = 0; i < p.r.size(); ++i)
      p.temperature[i] = 300.0 + 100.0 * std::cyl_bessel_j(0.0, zero * p.r[i] / radius);
    const auto amplitude = [&] {
      double top = 0.0, bottom = 0.0;
      for (std::size_t i = 0; i < p.r.size(); ++i) {
        const double mode = std::cyl_bessel_j(0.0, zero * p.r[i] / radius);
        top += p.mass[i] * (p.temperature[i] - 300.0) * mode;
        bottom += p.mass[i] * mode * mode;
      }
      return top / bottom;
    };
    const auto& steel = simulation.scene().steel();
    const double rate = steel.strength.conductivity / (steel.eos.density * steel.strength.specific_heat) *
                        std::pow(zero / radius, 2);
    mpm::Conduction conduction(simulation);
    const double start = amplitude();
    const double dt = 1e-4 / rate;
    for (int step = 0; step < 100; ++step) conduction.advance(simulation, dt);
    // Backward Euler divides by 1 + rate dt a step.
    const double measured = (std::pow(start / amplitude(), 0.01) - 1.0) / dt;
    return std::abs(measured / rate - 1.0);
  };
  const double coarse = rate_error(1e-3), fine = rate_error(0.5e-3);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.2);
}

TEST(Conduction, CarriesTheFluxThroughTheInterfacesOfALayer) {
  // A layer of charge between a plate of steel, heated at the base, and a sink of steel. In the end all warm
  // at one rate, so of the heat that enters, each face passes on the share of the capacity beyond it.
  constexpr double flux = 1e4, sink_length = 0.2, layer_length = 2e-3, plate_length = 8e-3;
  scene::Scene pair;
  const double layer_begin = sink_length, layer_end = layer_begin + layer_length;
  pair.bodies = {{"sink", "steel", 0.0, layer_begin, 0.0, 1e-3},
                 {"layer", "charge", layer_begin, layer_end, 0.0, 1e-3},
                 {"plate", "steel", layer_end, layer_end + plate_length, 0.0, 1e-3}};
  pair.numerics.cell_size = 1e-3;
  mpm::Simulation simulation(pair);
  mpm::Conduction conduction(simulation);
  mpm::ParticleFields& in_plate = simulation.bodies_of<materials::Steel>()[1].get().particles;
  // Time constants: plate over layer 230 s, sink 3800 s/pi^2.
  for (int step = 0; step < 400; ++step)
    advance_under(flux, 7830.0 * 460.0, in_plate, conduction, simulation, 50.0);
  const double sink = 7830.0 * 460.0 * sink_length, layer = 1717.0 * 1780.0 * layer_length,
               plate = 7830.0 * 460.0 * plate_length;
  const mpm::ParticleFields& in_layer = simulation.bodies_of<materials::Charge>()[0].get().particles;
  const auto at = [](const mpm::ParticleFields& p, int i) { return p.temperature[p.lattice.slot(i, 0)]; };
  const double through_middle = (at(in_layer, 1) - at(in_layer, 0)) * 0.246 / in_layer.lattice.length_x(0);
  EXPECT_NEAR(through_middle / flux, (sink + 0.5 * layer) / (sink + layer + plate), 1e-4);
  // From the layer's last particle to the plate's first: two half spacings in series.
  const double resistance =
      0.5 * (in_layer.lattice.length_x(0) / 0.246 + in_plate.lattice.length_x(0) / 38.0);
  EXPECT_NEAR((at(in_plate, 0) - at(in_layer, 1)) / resistance / flux,
              (sink + layer) / (sink + layer + plate), 1e-4);
}

/// Two columns that meet at x = 0.2 m.
mpm::Simulation two_halves(const std::string& material, double length) {
  scene::Scene pair;
  pair.bodies = {{"left", "charge", 0.2 - 0.02, 0.2, 0.0, 1e-3},
                 {"right", material, 0.2, 0.2 + length, 0.0, 1e-3}};
  pair.numerics.cell_size = 0.5e-3;
  return mpm::Simulation(pair);
}

/// The charge on the left turns to gas.
void burn_left(mpm::Simulation& simulation) {
  const mpm::Lattice lattice = mpm::particle_fields_of(simulation.bodies()[0]).lattice;
  constexpr double energy = 1780.0 * 784.0;  // J/kg at T2
  for (int j = 0; j < lattice.rows(); ++j)
    for (int i = 0; i < lattice.columns(); ++i) simulation.burn(0, lattice.slot(i, j), 1.0, energy);
  simulation.step(simulation.stable_time_step());
  ASSERT_TRUE(simulation.within_gas_law());
}

struct HalfSpace {
  double conductivity, capacity;  // W/(m K), J/(m3 K)
  double effusivity() const { return std::sqrt(conductivity * capacity); }
  double diffusivity() const { return conductivity / capacity; }
};

TEST(Conduction, BurntAndUnburntHalvesAreTwoHalfSpacesInContact) {
  // Carslaw & Jaeger 1959, 2.15: the faces are at once at the mean of both temperatures, weighted with the
  // effusivities, and stay there; each side goes there as erf(x/sqrt(4 alpha t)). Products conduct as the
  // charge that they were (Eq. 40).
  constexpr double hot = 784.0, cold = 300.0, duration = 28.0;  // s: 3 mm in the charge
  const HalfSpace charge{0.246, 1717.0 * 1780.0}, steel{38.0, 7830.0 * 460.0};
  for (const auto& [material, right, length] :
       {std::tuple{"charge", charge, 0.02}, std::tuple{"steel", steel, 0.2}}) {
    mpm::Simulation simulation = two_halves(material, length);
    burn_left(simulation);
    const double sides[] = {hot, cold};
    for (std::size_t side : {0u, 1u}) {
      auto& p = std::visit([](auto& body) -> mpm::ParticleFields& { return body.particles; },
                           simulation.bodies()[side]);
      for (double& temperature : p.temperature) temperature = sides[side];
    }
    mpm::Conduction conduction(simulation);
    const double heat = heat_in(simulation);
    for (int step = 0; step < 1000; ++step) conduction.advance(simulation, duration / 1000);
    EXPECT_NEAR(heat_in(simulation) / heat, 1.0, 1e-12);
    const double face =
        (charge.effusivity() * hot + right.effusivity() * cold) / (charge.effusivity() + right.effusivity());
    double largest = 0.0;
    for (std::size_t side : {0u, 1u}) {
      const mpm::ParticleFields& p = mpm::particle_fields_of(simulation.bodies()[side]);
      const double alpha = (side == 0 ? charge : right).diffusivity();
      for (int i = 0; i < p.lattice.columns(); ++i) {
        const double depth = std::abs(p.lattice.x_of(i) - 0.2) / std::sqrt(4.0 * alpha * duration);
        const double exact = face + (sides[side] - face) * std::erf(depth);
        largest = std::max(largest, std::abs(p.temperature[p.lattice.slot(i, 0)] - exact));
      }
    }
    EXPECT_LT(largest, 0.005 * (hot - cold)) << material;
  }
}

TEST(Conduction, RefreshesTheFlowStressOfHeatedSteel) {
  mpm::Simulation simulation(test_support::steel_bar(0.02, 0.01, 2.5e-3));
  mpm::Conduction conduction(simulation);
  mpm::Body<materials::Steel>& body = simulation.bodies_of<materials::Steel>()[0];
  for (std::size_t i = 0; i < body.particles.x.size(); ++i)
    if (body.particles.x[i] > 0.01) body.particles.temperature[i] = 900.0;
  conduction.advance(simulation, 100.0);
  const std::size_t slot = body.particles.lattice.slot(0, 0);
  EXPECT_GT(body.particles.temperature[slot], 500.0);
  EXPECT_DOUBLE_EQ(body[materials::Steel::flow_stress][slot],
                   materials::johnson_cook_flow_stress(simulation.scene().steel().strength, 0.0, 0.0,
                                                       body.particles.temperature[slot]));
}

}  // namespace
