// A key of an input file as data: name, dimension, allowed range, standing, a sentence, and the member of a
// struct that it fills. What declares such a struct lists its keys beside it; reading, documenting, sweeping
// and storing go through the list.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace launchsafe::keys {

/// The part of a computation that another value of an input changes. A launch without bulk reaction,
/// conduction, or stored temperatures (scene::mechanical_part) has mechanics that depend on fewer inputs.
enum class ActsOn {
  mechanics,   ///< the mechanical run
  numerics,    ///< likewise, by its error alone
  trace,       ///< the skin, and what the mechanical run traces for it
  heat,        ///< the skin, and the mechanical run where temperatures of the charge matter to it
  conduction,  ///< likewise, where heat is conducted
  chemistry,   ///< likewise, where the bulk reacts
  surface,     ///< the skin
  combustion,  ///< what follows ignition
  nothing      ///< no number that is computed
};
/// Whether a mechanical run may depend on an input, in some launch.
constexpr bool reaches_mechanics(ActsOn acts_on) { return acts_on < ActsOn::surface; }

/// The value of any key: number; flag; word, words ("a, b") or text; list or range.
using Value = std::variant<double, bool, std::string, std::vector<double>>;

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
  toughness,
  share,  ///< written in percent
  // Of results alone.
  mass,
  volume,
  energy,
  energy_per_area,
  // Of options too: what a computation takes.
  memory,
  duration
};

/// Where a value comes from; the letters are those of the reports: P, L, D, A, C; `input` is what the user
/// wrote.
enum class Standing { input, paper, literature, derived, assumed, calibrated };

/// number: one quantity; flag: true or false; word: one of a few; words: some of a few, each once; text: any
/// string; list: quantities; range: "a to b".
enum class KeyKind { number, flag, word, words, text, list, range };

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

/// All there is to say about a key, apart from where its value goes.
struct KeyDescription {
  std::string name = {};  ///< dotted, such as "charge.crack_radius"
  KeyKind kind = KeyKind::number;
  Dimension dimension = Dimension::number;
  Limits limits = {};
  std::vector<std::string> words = {};  ///< of a word or of words: those that there are
  std::size_t list_length = 0;          ///< of a list that has a fixed one; 0: any
  Standing standing = Standing::assumed;
  std::string sentence = {};
  std::string example = {};                 ///< of a text, without quotation marks
  bool may_be_empty = false;                ///< of a list: [] is allowed
  bool required = false;                    ///< no default: the user must say
  std::string usual = {};                   ///< the default in words, where it follows from other keys
  std::vector<std::string> overrides = {};  ///< keys whose earlier value a new one of this takes back
  ActsOn acts_on = ActsOn::mechanics;
};

/// A described key bound to a struct.
template <class Owner>
struct Key : KeyDescription {
  std::function<void(Owner&, const Value&)> set = {};
  std::function<Value(const Owner&)> get = {};
  /// Whether the owner written back has the key; empty: always. What a key came later than, such as results
  /// that are stored, stays what it is where the key does nothing.
  std::function<bool(const Owner&)> is_written = {};
  /// Where the key is written, and others take its place; empty: nowhere.
  std::function<bool(const Owner&)> is_replaced = {};
  bool is_used(const Owner& owner) const {
    return (!is_written || is_written(owner)) && !(is_replaced && is_replaced(owner));
  }
  Value default_value() const { return get(Owner{}); }
};

/// The one of that name, or nullptr.
template <class Named>
const Named* find_named(const std::vector<Named>& all, std::string_view name) {
  const auto found = std::ranges::find(all, name, &Named::name);
  return found == all.end() ? nullptr : &*found;
}
template <class Owner>
const Key<Owner>* find_key(const std::vector<Key<Owner>>& keys, std::string_view name) {
  return find_named(keys, name);
}

template <class Named, class Member>
struct OwnerOfMember {
  using type = Named;
};
template <class Owner, class Part>
struct OwnerOfMember<void, Part Owner::*> {
  using type = Owner;
};

/// The struct that a key is bound to: that of the pointer to its member, unless it is named.
template <class Named, class Member>
using OwnerOf = typename OwnerOfMember<Named, Member>::type;
/// The type of the bound member.
template <class Named, class Member>
using PartOf = std::remove_cvref_t<std::invoke_result_t<Member, OwnerOf<Named, Member>&>>;

// --- Making keys. `member` is a pointer to the bound member, such as &Load::peak, or a function that returns
// a reference to it; the owner has to be named for a function only. ---

/// What there is to say about a key, without words.
inline KeyDescription description(std::string name, KeyKind kind, Standing standing, std::string sentence,
                                  Dimension dimension = Dimension::number, Limits limits = {},
                                  std::size_t list_length = 0) {
  return {.name = std::move(name),
          .kind = kind,
          .dimension = dimension,
          .limits = limits,
          .list_length = list_length,
          .standing = standing,
          .sentence = std::move(sentence)};
}

