// Materials as data: their tables, files and shipped ones, where their numbers come from, and what bodies
// make of their names.
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "scene/scene_text.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace launchsafe::scene {
namespace {

SceneFile scene_of(const std::string& text, const std::string& path = "shell.toml") {
  auto file = parse_scene(text, path);
  EXPECT_TRUE(file) << (file ? "" : file.error().message()) << text;
  return file ? *file : SceneFile{};
}

const std::string of_comp_b = with(small_scene, "material = \"charge\"", "material = \"comp-b\"");
const std::string of_own = with(small_scene, "material = \"charge\"", "material = \"my-mix\"");
const std::string own_mix =
    "\n[material.my-mix]\nlaw = \"charge\"\nlike = \"comp-b\"\ntitle = \"Mix 7\"\ndensity = \"1.65 g/cm3\"\n"
    "toughness = \"0.4 MPa m^0.5\"\nkinetics.ignition_temperature = \"500 K\"\n"
    "source = [ { keys = \"density\", citation = \"our certificate 12\" } ]\n";
const std::string hard_steel =
    "\n[material.hard]\nlaw = \"steel\"\nlike = \"shell-steel\"\nyield_stress = \"1.2 GPa\"\n";

TEST(NamedMaterial, ThatShipsGivesANumberAndASourceOfEveryKey) {
  ASSERT_GE(shipped_materials().size(), 3U);
  for (const NamedMaterial& material : shipped_materials()) {
    EXPECT_FALSE(material.title.empty()) << material.name;
    for (const auto& [key, given] : material.values) {
      const Source* source = source_of(material.sources, key);
      ASSERT_NE(source, nullptr) << material.name << " " << key;
      EXPECT_GT(source->citation.size(), 10U) << material.name << " " << key;
      EXPECT_TRUE(is_plausible(*find_key(scene_keys(), key), given.value)) << material.name << " " << key;
    }
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
  EXPECT_EQ(to_toml(plain), to_toml(expected));
  EXPECT_EQ(to_toml(mechanical_part(named.scene)), to_toml(mechanical_part(usual.scene)));
  EXPECT_FALSE(named.given.contains("kinetics.ignition_temperature"));
  EXPECT_EQ(named.scene.material<Charge>().title, "Composition B of the published launches");
}

TEST(NamedMaterial, OfTheSceneIsTheChargeWithItsNumbersSourcesAndTitle) {
  const SceneFile file = scene_of(of_own + own_mix);
  EXPECT_DOUBLE_EQ(file.scene.charge().initial_density(), 1650.0);
  EXPECT_DOUBLE_EQ(file.scene.charge().strength.toughness, 4e5);
  EXPECT_DOUBLE_EQ(file.scene.charge().kinetics.ignition_temperature, 500.0);
  EXPECT_DOUBLE_EQ(file.scene.charge().specific_heat, 1780.0);  // of comp-b, which it is like
  EXPECT_EQ(file.scene.material<Charge>().title, "Mix 7");
  ASSERT_NE(source_of(file.scene.sources, "charge.density"), nullptr);
  EXPECT_EQ(source_of(file.scene.sources, "charge.density")->citation, "our certificate 12");
  EXPECT_EQ(source_of(file.scene.sources, "charge.specific_heat")->standing, Standing::assumed);
  EXPECT_EQ(source_of(file.scene.sources, "charge.toughness"), nullptr);
  for (const ListedKey& key : list_keys(file)) {
    if (key.name == "charge.density") {
      EXPECT_EQ(key.citation, "our certificate 12");
    }
    if (key.name == "charge.toughness") {
      EXPECT_EQ(key.standing, Standing::input);
    }
  }
}

TEST(NamedMaterial, ReadsBackFromTheWrittenScene) {
  for (const std::string& text :
       {of_own + own_mix, with(of_comp_b, "material = \"steel\"", "material = \"hard\"") + hard_steel}) {
    const std::string written = to_toml(scene_of(text).scene);
    EXPECT_EQ(to_toml(scene_of(written).scene), written);
  }
}

/// A value that is not the material's is not the source's either.
TEST(NamedMaterial, YieldsToTheTablesOfTheSceneAndLosesTheirSource) {
  const SceneFile file = scene_of(of_own + "\n[charge]\ndensity = \"1.7 g/cm3\"\n" + own_mix);
  EXPECT_DOUBLE_EQ(file.scene.charge().initial_density(), 1700.0);
  EXPECT_EQ(source_of(file.scene.sources, "charge.density"), nullptr);
  const auto changed = with_written_key(scene_of(of_own + own_mix), "charge.density", "1.6 g/cm3", {});
  ASSERT_TRUE(changed);
  EXPECT_DOUBLE_EQ(changed->scene.charge().initial_density(), 1600.0);
  EXPECT_EQ(source_of(changed->scene.sources, "charge.density"), nullptr);
  EXPECT_NE(source_of(changed->scene.sources, "charge.specific_heat"), nullptr);
}

const std::string hot_mix =
    "\n[material.my-mix]\nlaw = \"charge\"\nlike = \"comp-b\"\nkinetics.activation_temperature = \"15000 "
    "K\"\n";

TEST(NamedMaterial, ReactsByItsOwnKinetics) {
  const SceneFile hot = scene_of(of_own + hot_mix);
  EXPECT_EQ(hot.scene.charge().kinetics.activation_temperature, 15000.0);
  EXPECT_EQ(hot.scene.charge().kinetics.frequency, Charge{}.kinetics.frequency);
  const SceneFile pbx = scene_of(with(small_scene, "material = \"charge\"", "material = \"pbx-9501\""));
  EXPECT_EQ(pbx.scene.charge().kinetics.activation_temperature, 26520.0);
  EXPECT_EQ(pbx.scene.charge().kinetics.frequency, 5e19);
  EXPECT_EQ(pbx.scene.charge().kinetics.heat_of_reaction, 2.09e6);
}

TEST(NamedMaterial, IsNotGivenOtherKineticsByTheScene) {
  for (const auto& [key, value] : {std::pair{"set", "comp-b"},
                                   {"set", "printed"},
                                   {"activation_temperature", "27000 K"},
                                   {"frequency", "1e18 1/s"},
                                   {"heat_of_reaction", "5 MJ/kg"},
                                   {"ignition_temperature", "600 K"},
                                   {"burnt_temperature", "800 K"}}) {
    const std::string line = fmt::format("{} = \"{}\"", key, value),
                      text = of_own + "\n[kinetics]\n" + line + "\n" + hot_mix;
    const bool of_hot = key == std::string("set") || key == std::string("activation_temperature");
    const InputError error = error_of(text);
    EXPECT_EQ(error.key, std::string("kinetics.") + key) << error.message();
    EXPECT_EQ(error.line, line_of(text, line)) << error.message();
    const std::string material =
        of_hot ? fmt::format("shell.toml:{}", line_of(text, "kinetics.act")) : "the shipped comp-b.toml:";
    EXPECT_NE(error.message().find(material), std::string::npos) << error.message();
  }
  const std::string pbx = with(small_scene, "material = \"charge\"", "material = \"pbx-9501\"");
  EXPECT_EQ(error_of(pbx + "\n[kinetics]\nset = \"comp-b\"\n").key, "kinetics.set");
  for (const char* same : {"frequency = \"2.01e18 1/s\"", "burnt_temperature = \"784 K\""})
    EXPECT_EQ(scene_of(of_own + "\n[kinetics]\n" + same + "\n" + hot_mix)
                  .scene.charge()
                  .kinetics.activation_temperature,
              15000.0);
  scene_of(of_comp_b + "\n[kinetics]\nset = \"comp-b\"\n");
}

/// What calibrations find of it, the ignition temperature, is theirs to set.
TEST(NamedMaterial, IsGivenOtherKineticsByStudiesUnderItsName) {
  const SceneFile hot = scene_of(of_own + hot_mix);
  const Place study{"study.toml", 3};
  for (const auto& [key, value] : {std::pair{"kinetics.set", "comp-b"}, {"kinetics.frequency", "1e18 1/s"}}) {
    const auto refused = with_written_key(hot, key, value, study);
    ASSERT_FALSE(refused) << key;
    EXPECT_EQ(refused.error().file, "study.toml");
    EXPECT_EQ(refused.error().key, key);
  }
  const auto later = with_written_key(hot, "kinetics.ignition_temperature", "540 K", study);
  ASSERT_TRUE(later) << later.error().message();
  EXPECT_EQ(later->scene.charge().kinetics.ignition_temperature, 540.0);
  const auto other = with_written_key(hot, "material.my-mix.kinetics.frequency", "1e18 1/s", study);
  ASSERT_TRUE(other) << other.error().message();
  EXPECT_EQ(other->scene.charge().kinetics.frequency, 1e18);
  // A body of another material beside a line of the scene, too.
  const SceneFile usual = scene_of(small_scene + "\n[kinetics]\nset = \"comp-b\"\n");
  EXPECT_FALSE(with_written_key(usual, "body.filling.material", "pbx-9501", study));
}

TEST(NamedMaterial, AndNamedSetsAndKeysAreTheOriginsOfKinetics) {
  const std::string of_set = small_scene + "\n[kinetics]\nset = \"printed\"\n",
                    of_number = of_set + "frequency = \"1e18 1/s\"\n", of_material = of_own + hot_mix;
  const auto at = [](const std::string& text, const std::string& line) {
    return fmt::format("(shell.toml:{})", line_of(text, line));
  };
  EXPECT_EQ(kinetics_origin(scene_of(small_scene)), "named set \"comp-b\", the default");
  const std::string set = "named set \"printed\" " + at(of_set, "set =");
  EXPECT_EQ(kinetics_origin(scene_of(of_set)), set);
  EXPECT_EQ(kinetics_origin(scene_of(of_number)),
            set + "; kinetics.frequency " + at(of_number, "frequency ="));
  const std::string material = "material \"my-mix\" " + at(of_material, "[material.my-mix]");
  EXPECT_EQ(kinetics_origin(scene_of(of_material)), material);
  const auto changed = with_written_key(scene_of(of_material), "material.my-mix.kinetics.heat_of_reaction",
                                        "5 MJ/kg", {"a/study.toml", 3});
  ASSERT_TRUE(changed);
  EXPECT_EQ(kinetics_origin(*changed),
            material + "; material.my-mix.kinetics.heat_of_reaction (study.toml:3)");
  EXPECT_TRUE(
      kinetics_origin(scene_of(of_comp_b)).starts_with("material \"comp-b\" (the shipped comp-b.toml:"));
}

TEST(NamedMaterial, OfABodyIsAKeyThatStudiesChange) {
  const SceneFile file = scene_of(of_own + own_mix);
  const auto body = std::find_if(file.scene.bodies.begin(), file.scene.bodies.end(),
                                 [&](const Body& each) { return is_charge(file.scene, each); });
  ASSERT_NE(body, file.scene.bodies.end());
  const std::string key = "body." + body->name + ".material";
  EXPECT_EQ(std::get<std::string>(value_in(file, key)), "my-mix");
  const auto other = with_written_key(file, key, "comp-b", {});
  ASSERT_TRUE(other) << other.error().message();
  EXPECT_DOUBLE_EQ(other->scene.charge().initial_density(), 1717.0);
  EXPECT_DOUBLE_EQ(other->scene.charge().kinetics.ignition_temperature,
                   Charge{}.kinetics.ignition_temperature);
  const auto number = with_written_key(file, "material.my-mix.toughness", "0.3 MPa m^0.5", {});
  ASSERT_TRUE(number) << number.error().message();
  EXPECT_DOUBLE_EQ(number->scene.charge().strength.toughness, 3e5);
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
  EXPECT_DOUBLE_EQ(file.scene.steel().strength.a, Steel{}.strength.a);
  EXPECT_DOUBLE_EQ(file.scene.steel().strength.b, 600e6);
  const auto soft = with_written_key(file, "material.hard.yield_stress", "100 MPa", {});
  ASSERT_TRUE(soft) << soft.error().message();
  const std::vector<Implausible> judged = implausible_values(soft->scene);
  EXPECT_TRUE(std::any_of(judged.begin(), judged.end(),
                          [](const Implausible& each) { return each.key == "material.hard.yield_stress"; }));
}

TEST(NamedMaterial, OfOneSteelIsTheSteelOfTheScene) {
  std::string text = small_scene;
  for (int body = 0; body < 3; ++body) text = with(text, "material = \"steel\"", "material = \"hard\"");
  const SceneFile file = scene_of(text + hard_steel);
  EXPECT_EQ(file.scene.bodies[0].material, "steel");
  EXPECT_DOUBLE_EQ(file.scene.steel().strength.a, 1.2e9);
}

TEST(NamedMaterial, IsReadFromAFileOfItsOwn) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "launchsafe-named-material";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "mixes.toml") << own_mix;
  const std::string text = "material_file = \"mixes.toml\"\n" + of_own;
  EXPECT_DOUBLE_EQ(scene_of(text, (folder / "shell.toml").string()).scene.charge().initial_density(), 1650.0);
  std::ofstream(folder / "mixes.toml") << own_mix << "\n[load]\npeak = \"300 MPa\"\n";
  const auto more = parse_scene(text, folder / "shell.toml");
  ASSERT_FALSE(more);
  EXPECT_EQ(more.error().key, "load.peak");
  EXPECT_TRUE(more.error().file.ends_with("mixes.toml"));
  std::filesystem::remove_all(folder);
  const auto missing = parse_scene(text, folder / "shell.toml");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().key, "material_file");
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
        MaterialFault{"a key of another law", of_own + own_mix + "yield_stress = \"1 GPa\"\n",
                      "material.my-mix.yield_stress"},
        MaterialFault{"numbers that nobody gives", of_own + with(own_mix, "like = \"comp-b\"\n", ""),
                      "material.my-mix.crack_radius"},
        MaterialFault{"like a steel", of_own + with(own_mix, "\"comp-b\"", "\"shell-steel\""),
                      "material.my-mix.like"},
        MaterialFault{"like nothing", of_own + with(own_mix, "\"comp-b\"", "\"comp-c\""),
                      "material.my-mix.like"},
        MaterialFault{"like itself", of_own + with(own_mix, "\"comp-b\"", "\"my-mix\""),
                      "material.my-mix.like"},
        MaterialFault{"a number out of range", of_own + with(own_mix, "1.65 g/cm3", "-1 g/cm3"),
                      "material.my-mix.density"},
        MaterialFault{"a source of a number that it has not",
                      of_own + with(own_mix, "keys = \"density\"", "keys = \"conductivity\""),
                      "material.my-mix.source.keys"},
        MaterialFault{"a source without words", of_own + with(own_mix, "our certificate 12", " "),
                      "material.my-mix.source.citation"},
        MaterialFault{"the name of a law",
                      of_own + "\n[material.charge]\nlaw = \"charge\"\nlike = \"comp-b\"\n" + own_mix,
                      "material"},
        MaterialFault{"the name of a shipped one",
                      of_own + "\n[material.comp-b]\nlaw = \"charge\"\nlike = \"comp-b\"\n" + own_mix,
                      "material"},
        MaterialFault{
            "two explosives",
            of_own + own_mix +
                "\n[[body]]\nname = \"booster\"\nmaterial = \"comp-b\"\nx = \"0 to 1 cm\"\nr = \"0 to 1 "
                "cm\"\n",
            "body.booster.material"},
        MaterialFault{"a key of steel beside two named ones",
                      with(with(with(small_scene, "\"steel\"", "\"hard\""), "\"steel\"", "\"shell-steel\""),
                           "\"steel\"", "\"shell-steel\"") +
                          "\n[steel]\nhardening = \"600 MPa\"\n" + hard_steel,
                      "steel.hardening"}),
    [](const auto& instance) {
      std::string name = instance.param.what;
      for (char& c : name)
        if (c == ' ') c = '_';
      return name;
    });

