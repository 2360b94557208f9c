#include "launchsafe/materials/unreacted_jwl.hpp"

#include <fmt/format.h>

namespace launchsafe::materials {
using keys::above_to, keys::between, keys::Dimension, keys::Key, keys::Standing, keys::then;

namespace {

/// Whenever a JWL constant changes, the initial energy follows, so that p(V = 1) = 0.
void balance(JwlParameters& eos) { eos.initial_energy = -jwl_cold_pressure(eos, 1.0) / eos.omega; }

std::vector<Key<JwlParameters>> constants_keys() {
  const auto constant = [](const char* name, Dimension dimension, keys::Limits limits, const char* sentence,
                           double JwlParameters::*member, keys::Limits plausible, const char* because) {
    return number_key(name, dimension, limits, Standing::paper, sentence, member) | then(balance) |
           plausibly(plausible, because);
  };
  return {
      constant("jwl.a", Dimension::pressure, above_to(0, 1e17), "A of the unreacted JWL.", &JwlParameters::a,
               between(1e12, 1e16), "unreacted explosives are fitted with 17 to 950 TPa"),
      constant("jwl.b", Dimension::pressure, between(-1e12, 1e12), "B of the unreacted JWL.",
               &JwlParameters::b, between(-5e10, 0), "unreacted explosives are fitted with -4 to -7 GPa"),
      constant("jwl.r1", Dimension::number, above_to(0, 100), "R1 of the unreacted JWL.", &JwlParameters::r1,
               between(6, 20), "unreacted explosives are fitted with 10 to 14"),
      constant("jwl.r2", Dimension::number, above_to(0, 100), "R2 of the unreacted JWL.", &JwlParameters::r2,
               between(0.5, 3), "unreacted explosives are fitted with a tenth of R1"),
      constant("jwl.omega", Dimension::number, above_to(0, 10),
               "w of the unreacted JWL; its initial energy follows from p(V = 1) = 0.", &JwlParameters::omega,
               between(0.3, 1.5), "it is the Grueneisen coefficient of an organic solid"),
  };
}

}  // namespace

double UnreactedJwl::energy(double volume) const {
  const JwlParameters& m = constants;
  const double thermal = m.initial_energy - jwl_cold_energy(m, 1.0);
  return jwl_cold_energy(m, volume) + thermal * std::pow(volume, -m.omega) - m.initial_energy;
}

std::optional<ConstantsFault> UnreactedJwl::fault() const {
  if (!(constants.r1 > constants.r2))
    return ConstantsFault{{"jwl.r2", "jwl.r1"},
                          fmt::format("R1 = {:.6g} and R2 = {:.6g}", constants.r1, constants.r2),
                          "R1 above R2"};
  const double bulk = bulk_modulus_at_rest();
  if (bulk > 0.0) return std::nullopt;
  return ConstantsFault{{"jwl.a", "jwl.omega", "jwl.r2", "jwl.r1", "jwl.b"},
                        fmt::format("a JWL with a bulk modulus of {:.4g} GPa before launch", 1e-9 * bulk),
                        "constants whose bulk modulus is above 0 GPa"};
}

std::vector<Key<UnreactedJwl>> UnreactedJwl::parameters() {
  return keys_of_part("", &UnreactedJwl::constants, constants_keys());
}

}  // namespace launchsafe::materials
