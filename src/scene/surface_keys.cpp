// The keys of the charge's bottom.
#include "launchsafe/scene/read_scene.hpp"

namespace launchsafe::scene {
namespace {

std::vector<Key<Surface>> gap_keys() {
  return {
      list_key("thickness", Dimension::length, between(0, 0.01), Standing::paper,
               "Gaps between charge and base; all are judged on one run of the mechanics.", &Surface::gaps) |
          always_plausible("each gap is judged for itself, and a larger one is hotter",
                           Role{ActsOn::surface, Part::free}),
      number_key("skin_thickness", Dimension::length, above_to(0, 0.01), Standing::paper,
                 "Thickness of the charge's skin that the air heats.", &Surface::skin_thickness) |
          plausibly(between(3e-5, 1.5e-4),
                    "heat goes 40 µm deep in a launch, and the published skin is 0.1 mm"),
      number_key("exchange_time", Dimension::time, above_to(0, 100), Standing::calibrated,
                 "Time constant of the exchange between air and skin.", &Surface::exchange_time) |
          plausibly(between(1.5e-4, 6e-4), "published temperatures ask for 0.3 ms, whatever mesh and closure",
                    Role{ActsOn::surface, Part::calibrated, Hotter::below}),
  };
}

std::vector<Key<materials::AirParameters>> air_keys() {
  using materials::AirParameters;
  return {
      number_key("specific_heat", Dimension::specific_heat, between(100, 1e4), Standing::literature,
                 "Specific heat of the air.", &AirParameters::specific_heat) |
          plausibly(between(950, 1.2e3), "air has 1.00 kJ/(kg K), at 1000 K 1.14"),
      number_key("heat_ratio", Dimension::number, above_to(1, 1.67), Standing::paper,
                 "Adiabatic exponent of the air.", &AirParameters::heat_ratio) |
          plausibly(between(1.3, 1.42), "air has 1.40, at 2000 K 1.30"),
      number_key("pressure", Dimension::pressure, above_to(0, 10e6), Standing::assumed,
                 "Pressure of the air before launch; its density follows by the gas law.",
                 &AirParameters::initial_pressure) |
          then([](AirParameters& air) {
            air.density = materials::air_density(air.initial_temperature, air.initial_pressure);
          }) |
          plausibly(between(1e5, 1.2e5), "shells are closed near the ground, and thinner air heats less",
                    Role{ActsOn::trace, Part::range}),
  };
}

std::vector<Key<Surface>> friction_keys() {
  std::vector<std::pair<std::string, FrictionClosure>> words;
  std::vector<std::string> plausible;
  for (const FrictionClosure closure : materials::all_closures) {
    words.emplace_back(word_of(closure), closure);
    if (closure != FrictionClosure::none) plausible.emplace_back(word_of(closure));
  }
  return {
      word_key("closure", Standing::assumed,
               "Strain rate that the sliding friction acts on: the total one, or none.", words,
               &Surface::friction) |
          plausibly(plausible, "without friction heat the published temperatures are missed by 80 K",
                    Role{ActsOn::heat, Part::model}),
      number_key("localisation", Dimension::number, between(0, 1e6), Standing::calibrated,
                 "Crack spacing over the thickness of the sliding layer: factor on the friction heat.",
                 &Surface::localisation) |
          plausibly(between(250, 2.5e3),
                    "published temperatures ask for 1100 to 2000, however the shell holds the charge",
                    Role{ActsOn::surface, Part::calibrated, Hotter::above}),
  };
}

std::vector<Key<Surface>> station_keys() {
  return {
      number_key("width", Dimension::length, above_to(0, 1), Standing::assumed,
                 "Width of the stations that tile the charge's bottom, rounded so that a whole "
                 "number of them does; skin temperatures and verdicts are theirs.",
                 &Surface::station_width) |
          plausibly(
              between(2e-3, 0.01),
              "published points are 5 mm apart, a wider station hides a hot place, and beside the wall the "
              "stress of a narrower one grows without bound"),
      number_key("depth", Dimension::length, above_to(0, 1), Standing::assumed,
                 "Depth from the bottom over which stations average pressure and strain.",
                 &Surface::station_depth) |
          plausibly(
              between(2e-3, 0.01),
              "a deeper station averages what is not near the bottom, and beside the wall the stress of a "
              "shallower one grows without bound"),
  };
}

}  // namespace

std::vector<Key<Scene>> surface_keys() {
  using keys::in_role, keys::keys_of_part;
  return keys::joined({keys_of_part("gap.", &Scene::surface, in_role({ActsOn::surface}, gap_keys())),
                       keys_of_part<Scene>(
                           "gap.air_", [](auto& scene) -> auto& { return scene.surface.air; },
                           in_role({ActsOn::surface}, air_keys())),
                       keys_of_part("friction.", &Scene::surface, friction_keys()),
                       keys_of_part("station.", &Scene::surface, in_role(of_model, station_keys()))});
}

}  // namespace launchsafe::scene
