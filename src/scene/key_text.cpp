// How keys and their values are written, for people and for programs.
#include "launchsafe/scene/toml_reader.hpp"

#include <array>
#include <cmath>
#include <sstream>

namespace launchsafe::scene {
namespace {

/// "0 cm to 1 cm", "at least 0 K", ...; empty for any number.
std::string limits_text(const Limits& limits, Dimension dimension) {
  const auto shown = [&](double value) { return format_quantity(value, dimension); };
  const bool low = std::isfinite(limits.lowest), high = std::isfinite(limits.highest);
  if (low && high)
    return fmt::format("{} {}to {}{}", shown(limits.lowest), limits.lowest_allowed ? "" : "(excluded) ",
                       shown(limits.highest), limits.highest_allowed ? "" : " (excluded)");
  if (low)
    return fmt::format("{}{}", limits.lowest_allowed ? "at least " : "more than ", shown(limits.lowest));
  if (high)
    return fmt::format("{}{}", limits.highest_allowed ? "at most " : "less than ", shown(limits.highest));
  return {};
}

/// Numbers in the first unit, as one text.
std::string example_of_numbers(const KeyDescription& key, const char* numbers) {
  const auto units = units_of(key.dimension);
  return fmt::format("\"{}{}\"", numbers, units.empty() ? std::string{} : " " + units.front());
}

/// As toml++ writes it, which is in single quotes wherever nothing needs an escape.
std::string string_as_toml(const std::string& string) {
  const auto is_plain = [](char c) { return c >= ' ' && c <= '~' && c != '"' && c != '\'' && c != '\\'; };
  if (!string.empty() && std::ranges::all_of(string, is_plain)) return "'" + string + "'";
  std::ostringstream stream;
  stream << toml::value<std::string>(string);
  return stream.str();
}

}  // namespace

std::string_view letter_of(Standing standing) {
  constexpr std::array<std::string_view, 6> letters{"input", "P", "L", "D", "A", "C"};
  return letters[static_cast<std::size_t>(standing)];
}

std::string_view meaning_of(Standing standing) {
  constexpr std::array<std::string_view, 6> meanings{
      "given in the file", "stated in the paper", "literature", "derived", "assumed", "calibrated"};
  return meanings[static_cast<std::size_t>(standing)];
}

std::string example_of(const KeyDescription& key) {
  switch (key.kind) {
    case KeyKind::flag:
      return "true";
    case KeyKind::word:
    case KeyKind::words:
      return fmt::format("\"{}\"", key.words.front());
    case KeyKind::text:
      return fmt::format("\"{}\"", key.example);
    case KeyKind::list:
      return example_of_numbers(key, "0, 1.5, 2");
    case KeyKind::range:
      return example_of_numbers(key, "0 to 2.5");
    case KeyKind::number:
      return std::string(example_of(key.dimension));
  }
  return {};
}

std::string allowed_text(const KeyDescription& key) {
  const std::string_view name = name_of(key.dimension);
  const std::string range = limits_text(key.limits, key.dimension);
  const std::string limits = range.empty() ? range : ", " + range;
  std::string units = fmt::format("{}", fmt::join(units_of(key.dimension), ", "));
  if (!units.empty()) units = fmt::format(" (units: {})", units);
  switch (key.kind) {
    case KeyKind::flag:
      return "true or false";
    case KeyKind::word:
      return quoted_list(key.words);
    case KeyKind::words:
      return "any of " + quoted_list(key.words) + ", with commas between";
    case KeyKind::text:
      return key.example.empty() ? "a text in quotation marks"
                                 : "a text in quotation marks, such as " + example_of(key);
    case KeyKind::number:
      return fmt::format("a {}{}, such as {}{}", name, limits, example_of(key), units);
    case KeyKind::range:
      return fmt::format("a range, lower end first, of a {}{}, such as {}{}", name, limits, example_of(key),
                         units);
    case KeyKind::list:
      return fmt::format(
          "a list of {}, each a {}{}, such as {}{}",
          key.list_length > 0 ? fmt::format("{} values", key.list_length) : "one or more values", name,
          limits, example_of(key), units);
  }
  return {};
}

std::string format_value(const KeyDescription& key, const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) {
    // Cells of all sizes are in one unit, to compare them.
    if (key.name.ends_with("cell_size") && std::isfinite(*number))
      return fmt::format("{:.6g} mm", in_unit(*number, key.dimension, "mm"));
    return format_quantity(*number, key.dimension);
  }
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  std::vector<std::string> numbers;
  for (const double number : std::get<std::vector<double>>(value))
    numbers.push_back(format_quantity(number, key.dimension));
  return fmt::format("{}", fmt::join(numbers, key.kind == KeyKind::range ? " to " : ", "));
}

std::string exact_toml(const KeyDescription& key, const Value& value) {
  const std::string_view unit = key.dimension == Dimension::share ? "%" : si_unit_of(key.dimension);
  const auto written = [&](double number) { return as_written(number, key.dimension, unit); };
  if (const auto* number = std::get_if<double>(&value))
    return unit.empty() ? fmt::format("{}", *number) : fmt::format("\"{} {}\"", written(*number), unit);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* string = std::get_if<std::string>(&value)) return string_as_toml(*string);
  std::vector<double> numbers = std::get<std::vector<double>>(value);
  if (numbers.empty()) return "[]";
  std::ranges::transform(numbers, numbers.begin(), written);
  return fmt::format("\"{}{}{}\"", fmt::join(numbers, key.kind == KeyKind::range ? " to " : ", "),
                     unit.empty() ? "" : " ", unit);
}

bool same_value(const Value& a, const Value& b, double tolerance) {
  if (a.index() != b.index()) return false;
  const auto is_same = [tolerance](double one, double other) {
    return one == other || std::abs(one - other) <= tolerance * std::max(std::abs(one), std::abs(other));
  };
  if (const auto* number = std::get_if<double>(&a)) return is_same(*number, std::get<double>(b));
  const auto* numbers = std::get_if<std::vector<double>>(&a);
  return numbers == nullptr ? a == b
                            : std::ranges::equal(*numbers, std::get<std::vector<double>>(b), is_same);
}

}  // namespace launchsafe::scene
