// Gaps that open as a cast charge cools, in scene files.
#include "launchsafe/scene/plan.hpp"
#include "scene/scene_text.hpp"

#include <gtest/gtest.h>

namespace launchsafe::scene {
namespace {

/// The small scene with a temperature in place of its gaps.
std::string cooled_from(const std::string& kelvin, const std::string& more = {}) {
  return with(small_scene, "thickness = \"0, 0.01 cm\"\n",
              "opens_by_cooling = \"" + kelvin + " K\"\n" + more);
}

SceneFile scene_from(const std::string& text) {
  auto file = parse_scene(text, "shell.toml");
  EXPECT_TRUE(file) << (file ? "" : file.error().message());
  return file ? *file : SceneFile{};
}

TEST(CoolingGap, IsWhatTheChargeShrinksMoreThanTheShell) {
  // 0.56 m of Composition B in steel, cooled by 17 K: (54.6 - 11.7)e-6 x 0.56 x 17 (model section 14: about
  // 24 um a kelvin).
  const SceneFile shipped = read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").value();
  EXPECT_NEAR(opening_by_cooling(shipped.scene), 24.024e-6, 1e-12);
  const auto at = [&](double cast, double initial) {
    return with_keys(shipped, {{"gap.opens_by_cooling", cast, {}}, {"initial_temperature", initial, {}}})
        ->scene.surface.gaps;
  };
  ASSERT_EQ(at(317.0, 300.0).size(), 1u);
  EXPECT_NEAR(at(317.0, 300.0).front(), 4.08408e-4, 1e-12);
  EXPECT_NEAR(at(317.0, 283.0).front(), 8.16816e-4, 1e-12);
  EXPECT_EQ(at(317.0, 317.0).front(), 0.0);
  EXPECT_EQ(at(317.0, 336.0).front(), 0.0);
}

TEST(CoolingGap, FollowsTheExpansionOfTheMaterials) {
  const SceneFile usual = scene_from(cooled_from("320"));
  const double length = charge_extent(usual.scene).x_end - charge_extent(usual.scene).x_begin;
  EXPECT_NEAR(usual.scene.surface.gaps.front(), 42.9e-6 * 20.0 * length, 1e-15);
  const SceneFile other = scene_from(cooled_from(
      "320", "[charge]\nthermal_expansion = \"60 um/(m K)\"\n[steel]\nthermal_expansion = \"1e-5 1/K\"\n"));
  EXPECT_NEAR(other.scene.surface.gaps.front(), 50e-6 * 20.0 * length, 1e-15);
  EXPECT_NE(to_toml(other.scene).find("charge.thermal_expansion"), std::string::npos);
}

TEST(CoolingGap, IsWrittenBackInPlaceOfTheThickness) {
  const SceneFile file = scene_from(cooled_from("320"));
  const std::string text = to_toml(file.scene);
  EXPECT_EQ(text.find("gap.thickness"), std::string::npos);
  const SceneFile again = scene_from(text);
  EXPECT_EQ(to_toml(again.scene), text);
  EXPECT_EQ(again.scene.surface.gaps, file.scene.surface.gaps);
}

TEST(CoolingGap, LeavesOtherScenesAndAllMechanicsAsTheyWere) {
  const std::string plain = to_toml(scene_from(small_scene).scene);
  EXPECT_EQ(plain.find("opens_by_cooling"), std::string::npos);
  EXPECT_EQ(plain.find("thermal_expansion"), std::string::npos);
  const std::string more = "[charge]\nthermal_expansion = \"60 um/(m K)\"\n";
  EXPECT_EQ(to_toml(mechanical_part(scene_from(cooled_from("320", more)).scene)),
            to_toml(mechanical_part(scene_from(small_scene).scene)));
}

TEST(CoolingGap, IsEitherStatedOrFollows) {
  const std::string both = with(small_scene, "[gap]\n", "[gap]\nopens_by_cooling = \"320 K\"\n");
  expect_error(error_of(both), line_of(both, "thickness ="), "gap.thickness", "beside gap.opens_by_cooling",
               "one of the two");
  // A new value of one takes the other back.
  const auto stated =
      with_keys(scene_from(cooled_from("320")), {{"gap.thickness", std::vector<double>{1e-4}, {}}});
  ASSERT_TRUE(stated) << stated.error().message();
  EXPECT_EQ(stated->scene.surface.gaps, std::vector<double>{1e-4});
  EXPECT_FALSE(stated->scene.surface.opens_by_cooling);
  const auto follows = with_keys(scene_from(small_scene), {{"gap.opens_by_cooling", 320.0, {}}});
  ASSERT_TRUE(follows) << follows.error().message();
  EXPECT_EQ(follows->scene.surface.gaps, scene_from(cooled_from("320")).scene.surface.gaps);
}

TEST(CoolingGap, IsRefusedWhereItIsTooWideOrNothingShrinks) {
  const auto wide = with_keys(read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").value(),
                              {{"gap.opens_by_cooling", 400.0, {}}, {"charge.thermal_expansion", 1e-3, {}}});
  ASSERT_FALSE(wide);
  EXPECT_EQ(wide.error().key, "gap.opens_by_cooling");
  EXPECT_NE(wide.error().message().find("a gap of 5.53"), std::string::npos) << wide.error().message();
  const std::string inert = with(cooled_from("320"), "\"charge\"", "\"steel\"");
  expect_error(error_of(inert), line_of(inert, "opens_by"), "gap.opens_by_cooling", "without a charge",
               "under a body");
  const std::string celsius = cooled_from("20");
  expect_error(error_of(celsius), line_of(celsius, "opens_by"), "gap.opens_by_cooling", "20 K", "200");
}

}  // namespace
}  // namespace launchsafe::scene
