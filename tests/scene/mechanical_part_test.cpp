
#include "launchsafe/scene/plan.hpp"
#include "scene/perturbed_scenes.hpp"
#include "scene/scene_text.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace launchsafe::scene {
namespace {

using KeyNames = std::vector<std::string>;

/// The words of a text.
KeyNames names_in(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

/// The list without some of its names.
KeyNames without(KeyNames names, const KeyNames& kept) {
  std::erase_if(names, [&kept](const std::string& name) {
    return std::find(kept.begin(), kept.end(), name) != kept.end();
  });
  return names;
}

/// What a launch without snapshots, conduction and bulk reaction leaves out.
const KeyNames most_dropped = names_in(
    "title coupling load.exit_decay load.expected_velocity steel.conductivity steel.title "
    "charge.specific_heat charge.conductivity kinetics.heat_of_reaction kinetics.frequency "
    "kinetics.activation_temperature "
    "kinetics.ignition_temperature kinetics.burnt_temperature charge.title elastic.density "
    "elastic.bulk_modulus elastic.shear_modulus elastic.specific_heat elastic.conductivity "
    "elastic.title gap.thickness gap.skin_thickness gap.exchange_time gap.air_specific_heat "
    "gap.air_heat_ratio friction.closure friction.localisation combustion.duration "
    "combustion.stop_pressure");
const KeyNames conductivities{"steel.conductivity", "charge.conductivity"};
const KeyNames of_temperatures{"charge.specific_heat", "friction.closure"};
const KeyNames of_reaction = names_in(
    "kinetics.heat_of_reaction kinetics.frequency kinetics.activation_temperature "
    "kinetics.ignition_temperature kinetics.burnt_temperature");

/// A key that is new among these is a decision: tests/run/mechanical_part_test.cpp shows whether it is right.
TEST(MechanicalPart, LeavesOutTheseKeys) {
  KeyNames under_curve = most_dropped;
  const KeyNames of_shape{"load.base", "load.peak_time", "load.shape", "load.width", "load.steepness"};
  under_curve.insert(under_curve.begin() + 2, of_shape.begin(), of_shape.end());
  KeyNames under_own_curve = under_curve;
  under_own_curve.insert(under_own_curve.begin() + 2, "load.peak");
  const std::map<std::string, KeyNames> expected{
      {"plain", most_dropped},
      {"snapshots", without(most_dropped, of_temperatures)},
      {"conduction", without(without(most_dropped, of_temperatures), conductivities)},
      {"reaction", without(without(most_dropped, of_temperatures), of_reaction)},
      {"curve", under_own_curve},
      {"rescaled curve", under_curve}};
  for (const NamedScene& scene : quick_scenes())
    EXPECT_EQ(dropped_keys(scene.file), expected.at(scene.name)) << scene.name;
}

TEST(MechanicalPart, IsAValidSceneAndItsOwnMechanicalPart) {
  for (const auto& [name, file] : quick_scenes()) {
    const Scene part = mechanical_part(file.scene);
    const auto read = parse_scene(to_toml(part), "part.toml");
    EXPECT_EQ(to_toml(read.scene), to_toml(part)) << name;
    EXPECT_EQ(to_toml(mechanical_part(part)), to_toml(part)) << name;
    EXPECT_EQ(make_plan(part).conducts, make_plan(file.scene).conducts);
    EXPECT_EQ(make_plan(part).reacts, make_plan(file.scene).reacts);
  }
}

TEST(MechanicalPart, StatesWhatThePlanDecides) {
  const SceneFile automatic = quick_scenes().front().file;
  const Place place{"test", 1, 1};
  const auto off = caught([&] {
    return with_keys(automatic, {{"physics.conduction", std::string("off"), place}});
  });
  const auto on = caught([&] {
    return with_keys(automatic, {{"physics.conduction", std::string("on"), place}});
  });
  EXPECT_EQ(to_toml(mechanical_part(off->scene)), to_toml(mechanical_part(automatic.scene)));
  EXPECT_NE(to_toml(mechanical_part(on->scene)), to_toml(mechanical_part(off->scene)));
}

TEST(MechanicalPart, KnowsACurveByItsValues) {
  const std::string folder = ::testing::TempDir();
  for (const char* name : {"mechanical_part_a.csv", "mechanical_part_b.csv"})
    std::ofstream(folder + name) << "time_us,pressure_MPa\n0,0\n10,1000\n50,2000\n";
  const auto with_curve = [](const std::string& load) {
    const auto file = caught([&] { return parse_scene(quick_numerics + load + quick_scene, "scene.toml"); });
    EXPECT_TRUE(file) << (file ? "" : file.error().message());
    return file ? to_toml(mechanical_part(file->scene)) : std::string{};
  };
  const std::string written = with_curve(measured_load);
  EXPECT_EQ(with_curve("load.curve = \"" + folder + "mechanical_part_a.csv\"\n"), written);
  EXPECT_EQ(with_curve("load.curve = \"" + folder + "mechanical_part_b.csv\"\n"), written);
}

// It is a scene with one-way coupling, which would refuse them.
TEST(MechanicalPart, HasNoSnapshotsOfIgnitionAndOfWhatFollows) {
  Scene scene = quick_scenes().front().file.scene;
  scene.coupling = Coupling::two_way;
  scene.output.snapshot_times = {end_time(scene.load) + 1e-4, end_time(scene.load)};
  scene.output.snapshot_events = {Event::peak_pressure, Event::ignition};
  const Scene part = mechanical_part(scene);
  EXPECT_EQ(part.output.snapshot_times, std::vector{end_time(scene.load)});
  EXPECT_EQ(part.output.snapshot_events, std::vector{Event::peak_pressure});
  EXPECT_TRUE(caught([&] { return parse_scene(to_toml(part), "part.toml"); }));
}

TEST(MechanicalPart, IsTheSameHoweverTheSceneIsWritten) {
  const auto part_of = [](const std::string& text) {
    return to_toml(mechanical_part(parse_scene(text, "written.toml").scene));
  };
  for (const auto& [from, to] : {std::pair{"\"1 ms\"", "\" +1.00e3 us\""},
                                 {"\"0, 0.01 cm\"", "[\"0 m\", \"1e-4 m\"]"},
                                 {"x = \"4 to 5 cm\"", "x = \"40000 um to 0.05 m\"  # a comment"}})
    EXPECT_EQ(part_of(with(small_scene, from, to)), part_of(small_scene)) << to;
}

}  // namespace
}  // namespace launchsafe::scene
