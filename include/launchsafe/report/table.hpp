// Numbers as text; tables as values, made of typed rows and a list of quantities, and as text for people and
// for programs.
#pragma once

#include "launchsafe/keys/quantity.hpp"

#include <fmt/ranges.h>
#include <nlohmann/json_fwd.hpp>

namespace launchsafe::report {

/// `decimals` digits after the point: 416.10. Never "-0.0". Not a number is "n/a", infinity "inf".
std::string fixed(double value, int decimals);

/// `decimals` digits after the first: 1.50e-05. Not a number and infinity as in `fixed`.
std::string scientific(double value, int decimals);

/// `digits` significant digits without trailing zeros; with a power of ten below 1e-4 and from 1e6 on.
std::string significant(double value, int digits);

/// The shortest text that reads back as exactly the same number; "NaN", "Infinity", "-Infinity" for the
/// others.
std::string exact(double value);

/// The smallest of 1, 2 and 5 times the powers of ten that is at least so large (> 0): for marks on an axis.
double round_distance(double least);

/// A duration in seconds for people: "0.3 s", "42 s", "3 min 05 s", "2 h 14 min", "3 d 04 h".
std::string duration(double seconds);

/// Bytes of the shortest text that, where it is the same in all rows of a table, is said once beside them.
constexpr std::size_t shortest_shared_sentence = 60;

/// "1 case", "3 cases".
std::string counted(std::int64_t count, std::string_view noun);

/// Columns that a UTF-8 text takes in a terminal, with one for every code point but combining ones.
std::size_t display_width(std::string_view text);

// A value with its uncertainty in digits that mean something. Rounding never makes an allowed gap larger or
// an uncertainty smaller.

/// Digits after the point with which an uncertainty (> 0) is told: two significant digits. At least 0.
int decimals_for(double uncertainty);

/// `value` cut to so many digits after the point, towards minus infinity; what is a decimal number already
/// stays. Never above `value` by more than round-off.
double rounded_down(double value, int decimals);
/// Likewise towards plus infinity.
double rounded_up(double value, int decimals);

/// As it is printed.
struct Measured {
  double value = 0;            ///< rounded down
  double minus = 0, plus = 0;  ///< rounded up
  int decimals = 0;
  double lower() const { return value - minus; }
  double upper() const { return value + plus; }
  /// "0.039 ± 0.010 cm", or "0.039 +0.010 −0.012 cm" where the two differ.
  std::string text(const std::string& unit) const;
};

/// A value that may be smaller by `minus` and larger by `plus` (both finite, >= 0, not both 0).
Measured measured(double value, double minus, double plus);

/// A critical gap between its bounds, all in cm. Nothing where one of them is not known.
std::optional<Measured> measured_gap(double value, double at_least, double at_most);

/// `value` rounded down with so many decimals, as text: what is allowed. Never "-0.0".
std::string allowed_text(double value, int decimals);
/// `value` rounded up to so many significant digits, as text: what is uncertain. 0 stays 0.
std::string uncertain_text(double value, int digits = 2);

using keys::always, keys::Audience, keys::Cell, keys::count, keys::for_people, keys::for_programs, keys::Form,
    keys::headed, keys::known, keys::named, keys::Notation, keys::of_part, keys::Quantities, keys::Quantity;
using keys::centimetre, keys::cubic_centimetre, keys::gram, keys::kelvin, keys::kelvin_per_centimetre,
    keys::kilojoule, keys::kilojoule_per_area, keys::megabyte, keys::megapascal, keys::micrometre,
    keys::millimetre, keys::millisecond, keys::per_second, keys::percent, keys::second;

/// What is said of the cells of a column: those of a table have its unit already.
using Column = keys::QuantityDescription;

struct Table {
  std::string title = {};
  std::vector<Column> columns = {};
  std::vector<std::vector<Cell>> rows = {};
  std::vector<std::string> notes = {};  ///< sentences under the table; in text and Markdown only
};

/// The columns that programs read, named by their keys; every row is whole.
Table for_programs(const Table& table);

/// A value in SI in the unit of a form, as if it had been written so: the only conversion there is.
double shown_value(double value_si, const Form& form);
/// A cell in SI in the unit of its column.
Cell shown_cell(Cell cell_si, const Column& column);
/// A value in SI as people read it within a sentence: "0.0381 cm".
std::string in_words(double value_si, const Form& form);
/// The same without the unit.
std::string digits_of(double value_si, const Form& form);

/// A row in the units of its quantities.
template <class Row>
std::vector<Cell> cells_of(const Quantities<Row>& quantities, const Row& row) {
  std::vector<Cell> cells;
  cells.reserve(quantities.size());
  for (const Quantity<Row>& each : quantities) cells.push_back(shown_cell(each.value(row), each));
  return cells;
}

/// A table with a column for every quantity.
template <class Row>
Table table_of(std::string title, const Quantities<Row>& quantities, const std::vector<Row>& rows,
               std::vector<std::string> notes = {}) {
  Table table{std::move(title), keys::described(quantities), {}, std::move(notes)};
  table.rows.reserve(rows.size());
  for (const Row& row : rows) table.rows.push_back(cells_of(quantities, row));
  return table;
}

/// Text in which nothing is markup to GitHub's Markdown.
std::string markdown_escaped(const std::string& text);

/// The keys of all columns, all different.
std::vector<std::string> keys_of(const Table& table);

/// For a terminal: title, header, rule, rows; numbers rounded as the columns say. Of a table that is wider
/// than so many columns (0: of any width) parts that fit stand below each other, the first column before
/// each.
std::string to_text(const Table& table, std::size_t width = 0);

/// GitHub's Markdown. Whatever would be markup in a cell is escaped.
std::string to_markdown(const Table& table);

/// RFC 4180: a header of keys, lines ending in CR LF, quotes where needed, numbers exact, NaN as "NaN",
/// nothing as "".
std::string to_csv(const Table& table);

/// The rows as objects by key; numbers exact, NaN and nothing as null.
nlohmann::ordered_json json_rows(const Table& table);

/// Adds the same rows, a line each, to a text that ends in an open array: a long table is never the
/// whole of it as objects in memory.
void append_json_rows(std::string& text, const Table& table);

/// One row as an object, for programs.
template <class Row, class Json = nlohmann::ordered_json>
Json json_of(const Quantities<Row>& quantities, const Row& row) {
  return json_rows(table_of({}, quantities, std::vector<Row>{row})).front();
}

}  // namespace launchsafe::report
