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
using PlausibleKeys = std::vector<PlausibleKey>;

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

PlausibleKeys of_scene_and_load() {
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

PlausibleKeys of_station() {
  return {
      in("station.width", between(2e-3, 0.01),
         "published points are 5 mm apart, a wider station hides a hot place, and beside the wall the stress "
         "of "
         "a narrower one grows without bound"),
      in("station.depth", between(2e-3, 0.01),
         "a deeper station averages what is not near the bottom, and beside the wall the stress of a "
         "shallower "
         "one grows without bound"),
  };
}

PlausibleKeys of_gap() {
  return {
      any("gap.thickness", "each gap is judged for itself, and a larger one is hotter"),
      any("gap.pressure", "both are readings of the published model"),
      any("gap.air", "all are models of the air; constants are calibrated for one of them"),
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
         "published temperatures ask for 1100 to 2000, however the shell holds the charge"),
  };
}

PlausibleKeys of_computation() {
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

PlausibleKeys of_geometry() {
  return {
      any("body.name", "it is for people"),
      any("body.material", "the constants of each are judged"),
      in("body.x", between(5e-4, 2), "parts of shells are half a millimetre to two metres long"),
      in("body.r", between(5e-4, 0.25),
         "naval guns had calibres up to 46 cm, and walls are millimetres thick"),
      any("observation_point.name", "it is for people"),
      any("observation_point.x", "it has to lie at the charge's bottom"),
      any("observation_point.r", "it has to lie at the charge's bottom"),
  };
}

PlausibleKeys all_keys() {
  PlausibleKeys keys;
  for (PlausibleKeys part : {of_scene_and_load(), of_gap(), of_station(), of_computation(), of_geometry()})
    std::move(part.begin(), part.end(), std::back_inserter(keys));
  return keys;
}

}  // namespace

Plausible plausible_values_of(std::string_view key) {
  static const PlausibleKeys keys = all_keys();
  const auto found =
      std::find_if(keys.begin(), keys.end(), [key](const PlausibleKey& each) { return each.key == key; });
  return found == keys.end() ? Plausible{} : found->values;
}

}  // namespace launchsafe::scene
