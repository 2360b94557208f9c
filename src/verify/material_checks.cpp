#include "checks.hpp"
#include "launchsafe/materials/ideal_gas.hpp"
#include "launchsafe/materials/jwl.hpp"
#include "launchsafe/materials/mie_gruneisen.hpp"
#include "launchsafe/materials/visco_scram.hpp"
#include "launchsafe/materials/vlw.hpp"
#include "launchsafe/math/statistics.hpp"

#include <utility>

namespace launchsafe::verify {
namespace {

/// Expected to all digits printed: `digit` is the unit of the last one, and half of it (and a hair) is the
/// tolerance.
Check printed(std::string name, double computed, double expected, double digit, std::string unit,
              std::string source) {
  return {std::move(name), computed, expected, 0.501 * digit, std::move(unit), std::move(source)};
}

Checks air_checks() {
  const auto at = [](const std::string& name, double ratio, double expected) {
    const materials::AirParameters air;
    return printed("temperature at pressure ratio " + name,
                   materials::adiabatic_temperature(air, ratio * air.initial_pressure), expected, 1e-3, "K",
                   "T0 ratio^(2/7) from 300 K");
  };
  return {at("1.5", 1.5, 336.847), at("3", 3.0, 410.621), at("9.5", 9.5, 570.783), at("100", 100.0, 1118.278),
          at("496 MPa over 101325 Pa", 496e6 / 101325.0, 3398.911)};
}

Checks jwl_checks() {
  const materials::JwlParameters unreacted = materials::unreacted_composition_b();
  constexpr double heat_capacity = 2.487e6, megabar = 1e11;
  const std::string source = "temperature form of the same law at 298 K, nine digits";
  const auto energy = [&](double v) {
    return materials::jwl_energy_at_temperature(unreacted, v, heat_capacity, 298.0);
  };
  const auto pressure = [&](double v) { return materials::jwl_pressure(unreacted, v, energy(v)); };
  return {
      printed("energy at V = 0.99, 298 K", energy(0.99) / megabar, -6.18040254e-3, 1e-11, "Mbar", source),
      printed("pressure at V = 0.99, 298 K", pressure(0.99) / megabar, 1.03371865e-3, 1e-11, "Mbar", source),
      printed("energy at V = 0.95, 298 K", energy(0.95) / megabar, -6.30783693e-3, 1e-11, "Mbar", source),
      printed("pressure at V = 0.95, 298 K", pressure(0.95) / megabar, 6.71521900e-3, 1e-11, "Mbar", source),
      printed("initial energy of the unreacted charge", unreacted.initial_energy, -6.11861e8, 1e3, "J/m3",
              "p(V = 1) = 0 solved for E"),
      {"pressure at V = 1", materials::jwl_pressure(unreacted, 1.0, unreacted.initial_energy), 0.0, 1.0, "Pa",
       "a charge at rest bears no pressure"},
      printed("isentropic bulk modulus at rest",
              materials::jwl_bulk_modulus(unreacted, 1.0, unreacted.initial_energy) / 1e9, 10.297, 1e-3,
              "GPa", "-V dp/dV with dE = -p dV"),
      {"energy of the products before detonation (Eq. 34)",
       materials::chapman_jouguet_initial_energy(materials::composition_b_products(), 7980.0, 29.5e9), 8.5e9,
       0.005, "J/m3", "the literature's E0; D and P_CJ are rounded to three digits", Tolerance::relative}};
}

Checks virial_gas_checks() {
  const auto series = [](const std::string& name, double reduced, double expected, double digit) {
    return printed("Lennard-Jones B* at T* = " + name, materials::reduced_second_virial(reduced), expected,
                   digit, "", "Gamma series in 50 digits; agrees with Hirschfelder's table");
  };
  const auto nitrogen = [](const std::string& name, double temperature, double volume, double expected) {
    return printed("Z of N2 at " + name,
                   materials::virial_compressibility(materials::nitrogen(), temperature, volume), expected,
                   1e-8, "", "Eq. 37 corrected, three terms");
  };
  return {series("1", 1.0, -2.53808134, 1e-8),
          series("2", 2.0, -0.627625288, 1e-9),
          series("5", 5.0, 0.243343503, 1e-9),
          series("20", 20.0, 0.525374204, 1e-9),
          nitrogen("800 K, 100 cm3/mol", 800.0, 100e-6, 1.37323443),
          nitrogen("1500 K, 50 cm3/mol", 1500.0, 50e-6, 2.07576984)};
}

Checks steel_checks() {
  const materials::MieGruneisenParameters steel;
  const auto pressure = [&](const std::string& name, double mu, double expected) {
    return printed("Hugoniot pressure at mu = " + name, materials::hugoniot_pressure(steel, mu) / 1e9,
                   expected, 1e-6, "GPa", "Eq. 19 with s - 1");
  };
  return {pressure("0.001", 0.001, 0.166814), pressure("0.01", 0.01, 1.705489),
          pressure("0.1", 0.1, 21.300845),
          printed("Hugoniot energy at mu = 0.01", materials::hugoniot_energy(steel, 0.01), 1078.291, 1e-3,
                  "J/kg", "p_H mu/(2 rho0 (1 + mu))")};
}

Checks crack_checks() {
  const materials::ViscoScramParameters strength;
  const std::string source = "growth law with K1 = K' (1 + m/2)^(1/m)";
  const auto speed = [&](double intensity) {
    return materials::crack_growth_speed(strength, intensity, strength.toughness);
  };
  return {printed("growth speed at K = 3e5", speed(3e5), 0.1215, 1e-4, "m/s", source),
          printed("growth speed at K = 5e5", speed(5e5), 20.09388, 1e-5, "m/s", source),
          {"growth speed at K = 1e6", speed(1e6), 225.0, 1e-9, "m/s", source},
          // At K' both branches give v_max/(1 + m/2) = 50 m/s, and (K'/K1)^m = 1/(1 + m/2).
          {"growth speed at K' = 547722.558", speed(547722.5575051661), 50.0, 1e-9, "m/s",
           "both branches at K' give v_max/(1 + m/2)"},
          {"growth speed with K1 = 655202.812, at K = K1/2", speed(0.5 * 655202.812), 300.0 / 1024.0, 1e-6,
           "m/s", "v_max (1/2)^10", Tolerance::relative},
          printed("toughness under friction at 141 MPa, c = 30 um",
                  materials::frictional_toughness(strength, 141e6, 30e-6), 1.827012e6, 1.0, "Pa m^0.5",
                  "K0 sqrt[1 + (pi A/K0)(1 + A/K0)]")};
}

/// Shear stress over twice the shear strain (Pa), `time` seconds after a sudden strain, by the law's own
/// steps; with the relaxation times as the paper's Table 3 prints them (the law's default rates are these
/// rounded to three digits).
double relaxation_modulus(double time, int steps) {
  materials::ViscoScramParameters solid;
  solid.relaxation_rates = {0.0, 1.0 / 1.366e-4, 1.0 / 1.366e-5, 1.0 / 1.366e-6, 1.0 / 5e-7};
  solid.flaw_size = 0.0;
  materials::ViscoScramState<double> state{};
  constexpr double strain = 1e-4;
  for (std::size_t n = 0; n < materials::maxwell_elements; ++n)
    state.elements[n].rx = 2.0 * solid.shear_moduli[n] * strain;
  const auto step = materials::relaxation(solid, steps > 0 ? time / steps : 1e-9);
  for (int k = 0; k < steps; ++k) materials::visco_scram_update<double>(solid, step, state, {}, 0.0);
  return materials::total_deviator(state).rx / (2.0 * strain);
}

Checks relaxation_checks() {
  const auto modulus = [](const std::string& name, double time, int steps, double expected) {
    return printed("modulus " + name, relaxation_modulus(time, steps) / 1e9, expected, 1e-6, "GPa",
                   "sum G_n exp(-t/tau_n)");
  };
  return {modulus("at once", 0.0, 0, 3.235), modulus("after 10 us in one step", 1e-5, 1, 1.356785),
          modulus("after 10 us in 1000 steps", 1e-5, 1000, 1.356785),
          modulus("after 1 ms in one step", 1e-3, 1, 0.944115)};
}

Checks statistics_checks() {
  const std::string celik = "Celik et al. 2008, Table 1, recomputed without rounding";
  const std::string table_8 = "ordinary least squares of Table 8";
  const auto size = [](double cells) { return math::representative_cell_size(cells, 2); };
  const math::GridConvergence grid =
      math::grid_convergence({6.063, 5.972, 5.863}, {size(18000), size(8000), size(4500)})
          .value_or(math::GridConvergence{});
  const auto factor = [](int n, double expected) {
    return printed("one-sided tolerance factor 95/95, n = " + std::to_string(n),
                   math::one_sided_tolerance_factor(n, 0.95, 0.95), expected, 1e-4, "",
                   "noncentral t; ISO 16269-6 tables");
  };
  const auto line = math::fit_line({0.0, 0.01, 0.02, 0.03, 0.039}, {416.1, 442.2, 467.7, 492.9, 523.3});
  const auto coefficient = [&](std::size_t k) { return line ? line->coefficients[k] : 0.0; };
  return {printed("observed order of three meshes", grid.order, 1.5340, 1e-4, "", celik),
          printed("extrapolated value", grid.extrapolated, 6.1685, 1e-4, "", celik),
          printed("grid convergence index, fine", 100.0 * grid.fine_index, 2.175, 1e-3, "%", celik),
          factor(5, 4.2027),
          factor(10, 2.9110),
          factor(20, 2.3960),
          printed("slope of the paper's five safe rows", coefficient(1), 2702.061, 1e-3, "K/cm", table_8),
          printed("intercept of the paper's five safe rows", coefficient(0), 414.939, 1e-3, "K", table_8)};
}

}  // namespace

std::vector<Computation> material_computations() {
  return {{"air", air_checks},
          {"jwl", jwl_checks},
          {"virial gas", virial_gas_checks},
          {"steel", steel_checks},
          {"cracks", crack_checks},
          {"relaxation", relaxation_checks},
          {"statistics", statistics_checks}};
}

}  // namespace launchsafe::verify
