// Materials as tables of numbers: shipped ones, files, and what bodies make of their names.
#include "launchsafe/scene/constants.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "scene/scene_text.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace launchsafe::scene {
namespace {

SceneFile scene_of(const std::string& text, const std::string& path = "shell.toml") {
  auto file = parse_scene(text, path);
  EXPECT_TRUE(file) << (file ? "" : file.error().message()) << text;
  return file ? *file : SceneFile{};
}

std::string shipped(const std::string& name) {
  std::ifstream file(LAUNCHSAFE_SOURCE_DIR "/studies/materials/" + name + ".toml");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// All numbers of a shipped material, one of them changed, as a table of a scene.
std::string like(const std::string& shipped_name, const std::string& name, const std::string& from,
                 const std::string& to) {
  return fmt::format("\n[material.{}]\n{}", name, with(shipped(shipped_name), from, to));
}

const std::string of_comp_b = with(small_scene, "material = \"charge\"", "material = \"comp-b\"");
const std::string of_own = with(small_scene, "material = \"charge\"", "material = \"my-mix\"");
const std::string own_mix = like("comp-b", "my-mix", "1.717 g/cm3", "1.65 g/cm3");
const std::string hot_mix = like("comp-b", "my-mix", "21700 K", "15000 K");
const std::string hard_steel = like("shell-steel", "hard", "792 MPa", "1.2 GPa");

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
TEST(NamedMaterial, CompBAndShellSteelAreTheDefaults) {
  std::string both = of_comp_b;
  for (int body = 0; body < 3; ++body)
    both = with(both, "material = \"steel\"", "material = \"shell-steel\"");
  const SceneFile named = scene_of(both), usual = scene_of(small_scene);
  Scene plain = named.scene;
  clear_remarks(plain);
  Scene expected = usual.scene;
  clear_remarks(expected);
  // The constants have a steel of their own, which a steel that bodies name does not take.
  EXPECT_EQ(expected.steel().strength.a,
            std::get<double>(shipped_constants().front()->values.at("steel.yield_stress")));
  expected.steel().strength.a = 792e6;
  EXPECT_EQ(to_toml(plain), to_toml(expected));
  EXPECT_FALSE(named.given.contains("kinetics.ignition_temperature"));
  EXPECT_FALSE(named.scene.material<Charge>().title.empty());
}

TEST(NamedMaterial, YieldsToSingleNumbersOfTheScene) {
  const SceneFile own = scene_of(of_own + own_mix);
  EXPECT_DOUBLE_EQ(own.scene.charge().initial_density(), 1650.0);
  EXPECT_DOUBLE_EQ(own.scene.charge().specific_heat, 1780.0);
  const SceneFile file = scene_of(of_own + "\n[charge]\ndensity = \"1.7 g/cm3\"\n" + own_mix);
  EXPECT_DOUBLE_EQ(file.scene.charge().initial_density(), 1700.0);
  const auto changed = with_written_key(own, "charge.density", "1.6 g/cm3", {});
  ASSERT_TRUE(changed);
  EXPECT_DOUBLE_EQ(changed->scene.charge().initial_density(), 1600.0);
}

TEST(NamedMaterial, ReadsBackFromTheWrittenScene) {
  for (const std::string& text :
       {of_own + own_mix, with(of_comp_b, "material = \"steel\"", "material = \"hard\"") + hard_steel,
        with(small_scene, "material = \"steel\"", "material = \"shell-steel\"")}) {
    const std::string written = to_toml(scene_of(text).scene);
    EXPECT_EQ(to_toml(scene_of(written).scene), written);
  }
}

TEST(NamedMaterial, ReactsByItsOwnKinetics) {
  const SceneFile pbx = scene_of(with(small_scene, "material = \"charge\"", "material = \"pbx-9501\""));
  EXPECT_EQ(pbx.scene.charge().kinetics.activation_temperature, 26520.0);
  EXPECT_EQ(pbx.scene.charge().kinetics.frequency, 5e19);
  EXPECT_EQ(pbx.scene.charge().kinetics.heat_of_reaction, 2.09e6);
}

TEST(NamedMaterial, IsNotGivenOtherKineticsByTheScene) {
  for (const auto& [key, value] : {std::pair{"activation_temperature", "27000 K"},
                                   {"frequency", "1e18 1/s"},
                                   {"heat_of_reaction", "5 MJ/kg"},
                                   {"burnt_temperature", "800 K"}}) {
    const std::string line = fmt::format("{} = \"{}\"", key, value),
                      text = of_own + "\n[kinetics]\n" + line + "\n" + hot_mix;
    const InputError error = error_of(text);
    EXPECT_EQ(error.key, std::string("kinetics.") + key) << error.message();
    EXPECT_EQ(error.line, line_of(text, line)) << error.message();
    EXPECT_NE(error.allowed.find("shell.toml:"), std::string::npos) << error.message();
  }
  const std::string pbx = with(small_scene, "material = \"charge\"", "material = \"pbx-9501\"");
  EXPECT_EQ(error_of(pbx + "\n[kinetics]\nfrequency = \"2.01e18 1/s\"\n").key, "kinetics.frequency");
  for (const char* same : {"frequency = \"2.01e18 1/s\"", "burnt_temperature = \"784 K\""})
    EXPECT_EQ(scene_of(of_own + "\n[kinetics]\n" + same + "\n" + hot_mix)
                  .scene.charge()
                  .kinetics.activation_temperature,
              15000.0);
  // A material that does not say when it ignites leaves it to the constants, or to the scene.
  EXPECT_EQ(scene_of(of_own + "\n[kinetics]\nignition_temperature = \"600 K\"\n" + hot_mix)
                .scene.charge()
                .kinetics.ignition_temperature,
            600.0);
  scene_of(of_comp_b + "\n[kinetics]\nfrequency = \"2.01e18 1/s\"\n");
}

TEST(NamedMaterial, IsGivenOtherKineticsByStudies) {
  const Place study{"a/study.toml", 3};
  const auto hot = with_written_key(scene_of(of_own + hot_mix), "kinetics.frequency", "1e18 1/s", study);
  ASSERT_TRUE(hot) << hot.error().message();
  EXPECT_EQ(hot->scene.charge().kinetics.frequency, 1e18);
  EXPECT_EQ(hot->scene.charge().kinetics.activation_temperature, 15000.0);
  // But not by a body of another material beside a line of the scene.
  const SceneFile usual = scene_of(small_scene + "\n[kinetics]\nfrequency = \"2.01e18 1/s\"\n");
  EXPECT_FALSE(with_written_key(usual, "body.filling.material", "pbx-9501", study));
}

TEST(NamedMaterial, AndKeysAreTheOriginsOfKinetics) {
  const std::string of_number = small_scene + "\n[kinetics]\nfrequency = \"1e18 1/s\"\n",
                    of_material = of_own + hot_mix;
  const auto at = [](const std::string& text, const std::string& line) {
    return fmt::format("(shell.toml:{})", line_of(text, line));
  };
  EXPECT_EQ(kinetics_origin(scene_of(small_scene)), "the default");
  EXPECT_EQ(kinetics_origin(scene_of(of_number)),
            "the default; kinetics.frequency " + at(of_number, "frequency ="));
  EXPECT_EQ(kinetics_origin(scene_of(of_material)),
            "material \"my-mix\" " + at(of_material, "[material.my-mix]"));
}

TEST(NamedMaterial, OfABodyIsAKeyThatStudiesChange) {
  const SceneFile file = scene_of(of_own + own_mix);
  const std::string key = "body.filling.material";
  EXPECT_EQ(std::get<std::string>(value_in(file, key)), "my-mix");
  const auto other = with_written_key(file, key, "comp-b", {});
  ASSERT_TRUE(other) << other.error().message();
  EXPECT_DOUBLE_EQ(other->scene.charge().initial_density(), 1717.0);
  const auto none = with_written_key(file, key, "my-mxi", {});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().suggestion, "\"my-mix\"");
}

/// The cup is of one steel and the wall of another.
TEST(NamedMaterial, OfTwoSteelsKeepTheirNumbersApart) {
  const std::string text = with(small_scene, "material = \"steel\"", "material = \"hard\"") + hard_steel;
  const SceneFile file = scene_of(text + "\n[steel]\nhardening = \"600 MPa\"\n");
  const Material* hard = find_material(file.scene, "hard");
  ASSERT_NE(hard, nullptr);
  EXPECT_EQ(file.scene.bodies[0].material, "hard");
  EXPECT_DOUBLE_EQ(std::get<Steel>(hard->law).strength.a, 1.2e9);
  EXPECT_DOUBLE_EQ(std::get<Steel>(hard->law).strength.b, Steel{}.strength.b);
  EXPECT_DOUBLE_EQ(file.scene.steel().strength.a,
                   std::get<double>(shipped_constants().front()->values.at("steel.yield_stress")));
  EXPECT_DOUBLE_EQ(file.scene.steel().strength.b, 600e6);
}

TEST(NamedMaterial, OfOneSteelIsTheSteelOfTheScene) {
  std::string text = small_scene;
  for (int body = 0; body < 3; ++body) text = with(text, "material = \"steel\"", "material = \"hard\"");
  const SceneFile file = scene_of(text + hard_steel);
  EXPECT_EQ(file.scene.bodies[0].material, "steel");
  EXPECT_DOUBLE_EQ(file.scene.steel().strength.a, 1.2e9);
}

TEST(NamedMaterial, IsReadFromAFileThatABodyNames) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "launchsafe-named-material";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "mix.toml") << with(shipped("comp-b"), "1.717 g/cm3", "1.65 g/cm3");
  const std::string text = with(small_scene, "material = \"charge\"", "material = \"mix.toml\"");
  const SceneFile file = scene_of(text, (folder / "shell.toml").string());
  EXPECT_DOUBLE_EQ(file.scene.charge().initial_density(), 1650.0);
  std::ofstream(folder / "mix.toml") << shipped("comp-b") << "\n[load]\npeak = \"300 MPa\"\n";
  const auto more = parse_scene(text, folder / "shell.toml");
  ASSERT_FALSE(more);
  EXPECT_EQ(more.error().key, "load.peak");
  EXPECT_TRUE(more.error().file.ends_with("mix.toml"));
  std::filesystem::remove_all(folder);
  const auto missing = parse_scene(text, folder / "shell.toml");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().key, "body.filling.material");
}

