// How keys and their values are written, for people and for programs.
#include "scene_file.hpp"

#include <sstream>

namespace launchsafe::scene {
namespace {

/// ", 0 cm to 1 cm", ", at least 0 K", ...; empty for any number.
std::string limits_text(const Limits& limits, Dimension dimension) {
  const std::string low = format_quantity(limits.lowest, dimension);
  const std::string high = format_quantity(limits.highest, dimension);
  if (std::isfinite(limits.lowest) && std::isfinite(limits.highest))
    return fmt::format(", {} {}to {}{}", low, limits.lowest_allowed ? "" : "(excluded) ", high,
                       limits.highest_allowed ? "" : " (excluded)");
  if (std::isfinite(limits.lowest)) return (limits.lowest_allowed ? ", at least " : ", more than ") + low;
  if (std::isfinite(limits.highest)) return (limits.highest_allowed ? ", at most " : ", less than ") + high;
  return {};
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

std::string allowed_text(const KeyDescription& key) {
  if (key.kind == KeyKind::flag) return "true or false";
  if (key.kind == KeyKind::word) return quoted_list(key.words);
  if (key.kind == KeyKind::words) return "any of " + quoted_list(key.words) + ", with commas between";
  if (key.kind == KeyKind::text)
    return "a text in quotation marks" + (key.example.empty() ? "" : ", such as \"" + key.example + '"');
  const std::vector<std::string> units = units_of(key.dimension);
  const std::string limits = limits_text(key.limits, key.dimension);
  std::string kind = fmt::format("a {}{}", name_of(key.dimension), limits);
  std::string example = example_of(key.dimension);
  if (key.kind != KeyKind::number) {
    const bool range = key.kind == KeyKind::range;
    example = fmt::format("\"{}{}{}\"", range ? "0 to 2.5" : "0, 1.5, 2", units.empty() ? "" : " ",
                          units.empty() ? "" : units.front());
    const std::string values =
        key.list_length > 0 ? fmt::format("{} values", key.list_length) : "one or more values";
    kind =
        range ? "a range, lower end first, of " + kind : fmt::format("a list of {}, each {}", values, kind);
  }
  const std::string listed = units.empty() ? "" : fmt::format(" (units: {})", fmt::join(units, ", "));
  return fmt::format("{}, such as {}{}", kind, example, listed);
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
