#include "launchsafe/scene/read_scene.hpp"
#include "scene/scene_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace launchsafe::scene {
namespace {

SceneFile small_file() {
  auto file = parse_scene(small_scene, "shell.toml");
  return file;
}

TEST(SceneKeys, EveryKeyIsDocumentedOnce) {
  std::set<std::string> names;
  for (const DocumentedKey& key : describe_keys()) {
    EXPECT_TRUE(names.insert(key.description.name).second) << key.description.name;
    EXPECT_TRUE(key.description.sentence.ends_with('.')) << key.description.name;
    EXPECT_FALSE(allowed_text(key.description).empty()) << key.description.name;
  }
  EXPECT_TRUE(names.contains("charge.crack_radius"));
  EXPECT_TRUE(names.contains("body.x"));
}

TEST(SceneKeys, EveryDefaultIsAllowedAndReadsBack) {
  for (const Key<Scene>& key : scene_keys()) {
    if (key.standing == Standing::input) continue;  // only the user can say it
    const std::string line = "value = " + exact_toml(key, key.default_value());
    const auto table = parse_toml(line, "defaults.toml");
    const auto value = read_value(*table.get("value"), key, "defaults.toml");
    EXPECT_EQ(value, key.default_value()) << key.name;
  }
}

TEST(SceneKeys, EveryKeyReadsWhatItSets) {
  for (const Key<Scene>& key : scene_keys()) {
    Scene scene;
    Value value = key.default_value();
    if (auto* number = std::get_if<double>(&value))
      *number = key.dimension == Dimension::count ? 2.0 : *number * 0.75;
    if (auto* flag = std::get_if<bool>(&value)) *flag = !*flag;
    if (key.kind == KeyKind::word) value = key.words.back();
    if (key.kind == KeyKind::text) value = std::string("some text");
    if (auto* list = std::get_if<std::vector<double>>(&value)) {
      for (double& number : *list) number *= 0.5;
      if (key.list_length == 0) list->push_back(0.125);
    }
    key.set(scene, value);
    EXPECT_EQ(key.get(scene), value) << key.name;
  }
}

TEST(SceneKeys, ActOnTheMechanicsWhereTheySayNothing) {
  EXPECT_EQ(acts_on("charge.conductivity"), ActsOn::conduction);
  EXPECT_EQ(acts_on("gap.exchange_time"), ActsOn::surface);
  EXPECT_EQ(acts_on("kinetics.frequency"), ActsOn::chemistry);
  EXPECT_EQ(acts_on("load.peak"), ActsOn::mechanics);
  EXPECT_EQ(acts_on("body.wall.x"), ActsOn::mechanics);
}

TEST(SceneKeys, JwlConstantsKeepThePressureOfTheUnloadedChargeZero) {
  const auto changed = with_written_key(small_file(), "charge.jwl.omega", "0.5", {});
  ASSERT_TRUE(changed);
  const auto& eos = changed->scene.charge().eos;
  EXPECT_NEAR(materials::jwl_isentropic_pressure(eos, 1.0), 0.0, 1e-5);
}

TEST(SceneKeys, GapAirStartsAtTheInitialTemperature) {
  const auto warm = with_written_key(small_file(), "initial_temperature", "320 K", {});
  ASSERT_TRUE(warm);
  EXPECT_EQ(warm->scene.surface.air.initial_temperature, 320.0);
}

TEST(SceneKeys, ChangedSceneIsValidatedAtThePlaceOfTheChange) {
  const SceneFile file = small_file();
  const auto thick = with_written_key(file, "body.filling.r", "0 to 1.8 cm", {"sweep.toml", 7, 1});
  EXPECT_FALSE(thick);
  const auto shorter = with_written_key(file, "body.cup.x", "0.05 to 1 cm", {"sweep.toml", 7, 1});
  ASSERT_TRUE(shorter) << shorter.error().message();
  EXPECT_EQ(shorter->scene.bodies[0].x_begin, 0.0005);
  const auto unknown = with_written_key(file, "charge.crack_radios", "1 mm", {"sweep.toml", 7, 1});
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().suggestion, "charge.crack_radius");
  EXPECT_TRUE(unknown.error().message().starts_with("sweep.toml:7:1: charge.crack_radios"));
}

TEST(SceneKeys, ListingHasWhatDoesSomethingOrIsGiven) {
  const SceneFile file = small_file();
  const auto idle = std::ranges::count_if(scene_keys(), [&](const Key<Scene>& key) {
    return key.is_written && !key.is_written(file.scene) && !file.given.contains(key.name);
  });
  const auto listed = list_keys(file);
  EXPECT_EQ(listed.size() + static_cast<std::size_t>(idle), scene_keys().size());
  for (const ListedKey& key : listed) {
    EXPECT_NE(key.name, "load.exponent") << "of the other shape";
    if (key.name == "load.duration") {
      EXPECT_EQ(key.value, "1 ms");
    }
  }
}

}  // namespace
}  // namespace launchsafe::scene
