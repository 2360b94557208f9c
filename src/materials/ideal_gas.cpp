#include "launchsafe/materials/ideal_gas.hpp"

#include <cstddef>

namespace launchsafe::materials {
namespace {

/// Of the table of isentropes, K.
constexpr double knot_distance = 5.0, last_knot = 12000.0;

}  // namespace

double specific_gas_constant(const AirParameters& air) {
  return air.specific_heat * (air.heat_ratio - 1.0) / air.heat_ratio;
}

AirParameters hot_and_dense(AirParameters air) {
  air.vibration_temperature = 3055.6;
  air.covolume = 1.03e-3;
  return air;
}

/// Knots by Newton's method in ln T, from the one before.
Isentropes::Isentropes(const AirParameters& air) {
  if (!(air.vibration_temperature > 0.0)) return;
  constexpr double exact = 1e-15;
  constexpr int most = 50;
  const double share = specific_gas_constant(air) / air.specific_heat;
  knots_.push_back({0.0, 1.0});
  double temperature = knot_distance;
  for (double without = knot_distance; without <= last_knot; without += knot_distance) {
    double ratio = 1.0;
    for (int count = 0; count < most; ++count) {
      const double x = air.vibration_temperature / temperature, boltzmann = std::exp(-x);
      const double entropy = x / std::expm1(x) - std::log1p(-boltzmann);  // over R
      ratio = 1.0 + share * x * x * boltzmann / ((1.0 - boltzmann) * (1.0 - boltzmann));
      const double excess = std::log(temperature / without) + share * entropy;
      temperature *= std::exp(-excess / ratio);
      if (std::abs(excess) < exact) break;
    }
    knots_.push_back({temperature, temperature / (without * ratio)});
  }
}

/// Cubic between knots.
CompressedAir Isentropes::at(double without) const {
  if (knots_.empty()) return {without, 1.0, 1.0};
  CompressedAir air;
  const double place = without / knot_distance;
  if (!(place >= 0.0 && place < static_cast<double>(knots_.size() - 1))) {
    const auto& [temperature, slope] = knots_.back();
    air.slope = slope;
    air.temperature =
        temperature + slope * (without - knot_distance * static_cast<double>(knots_.size() - 1));
  } else {
    const auto knot = static_cast<std::size_t>(place);
    const auto& [from, slope_from] = knots_[knot];
    const auto& [to, slope_to] = knots_[knot + 1];
    const double t = place - static_cast<double>(knot), rise = (to - from) / knot_distance;
    const double bend = slope_from + slope_to - 2.0 * rise, sag = rise - slope_from;
    air.temperature = from + knot_distance * t * (slope_from + t * (sag + (t - 1.0) * bend));
    air.slope = slope_from + t * (2.0 * sag + (3.0 * t - 2.0) * bend);
  }
  air.capacity_ratio = air.temperature / (without * air.slope);
  return air;
}

double Isentropes::without(double temperature) const {
  constexpr double exact = 1e-14;
  constexpr int most = 20;
  double result = temperature;
  for (int count = 0; count < most; ++count) {
    const CompressedAir air = at(result);
    const double more = (temperature - air.temperature) / air.slope;
    result += more;
    if (std::abs(more) < exact * result) break;
  }
  return result;
}

double enthalpy(const AirParameters& air, double temperature) {
  const double vibration = air.vibration_temperature;
  const double stored = vibration > 0.0 ? vibration / std::expm1(vibration / temperature) : 0.0;
  return air.specific_heat * temperature + specific_gas_constant(air) * stored;
}

double isentropic_temperature(const AirParameters& air, double pressure) {
  const double exponent = (air.heat_ratio - 1.0) / air.heat_ratio;
  return air.initial_temperature * std::pow(pressure / air.initial_pressure, exponent);
}

double adiabatic_temperature(const AirParameters& air, double pressure) {
  if (pressure <= air.initial_pressure) return air.initial_temperature;  // false for NaN, which goes through
  return isentropic_temperature(air, pressure);
}

double air_density(double temperature, double pressure) {
  const AirParameters usual;
  return usual.density * (pressure / usual.initial_pressure) * (usual.initial_temperature / temperature);
}

AirParameters warmed(AirParameters air, double rise) {
  air.density *= air.initial_temperature / (air.initial_temperature + rise);
  air.initial_temperature += rise;
  return air;
}

}  // namespace launchsafe::materials
