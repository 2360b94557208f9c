// Reading a TOML table against a described set of keys, and writing keys and values as text. Every function
// that reads throws the first InputError that it finds.
#pragma once

#include "launchsafe/scene/quantity.hpp"

#include <toml++/toml.h>

#include <filesystem>
#include <map>

namespace launchsafe::scene {

using namespace keys;  // whose words every list of keys is made of

// --- keys and values as text ---

/// "input", "P", "L", "D", "A" or "C".
std::string_view letter_of(Standing standing);
/// "stated in the paper", "literature", ...
std::string_view meaning_of(Standing standing);
/// "a length, more than 0 cm, such as ...": for messages and the key listing.
std::string allowed_text(const KeyDescription& key);
/// A value as people read it ("0.003 cm", "axisymmetric", "0 to 11.8 cm").
std::string format_value(const KeyDescription& key, const Value& value);
/// A value as TOML that reads back to exactly the same.
std::string exact_toml(const KeyDescription& key, const Value& value);
/// Whether two values are one: numbers up to a relative tolerance.
bool same_value(const Value& a, const Value& b, double tolerance);

// --- places and faults ---

/// A place in a file.
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};
Place place_of(const toml::node& node, const std::string& file);
InputError error_at(const Place& place, std::string_view key, std::string_view found,
                    std::string_view allowed, std::string_view suggestion = {});
/// The fault of a name that no key has, with the nearest key that exists.
InputError unknown_key(const Place& place, const std::string& name, const std::vector<std::string>& known);
/// `"abc"`, `12`, `a table`: a TOML value as found, for messages.
std::string found_text(const toml::node& node);
/// Throws the fault of a key at a place whose text is no reason: it has at least two words and eight letters.
void check_reason(const std::string& text, const Place& place, const std::string& key);

/// What `read` gives; what it throws is the fault of a key within that table, whose name comes before the
/// key's.
template <std::invocable Read>
auto within(const std::string& table, Read&& read) {
  try {
    return read();
  } catch (InputError& error) {
    error.key = table + "." + error.key;
    throw;
  }
}

// --- files ---

/// Bytes of the largest scene, study or record that is read, and of the largest pressure curve.
inline constexpr std::size_t largest_input = std::size_t{16} << 20, largest_curve = std::size_t{64} << 20;

/// The content of a regular file of at most `largest` bytes. The fault of a missing file suggests the one
/// that was perhaps meant.
std::string read_text_file(const std::filesystem::path& file, std::size_t largest = largest_input);
/// The path of a file that a key names by its path from a folder, that of the key's own file. Throws where it
/// is missing: `wanted` says which file that should be.
std::filesystem::path named_file(const std::filesystem::path& folder, const std::string& name,
                                 const Place& place, std::string_view key, const std::string& wanted);
/// The names of what is in a folder, sorted, so that nothing depends on the file system's order; none of one
/// that cannot be read.
std::vector<std::string> list_folder(const std::filesystem::path& folder);

/// What a file of input is of: people give a study where a scene is asked for, and the other way round.
enum class InputContent { scene, study, material, unknown };
/// By the keys of a file: a scene has bodies; a study names its kind or its scene; a material has a law.
InputContent content_of(const toml::table& root);
/// Throws the fault of a file that is clearly of something else than is wanted.
void check_content(const toml::table& root, const std::string& file, InputContent wanted);

// --- tables ---

/// A text as a table; `file` is named in errors.
toml::table parse_toml(std::string_view text, const std::string& file);

/// One value of a table, checked against its key.
Value read_value(const toml::node& node, const KeyDescription& key, const std::string& file);
/// Several values for a key that takes one: an array, or "0, 0.01, 0.02 cm". Sweeps are made of these.
std::vector<Value> read_values(const toml::node& node, const KeyDescription& key, const std::string& file);

/// A key of a table by its dotted name.
struct Leaf {
  std::string name;
  const toml::node* node = nullptr;
};
/// All keys of a table and of the tables in it, as people wrote them: toml++ sorts a table by key. One
/// without keys is a leaf itself. `elsewhere` names keys and tables that others read.
std::vector<Leaf> leaves_as_written(const toml::table& table, const std::vector<std::string>& elsewhere);

/// A value that a file gives, and where.
struct Given {
  Place place;
  Value value;
  bool of_material = false;  ///< by the material of a body, and not by the scene itself
};

/// The keys that a table gives, by dotted name, checked against their descriptions; sub-tables are dotted
/// names. Throws the first fault by line. `elsewhere` names keys and tables that others read.
std::map<std::string, Given> read_described(const toml::table& table, const std::vector<KeyDescription>& keys,
                                            const std::vector<std::string>& elsewhere,
                                            const std::string& file);

template <class Owner>
std::vector<KeyDescription> descriptions_of(const std::vector<Key<Owner>>& keys) {
  return {keys.begin(), keys.end()};
}

/// Reads a table into `owner`, in the order in which the keys are declared. Gives where each given key
/// stands.
template <class Owner>
std::map<std::string, Place> read_table(const toml::table& table, const std::vector<Key<Owner>>& keys,
                                        const std::vector<std::string>& elsewhere, const std::string& file,
                                        Owner& owner) {
  const auto given = read_described(table, descriptions_of(keys), elsewhere, file);
  std::map<std::string, Place> places;
  for (const Key<Owner>& key : keys)
    if (const auto found = given.find(key.name); found != given.end()) {
      key.set(owner, found->second.value);
      places[key.name] = found->second.place;
    }
  return places;
}

/// All tables of an array of that name, none if there is no such array. `allowed`: what the fault says of
/// anything else than tables under that name.
std::vector<const toml::table*> tables_of(const toml::table& root, const std::string& name,
                                          const std::string& file, const std::string& allowed);

/// Reads them: what each says, and where. A fault within one is that of the key "name.key".
template <class Owner>
std::vector<std::pair<Owner, std::map<std::string, Place>>> read_tables(const toml::table& root,
                                                                        const std::string& name,
                                                                        const std::vector<Key<Owner>>& keys,
                                                                        const std::string& file,
                                                                        const std::string& allowed) {
  std::vector<std::pair<Owner, std::map<std::string, Place>>> owners;
  for (const toml::table* table : tables_of(root, name, file, allowed)) {
    auto& [owner, places] = owners.emplace_back();
    within(name, [&, &own = owner, &its = places] { its = read_table(*table, keys, {}, file, own); });
  }
  return owners;
}

}  // namespace launchsafe::scene
