// The keys of the charge's bottom.
#include "launchsafe/scene/read_scene.hpp"

namespace launchsafe::scene {
namespace {

std::vector<Key<Surface>> gap_keys() {
  return {
      list_key("thickness", Dimension::length, between(0, 0.01), Standing::paper,
               "Gaps between charge and base; all are judged on one run of the mechanics.", &Surface::gaps),
      number_key("skin_thickness", Dimension::length, above_to(0, 0.01), Standing::paper,
                 "Thickness of the charge's skin that the air heats.", &Surface::skin_thickness),
      number_key("exchange_time", Dimension::time, above_to(0, 1), Standing::calibrated,
                 "Time constant of the exchange between air and skin.", &Surface::exchange_time),
  };
}

std::vector<Key<materials::AirParameters>> air_keys() {
  using materials::AirParameters;
  return {
      number_key("specific_heat", Dimension::specific_heat, between(950, 1.2e3), Standing::literature,
                 "Specific heat of the air.", &AirParameters::specific_heat),
      number_key("heat_ratio", Dimension::number, between(1.3, 1.42), Standing::paper,
                 "Adiabatic exponent of the air.", &AirParameters::heat_ratio),
      number_key("pressure", Dimension::pressure, between(80e3, 150e3), Standing::assumed,
                 "Pressure of the air before launch; its density follows by the gas law.",
                 &AirParameters::initial_pressure) |
          then([](AirParameters& air) {
            air.density = materials::air_density(air.initial_temperature, air.initial_pressure);
          }) |
          acting_on(ActsOn::trace),
  };
}

std::vector<Key<Surface>> friction_keys() {
  std::vector<std::pair<std::string, FrictionClosure>> words;
  for (const auto closure : {FrictionClosure::total_strain_rate, FrictionClosure::none})
    words.emplace_back(word_of(closure), closure);
  return {
      word_key("closure", Standing::assumed,
               "Strain rate that the sliding friction acts on: the total one, or none.", words,
               &Surface::friction) |
          acting_on(ActsOn::heat),
      number_key("localisation", Dimension::number, between(0, 1e6), Standing::calibrated,
                 "Crack spacing over the thickness of the sliding layer: factor on the friction heat.",
                 &Surface::localisation) |
          acting_on(ActsOn::surface),
  };
}

std::vector<Key<Surface>> station_keys() {
  return {
      number_key("width", Dimension::length, between(1e-3, 0.03), Standing::assumed,
                 "Width of the stations that tile the charge's bottom, rounded so that a whole "
                 "number of them does; skin temperatures and verdicts are theirs.",
                 &Surface::station_width),
      number_key("depth", Dimension::length, between(1e-3, 0.03), Standing::assumed,
                 "Depth from the bottom over which stations average pressure and strain.",
                 &Surface::station_depth),
  };
}

}  // namespace

std::vector<Key<Scene>> surface_keys() {
  using keys::keys_of_part;
  return keys::joined({keys_of_part("gap.", &Scene::surface, acting_on(ActsOn::surface, gap_keys())),
                       keys_of_part<Scene>(
                           "gap.air_", [](auto& scene) -> auto& { return scene.surface.air; },
                           acting_on(ActsOn::surface, air_keys())),
                       keys_of_part("friction.", &Scene::surface, friction_keys()),
                       keys_of_part("station.", &Scene::surface, station_keys())});
}

}  // namespace launchsafe::scene
