#include "launchsafe/scene/load.hpp"
#include "scene_file.hpp"

namespace launchsafe::scene {
namespace {

/// The next line of a text, which is shortened by it; lines end with LF, CRLF or CR.
std::string_view take_line(std::string_view& text) {
  const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
  const std::string_view line = text.substr(0, end);
  const std::string_view rest = text.substr(end);
  text.remove_prefix(end + (rest.starts_with("\r\n") ? 2 : std::min<std::size_t>(rest.size(), 1)));
  return line;
}

/// The first of semicolon, tab and comma in this header; a comma if it has none.
char separator_of(std::string_view header) {
  for (const char separator : {';', '\t'})
    if (contains(header, separator)) return separator;
  return ',';
}

/// The cells of a line without blanks and quotation marks around them. Nothing where a quotation mark stands
/// elsewhere, as where there is a separator within a pair of them.
std::optional<std::vector<std::string>> cells_of(std::string_view line, char separator) {
  std::vector<std::string> cells;
  for (std::string_view cell : parts_of_list(line, separator)) {
    if (cell.size() > 1 && cell.starts_with('"') && cell.ends_with('"'))
      cell = without_blanks_around(cell.substr(1, cell.size() - 2));
    if (contains(cell, '"')) return std::nullopt;
    cells.emplace_back(cell);
  }
  return cells;
}

constexpr std::string_view allowed_header =
    "a header that names quantities and units, such as time_ms,pressure_MPa or \"Time (ms);Pressure (bar)\"";

/// One column of the curve.
struct Column {
  std::size_t cell = 0;
  Dimension dimension = Dimension::time;
  std::string name;  ///< as in the header, without the unit
  std::string unit;
};

struct Header {
  char separator = ',';
  std::size_t columns = 2;
  Column time, pressure;
};

/// "pressure (MPa)", "pressure_MPa", "p / MPa" or "Pressure in MPa" as name and unit. After the unit's
/// bracket nothing may follow: it could be a factor.
Column column_of(const std::string& cell, std::size_t index) {
  const std::size_t mark = cell.find_first_of("_([/"), word = cell.find(" in ");
  const std::size_t name_end = std::min(mark, word);
  Column column;
  column.cell = index;
  column.name = without_blanks_around(std::string_view(cell).substr(0, name_end));
  if (name_end == std::string::npos) return column;
  std::string_view unit =
      without_blanks_around(std::string_view(cell).substr(name_end + (word < mark ? 4 : 1)));
  const char bracket = word < mark ? ' ' : cell[mark];
  if ((bracket == '(' && unit.ends_with(')')) || (bracket == '[' && unit.ends_with(']')))
    unit.remove_suffix(1);
  column.unit = without_blanks_around(unit);
  return column;
}

/// Whether a column's name is the word, whatever its case and the words that follow, or its letter.
bool is_named(const Column& column, std::string_view word) {
  const std::string name = lower_case(column.name);
  if (name == word.substr(0, 1)) return true;
  const auto may_belong = [](char c) {
    return c == ' ' || c == '-' || std::isalpha(static_cast<unsigned char>(c)) != 0;
  };
  return name.starts_with(word) && std::ranges::all_of(name, may_belong);
}

/// A column's unit must be one of its dimension.
void check_unit(const Column& column, const Place& place) {
  if (parse_quantity("1 " + column.unit, column.dimension)) return;
  throw error_at(place, name_of(column.dimension),
                 column.unit.empty()
                     ? fmt::format("\"{}\", without a unit", column.name)
                     : fmt::format("\"{}\" with the unknown unit \"{}\"", column.name, column.unit),
                 fmt::format("a {} in one of the units {}", name_of(column.dimension),
                             fmt::join(units_of(column.dimension), ", ")));
}

/// The one column in a unit of the dimension, or of the wanted name: of several the user must say which.
Column chosen_column(const std::vector<Column>& columns, Dimension dimension, const Place& place,
                     const std::string& wanted) {
  std::vector<Column> found;
  std::vector<std::string> names;
  for (const Column& column : columns) {
    if (!parse_quantity("1 " + column.unit, dimension)) continue;
    names.push_back(column.name);
    if (wanted.empty() || column.name == wanted) found.push_back(column);
  }
  if (found.size() == 1) return found.front();
  const std::string_view quantity = name_of(dimension);
  throw error_at(place, quantity,
                 wanted.empty() ? fmt::format("{} columns in units of {}", found.size(), quantity)
                                : fmt::format("no single column \"{}\" in units of {}", wanted, quantity),
                 names.empty() ? std::string(allowed_header)
                               : fmt::format("one of the columns {}{}", quoted_list(names),
                                             dimension == Dimension::pressure ? ", by --pressure" : ""),
                 nearest_of(wanted, names));
}

/// `gauge`: the pressure's column in a gauge's record, or nullptr.
Header read_header(std::string_view line, const Place& place, const std::string* gauge) {
  const char separator = separator_of(line);
  const auto cells = cells_of(line, separator);
  std::vector<Column> columns;
  for (std::size_t i = 0; cells && i < cells->size(); ++i) columns.push_back(column_of((*cells)[i], i));
  const auto wrong = [&] { return error_at(place, {}, fmt::format("\"{}\"", line), allowed_header); };
  if (columns.size() < 2 || (columns.size() > 2 && gauge == nullptr)) throw wrong();
  Header header{separator, columns.size(), columns[0], columns[1]};
  if (gauge != nullptr) {
    header.time = chosen_column(columns, Dimension::time, place, {});
    header.pressure = chosen_column(columns, Dimension::pressure, place, *gauge);
  } else {
    if (!is_named(header.time, "time")) std::swap(header.time, header.pressure);
    if (!is_named(header.time, "time") || !is_named(header.pressure, "pressure")) throw wrong();
  }
  header.pressure.dimension = Dimension::pressure;
  check_unit(header.time, place);
  check_unit(header.pressure, place);
  return header;
}

/// What marks the decimals of a curve's numbers. A point beside a comma, and a comma that always has three
/// digits after it, may as well divide thousands.
class DecimalMark {
 public:
  /// The number with a point for its comma.
  std::string pointed(std::string number, const std::string& key, const Place& place) {
    const std::size_t comma = number.find(',');
    const bool has_comma = comma != std::string::npos;
    commas_ = commas_ || has_comma;
    points_ = points_ || contains(number, '.');
    if (commas_ && points_)
      throw error_at(place, key,
                     fmt::format("\"{}\", in a file that has points and commas in its numbers", number),
                     "one decimal mark, and nothing between thousands");
    if (!has_comma) return number;
    if (!may_divide_thousands(number, comma)) {
      sure_ = true;
    } else if (!ambiguous_) {
      ambiguous_ = error_at(
          place, key, fmt::format("\"{}\", where the comma may divide thousands", number),
          "numbers with decimal points, or at least one that shows what the commas are, such as 0,5");
    }
    number[comma] = '.';
    return number;
  }

