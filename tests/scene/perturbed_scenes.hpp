// Scenes that differ in one key, and which keys the mechanical part leaves out.
#pragma once

#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "small_shell.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace launchsafe::scene {

/// A small shell whose run takes milliseconds and makes its steel yield; more keys may be put before it, more
/// tables after it.
inline const std::string quick_scene = R"(
[gap]
thickness = "0, 0.01 cm"

[charge]
crack_radius = "100 um"
)" + testing::small_shell + testing::small_shell_base +
                                       testing::small_shell_point;
inline const std::string quick_numerics =
    "numerics.cell_size = \"5 mm\"\nnumerics.energy_drift_limit = 0.5\noutput.trace_interval = \"5 us\"\n"
    "load.duration = \"50 us\"\n";
inline const std::string analytic_load =
    "load.base = \"0 Pa\"\nload.peak = \"2 GPa\"\nload.peak_time = \"50 us\"\nload.exponent = 3\n"
    "load.shape = \"power-exponential\"\n";
inline const std::string measured_load =
    "load.curve_time = \"0, 10, 50 us\"\nload.curve_pressure = \"0, 1000, 2000 MPa\"\n";

/// A scene with its name, for messages.
struct NamedScene {
  std::string name;
  SceneFile file;
};

/// One scene for every reason that lets a key matter to the mechanics.
inline std::vector<NamedScene> quick_scenes() {
  const std::string common = quick_numerics, inert = "physics.bulk_reaction = \"off\"\n";
  const std::vector<std::pair<std::string, std::string>> texts{
      {"plain", inert + analytic_load},
      {"snapshots", inert + analytic_load + "output.snapshots = \"20, 50 us\"\n"},
      {"conduction", inert + analytic_load + "physics.conduction = \"on\"\n"},
      {"reaction", analytic_load + "physics.bulk_reaction = \"on\"\noutput.snapshots = \"50 us\"\n"},
      {"curve", inert + measured_load},
      {"rescaled curve", inert + measured_load + "load.rescale_to_peak = true\nload.peak = \"2.5 GPa\"\n"}};
  std::vector<NamedScene> scenes;
  for (const auto& [name, text] : texts) {
    const auto file = caught([&] { return parse_scene(common + text + quick_scene, name + ".toml"); });
    EXPECT_TRUE(file) << (file ? "" : file.error().message());
    if (file) scenes.push_back({name, *file});
  }
  return scenes;
}

/// Other values that a key may take.
inline std::vector<Value> other_values(const KeyDescription& key, const Value& value) {
  std::vector<Value> others;
  if (const auto* number = std::get_if<double>(&value)) {
    const bool count = key.dimension == Dimension::count;
    for (const double other : {count ? *number + 1.0 : *number * 1.1, *number * 0.9, *number + 1e-3}) {
      if (other != *number && key.limits.contain(other) && (!count || other == *number + 1.0))
        others.emplace_back(other);
    }
  } else if (const auto* flag = std::get_if<bool>(&value)) {
    others.emplace_back(!*flag);
  } else if (const auto* text = std::get_if<std::string>(&value)) {
    for (const std::string& word : key.words) {
      if (word != *text) others.emplace_back(word);
    }
    if (key.kind == KeyKind::text) others.emplace_back(*text + " of another name");
  } else {
    auto numbers = std::get<std::vector<double>>(value);
    for (double& each : numbers) each *= 0.9;
    if (!numbers.empty()) others.emplace_back(numbers);
  }
  return others;
}

/// All valid scenes with another value of one key.
inline std::vector<SceneFile> perturbed(const SceneFile& file, const Key<Scene>& key) {
  std::vector<SceneFile> scenes;
  for (const Value& value : other_values(key, key.get(file.scene))) {
    if (auto changed = caught([&] { return with_keys(file, {{key.name, value, Place{"test", 1, 1}}}); }))
      scenes.push_back(std::move(*changed));
  }
  return scenes;
}

/// Whether other values of a key leave the mechanical part as it is.
inline bool is_dropped(const SceneFile& file, const Key<Scene>& key) {
  const std::string part = to_toml(mechanical_part(file.scene));
  const auto others = perturbed(file, key);
  return !others.empty() && std::all_of(others.begin(), others.end(), [&](const SceneFile& other) {
    return to_toml(mechanical_part(other.scene)) == part;
  });
}

inline std::vector<std::string> dropped_keys(const SceneFile& file) {
  std::vector<std::string> names;
  for (const Key<Scene>& key : scene_keys()) {
    if (is_dropped(file, key)) names.push_back(key.name);
  }
  return names;
}

}  // namespace launchsafe::scene
