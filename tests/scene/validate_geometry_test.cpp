// Drawings that look right and are not: gaps and steps by mistake.
#include "scene_text.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace launchsafe::scene {
namespace {

const std::string x_of_base = "x = \"4 to 5 cm\"", r_of_base = "r = \"0 to 2 cm\"";

/// The small shell with the last `from` of its text replaced: its base.
std::string with_base(const std::string& from, const std::string& to) {
  std::string text = small_scene;
  return text.replace(text.rfind(from), from.size(), to);
}

/// Inches by hand: 4.0000001 cm is 1 nm off. Cells are 2.5 mm, so that the tenth is 0.25 mm.
TEST(Drawing, EdgesThatNearlyMeetAreRefused) {
  for (const char* begin : {"4.0000001", "3.9999999", "4.024", "3.98"}) {
    const InputError error = error_of(with_base(x_of_base, fmt::format("x = \"{} to 5 cm\"", begin)));
    EXPECT_EQ(error.key, "body.base.x") << error.message();
    EXPECT_NE(error.found.find("\"filling\""), std::string::npos) << error.message();
  }
  const InputError rim = error_of(with_base(r_of_base, "r = \"0 to 1.9999999 cm\""));
  EXPECT_EQ(rim.key, "body.base.r");
  EXPECT_EQ(error_of(with_base(r_of_base, "r = \"1e-7 to 2 cm\"")).key, "body.base.r");
}

TEST(Drawing, AGapUnderTheChargeIsRefusedByTheKeyThatSaysGaps) {
  const InputError open = error_of(with_base(x_of_base, "x = \"4.03 to 5 cm\""));
  EXPECT_EQ(open.key, "gap.thickness");
  EXPECT_EQ(error_of(with_base(r_of_base, "r = \"0.5 to 2 cm\"")).key, "gap.thickness");
}

/// Without its cup; under a cup with a bore; and behind a narrower charge, of which it leaves a step.
TEST(Drawing, AnOpenEndOfTheChargeIsRefusedUnlessTheSceneSaysSo) {
  const auto body = [](const char* name, const char* material, const char* x, const char* r) {
    return fmt::format("[[body]]\nname = \"{}\"\nmaterial = \"{}\"\nx = \"{}\"\nr = \"{}\"\n", name, material,
                       x, r);
  };
  const std::string cup = body("cup", "steel", "0 to 1 cm", "0 to 2 cm"),
                    ring = body("ring", "steel", "0 to 1 cm", "1 to 2 cm"),
                    plug = body("plug", "steel", "0 to 0.5 cm", "0 to 1 cm");
  for (const auto& [front, open] :
       {std::pair{std::string{}, "filling"},
        {ring, "filling"},
        {ring + body("booster", "charge", "0 to 1 cm", "0 to 1 cm"), "booster"},
        {ring + plug + body("booster", "charge", "0.5 to 1 cm", "0 to 0.8 cm"), "filling"}}) {
    const std::string text = with(small_scene, cup, front);
    const InputError error = error_of(text);
    EXPECT_EQ(error.key, fmt::format("body.{}.x", open)) << error.message();
    EXPECT_EQ(error.line, line_of(text, open) + 2) << error.message();
    const auto said = parse_scene("open_charge = true\n" + text, "shell.toml");
    EXPECT_EQ(to_toml(parse_scene(to_toml(said.scene), "shell.toml").scene), to_toml(said.scene));
  }
  // The bottom bears all over, whatever the scene says.
  const std::string bored = with_base(r_of_base, "r = \"0.5 to 2 cm\"");
  EXPECT_EQ(error_of("open_charge = true\n" + bored).key, "gap.thickness");
}

TEST(Drawing, ABodyThatNothingHoldsIsRefused) {
  const std::string tail =
      "\n[[body]]\nname = \"tail\"\nmaterial = \"steel\"\nx = \"5.1 to 6 cm\"\nr = \"0 to 2 cm\"\n";
  EXPECT_EQ(error_of(small_scene + tail).key, "body.tail.x");
}

TEST(Drawing, AChamberThatItLeavesUnclearIsRefused) {
  const std::string shorter =
      with(small_scene, "x = \"1 to 4 cm\"\nr = \"1.5 to 2 cm\"", "x = \"1 to 3 cm\"\nr = \"1.5 to 2 cm\"");
  EXPECT_EQ(error_of(shorter).key, "load.obturation");
  EXPECT_TRUE(caught(
      [&] { return parse_scene(with(shorter, "[load]", "[load]\nobturation = \"4.5 cm\""), "shell.toml"); }));
}

}  // namespace
}  // namespace launchsafe::scene
