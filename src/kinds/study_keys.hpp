// Keys of study files that several kinds share, and the tables of published results.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/scene/toml_reader.hpp"

#include <string>
#include <utility>
#include <vector>

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

/// The key of a list that a study may state.
template <class Settings>
scene::Key<Settings> assumed_list(std::string name, scene::Dimension dimension, scene::Limits limits,
                                  std::string sentence, std::vector<double> Settings::*member) {
  return scene::list_key<Settings>(std::move(name), dimension, limits, scene::Standing::assumed,
                                   std::move(sentence), member);
}

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

}  // namespace launchsafe::kinds
