#include "launchsafe/scene/pressure_curve.hpp"

#include "launchsafe/scene/quantity.hpp"
#include "launchsafe/scene/toml_reader.hpp"

#include <fmt/format.h>

#include <sstream>
#include <string_view>

namespace launchsafe::scene {
namespace {

constexpr std::string_view allowed_header =
    "a header that names quantities and units, such as time_ms,pressure_MPa";

std::string trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\"";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return std::string(text.substr(begin, text.find_last_not_of(blanks) - begin + 1));
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find_first_of(",;\t", begin), line.size());
    cells.push_back(trimmed(std::string_view(line).substr(begin, end - begin)));
    begin = end + 1;
  }
  return cells;
}

/// Which column holds what, and in which unit.
struct Header {
  std::size_t time_column = 0, pressure_column = 1;
  std::string time_unit, pressure_unit;
};

/// "pressure (MPa)" or "pressure_MPa" to "MPa".
std::string unit_in(const std::string& cell) {
  const std::size_t begin = cell.find_first_of("_([");
  if (begin == std::string::npos) return {};
  return trimmed(cell.substr(begin + 1, cell.find_first_of(")]", begin) - begin - 1));
}

/// The error in a header cell, if its unit is none of the dimension.
std::optional<InputError> check_unit(const std::string& cell, const std::string& unit, Dimension dimension,
                                     const Place& place) {
  if (parse_quantity("1 " + unit, dimension)) return std::nullopt;
  const auto units = units_of(dimension);
  return error_at(place, cell.substr(0, cell.find_first_of(" _([")),
                  unit.empty() ? fmt::format("\"{}\", without a unit", cell)
                               : fmt::format("\"{}\", with the unknown unit \"{}\"", cell, unit),
                  fmt::format("a {} in one of the units {}", name_of(dimension), fmt::join(units, ", ")),
                  nearest_of(unit, units));
}

Expected<Header> read_header(const std::string& line, const Place& place) {
  const auto cells = cells_of(line);
  const auto wrong = [&] {
    return error_at(place, {}, '"' + trimmed(line) + '"', std::string(allowed_header));
  };
  if (cells.size() != 2) return wrong();
  Header header;
  header.time_column = cells[0].starts_with("time") ? 0 : 1;
  header.pressure_column = 1 - header.time_column;
  const std::string& time = cells[header.time_column];
  const std::string& pressure = cells[header.pressure_column];
  if (!time.starts_with("time") || !pressure.starts_with("pressure")) return wrong();
  header.time_unit = unit_in(time);
  header.pressure_unit = unit_in(pressure);
  if (const auto error = check_unit(time, header.time_unit, Dimension::time, place)) return *error;
  if (const auto error = check_unit(pressure, header.pressure_unit, Dimension::pressure, place))
    return *error;
  return header;
}

Expected<double> read_cell(const std::string& cell, const std::string& unit, Dimension dimension,
                           const Place& place) {
  const bool plain =
      cell.find_first_of(" \t") == std::string::npos && parse_quantity(cell, Dimension::number);
  const auto value = parse_quantity(cell + " " + unit, dimension);
  if (plain && value) return *value;
  return error_at(place, dimension == Dimension::time ? "time" : "pressure", fmt::format("\"{}\"", cell),
                  fmt::format("a finite number of {}", unit));
}

/// Adds one point, which must come later than the last one.
std::optional<InputError> add_point(const std::vector<std::string>& cells, const Header& header,
                                    const Place& place, PressureCurve& curve) {
  if (cells.size() != 2) {
    return error_at(place, {}, fmt::format("{} values", cells.size()), "two values, a time and a pressure");
  }
  const auto time = read_cell(cells[header.time_column], header.time_unit, Dimension::time, place);
  if (!time) return time.error();
  const auto pressure =
      read_cell(cells[header.pressure_column], header.pressure_unit, Dimension::pressure, place);
  if (!pressure) return pressure.error();
  if (*pressure < 0.0 || *pressure > largest_load) {
    return error_at(place, "pressure", cells[header.pressure_column] + " " + header.pressure_unit,
                    fmt::format("a pressure of at least 0 {}, at most {}", header.pressure_unit,
                                format_quantity(largest_load, Dimension::pressure)));
  }
  if (!curve.time.empty() && !(*time > curve.time.back())) {
    return error_at(place, "time", cells[header.time_column] + " " + header.time_unit,
                    fmt::format("times in increasing order, here later than {}",
                                format_quantity(curve.time.back(), Dimension::time)));
  }
  curve.time.push_back(*time);
  curve.pressure.push_back(*pressure);
  return std::nullopt;
}

}  // namespace

Expected<PressureCurve> read_pressure_curve(const std::filesystem::path& file) {
  const auto text = read_text_file(file);
  if (!text) return text.error();
  return parse_pressure_curve(*text, file.string());
}

Expected<PressureCurve> parse_pressure_curve(const std::string& text, const std::string& file) {
  std::istringstream stream(text);
  std::optional<Header> header;
  PressureCurve curve;
  Place place{file};
  for (std::string line; std::getline(stream, line);) {
    ++place.line;
    const std::string content = trimmed(line);
    if (content.empty() || content.starts_with('#')) continue;
    if (!header) {
      auto read = read_header(line, place);
      if (!read) return read.error();
      header = std::move(*read);
    } else if (const auto error = add_point(cells_of(line), *header, place, curve)) {
      return *error;
    }
  }
  if (!header) return error_at({file, 1}, {}, "no header", std::string(allowed_header));
  if (curve.time.size() < 2) {
    return error_at(place, "time",
                    fmt::format("{} point{}", curve.time.size(), curve.time.size() == 1 ? "" : "s"),
                    "a curve of at least two points");
  }
  return curve;
}

}  // namespace launchsafe::scene
