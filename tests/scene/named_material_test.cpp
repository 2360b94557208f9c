// Materials as tables of numbers: shipped ones, files, and what bodies make of their names.
#include "launchsafe/scene/constants.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "scene/scene_text.hpp"
#include "store/temporary_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace launchsafe::scene {
namespace {

std::string shipped(const std::string& name) {
  std::ifstream file(LAUNCHSAFE_SOURCE_DIR "/studies/materials/" + name + ".toml");
  return {std::istreambuf_iterator<char>(file), {}};
}

const std::string of_comp_b = with(small_scene, "material = \"charge\"", "material = \"comp-b\""),
                  of_pbx = with(small_scene, "material = \"charge\"", "material = \"pbx-9501\""),
                  of_mix = with(small_scene, "material = \"charge\"", "material = \"mix.toml\"");

std::string with_steel(const std::string& name) {
  std::string text = small_scene;
  for (int body = 0; body < 3; ++body)
    text = with(text, "material = \"steel\"", fmt::format("material = \"{}\"", name));
  return text;
}

/// A folder with the file of a material beside a scene.
class NamedMaterials : public testing::TemporaryFolder {
 protected:
  /// mix.toml: Composition B with one number changed.
  void write_mix(const std::string& from, const std::string& to) const {
    std::ofstream(folder() / "mix.toml") << with(shipped("comp-b"), from, to);
  }
  SceneFile scene_of(const std::string& text) const { return parse_scene(text, folder() / "shell.toml"); }
  InputError fault_of(const std::string& text) const {
    return caught([&] { return scene_of(text); }).error();
  }
};

/// Every number stands on one line with its source.
TEST(NamedMaterial, ThatShipsHasASourceBesideEveryNumber) {
  ASSERT_EQ(shipped_materials().size(), 3U);
  for (const NamedMaterial& material : shipped_materials()) {
    EXPECT_FALSE(material.title.empty()) << material.name;
    std::ifstream file(LAUNCHSAFE_SOURCE_DIR "/studies/materials/" + material.name + ".toml");
    std::size_t sources = 0;
    for (std::string line; std::getline(file, line);)
      if (!line.starts_with('#') && line.find(" = ") != std::string::npos &&
          line.find("  # ") != std::string::npos)
        ++sources;
    EXPECT_EQ(sources, material.values.size()) << material.name;
  }
}

/// What is called comp-b is what scenes have by default: all that was computed and calibrated with it holds.
TEST_F(NamedMaterials, CompBAndShellSteelAreTheDefaults) {
  const SceneFile named =
      scene_of(with(with_steel("shell-steel"), "material = \"charge\"", "material = \"comp-b\""));
  Scene plain = named.scene, expected = scene_of(small_scene).scene;
  clear_remarks(plain);
  clear_remarks(expected);
  // The constants have a steel of their own, which a steel that bodies name does not take.
  EXPECT_EQ(expected.steel().strength.a,
            std::get<double>(shipped_constants().front()->values.at("steel.yield_stress")));
  expected.steel().strength.a = 792e6;
  EXPECT_EQ(to_toml(plain), to_toml(expected));
  EXPECT_EQ(to_toml(scene_of(to_toml(plain)).scene), to_toml(plain));
  EXPECT_FALSE(named.given.contains("kinetics.ignition_temperature"));
  EXPECT_FALSE(named.scene.material<Charge>().title.empty());
}

TEST_F(NamedMaterials, YieldToSingleNumbersOfTheScene) {
  write_mix("1.717 g/cm3", "1.65 g/cm3");
  const SceneFile own = scene_of(of_mix);
  EXPECT_DOUBLE_EQ(own.scene.charge().initial_density(), 1650.0);
  EXPECT_DOUBLE_EQ(own.scene.charge().specific_heat, 1780.0);
  const SceneFile file = scene_of(of_mix + "\n[charge]\ndensity = \"1.7 g/cm3\"\n");
  EXPECT_DOUBLE_EQ(file.scene.charge().initial_density(), 1700.0);
  EXPECT_DOUBLE_EQ(with_written_key(own, "charge.density", "1.6 g/cm3", {})->scene.charge().initial_density(),
                   1600.0);
}

TEST_F(NamedMaterials, ReactByTheirOwnKinetics) {
  const auto kinetics = scene_of(of_pbx).scene.charge().kinetics;
  EXPECT_EQ(kinetics.activation_temperature, 26520.0);
  EXPECT_EQ(kinetics.frequency, 5e19);
  EXPECT_EQ(kinetics.heat_of_reaction, 2.09e6);
}

TEST_F(NamedMaterials, AreNotGivenOtherKineticsByTheSceneButByStudies) {
  write_mix("21700 K", "15000 K");
  for (const std::string line : {"activation_temperature = \"27000 K\"", "frequency = \"1e18 1/s\"",
                                 "heat_of_reaction = \"5 MJ/kg\"", "burnt_temperature = \"800 K\""}) {
    const InputError error = fault_of(of_mix + "\n[kinetics]\n" + line + "\n");
    EXPECT_EQ(error.key, "kinetics." + line.substr(0, line.find(' '))) << error.message();
    EXPECT_NE(error.allowed.find("mix.toml:"), std::string::npos) << error.message();
  }
  EXPECT_EQ(fault_of(of_pbx + "\n[kinetics]\nfrequency = \"2.01e18 1/s\"\n").key, "kinetics.frequency");
  // A material that does not say when it ignites leaves it to the constants, or to the scene.
  EXPECT_EQ(scene_of(of_mix + "\n[kinetics]\nfrequency = \"2.01e18 1/s\"\nignition_temperature = \"600 K\"\n")
                .scene.charge()
                .kinetics.ignition_temperature,
            600.0);
  const Place study{"a/study.toml", 3};
  const auto hot = with_written_key(scene_of(of_mix), "kinetics.frequency", "1e18 1/s", study);
  ASSERT_TRUE(hot) << hot.error().message();
  EXPECT_EQ(hot->scene.charge().kinetics.frequency, 1e18);
  EXPECT_EQ(hot->scene.charge().kinetics.activation_temperature, 15000.0);
  // But not by a body of another material beside a line of the scene.
  const SceneFile usual = scene_of(small_scene + "\n[kinetics]\nfrequency = \"2.01e18 1/s\"\n");
  EXPECT_FALSE(with_written_key(usual, "body.filling.material", "pbx-9501", study));
}

TEST_F(NamedMaterials, AndKeysAreTheOriginsOfKinetics) {
  write_mix("21700 K", "15000 K");
  const std::string of_number = small_scene + "\n[kinetics]\nfrequency = \"1e18 1/s\"\n";
  EXPECT_EQ(kinetics_origin(scene_of(small_scene)), "the default");
  EXPECT_EQ(
      kinetics_origin(scene_of(of_number)),
      fmt::format("the default; kinetics.frequency (shell.toml:{})", line_of(of_number, "frequency =")));
  EXPECT_EQ(kinetics_origin(scene_of(of_mix)).find("material \"mix.toml\" (mix.toml:"), 0u);
}

TEST_F(NamedMaterials, OfABodyAreAKeyThatStudiesChange) {
  const SceneFile file = scene_of(of_pbx);
  const std::string key = "body.filling.material";
  EXPECT_EQ(std::get<std::string>(value_in(file, key)), "pbx-9501");
  EXPECT_DOUBLE_EQ(with_written_key(file, key, "comp-b", {})->scene.charge().initial_density(), 1717.0);
  EXPECT_EQ(with_written_key(file, key, "comb-p", {}).error().suggestion, "\"comp-b\"");
}

/// Of small_scene with comp-b read from mix.toml.
struct MaterialFault {
  const char *from, *to, *key;
};

TEST_F(NamedMaterials, ThatAreFaultyAreRefusedAtTheirKey) {
  for (const auto& [from, to, key] :
       {MaterialFault{"law = \"charge\"", "law = \"explosive\"", "law"},
        {"law = \"charge\"\n", "", "law"},
        {"flaw_size =", "yield_stress = \"1 GPa\"\nflaw_size =", "yield_stress"},
        {"flaw_size =", "# ", "flaw_size"},
        {"1.717 g/cm3", "-1 g/cm3", "density"},
        {"title =", "load.peak = \"300 MPa\"\ntitle =", "load.peak"}}) {
    write_mix(from, to);
    const InputError error = fault_of(of_mix);
    EXPECT_EQ(error.key, key) << error.message();
    EXPECT_TRUE(error.file.ends_with("mix.toml")) << error.message();
    EXPECT_GT(error.line, 0) << error.message();
  }
  std::filesystem::remove(folder() / "mix.toml");
  EXPECT_EQ(fault_of(of_mix).key, "body.filling.material");
  // A second explosive, and two steels.
  EXPECT_EQ(fault_of(with(of_comp_b, "material = \"steel\"", "material = \"pbx-9501\"")).key,
            "body.filling.material");
  EXPECT_EQ(fault_of(with(small_scene, "material = \"steel\"", "material = \"shell-steel\"")).key,
            "body.wall.material");
}

}  // namespace
}  // namespace launchsafe::scene
