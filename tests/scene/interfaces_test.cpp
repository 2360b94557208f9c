// Interfaces in scene files: read, written back, refused.
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "scene/scene_text.hpp"

#include <gtest/gtest.h>

namespace launchsafe::scene {
namespace {

const std::string sliding_wall = "\n[interface.wall]\ncondition = \"sliding\"\nfriction = 0.05\n";
const std::string bonded_cup = "\n[interface.cup]\ncondition = \"bonded\"\n";
const std::string form = "[numerics]\nformulation = \"updated-lagrangian\"\n";

/// Bodies are held as their tables say, and bonded without one.
SceneFile without_constants(const std::string& tables) {
  return parse_scene("constants = \"none\"\n" + small_scene + tables, "shell.toml");
}

TEST(Interfaces, AreReadAndWrittenBack) {
  const Scene scene = without_constants(sliding_wall + bonded_cup).scene;
  ASSERT_EQ(scene.interfaces.size(), 2u);
  const Interface &cup = scene.interfaces[0], &wall = scene.interfaces[1];
  EXPECT_EQ(wall.body, "wall");
  EXPECT_EQ(wall.condition, Condition::sliding);
  EXPECT_EQ(wall.friction, 0.05);
  EXPECT_EQ(cup.condition, Condition::bonded);
  EXPECT_FALSE(cup.friction);
  EXPECT_EQ(to_toml(parse_scene(to_toml(scene), "again.toml").scene), to_toml(scene));
}

TEST(Interfaces, ThatCannotSlideChangeNoMechanics) {
  const auto part = [](const std::string& tables) {
    return to_toml(mechanical_part(without_constants(tables).scene));
  };
  EXPECT_EQ(part(bonded_cup), part(""));
  EXPECT_NE(part(sliding_wall), part(""));
}

/// The wall's table with `from` replaced.
struct InterfaceFault {
  const char *from, *to, *at, *key;
  const char* suggestion = "";
};

TEST(Interfaces, FaultsNameTheirKey) {
  for (const auto& [from, to, at, key, suggestion] : std::vector<InterfaceFault>{
           {"wall", "wal", "[interface", "interface.wal", "interface.wall"},
           {"wall", "filling", "[interface", "interface.filling"},
           {"0.05", "10.5", "friction =", "interface.wall.friction"},
           {"0.05", "-0.1", "friction =", "interface.wall.friction"},
           {"friction = 0.05\n", "", "condition", "interface.wall.friction"},
           {"sliding", "bonded", "friction =", "interface.wall.friction"},
           {"sliding", "glued", "condition", "interface.wall.condition"},
           {"condition = \"sliding\"\n", "", "[interface", "interface.wall.condition"},
           {"friction", "fricton", "fricton", "interface.wall.fricton", "friction"}}) {
    const std::string text = small_scene + with(sliding_wall, from, to);
    expect_error(error_of(text), line_of(text, at), key);
    EXPECT_EQ(error_of(text).suggestion, suggestion);
  }
  expect_error(error_of("interface = 3\n" + small_scene), 1, "interface", "3");
  const std::string even = small_scene + form + sliding_wall;
  expect_error(error_of(even), line_of(even, "condition"), "interface.wall.condition");
  EXPECT_NO_THROW(parse_scene(small_scene + form + bonded_cup, "shell.toml"));
}

TEST(Interfaces, TakeOtherValuesInStudies) {
  const SceneFile file = without_constants(sliding_wall);
  EXPECT_EQ(with_written_key(file, "interface.wall.friction", "0.3", {})->scene.interfaces[0].friction, 0.3);
  EXPECT_FALSE(with_written_key(file, "interface.wall.friction", "11", {}));
  EXPECT_FALSE(with_written_key(file, "interface.cup.friction", "0.1", {}));
}

}  // namespace
}  // namespace launchsafe::scene
