// A measured chamber pressure from text: two columns under a header that names their units.
#include "launchsafe/scene/load.hpp"
#include "scene_file.hpp"

#include <boost/locale/utf.hpp>

#include <sstream>

namespace launchsafe::scene {
namespace {

constexpr std::string_view allowed_header =
    "a header that names quantities and units, such as time_ms,pressure_MPa or \"Time (ms);Pressure (bar)\"";

/// One column of the curve.
struct Column {
  std::size_t cell = 0;
  Dimension dimension = Dimension::time;
  std::string name = {}, unit = {};  ///< as in the header
};

struct Header {
  char separator = ',';
  std::size_t columns = 2;
  Column time, pressure;
};

/// The cells of a line without blanks and quotation marks around them.
std::vector<std::string> cells_of(std::string_view line, char separator) {
  std::vector<std::string> cells;
  for (std::string_view cell : parts_of_list(line, separator)) {
    if (cell.size() > 1 && cell.starts_with('"') && cell.ends_with('"'))
      cell = without_blanks_around(cell.substr(1, cell.size() - 2));
    cells.emplace_back(cell);
  }
  return cells;
}

/// "pressure (MPa)", "pressure_MPa", "p / MPa" or "Pressure in MPa" as name and unit.
Column column_of(const std::string& cell, std::size_t index) {
  const std::size_t mark = cell.find_first_of("_([/"), word = cell.find(" in ");
  const std::size_t end = std::min({mark, word, cell.size()});
  Column column{.cell = index, .name = std::string(without_blanks_around(cell.substr(0, end)))};
  std::string unit = end < cell.size() ? cell.substr(end + (word < mark ? 4 : 1)) : "";
  unit = without_blanks_around(unit);
  if (unit.ends_with(')') || unit.ends_with(']')) unit.pop_back();
  column.unit = without_blanks_around(unit);
  return column;
}

/// Whether a number with the column's unit is of a dimension.
bool is_in_units_of(const Column& column, Dimension dimension) {
  return contains(units_of(dimension), column.unit);
}

/// The one column in a unit of the dimension, or of the wanted name: of several the user must say which.
Column chosen_column(const std::vector<Column>& columns, Dimension dimension, const Place& place,
                     const std::string& wanted) {
  std::vector<Column> found;
  std::vector<std::string> names;
  for (const Column& column : columns) {
    if (!is_in_units_of(column, dimension)) continue;
    names.push_back(column.name);
    if (wanted.empty() || column.name == wanted) found.push_back(column);
  }
  if (found.size() == 1) {
    found.front().dimension = dimension;
    return found.front();
  }
  throw error_at(place, name_of(dimension),
                 wanted.empty() ? fmt::format("{} columns in units of {}", found.size(), name_of(dimension))
                                : fmt::format("no single column \"{}\"", wanted),
                 names.empty() ? std::string(allowed_header)
                               : fmt::format("one of the columns {}, by --pressure", quoted_list(names)),
                 nearest_of(wanted, names));
}

/// `gauge`: the pressure's column in a gauge's record, or nullptr.
Header read_header(std::string_view line, const Place& place, const std::string* gauge) {
  const char separator = contains(line, ';') ? ';' : contains(line, '\t') ? '\t' : ',';
  std::vector<Column> columns;
  for (const std::string& cell : cells_of(line, separator))
    columns.push_back(column_of(cell, columns.size()));
  if (columns.size() < 2 || (columns.size() > 2 && gauge == nullptr))
    throw error_at(place, {}, fmt::format("\"{}\"", line), allowed_header);
  return {separator, columns.size(), chosen_column(columns, Dimension::time, place, {}),
          chosen_column(columns, Dimension::pressure, place, gauge == nullptr ? "" : *gauge)};
}

/// Which marks of decimals the numbers of a file have.
struct Decimals {
  bool points = false, commas = false;
};

double read_cell(const std::string& cell, const Header& header, const Column& column, Decimals& decimals,
                 const Place& place) {
  std::string number = cell;
  decimals.points = decimals.points || contains(number, '.');
  if (const std::size_t comma = number.find(','); comma != std::string::npos) {
    decimals.commas = true;
    number[comma] = '.';
  }
  const auto value = caught([&] {
    parse_quantity(number, Dimension::number);
    return parse_quantity(number + " " + column.unit, column.dimension);
  });
  if (value && !(decimals.points && decimals.commas)) return *value;
  throw error_at(place, name_of(column.dimension), fmt::format("\"{}\"", cell),
                 fmt::format("a finite number of {}, with one decimal mark in the whole file{}", column.unit,
                             header.separator == ',' ? "" : ", a point or a comma"));
}

/// Adds the point of one line, which must come later than the last one. `lowest`: pressure, Pa.
void add_point(std::string_view line, const Header& header, double lowest, Decimals& decimals,
               const Place& place, PressureCurve& curve) {
  const std::vector<std::string> cells = cells_of(line, header.separator);
  if (cells.size() != header.columns)
    throw error_at(place, {}, fmt::format("{} values", cells.size()),
                   fmt::format("{} values, as in the header{}", header.columns,
                               header.separator == ',' ? "; with decimal commas, semicolons between" : ""));
  const auto read = [&](const Column& column) {
    return read_cell(cells[column.cell], header, column, decimals, place);
  };
  const double time = read(header.time), pressure = read(header.pressure);
  if (pressure < lowest || pressure > largest_load)
    throw error_at(place, "pressure", pressure_text(pressure),
                   fmt::format("{} to {}", pressure_text(lowest), pressure_text(largest_load)),
                   pressure < lowest ? "launchsafe import-curve, for the offset of a gauge" : "");
  if (std::abs(time) > largest_curve_time)
    throw error_at(place, "time", time_text(time), "a time within 1e6 s of the start");
  if (!curve.time.empty() && !(time - curve.time.back() > least_curve_interval))
    throw error_at(place, "time", time_text(time),
                   "times in increasing order, here later than " + time_text(curve.time.back()));
  curve.time.push_back(time);
  curve.pressure.push_back(pressure);
}

/// No propellant takes a tenth of a second from a tenth of the largest pressure to all of it: a record in ms
/// has been called one in s.
void check_rise(const PressureCurve& curve, const Place& header) {
  constexpr double longest_rise = 0.1, share_at_foot = 0.1;
  const auto [lowest, largest] = std::ranges::minmax(curve.pressure);
  const double level = lowest + share_at_foot * (largest - lowest);
  double foot = curve.time.front(), rise = 0.0;
  for (std::size_t i = 0; i < curve.time.size(); ++i) {
    if (curve.pressure[i] <= level) foot = curve.time[i];
    rise = curve.time[i] - foot;
    if (curve.pressure[i] == largest) break;
  }
  if (rise <= longest_rise) return;
  throw error_at(header, "time", fmt::format("a peak that rises in {:.3g} s", rise),
                 fmt::format("a rise within {:g} s; the header's unit of time is wrong", longest_rise));
}

void check_encoding(const std::string& text, const std::string& file) {
  for (const char* at = text.data(); at != text.data() + text.size();) {
    const auto code = boost::locale::utf::utf_traits<char>::decode(at, text.data() + text.size());
    if (code == 0 || !boost::locale::utf::is_valid_codepoint(code))
      throw error_at({file}, {}, "a byte that is no UTF-8, as in UTF-16 or in a file that is no text",
                     "text in UTF-8");
  }
}

/// `gauge`: the pressure's column in a gauge's record; none for a curve that is a load.
PressureCurve parse(const std::string& text, const std::string& file, const std::string* gauge) {
  check_encoding(text, file);
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  std::istringstream lines(text.substr(text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0));
  PressureCurve curve;
  std::optional<Header> header;
  Decimals decimals;
  Place place{file}, place_of_header{file, 1};
  for (std::string line; std::getline(lines, line);) {
    ++place.line;
    const std::string_view content = without_blanks_around(line);
    if (content.empty() || content.starts_with('#')) continue;
    if (header) {
      add_point(content, *header, gauge ? -largest_load : 0.0, decimals, place, curve);
    } else {
      header = read_header(content, place, gauge);
      place_of_header = place;
    }
  }
  if (!header) throw error_at(place_of_header, {}, "no header", allowed_header);
  if (curve.time.size() < 2)
    throw error_at(place, "time", fmt::format("{} points", curve.time.size()),
                   "a curve of at least two points");
  check_rise(curve, place_of_header);
  return curve;
}

}  // namespace

PressureCurve parse_pressure_curve(const std::string& text, const std::string& file) {
  return parse(text, file, nullptr);
}

PressureCurve parse_gauge_record(const std::string& text, const std::string& file,
                                 const std::string& column) {
  return parse(text, file, &column);
}

}  // namespace launchsafe::scene
