#include "launchsafe/materials/jwl.hpp"

#include <algorithm>
#include <tuple>

namespace launchsafe::materials {

JwlParameters unreacted_composition_b() {
  JwlParameters parameters;  // the defaults are the unreacted explosive
  parameters.initial_energy = -jwl_cold_pressure(parameters, 1.0) / parameters.omega;
  return parameters;
}

JwlParameters composition_b_products() {
  JwlParameters parameters;
  parameters.a = 5.242e11;
  parameters.b = 7.678e9;
  parameters.r1 = 4.2;
  parameters.r2 = 1.1;
  parameters.omega = 0.34;
  parameters.initial_energy = 8.5e9;
  return parameters;
}

double jwl_energy_at_temperature(const JwlParameters& m, double v, double heat_capacity, double temperature) {
  return m.a / m.r1 * std::exp(-m.r1 * v) + m.b / m.r2 * std::exp(-m.r2 * v) + heat_capacity * temperature;
}

double chapman_jouguet_volume(const JwlParameters& m, double velocity, double pressure) {
  return 1.0 - pressure / (m.initial_density * velocity * velocity);
}

double chapman_jouguet_initial_energy(const JwlParameters& m, double velocity, double pressure) {
  const double volume = chapman_jouguet_volume(m, velocity, pressure);
  const double energy = (pressure - jwl_cold_pressure(m, volume)) * volume / m.omega;
  return energy - 0.5 * pressure * (1.0 - volume);
}

namespace {

/// A e^(-R1 V), B e^(-R2 V) and w K V^(-1-w) of the isentrope, in more digits than the fit keeps.
struct Terms {
  long double first, second, thermal;

  long double sum() const { return first + second + thermal; }
  long double size() const { return std::abs(first) + std::abs(second) + std::abs(thermal); }
};

Terms terms(const JwlParameters& m, long double v) {
  const long double cold = m.a / static_cast<long double>(m.r1) * std::exp(-static_cast<long double>(m.r1)) +
                           m.b / static_cast<long double>(m.r2) * std::exp(-static_cast<long double>(m.r2));
  return {m.a * std::exp(-m.r1 * v), m.b * std::exp(-m.r2 * v),
          m.omega * (m.initial_energy - cold) * std::pow(v, -1.0L - m.omega)};
}

/// Round-off of a sum of the three terms in double precision, Pa.
double round_off(const Terms& t) { return static_cast<double>(4.0L * 0x1p-52L * t.size()); }

}  // namespace

JwlIsentrope::JwlIsentrope(const JwlParameters& law) : law_(law) {
  const Terms rest = terms(law, 1.0L);
  const double pressure = static_cast<double>(rest.sum());
  at_rest_ = std::abs(pressure) <= round_off(rest) ? 0.0 : pressure;
  // Stiffer laws than those known (R1 above 15 or so) bend too much for the whole interval.
  while (!fit()) {
    const double shrink = highest_ > 1e-3 ? 0.5 : 0.0;  // 0 leaves the closed form alone
    lowest_ *= shrink;
    highest_ *= shrink;
    if (!(highest_ > 0.0)) break;
  }
}

bool JwlIsentrope::fit() {
  const long double rest = terms(law_, 1.0L).sum();
  const auto secant = [&](long double x) {
    const long double least = 1e-9L;  // a node at rest itself would be 0/0
    const long double from_rest = std::abs(x) < least ? least : x;
    return (terms(law_, 1.0L + from_rest).sum() - rest) / from_rest;
  };
  coefficients_ = math::chebyshev_fit<std::tuple_size_v<decltype(coefficients_)>>(secant, lowest_, highest_);
  constexpr int points = 1000;
  bool as_exact = true;
  error_ = 0;
  for (int k = 0; k <= points; ++k) {
    const double x = lowest_ + (highest_ - lowest_) * k / points;
    const double near = at_rest_ + x * math::polynomial(coefficients_, x);
    const Terms exact = terms(law_, 1.0L + x);
    const double error = std::abs(static_cast<double>(near - exact.sum()));
    error_ = std::max(error_, error);
    as_exact = as_exact && error <= round_off(exact);  // false for NaN
  }
  return as_exact;
}

}  // namespace launchsafe::materials
