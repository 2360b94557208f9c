// What scene files may say of steel.
#include "launchsafe/materials/steel.hpp"

namespace launchsafe::materials {
using keys::above_to, keys::ActsOn, keys::between, keys::Dimension, keys::Key, keys::Role, keys::Standing,
    keys::usually;

namespace {

std::vector<Key<MieGruneisenParameters>> pressure_keys() {
  return {
      number_key("density", Dimension::density, between(500, 25e3), Standing::paper, "Density before launch.",
                 &MieGruneisenParameters::density) |
          plausibly(between(7.5e3, 8.2e3), "steels have 7.7 to 8.1 g/cm3"),
      number_key("sound_speed", Dimension::speed, between(100, 2e4), Standing::paper,
                 "c0 of the linear Hugoniot.", &MieGruneisenParameters::sound_speed) |
          plausibly(between(4e3, 5.2e3), "iron and steels have 4.5 to 4.7 km/s"),
      number_key("hugoniot_slope", Dimension::number, between(0, 10), Standing::paper,
                 "s of the linear Hugoniot.", &MieGruneisenParameters::slope) |
          plausibly(between(1, 2), "metals have 1.2 to 1.9"),
      number_key("gruneisen", Dimension::number, between(0, 10), Standing::paper,
                 "Grueneisen coefficient at the initial density.", &MieGruneisenParameters::gruneisen) |
          plausibly(between(1, 2.5), "metals have 1 to 2.5, and steels about 1.7"),
      number_key("pole_fraction", Dimension::number, above_to(0, 0.99), Standing::assumed,
                 "Largest compression as a share of the Hugoniot's pole 1/(s - 1).",
                 &MieGruneisenParameters::pole_fraction) |
          plausibly(between(0.3, 0.95), "nearer to the pole no Hugoniot was measured"),
  };
}

std::vector<Key<JohnsonCookParameters>> strength_keys() {
  return {
      number_key("yield_stress", Dimension::pressure, above_to(0, 1e12), Standing::paper,
                 "A of Johnson-Cook.", &JohnsonCookParameters::a) |
          plausibly(between(150e6, 3e9), "mild steel has 200 MPa, the hardest steels 2.5 GPa"),
      number_key("hardening", Dimension::pressure, between(0, 1e12), Standing::paper, "B of Johnson-Cook.",
                 &JohnsonCookParameters::b) |
          plausibly(between(0, 3e9), "steels harden by less than their strength"),
      number_key("hardening_exponent", Dimension::number, above_to(0, 10), Standing::paper,
                 "n of Johnson-Cook.", &JohnsonCookParameters::n) |
          plausibly(between(0.03, 1), "steels have 0.1 to 0.6"),
      number_key("rate_sensitivity", Dimension::number, between(0, 1), Standing::paper, "C of Johnson-Cook.",
                 &JohnsonCookParameters::c) |
          plausibly(between(0, 0.1), "steels gain some percent of strength in each decade"),
      number_key("softening_exponent", Dimension::number, above_to(0, 10), Standing::paper,
                 "m of Johnson-Cook.", &JohnsonCookParameters::m) |
          plausibly(between(0.3, 3), "steels have 0.5 to 1.5"),
      number_key("reference_rate", Dimension::frequency, above_to(0, 1e12), Standing::assumed,
                 "Plastic strain rate at which the rate factor of Johnson-Cook is 1.",
                 &JohnsonCookParameters::reference_rate) |
          plausibly(between(1e-5, 1e4), "it lies between the slowest and the fastest tests"),
      number_key("room_temperature", Dimension::temperature, above_to(0, 1e4), Standing::assumed,
                 "Temperature below which Johnson-Cook does not soften.",
                 &JohnsonCookParameters::room_temperature) |
          plausibly(between(250, 350), "it is that of a laboratory"),
      number_key("melting_temperature", Dimension::temperature, above_to(0, 1e4), Standing::paper,
                 "Temperature at which the flow stress vanishes.",
                 &JohnsonCookParameters::melting_temperature) |
          plausibly(between(1.5e3, 1.9e3), "iron melts at 1811 K, its alloys below"),
      number_key("shear_modulus", Dimension::pressure, above_to(0, 1e12), Standing::literature,
                 "Shear modulus.", &JohnsonCookParameters::shear_modulus) |
          plausibly(between(70e9, 90e9), "steels have 76 to 84 GPa"),
      number_key("specific_heat", Dimension::specific_heat, between(50, 1e4), Standing::paper,
                 "Specific heat.", &JohnsonCookParameters::specific_heat) |
          plausibly(between(400, 700), "iron has 450 J/(kg K) at 300 K"),
      number_key("taylor_quinney", Dimension::number, between(0, 1), Standing::assumed,
                 "Share of the plastic work that becomes heat.", &JohnsonCookParameters::taylor_quinney) |
          plausibly(between(0.3, 1), "0.3 to 1 of plastic work was measured to become heat"),
      number_key("conductivity", Dimension::conductivity, between(0, 1e4), Standing::literature,
                 "Thermal conductivity.", &JohnsonCookParameters::conductivity) |
          plausibly(between(10, 80), "stainless steel has 15 W/(m K), pure iron 80",
                    Role{ActsOn::conduction}),
  };
}

}  // namespace

std::vector<Key<Steel>> Steel::parameters() {
  return keys::joined({keys_of_part("steel.", &Steel::eos, pressure_keys()),
                       keys_of_part("steel.", &Steel::strength, strength_keys())});
}

}  // namespace launchsafe::materials
