// The cases of a study, complete, valid scenes: other values of scene keys, the keys that vary, and what is
// wrong with a study and where.
#pragma once

#include "launchsafe/store/file.hpp"
#include "launchsafe/study/study_file.hpp"

namespace launchsafe::study {

/// Equal but for the round-off of units.
bool same_number(double a, double b);
/// Likewise; numbers of lists too.
bool same_value(const scene::Value& a, const scene::Value& b);

/// What two scenes have otherwise: names of scene keys; "body", "interface", "observation_point".
std::vector<std::string> differences(const scene::Scene& scene, const scene::Scene& other);

/// A scene key with a new value.
struct Change : scene::KeyChange {
  std::string study_key;  ///< for faults: where in the study it was asked for
};
/// The value as people read it.
std::string text_of(const scene::SceneFile& scene, const Change& change);

/// The scene with all changes, which need be valid only together (scene::with_keys), or why it cannot have
/// them, at the change that this is about.
scene::Expected<scene::SceneFile> with_changes(const scene::SceneFile& scene,
                                               const std::vector<Change>& changes);

/// Where the user gave a key; the file as a whole if he did not.
inline scene::Place place_of_key(const StudyFile& study, const std::string& key) {
  const auto found = study.places.find(key);
  return found == study.places.end() ? scene::Place{study.file} : found->second;
}

// What follows, and whatever reads study files, throws what is wrong, an InputError; `kinds::read_study`
// gives it back as a value.
[[noreturn]] inline void refuse_at(const StudyFile& study, const std::string& key, std::string found,
                                   std::string allowed, std::string suggestion = {}) {
  throw scene::error_at(place_of_key(study, key), key, std::move(found), std::move(allowed),
                        std::move(suggestion));
}

/// The tables [[name]] of a study file; none where there are none. A kind that needs at least one says what
/// stands in it: "with a name".
std::vector<const toml::table*> tables_of(const toml::table& root, const std::string& name,
                                          const StudyFile& study, const std::string& needed = {});

/// Adds a row for every [[name]] of a study file or of a file that it names. Where a key of one stands is
/// known as that of "name.0.key".
template <class Row>
void read_rows(const toml::table& root, const std::string& name, const std::vector<scene::Key<Row>>& keys,
               const std::string& file, StudyFile& study, std::vector<Row>& rows) {
  const std::string allowed = "tables, each written [[" + name + "]]";
  for (auto& [row, places] : scene::read_tables(root, name, keys, file, allowed)) {
    for (const auto& [key, place] : places)
      study.places[name + "." + std::to_string(rows.size()) + "." + key] = place;
    rows.push_back(std::move(row));
  }
}

/// The text of the file that a key names by its path from the study file's folder; `wanted` says which file
/// that should be.
std::string read_named_file(const StudyFile& study, const std::filesystem::path& folder,
                            const std::string& key, const std::string& name, const std::string& wanted);

/// Gives the scene of a study the constants that the study names, if it names some.
void use_constants(StudyFile& study, const std::filesystem::path& folder);

/// Refuses a scene, or a study, that states or varies a key that its constants have, where verdicts are
/// given: a constants file is the one place of these. A steel may be stated, beyond the interval of the
/// constants.
void check_constants(const StudyFile& study);

/// Reads the constants files that the study names as other models. Refused are: none there, one without
/// constants, and two of one name.
void read_models(StudyFile& study, const std::filesystem::path& folder);
/// Refuses a model under which a case of the study is no valid scene.
void check_models(const StudyFile& study);
/// Name of a model in tables: that of shipped constants, or of their file without its ending.
std::string name_of_model(const scene::Constants& model);
/// The scene of a case under other constants; what its scene and the study state stays.
scene::Scene scene_of_model(const StudyCase& input, const std::shared_ptr<const scene::Constants>& model);

using scene::Leaf;
/// All keys of a table and of the tables in it, as people wrote them.
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
scene::KeyDescription varied_key(const StudyFile& study, const std::string& name,
                                 const std::string& faulty_key, const scene::Place& place);

/// The value of a scene key that takes one number, SI.
double number_in(const scene::SceneFile& file, const std::string& key);

/// Refuses a scene key that is to vary and is fixed elsewhere, or varies already; it was asked for at a place
/// under a name.
void check_free(const StudyFile& study, const std::string& scene_key, const scene::Place& place,
                const std::string& faulty_key);

/// Refuses axes that cannot have an effect: those of the analytic load under a measured curve.
void check_load_axes(const StudyFile& study);

/// Refuses a value (SI) that stands twice, but for round-off.
void check_twice(const StudyFile& study, const std::string& key, scene::Dimension dimension,
                 std::vector<double> values);

/// A case of a valid scene, of another launch than the study's until somebody says so.
StudyCase case_of(std::string label, scene::SceneFile scene);

/// What to call a case by its place among those that are added.
using LabelOf = std::function<std::string(std::size_t index, const StudyCase& made)>;
/// The values of the axes (SI) of a case by its place.
using CoordinatesOf = std::function<std::vector<double>(std::size_t index)>;

/// Adds so many cases that have Study::axes otherwise than the study's scene. Every one is made once, to be
/// checked: the fault is that of the first that cannot be. Both functions are called from several threads.
void add_varied_cases(StudyFile& study, std::size_t count, const CoordinatesOf& coordinates_of,
                      const LabelOf& label_of);

/// The full factorial of Study::axes, the last one fastest.
void make_factorial(StudyFile& study);

/// Refuses, at `key`, more cases than a study may have; `what` says how they come about.
void check_count(const StudyFile& study, const std::string& key, double count, const std::string& what);

/// The key of a scene that its gaps stand under. Cases share gaps, unless a study varies this key: then each
/// has a gap of its own.
inline constexpr const char* gap_key = "gap.thickness";
bool varies_gap(const Study& study);

/// The gaps of a study that judges some, where it has none itself: those of its scene.
void settle_gaps(StudyFile& study);

}  // namespace launchsafe::study