const std::string smooth_wall = "\n[interface.wall]\ncontact = \"smooth\"\n";

TEST(NamedContact, GivesWhatAnInterfaceDoesNotSay) {
  const SceneFile file = scene_of(small_scene + smooth_wall);
  ASSERT_EQ(file.scene.interfaces.size(), 1U);
  EXPECT_EQ(file.scene.interfaces[0].condition, Condition::sliding);
  EXPECT_EQ(file.scene.interfaces[0].friction, 0.0);
  ASSERT_NE(source_of(file.scene.sources, "interface.wall.friction"), nullptr);
  const SceneFile rough = scene_of(small_scene + smooth_wall + "friction = 0.2\n");
  EXPECT_EQ(rough.scene.interfaces[0].friction, 0.2);
  EXPECT_EQ(source_of(rough.scene.sources, "interface.wall.friction"), nullptr);
  EXPECT_NE(source_of(rough.scene.sources, "interface.wall.condition"), nullptr);
  const SceneFile own = scene_of(small_scene +
                                 "\n[interface.wall]\ncontact = \"lacquer\"\n[contact.lacquer]\ncondition = "
                                 "\"sliding\"\nfriction = 0.3\n");
  EXPECT_EQ(own.scene.interfaces[0].friction, 0.3);
  EXPECT_EQ(to_toml(scene_of(to_toml(own.scene)).scene), to_toml(own.scene));
  // The numbers count, not the name.
  EXPECT_EQ(
      to_toml(mechanical_part(file.scene)),
      to_toml(mechanical_part(
          scene_of(small_scene + "\n[interface.wall]\ncondition = \"sliding\"\nfriction = 0\n").scene)));
}

