#include "launchsafe/scene/toml_reader.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>

namespace launchsafe::scene {
namespace {

/// A key as found in a table, by its dotted name.
struct Leaf {
  std::string name;
  const toml::node* node = nullptr;
};

bool is_prefix(const std::string& table, const std::vector<const KeyDescription*>& keys) {
  return std::any_of(keys.begin(), keys.end(),
                     [&](const KeyDescription* key) { return key->name.starts_with(table + "."); });
}

void collect_leaves(const toml::table& table, const std::string& prefix,
                    const std::vector<std::string>& elsewhere, std::vector<Leaf>& leaves) {
  for (const auto& [key, node] : table) {
    std::string name = prefix + std::string(key.str());
    if (std::find(elsewhere.begin(), elsewhere.end(), name) != elsewhere.end()) continue;
    const toml::table* inner = node.as_table();
    if (inner && !inner->empty()) {
      collect_leaves(*inner, name + ".", elsewhere, leaves);
    } else {
      leaves.push_back({std::move(name), &node});
    }
  }
}

bool stands_before(const Leaf& a, const Leaf& b) {
  const auto& first = a.node->source().begin;
  const auto& second = b.node->source().begin;
  return first.line != second.line ? first.line < second.line : first.column < second.column;
}

InputError error_for(const Place& place, const KeyDescription& key, std::string found,
                     std::string suggestion = {}) {
  return error_at(place, key.name, std::move(found), allowed_text(key), std::move(suggestion));
}

std::optional<InputError> check_limits(const std::vector<double>& numbers, const std::string& found,
                                       const KeyDescription& key, const Place& place) {
  for (const double number : numbers) {
    if (!key.limits.contain(number)) return error_for(place, key, found);
  }
  if (key.list_length > 0 && numbers.size() != key.list_length) {
    return error_for(place, key, fmt::format("{} with {} values", found, numbers.size()));
  }
  return std::nullopt;
}

/// A plain TOML number for a dimensionless key; a dimensional one needs its unit.
Expected<double> read_plain_number(const toml::node& node, const KeyDescription& key, const Place& place) {
  const double value = node.value<double>().value_or(std::numeric_limits<double>::quiet_NaN());
  if (!std::isfinite(value))
    return error_for(place, key, found_text(node) + ", which is not a finite number");
  const auto units = units_of(key.dimension);
  if (!units.empty()) {
    return error_for(place, key, found_text(node) + ", without a unit",
                     fmt::format("\"{} {}\"", found_text(node), units.front()));
  }
  if (key.dimension == Dimension::count && !node.is_integer()) {
    return error_for(place, key, found_text(node) + ", which is no whole number");
  }
  return value;
}

Expected<double> read_number(const toml::node& node, const KeyDescription& key, const Place& place) {
  if (node.is_number()) return read_plain_number(node, key, place);
  const auto text = node.value<std::string>();
  if (!text) return error_for(place, key, found_text(node));
  if (units_of(key.dimension).empty()) {
    const bool readable = parse_quantity(*text, key.dimension).has_value();
    return error_for(place, key, found_text(node) + ", which is a text", readable ? *text : std::string{});
  }
  const auto value = parse_quantity(*text, key.dimension);
  if (!value) return error_for(place, key, value.error().found, value.error().suggestion);
  return *value;
}

Expected<std::vector<double>> parse_numbers(const std::string& text, const KeyDescription& key,
                                            const Place& place) {
  const auto numbers =
      key.kind == KeyKind::range ? parse_range(text, key.dimension) : parse_list(text, key.dimension);
  if (!numbers) return error_for(place, key, numbers.error().found, numbers.error().suggestion);
  return *numbers;
}

Expected<std::vector<double>> read_numbers(const toml::node& node, const KeyDescription& key,
                                           const std::string& file) {
  const Place place = place_of(node, file);
  if (const auto text = node.value<std::string>()) return parse_numbers(*text, key, place);
  const toml::array* array = node.as_array();
  const bool too_short = array && array->empty() && !key.may_be_empty;
  if (!array || key.kind == KeyKind::range || too_short) return error_for(place, key, found_text(node));
  std::vector<double> numbers;
  for (const toml::node& element : *array) {
    const auto number = read_number(element, key, place_of(element, file));
    if (!number) return number.error();
    numbers.push_back(*number);
  }
  return numbers;
}

Expected<Value> checked_word(const std::string& word, const KeyDescription& key, const Place& place) {
  if (std::find(key.words.begin(), key.words.end(), word) != key.words.end()) return Value(word);
  const std::string near = nearest_of(word, key.words);
  return error_for(place, key, '"' + word + '"', near.empty() ? near : '"' + near + '"');
}

Expected<Value> checked_number(double number, const std::string& found, const KeyDescription& key,
                               const Place& place) {
  if (const auto error = check_limits({number}, found, key, place)) return *error;
  return Value(number);
}

std::string last_part(const std::string& name) { return name.substr(name.rfind('.') + 1); }

std::string section_of(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos ? std::string{} : name.substr(0, dot);
}

std::string nearest_key(const std::string& name, const std::vector<std::string>& known) {
  const std::string near = nearest_of(name, known);
  if (!near.empty()) return near;
  const std::string last = last_part(name);
  for (const std::string& candidate : known) {
    if (last_part(candidate) == last) return candidate;
  }
  for (const std::string& candidate : known) {
    if (last.size() > 3 && candidate.find(last) != std::string::npos) return candidate;
  }
  for (const std::string& candidate : known) {
    if (name.size() > 3 && candidate.starts_with(name.substr(0, 3))) return candidate;
  }
  return {};
}

}  // namespace

std::string found_text(const toml::node& node) {
  if (const auto* text = node.as_string()) return '"' + text->get() + '"';
  if (node.is_table()) return "a table";
  if (node.is_array_of_tables()) return "an array of tables";
  if (node.is_array() && node.as_array()->empty()) return "an empty array";
  std::ostringstream stream;
  node.visit([&stream](const auto& concrete) { stream << concrete; });
  return stream.str();
}

Place place_of(const toml::node& node, const std::string& file) {
  const auto& begin = node.source().begin;
  return {file, static_cast<int>(begin.line), static_cast<int>(begin.column)};
}

InputError error_at(const Place& place, std::string key, std::string found, std::string allowed,
                    std::string suggestion) {
  return {place.file,       place.line,         place.column,         std::move(key),
          std::move(found), std::move(allowed), std::move(suggestion)};
}

Expected<std::string> read_text_file(const std::filesystem::path& file) {
  std::error_code status;
  const Place place{file.string()};
  if (!std::filesystem::exists(file, status)) {
    std::vector<std::string> names;
    const auto folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    for (const auto& entry : std::filesystem::directory_iterator(folder, status)) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    const std::string near = nearest_of(file.filename().string(), names);
    return error_at(place, {}, "no such file", "a file that exists",
                    near.empty() ? near : '"' + (file.parent_path() / near).string() + '"');
  }
  if (std::filesystem::is_directory(file, status)) return error_at(place, {}, "a folder", "a file");
  std::ifstream stream(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!stream) return error_at(place, {}, "a file that cannot be read", "a readable file");
  return text;
}

Expected<toml::table> parse_toml(std::string_view text, const std::string& file) {
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    const auto& begin = error.source().begin;
    const Place place{file, static_cast<int>(begin.line), static_cast<int>(begin.column)};
    return error_at(place, {}, fmt::format("text that is not TOML ({})", error.description()),
                    "TOML, such as key = \"2.5 mm\"");
  }
}

