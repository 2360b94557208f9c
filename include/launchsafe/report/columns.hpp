// Columns and cells that the tables of all studies are made of.
#pragma once

#include "launchsafe/report/table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace launchsafe::report {

/// A number with so many digits after the point.
inline Column number_column(std::string name, std::string unit, int decimals, std::string key) {
  return {std::move(name), std::move(unit), Alignment::right, decimals, Notation::fixed, std::move(key)};
}

/// A number with so many significant digits.
inline Column significant_column(std::string name, std::string unit, int digits, std::string key) {
  return {std::move(name), std::move(unit), Alignment::right, digits, Notation::significant, std::move(key)};
}

/// A number as 1.2e-05.
inline Column scientific_column(std::string name, std::string unit, int decimals, std::string key) {
  return {std::move(name), std::move(unit), Alignment::right, decimals, Notation::scientific, std::move(key)};
}

/// A text under a key of its own.
inline Column named_text(std::string name, std::string key) {
  return {.name = std::move(name), .unit = {}, .alignment = Alignment::left, .key = std::move(key)};
}

/// A whole number.
inline Column count_column(std::string name, std::string key) {
  return {std::move(name), "", Alignment::right, 0, Notation::fixed, std::move(key)};
}

/// The same column in CSV and JSON alone.
inline Column for_programs(Column column) {
  column.audience = Audience::programs;
  return column;
}

/// The same column in text and Markdown alone.
inline Column for_people(Column column) {
  column.audience = Audience::people;
  return column;
}

/// Puts columns, or fields, behind others.
template <class Part>
void append(std::vector<Part>& parts, std::vector<std::type_identity_t<Part>> more) {
  for (Part& part : more) parts.push_back(std::move(part));
}

/// Nothing for a number that is not there; other than NaN in a result that should have one.
inline Cell optional_number(double value) { return std::isfinite(value) ? Cell(value) : Cell(); }

/// The same of the i-th number of a list, in units per SI unit; nothing beyond its end.
inline Cell number_at(const std::vector<double>& values, std::size_t i, double scale = 1.0) {
  return i < values.size() ? optional_number(scale * values[i]) : Cell();
}

/// What a row has in a column: tables say both at once.
struct Field {
  Field(Column shown, Cell value) : column(std::move(shown)), cell(std::move(value)) {}
  /// Nothing for a number that is not there.
  Field(Column shown, double value) : column(std::move(shown)), cell(optional_number(value)) {}

  Column column;
  Cell cell;
};

/// Adds a row. A field stands under the first column of its key that the row has not filled yet, which is
/// added where there is none.
inline void add_row(Table& table, std::vector<Field> fields) {
  std::vector<std::optional<Cell>> cells(table.columns.size());
  for (Field& field : fields) {
    std::size_t place = 0;
    while (place < cells.size() && (cells[place] || table.columns[place].key != field.column.key)) ++place;
    if (place == cells.size()) {
      table.columns.push_back(std::move(field.column));
      cells.emplace_back();
    }
    cells[place] = std::move(field.cell);
  }
  std::vector<Cell>& row = table.rows.emplace_back();
  for (std::optional<Cell>& cell : cells) row.push_back(cell ? std::move(*cell) : Cell());
}

}  // namespace launchsafe::report
