// What reads the study files of several kinds: keys, tables of published results, the scene that cases start
// from, and [[vary]].
#pragma once

#include "answer_tables.hpp"
#include "launchsafe/kinds/comparison.hpp"

namespace launchsafe::kinds {

// What all readers of study files speak of.
using scene::above, scene::above_to, scene::any_number, scene::at_least, scene::between, scene::plausibly,
    scene::required, scene::usually;
using scene::allowed_text, scene::error_at, scene::found_text;
using scene::Dimension, scene::Key, scene::KeyDescription, scene::Place, scene::Standing, scene::Value;
using scene::Expected, scene::Limits, scene::range_key, scene::SceneFile;
using scene::flag_key, scene::list_key, scene::number_key, scene::text_key, scene::word_key;
using study::Change, study::Leaf;

using StudyKeys = std::vector<Key<Study>>;

// Readers of study files throw what is wrong; `read_study_table` and `read_references` give it back as a
// value.

/// What was read, or else refused; `table`: of the study file, in which it stands.
template <class Read>
Read taken(Expected<Read> read, const std::string& table = {}) {
  if (!read) throw table.empty() ? read.error() : scene::within(table, read.error());
  return std::move(*read);
}

/// Keys of every kind, with the kind itself.
const StudyKeys& common_keys();
/// Gaps to judge; how the critical gap is sought, and gaps are judged besides; where the constants come from;
/// what the uncertainty of a verdict is made of, besides the mesh; a file of published rows, and a line.
StudyKeys gaps_keys(), search_keys(), judging_keys(), calibration_record_keys(), uncertainty_keys(),
    reference_keys();
/// Refuses an uncertainty that is stated by hand as a bare number, "1 K".
void check_bare_uncertainties(const toml::table& root, const StudyKeys& keys, const std::string& file);
/// Likewise one without a source in words, and a source without its value.
void check_stated_uncertainties(const StudyKeys& keys, const StudyFile& study);

/// The settings of a kind as keys of the study that holds them.
template <class Settings>
StudyKeys own_keys(const std::vector<Key<Settings>>& keys) {
  StudyKeys result;
  for (const Key<Settings>& key : keys) {
    Key<Study> lifted{KeyDescription(key), {}, {}};
    lifted.set = [key](Study& study, const Value& value) { key.set(settings_of<Settings>(study), value); };
    lifted.get = [key](const Study& study) { return key.get(settings_of<Settings>(study)); };
    result.push_back(std::move(lifted));
  }
  return result;
}

/// The default of a key for documentation; empty for a value that stands for none.
std::string default_text(const KeyDescription& key, const Value& value);

/// A table of a study file with the keys of one of its entries, for documentation.
template <class Owner>
StudyTable study_table_of(const std::string& name, const std::vector<Key<Owner>>& keys) {
  StudyTable table{name, {}};
  for (const Key<Owner>& key : keys) {
    scene::DocumentedKey entry{key, default_text(key, key.default_value())};
    entry.description.name = name + "." + key.name;
    table.keys.push_back(std::move(entry));
  }
  return table;
}

StudyTable reference_table(), cited_limit_table(), vary_table(), correlation_table();

/// Reads [[reference]], or the file that holds them, into Study::references.
void read_references(const StudySource& source, StudyFile& study);

/// Scene keys with other values than the scene has: a table of the study file, by its name there. No node:
/// none.
struct OverrideTable {
  std::string name;
  const toml::node* node = nullptr;
};

/// The changes that a table asks of a scene, which gets the notes on them; or what is wrong with a value. A
/// key that the scene does not know is refused in any case. `written`: how the table is written.
Expected<std::vector<Change>> changes_in(const OverrideTable& table, const std::string& file,
                                         const std::string& written, SceneFile& scene);

/// kinds::read_study of a table; `file` is named in errors.
Expected<StudyFile> read_study_table(const StudySource& source, const std::string& file,
                                     std::size_t most_cases);

/// Reads a scene by its path from the study file's folder; the fault of a missing one is at `key`.
SceneFile read_named_scene(const std::string& name, const std::filesystem::path& folder,
                           const std::string& key, const Place& place);

/// Reads the scene that the study names, then the overrides, in their order, then the constants of a
/// calibration, then the numerics that a tolerance (K, of T max) picks from the accuracy records that the
/// study names, which are returned.
study::AccuracyRecords settle_scene(const StudySource& source, const std::vector<OverrideTable>& overrides,
                                    StudyFile& study);

/// The acceptances of a table: those of scene keys go to the study's scene, those of its own keys beside what
/// it states. Needs the overrides.
void settle_acceptances(const toml::table& table, const StudyKeys& keys, StudyFile& study);

/// Reads all entries but variants into Study::axes. Needs the study's scene and overrides. An entry that the
/// kind does not admit is refused.
void read_vary(const StudySource& source, const Varied& admitted, StudyFile& study);

/// Reads which of these axes vary together, and brings those next to each other.
void read_correlations(const StudySource& source, StudyFile& study);

/// Of one of the variants of an entry, besides its tables.
std::vector<Key<Variant>> variant_keys();
/// The tables of the entry with variants.
std::vector<const toml::table*> variants_in(const StudySource& source, const StudyFile& study);

}  // namespace launchsafe::kinds
