#include "launchsafe/materials/jwl.hpp"

#include <fmt/format.h>

#include <tuple>

namespace launchsafe::materials {

using keys::above_to, keys::between, keys::Dimension, keys::Key, keys::Standing, keys::then;

namespace {

/// The part of the pressure (Pa) at V = 1 that does not depend on the energy.
double cold_pressure_at_rest(const JwlParameters& m) {
  return m.a * (1.0 - m.omega / m.r1) * std::exp(-m.r1) + m.b * (1.0 - m.omega / m.r2) * std::exp(-m.r2);
}

/// The initial energy follows from the other constants, so that p(V = 1) = 0.
void balance(JwlParameters& m) { m.initial_energy = -cold_pressure_at_rest(m) / m.omega; }

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

JwlParameters unreacted_composition_b() {
  JwlParameters parameters;  // the defaults are the unreacted explosive
  balance(parameters);
  return parameters;
}

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
  for (int k = 0; k <= points; ++k) {
    const double x = lowest_ + (highest_ - lowest_) * k / points;
    const double near = at_rest_ + x * math::polynomial(coefficients_, x);
    const Terms exact = terms(law_, 1.0L + x);
    const double error = std::abs(static_cast<double>(near - exact.sum()));
    as_exact = as_exact && error <= round_off(exact);  // false for NaN
  }
  return as_exact;
}

double jwl_bulk_modulus_at_rest(const JwlParameters& m) {
  const double pressure = cold_pressure_at_rest(m) + m.omega * m.initial_energy;
  const double slope = m.a * std::exp(-m.r1) * (m.omega / m.r1 - m.r1 + m.omega) +
                       m.b * std::exp(-m.r2) * (m.omega / m.r2 - m.r2 + m.omega) -
                       m.omega * m.initial_energy;  // dp/dV at constant energy
  return m.omega * pressure - slope;
}

double jwl_isentropic_energy(const JwlParameters& m, double volume) {
  const double thermal = m.initial_energy - jwl_cold_energy(m, 1.0);
  return jwl_cold_energy(m, volume) + thermal * std::pow(volume, -m.omega) - m.initial_energy;
}

std::optional<ConstantsFault> fault_of(const JwlParameters& m) {
  if (!(m.r1 > m.r2))
    return ConstantsFault{
        {"jwl.r2", "jwl.r1"}, fmt::format("R1 = {:.6g} and R2 = {:.6g}", m.r1, m.r2), "R1 above R2"};
  const double bulk = jwl_bulk_modulus_at_rest(m);
  if (bulk > 0.0) return std::nullopt;
  return ConstantsFault{{"jwl.a", "jwl.omega", "jwl.r2", "jwl.r1", "jwl.b"},
                        fmt::format("a JWL with a bulk modulus of {:.4g} GPa before launch", 1e-9 * bulk),
                        "constants whose bulk modulus is above 0 GPa"};
}

std::vector<Key<JwlParameters>> jwl_keys() {
  const auto constant = [](const char* name, Dimension dimension, keys::Limits limits, const char* sentence,
                           double JwlParameters::*member) {
    return number_key(name, dimension, limits, Standing::paper, sentence, member) | then(balance);
  };
  return {
      constant("jwl.a", Dimension::pressure, above_to(0, 1e17), "A of the unreacted JWL.", &JwlParameters::a),
      constant("jwl.b", Dimension::pressure, between(-1e12, 1e12), "B of the unreacted JWL.",
               &JwlParameters::b),
      constant("jwl.r1", Dimension::number, above_to(0, 100), "R1 of the unreacted JWL.", &JwlParameters::r1),
      constant("jwl.r2", Dimension::number, above_to(0, 100), "R2 of the unreacted JWL.", &JwlParameters::r2),
      constant("jwl.omega", Dimension::number, above_to(0, 10),
               "w of the unreacted JWL; its initial energy follows from p(V = 1) = 0.",
               &JwlParameters::omega),
  };
}

}  // namespace launchsafe::materials