namespace detail {

/// Fills a member of any type that a key can have, enumerations apart.
template <class Part>
void assign(Part& part, const Value& value) {
  if constexpr (std::is_same_v<Part, bool>) {
    part = std::get<bool>(value);
  } else if constexpr (std::is_arithmetic_v<Part> || std::is_same_v<Part, std::optional<double>>) {
    part = static_cast<Part>(std::get<double>(value));
  } else if constexpr (std::is_assignable_v<Part&, const std::string&>) {
    part = std::get<std::string>(value);
  } else if constexpr (const auto& numbers = std::get<std::vector<double>>(value);
                       requires { part.assign(numbers.begin(), numbers.end()); }) {
    part.assign(numbers.begin(), numbers.end());
  } else {
    std::copy_n(numbers.begin(), std::min(numbers.size(), part.size()), part.begin());
  }
}

/// The value of such a member; 0 of an optional number that is absent.
template <class Part>
Value value_of(const Part& part) {
  if constexpr (std::is_same_v<Part, bool>)
    return part;
  else if constexpr (std::is_arithmetic_v<Part>)
    return static_cast<double>(part);
  else if constexpr (std::is_same_v<Part, std::optional<double>>)
    return part.value_or(0.0);
  else if constexpr (std::is_convertible_v<Part, std::string>)
    return std::string(part);
  else
    return std::vector<double>(part.begin(), part.end());
}

/// A key of that description, bound to a member of one of these types.
template <class Named, class Member>
auto member_key(KeyDescription described, Member member) {
  using Owner = OwnerOf<Named, Member>;
  Key<Owner> key{std::move(described)};
  key.set = [member](Owner& owner, const Value& value) { assign(std::invoke(member, owner), value); };
  key.get = [member](const Owner& owner) { return value_of(std::invoke(member, owner)); };
  return key;
}

}  // namespace detail

/// A quantity, or a whole number if the dimension is `count`. A member that is an optional number has no
/// default, and is written back only where it is stated.
template <class Named = void, class Member>
auto number_key(std::string name, Dimension dimension, Limits limits, Standing standing, std::string sentence,
                Member member) {
  auto key = detail::member_key<Named>(
      description(std::move(name), KeyKind::number, standing, std::move(sentence), dimension, limits),
      member);
  using Owner = OwnerOf<Named, Member>;
  if constexpr (std::is_same_v<PartOf<Named, Member>, std::optional<double>>)
    key.is_written = [member](const Owner& owner) { return std::invoke(member, owner).has_value(); };
  return key;
}

template <class Named = void, class Member>
auto flag_key(std::string name, Standing standing, std::string sentence, Member member) {
  return detail::member_key<Named>(description(std::move(name), KeyKind::flag, standing, std::move(sentence)),
                                   member);
}

template <class Named = void, class Member>
auto text_key(std::string name, Standing standing, std::string sentence, std::string example, Member member) {
  KeyDescription described = description(std::move(name), KeyKind::text, standing, std::move(sentence));
  described.example = std::move(example);
  return detail::member_key<Named>(std::move(described), member);
}

/// Quantities of one dimension in a container that is assigned or, if its length is fixed, filled.
template <class Named = void, class Member>
auto list_key(std::string name, Dimension dimension, Limits limits, Standing standing, std::string sentence,
              Member member, std::size_t fixed_length = 0) {
  return detail::member_key<Named>(description(std::move(name), KeyKind::list, standing, std::move(sentence),
                                               dimension, limits, fixed_length),
                                   member);
}

/// One of several words, each standing for a value of the member's enumeration. The second parameter is that
/// enumeration where the owner is named.
template <class Named = void, class = void, class Member>
auto word_key(std::string name, Standing standing, std::string sentence,
              std::vector<std::pair<std::string, PartOf<Named, Member>>> words, Member member) {
  using Owner = OwnerOf<Named, Member>;
  Key<Owner> key{description(std::move(name), KeyKind::word, standing, std::move(sentence))};
  for (const auto& word : words) key.words.push_back(word.first);
  key.set = [words, member](Owner& owner, const Value& value) {
    for (const auto& [word, meaning] : words)
      if (word == std::get<std::string>(value)) std::invoke(member, owner) = meaning;
  };
  key.get = [words, member](const Owner& owner) -> Value {
    for (const auto& [word, meaning] : words)
      if (meaning == std::invoke(member, owner)) return word;
    return std::string{};
  };
  return key;
}

