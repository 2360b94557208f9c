// JWL from V = 0.3 to 5, and the virial gas where it has no meaning.
#include "law_tests.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace launchsafe::verify::law_tests {

namespace {

using materials::JwlParameters;

/// The law on one number, or as a run calls it, on a Pack.
template <class Number>
materials::JwlState<double> compress(const JwlParameters& m, double v0, double p0, double energy0,
                                     double v1) {
  const auto state = materials::jwl_compress<Number>(m, Number(v0), Number(p0), Number(energy0), Number(v1));
  return {first_of(state.pressure), first_of(state.energy)};
}

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

materials::VirialState products(double temperature, double density) {
  return materials::virial_state(materials::composition_b_gas(), temperature, density);
}

/// The charge's tension as a run treats it: steps along the isentrope from rest to V = 5, with the pressure
/// held at the cut-off. Where the sound speed is not real, the cut-off must have acted, as runs count it.
void assess_tension(Bounds& bounds) {
  const JwlParameters m = materials::unreacted_composition_b();
  const double cutoff = scene::Charge{}.tension_cutoff;
  constexpr int steps = 4000;
  double acted_at = 0.0, soft_at = 0.0;
  for (int k = 1; k <= steps; ++k) {
    const double v = 1.0 + 4.0 * k / steps, energy = isentrope_energy(m, v);
    const double modulus = materials::jwl_bulk_modulus(m, v, energy);
    bounds.never("a modulus is not finite", !std::isfinite(modulus));
    if (acted_at == 0.0 && materials::jwl_pressure(m, v, energy) < -cutoff) acted_at = v;
    if (soft_at == 0.0 && modulus <= 0.0) soft_at = v;
  }
  bounds.never("the sound speed is real throughout, so this case shows nothing", soft_at == 0.0);
  bounds.never("the sound speed ceases to be real before the tension cut-off is counted",
               !(acted_at > 0.0 && acted_at < soft_at));
  bounds.caught(
      fmt::format("the tension cut-off acts, and is counted, from V = {:.4g}; the sound speed is not real "
                  "from V = {:.3g}, where at V = 5 even a pressure of {:.3g} MPa returns",
                  acted_at, soft_at, 1e-6 * isentrope_pressure(m, 5.0)));
}

void assess_no_volume(Bounds& bounds) {
  for (const JwlParameters& m : {materials::unreacted_composition_b(), materials::composition_b_products()}) {
    for (const JwlLaw& law : {JwlLaw(compress<double>), JwlLaw(compress<math::Pack>)}) {
      for (const double v : {0.0, -0.0, -1e-310, -0.3, -5.0, std::numeric_limits<double>::quiet_NaN()}) {
        const auto state = law(m, 1.0, 0.0, m.initial_energy, v);
        bounds.never("a volume that is none has a pressure",
                     std::isfinite(state.pressure) || std::isfinite(state.energy));
      }
    }
  }
  bounds.caught("NaN");
}

}  // namespace

void assess_jwl(Bounds& bounds, const JwlLaw& law, const JwlParameters& m, double v, int steps) {
  materials::JwlState<double> state{materials::jwl_pressure(m, 1.0, m.initial_energy), m.initial_energy};
  double last = 1.0;
  for (int k = 1; k <= steps; ++k) {
    const double next = k == steps ? v : 1.0 + (v - 1.0) * k / steps;
    const double before = state.pressure;
    state = law(m, last, state.pressure, state.energy, next);
    if (v < 1.0) {
      bounds.never("the pressure falls on compression", !(state.pressure > before));
      const double modulus = materials::jwl_bulk_modulus(m, next, state.energy);
      bounds.never("the sound speed is not real under compression", !(modulus > 0.0));
    }
    last = next;
  }
  bounds.never("a number is not finite", !std::isfinite(state.pressure + state.energy));
  // The mean of two pressures errs by (R1 dV)^2/12 of what a step does, R1 = 11.3. Steps beyond the small
  // change go along the isentrope itself.
  const double part = std::min(std::abs(v - 1.0) / steps, materials::jwl_small_change * std::max(1.0, v));
  const double allowed = 1e-10 + 15.0 * part * part;
  const double scale = std::abs(isentrope_energy(m, v)) + std::abs(m.initial_energy);
  bounds.at_most("distance from the isentrope's energy, share of what the step allows",
                 std::abs(state.energy - isentrope_energy(m, v)) / (scale * allowed), 1.0);
  const double stiffness = std::abs(isentrope_pressure(m, v)) + m.omega / v * scale;
  bounds.at_most("distance from the isentrope's pressure, share of what the step allows",
                 std::abs(state.pressure - isentrope_pressure(m, v)) / (stiffness * allowed), 1.0);
}

void assess_gas(Bounds& bounds, const GasLaw& law, double temperature, double density) {
  const materials::VirialState state = law(temperature, density);
  if (!state.valid) {
    bounds.never("an invalid state has a pressure", !std::isnan(state.pressure));
    bounds.caught("outside its range the gas is flagged and its pressure is NaN");
    return;
  }
  bounds.never("a valid state has no pressure", !(state.pressure > 0.0) || !std::isfinite(state.pressure));
  bounds.never("temperature or density of a valid state are none", !(temperature > 0.0 && density > 0.0));
  const materials::VirialState denser = law(temperature, density * (1.0 + 1e-6));
  bounds.never("the pressure of a valid state falls on compression",
               denser.valid && denser.pressure < state.pressure);
  const double ideal = materials::gas_constant * temperature * density * 30.447;
  bounds.at_most("p V/(R T) against the Z it states, share",
                 std::abs(state.pressure / (ideal * state.compressibility) - 1.0), 1e-12);
}

