#include "launchsafe/materials/product_gas.hpp"

#include "launchsafe/math/polynomial.hpp"

#include <cmath>
#include <limits>

namespace launchsafe::materials {
namespace {

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
  state.valid = state.compressibility > 0.0 && stiffness > 0.0 && state.energy_by_temperature > 0.0;
  return state;
}

double ProductGas::temperature_at(double energy, double volume, double guess) const {
  constexpr int most_iterations = 50;
  constexpr double enough = 1e-13;
  double temperature = guess;
  for (int i = 0; i < most_iterations; ++i) {
    const GasState state = at(temperature, volume);
    if (!state.valid) break;
    const double change = (energy - state.energy) / state.energy_by_temperature;
    if (std::abs(change) <= enough * temperature) return temperature + change;
    // Half way to the end of the table at most.
    const double next = temperature + change;
    if (next <= lowest_temperature)
      temperature = 0.5 * (temperature + lowest_temperature);
    else if (next >= highest_temperature)
      temperature = 0.5 * (temperature + highest_temperature);
    else
      temperature = next;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace launchsafe::materials
