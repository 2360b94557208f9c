#include "launchsafe/scene/quantity.hpp"

#include "scene_file.hpp"

#include <charconv>
#include <set>
#include <system_error>

namespace launchsafe::scene {
namespace {

constexpr std::size_t dimension_count = static_cast<std::size_t>(Dimension::duration) + 1;

/// Most units are powers of ten of the SI unit, so that a decimal number converts without rounding twice. A
/// number in any other unit becomes (number + shift) * factor in SI.
struct Unit {
  std::string_view name;
  int power = 0;  ///< SI units per unit, as a power of ten
  long double factor = 1, shift = 0;
  bool is_decimal() const { return factor == 1 && shift == 0; }
};

constexpr Unit celsius(std::string_view name) { return {name, 0, 1, 273.15L}; }
constexpr Unit fahrenheit(std::string_view name) { return {name, 0, 5.0L / 9.0L, 459.67L}; }
constexpr long double inch = 0.0254L, foot = 12 * inch;  // m
/// Pa; pound-force (0.45359237 kg at 9.80665 m/s2) over square inch.
constexpr long double psi = 0.45359237L * 9.80665L / (inch * inch);

struct DimensionInfo {
  std::string_view name, example;         ///< a number as an example, in the first unit
  std::vector<Unit> units;                ///< the one to suggest first
  std::vector<std::string_view> display;  ///< units to try in this order when formatting for people
};

const DimensionInfo& info_of(Dimension dimension) {
  static const std::array<DimensionInfo, dimension_count> table{{
      {"number", "0.5", {}, {}},
      {"whole number", "2", {}, {}},
      {"length",
       "2.5",
       {{"cm", -2}, {"mm", -3}, {"m", 0}, {"um", -6}, {"\u00b5m", -6}, {"in", 0, inch}, {"ft", 0, foot}},
       {"cm", "mm", "\u00b5m", "m"}},
      {"time",
       "18",
       {{"ms", -3}, {"s", 0}, {"us", -6}, {"\u00b5s", -6}, {"ns", -9}},
       {"ms", "\u00b5s", "s", "ns"}},
      {"pressure",
       "496",
       {{"MPa", 6},
        {"GPa", 9},
        {"kPa", 3},
        {"Pa", 0},
        {"bar", 5},
        {"TPa", 12},
        {"kbar", 8},
        {"Mbar", 11},
        {"psi", 0, psi},
        {"ksi", 0, 1000 * psi},
        {"atm", 0, 101325}},
       {"MPa", "GPa", "TPa", "kPa", "Pa"}},
      {"temperature",
       "300",
       {{"K", 0},
        celsius("\u00b0C"),
        celsius("degC"),
        celsius("C"),
        fahrenheit("\u00b0F"),
        fahrenheit("degF"),
        fahrenheit("F")},
       {}},
      {"temperature difference", "5", {{"K", 0}}, {}},
      {"density", "1717", {{"kg/m3", 0}, {"g/cm3", 3}, {"kg/m^3", 0}, {"g/cm^3", 3}}, {}},
      {"speed", "300", {{"m/s", 0}, {"km/s", 3}, {"mm/us", 3}, {"cm/us", 4}, {"ft/s", 0, foot}}, {}},
      {"frequency", "7320", {{"1/s", 0}, {"1/ms", 3}, {"1/us", 6}}, {}},
      {"specific energy",
       "5.82",
       {{"MJ/kg", 6}, {"kJ/kg", 3}, {"J/kg", 0}, {"J/g", 3}, {"kJ/g", 6}},
       {"MJ/kg", "kJ/kg", "J/kg"}},
      {"specific heat", "1780", {{"J/(kg K)", 0}, {"J/kg/K", 0}, {"J/kgK", 0}, {"kJ/(kg K)", 3}}, {}},
      {"thermal conductivity", "0.246", {{"W/(m K)", 0}, {"W/m/K", 0}, {"W/mK", 0}}, {}},
      {"fracture toughness", "0.5", {{"MPa m^0.5", 6}, {"Pa m^0.5", 0}}, {"MPa m^0.5", "Pa m^0.5"}},
      {"share", "5", {{"%", -2}}, {"%"}},
      {"mass", "1", {{"kg", 0}, {"g", -3}}, {}},
      {"volume", "1", {{"cm3", -6}, {"m3", 0}}, {}},
      {"heat", "1", {{"kJ", 3}, {"J", 0}}, {}},
      {"heat per area", "1", {{"kJ/m2", 3}, {"J/m2", 0}}, {}},
      {"size of memory",
       "8",
       {{"GB", 9}, {"MB", 6}, {"TB", 12}, {"kB", 3}, {"B", 0}, {"MiB", 0, 0x1p20L}, {"GiB", 0, 0x1p30L}},
       {}},
      {"duration", "10", {{"min", 0, 60}, {"h", 0, 3600}, {"d", 0, 86400}, {"s", 0}}, {}},
  }};
  return table[static_cast<std::size_t>(dimension)];
}

std::optional<Unit> find_unit(Dimension dimension, std::string_view name) {
  const std::vector<Unit>& units = info_of(dimension).units;
  const auto found = std::ranges::find(units, name, &Unit::name);
  return found == units.end() ? std::nullopt : std::optional(*found);
}

InputError fault(std::string found, Dimension dimension, std::string suggestion = {}) {
  std::string allowed = fmt::format("a {}, such as {}", name_of(dimension), example_of(dimension));
  const std::vector<std::string> units = units_of(dimension);
  if (!units.empty()) allowed += fmt::format(" (units: {})", fmt::join(units, ", "));
  return {{}, 0, 0, {}, std::move(found), std::move(allowed), std::move(suggestion)};
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A number and what follows it, both as written.
struct Token {
  std::string_view number;
  std::string_view unit;
};

Token split(std::string_view text, std::string_view whole, Dimension dimension) {
  text = without_blanks_around(text);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status == std::errc::invalid_argument)
    throw fault(fmt::format("\"{}\", where no number is readable", whole), dimension);
  if (status == std::errc::result_out_of_range || !std::isfinite(value))
    throw fault(fmt::format("\"{}\", which is not a finite number", whole), dimension);
  const auto length = static_cast<std::size_t>(end - text.data());
  const std::string_view number = text.substr(0, length), rest = text.substr(length);
  return {number, without_blanks_around(rest)};
}

/// The double nearest to `number` times ten to the power.
double scaled(std::string_view number, int power) {
  const std::size_t e = number.find_first_of("eE");
  long long exponent = 0;
  if (e != std::string_view::npos) {
    std::string_view digits = number.substr(e + 1);
    if (digits.starts_with('+')) digits.remove_prefix(1);
    std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
  }
  const std::string decimal = fmt::format("{}e{}", number.substr(0, e), exponent + power);
  double value = 0.0;
  const auto [end, status] = std::from_chars(decimal.data(), decimal.data() + decimal.size(), value);
  // Out of range here is a number that underflows or overflows only in SI.
  if (status != std::errc{}) return exponent + power > 0 ? std::numeric_limits<double>::infinity() : 0.0;
  return value;
}

double convert(const Token& token, std::string_view whole, Dimension dimension) {
  const DimensionInfo& info = info_of(dimension);
  if (info.units.empty()) {
    if (!token.unit.empty()) throw fault(fmt::format("\"{}\", a number with a unit", whole), dimension);
    return scaled(token.number, 0);
  }
  if (token.unit.empty()) throw fault(fmt::format("\"{}\", without a unit", whole), dimension);
  // No unit is suggested: another one, however near in letters, makes another quantity of the number.
  const std::optional<Unit> unit = find_unit(dimension, token.unit);
  if (!unit) throw fault(fmt::format("\"{}\", with the unknown unit \"{}\"", whole, token.unit), dimension);
  double value = 0.0;
  if (unit->is_decimal()) {
    value = scaled(token.number, unit->power);
  } else {
    long double number = 0;
    std::from_chars(token.number.data(), token.number.data() + token.number.size(), number);
    value = static_cast<double>((number + unit->shift) * unit->factor);
  }
  if (!std::isfinite(value))
    throw fault(fmt::format("\"{}\", which is not a finite number", whole), dimension);
  return value;
}

/// Parts joined by a separator, each a number with its unit, or all with that of the last. What has no unit
/// beside several units may be meant in any of them.
std::vector<double> convert_all(const std::vector<std::string_view>& parts, std::string_view whole,
                                Dimension dimension) {
  std::vector<Token> tokens;
  for (const std::string_view part : parts) tokens.push_back(split(part, whole, dimension));
  std::set<std::string_view> units;
  for (const Token& token : tokens) units.insert(token.unit);
  if (units.contains("") && units.size() > 2)
    throw fault(fmt::format("\"{}\", where a number without a unit stands beside several units", whole),
                dimension);
  std::vector<double> values;
  for (Token& token : tokens) {
    if (token.unit.empty()) token.unit = tokens.back().unit;
    values.push_back(convert(token, whole, dimension));
  }
  return values;
}

}  // namespace

Dimension difference_of(Dimension dimension) {
  return dimension == Dimension::temperature ? Dimension::temperature_difference : dimension;
}

std::string_view name_of(Dimension dimension) { return info_of(dimension).name; }

std::string example_of(Dimension dimension) {
  const DimensionInfo& info = info_of(dimension);
  if (info.units.empty()) return std::string(info.example);
  return fmt::format("\"{} {}\"", info.example, info.units.front().name);
}

std::string_view si_unit_of(Dimension dimension) {
  const std::vector<Unit>& units = info_of(dimension).units;
  const auto si = std::ranges::find_if(units, [](const Unit& u) { return u.is_decimal() && u.power == 0; });
  return si == units.end() ? std::string_view{} : si->name;
}

std::vector<std::string> units_of(Dimension dimension) {
  std::vector<std::string> names;
  for (const Unit& unit : info_of(dimension).units) names.emplace_back(unit.name);
  return names;
}

double parse_quantity(std::string_view text, Dimension dimension) {
  return convert(split(text, text, dimension), text, dimension);
}

std::vector<double> parse_range(std::string_view text, Dimension dimension) {
  const auto wrong = [&](std::string_view why) {
    InputError error = fault(fmt::format("\"{}\", {}", text, why), dimension);
    error.allowed = fmt::format("a range, lower end first, such as \"0 to 2.5 {}\"", si_unit_of(dimension));
    return error;
  };
  const std::size_t separator = text.find(" to ");
  if (separator == std::string_view::npos) throw wrong("without \"to\"");
  const std::vector<double> values =
      convert_all({text.substr(0, separator), text.substr(separator + 4)}, text, dimension);
  if (!(values[0] < values[1])) throw wrong("which has no extent");
  return values;
}

std::vector<double> parse_list(std::string_view text, Dimension dimension) {
  for (std::size_t i = 1; i + 1 < text.size(); ++i)
    if (text[i] == ',' && is_digit(text[i - 1]) && is_digit(text[i + 1]))
      throw fault(fmt::format("\"{}\", where a comma without a blank may be a decimal point", text),
                  dimension);
  return convert_all(parts_of_list(text), text, dimension);
}

std::string format_quantity(double value_si, Dimension dimension) {
  const DimensionInfo& info = info_of(dimension);
  for (const std::string_view unit : info.display) {
    const double value = in_unit(value_si, dimension, unit);
    const bool reads_well = value_si == 0.0 || (std::abs(value) >= 0.0999999 && std::abs(value) < 999.9999);
    if (reads_well || dimension == Dimension::share) return fmt::format("{:.6g} {}", value, unit);
  }
  const std::string_view unit = si_unit_of(dimension);
  return fmt::format("{:.6g}{}{}", value_si, unit.empty() ? "" : " ", unit);
}

std::string length_text(double length) { return format_quantity(length, Dimension::length); }
std::string time_text(double time) { return format_quantity(time, Dimension::time); }
std::string pressure_text(double pressure) { return format_quantity(pressure, Dimension::pressure); }

double in_unit(double value_si, Dimension dimension, std::string_view unit_name) {
  const std::optional<Unit> unit = find_unit(dimension, unit_name);
  if (!unit) return std::numeric_limits<double>::quiet_NaN();
  if (!unit->is_decimal()) return static_cast<double>(value_si / unit->factor - unit->shift);
  const double factor = std::pow(10.0, std::abs(unit->power));
  return unit->power > 0 ? value_si / factor : value_si * factor;
}

double as_written(double value_si, Dimension dimension, std::string_view unit_name) {
  const std::optional<Unit> unit = find_unit(dimension, unit_name);
  const bool moves = unit && unit->power != 0 && std::isfinite(value_si);
  return moves ? scaled(fmt::format("{}", value_si), -unit->power) : value_si;
}

}  // namespace launchsafe::scene
