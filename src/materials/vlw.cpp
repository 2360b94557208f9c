#include "launchsafe/materials/vlw.hpp"

#include <cmath>
#include <limits>

namespace launchsafe::materials {

namespace {

constexpr double cubic_centimetre = 1e-6;  // m3

/// Z at x = b0/V and d(Z/V)/d(1/V), which is the isothermal dp/drho over that of the ideal gas.
struct Series {
  double compressibility = 1.0, stiffness = 1.0;
};

Series series_of(const LennardJones& gas, double temperature, double molar_volume, int terms) {
  const double reduced = temperature / gas.temperature;
  const double second = reduced_second_virial(reduced);
  const double x = gas.covolume / molar_volume;
  double higher = 0.0, higher_slope = 0.0;
  for (int n = 3; n <= terms; ++n) {
    const double term = std::pow(n - 2.0, -n) * std::pow(x, n - 1);
    higher += term;
    higher_slope += n * term;
  }
  const double factor = second / std::pow(reduced, 0.25);
  return {1.0 + second * x + factor * higher, 1.0 + 2.0 * second * x + factor * higher_slope};
}

VirialState state_of(const Series& series, double ideal_pressure) {
  const double pressure = series.compressibility * ideal_pressure;
  const bool valid = series.compressibility > 0.0 && series.stiffness > 0.0 && ideal_pressure > 0.0 &&
                     std::isfinite(pressure);
  return {series.compressibility, valid ? pressure : std::numeric_limits<double>::quiet_NaN(), valid};
}

}  // namespace

LennardJones nitrogen() { return {"N2", 95.05, 63.78 * cubic_centimetre}; }
LennardJones carbon_monoxide() { return {"CO", 100.2, 67.22 * cubic_centimetre}; }
LennardJones carbon_dioxide() { return {"CO2", 189.0, 113.9 * cubic_centimetre}; }
LennardJones hydrogen() { return {"H2", 37.0, 31.67 * cubic_centimetre}; }
LennardJones water() { return {"H2O", 380.0, 23.5 * cubic_centimetre}; }

std::vector<GasComponent> composition_b_gas() {
  return {{nitrogen(), 10.645}, {water(), 13.097}, {carbon_dioxide(), 6.705}};
}

double reduced_second_virial(double reduced_temperature) {
  if (!(reduced_temperature > 0.0)) return std::numeric_limits<double>::quiet_NaN();
  // Two interleaved series, j even and j odd, in each of which the next term follows from the last by
  // Gamma(x + 1) = x Gamma(x): term(j + 2) = term(j) * 4 / ((j + 1)(j + 2)) * (2j - 1)/4 / T*.
  const double inverse = 1.0 / reduced_temperature;
  double total = 0.0;
  for (int first = 0; first < 2; ++first) {
    double term = std::exp2(first + 0.5) / 4.0 * std::tgamma((2.0 * first - 1.0) / 4.0) *
                  std::pow(inverse, (2.0 * first + 1.0) / 4.0);
    double partial = term;
    for (int j = first; std::abs(term) > 1e-18 * std::abs(partial) && j < 100000; j += 2) {
      term *= (2.0 * j - 1.0) / ((j + 1.0) * (j + 2.0)) * inverse;
      partial += term;
    }
    total -= partial;
  }
  return total;
}

double virial_compressibility(const LennardJones& gas, double temperature, double molar_volume, int terms) {
  return series_of(gas, temperature, molar_volume, terms).compressibility;
}

VirialState virial_state(const LennardJones& gas, double temperature, double molar_volume, int terms) {
  return state_of(series_of(gas, temperature, molar_volume, terms),
                  gas_constant * temperature / molar_volume);
}

VirialState virial_state(const std::vector<GasComponent>& mixture, double temperature, double density,
                         int terms) {
  double amount = 0.0;  // mol/kg
  for (const GasComponent& component : mixture) amount += component.amount;
  const double molar_volume = 1.0 / (density * amount);
  Series mixed{0.0, 0.0};
  for (const GasComponent& component : mixture) {
    const Series series = series_of(component.potential, temperature, molar_volume, terms);
    mixed.compressibility += component.amount / amount * series.compressibility;
    mixed.stiffness += component.amount / amount * series.stiffness;
  }
  return state_of(mixed, gas_constant * temperature / molar_volume);
}

}  // namespace launchsafe::materials
