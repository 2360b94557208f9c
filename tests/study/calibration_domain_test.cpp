#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/scene/toml_reader.hpp"
#include "launchsafe/study/constants_of_study.hpp"
#include "launchsafe/study/record_domain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace {

using namespace launchsafe;
using namespace launchsafe::study;

scene::Scene shipped_scene() {
  return scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").value().scene;
}

RecordDistance distance_of(const scene::Scene& scene,
                           const scene::Scene& calibrated = shipped_calibration().scene) {
  return distance_to_record(RecordKind::calibration, scene, calibrated);
}

TEST(CalibrationDomain, IsTheShippedScene) {
  const scene::Scene calibrated = shipped_calibration().scene, shipped = shipped_scene();
  EXPECT_TRUE(distance_of(shipped).inside());
  for (const auto& key : scene::scene_keys()) {
    if (key.name == "title" || key.name == "gap.thickness") continue;
    EXPECT_EQ(scene::format_value(key, key.get(calibrated)), scene::format_value(key, key.get(shipped)))
        << key.name;
  }
}

scene::Interface& interface_of(scene::Scene& scene, const std::string& body) {
  return *std::find_if(scene.interfaces.begin(), scene.interfaces.end(),
                       [&](const scene::Interface& each) { return each.body == body; });
}

/// Names are the user's: a nose that is called base slides as the nose does.
TEST(CalibrationDomain, WhatFollowsIgnitionIsNoPartOfIt) {
  scene::Scene scene = scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").value().scene;
  scene.coupling = scene::Coupling::two_way;
  scene.combustion = {2e-3, 1e9};
  EXPECT_TRUE(distance_of(scene).inside());
}

std::vector<std::string> foreign_in(const scene::Scene& scene) {
  std::vector<std::string> keys;
  for (const auto& each : distance_of(scene).foreign) keys.push_back(each.key);
  return keys;
}

using Keys = std::vector<std::string>;

/// One constant is told by its key; several are a property, whose value changes with each of them. What the
/// constants are decides, and no name does.
TEST(CalibrationDomain, SeveralConstantsOfMaterialsAreOneProperty) {
  scene::Scene scene = shipped_calibration().scene;
  scene.material<scene::Charge>().title = "PBX 9501";
  EXPECT_EQ(foreign_in(scene), Keys{});
  scene.charge().density = 1832;
  EXPECT_EQ(foreign_in(scene), Keys{"charge.density"});
  scene.charge().kinetics.frequency = 5e19;
  scene.charge().kinetics.ignition_temperature = 700.0;
  EXPECT_EQ(foreign_in(scene), (Keys{"kinetics.ignition_temperature", "calibration.material"}));
  const auto value = [&] { return distance_of(scene).foreign.back().value; };
  const std::string before = value();
  scene.charge().kinetics.frequency = 6e19;
  EXPECT_NE(value(), before);
}

/// Issue 31, point 6: bodies of a second steel, under whatever name, and steels that change places.
TEST(CalibrationDomain, AllMaterialsOfAllBodiesCount) {
  scene::Scene scene = shipped_calibration().scene;
  scene.materials.push_back({"second", scene.steel()});
  scene.bodies.back().material = "second";
  EXPECT_EQ(foreign_in(scene), Keys{}) << "another name is no other steel";
  std::get<scene::Steel>(scene.materials.back().law).strength.a *= 1.5;
  EXPECT_EQ(foreign_in(scene), Keys{"material.second.yield_stress"});
  EXPECT_TRUE(distance_of(scene, scene).inside());
  scene::Scene exchanged = scene;
  std::swap(exchanged.bodies.front().material, exchanged.bodies.back().material);
  EXPECT_FALSE(distance_of(exchanged, scene).inside());
}

TEST(CalibrationDomain, ComparesInterfacesByTheBodiesThatTheyName) {
  scene::Scene renamed = shipped_scene();
  const auto rename = [&renamed](const std::string& from, const std::string& to) {
    for (scene::Body& each : renamed.bodies)
      if (each.name == from) each.name = to;
  };
  rename("nose", "x");
  rename("wall", "nose");
  rename("x", "wall");
  EXPECT_FALSE(distance_of(renamed).inside());
  std::swap(interface_of(renamed, "nose").friction, interface_of(renamed, "wall").friction);
  EXPECT_TRUE(distance_of(renamed).inside());
}

struct Change {
  const char* name;
  std::function<void(scene::Scene&)> change;
  const char* unknown;  ///< what nothing carries over; empty: a rule does
  const char* carried;  ///< likewise; empty: nothing
};

TEST(CalibrationDomain, NamesWhatLiesOutside) {
  const std::vector<Change> changes{
      {"gaps are judged row by row", [](auto& s) { s.surface.gaps = {1e-3}; }, "", ""},
      {"smaller steps", [](auto& s) { s.numerics.time_step_factor = 0.25; }, "", ""},
      {"pressure", [](auto& s) { s.load.peak = 550e6; }, "", "peak pressure"},
      {"cracks", [](auto& s) { s.charge().strength.initial_crack_radius = 1e-4; }, "", "crack radius"},
      {"cold", [](auto& s) { s.initial_temperature = 250.0; }, "", "initial temperature"},
      {"a measured curve",
       [](auto& s) {
         s.load.curve_time = {0.0, 9e-3, 18e-3};
         s.load.curve_pressure = {0.0, 496e6, 1e8};
       },
       "", "load shape"},
      {"mesh", [](auto& s) { s.numerics.cell_size = 5e-3; }, "", "numerics"},
      {"another calibre", [](auto& s) { s.bodies[2].r_end = s.bodies[0].r_end = s.bodies[3].r_end = 0.06; },
       "calibration.shell", ""},
      {"wider stations", [](auto& s) { s.surface.station_width = 10e-3; }, "station.width", ""},
      {"steel", [](auto& s) { s.steel().strength.a = 1e9; }, "steel.yield_stress", ""},
      {"closure", [](auto& s) { s.surface.friction = scene::FrictionClosure::none; }, "friction.closure", ""},
      {"a wall with friction", [](auto& s) { interface_of(s, "wall").friction = 0.1; },
       "calibration.interfaces", ""},
      {"barrel", [](auto& s) { s.barrel = scene::Barrel::none; }, "barrel", ""},
      {"less friction heat", [](auto& s) { s.surface.localisation = 400.0; }, "friction.localisation", ""},
      {"more friction heat", [](auto& s) { s.surface.localisation = 1700.0; }, "", "friction.localisation"},
      {"slower exchange", [](auto& s) { s.surface.exchange_time = 1e-3; }, "gap.exchange_time", ""},
      {"later ignition", [](auto& s) { s.charge().kinetics.ignition_temperature = 528.0; },
       "kinetics.ignition_temperature", ""},
      {"earlier ignition", [](auto& s) { s.charge().kinetics.ignition_temperature = 500.0; }, "",
       "kinetics.ignition_temperature"},
  };
  for (const Change& each : changes) {
    scene::Scene scene = shipped_scene();
    each.change(scene);
    const RecordDistance distance = distance_of(scene);
    const auto said = [](const std::vector<std::string>& names) {
      return names.empty() ? "" : names.front();
    };
    EXPECT_EQ(said(foreign_in(scene)), each.unknown) << each.name;
    EXPECT_EQ(said(distance.carried), each.carried) << each.name;
  }
}

}  // namespace