struct MaterialFault {
  const char* what;
  std::string text, key;
};
class FaultyMaterial : public ::testing::TestWithParam<MaterialFault> {};

TEST_P(FaultyMaterial, IsRefusedAtItsKey) {
  const auto file = parse_scene(GetParam().text, "shell.toml");
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().key, GetParam().key) << file.error().message();
  EXPECT_GT(file.error().line, 0) << file.error().message();
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, FaultyMaterial,
    ::testing::Values(
        MaterialFault{"a law that there is not",
                      of_own + with(own_mix, "law = \"charge\"", "law = \"explosive\""),
                      "material.my-mix.law"},
        MaterialFault{"no law", of_own + with(own_mix, "law = \"charge\"\n", ""), "material.my-mix.law"},
        MaterialFault{"a key of another law",
                      of_own + with(own_mix, "flaw_size =", "yield_stress = \"1 GPa\"\nflaw_size ="),
                      "material.my-mix.yield_stress"},
        MaterialFault{"a number that nobody gives", of_own + with(own_mix, "flaw_size =", "# "),
                      "material.my-mix.flaw_size"},
        MaterialFault{"a number out of range", of_own + with(own_mix, "1.65 g/cm3", "-1 g/cm3"),
                      "material.my-mix.density"},
        MaterialFault{"the name of a law",
                      small_scene + with(own_mix, "[material.my-mix]", "[material.steel]"), "material"},
        MaterialFault{"a second explosive",
                      with(of_comp_b, "material = \"steel\"", "material = \"pbx-9501\""),
                      "body.filling.material"},
        MaterialFault{"keys that mean neither of two steels",
                      with(with(with(small_scene, "material = \"steel\"", "material = \"hard\""),
                                "material = \"steel\"", "material = \"shell-steel\""),
                           "material = \"steel\"", "material = \"hard\"") +
                          "\n[steel]\nhardening = \"600 MPa\"\n" + hard_steel,
                      "steel.hardening"}));

}  // namespace
}  // namespace launchsafe::scene
