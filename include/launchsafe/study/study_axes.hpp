// The scene keys that a study varies.
#pragma once

#include "launchsafe/study/study_faults.hpp"

#include <string>
#include <vector>

namespace launchsafe::study {

/// A key of a table by its dotted name.
struct Leaf {
  std::string name;
  const toml::node* node = nullptr;
};
/// All keys of a table and of the tables in it, as people wrote them: toml++ sorts a table by key.
std::vector<Leaf> leaves_as_written(const toml::table& table);

/// Short names of scene keys that studies vary most, and the scene keys.
struct NamedAxis {
  std::string name;
  std::string key;
};
const std::vector<NamedAxis>& named_axes();

/// The short name of a scene key, or else its own.
std::string name_of_axis(const std::string& scene_key);

/// The scene key behind a short or full name: one that takes one number. Faults name `faulty_key`.
scene::Expected<scene::KeyDescription> varied_key(const StudyFile& study, const std::string& name,
                                                  const std::string& faulty_key, const scene::Place& place);

/// The value of a scene key that takes one number, SI.
double number_in(const scene::SceneFile& file, const std::string& key);

/// Adds an axis over those values (SI) of a key, by its short or full name; none where there are no values. A
/// fault where one stands twice.
Fault add_axis(StudyFile& study, const std::string& name, const std::string& study_key,
               std::vector<double> values);

/// A scene key that is to vary and is fixed elsewhere, or varies already; it was asked for at a place under a
/// name.
Fault check_free(const StudyFile& study, const std::string& scene_key, const scene::Place& place,
                 const std::string& faulty_key);

/// Axes that cannot have an effect: those of the analytic load under a measured curve.
Fault check_load_axes(const StudyFile& study);

/// A fault where a value (SI) stands twice, but for round-off.
Fault check_twice(const StudyFile& study, const std::string& key, scene::Dimension dimension,
                  std::vector<double> values);

}  // namespace launchsafe::study
