// Columns and cells that the tables of all studies are made of.
#pragma once

#include "launchsafe/report/table.hpp"

#include <cmath>
#include <string>
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
  Column column = text_column(std::move(name));
  column.key = std::move(key);
  return column;
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

/// Puts columns behind others.
inline void append(std::vector<Column>& columns, std::vector<Column> more) {
  for (Column& column : more) columns.push_back(std::move(column));
}

/// Nothing for a number that is not there; other than NaN in a result that should have one.
inline Cell optional_number(double value) { return std::isfinite(value) ? Cell(value) : Cell(); }

}  // namespace launchsafe::report