TEST(NamedContact, ThatIsUnknownOrTakenIsRefused) {
  const InputError unknown = error_of(small_scene + "\n[interface.wall]\ncontact = \"smoth\"\n");
  EXPECT_EQ(unknown.key, "interface.wall.contact");
  EXPECT_EQ(unknown.suggestion, "smooth");
  EXPECT_EQ(error_of(small_scene + smooth_wall + "\n[contact.smooth]\ncondition = \"bonded\"\n").key,
            "contact");
  EXPECT_EQ(error_of(small_scene + "\n[interface.wall]\nfriction = 0.1\n").key, "interface.wall.condition");
}

TEST(NamedContact, ThatShipsHasASourceOfEveryKeyThatItGives) {
  ASSERT_GE(shipped_contacts().size(), 2U);
  for (const NamedContact& contact : shipped_contacts())
    for (const Key<Interface>& key : interface_keys())
      if (!key.is_written || key.is_written(contact.faces)) {
        EXPECT_NE(source_of(contact.sources, key.name), nullptr) << contact.name << key.name;
      }
}

TEST(Sources, OfASceneSpeakOfItsValues) {
  const std::string cited =
      small_scene + "\n[[source]]\nkeys = \"load.peak, gap.thickness\"\ncitation = \"proof shot 12\"\n";
  const SceneFile file = scene_of(cited);
  EXPECT_EQ(source_of(file.scene.sources, "load.peak")->citation, "proof shot 12");
  EXPECT_EQ(to_toml(scene_of(to_toml(file.scene)).scene), to_toml(file.scene));
  EXPECT_EQ(to_toml(mechanical_part(file.scene)), to_toml(mechanical_part(scene_of(small_scene).scene)));
  const auto changed = with_written_key(file, "load.peak", "321 MPa", {});
  ASSERT_TRUE(changed);
  EXPECT_EQ(source_of(changed->scene.sources, "load.peak"), nullptr);
  EXPECT_NE(source_of(changed->scene.sources, "gap.thickness"), nullptr);
  const auto unknown = parse_scene(with(cited, "load.peak, gap", "load.peek, gap"), "shell.toml");
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().suggestion, "load.peak");
}

}  // namespace
}  // namespace launchsafe::scene