Expected<toml::table> read_toml_file(const std::filesystem::path& file) {
  const auto text = read_text_file(file);
  if (!text) return text.error();
  return parse_toml(*text, file.string());
}

Expected<Value> read_value(const toml::node& node, const KeyDescription& key, const std::string& file) {
  const Place place = place_of(node, file);
  switch (key.kind) {
    case KeyKind::number: {
      const auto number = read_number(node, key, place);
      if (!number) return number.error();
      return checked_number(*number, found_text(node), key, place);
    }
    case KeyKind::list:
    case KeyKind::range: {
      auto numbers = read_numbers(node, key, file);
      if (!numbers) return numbers.error();
      if (const auto error = check_limits(*numbers, found_text(node), key, place)) return *error;
      return Value(std::move(*numbers));
    }
    case KeyKind::flag:
      if (const auto* flag = node.as_boolean()) return Value(flag->get());
      return error_for(place, key, found_text(node));
    case KeyKind::word:
      if (const auto* word = node.as_string()) return checked_word(word->get(), key, place);
      return error_for(place, key, found_text(node));
    case KeyKind::text:
      if (const auto* text = node.as_string()) return Value(text->get());
      return error_for(place, key, found_text(node));
  }
  return error_for(place, key, found_text(node));
}

Expected<Value> parse_value(std::string_view text, const KeyDescription& key, const Place& place) {
  const std::string written(text);
  switch (key.kind) {
    case KeyKind::number: {
      const auto number = parse_quantity(text, key.dimension);
      if (!number) return error_for(place, key, number.error().found, number.error().suggestion);
      if (key.dimension == Dimension::count && *number != std::round(*number)) {
        return error_for(place, key, written + ", which is no whole number");
      }
      return checked_number(*number, '"' + written + '"', key, place);
    }
    case KeyKind::list:
    case KeyKind::range: {
      auto numbers = parse_numbers(written, key, place);
      if (!numbers) return numbers.error();
      if (const auto error = check_limits(*numbers, '"' + written + '"', key, place)) return *error;
      return Value(std::move(*numbers));
    }
    case KeyKind::flag:
      if (text == "true" || text == "false") return Value(text == "true");
      return error_for(place, key, '"' + written + '"');
    case KeyKind::word:
      return checked_word(written, key, place);
    case KeyKind::text:
      return Value(written);
  }
  return error_for(place, key, '"' + written + '"');
}

