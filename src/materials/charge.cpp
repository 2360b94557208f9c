// What scene files may say of the charge and its kinetics.
#include "launchsafe/materials/charge.hpp"

namespace launchsafe::materials {
using keys::above_to, keys::acting_on, keys::ActsOn, keys::between, keys::Dimension, keys::Key, keys::usually,
    keys::Standing;

namespace {

std::vector<Key<ViscoScramParameters>> crack_keys() {
  return {
      number_key("crack_radius", Dimension::length, between(0, 1), Standing::paper,
                 "Mean crack radius c(0) before launch; 0 leaves the cracks out.",
                 &ViscoScramParameters::initial_crack_radius),
      number_key("flaw_size", Dimension::length, between(0, 1), Standing::paper,
                 "Flaw size a, which cracks are measured against; 0 leaves the cracks out.",
                 &ViscoScramParameters::flaw_size),
      number_key("largest_crack_radius", Dimension::length, between(1e-3, 1), Standing::assumed,
                 "Crack radius at which growth stops.", &ViscoScramParameters::largest_crack_radius),
      flag_key("crack_growth", Standing::paper, "Whether cracks grow; false freezes their radius.",
               &ViscoScramParameters::growth),
      number_key("largest_growth_speed", Dimension::speed, above_to(0, 1e4), Standing::paper,
                 "Limit v_max of the crack growth speed.", &ViscoScramParameters::largest_growth_speed),
      number_key("growth_exponent", Dimension::number, above_to(0, 100), Standing::paper,
                 "Exponent m of slow crack growth.", &ViscoScramParameters::growth_exponent),
      number_key("toughness", Dimension::toughness, above_to(0, 1e9), Standing::paper,
                 "Threshold stress intensity K0 of frictionless cracks.", &ViscoScramParameters::toughness),
      number_key("face_friction", Dimension::number, between(0, 1.2), Standing::literature,
                 "Friction coefficient mu_s of closed crack faces, which raises the "
                 "toughness; 0 leaves it out.",
                 &ViscoScramParameters::face_friction),
      list_key("shear_moduli", Dimension::pressure, above_to(0, 1e12), Standing::paper,
               "Shear moduli G_n of the Maxwell elements.", &ViscoScramParameters::shear_moduli,
               maxwell_elements),
      list_key("relaxation_rates", Dimension::frequency, between(0, 1e15), Standing::paper,
               "Relaxation rates 1/tau_n of the Maxwell elements; 0 is an elastic spring.",
               &ViscoScramParameters::relaxation_rates, maxwell_elements),
  };
}

std::vector<Key<Charge>> heat_keys() {
  return {
      number_key("tension_cutoff", Dimension::pressure, above_to(0, 1e12), Standing::assumed,
                 "Tension that the charge bears; its pressure never falls below minus this.",
                 &Charge::tension_cutoff),
      number_key("specific_heat", Dimension::specific_heat, between(100, 1e4), Standing::paper,
                 "Specific heat.", &Charge::specific_heat) |
          acting_on(ActsOn::heat),
      number_key("conductivity", Dimension::conductivity, between(0, 1e4), Standing::paper,
                 "Thermal conductivity.", &Charge::conductivity) |
          acting_on(ActsOn::conduction),
      number_key("sliding_friction", Dimension::number, between(0, 10), Standing::paper,
                 "Coefficient mu_d of the friction that heats the charge.", &Charge::sliding_friction) |
          acting_on(ActsOn::trace),
  };
}

std::vector<Key<KineticsParameters>> kinetics_keys() {
  return {
      number_key("heat_of_reaction", Dimension::specific_energy, between(0, 1e8), Standing::paper,
                 "Heat Q that the reaction releases.", &KineticsParameters::heat_of_reaction),
      number_key("frequency", Dimension::frequency, between(0, 1e30), Standing::paper,
                 "Frequency factor Z of the Arrhenius law.", &KineticsParameters::frequency),
      number_key("activation_temperature", Dimension::temperature_difference, above_to(0, 1e6),
                 Standing::calibrated, "Activation energy over the gas constant, E/R.",
                 &KineticsParameters::activation_temperature),
      number_key("ignition_temperature", Dimension::temperature, above_to(0, 2e3), Standing::calibrated,
                 "Temperature T1 that triggers ignition.", &KineticsParameters::ignition_temperature) |
          usually("that of the constants"),
      number_key("burnt_temperature", Dimension::temperature, above_to(0, 1e4), Standing::paper,
                 "Temperature T2 at which the reaction is complete.", &KineticsParameters::burnt_temperature),
  };
}

}  // namespace

std::vector<Key<Charge>> Charge::parameters() {
  return keys::joined(
      {keys_of_part("charge.", &Charge::strength, crack_keys()),
       keys::keys_of_part<Charge>("charge.", std::identity{},
                                  {number_key("density", Dimension::density, between(500, 25e3),
                                              Standing::paper, "Density before launch.", &Charge::density)}),
       keys_of_part("charge.", &Charge::eos, jwl_keys()),
       keys_of_part<Charge>("charge.", std::identity{}, heat_keys()),
       keys_of_part("kinetics.", &Charge::kinetics, acting_on(ActsOn::chemistry, kinetics_keys()))});
}

}  // namespace launchsafe::materials
