// Gaps that close in scene files: read, written back, refused.
#include "launchsafe/scene/plan.hpp"
#include "scene/scene_text.hpp"

#include <gtest/gtest.h>

namespace launchsafe::scene {
namespace {

const std::string sliding_base = R"(
[interface.BASE]
condition = "sliding"
friction = 0.1
)";

std::string with_keys_of_gap(const std::string& keys) {
  return with(small_scene, "thickness = \"0, 0.01 cm\"\n", "thickness = \"0, 0.01 cm\"\n" + keys);
}

/// The small scene whose base slides, with keys of its gap.
std::string closing(const std::string& keys = "model = \"closing\"\n") {
  const auto plain = parse_scene(small_scene, "shell.toml");
  const std::string base = body_under_charge(plain->scene)->name;
  return with_keys_of_gap(keys) + with(sliding_base, "BASE", base);
}

TEST(ClosingGap, IsReadAndWrittenBack) {
  const auto file = parse_scene(
      closing("model = \"closing\"\nroughness = \"5 um\"\nbase = \"insulated\"\nrelease = \"0.5 ms\"\n"
              "release_duration = \"0 ms\"\n"),
      "shell.toml");
  ASSERT_TRUE(file) << file.error().message();
  const Surface& surface = file->scene.surface;
  EXPECT_EQ(surface.model, GapModel::closing);
  EXPECT_EQ(surface.base, GapBase::insulated);
  EXPECT_DOUBLE_EQ(surface.roughness, 5e-6);
  EXPECT_DOUBLE_EQ(surface.release, 5e-4);
  EXPECT_EQ(surface.release_duration, 0.0);
  EXPECT_TRUE(closes(surface, 1e-4));
  EXPECT_FALSE(closes(surface, 5e-6));
  EXPECT_DOUBLE_EQ(file->scene.numerics.selective_inertia, 2.0);
  const std::string text = to_toml(file->scene);
  const auto again = parse_scene(text, "again.toml");
  ASSERT_TRUE(again) << again.error().message() << text;
  EXPECT_EQ(to_toml(again->scene), text);
}

TEST(ClosingGap, IsNotWrittenWhereThereIsNone) {
  const auto file = parse_scene(small_scene, "shell.toml");
  ASSERT_TRUE(file);
  for (const char* key : {"gap.model", "gap.roughness", "gap.base", "gap.release"})
    EXPECT_EQ(to_toml(file->scene).find(key), std::string::npos) << key;
}

TEST(ClosingGap, IsWrittenWithTheFlowOfItsAirOnlyWhereItFlows) {
  const auto flows =
                 parse_scene(closing("model = \"closing\"\nair_flow = \"common-pressure\"\n"), "shell.toml"),
             trapped = parse_scene(closing("model = \"closing\"\nair_flow = \"trapped\"\n"), "shell.toml");
  ASSERT_TRUE(flows && trapped);
  EXPECT_EQ(flows->scene.surface.air_flow, AirFlow::common_pressure);
  const std::string text = to_toml(flows->scene);
  EXPECT_EQ(to_toml(parse_scene(text, "again.toml")->scene), text);
  EXPECT_EQ(to_toml(trapped->scene), to_toml(parse_scene(closing(), "shell.toml")->scene));
}

TEST(ClosingGap, IsAnotherLaunch) {
  const auto reservoir = parse_scene(closing(""), "shell.toml"),
             closed = parse_scene(closing(), "shell.toml");
  ASSERT_TRUE(reservoir && closed);
  EXPECT_NE(to_toml(mechanical_part(reservoir->scene)), to_toml(mechanical_part(closed->scene)));
}

TEST(ClosingGap, IsRefusedOverABondedBase) {
  const std::string text = with_keys_of_gap("model = \"closing\"\n");
  expect_error(error_of(text), line_of(text, "model ="), "gap.model", "bonded", "condition = \"sliding\"");
}

TEST(ClosingGap, IsRefusedWhereAnyPartOfTheBaseIsBonded) {
  // A base of two bodies, of which the interface speaks of one.
  const std::string text =
      with(closing(), "x = \"4 to 5 cm\"\nr = \"0 to 2 cm\"",
           "x = \"4 to 5 cm\"\nr = \"0 to 1 cm\"\n\n[[body]]\nname = \"ring\"\nmaterial = \"steel\"\n"
           "x = \"4 to 5 cm\"\nr = \"1 to 2 cm\"");
  expect_error(error_of(text), line_of(text, "model ="), "gap.model", "bonded to \"ring\"",
               "[interface.ring]");
}

TEST(ClosingGap, ARoughnessOfNothingIsRefusedWithOneThatIsAllowed) {
  const std::string text = closing("model = \"closing\"\nroughness = \"0 um\"\n");
  expect_error(error_of(text), line_of(text, "roughness ="), "gap.roughness", "0 um", "such as \"30 µm\"");
}

TEST(ClosingGap, LettingGoTakesNoTimeWhereNothingHoldsTheCharge) {
  const std::string text = closing("model = \"closing\"\nrelease_duration = \"1 ms\"\n");
  expect_error(error_of(text), line_of(text, "release_duration ="), "gap.release_duration",
               "without gap.release", "until when the charge is held");
}

TEST(ClosingGap, IsRefusedWithKeysOfTheReservoirAndTheOtherWayRound) {
  const std::string film = closing("model = \"closing\"\nair = \"film\"\n");
  expect_error(error_of(film), line_of(film, "air ="), "gap.air", "\"reservoir\" beside \"closing\"",
               "absent");
  for (const char* key : {"roughness = \"10 um\"", "base = \"insulated\"", "release = \"1 ms\"",
                          "release_duration = \"1 ms\"", "air_flow = \"common-pressure\""}) {
    const std::string text = closing(std::string(key) + "\n");
    const std::string name = std::string(key).substr(0, std::string(key).find(' '));
    expect_error(error_of(text), line_of(text, key), "gap." + name, "\"closing\" beside \"reservoir\"",
                 "absent");
  }
}

TEST(ClosingGap, IsWrittenWithTheTimeOverWhichTheChargeLetsGo) {
  // What determines a stored launch has it, so that none of an earlier release takes its place.
  EXPECT_NE(to_toml(parse_scene(closing(), "shell.toml")->scene).find("gap.release_duration = "),
            std::string::npos);
  EXPECT_EQ(to_toml(parse_scene(small_scene, "shell.toml")->scene).find("release_duration"),
            std::string::npos);
}

TEST(ClosingGap, MayBeWiderThanOneOfTheReservoir) {
  const auto wide = [](std::string text) { return with(std::move(text), "0, 0.01 cm", "0, 2 cm"); };
  EXPECT_TRUE(parse_scene(wide(closing()), "shell.toml"));
  const std::string text = wide(small_scene);
  expect_error(error_of(text), line_of(text, "thickness ="), "gap.thickness", "2 cm", "at most 1 cm");
}

TEST(ClosingGap, IsRefusedWithoutRoughness) {
  const std::string text = closing("model = \"closing\"\nroughness = \"0 um\"\n");
  expect_error(error_of(text), line_of(text, "roughness"), "gap.roughness", "0 um", "excluded");
}

}  // namespace
}  // namespace launchsafe::scene