/// Some of a few words, none of them too, in the order in which these are given: each stands for the value of
/// the member's enumeration with its index.
template <class Named = void, class Member>
auto words_key(std::string name, Standing standing, std::string sentence, std::vector<std::string> words,
               Member member) {
  using Owner = OwnerOf<Named, Member>;
  using Enumeration = typename PartOf<Named, Member>::value_type;
  Key<Owner> key{description(std::move(name), KeyKind::words, standing, std::move(sentence))};
  key.words = words;
  key.set = [words, member](Owner& owner, const Value& value) {
    auto& target = std::invoke(member, owner);
    target.clear();
    const std::string list = ", " + std::get<std::string>(value) + ",";
    for (std::size_t i = 0; i < words.size(); ++i)
      if (list.find(" " + words[i] + ",") != std::string::npos) target.push_back(static_cast<Enumeration>(i));
  };
  key.get = [words, member](const Owner& owner) -> Value {
    std::string list;
    for (std::size_t i = 0; i < words.size(); ++i)
      if (std::ranges::count(std::invoke(member, owner), static_cast<Enumeration>(i)) > 0)
        list += (list.empty() ? "" : ", ") + words[i];
    return list;
  };
  return key;
}

/// "a to b", bound to two members.
template <class Named = void, class Begin, class End>
auto range_key(std::string name, Dimension dimension, Limits limits, Standing standing, std::string sentence,
               Begin begin, End end) {
  using Owner = OwnerOf<Named, Begin>;
  Key<Owner> key{
      description(std::move(name), KeyKind::range, standing, std::move(sentence), dimension, limits, 2)};
  key.set = [begin, end](Owner& owner, const Value& value) {
    const auto& numbers = std::get<std::vector<double>>(value);
    std::invoke(begin, owner) = numbers[0];
    std::invoke(end, owner) = numbers[1];
  };
  key.get = [begin, end](const Owner& owner) -> Value {
    return std::vector<double>{std::invoke(begin, owner), std::invoke(end, owner)};
  };
  return key;
}

/// The keys of a part as keys of the whole that holds it, their names and those that they override under a
/// prefix. `member` is a pointer to the part, or a function that returns a reference to it.
template <class Named = void, class Member>
auto keys_of_part(const std::string& prefix, Member member,
                  const std::vector<Key<PartOf<Named, Member>>>& keys) {
  using Whole = OwnerOf<Named, Member>;
  std::vector<Key<Whole>> lifted;
  for (const auto& key : keys) {
    Key<Whole>& own = lifted.emplace_back(Key<Whole>{static_cast<const KeyDescription&>(key)});
    own.name = prefix + key.name;
    for (std::string& other : own.overrides) other = prefix + other;
    own.set = [member, set = key.set](Whole& whole, const Value& value) {
      set(std::invoke(member, whole), value);
    };
    own.get = [member, get = key.get](const Whole& whole) { return get(std::invoke(member, whole)); };
    const auto lift = [member](const auto& condition) -> std::function<bool(const Whole&)> {
      if (!condition) return {};
      return [member, condition](const Whole& whole) { return condition(std::invoke(member, whole)); };
    };
    own.is_written = lift(key.is_written);
    own.is_replaced = lift(key.is_replaced);
  }
  return lifted;
}

/// Several lists, of keys or of quantities, one after the other.
template <class Owner, template <class> class Described>
auto joined(std::initializer_list<std::vector<Described<Owner>>> lists) {
  std::vector<Described<Owner>> all;
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

/// The same keys; those that say nothing of it act on that part of the computation.
template <class Owner>
std::vector<Key<Owner>> acting_on(ActsOn part, std::vector<Key<Owner>> keys) {
  for (Key<Owner>& key : keys)
    if (key.acts_on == ActsOn::mechanics) key.acts_on = part;
  return keys;
}

// --- What else there is to say about a key: number_key(...) | written_where(...). ---

template <class Owner, std::invocable<Key<Owner>&> Change>
Key<Owner> operator|(Key<Owner> key, const Change& change) {
  change(key);
  return key;
}

/// It has no default: the user must give it.
inline auto required() {
  return [](KeyDescription& key) { key.required = true; };
}
/// Its default follows from others; whoever reads the file sets it.
inline auto usually(std::string words) {
  return [words](KeyDescription& key) { key.usual = words; };
}
/// Another value changes that part of a computation.
inline auto acting_on(ActsOn part) {
  return [part](KeyDescription& key) { key.acts_on = part; };
}
/// It takes back earlier values of others that would contradict it.
inline auto overriding(std::vector<std::string> others) {
  return [others](KeyDescription& key) { key.overrides = others; };
}
/// Of a list: it may also be [].
inline auto may_be_empty() {
  return [](KeyDescription& key) { key.may_be_empty = true; };
}
/// It is written back only where a condition on its owner holds.
template <class Condition>
auto written_where(Condition condition) {
  return [condition]<class Owner>(Key<Owner>& key) { key.is_written = condition; };
}
/// Something that follows from it is done to its owner after it is set.
template <class Consequence>
auto then(Consequence consequence) {
  return [consequence]<class Owner>(Key<Owner>& key) {
    key.set = [set = key.set, consequence](Owner& owner, const Value& value) {
      set(owner, value);
      consequence(owner);
    };
  };
}

}  // namespace launchsafe::keys
