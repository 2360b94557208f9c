#include "launchsafe/scene/read_scene.hpp"

#include "launchsafe/scene/plan.hpp"
#include "scene/scene_text.hpp"
#include "store/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace launchsafe::scene {
namespace {

const std::string shipped_file = LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml";

TEST(ReadScene, ShippedSceneIsTheOneOfTheModel) {
  const auto file = read_scene(shipped_file);
  const Scene& scene = file.scene;
  ASSERT_EQ(scene.bodies.size(), 4u);
  EXPECT_EQ(scene.bodies[1].material, "charge");
  EXPECT_EQ(scene.surface.gaps, (std::vector<double>{0.0, 1e-4, 2e-4, 3e-4, 3.9e-4, 4e-4}));
  ASSERT_EQ(scene.output.observation_points.size(), 13u);
  for (std::size_t i = 0; i < 13; ++i) {
    EXPECT_EQ(scene.output.observation_points[i].name, "G" + std::to_string(i + 1));
    EXPECT_EQ(scene.output.observation_points[i].x, 0.6775);
    EXPECT_NEAR(scene.output.observation_points[i].r, 0.0625 - 0.005 * static_cast<double>(i), 1e-15);
  }
  EXPECT_EQ(scene.load.peak, 496e6);
  EXPECT_GT(scene.charge().strength.face_friction, 0.0);
}

TEST(ReadScene, LaunchesTakeLongerStepsWhereThatWasMeasured) {
  const auto file = read_scene(shipped_file);
  EXPECT_EQ(file.scene.numerics.selective_inertia, 4.0);
  EXPECT_NE(to_toml(file.scene).find("numerics.selective_inertia = 4"), std::string::npos);
  const auto with = [&](const char* key, const char* value) {
    const auto changed = with_written_key(file, key, value, {});
    EXPECT_TRUE(changed) << key;
    return changed ? changed->scene.numerics.selective_inertia : 0.0;
  };
  EXPECT_EQ(with("coupling", "two-way"), 1.0);
  EXPECT_EQ(with("numerics.inertial_scaling", "4"), 1.0);
  // A measured curve has true inertia. One that rises or falls within 0.3 ms is too fast besides.
  const auto is_fast = [](const char* times) {
    const auto curve = caught([&] {
      return parse_scene(std::string("load.curve_time = \"") + times +
                             "\"\nload.curve_pressure = \"0, 200, 20 MPa\"\n" + testing::small_shell +
                             testing::small_shell_base,
                         "curve.toml");
    });
    EXPECT_TRUE(curve) << (curve ? "" : curve.error().message());
    EXPECT_EQ(curve->scene.numerics.selective_inertia, 1.0);
    return changes_too_fast_for_selective_inertia(curve->scene);
  };
  EXPECT_TRUE(is_fast("0, 0.3, 9 ms"));
  EXPECT_TRUE(is_fast("0, 6, 6.3 ms"));
  EXPECT_FALSE(is_fast("0, 3, 9 ms"));
  // What is stated stays, and is written even where it is what a scene has by default.
  EXPECT_EQ(with("numerics.selective_inertia", "1"), 1.0);
  const auto exact = with_written_key(file, "numerics.selective_inertia", "1", {});
  EXPECT_EQ(parse_scene(to_toml(exact->scene), "again.toml").scene.numerics.selective_inertia, 1.0);
}

TEST(ReadScene, WrittenSceneReadsBackToTheSame) {
  auto file = read_scene(shipped_file);
  file.scene.surface.localisation = 1.0 / 3.0;
  file.scene.title = "a \"quoted\" title\nof two lines";
  file.scene.load.curve_time = {0.0, 1e-3, 0.018};
  file.scene.load.curve_pressure = {1e5, 1e8, 2e8 / 3.0};
  file.scene.output.snapshot_times = {0.0, 5e-3};
  file.scene.charge().strength.face_friction = 0.0;
  const std::string text = to_toml(file.scene);
  const auto again = parse_scene(text, "again.toml");
  EXPECT_EQ(to_toml(again.scene), text);
  EXPECT_EQ(again.scene.surface.localisation, 1.0 / 3.0);
  EXPECT_EQ(again.scene.title, file.scene.title);
}

TEST(ReadScene, MissingFileIsNamedWithTheNearestOne) {
  const auto file = caught([&] { return read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155m.toml"); });
  ASSERT_FALSE(file);
  const std::string message = file.error().message();
  EXPECT_NE(message.find("scene_155m.toml:"), std::string::npos) << message;
  EXPECT_NE(message.find("scene_155mm.toml"), std::string::npos) << message;
  EXPECT_FALSE(caught([&] { return read_scene(LAUNCHSAFE_SOURCE_DIR "/studies"); }));
  EXPECT_FALSE(caught([&] { return read_scene("no such folder/scene.toml"); }));
}

/// What is wrong in a scene, and the key and value that its error names. The line is that on which `at`
/// stands.
struct Fault {
  const char* from;  ///< of the small scene; empty: `to` is put before it
  const char* to;
  const char* at;
  const char* key;
  const char* value = "";
  const char* suggestion = "";
};

const Fault faults[] = {
    {"duration", "duratoin", "duratoin", "load.duratoin", "", "load.duration"},
    {"r = \"0 to 1.5 cm\"", "r = \"0 to 1.5 cm\"\nradius = 3", "radius", "body.radius"},
    {"[gap]", "[gapp]", "thickness", "gapp.thickness", "", "gap.thickness"},
    {"\"1 ms\"", "\"1 mm\"", "1 mm", "load.duration"},
    {"material = \"steel\"", "material = \"stele\"", "stele", "body.cup.material", "\"stele\"", "\"steel\""},
    {"x = \"0 to 1 cm\"", "x = \"1 cm\"", "x = ", "body.x"},
    {"r = \"0 to 2 cm\"", "r = \"-1 to 2 cm\"", "-1 to", "body.r", "-1 to 2 cm"},
    {"", "numerics.cell_size = \"-1 mm\"\n", "-1 mm", "numerics.cell_size", "-1 mm"},
    {"r = \"0 to 2 cm\"", "r = \"2 to 2 cm\"", "2 to 2", "body.r"},
    {"r = \"0 to 1.5 cm\"", "r = \"0 to 2.5 cm\"", "1.5 to 2 cm", "body.wall.r"},
    {"x = \"1 to 4 cm\"", "x = \"1 to 6 cm\"", "x = \"4 to", "body.base.x"},
    {"r = \"1.5 to 2 cm\"", "r = \"1.4 to 2 cm\"", "1.4 to", "body.wall.r"},
    {"", "numerics.cell_size = \"1.5 cm\"\n", "1.5 cm", "numerics.cell_size"},
    {"0, 0.01 cm", "0, 0.01, 0.02, 0.01 cm", "thickness", "gap.thickness"},
    {"0, 0.01 cm", "0, -0.01 cm", "thickness", "gap.thickness", "-0.01 cm"},
    {"\"0, 0.01 cm\"", "[]", "thickness", "gap.thickness"},
    {"", "kinetics.ignition_temperature = \"800 K\"\n", "800", "kinetics.ignition_temperature", "800 K"},
    {"r = \"1 cm\"", "r = \"1.6 cm\"", "1.6 cm", "observation_point.G1.r", "r 1.6 cm"},
    {"", "numerics.time_step_factor = 2.1\n", "2.1", "numerics.time_step_factor", "2.1"},
    {"", "output.snapshots = \"0, 2 ms\"\n", "2 ms", "output.snapshots", "2 ms"},
    {"duration = \"1 ms\"", "duration = \"1 ms", "duration", ""},
};

TEST(ReadScene, FaultsNameLineKeyFoundAllowedAndTheNearest) {
  for (const Fault& fault : faults) {
    const std::string from = fault.from, to = fault.to;
    const std::string text = from.empty() ? to + small_scene : with(small_scene, from, to);
    const InputError error = error_of(text);
    expect_error(error, line_of(text, fault.at), fault.key, fault.value);
    EXPECT_EQ(error.suggestion.find(fault.suggestion), 0u) << error.message();
  }
  EXPECT_EQ(error_of(with(small_scene, "[[body]]", "[[bodies]]")).suggestion, "");
  EXPECT_EQ(error_of(with(small_scene, "material = \"charge\"\n", "")).key, "body.material");
  EXPECT_TRUE(
      caught([&] { return parse_scene("numerics.cell_size = \"1 cm\"\n" + small_scene, "shell.toml"); }));
  EXPECT_TRUE(
      caught([&] { return parse_scene("numerics.time_step_factor = 2\n" + small_scene, "shell.toml"); }));
}

TEST(ReadScene, TwoWayCouplingNeedsTheTotalLagrangianForm) {
  const std::string two_way = "coupling = \"two-way\"\n";
  EXPECT_TRUE(caught([&] { return parse_scene(two_way + small_scene, "shell.toml"); }));
  expect_error(error_of(two_way + "numerics.formulation = \"updated-lagrangian\"\n" + small_scene), 1,
               "coupling");
}

TEST(ReadScene, ACurveInTheSceneMustLastUntilTheEnd) {
  const auto text =
      "load.curve_time = \"0, 0.5 ms\"\nload.curve_pressure = \"0, 300 MPa\"\nload.duration = \"1 ms\"\n" +
      with(small_scene, "[load]\nduration = \"1 ms\"\n", "");
  expect_error(error_of(text), 1, "load.curve_time", "0.5 ms");
}

TEST(ReadScene, NumbersOfTheOtherShapeAreRefused) {
  const std::string bell = "load.shape = \"bell\"\n", power = "load.shape = \"power-exponential\"\n";
  const std::string shell = with(small_scene, "[load]\nduration = \"1 ms\"\n", "load.duration = \"1 ms\"\n");
  const auto of = [&](const std::string& load) { return error_of(load + shell); };
  EXPECT_TRUE(caught([&] {
    return parse_scene(bell + "load.width = \"3 ms\"\nload.steepness = 1.4\n" + shell, "shell.toml");
  }));
  EXPECT_TRUE(caught([&] { return parse_scene(power + "load.exponent = 12\n" + shell, "shell.toml"); }));
  expect_error(of(bell + "load.exponent = 12\n"), 2, "load.exponent", "\"bell\"");
  expect_error(of(power + "load.width = \"3 ms\"\n"), 2, "load.width", "\"power-exponential\"");
  expect_error(of(power + "load.steepness = 2\n"), 2, "load.steepness");
  expect_error(of(bell + "load.width = \"0 ms\"\n"), 2, "load.width", "0 ms");
  expect_error(of(bell + "load.steepness = -1\n"), 2, "load.steepness", "-1");
}

TEST(ReadScene, EventsOfSnapshotsAreWordsInAnyOrder) {
  const auto file = caught([&] {
    return parse_scene("output.snapshot_events = \"ignition,peak-pressure\"\n" + small_scene, "small.toml");
  });
  ASSERT_TRUE(file) << file.error().message();
  EXPECT_EQ(file->scene.output.snapshot_events, (std::vector{Event::peak_pressure, Event::ignition}));
  EXPECT_NE(to_toml(file->scene).find("snapshot_events = 'peak-pressure, ignition'"), std::string::npos);
  EXPECT_EQ(to_toml(parse_scene(small_scene, "small.toml").scene).find("snapshot_events"), std::string::npos)
      << "what has no events stays what it was";
  const auto faulty = [](const std::string& words) {
    return error_of("output.snapshot_events = \"" + words + "\"\n" + small_scene);
  };
  expect_error(faulty("peak-presure"), 1, "output.snapshot_events");
  expect_error(faulty("ignition, ignition"), 1, "output.snapshot_events");
}

TEST(ReadScene, NamesMustBeUnique) {
  const auto text = with(small_scene, "\"wall\"", "\"cup\"");
  expect_error(error_of(text), line_of(text, "x = \"1 to 4 cm\"\nr = \"1.5 to 2") - 2, "body.cup.name",
               "\"cup\"");
}

TEST(ReadScene, SteelAloneIsASceneWithoutGaps) {
  const std::string bar =
      "[[body]]\nname = \"bar\"\nmaterial = \"steel\"\nx = \"0 to 10 cm\"\nr = \"0 to 1 cm\"\n";
  EXPECT_TRUE(caught([&] { return parse_scene(bar, "shell.toml"); }));
  expect_error(error_of("gap.thickness = \"0.1 mm\"\n" + bar), 1, "gap.thickness");
  const InputError empty = error_of("title = \"nothing\"");
  EXPECT_EQ(empty.key, "body");
  EXPECT_EQ(empty.found, "no body");
}

/// A scene with lines of [load] beside a curve, gun.csv.
class CurveFile : public testing::TemporaryFolder {
 protected:
  Expected<SceneFile> shell_with(const std::string& load, const std::string& curve) const {
    std::ofstream(folder() / "gun.csv") << "time_ms,pressure_MPa\n" + curve;
    std::ofstream(folder() / "shell.toml") << with(small_scene, "[load]", "[load]\n" + load);
    return caught([&] { return read_scene(folder() / "shell.toml"); });
  }
};

TEST_F(CurveFile, IsFoundBesideTheSceneAndHasAPeakOfItsOwn) {
  const std::string curve = "0,0.1\n0.5,300\n1,10\n";
  const auto file = shell_with("curve = \"gun.csv\"", curve);
  ASSERT_TRUE(file) << file.error().message();
  EXPECT_EQ(file->scene.load.curve_pressure, (std::vector<double>{1e5, 3e8, 1e7}));
  EXPECT_EQ(PressureHistory(file->scene.load).at(5e-4), 3e8);
  const auto scaled = shell_with("curve = \"gun.csv\"\nrescale_to_peak = true\npeak = \"400 MPa\"", curve);
  ASSERT_TRUE(scaled) << scaled.error().message();
  EXPECT_EQ(PressureHistory(scaled->scene.load).peak(), 4e8);
}

TEST_F(CurveFile, FaultsNameFileLineAndKey) {
  struct {
    const char *load, *curve, *file, *key;
    int line;
  } const faults[] = {
      {"curve = \"gunn.csv\"", "0,0.1\n0.5,300\n1,10\n", "shell.toml", "load.curve", 2},
      {"curve = \"gun.csv\"\npeak = \"400 MPa\"", "0,0.1\n0.5,300\n1,10\n", "shell.toml", "load.peak", 3},
      {"curve = \"gun.csv\"", "0,0.1\n0.5,300\n0.9,10\n", "shell.toml", "load.curve", 2},
      {"curve = \"gun.csv\"", "0,0.1\n0.5,nan\n", "gun.csv", "pressure", 3}};
  for (const auto& [load, curve, name, key, line] : faults) {
    const auto file = shell_with(load, curve);
    ASSERT_FALSE(file) << load;
    EXPECT_TRUE(file.error().file.ends_with(name)) << file.error().message();
    EXPECT_EQ(file.error().key, key) << file.error().message();
    EXPECT_EQ(file.error().line, line) << file.error().message();
  }
  EXPECT_NE(shell_with("curve = \"gunn.csv\"", "").error().suggestion.find("gun.csv"), std::string::npos);
}

}  // namespace
}  // namespace launchsafe::scene
