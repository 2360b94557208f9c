// What reads the study files of several kinds: keys, tables of published results, the scene that cases start
// from, and [[vary]].
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/study/accuracy_record.hpp"

namespace launchsafe::kinds {

using StudyKeys = std::vector<scene::Key<study::Study>>;

/// Keys of every kind, with the kind itself.
const StudyKeys& common_keys();
/// Gaps to judge, as a list.
StudyKeys gaps_keys();
/// Of every kind that seeks the critical gap.
StudyKeys search_keys();
/// Of every kind that judges gaps besides.
StudyKeys judging_keys();
/// Where the constants of a study come from.
StudyKeys calibration_record_keys();
/// What the uncertainty of a verdict is made of, besides the mesh.
StudyKeys uncertainty_keys();
/// The fault of an uncertainty that is stated by hand as a bare number, "1 K"; none without one.
study::Fault check_bare_uncertainties(const toml::table& root, const StudyKeys& keys,
                                      const std::string& file);
/// The fault of one without a source in words, or of a source without its value.
study::Fault check_stated_uncertainties(const StudyKeys& keys, const study::StudyFile& study);
/// A file of published rows, and a published line.
StudyKeys reference_keys();

using keys::joined;

/// The settings of a kind as keys of the study that holds them.
template <class Settings>
StudyKeys own_keys(const std::vector<scene::Key<Settings>>& keys) {
  StudyKeys result;
  for (const scene::Key<Settings>& key : keys) {
    scene::Key<study::Study> lifted{scene::KeyDescription(key), {}, {}};
    lifted.set = [key](study::Study& study, const scene::Value& value) {
      key.set(settings_of<Settings>(study), value);
    };
    lifted.get = [key](const study::Study& study) { return key.get(settings_of<Settings>(study)); };
    result.push_back(std::move(lifted));
  }
  return result;
}

/// The default of a key for documentation; empty for a value that stands for none.
std::string default_text(const scene::KeyDescription& key, const scene::Value& value);

/// A table of a study file with the keys of one of its entries, for documentation.
template <class Owner>
StudyTable study_table_of(const std::string& name, const std::vector<scene::Key<Owner>>& keys) {
  StudyTable table{name, {}};
  for (const scene::Key<Owner>& key : keys) {
    scene::DocumentedKey entry{key, default_text(key, key.default_value())};
    entry.description.name = name + "." + key.name;
    table.keys.push_back(std::move(entry));
  }
  return table;
}

/// [[reference]] and [[cited_limit]].
StudyTable reference_table();
StudyTable cited_limit_table();

/// Reads [[reference]], or the file that holds them, into Study::references.
study::Fault read_references(const StudySource& source, study::StudyFile& study);

/// Scene keys with other values than the scene has: a table of the study file, by its name there. No node:
/// none.
struct OverrideTable {
  std::string name;
  const toml::node* node = nullptr;
};

/// Reads and validates a study and its scene from its table; `file` is named in errors. A study with more
/// cases is refused. Nothing is computed.
scene::Expected<study::StudyFile> read_study_table(const StudySource& source, const std::string& file,
                                                   std::size_t most_cases);

/// Reads a scene by its path from the study file's folder; the fault of a missing one is at `key`.
scene::Expected<scene::SceneFile> read_named_scene(const std::string& name,
                                                   const std::filesystem::path& folder,
                                                   const std::string& key, const scene::Place& place);

/// Reads the scene that the study names, then the overrides, in their order, then the constants of a
/// calibration, then the numerics that a tolerance (K, of T max) picks from an accuracy record. `record`
/// becomes that of the study, if it names one.
study::Fault settle_scene(const StudySource& source, const std::vector<OverrideTable>& overrides,
                          study::StudyFile& study, study::AccuracyRecords& records);

/// The acceptances of a table: those of scene keys go to the study's scene, those of its own keys beside what
/// it states. Needs the overrides.
study::Fault settle_acceptances(const toml::table& table, const StudyKeys& keys, study::StudyFile& study);

/// The keys of all entries, for documentation.
StudyTable vary_table();

/// Reads all entries but variants into Study::axes. Needs the study's scene and overrides. An entry that the
/// kind does not admit is a fault.
study::Fault read_vary(const StudySource& source, const Varied& admitted, study::StudyFile& study);

/// One of the variants of an entry as read, without its tables.
struct VariantText {
  std::string name, description, calibration;
};
std::vector<scene::Key<VariantText>> variant_keys();

/// The tables of the entry with variants; none is a fault.
scene::Expected<std::vector<const toml::table*>> variants_in(const StudySource& source,
                                                             const study::StudyFile& study);

}  // namespace launchsafe::kinds
