#include "launchsafe/scene/constants.hpp"

#include "launchsafe/materials/laws.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace {

using namespace launchsafe;
using namespace launchsafe::scene;

const Constants& shipped() { return *shipped_constants().front(); }

/// Constants that differ from the shipped ones in every kind of value.
Constants other_constants() {
  Constants other = shipped();
  other.values["friction.localisation"] = 777.0;
  other.values["steel.yield_stress"] = 650e6;
  other.values["interface.bottom.condition"] = std::string("sliding");
  other.values["interface.bottom.friction"] = 0.02;
  other.fitted_keys = {"friction.localisation", "interface.side.friction"};
  other.covariance = {1e-4, 1e-5, 1e-5, 4e-4};
  other.range = {{"peak_pressure", "400 to 550 MPa"}};
  other.rows = {{"T at 18 ms", 1e-4, 442.2, 442.25, "K", true},
                {"ignition time", 4e-4, 17.7, 17.69, "ms", false}};
  return other;
}

const std::string bodies = R"(
title = "a shell"
body = [
  { name = "front plate", material = "steel",  x = "0 to 1 cm", r = "0 to 2 cm" },
  { name = "charge",      material = "charge", x = "1 to 4 cm", r = "0 to 1.5 cm" },
  { name = "tube",        material = "steel",  x = "1 to 4 cm", r = "1.5 to 2 cm" },
  { name = "rear plate",  material = "steel",  x = "4 to 5 cm", r = "0 to 2 cm" },
]
)";

Scene scene_of(const std::string& text) {
  const auto read = parse_scene(text, "scene.toml");
  return read.scene;
}

Scene with_other(const std::string& text) {
  const auto read = parse_scene(text, "scene.toml");
  return with_constants(read, std::make_shared<Constants>(other_constants())).scene;
}

const Interface* held(const Scene& scene, const std::string& body) {
  const auto found = std::ranges::find(scene.interfaces, body, &Interface::body);
  return found == scene.interfaces.end() ? nullptr : &*found;
}

TEST(Constants, TheShippedOnesAreThoseOfTheProgramsDefaults) {
  const Scene defaults;
  for (const auto& [name, value] : shipped().values) {
    const auto* key = find_key(scene_keys(), name);
    if (key == nullptr || name == "steel.yield_stress") continue;  // the steel is the published one
    EXPECT_TRUE(same_value(key->get(defaults), value, 1e-5)) << name;
  }
}

TEST(Constants, ReadBackWhatWasWritten) {
  const Constants other = other_constants();
  const auto read = parse_constants(to_toml(other), "other.toml");
  EXPECT_EQ(read.values, other.values);
  EXPECT_EQ(read.fitted_keys, other.fitted_keys);
  EXPECT_EQ(read.covariance, other.covariance);
  EXPECT_EQ(read.range, other.range);
  ASSERT_EQ(read.rows.size(), 2u);
  EXPECT_DOUBLE_EQ(read.rows[0].misfit(), other.rows[0].misfit());
  EXPECT_TRUE(read.rows[0].is_fitted);
  EXPECT_FALSE(read.rows[1].is_fitted);
  EXPECT_EQ(to_toml(read.scene), to_toml(other.scene));
}

TEST(Constants, FillEveryKeyThatASceneDoesNotState) {
  const Scene scene = with_other(bodies);
  EXPECT_EQ(scene.surface.localisation, 777.0);
  EXPECT_EQ(scene.steel().strength.a, 650e6);
  ASSERT_NE(held(scene, "rear plate"), nullptr);
  EXPECT_EQ(held(scene, "rear plate")->friction, 0.02);
  ASSERT_NE(held(scene, "tube"), nullptr);
  EXPECT_EQ(held(scene, "tube")->condition, Condition::sliding);
}

TEST(Constants, LeaveWhatASceneStates) {
  const Scene scene = with_other(bodies +
                                 "friction.localisation = 100\nsteel.yield_stress = \"1 GPa\"\n"
                                 "interface.tube.condition = \"bonded\"\n");
  EXPECT_EQ(scene.surface.localisation, 100.0);
  EXPECT_EQ(scene.steel().strength.a, 1e9);
  EXPECT_FALSE(can_slide(*held(scene, "tube")));
}

TEST(Constants, LeaveASteelThatABodyNames) {
  std::string text = bodies;
  for (std::size_t at = 0; (at = text.find("\"steel\"", at)) != std::string::npos; at += 5)
    text.replace(at, 7, "\"shell-steel\"");
  EXPECT_EQ(with_other(text).steel().strength.a, 792e6);
}

TEST(Constants, NoneLeavesTheProgramsDefaultsAndBondedFaces) {
  const Scene scene = scene_of("constants = \"none\"\n" + bodies);
  EXPECT_TRUE(scene.interfaces.empty());
}

TEST(Constants, HoldNothingInTheFormWithOneVelocityAPlace) {
  const Scene scene = with_other(bodies + "numerics.formulation = \"updated-lagrangian\"\n");
  EXPECT_TRUE(scene.interfaces.empty());
}

TEST(Constants, AFaceIsThatOfTheBodyThatBearsOnIt) {
  const Scene scene = scene_of(bodies);
  EXPECT_EQ(key_in_scene(scene, "interface.side.friction"), "interface.tube.friction");
  EXPECT_EQ(key_in_scene(scene, "interface.bottom.condition"), "interface.rear plate.condition");
  EXPECT_EQ(key_in_scene(scene, "gap.exchange_time"), "gap.exchange_time");
}

TEST(Constants, FaultsNameFileAndKey) {
  const auto scene = caught([&] { return parse_scene("constants = \"155m\"\n" + bodies, "scene.toml"); });
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().key, "constants");
  EXPECT_EQ(scene.error().line, 1);
  EXPECT_EQ(scene.error().suggestion, "\"155mm\"");
  std::string text = to_toml(shipped());
  const std::string version = fmt::format("model_version = {}", model_version);
  text.replace(text.find(version), version.size(), "model_version = 1");
  const auto constants = caught([&] { return parse_constants(text, "old.toml"); });
  ASSERT_FALSE(constants);
  EXPECT_EQ(constants.error().key, "model_version");
  EXPECT_EQ(constants.error().file, "old.toml");
}

}  // namespace