void assess_second_virial(Bounds& bounds, const std::function<double(double)>& law, double reduced) {
  const double found = law(reduced);
  if (!(reduced > 0.0)) {
    bounds.never("no temperature gives a coefficient", !std::isnan(found));
    bounds.caught("NaN");
    return;
  }
  // -3 integral (exp(-u/T*) - 1) r^2 dr, u = 4 (r^-12 - r^-6), with s = 1/r beyond r = 1.
  using Quadrature = boost::math::quadrature::gauss_kronrod<double, 61>;
  const auto mayer = [&](double sixth) { return std::expm1(-4.0 * sixth * (sixth - 1.0) / reduced); };
  const auto near = [&](double r) { return mayer(std::pow(r, -6.0)) * r * r; };
  const auto far = [&](double s) { return s > 0.0 ? mayer(std::pow(s, 6.0)) / (s * s * s * s) : 0.0; };
  const double exact = -3.0 * (Quadrature::integrate(near, 0.0, 0.5, 15, 1e-12) +
                               Quadrature::integrate(near, 0.5, 1.0, 15, 1e-12) +
                               Quadrature::integrate(far, 0.0, 1.0, 15, 1e-12));
  bounds.at_most("distance from the integral over the potential, share of 1 and it",
                 std::abs(found - exact) / (1.0 + std::abs(exact)), 1e-9);
}

LawTests charge_pressure_tests() {
  LawTests tests;
  const std::string group = "extreme: JWL";
  struct Law {
    const char* name;
    JwlParameters parameters;
  };
  for (const Law& law : {Law{"unreacted", materials::unreacted_composition_b()},
                         Law{"products", materials::composition_b_products()}}) {
    for (const double v : {0.3, 0.31, 0.5, 0.95, 1.05, 2.0, 5.0}) {
      tests.push_back({group, fmt::format("{}, V = 1 to {:g} in 1 to 10000 steps", law.name, v),
                       "Energy and pressure are those of the isentrope to the second order of the step; "
                       "under compression the pressure rises with every step and the sound speed is real.",
                       [parameters = law.parameters, v](Bounds& bounds) {
                         for (const int steps : {1, 2, 5, 10, 100, 10000}) {
                           assess_jwl(bounds, compress<double>, parameters, v, steps);
                           assess_jwl(bounds, compress<math::Pack>, parameters, v, steps);
                         }
                       }});
    }
  }
  tests.push_back({group, "unreacted, tension to V = 5: sound speed",
                   "Where the sound speed is not real the tension cut-off has acted, which runs count.",
                   assess_tension});
  tests.push_back({group, "volumes that are none", "No pressure and no energy come out.", assess_no_volume});
  return tests;
}

LawTests gas_tests() {
  LawTests tests;
  const std::string group = "extreme: virial gas";
  for (const double temperature : {1e-310, 1.0, 100.0, 200.0, 300.0, 500.0, 784.0, 3000.0, 1e5}) {
    tests.push_back({group, fmt::format("{:g} K, densities 0 to beyond the solid's", temperature),
                     "A state is valid, with a positive pressure that rises on compression, or it is flagged "
                     "and its pressure is NaN.",
                     [temperature](Bounds& bounds) {
                       for (const double density : {-1.0, 0.0, 1e-310, 1e-3, 1.0, 30.0, 100.0, 200.0, 300.0,
                                                    400.0, 600.0, 800.0, 1000.0, 1717.0, 5000.0, 1e300})
                         assess_gas(bounds, products, temperature, density);
                     }});
  }
  tests.push_back(
      {group, "steam at 784 K and the solid's density", "The negative Z is stated and the state flagged.",
       [](Bounds& bounds) {
         const auto state = materials::virial_state(materials::water(), 784.0, 1.0 / (1717.0 * 30.447));
         bounds.at_most("its Z, which should be below 0, is", std::max(0.0, state.compressibility), 0.0);
         bounds.never("it passes as valid", state.valid || !std::isnan(state.pressure));
         bounds.caught("flagged, pressure NaN");
       }});
  tests.push_back({group, "second virial coefficient, T* 0.05 to 1e4",
                   "It is the integral over the Lennard-Jones potential.", [](Bounds& bounds) {
                     for (const double t : {0.05, 0.1, 0.2, 0.3, 0.5, 1.0, 2.0, 3.418, 10.0, 100.0, 1e3, 1e4})
                       assess_second_virial(bounds, materials::reduced_second_virial, t);
                   }});
  tests.push_back(
      {group, "second virial coefficient at no temperature", "No number comes out.", [](Bounds& bounds) {
         for (const double t : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
           assess_second_virial(bounds, materials::reduced_second_virial, t);
       }});
  return tests;
}

}  // namespace launchsafe::verify::law_tests
