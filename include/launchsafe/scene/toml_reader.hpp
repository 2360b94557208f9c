// Reading a TOML table against a described set of keys. Declaring a key, documenting it and reading it are
// one act: a Key names its dimension, range, default, standing and meaning, and is bound to a member of the
// struct it fills.
#pragma once

#include "launchsafe/scene/input_error.hpp"
#include "launchsafe/scene/quantity.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace launchsafe::scene {

/// Where a value comes from; the letters are those of the reports: P, L, D, A, C; `input` is what the user
/// wrote.
enum class Standing { input, paper, literature, derived, assumed, calibrated };
/// "input", "P", "L", "D", "A" or "C".
std::string_view letter_of(Standing standing);
/// "stated in the paper", "literature", ...
std::string_view meaning_of(Standing standing);

/// number: one quantity; flag: true or false; word: one of a few; text: any string; list: quantities; range:
/// "a to b".
enum class KeyKind { number, flag, word, text, list, range };

/// The value of any key: number; flag; word or text; list or range.
using Value = std::variant<double, bool, std::string, std::vector<double>>;

/// Allowed numbers in SI; for lists and ranges, those of every number.
struct Limits {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  bool lowest_allowed = true;   ///< whether `lowest` itself is allowed
  bool highest_allowed = true;  ///< whether `highest` itself is allowed
  bool contain(double value) const;
};
inline Limits any_number() { return {}; }
inline Limits at_least(double lowest) { return {.lowest = lowest}; }
inline Limits above(double lowest) { return {.lowest = lowest, .lowest_allowed = false}; }
inline Limits between(double lowest, double highest) { return {.lowest = lowest, .highest = highest}; }
inline Limits above_to(double lowest, double highest) {
  return {.lowest = lowest, .highest = highest, .lowest_allowed = false};
}

/// What a key is expected to hold: a value that is allowed but not plausible puts every verdict that rests on
/// it in doubt (see plausibility.hpp).
struct Plausible {
  Limits limits = {};    ///< SI; of a list those of every number, of a range those of its width
  bool or_zero = false;  ///< 0 too, where it stands for "none"
  std::vector<std::string> words = {};  ///< of a word, or of a flag ("true"); empty: every one
  std::string because = {};             ///< a clause: why; where all is plausible, why that is
};

/// All there is to say about a key, apart from where its value goes.
struct KeyDescription {
  std::string name = {};  ///< dotted, such as "charge.crack_radius"
  KeyKind kind = KeyKind::number;
  Dimension dimension = Dimension::number;
  Limits limits = {};
  std::vector<std::string> words = {};  ///< of a word
  std::size_t list_length = 0;          ///< of a list that has a fixed one; 0: any
  Standing standing = Standing::assumed;
  std::string sentence = {};
  bool may_be_empty = false;  ///< of a list: [] is allowed
  bool required = false;      ///< no default: the user must say
  Plausible plausible = {};
};

/// "a length, more than 0 cm, such as ...": for messages and the key listing.
std::string allowed_text(const KeyDescription& key);
/// "0.05 ms to 2 ms, because ...": what is plausible of a key; "any" where all that is allowed is.
std::string plausible_text(const KeyDescription& key);
/// A value as people read it ("0.003 cm", "axisymmetric", "0 to 11.8 cm").
std::string format_value(const KeyDescription& key, const Value& value);
/// A value as TOML that reads back to exactly the same.
std::string exact_toml(const KeyDescription& key, const Value& value);

/// A described key bound to a struct.
template <class Owner>
struct Key : KeyDescription {
  std::function<void(Owner&, const Value&)> set;
  std::function<Value(const Owner&)> get;
  Value default_value() const { return get(Owner{}); }
};

/// What is needed to name a place in a file.
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
};
Place place_of(const toml::node& node, const std::string& file);
InputError error_at(const Place& place, std::string key, std::string found, std::string allowed,
                    std::string suggestion = {});
/// `"abc"`, `12`, `a table`: a TOML value as found, for messages.
std::string found_text(const toml::node& node);

/// The whole file as a table, or why it cannot be read or is no TOML. Never throws.
Expected<toml::table> read_toml_file(const std::filesystem::path& file);
Expected<toml::table> parse_toml(std::string_view text, const std::string& file);
/// The text of a file, or why it cannot be read, with the nearest name in its folder.
Expected<std::string> read_text_file(const std::filesystem::path& file);

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

/// Checks a table against keys; sub-tables are dotted names. Reports the first fault by line. `elsewhere`
/// names keys and tables of the same file that others read.
Expected<ReadValues> read_described(const toml::table& table, const std::vector<const KeyDescription*>& keys,
                                    const std::vector<std::string>& elsewhere, const std::string& file);

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

/// The key of that name, or nullptr.
template <class Owner>
const Key<Owner>* find_key(const std::vector<Key<Owner>>& keys, std::string_view name) {
  const auto found =
      std::find_if(keys.begin(), keys.end(), [name](const Key<Owner>& key) { return key.name == name; });
  return found == keys.end() ? nullptr : &*found;
}

