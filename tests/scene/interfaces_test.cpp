// Interfaces in scene files: read, written back, refused.
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "scene/scene_text.hpp"

#include <gtest/gtest.h>

namespace launchsafe::scene {
namespace {

const std::string sliding_wall = R"(
[interface.wall]
condition = "sliding"
friction = 0.05
)";
const std::string bonded_cup = R"(
[interface.cup]
condition = "bonded"
)";

/// Bodies are held as their tables say, and bonded without one.
const std::string without_constants = "constants = \"none\"\n" + small_scene;

TEST(Interfaces, AreReadAndWrittenBack) {
  const auto file = parse_scene(without_constants + sliding_wall + bonded_cup, "shell.toml");
  ASSERT_TRUE(file) << file.error().message();
  ASSERT_EQ(file->scene.interfaces.size(), 2u);
  const Interface &cup = file->scene.interfaces[0], &wall = file->scene.interfaces[1];
  EXPECT_EQ(wall.body, "wall");
  EXPECT_EQ(wall.condition, Condition::sliding);
  EXPECT_EQ(wall.friction, 0.05);
  EXPECT_EQ(cup.condition, Condition::bonded);
  EXPECT_FALSE(cup.friction);
  const std::string text = to_toml(file->scene);
  const auto again = parse_scene(text, "again.toml");
  ASSERT_TRUE(again) << again.error().message() << text;
  EXPECT_EQ(to_toml(again->scene), text);
}

TEST(Interfaces, ThatCannotSlideChangeNoMechanics) {
  const auto plain = parse_scene(without_constants, "shell.toml");
  const auto bonded =
      parse_scene(without_constants + "[interface.wall]\ncondition = \"bonded\"\n", "shell.toml");
  const auto slides = parse_scene(without_constants + sliding_wall, "shell.toml");
  ASSERT_TRUE(plain && bonded && slides);
  EXPECT_EQ(to_toml(mechanical_part(bonded->scene)), to_toml(mechanical_part(plain->scene)));
  EXPECT_NE(to_toml(mechanical_part(slides->scene)), to_toml(mechanical_part(plain->scene)));
}

TEST(Interfaces, OfBodiesAwayFromTheChargeAreRefused) {
  auto text = small_scene + with(sliding_wall, "wall", "wal");
  auto error = error_of(text);
  expect_error(error, line_of(text, "[interface"), "interface.wal");
  EXPECT_EQ(error.suggestion, "interface.wall");
  text = small_scene + with(sliding_wall, "wall", "filling");
  expect_error(error_of(text), line_of(text, "[interface"), "interface.filling");
  text = small_scene +
         "[[body]]\nname = \"lid\"\nmaterial = \"steel\"\nx = \"5 to 6 cm\"\nr = \"0 to 2 cm\"\n" +
         with(sliding_wall, "wall", "lid");
  expect_error(error_of(text), line_of(text, "[interface"), "interface.lid");
}

TEST(Interfaces, WithKeysMissingOrOutOfRangeAreRefused) {
  auto text = small_scene + with(sliding_wall, "0.05", "10.5");
  expect_error(error_of(text), line_of(text, "friction ="), "interface.wall.friction", "10.5");
  text = small_scene + with(sliding_wall, "0.05", "-0.1");
  expect_error(error_of(text), line_of(text, "friction ="), "interface.wall.friction", "-0.1");
  text = small_scene + with(sliding_wall, "friction = 0.05\n", "");
  expect_error(error_of(text), line_of(text, "condition"), "interface.wall.friction");
  EXPECT_EQ(error_of(text).suggestion, "") << "no friction is usual";
  text = small_scene + with(sliding_wall, "sliding", "bonded");
  expect_error(error_of(text), line_of(text, "friction ="), "interface.wall.friction");
  text = small_scene + with(sliding_wall, "sliding", "glued");
  expect_error(error_of(text), line_of(text, "condition"), "interface.wall.condition");
  text = small_scene + with(sliding_wall, "condition = \"sliding\"\n", "");
  expect_error(error_of(text), line_of(text, "[interface"), "interface.wall.condition");
  text = small_scene + with(sliding_wall, "friction", "fricton");
  EXPECT_EQ(error_of(text).suggestion, "friction");
  text = "interface = 3\n" + small_scene;
  expect_error(error_of(text), 1, "interface", "3");
}

TEST(Interfaces, DoNotSlideInTheUpdatedLagrangianForm) {
  const std::string form = "[numerics]\nformulation = \"updated-lagrangian\"\n";
  const std::string text = small_scene + form + sliding_wall;
  expect_error(error_of(text), line_of(text, "condition"), "interface.wall.condition");
  EXPECT_TRUE(parse_scene(small_scene + form + "[interface.wall]\ncondition = \"bonded\"\n", "shell.toml"));
}

TEST(Interfaces, TakeOtherValuesInStudies) {
  const auto file = parse_scene(without_constants + sliding_wall, "shell.toml");
  ASSERT_TRUE(file);
  const auto rough = with_written_key(*file, "interface.wall.friction", "0.3", {});
  ASSERT_TRUE(rough) << rough.error().message();
  EXPECT_EQ(rough->scene.interfaces[0].friction, 0.3);
  EXPECT_FALSE(with_written_key(*file, "interface.wall.friction", "11", {}));
  EXPECT_FALSE(with_written_key(*file, "interface.cup.friction", "0.1", {}));
}

}  // namespace
}  // namespace launchsafe::scene
