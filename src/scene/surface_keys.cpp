// The keys of the charge's bottom.
#include "launchsafe/scene/read_scene.hpp"

namespace launchsafe::scene {
namespace {

bool is_closing(const Surface& surface) { return surface.model == GapModel::closing; }

/// How finely a closing gap is resolved; written where that is not as usual, for the sake of what is stored.
std::vector<Key<Surface>> resolution_keys() {
  std::vector<Key<Surface>> keys{
      number_key("air_cells", Dimension::count, between(4, 1024), Standing::assumed,
                 "Cells in which a closing gap resolves its air.", &Surface::air_cells) |
          plausibly(between(16, 256), "coarser ones were never compared with finer ones"),
      number_key("depth_cells", Dimension::count, between(5, 1024), Standing::assumed,
                 "Cells in which a closing gap resolves the depth of the charge that heat reaches; "
                 "that of the base has three fifths of them.",
                 &Surface::depth_cells) |
          plausibly(between(20, 320), "coarser ones were never compared with finer ones"),
      number_key("turns", Dimension::number, between(0.1, 100), Standing::assumed,
                 "How many times as often as usual motion and heat of a closing gap take turns.",
                 &Surface::turns) |
          plausibly(between(0.5, 16), "rarer ones were never compared with more frequent ones"),
  };
  for (Key<Surface>& key : keys) {
    const auto is_usual = [get = key.get](const Surface& each) { return get(each) == get(Surface{}); };
    written_where([is_usual](const Surface& each) { return is_closing(each) && !is_usual(each); })(key);
  }
  return keys::in_role(refined_setting, std::move(keys));
}

/// Written where the gap closes alone, so that what was stored before there was such a gap stays what it is.
std::vector<Key<Surface>> closing_keys() {
  const Role of_motion{ActsOn::mechanics, Part::constant};
  std::vector<Key<Surface>> keys{
      word_key("model", Standing::assumed,
               "As published, with air that stays on its adiabat and a charge that rests; or a gap that "
               "closes: the charge flies across it, compresses its air and meets the base.",
               {{"reservoir", GapModel::reservoir}, {"closing", GapModel::closing}}, &Surface::model) |
          always_plausible("both are models of the gap; constants are calibrated for the reservoir",
                           of_motion),
      number_key("roughness", Dimension::length, above_to(0, 1e-3), Standing::assumed,
                 "Least opening of a closing gap, at which the faces meet; a gap no wider is none.",
                 &Surface::roughness) |
          plausibly(between(1e-6, 3e-5), "pressed and machined faces have 1 to 30 µm", of_motion),
      word_key("base", Standing::assumed,
               "Whether the base takes heat from the air of a closing gap: the two bounds.",
               {{"conducting", GapBase::conducting}, {"insulated", GapBase::insulated}}, &Surface::base) |
          always_plausible("both are bounds of the same gap", of_motion),
      number_key("release", Dimension::time, between(0, 1), Standing::assumed,
                 "Until when nose and wall hold the charge where they slide, over a gap that closes or none; "
                 "then they let go. 0: it is free from the start.",
                 &Surface::release) |
          always_plausible("when a charge lets go is not known, and the worst instant has to be looked for",
                           of_motion),
  };
  for (Key<Surface>& key : keys) written_where(is_closing)(key);
  // Came later than stored launches that have neither.
  keys.push_back(flag_key("melts", Standing::assumed,
                          "The charge over a closing gap melts as heat reaches it, which takes heat; for "
                          "comparison: its constants were calibrated without, and no verdict rests on it.",
                          &Surface::melts) |
                 always_plausible("no verdict rests on it", of_motion) |
                 written_where([](const Surface& surface) { return is_closing(surface) && surface.melts; }));
  keys.push_back(
      word_key("air_flow", Standing::assumed,
               "Whether the air of a closing gap stays at its radius, or flows freely so that it has one "
               "pressure over the bottom: the two bounds.",
               {{"trapped", AirFlow::trapped}, {"common-pressure", AirFlow::common_pressure}},
               &Surface::air_flow) |
      always_plausible("both are bounds of the same gap", of_motion) |
      written_where([](const Surface& surface) {
        return is_closing(surface) && surface.air_flow != AirFlow::trapped;
      }));
  keys.push_back(
      optional_number_key<Surface>(
          "release_duration", Dimension::time, between(0, 0.1),
          "From gap.release on, over which what nose and wall bear falls to nothing; where it is not said, "
          "the time that sound takes through the charge. 0: all of it lets go at once, and rings most.",
          &Surface::release_duration) |
      always_plausible(
          "how fast a hold breaks is not known, and no break runs through the charge faster than sound",
          of_motion));
  return keys;
}

/// Each takes the other one back: the gap is stated, or follows.
std::vector<Key<Surface>> thickness_keys() {
  const Role of_gap{ActsOn::surface, Part::free};
  Key<Surface> thickness =
      list_key("thickness", Dimension::length, between(0, 0.02), Standing::paper,
               "Gaps between charge and base; all are judged on one run of the mechanics.", &Surface::gaps) |
      always_plausible("each gap is judged for itself, and a larger one is hotter", of_gap);
  thickness.overrides = {"opens_by_cooling"};
  thickness.is_written = [](const Surface& surface) { return !surface.opens_by_cooling; };
  Key<Surface> cooling =
      optional_number_key<Surface>(
          "opens_by_cooling", Dimension::temperature, between(200, 500),
          "Temperature at which charge and shell fitted without a gap; instead of gap.thickness, the gap is "
          "what the charge, held at the nose, has shrunk away from the base at initial_temperature.",
          &Surface::opens_by_cooling) |
      plausibly(between(270, 400), "charges are cast or cured at 330 to 400 K and settle as they cool",
                of_gap);
  cooling.overrides = {"thickness"};
  return {thickness, cooling};
}

std::vector<Key<Surface>> gap_keys() {
  return {
      word_key("pressure", Standing::assumed,
               "What compresses the air: the charge's bottom stress or the chamber.",
               {{"charge-bottom", AirPressure::charge_bottom}, {"chamber", AirPressure::chamber}},
               &Surface::air_pressure) |
          always_plausible("both are readings of the published model", of_skin_model),
      word_key("air", Standing::paper,
               "Air that stays on its adiabat, or a film that conducts into charge and base and gives what "
               "compression supplies alone; in the film no exchange, skin or air density counts.",
               {{"reservoir", AirModel::reservoir}, {"film", AirModel::film}}, &Surface::air_model) |
          always_plausible("both are models of the air; constants are calibrated for one of them",
                           of_skin_model),
      word_key("exchange", Standing::derived,
               "Heat exchange as a rate, or the printed share in each time step, which depends on it.",
               {{"rate", Exchange::rate}, {"per-step", Exchange::per_step}}, &Surface::exchange) |
          plausibly(std::vector<std::string>{"rate"}, "the printed share in each step depends on the step",
                    of_skin_model),
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

void take_density_from_gas_law(materials::AirParameters& air) {
  air.density = materials::air_density(air.initial_temperature, air.initial_pressure);
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
      number_key("temperature", Dimension::temperature, between(200, 500), Standing::paper,
                 "Temperature of the air before launch; follows initial_temperature unless given.",
                 &AirParameters::initial_temperature) |
          then(take_density_from_gas_law) |
          plausibly(between(219, 345), "shells are stored and fired from -54 to 71 degC",
                    Role{ActsOn::surface, Part::range}),
      number_key("pressure", Dimension::pressure, above_to(0, 10e6), Standing::assumed,
                 "Pressure of the air before launch.", &AirParameters::initial_pressure) |
          then(take_density_from_gas_law) |
          plausibly(between(1e5, 1.2e5), "shells are closed near the ground, and thinner air heats less",
                    Role{ActsOn::trace, Part::range}),
      // After what it follows from, so that one that is given stays.
      number_key("density", Dimension::density, between(0.01, 100), Standing::literature,
                 "Density of the air before launch; follows from its temperature and pressure by the "
                 "gas law unless given.",
                 &AirParameters::density) |
          plausibly(between(0.6, 1.7), "air has 1.2 kg/m3 at the ground", Role{ActsOn::surface, Part::range}),
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
               "Which strain rate the sliding friction acts on: total, inelastic or none. "
               "Files may still say \"literal\" for the total strain rate.",
               words, &Surface::friction) |
          formerly({"literal", "total strain rate"}) |
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
  return keys::joined({keys_of_part("gap.", &Scene::surface, thickness_keys()),
                       keys_of_part("gap.", &Scene::surface, in_role({ActsOn::surface}, gap_keys())),
                       keys_of_part("gap.", &Scene::surface, closing_keys()),
                       keys_of_part("gap.", &Scene::surface, resolution_keys()),
                       keys_of_part<Scene>(
                           "gap.air_", [](auto& scene) -> auto& { return scene.surface.air; },
                           in_role({ActsOn::surface}, air_keys())),
                       keys_of_part("friction.", &Scene::surface, friction_keys()),
                       keys_of_part("station.", &Scene::surface, in_role(of_model, station_keys()))});
}

}  // namespace launchsafe::scene
