// A small valid scene as text, for tests that break it in one place.
#pragma once

#include "launchsafe/scene/read_scene.hpp"
#include "small_shell.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace launchsafe::scene {

inline const std::string small_scene = R"([load]
duration = "1 ms"

[gap]
thickness = "0, 0.01 cm"
)" + testing::small_shell + testing::small_shell_point +
                                       testing::small_shell_base;

/// The bell that the published temperatures imply.
inline Load published_bell() {
  Load load;
  load.shape = LoadShape::bell;
  load.peak_time = 11.49e-3;
  load.width = 3.03e-3;
  load.steepness = 1.44;
  return load;
}

/// The text with its first `from` replaced by `to`.
inline std::string with(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// Line (from 1) on which `part` first stands.
inline int line_of(const std::string& text, std::string_view part) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(text.find(part));
  return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
}

/// The error of a scene text, read as "shell.toml".
inline InputError error_of(const std::string& text) {
  const auto file = caught([&] { return parse_scene(text, "shell.toml"); });
  EXPECT_FALSE(file) << "the scene was accepted";
  return file ? InputError{} : file.error();
}

/// Checks that an error names file, line, key and, where one is given, the value that was found.
inline void expect_error(const InputError& error, int line, std::string_view key,
                         std::string_view value = {}) {
  const std::string message = error.message();
  EXPECT_EQ(error.file, "shell.toml");
  EXPECT_EQ(error.line, line) << message;
  EXPECT_EQ(error.key, key) << message;
  EXPECT_NE(error.found.find(value), std::string::npos) << message;
  EXPECT_TRUE(message.starts_with("shell.toml:" + std::to_string(line) + ":")) << message;
}

/// A value of a key as written: "0.1 mm", "true", "comp-b".
inline Value written_value(const std::string& written, const KeyDescription& key) {
  const bool plain =
      key.kind == KeyKind::flag || (units_of(key.dimension).empty() && key.kind == KeyKind::number);
  const toml::table table = parse_toml(plain ? "key = " + written : "key = '" + written + "'", "value");
  return read_value(*table.get("key"), key, "value");
}

/// The scene with one key changed to a value as written.
inline Expected<SceneFile> with_written_key(const SceneFile& file, const std::string& name,
                                            const std::string& written, const Place& place) {
  return caught([&] {
    return with_keys(file, {{name, written_value(written, describe_key(file, name, place)), place}});
  });
}

}  // namespace launchsafe::scene
