#include "plausible_ranges.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace launchsafe::scene {
namespace {

struct PlausibleKey {
  std::string key;
  Plausible values;
};
using Keys = std::vector<PlausibleKey>;

PlausibleKey in(std::string key, Limits limits, std::string because) {
  return {std::move(key), {.limits = limits, .because = std::move(because)}};
}
PlausibleKey zero_or_in(std::string key, Limits limits, std::string because) {
  return {std::move(key), {.limits = limits, .or_zero = true, .because = std::move(because)}};
}
PlausibleKey one_of(std::string key, std::vector<std::string> words, std::string because) {
  return {std::move(key), {.words = std::move(words), .because = std::move(because)}};
}
/// All that is allowed is plausible.
PlausibleKey any(std::string key, std::string because) {
  return {std::move(key), {.because = std::move(because)}};
}

Keys of_scene_and_load() {
  return {
      any("title", "it is for people"),
      any("symmetry", "both are shapes that are asked about"),
      any("frame", "a run at rest that errs is doubted by the distance that it flew"),
      any("barrel", "a free shell is the harder case"),
      in("initial_temperature", between(219, 345), "shells are stored and fired from -54 to 71 degC"),
      in("load.duration", between(1e-3, 0.1), "a shell leaves its tube after some milliseconds"),
      in("load.peak", between(10e6, 1e9), "a mortar has 10 MPa, and no gun tube bears 1 GPa"),
      in("load.base", between(0, 20e6), "before the shell moves there is an igniter's pressure at most"),
      in("load.peak_time", between(0.2e-3, 0.05), "propellant burns for some milliseconds"),
      in("load.exponent", between(1, 50), "gentler or steeper pulses than these no propellant makes"),
      any("load.curve", "its pressures are judged by load.measured_peak and load.simulated_peak"),
      any("load.curve_time", "the launch that it makes is judged by load.launch_speed"),
      any("load.curve_pressure", "its largest is judged by load.measured_peak and load.simulated_peak"),
      zero_or_in(
          "load.smoothing", between(1e-6, 1e-3),
          "gauges ring and sample within a millisecond, and a longer average takes from the pulse itself"),
      any("load.rescale_to_peak", "the factor is judged by load.rescaling"),
  };
}

Keys of_steel() {
  return {
      in("steel.density", between(7.5e3, 8.2e3), "steels have 7.7 to 8.1 g/cm3"),
      in("steel.sound_speed", between(4e3, 5.2e3), "iron and steels have 4.5 to 4.7 km/s"),
      in("steel.hugoniot_slope", between(1, 2), "metals have 1.2 to 1.9"),
      in("steel.gruneisen", between(1, 2.5), "metals have 1 to 2.5, and steels about 1.7"),
      in("steel.pole_fraction", between(0.3, 0.95), "nearer to the pole no Hugoniot was measured"),
      in("steel.yield_stress", between(150e6, 3e9), "mild steel has 200 MPa, the hardest steels 2.5 GPa"),
      in("steel.hardening", between(0, 3e9), "steels harden by less than their strength"),
      in("steel.hardening_exponent", between(0.03, 1), "steels have 0.1 to 0.6"),
      in("steel.rate_sensitivity", between(0, 0.1), "steels gain some percent of strength in each decade"),
      in("steel.softening_exponent", between(0.3, 3), "steels have 0.5 to 1.5"),
      in("steel.reference_rate", between(1e-5, 1e4), "it lies between the slowest and the fastest tests"),
      in("steel.room_temperature", between(250, 350), "it is that of a laboratory"),
      in("steel.melting_temperature", between(1.5e3, 1.9e3), "iron melts at 1811 K, its alloys below"),
      in("steel.shear_modulus", between(70e9, 90e9), "steels have 76 to 84 GPa"),
      in("steel.specific_heat", between(400, 700), "iron has 450 J/(kg K) at 300 K"),
      in("steel.taylor_quinney", between(0.3, 1), "0.3 to 1 of plastic work was measured to become heat"),
      in("steel.conductivity", between(10, 80), "stainless steel has 15 W/(m K), pure iron 80"),
  };
}

Keys of_cracks() {
  return {
      in("charge.crack_radius", between(1e-6, 5e-3),
         "grains are micrometres to millimetres large, and 0 would leave the cracks out"),
      in("charge.flaw_size", between(1e-5, 1e-2),
         "flaws are as far apart as grains to pebbles, and 0 would leave the cracks out"),
      in("charge.largest_crack_radius", between(1e-3, 0.1),
         "a smaller bound would stop what heats the charge"),
      one_of("charge.crack_growth", {"true"}, "cracks grow under load, and what freezes them hides heat"),
      in("charge.largest_growth_speed", between(30, 1.5e3),
         "cracks run at a share of the Rayleigh wave speed, 1 km/s"),
      in("charge.growth_exponent", between(2, 50), "subcritical growth is fitted with 5 to 40"),
      in("charge.toughness", between(1e5, 2e6), "explosives have 0.3 to 1 MPa m^0.5"),
      in("charge.face_friction", between(0, 0.8), "dry crystals rub with 0.3 to 0.6; 0 holds no crack back"),
      any("charge.crack_friction", "without it cracks grow sooner"),
      in("charge.shear_moduli", between(1e6, 1e10), "no part exceeds the whole, some GPa for a crystal"),
      in("charge.relaxation_rates", between(0, 1e9), "faster than 1 ns nothing relaxes in a launch"),
  };
}

Keys of_charge_and_kinetics() {
  return {
      in("charge.density", between(1e3, 2.3e3), "pressed and cast explosives have 1.5 to 2 g/cm3"),
      in("charge.jwl.a", between(1e12, 1e16), "unreacted explosives are fitted with 17 to 950 TPa"),
      in("charge.jwl.b", between(-5e10, 0), "unreacted explosives are fitted with -4 to -7 GPa"),
      in("charge.jwl.r1", between(6, 20), "unreacted explosives are fitted with 10 to 14"),
      in("charge.jwl.r2", between(0.5, 3), "unreacted explosives are fitted with a tenth of R1"),
      in("charge.jwl.omega", between(0.3, 1.5), "it is the Grueneisen coefficient of an organic solid"),
      in("charge.tension_cutoff", between(1e5, 5e7), "explosives tear at 1 to 10 MPa"),
      in("charge.specific_heat", between(900, 2.2e3),
         "explosives have 1.0 to 1.4 kJ/(kg K), the published model 1.78"),
      in("charge.conductivity", between(0.05, 1), "explosives have 0.1 to 0.5 W/(m K)"),
      in("charge.sliding_friction", between(0.1, 0.8),
         "solids rub with 0.1 to 0.8, and 0 would leave this heat out"),
      any("kinetics.set", "the numbers that it stands for are judged"),
      in("kinetics.heat_of_reaction", between(1e6, 1e7), "explosives release 2 to 7 MJ/kg"),
      in("kinetics.frequency", between(1e10, 1e24), "explosives are fitted with 1e11 to 1e20 1/s"),
      in("kinetics.activation_temperature", between(1.2e4, 3.2e4),
         "explosives are fitted with 25 to 60 kcal/mol"),
      in("kinetics.ignition_temperature", between(480, 560),
         "Composition B explodes within seconds at 551 K, and published launches ask for 515 to 528 K"),
      in("kinetics.burnt_temperature", between(600, 3.5e3),
         "it lies between the ignition and the flame of an explosive"),
  };
}

Keys of_gap() {
  return {
      any("gap.thickness", "each gap is judged for itself, and a larger one is hotter"),
      any("gap.pressure", "both are readings of the published model"),
      any("gap.air", "both are models of the air; constants are calibrated for one of them"),
      one_of("gap.exchange", {"rate"}, "the printed share in each step depends on the step"),
      in("gap.skin_thickness", between(3e-5, 1.5e-4),
         "heat goes 40 um deep in a launch, and the published skin is 0.1 mm"),
      in("gap.exchange_time", between(1.5e-4, 6e-4),
         "published temperatures ask for 0.3 ms, whatever mesh and closure"),
      in("gap.air_density", between(0.6, 1.7), "air has 1.2 kg/m3 at the ground"),
      in("gap.air_specific_heat", between(950, 1.2e3), "air has 1.00 kJ/(kg K), at 1000 K 1.14"),
      in("gap.air_heat_ratio", between(1.3, 1.42), "air has 1.40, at 2000 K 1.30"),
      in("gap.air_temperature", between(219, 345), "shells are stored and fired from -54 to 71 degC"),
      in("gap.air_pressure", between(5e4, 1.2e5),
         "it lies between those at 5500 m of altitude and at the ground"),
      one_of("friction.closure", {"literal", "inelastic"},
             "without friction heat the published temperatures are missed by 80 K"),
      in("friction.localisation", between(250, 2.5e3),
         "published temperatures ask for 800 to 1150, whatever mesh and closure"),
  };
}

Keys of_computation() {
  return {
      in("numerics.cell_size", between(1e-4, 1e-2),
         "shells are some cells thick, and cells hold many grains"),
      any("numerics.formulation", "constants are calibrated for one of them"),
      in("numerics.growth_x", between(1, 1.5), "cells that grow faster were never compared with a reference"),
      in("numerics.growth_r", between(1, 1.5), "cells that grow faster were never compared with a reference"),
      in("numerics.largest_cell", between(1e-4, 2e-2), "shells are some cells thick"),
      any("numerics.refined_x", "they only say where cells are small"),
      any("numerics.refined_r", "they only say where cells are small"),
      in("numerics.hourglass_stiffness", between(0.03, 1),
         "without it neighbours alternate, and more than the shear stiffness holds bending back"),
      in("numerics.steel_inertia", between(1, 10), "larger ones were never compared with a reference"),
      in("numerics.particles_per_cell", between(1, 4), "more were never compared with a reference"),
      in("numerics.time_step_factor", between(0.01, 0.68),
         "steps are proved stable up to 0.68, updated-Lagrangian ones to 0.57"),
      in("numerics.inertial_scaling", between(1, 100), "larger ones moved temperatures by tens of kelvin"),
      zero_or_in("numerics.damping_time", between(1e-3, 1),
                 "a faster one takes out motion that the load makes"),
      in("numerics.pic_fraction", between(0, 0.02), "a larger share takes out motion as damping does"),
      in("numerics.energy_drift_limit", between(1e-4, 0.1),
         "a run that invents or loses a tenth of its energy is broken"),
      in("output.trace_interval", between(1e-8, 5e-4), "the load changes within a millisecond"),
      any("output.snapshots", "they change nothing"),
      any("physics.conduction", "only \"off\" where the plan has it in is in doubt"),
      any("physics.bulk_reaction", "only \"off\" where the plan has it in is in doubt"),
      in("physics.conduction_bound", between(0, 0.5),
         "heat that reaches the next cell is not to be left out"),
      in("physics.reaction_bound", between(0, 1), "self-heating by a kelvin is not to be left out"),
  };
}

Keys of_geometry() {
  return {
      any("body.name", "it is for people"),
      any("body.material", "both are what shells are made of"),
      in("body.x", between(5e-4, 2), "parts of shells are half a millimetre to two metres long"),
      in("body.r", between(5e-4, 0.25),
         "naval guns had calibres up to 46 cm, and walls are millimetres thick"),
      any("observation_point.name", "it is for people"),
      any("observation_point.x", "it has to lie at the charge's bottom"),
      any("observation_point.r", "it has to lie at the charge's bottom"),
  };
}

Keys all_keys() {
  Keys keys;
  for (Keys part : {of_scene_and_load(), of_steel(), of_cracks(), of_charge_and_kinetics(), of_gap(),
                    of_computation(), of_geometry()})
    std::move(part.begin(), part.end(), std::back_inserter(keys));
  return keys;
}

}  // namespace

Plausible plausible_values_of(std::string_view key) {
  static const Keys keys = all_keys();
  const auto found =
      std::find_if(keys.begin(), keys.end(), [key](const PlausibleKey& each) { return each.key == key; });
  return found == keys.end() ? Plausible{} : found->values;
}

}  // namespace launchsafe::scene
