// What scene files may say of steel.
#include "launchsafe/materials/steel.hpp"

namespace launchsafe::materials {
using keys::above_to, keys::acting_on, keys::ActsOn, keys::between, keys::Dimension, keys::Key,
    keys::Standing, keys::usually;

namespace {

std::vector<Key<MieGruneisenParameters>> pressure_keys() {
  return {
      number_key("density", Dimension::density, between(500, 25e3), Standing::paper, "Density before launch.",
                 &MieGruneisenParameters::density),
      number_key("sound_speed", Dimension::speed, between(100, 2e4), Standing::paper,
                 "c0 of the linear Hugoniot.", &MieGruneisenParameters::sound_speed),
      number_key("hugoniot_slope", Dimension::number, between(0, 10), Standing::paper,
                 "s of the linear Hugoniot.", &MieGruneisenParameters::slope),
      number_key("gruneisen", Dimension::number, between(0, 10), Standing::paper,
                 "Grueneisen coefficient at the initial density.", &MieGruneisenParameters::gruneisen),
      number_key("pole_fraction", Dimension::number, above_to(0, 0.99), Standing::assumed,
                 "Largest compression as a share of the Hugoniot's pole 1/(s - 1).",
                 &MieGruneisenParameters::pole_fraction),
  };
}

std::vector<Key<JohnsonCookParameters>> strength_keys() {
  return {
      number_key("yield_stress", Dimension::pressure, above_to(0, 1e12), Standing::paper,
                 "A of Johnson-Cook.", &JohnsonCookParameters::a),
      number_key("hardening", Dimension::pressure, between(0, 1e12), Standing::paper, "B of Johnson-Cook.",
                 &JohnsonCookParameters::b),
      number_key("hardening_exponent", Dimension::number, above_to(0, 10), Standing::paper,
                 "n of Johnson-Cook.", &JohnsonCookParameters::n),
      number_key("rate_sensitivity", Dimension::number, between(0, 1), Standing::paper, "C of Johnson-Cook.",
                 &JohnsonCookParameters::c),
      number_key("softening_exponent", Dimension::number, above_to(0, 10), Standing::paper,
                 "m of Johnson-Cook.", &JohnsonCookParameters::m),
      number_key("reference_rate", Dimension::frequency, above_to(0, 1e12), Standing::assumed,
                 "Plastic strain rate at which the rate factor of Johnson-Cook is 1.",
                 &JohnsonCookParameters::reference_rate),
      number_key("room_temperature", Dimension::temperature, above_to(0, 1e4), Standing::assumed,
                 "Temperature below which Johnson-Cook does not soften.",
                 &JohnsonCookParameters::room_temperature),
      number_key("melting_temperature", Dimension::temperature, above_to(0, 1e4), Standing::paper,
                 "Temperature at which the flow stress vanishes.",
                 &JohnsonCookParameters::melting_temperature),
      number_key("shear_modulus", Dimension::pressure, above_to(0, 1e12), Standing::literature,
                 "Shear modulus.", &JohnsonCookParameters::shear_modulus),
      number_key("specific_heat", Dimension::specific_heat, between(50, 1e4), Standing::paper,
                 "Specific heat.", &JohnsonCookParameters::specific_heat),
      number_key("taylor_quinney", Dimension::number, between(0, 1), Standing::assumed,
                 "Share of the plastic work that becomes heat.", &JohnsonCookParameters::taylor_quinney),
      number_key("conductivity", Dimension::conductivity, between(0, 1e4), Standing::literature,
                 "Thermal conductivity.", &JohnsonCookParameters::conductivity) |
          acting_on(ActsOn::conduction),
  };
}

}  // namespace

std::vector<Key<Steel>> Steel::parameters() {
  return keys::joined({keys_of_part("steel.", &Steel::eos, pressure_keys()),
                       keys_of_part("steel.", &Steel::strength, strength_keys())});
}

}  // namespace launchsafe::materials
