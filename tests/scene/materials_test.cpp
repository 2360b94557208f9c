// Materials as values: a law with its parameters, a name that bodies refer to, and keys from beside the law.
#include "launchsafe/scene/plan.hpp"
#include "scene/scene_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace launchsafe::scene {
namespace {

SceneFile read(const std::string& text) {
  auto file = parse_scene(text, "shell.toml");
  return file;
}

const std::string elastic_bar =
    "gap.thickness = \"0 mm\"\n[elastic]\ndensity = \"2.5 g/cm3\"\nbulk_modulus = \"40 GPa\"\n"
    "shear_modulus = \"30 GPa\"\n[[body]]\nname = \"bar\"\nmaterial = \"elastic\"\n"
    "x = \"0 to 10 cm\"\nr = \"0 to 1 cm\"\n";

TEST(Materials, OfASceneAreOneOfEachLawByItsName) {
  const Scene scene;
  std::size_t laws = 0;
  materials::for_each_law([&]<class Law>(const Law&) {
    ++laws;
    const Material* material = find_material(scene, Law::name);
    ASSERT_NE(material, nullptr) << Law::name;
    EXPECT_TRUE(std::holds_alternative<Law>(material->law)) << Law::name;
  });
  EXPECT_EQ(scene.materials.size(), laws);
}

/// The key of every parameter is known to scenes with all that the law says of it, and writes that parameter.
TEST(Materials, HaveTheKeysOfTheirLaw) {
  materials::for_each_law([]<class Law>(const Law& usual) {
    for (const Key<Law>& own : Law::parameters()) {
      const Key<Scene>* key = find_key(scene_keys(), own.name);
      ASSERT_NE(key, nullptr) << own.name;
      EXPECT_EQ(key->get(Scene{}), own.get(usual)) << own.name;
      EXPECT_EQ(key->acts_on, own.acts_on) << own.name;
    }
  });
  const SceneFile bar = read(elastic_bar);
  EXPECT_DOUBLE_EQ(bar.scene.parameters<materials::LinearElastic>().density, 2500.0);
}

TEST(Materials, OfOneLawMayBeManyUnderDifferentNames) {
  Scene scene;
  scene.materials.push_back({"glass", materials::LinearElastic{.density = 2500.0}});
  scene.materials.push_back({"lead", materials::LinearElastic{.density = 11340.0}});
  scene.bodies = {{"pane", "glass", 0.0, 2.0, 0.0, 1.0}, {"weight", "lead", 2.0, 3.0, 0.0, 1.0}};
  EXPECT_DOUBLE_EQ(mass_of(scene, "glass"), std::numbers::pi * 5000.0);  // 2 m of pi m2 of 2500 kg/m3
  EXPECT_DOUBLE_EQ(mass_of(scene, "lead"), std::numbers::pi * 11340.0);
  EXPECT_DOUBLE_EQ(total_mass(scene), std::numbers::pi * 16340.0);
  EXPECT_FALSE(has_charge(scene));
}

/// Identities of stored results are made of this text: a law that is not used does not change it.
TEST(Materials, AreWrittenWhereTheyMatter) {
  const Scene shell = read(small_scene).scene;
  EXPECT_EQ(to_toml(shell).find("elastic"), std::string::npos);
  EXPECT_NE(to_toml(shell).find("steel.density = \"7830 kg/m3\""), std::string::npos);
  for (const std::string& text : {elastic_bar, "elastic.density = \"3 g/cm3\"\n" + small_scene}) {
    const std::string written = to_toml(read(text).scene);
    EXPECT_NE(written.find("elastic.density"), std::string::npos);
    EXPECT_EQ(to_toml(read(written).scene), written);
  }
}

TEST(Materials, ThatNoBodyIsOfLeaveTheMechanicalPartAsItIs) {
  const std::string bar = to_toml(mechanical_part(read(elastic_bar).scene));
  for (const char* other : {"steel.yield_stress = \"1 GPa\"\n", "charge.density = \"1.8 g/cm3\"\n",
                            "kinetics.burnt_temperature = \"800 K\"\n"})
    EXPECT_EQ(to_toml(mechanical_part(read(other + elastic_bar).scene)), bar) << other;
  EXPECT_NE(to_toml(mechanical_part(read(with(elastic_bar, "40 GPa", "41 GPa")).scene)), bar);
}

}  // namespace
}  // namespace launchsafe::scene
