// [[vary]]: what the cases of a study differ in. Every entry has a key of the scene with values, with a range
// and a count, or with a distribution; or a calibration whose constants vary together; or named variants.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/scene/toml_reader.hpp"

#include <limits>
#include <map>
#include <string>
#include <vector>

namespace launchsafe::kinds {

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

/// One entry as read.
struct VaryText {
  std::string name;
  scene::KeyDescription key;   ///< of the scene
  std::vector<double> values;  ///< SI
  int count = 0;               ///< values in the range
  /// SI; what is not given is infinite or NaN. `range` is its lower and upper end.
  math::Distribution distribution{math::Distribution::Kind::uniform, -std::numeric_limits<double>::infinity(),
                                  std::numeric_limits<double>::infinity(), study::not_a_number,
                                  study::not_a_number};
};

/// The keys of an entry that varies this key of a scene.
std::vector<scene::Key<VaryText>> vary_keys(const scene::KeyDescription& scene_key);

/// One entry while it is read.
struct VaryReader {
  study::StudyFile& study;
  const toml::table& table;
  std::size_t index;
  VaryText text = {};
  std::map<std::string, scene::Place> places = {};

  bool given(const std::string& key) const { return places.contains(key); }
  scene::Place place_of(const std::string& key) const;
  /// The key of the study file by which places and faults are kept: "vary.0.range".
  std::string study_key(const std::string& key) const;
  scene::InputError fault(const std::string& key, std::string found, std::string allowed,
                          std::string suggestion = {}) const;
  /// The fault of a key that is missing and that an entry such as `what` needs.
  scene::InputError missing(const std::string& key, const std::string& what) const;
};

/// Whether the distribution of an entry is whole and possible.
study::Fault check_distribution(const VaryReader& reader);

/// The entry that names the record of a calibration, by its path.
struct VaryRecord {
  std::string name;
};
std::vector<scene::Key<VaryRecord>> vary_record_keys();
study::Fault read_calibrated(VaryReader& reader, const std::filesystem::path& folder);

}  // namespace launchsafe::kinds
