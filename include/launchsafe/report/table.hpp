// Tables as values, made of typed rows and a list of quantities, and as text for people and for programs.
#pragma once

#include "launchsafe/keys/quantity.hpp"

#include <nlohmann/json_fwd.hpp>

namespace launchsafe::report {

using keys::always, keys::Audience, keys::Cell, keys::count, keys::for_people, keys::for_programs, keys::Form,
    keys::headed, keys::known, keys::named, keys::Notation, keys::of_part, keys::Quantities, keys::Quantity;
using keys::centimetre, keys::cubic_centimetre, keys::gram, keys::joule, keys::kelvin,
    keys::kelvin_per_centimetre, keys::kilojoule, keys::kilojoule_per_area, keys::megabyte, keys::megapascal,
    keys::metre_per_second, keys::micrometre, keys::millimetre, keys::millisecond, keys::per_second,
    keys::percent, keys::second;

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
