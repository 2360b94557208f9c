#include "launchsafe/materials/vlw.hpp"

#include "launchsafe/math/polynomial.hpp"

#include <limits>

namespace launchsafe::materials {

namespace {

constexpr double cubic_centimetre = 1e-6;  // m3

/// The tables' argument goes with ln T and spans an interval about 0 that is shorter than 1.
const double table_middle =
    0.5 * (std::log(ProductGas::lowest_temperature) + std::log(ProductGas::highest_temperature));
constexpr double table_scale = 4.0;
double table_argument(double temperature) { return (std::log(temperature) - table_middle) / table_scale; }

/// A function of temperature with its first two derivatives.
struct Curve {
  double value, slope, bend;
};

template <std::size_t count>
Curve curve_at(const std::array<double, count>& coefficients, double temperature) {
  const double s = table_argument(temperature);
  double value = 0, first = 0, second = 0;
  for (std::size_t k = count; k-- > 0;) {
    second = second * s + 2.0 * first;
    first = first * s + value;
    value = value * s + coefficients[k];
  }
  const double by_temperature = 1.0 / (table_scale * temperature);
  return {value, first * by_temperature,
          second * by_temperature * by_temperature - first * by_temperature / temperature};
}

}  // namespace

LennardJones nitrogen() { return {95.05, 63.78 * cubic_centimetre}; }
LennardJones water() { return {380.0, 23.5 * cubic_centimetre}; }

std::vector<GasComponent> composition_b_gas() {
  return {{nitrogen(), 10.645}, {water(), 13.097}, {LennardJones{189.0, 113.9 * cubic_centimetre}, 6.705}};
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

double GasState::isentropic_modulus(double temperature, double volume) const {
  return volume * (temperature * pressure_by_temperature * pressure_by_temperature / energy_by_temperature -
                   pressure_by_volume);
}

ProductGas::ProductGas(const std::vector<GasComponent>& components, double specific_heat)
    : specific_heat_(specific_heat) {
  for (const GasComponent& component : components) amount_ += component.amount;
  const auto table = [&](auto coefficient) {
    const double low = table_argument(lowest_temperature), high = table_argument(highest_temperature);
    return math::chebyshev_fit<std::tuple_size_v<Coefficients>>(
        [&](long double s) {
          const double temperature = std::exp(table_middle + table_scale * static_cast<double>(s));
          double sum = 0;
          for (const auto& [potential, amount] : components)
            sum += amount / amount_ * coefficient(potential, temperature / potential.temperature);
          return static_cast<long double>(sum);
        },
        low, high);
  };
  second_ = table(
      [](const LennardJones& gas, double reduced) { return gas.covolume * reduced_second_virial(reduced); });
  third_ = table([](const LennardJones& gas, double reduced) {
    return gas.covolume * gas.covolume * reduced_second_virial(reduced) / std::pow(reduced, 0.25);
  });
}

GasState ProductGas::at(double temperature, double volume) const {
  GasState state;
  if (!(temperature >= lowest_temperature && temperature <= highest_temperature && volume > 0.0))
    return state;
  const Curve second = curve_at(second_, temperature), third = curve_at(third_, temperature);
  const double density = amount_ / volume;  // mol/m3
  const double t = temperature, ideal = gas_constant * density;
  state.compressibility = 1.0 + density * (second.value + density * third.value);
  const double stiffness = 1.0 + density * (2.0 * second.value + 3.0 * density * third.value);
  state.pressure = ideal * t * state.compressibility;
  state.pressure_by_temperature =
      ideal * (state.compressibility + t * density * (second.slope + density * third.slope));
  state.pressure_by_volume = -ideal * t * stiffness / volume;
  const double slopes = density * (second.slope + 0.5 * density * third.slope);
  const double bends = density * (second.bend + 0.5 * density * third.bend);
  state.energy = specific_heat_ * t - amount_ * gas_constant * t * t * slopes;
  state.energy_by_temperature = specific_heat_ - amount_ * gas_constant * t * (2.0 * slopes + t * bends);
  state.energy_by_volume = t * state.pressure_by_temperature - state.pressure;
  state.valid = state.pressure > 0.0 && std::isfinite(state.pressure) && stiffness > 0.0 &&
                state.energy_by_temperature > 0.0;
  return state;
}

}  // namespace launchsafe::materials
