// A key of an input file as data: name, dimension, allowed and plausible range, standing, a sentence, and the
// member of a struct that it fills. What declares such a struct lists its keys beside it; reading,
// documenting, sweeping and storing go through the list.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace launchsafe::keys {

/// What a number measures. `number` is dimensionless, `count` a whole dimensionless number. A `temperature`
/// is one on a scale, which may be that of Celsius; a `temperature_difference`, such as an uncertainty, is in
/// K.
enum class Dimension {
  number,
  count,
  length,
  time,
  pressure,
  temperature,
  temperature_difference,
  density,
  speed,
  frequency,
  specific_energy,
  specific_heat,
  conductivity,
  toughness
};

/// Where a value comes from; the letters are those of the reports: P, L, D, A, C; `input` is what the user
/// wrote.
enum class Standing { input, paper, literature, derived, assumed, calibrated };

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
  bool contain(double value) const {
    const bool above_lowest = lowest_allowed ? value >= lowest : value > lowest;
    const bool below_highest = highest_allowed ? value <= highest : value < highest;
    return above_lowest && below_highest;
  }
};
inline Limits any_number() { return {}; }
inline Limits at_least(double lowest) { return {.lowest = lowest}; }
inline Limits above(double lowest) { return {.lowest = lowest, .lowest_allowed = false}; }
inline Limits between(double lowest, double highest) { return {.lowest = lowest, .highest = highest}; }
inline Limits above_to(double lowest, double highest) {
  return {.lowest = lowest, .highest = highest, .lowest_allowed = false};
}

/// What a key is expected to hold: a value that is allowed but not plausible puts every verdict that rests on
/// it in doubt (scene/plausibility.hpp).
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
  bool may_be_empty = false;                ///< of a list: [] is allowed
  bool required = false;                    ///< no default: the user must say
  std::vector<std::string> overrides = {};  ///< keys whose earlier value a new one of this takes back
  Plausible plausible = {};
};

/// A described key bound to a struct.
template <class Owner>
struct Key : KeyDescription {
  std::function<void(Owner&, const Value&)> set;
  std::function<Value(const Owner&)> get;
  /// Whether the owner written back has the key; empty: always. What a key came later than, such as results
  /// that are stored, stays what it is where the key does nothing.
  std::function<bool(const Owner&)> is_written = {};
  Value default_value() const { return get(Owner{}); }
};

/// The key of that name, or nullptr.
template <class Owner>
const Key<Owner>* find_key(const std::vector<Key<Owner>>& keys, std::string_view name) {
  const auto found =
      std::find_if(keys.begin(), keys.end(), [name](const Key<Owner>& key) { return key.name == name; });
  return found == keys.end() ? nullptr : &*found;
}

// --- Making keys. `member` is a pointer to the bound member, &Load::peak, or a function that returns a
// reference to it. ---

/// A quantity, or a whole number if the dimension is `count`.
template <class Owner, class Member>
Key<Owner> number_key(std::string name, Dimension dimension, Limits limits, Standing standing,
                      std::string sentence, Member member) {
  Key<Owner> key{
      {std::move(name), KeyKind::number, dimension, limits, {}, 0, standing, std::move(sentence)}, {}, {}};
  key.set = [member](Owner& owner, const Value& value) {
    using Number = std::remove_reference_t<decltype(std::invoke(member, owner))>;
    std::invoke(member, owner) = static_cast<Number>(std::get<double>(value));
  };
  key.get = [member](const Owner& owner) { return Value(static_cast<double>(std::invoke(member, owner))); };
  return key;
}

template <class Owner, class Member>
Key<Owner> flag_key(std::string name, Standing standing, std::string sentence, Member member) {
  Key<Owner> key{
      {std::move(name), KeyKind::flag, Dimension::number, {}, {}, 0, standing, std::move(sentence)}, {}, {}};
  key.set = [member](Owner& owner, const Value& value) {
    std::invoke(member, owner) = std::get<bool>(value);
  };
  key.get = [member](const Owner& owner) { return Value(static_cast<bool>(std::invoke(member, owner))); };
  return key;
}

template <class Owner, class Member>
Key<Owner> text_key(std::string name, Standing standing, std::string sentence, Member member) {
  Key<Owner> key{
      {std::move(name), KeyKind::text, Dimension::number, {}, {}, 0, standing, std::move(sentence)}, {}, {}};
  key.set = [member](Owner& owner, const Value& value) {
    std::invoke(member, owner) = std::get<std::string>(value);
  };
  key.get = [member](const Owner& owner) { return Value(std::string(std::invoke(member, owner))); };
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
      if (word == std::get<std::string>(value)) std::invoke(member, owner) = meaning;
    }
  };
  key.get = [member, words](const Owner& owner) {
    for (const auto& [word, meaning] : words) {
      if (meaning == std::invoke(member, owner)) return Value(word);
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
    auto& target = std::invoke(member, owner);
    if constexpr (requires { target.assign(numbers.begin(), numbers.end()); }) {
      target.assign(numbers.begin(), numbers.end());
    } else {
      std::copy_n(numbers.begin(), std::min(numbers.size(), target.size()), target.begin());
    }
  };
  key.get = [member](const Owner& owner) {
    const auto& source = std::invoke(member, owner);
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
    std::invoke(begin, owner) = numbers[0];
    std::invoke(end, owner) = numbers[1];
  };
  key.get = [begin, end](const Owner& owner) {
    return Value(std::vector<double>{std::invoke(begin, owner), std::invoke(end, owner)});
  };
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
/// The same word or flag ("true"), of which only these are plausible, and why.
template <class Owner>
Key<Owner> plausibly(Key<Owner> key, std::vector<std::string> words, std::string because) {
  key.plausible = {.words = std::move(words), .because = std::move(because)};
  return key;
}
/// The same key, of which all that is allowed is plausible, and why.
template <class Owner>
Key<Owner> always_plausible(Key<Owner> key, std::string because) {
  key.plausible = {.because = std::move(because)};
  return key;
}

/// The same key with something that follows from it done to its owner after it is set.
template <class Owner, class Consequence>
Key<Owner> then(Key<Owner> key, Consequence consequence) {
  key.set = [set = std::move(key.set), consequence = std::move(consequence)](Owner& owner,
                                                                             const Value& value) {
    set(owner, value);
    consequence(owner);
  };
  return key;
}

/// The same key, which takes back earlier values of others that would contradict it.
template <class Owner>
Key<Owner> overriding(Key<Owner> key, std::vector<std::string> others) {
  key.overrides = std::move(others);
  return key;
}

/// The same key, written back only where a condition holds.
template <class Owner>
Key<Owner> written_where(Key<Owner> key, std::function<bool(const Owner&)> condition) {
  key.is_written = std::move(condition);
  return key;
}

/// The same list, which may also be [].
template <class Owner>
Key<Owner> may_be_empty(Key<Owner> key) {
  key.may_be_empty = true;
  return key;
}

}  // namespace launchsafe::keys
