// Reading a TOML table against a described set of keys. Declaring a key, documenting it and reading it are
// one act: a Key names its dimension, range, default, standing and meaning, and is bound to a member of the
// struct it fills.
#pragma once

#include "launchsafe/scene/quantity.hpp"

#include <toml++/toml.h>

#include <filesystem>
#include <map>

namespace launchsafe::scene {

using namespace keys;  // whose words every list of keys is made of

/// "input", "P", "L", "D", "A" or "C".
std::string_view letter_of(Standing standing);
/// "stated in the paper", "literature", ...
std::string_view meaning_of(Standing standing);

/// A value as it is written in a file: `"2.5 mm"`, `"0 to 2.5 cm"`, `true`.
std::string example_of(const KeyDescription& key);
/// "a length, more than 0 cm, such as ...": for messages and the key listing.
std::string allowed_text(const KeyDescription& key);
/// A value as people read it ("0.003 cm", "axisymmetric", "0 to 11.8 cm").
std::string format_value(const KeyDescription& key, const Value& value);
/// A value as TOML that reads back to exactly the same.
std::string exact_toml(const KeyDescription& key, const Value& value);
/// Whether two values are one: numbers up to a relative tolerance.
bool same_value(const Value& a, const Value& b, double tolerance);

/// What is needed to name a place in a file.
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};
Place place_of(const toml::node& node, const std::string& file);
InputError error_at(const Place& place, std::string_view key, std::string_view found,
                    std::string_view allowed, std::string_view suggestion = {});
/// Throws the fault of a key at a place whose text is no reason: it has at least two words and eight letters.
void check_reason(const std::string& text, const Place& place, const std::string& key);
/// `"abc"`, `12`, `a table`: a TOML value as found, for messages.
std::string found_text(const toml::node& node);

/// A text as a table, or why it is no TOML. Never throws.
Expected<toml::table> parse_toml(std::string_view text, const std::string& file);

/// Bytes of the largest scene, study or record that is read, and of the largest pressure curve.
inline constexpr std::size_t largest_input = std::size_t{16} << 20, largest_curve = std::size_t{64} << 20;

/// The content of a regular file of at most `largest` bytes, or why it cannot be read.
Expected<std::string> read_regular_file(const std::filesystem::path& file, std::size_t largest);
/// The same of a file that a user named: in the place of a missing one that is suggested which was perhaps
/// meant.
Expected<std::string> read_text_file(const std::filesystem::path& file, std::size_t largest = largest_input);
/// The path of a file that a key names by its path from a folder, that of the key's own file. Throws the
/// fault of one that is not there: `wanted` says which file that should be.
std::filesystem::path named_file(const std::filesystem::path& folder, const std::string& name,
                                 const Place& place, std::string_view key, const std::string& wanted);
/// The names of what is in a folder, sorted, so that nothing depends on the file system's order; none of one
/// that cannot be read.
std::vector<std::string> list_folder(const std::filesystem::path& folder);

/// One value of a table, checked against its key.
Expected<Value> read_value(const toml::node& node, const KeyDescription& key, const std::string& file);
/// A value written as in a file, without the quotation marks of a quantity ("2.5 mm", "true", "comp-b").
Expected<Value> parse_value(std::string_view text, const KeyDescription& key, const Place& place);
/// Several values for a key that takes one: an array, or "0, 0.01, 0.02 cm". Sweeps are made of these.
Expected<std::vector<Value>> read_values(const toml::node& node, const KeyDescription& key,
                                         const std::string& file);

/// Values of a table by dotted key, in the order of the keys' declaration, and where each stands.
struct ReadValues {
  std::vector<std::pair<std::size_t, Value>> values;  ///< index of the key, value
  std::map<std::string, Place> places;                ///< of every key the user gave
};

/// A key of a table by its dotted name.
struct Leaf {
  std::string name;
  const toml::node* node = nullptr;
};
/// All keys of a table and of the tables in it, as people wrote them: toml++ sorts a table by key. One
/// without keys is a leaf itself. `elsewhere` names keys and tables that others read.
std::vector<Leaf> leaves_as_written(const toml::table& table, const std::vector<std::string>& elsewhere);

/// Checks a table against keys; sub-tables are dotted names. Reports the first fault by line. `elsewhere`
/// names keys and tables of the same file that others read.
Expected<ReadValues> read_described(const toml::table& table, const std::vector<const KeyDescription*>& keys,
                                    const std::vector<std::string>& elsewhere, const std::string& file);

/// The fault of a key within a table, whose name comes before the key's.
InputError within(const std::string& table, InputError error);
/// What `read` gives; what it throws is the fault of a key within that table.
template <std::invocable Read>
auto within(const std::string& table, Read&& read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw within(table, error);
  }
}

/// Visits all [table.NAME] of a file in the order of their names. Throws the fault of one that is no table:
/// `meaning` tells what NAME is the name of.
using VisitTable = std::function<void(const std::string& name, const toml::table& content)>;
void visit_tables(const toml::table& root, const std::string& table, std::string_view meaning,
                  const std::string& file, const VisitTable& visit);

template <class Owner>
std::vector<const KeyDescription*> descriptions_of(const std::vector<Key<Owner>>& keys) {
  std::vector<const KeyDescription*> result;
  for (const Key<Owner>& key : keys) result.push_back(&key);
  return result;
}

/// Reads a table into `owner`, in the order in which the keys are declared. Returns where each given key
/// stands.
template <class Owner>
Expected<std::map<std::string, Place>> read_table(const toml::table& table,
                                                  const std::vector<Key<Owner>>& keys,
                                                  const std::vector<std::string>& elsewhere,
                                                  const std::string& file, Owner& owner) {
  auto read = read_described(table, descriptions_of(keys), elsewhere, file);
  if (!read) return read.error();
  for (const auto& [index, value] : read->values) keys[index].set(owner, value);
  return std::move(read->places);
}

/// All tables of an array of that name, none if there is no such array. `allowed`: what the fault says of
/// anything else than tables under that name.
Expected<std::vector<const toml::table*>> tables_of(const toml::table& root, const std::string& name,
                                                    const std::string& file, const std::string& allowed);

/// Reads them: what each says, and where. A fault within one is that of the key "name.key".
template <class Owner>
Expected<std::vector<std::pair<Owner, std::map<std::string, Place>>>> read_tables(
    const toml::table& root, const std::string& name, const std::vector<Key<Owner>>& keys,
    const std::string& file, const std::string& allowed) {
  return caught([&] {
    std::vector<std::pair<Owner, std::map<std::string, Place>>> owners;
    for (const toml::table* table : tables_of(root, name, file, allowed).or_throw()) {
      auto& read = owners.emplace_back();
      read.second = within(name, [&] { return read_table(*table, keys, {}, file, read.first).or_throw(); });
    }
    return owners;
  });
}

/// The error for a name that no key has, with the nearest one that exists.
InputError unknown_key(const Place& place, const std::string& name, const std::vector<std::string>& known);

/// What a file of input is of: people give a study where a scene is asked for, and the other way round.
enum class InputContent { scene, study, material, unknown };
/// By the keys of a file: a scene has bodies; a study names its kind or its scene; a material has a law.
InputContent content_of(const toml::table& root);
/// Of a file; unknown where it cannot be read, about which its reader complains.
InputContent content_of(const std::filesystem::path& file);

/// Throws the fault of a file that is clearly of something else than is wanted.
void check_content(const toml::table& root, const std::string& file, InputContent wanted);

}  // namespace launchsafe::scene
