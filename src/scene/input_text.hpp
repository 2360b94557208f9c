// Text of input files before it is parsed: what no reader may see, and what all readers do with text.
#pragma once

#include "launchsafe/scene/input_error.hpp"

#include <algorithm>

namespace launchsafe::scene {

template <class List, class Value>
bool contains(const List& list, const Value& value) {
  return std::ranges::find(list, value) != list.end();
}

/// In quotation marks; nothing for nothing.
inline std::string in_quotes(const std::string& text) { return text.empty() ? text : '"' + text + '"'; }

/// The value of a key; null where a map has it not.
template <class Map>
const typename Map::mapped_type* find_in(const Map& map, const std::string& key) {
  const auto found = map.find(key);
  return found == map.end() ? nullptr : &found->second;
}

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& each : all) names.push_back(each.name);
  return names;
}

/// Without blanks, tabs and line ends at its ends.
std::string_view without_blanks_around(std::string_view text);

/// "a, b" as its parts between commas, without blanks around them; at least one, which may be empty.
std::vector<std::string_view> parts_of_list(std::string_view text);

/// With small letters (ASCII).
std::string lower_case(std::string_view text);

/// Throws the fault of the first byte of a text that is no UTF-8, or a NUL, with its line.
void check_encoding(std::string_view text, const std::string& file);

/// Throws that of TOML nested deeper than any scene or study is, which would exhaust the stack of whoever
/// walks through it: brackets inside each other, or a dotted key of many parts.
void check_nesting(std::string_view toml, const std::string& file);

}  // namespace launchsafe::scene