Expected<std::vector<Value>> read_values(const toml::node& node, const KeyDescription& key,
                                         const std::string& file) {
  const auto* text = node.as_string();
  std::vector<Value> values;
  if (text && key.kind == KeyKind::number && !units_of(key.dimension).empty()) {
    const auto numbers = parse_numbers(text->get(), key, place_of(node, file));
    if (!numbers) return numbers.error();
    if (const auto error = check_limits(*numbers, found_text(node), key, place_of(node, file))) return *error;
    values.assign(numbers->begin(), numbers->end());
    return values;
  }
  const toml::array* array = node.as_array();
  if (!array) {
    auto value = read_value(node, key, file);
    if (!value) return value.error();
    return std::vector<Value>{std::move(*value)};
  }
  if (array->empty()) return error_for(place_of(node, file), key, found_text(node));
  for (const toml::node& element : *array) {
    auto value = read_value(element, key, file);
    if (!value) return value.error();
    values.push_back(std::move(*value));
  }
  return values;
}

InputError unknown_key(const Place& place, const std::string& name, const std::vector<std::string>& known) {
  const std::string section = section_of(name);
  std::vector<std::string> siblings;
  for (const std::string& candidate : known) {
    if (section_of(candidate) == section) siblings.push_back(last_part(candidate));
  }
  std::string allowed = section.empty() ? "the keys " : fmt::format("in [{}] the keys ", section);
  if (siblings.empty()) {
    for (const std::string& candidate : known) {
      const std::string other = section_of(candidate);
      if (other.empty() || std::find(siblings.begin(), siblings.end(), other) != siblings.end()) continue;
      siblings.push_back(other);
    }
    allowed = "the tables ";
  }
  return error_at(place, name, "an unknown key", allowed + fmt::format("{}", fmt::join(siblings, ", ")),
                  nearest_key(name, known));
}

Expected<ReadValues> read_described(const toml::table& table, const std::vector<const KeyDescription*>& keys,
                                    const std::vector<std::string>& elsewhere, const std::string& file) {
  std::vector<Leaf> leaves;
  collect_leaves(table, "", elsewhere, leaves);
  std::stable_sort(leaves.begin(), leaves.end(), stands_before);
  std::vector<std::string> known = elsewhere;
  for (const KeyDescription* key : keys) known.push_back(key->name);

  ReadValues read;
  for (const Leaf& leaf : leaves) {
    const Place place = place_of(*leaf.node, file);
    const auto key =
        std::find_if(keys.begin(), keys.end(), [&](const auto* k) { return k->name == leaf.name; });
    if (key == keys.end()) {
      if (!is_prefix(leaf.name, keys)) return unknown_key(place, leaf.name, known);
      if (leaf.node->is_table()) continue;
      return error_at(place, leaf.name, found_text(*leaf.node),
                      fmt::format("a table, written [{}]", leaf.name));
    }
    auto value = read_value(*leaf.node, **key, file);
    if (!value) return value.error();
    read.values.emplace_back(static_cast<std::size_t>(key - keys.begin()), std::move(*value));
    read.places.emplace(leaf.name, place);
  }
  for (const KeyDescription* key : keys) {
    if (key->required && !read.places.contains(key->name)) {
      return error_for(place_of(table, file), *key, "nothing; the key is missing");
    }
  }
  std::sort(read.values.begin(), read.values.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  return read;
}

}  // namespace launchsafe::scene