/// The error for a name that no key has, with the nearest one that exists.
InputError unknown_key(const Place& place, const std::string& name, const std::vector<std::string>& known);

// --- Making keys. `member` returns a reference to the bound member: [](auto& s) -> auto& { return
// s.load.peak; } ---

/// A quantity, or a whole number if the dimension is `count`.
template <class Owner, class Member>
Key<Owner> number_key(std::string name, Dimension dimension, Limits limits, Standing standing,
                      std::string sentence, Member member) {
  Key<Owner> key{
      {std::move(name), KeyKind::number, dimension, limits, {}, 0, standing, std::move(sentence)}, {}, {}};
  key.set = [member](Owner& owner, const Value& value) {
    using Number = std::remove_reference_t<decltype(member(owner))>;
    member(owner) = static_cast<Number>(std::get<double>(value));
  };
  key.get = [member](const Owner& owner) { return Value(static_cast<double>(member(owner))); };
  return key;
}

template <class Owner, class Member>
Key<Owner> flag_key(std::string name, Standing standing, std::string sentence, Member member) {
  Key<Owner> key{
      {std::move(name), KeyKind::flag, Dimension::number, {}, {}, 0, standing, std::move(sentence)}, {}, {}};
  key.set = [member](Owner& owner, const Value& value) { member(owner) = std::get<bool>(value); };
  key.get = [member](const Owner& owner) { return Value(static_cast<bool>(member(owner))); };
  return key;
}

template <class Owner, class Member>
Key<Owner> text_key(std::string name, Standing standing, std::string sentence, Member member) {
  Key<Owner> key{
      {std::move(name), KeyKind::text, Dimension::number, {}, {}, 0, standing, std::move(sentence)}, {}, {}};
  key.set = [member](Owner& owner, const Value& value) { member(owner) = std::get<std::string>(value); };
  key.get = [member](const Owner& owner) { return Value(std::string(member(owner))); };
  return key;
}

/// One of several words, each standing for a value of an enumeration.
template <class Owner, class Enumeration, class Member>
Key<Owner> word_key(std::string name, Standing standing, std::string sentence,
                    std::vector<std::pair<std::string, Enumeration>> words, Member member) {
  Key<Owner> key{
      {std::move(name), KeyKind::word, Dimension::number, {}, {}, 0, standing, std::move(sentence)}, {}, {}};
  for (const auto& word : words) key.words.push_back(word.first);
  key.set = [member, words](Owner& owner, const Value& value) {
    for (const auto& [word, meaning] : words) {
      if (word == std::get<std::string>(value)) member(owner) = meaning;
    }
  };
  key.get = [member, words](const Owner& owner) {
    for (const auto& [word, meaning] : words) {
      if (meaning == member(owner)) return Value(word);
    }
    return Value(std::string{});
  };
  return key;
}

/// Quantities of one dimension in a container that is assigned or, if its length is fixed, filled.
template <class Owner, class Member>
Key<Owner> list_key(std::string name, Dimension dimension, Limits limits, Standing standing,
                    std::string sentence, Member member, std::size_t fixed_length = 0) {
  Key<Owner> key{
      {std::move(name), KeyKind::list, dimension, limits, {}, fixed_length, standing, std::move(sentence)},
      {},
      {}};
  key.set = [member](Owner& owner, const Value& value) {
    const auto& numbers = std::get<std::vector<double>>(value);
    auto& target = member(owner);
    if constexpr (requires { target.assign(numbers.begin(), numbers.end()); }) {
      target.assign(numbers.begin(), numbers.end());
    } else {
      std::copy_n(numbers.begin(), std::min(numbers.size(), target.size()), target.begin());
    }
  };
  key.get = [member](const Owner& owner) {
    const auto& source = member(owner);
    return Value(std::vector<double>(source.begin(), source.end()));
  };
  return key;
}

/// "a to b", bound to two members.
template <class Owner, class Begin, class End>
Key<Owner> range_key(std::string name, Dimension dimension, Limits limits, Standing standing,
                     std::string sentence, Begin begin, End end) {
  Key<Owner> key{
      {std::move(name), KeyKind::range, dimension, limits, {}, 2, standing, std::move(sentence)}, {}, {}};
  key.set = [begin, end](Owner& owner, const Value& value) {
    const auto& numbers = std::get<std::vector<double>>(value);
    begin(owner) = numbers[0];
    end(owner) = numbers[1];
  };
  key.get = [begin, end](const Owner& owner) { return Value(std::vector<double>{begin(owner), end(owner)}); };
  return key;
}

/// The same key, but without a default: the user must give it.
template <class Owner>
Key<Owner> required(Key<Owner> key) {
  key.required = true;
  return key;
}

/// The same key with what is plausible of it, and why.
template <class Owner>
Key<Owner> plausibly(Key<Owner> key, Limits limits, std::string because) {
  key.plausible = {.limits = limits, .because = std::move(because)};
  return key;
}

/// The same list, which may also be [].
template <class Owner>
Key<Owner> may_be_empty(Key<Owner> key) {
  key.may_be_empty = true;
  return key;
}

}  // namespace launchsafe::scene
