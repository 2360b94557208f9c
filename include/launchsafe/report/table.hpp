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

/// "1 case", "3 cases".
std::string counted(std::int64_t count, std::string_view noun);

/// Columns that a UTF-8 text takes in a terminal, with one for every code point but combining ones.
std::size_t display_width(std::string_view text);

/// `value` with so many digits after the point (of tens, hundreds, ... where negative) towards one side. A
/// decimal number of that many digits stays itself.
double rounded(double value, int decimals, keys::Rounding side);

/// "0.039 ± 0.010 cm", or "0.039 +0.010 −0.012 cm" where the two differ: a value between its bounds with two
/// digits of the larger uncertainty. The value is rounded down and the uncertainty up, so that neither bound
/// comes nearer. Empty where a bound is not known, or where both are the value.
std::string between_bounds(double value, double at_least, double at_most, const std::string& unit);

using keys::always, keys::Audience, keys::Cell, keys::count, keys::down, keys::for_people, keys::for_programs,
    keys::Form, keys::headed, keys::known, keys::named, keys::Notation, keys::of_part, keys::Quantities,
    keys::Quantity, keys::Rounding, keys::up;
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
/// A value in the unit of a form as people read it, rounded as the form says.
std::string shown_digits(double value, const Form& form);
/// A value in SI as people read it within a sentence: "0.0381 cm".
std::string in_words(double value_si, const Form& form);
/// The same without the unit.
std::string digits_of(double value_si, const Form& form);

/// A table with a column for every quantity.
template <class Row>
Table table_of(std::string title, const Quantities<Row>& quantities, const std::vector<Row>& rows,
               std::vector<std::string> notes = {}) {
  Table table{std::move(title), keys::described(quantities), {}, std::move(notes)};
  table.rows.reserve(rows.size());
  for (const Row& row : rows) {
    auto& cells = table.rows.emplace_back();
    for (const Quantity<Row>& each : quantities) cells.push_back(shown_cell(each.value(row), each));
  }
  return table;
}

/// Text in which nothing is markup to GitHub's Markdown.
std::string markdown_escaped(const std::string& text);

/// The keys of all columns.
std::vector<std::string> keys_of(const Table& table);

/// For a terminal: title, header, rule, rows; numbers rounded as the columns say. Of a table that is wider
/// than so many columns (0: of any width) parts that fit stand below each other, the first column before
/// each.
std::string to_text(const Table& table, std::size_t width = 0);

/// GitHub's Markdown. Whatever would be markup in a cell is escaped.
std::string to_markdown(const Table& table);

/// An HTML table of the id "ID-table", without its notes. A verdict is the class of its cell too.
std::string to_html(const Table& table, const std::string& id);

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
