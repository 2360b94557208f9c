#include "launchsafe/materials/kinetics.hpp"

#include <algorithm>

namespace launchsafe::materials {
namespace {

bool same_law(const KineticsParameters& a, const KineticsParameters& b) {
  return a.heat_of_reaction == b.heat_of_reaction && a.frequency == b.frequency &&
         a.activation_temperature == b.activation_temperature;
}

/// Whether a wave of speed u overshoots: g falls to 0 before T does to `cold`. Integrates d(g^2)/dT =
/// 2 (u g - rate)/alpha from the hot end down by the classical Runge-Kutta method; there g goes with hot - T.
bool overshoots(const std::function<double(double)>& rate, double diffusivity, double cold, double hot,
                double u) {
  constexpr int steps = 4000;
  const double h = (hot - cold) / steps;
  const double fall = std::max(rate(hot - h), 0.0) / h;  // -d(rate)/dT at the hot end, 1/s
  const double growth = (std::sqrt(u * u + 4.0 * diffusivity * fall) - u) / (2.0 * diffusivity);  // 1/m
  double square = growth * h * growth * h;
  const auto slope = [&](double temperature, double g2) {
    return 2.0 * (rate(temperature) - u * std::sqrt(std::max(g2, 0.0))) / diffusivity;
  };
  for (int k = 1; k < steps; ++k) {
    const double temperature = hot - k * h;
    const double k1 = slope(temperature, square);
    const double k2 = slope(temperature - 0.5 * h, square + 0.5 * h * k1);
    const double k3 = slope(temperature - 0.5 * h, square + 0.5 * h * k2);
    const double k4 = slope(temperature - h, square + h * k3);
    square += h * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
    if (!(square > 0.0)) return true;
  }
  return false;
}

}  // namespace

double adiabatic_runaway_time(const KineticsParameters& k, double specific_heat, double from) {
  constexpr double to = 2000.0;  // K
  constexpr int intervals = 2000;
  const double theta = k.activation_temperature, begin = theta / from, end = theta / to;
  const double h = (begin - end) / intervals;
  double sum = 0;
  for (int i = 0; i <= intervals; ++i) {
    const double x = i * h, temperature = theta / (begin - x);
    const double weight = i == 0 || i == intervals ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    sum += weight * std::exp(-x) * temperature * temperature / theta;
  }
  return h / 3.0 * sum / arrhenius_heating(k, specific_heat, from);
}

double reaction_degree(const KineticsParameters& k, double temperature) {
  if (std::isnan(temperature)) return temperature;
  if (temperature > k.burnt_temperature) return 1.0;
  if (temperature < k.ignition_temperature || !(k.ignition_temperature < k.burnt_temperature)) return 0.0;
  return (temperature - k.ignition_temperature) / (k.burnt_temperature - k.ignition_temperature);
}

KineticsParameters named_kinetics(const std::string& name) {
  KineticsParameters kinetics;
  if (name == "printed") kinetics.activation_temperature = 2.7e4;
  kinetics.name = name;
  return kinetics;
}

std::string name_of(const KineticsParameters& kinetics) {
  for (const std::string name : {"comp-b", "printed"})
    if (same_law(kinetics, named_kinetics(name))) return name;
  return "custom";
}

double travelling_wave_speed(const std::function<double(double)>& rate, double diffusivity, double cold,
                             double hot) {
  // Bounds: u^2 <= 4 alpha sup rate/(T - cold) (Aronson & Weinberger 1975).
  double steepest = 0;
  constexpr int samples = 1000;
  for (int k = 1; k < samples; ++k) {
    const double temperature = cold + (hot - cold) * k / samples;
    steepest = std::max(steepest, rate(temperature) / (temperature - cold));
  }
  if (!(steepest > 0.0)) return 0.0;
  double slow = 0.0, fast = 2.0 * std::sqrt(diffusivity * steepest);
  constexpr int bisections = 40;
  for (int k = 0; k < bisections; ++k) {
    const double middle = 0.5 * (slow + fast);
    (overshoots(rate, diffusivity, cold, hot, middle) ? fast : slow) = middle;
  }
  return 0.5 * (slow + fast);
}

double deflagration_speed(const KineticsParameters& k, double conductivity, double density,
                          double specific_heat, double unburnt) {
  if (!(unburnt < k.burnt_temperature)) return 0.0;
  if (k.heat_of_reaction < specific_heat * (k.burnt_temperature - unburnt)) return 0.0;
  const double ahead = arrhenius_heating(k, specific_heat, unburnt);
  const auto rate = [&](double temperature) {
    const double left = 1.0 - reaction_degree(k, temperature);
    return std::max(left * (arrhenius_heating(k, specific_heat, temperature) - ahead), 0.0);
  };
  return travelling_wave_speed(rate, conductivity / (density * specific_heat), unburnt, k.burnt_temperature);
}

}  // namespace launchsafe::materials
