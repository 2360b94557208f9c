#include "material_keys.hpp"

#include <string>
#include <utility>

namespace launchsafe::scene {
namespace {

using Keys = std::vector<Key<Scene>>;

template <class Member>
Key<Scene> number(std::string name, Dimension dimension, Limits limits, Standing standing,
                  std::string sentence, Member member) {
  return number_key<Scene>(std::move(name), dimension, limits, standing, std::move(sentence), member);
}

/// A JWL constant: whenever one changes, the initial energy follows, so that p(V = 1) = 0.
Key<Scene> balanced(Key<Scene> key) {
  key.set = [set = std::move(key.set)](Scene& scene, const Value& value) {
    set(scene, value);
    materials::JwlParameters& eos = scene.charge.eos;
    eos.initial_energy = -materials::jwl_cold_pressure(eos, 1.0) / eos.omega;
  };
  return key;
}

bool same_law(const materials::KineticsParameters& a, const materials::KineticsParameters& b) {
  return a.heat_of_reaction == b.heat_of_reaction && a.frequency == b.frequency &&
         a.activation_temperature == b.activation_temperature;
}

/// The named kinetics; "custom" starts from "comp-b".
materials::KineticsParameters named_kinetics(const std::string& name) {
  materials::KineticsParameters kinetics;
  if (name == "printed") kinetics.activation_temperature = 2.7e4;
  kinetics.name = name;
  return kinetics;
}

/// Names the kinetics after its numbers.
void rename(materials::KineticsParameters& kinetics) {
  kinetics.name = "custom";
  for (const std::string name : {"comp-b", "printed"}) {
    if (same_law(kinetics, named_kinetics(name))) kinetics.name = name;
  }
}

Key<Scene> renaming(Key<Scene> key) {
  key.set = [set = std::move(key.set)](Scene& scene, const Value& value) {
    set(scene, value);
    rename(scene.charge.kinetics);
  };
  return key;
}

Key<Scene> kinetics_set_key() {
  Key<Scene> key{
      {.name = "kinetics.set",
       .kind = KeyKind::word,
       .words = {"comp-b", "printed", "custom"},
       .standing = Standing::calibrated,
       .sentence = "Named decomposition kinetics: activation temperature 21700 K (comp-b) or 27000 K as "
                   "printed; custom says that the keys below make their own."},
      {},
      {}};
  key.set = [](Scene& scene, const Value& value) {
    const auto named = named_kinetics(std::get<std::string>(value));
    materials::KineticsParameters& kinetics = scene.charge.kinetics;
    kinetics.name = named.name;
    kinetics.heat_of_reaction = named.heat_of_reaction;
    kinetics.frequency = named.frequency;
    kinetics.activation_temperature = named.activation_temperature;
  };
  key.get = [](const Scene& scene) { return Value(scene.charge.kinetics.name); };
  return key;
}

Key<Scene> crack_friction_key() {
  Key<Scene> key{{.name = "charge.crack_friction",
                  .kind = KeyKind::flag,
                  .standing = Standing::literature,
                  .sentence = "Friction between closed crack faces; false is face_friction = 0."},
                 {},
                 {}};
  key.set = [](Scene& scene, const Value& value) {
    double& friction = scene.charge.cracks.face_friction;
    if (!std::get<bool>(value)) friction = 0.0;
    if (std::get<bool>(value) && friction == 0.0) friction = materials::ViscoScramParameters{}.face_friction;
  };
  key.get = [](const Scene& scene) { return Value(scene.charge.cracks.face_friction > 0.0); };
  return key;
}

Keys crack_keys() {
  return {
      number(
          "charge.crack_radius", Dimension::length, between(0, 1), Standing::paper,
          "Mean crack radius c(0) before launch; 0 leaves the cracks out.",
          [](auto& s) -> auto& { return s.charge.cracks.initial_crack_radius; }),
      number(
          "charge.flaw_size", Dimension::length, between(0, 1), Standing::paper,
          "Flaw size a, which cracks are measured against; 0 leaves the cracks out.",
          [](auto& s) -> auto& { return s.charge.cracks.flaw_size; }),
      number(
          "charge.largest_crack_radius", Dimension::length, above_to(0, 1), Standing::assumed,
          "Crack radius at which growth stops.",
          [](auto& s) -> auto& { return s.charge.cracks.largest_crack_radius; }),
      flag_key<Scene>(
          "charge.crack_growth", Standing::paper, "Whether cracks grow; false freezes their radius.",
          [](auto& s) -> auto& { return s.charge.cracks.growth; }),
      number(
          "charge.largest_growth_speed", Dimension::speed, above_to(0, 1e4), Standing::paper,
          "Limit v_max of the crack growth speed.",
          [](auto& s) -> auto& { return s.charge.cracks.largest_growth_speed; }),
      number(
          "charge.growth_exponent", Dimension::number, above_to(0, 100), Standing::paper,
          "Exponent m of slow crack growth.",
          [](auto& s) -> auto& { return s.charge.cracks.growth_exponent; }),
      number(
          "charge.toughness", Dimension::toughness, above_to(0, 1e9), Standing::paper,
          "Threshold stress intensity K0 of frictionless cracks.",
          [](auto& s) -> auto& { return s.charge.cracks.toughness; }),
      number(
          "charge.face_friction", Dimension::number, between(0, 1.2), Standing::literature,
          "Friction coefficient mu_s of closed crack faces, which raises the toughness; 0 leaves it out.",
          [](auto& s) -> auto& { return s.charge.cracks.face_friction; }),
      crack_friction_key(),
      list_key<Scene>(
          "charge.shear_moduli", Dimension::pressure, above_to(0, 1e12), Standing::paper,
          "Shear moduli G_n of the Maxwell elements.",
          [](auto& s) -> auto& { return s.charge.cracks.shear_moduli; }, materials::maxwell_elements),
      list_key<Scene>(
          "charge.relaxation_rates", Dimension::frequency, between(0, 1e15), Standing::paper,
          "Relaxation rates 1/tau_n of the Maxwell elements; 0 is an elastic spring.",
          [](auto& s) -> auto& { return s.charge.cracks.relaxation_rates; }, materials::maxwell_elements),
  };
}

Keys pressure_keys() {
  return {
      number(
          "charge.density", Dimension::density, between(500, 25e3), Standing::paper, "Density before launch.",
          [](auto& s) -> auto& { return s.charge.eos.initial_density; }),
      balanced(number(
          "charge.jwl.a", Dimension::pressure, above_to(0, 1e17), Standing::paper, "A of the unreacted JWL.",
          [](auto& s) -> auto& { return s.charge.eos.a; })),
      balanced(number(
          "charge.jwl.b", Dimension::pressure, between(-1e12, 1e12), Standing::paper,
          "B of the unreacted JWL.", [](auto& s) -> auto& { return s.charge.eos.b; })),
      balanced(number(
          "charge.jwl.r1", Dimension::number, above_to(0, 100), Standing::paper, "R1 of the unreacted JWL.",
          [](auto& s) -> auto& { return s.charge.eos.r1; })),
      balanced(number(
          "charge.jwl.r2", Dimension::number, above_to(0, 100), Standing::paper, "R2 of the unreacted JWL.",
          [](auto& s) -> auto& { return s.charge.eos.r2; })),
      balanced(number(
          "charge.jwl.omega", Dimension::number, above_to(0, 10), Standing::paper,
          "w of the unreacted JWL; its initial energy follows from p(V = 1) = 0.",
          [](auto& s) -> auto& { return s.charge.eos.omega; })),
      number(
          "charge.tension_cutoff", Dimension::pressure, above_to(0, 1e12), Standing::assumed,
          "Tension that the charge bears; its pressure never falls below minus this.",
          [](auto& s) -> auto& { return s.charge.tension_cutoff; }),
      number(
          "charge.specific_heat", Dimension::specific_heat, between(100, 1e4), Standing::paper,
          "Specific heat.", [](auto& s) -> auto& { return s.charge.specific_heat; }),
      number(
          "charge.conductivity", Dimension::conductivity, between(0, 1e4), Standing::paper,
          "Thermal conductivity.", [](auto& s) -> auto& { return s.charge.conductivity; }),
      number(
          "charge.sliding_friction", Dimension::number, between(0, 10), Standing::paper,
          "Coefficient mu_d of the friction that heats the charge.",
          [](auto& s) -> auto& { return s.charge.sliding_friction; }),
  };
}

}  // namespace

Keys steel_keys() {
  return {
      number(
          "steel.density", Dimension::density, between(500, 25e3), Standing::paper, "Density before launch.",
          [](auto& s) -> auto& { return s.steel.eos.density; }),
      number(
          "steel.sound_speed", Dimension::speed, between(100, 2e4), Standing::paper,
          "c0 of the linear Hugoniot.", [](auto& s) -> auto& { return s.steel.eos.sound_speed; }),
      number(
          "steel.hugoniot_slope", Dimension::number, between(0, 10), Standing::paper,
          "s of the linear Hugoniot.", [](auto& s) -> auto& { return s.steel.eos.slope; }),
      number(
          "steel.gruneisen", Dimension::number, between(0, 10), Standing::paper,
          "Grueneisen coefficient at the initial density.",
          [](auto& s) -> auto& { return s.steel.eos.gruneisen; }),
      number(
          "steel.pole_fraction", Dimension::number, above_to(0, 0.99), Standing::assumed,
          "Largest compression as a share of the Hugoniot's pole 1/(s - 1).",
          [](auto& s) -> auto& { return s.steel.eos.pole_fraction; }),
      number(
          "steel.yield_stress", Dimension::pressure, above_to(0, 1e12), Standing::paper, "A of Johnson-Cook.",
          [](auto& s) -> auto& { return s.steel.strength.a; }),
      number(
          "steel.hardening", Dimension::pressure, between(0, 1e12), Standing::paper, "B of Johnson-Cook.",
          [](auto& s) -> auto& { return s.steel.strength.b; }),
      number(
          "steel.hardening_exponent", Dimension::number, above_to(0, 10), Standing::paper,
          "n of Johnson-Cook.", [](auto& s) -> auto& { return s.steel.strength.n; }),
      number(
          "steel.rate_sensitivity", Dimension::number, between(0, 1), Standing::paper, "C of Johnson-Cook.",
          [](auto& s) -> auto& { return s.steel.strength.c; }),
      number(
          "steel.softening_exponent", Dimension::number, above_to(0, 10), Standing::paper,
          "m of Johnson-Cook.", [](auto& s) -> auto& { return s.steel.strength.m; }),
      number(
          "steel.reference_rate", Dimension::frequency, above_to(0, 1e12), Standing::assumed,
          "Plastic strain rate at which the rate factor of Johnson-Cook is 1.",
          [](auto& s) -> auto& { return s.steel.strength.reference_rate; }),
      number(
          "steel.room_temperature", Dimension::temperature, above_to(0, 1e4), Standing::assumed,
          "Temperature below which Johnson-Cook does not soften.",
          [](auto& s) -> auto& { return s.steel.strength.room_temperature; }),
      number(
          "steel.melting_temperature", Dimension::temperature, above_to(0, 1e4), Standing::paper,
          "Temperature at which the flow stress vanishes.",
          [](auto& s) -> auto& { return s.steel.strength.melting_temperature; }),
      number(
          "steel.shear_modulus", Dimension::pressure, above_to(0, 1e12), Standing::literature,
          "Shear modulus.", [](auto& s) -> auto& { return s.steel.strength.shear_modulus; }),
      number(
          "steel.specific_heat", Dimension::specific_heat, between(50, 1e4), Standing::paper,
          "Specific heat.", [](auto& s) -> auto& { return s.steel.strength.specific_heat; }),
      number(
          "steel.taylor_quinney", Dimension::number, between(0, 1), Standing::assumed,
          "Share of the plastic work that becomes heat.",
          [](auto& s) -> auto& { return s.steel.strength.taylor_quinney; }),
      number(
          "steel.conductivity", Dimension::conductivity, between(0, 1e4), Standing::literature,
          "Thermal conductivity.", [](auto& s) -> auto& { return s.steel.strength.conductivity; }),
  };
}

Keys charge_keys() {
  Keys keys = crack_keys();
  for (Key<Scene>& key : pressure_keys()) keys.push_back(std::move(key));
  return keys;
}

Keys kinetics_keys() {
  return {
      kinetics_set_key(),
      renaming(number(
          "kinetics.heat_of_reaction", Dimension::specific_energy, between(0, 1e8), Standing::paper,
          "Heat Q that the reaction releases.",
          [](auto& s) -> auto& { return s.charge.kinetics.heat_of_reaction; })),
      renaming(number(
          "kinetics.frequency", Dimension::frequency, between(0, 1e30), Standing::paper,
          "Frequency factor Z of the Arrhenius law.",
          [](auto& s) -> auto& { return s.charge.kinetics.frequency; })),
      renaming(number(
          "kinetics.activation_temperature", Dimension::temperature, above_to(0, 1e6), Standing::calibrated,
          "Activation energy over the gas constant, E/R.",
          [](auto& s) -> auto& { return s.charge.kinetics.activation_temperature; })),
      number(
          "kinetics.ignition_temperature", Dimension::temperature, above_to(0, 2e3), Standing::calibrated,
          "Temperature T1 that triggers ignition.",
          [](auto& s) -> auto& { return s.charge.kinetics.ignition_temperature; }),
      number(
          "kinetics.burnt_temperature", Dimension::temperature, above_to(0, 1e4), Standing::paper,
          "Temperature T2 at which the reaction is complete.",
          [](auto& s) -> auto& { return s.charge.kinetics.burnt_temperature; }),
  };
}

}  // namespace launchsafe::scene
