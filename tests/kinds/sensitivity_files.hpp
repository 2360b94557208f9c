// The beginnings of study files of kind sensitivity, and what is expected of them.
#pragma once

#include "study/read_error.hpp"

namespace launchsafe::study {

/// Three lines.
inline const std::string sensitivity_start =
    "kind = \"sensitivity\"\nscene = \"scene_155mm.toml\"\ngaps = \"0.02 cm\"\n";

inline std::string input(const std::string& rest) { return "[[vary]]\n" + rest + "\n"; }

inline const std::string crack =
    input("key = \"crack_radius\"\ndistribution = \"uniform\"\nrange = \"10 to 100 um\"");

/// One [[vary]] after the first three lines; its own first line is line 5.
inline void expect_input_error(const std::string& rest, const ExpectedError& expected) {
  expect_error_in(sensitivity_start + input(rest), expected);
}

/// A case is the study's scene with the coordinates set, whatever it was built from.
inline void expect_scenes_of_coordinates(const StudyFile& file) {
  const scene::Place place{"a.toml", 1, 1};
  for (const StudyCase& each : file.cases) {
    scene::SceneFile expected = file.scene;
    for (std::size_t i = 0; i < each.coordinates.size(); ++i)
      expected = scene::with_keys(expected, {{file.study.axes[i].key.name, each.coordinates[i], place}});
    ASSERT_EQ(scene::to_toml(each.scene.scene), scene::to_toml(expected.scene)) << each.label;
  }
}

}  // namespace launchsafe::study