  /// Commas none of which can only be that of decimals.
  void check() const {
    if (ambiguous_ && !sure_) throw *ambiguous_;
  }

 private:
  /// "1,250" but not "0,250", "1,25" or "1,250e3".
  static bool may_divide_thousands(const std::string& number, std::size_t comma) {
    const std::size_t begin = number.find_first_not_of("+-");
    return begin < comma && comma - begin <= 3 && number[begin] != '0' && number.size() == comma + 4 &&
           std::all_of(number.begin() + static_cast<std::ptrdiff_t>(begin), number.end(),
                       [](char c) { return c == ',' || (c >= '0' && c <= '9'); });
  }

  bool commas_ = false, points_ = false;  ///< seen in any number
  bool sure_ = false;                     ///< whether a comma was seen that can only be that of decimals
  Fault ambiguous_;                       ///< of the first comma that may be another one
};

InputError wrong_count(const Header& header, std::size_t count, const Place& place) {
  const char* separator = header.separator == ','   ? "a comma"
                          : header.separator == ';' ? "a semicolon"
                                                    : "a tab";
  const bool decimal_commas = header.separator == ',' && count > header.columns;
  const std::string values = header.columns == 2
                                 ? std::string("two values, a time and a pressure,")
                                 : fmt::format("{} values, one for each column,", header.columns);
  return error_at(
      place, {}, fmt::format("{} value{}", count, count == 1 ? "" : "s"),
      fmt::format("{} with {} between them{}", values, separator,
                  decimal_commas ? "; where numbers have decimal commas, a semicolon in every line"
                                 : " as in the header"));
}

double read_cell(const std::string& cell, const Column& column, DecimalMark& decimals, const Place& place) {
  const std::string key(name_of(column.dimension)), number = decimals.pointed(cell, key, place);
  const bool plain =
      number.find_first_of(" \t") == std::string::npos && parse_quantity(number, Dimension::number);
  const auto value = parse_quantity(number + " " + column.unit, column.dimension);
  if (plain && value) return *value;
  throw error_at(place, key, fmt::format("\"{}\"", cell), fmt::format("a finite number of {}", column.unit));
}

/// Adds the point of one line, which must come later than the last one. `lowest`: pressure, Pa.
void add_point(std::string_view line, const Header& header, double lowest, DecimalMark& decimals,
               const Place& place, PressureCurve& curve) {
  const auto cells = cells_of(line, header.separator);
  if (!cells)
    throw error_at(place, {}, "a quotation mark within a cell", "\"0.5\", without a separator in it");
  if (cells->size() != header.columns) throw wrong_count(header, cells->size(), place);
  const auto fault = [&](const Column& column, std::string allowed, std::string suggestion = {}) {
    return error_at(place, name_of(column.dimension), (*cells)[column.cell] + " " + column.unit, allowed,
                    suggestion);
  };
  const double time = read_cell((*cells)[header.time.cell], header.time, decimals, place),
               pressure = read_cell((*cells)[header.pressure.cell], header.pressure, decimals, place);
  if (pressure < lowest || pressure > largest_load)
    throw fault(header.pressure,
                fmt::format("a pressure of at least {}, at most {}",
                            lowest < 0.0 ? pressure_text(lowest) : "0 " + header.pressure.unit,
                            pressure_text(largest_load)),
                pressure < lowest ? "launchsafe import-curve, for the offset of a gauge" : "");
  if (std::abs(time) > largest_curve_time)
    throw fault(header.time, fmt::format("a time within {} of the start", time_text(largest_curve_time)));
  if (!curve.time.empty() && !(time - curve.time.back() > least_curve_interval))
    throw fault(header.time, fmt::format("times in increasing order, here later than {} by more than {}",
                                         time_text(curve.time.back()), time_text(least_curve_interval)));
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

/// `gauge`: the pressure's column in a gauge's record; none for a curve that is a load.
PressureCurve parse(const std::string& text, const std::string& file, const std::string* gauge) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
    throw error_at({file, 1}, {}, "text in UTF-16", "text in UTF-8");
  check_encoding(text, file);
  std::string_view rest = text;
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (rest.starts_with(byte_order_mark)) rest.remove_prefix(byte_order_mark.size());
  PressureCurve curve;
  std::optional<Header> header;
  DecimalMark decimals;
  Place place{file}, place_of_header;
  while (!rest.empty()) {
    ++place.line;
    const std::string_view line = take_line(rest);
    const std::string_view content = without_blanks_around(line);
    if (content.empty() || content.starts_with('#')) continue;
    if (header) {
      add_point(line, *header, gauge ? -largest_load : 0.0, decimals, place, curve);
    } else {
      header = read_header(line, place, gauge);
      place_of_header = place;
    }
  }
  if (!header) throw error_at({file, 1}, {}, "no header", allowed_header);
  if (curve.time.size() < 2)
    throw error_at(place, "time",
                   fmt::format("{} point{}", curve.time.size(), curve.time.size() == 1 ? "" : "s"),
                   "a curve of at least two points");
  decimals.check();
  check_rise(curve, place_of_header);
  return curve;
}

}  // namespace

Expected<PressureCurve> read_pressure_curve(const std::filesystem::path& file) {
  return caught(
      [&] { return parse(read_text_file(file, largest_curve).or_throw(), file.string(), nullptr); });
}

Expected<PressureCurve> parse_pressure_curve(const std::string& text, const std::string& file) {
  return caught([&] { return parse(text, file, nullptr); });
}

Expected<PressureCurve> parse_gauge_record(const std::string& text, const std::string& file,
                                           const std::string& column) {
  return caught([&] { return parse(text, file, &column); });
}

}  // namespace launchsafe::scene
