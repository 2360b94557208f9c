// Tables as values, and as text for people and for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace launchsafe::report {

enum class Alignment { left, right };
enum class Notation { fixed, scientific, significant };
/// Who a column is for: people read text and Markdown, programs read CSV and JSON.
enum class Audience { everyone, people, programs };

struct Column {
  std::string name;  ///< as people read it: "T max"
  std::string unit;  ///< "K"; empty for text and pure numbers
  Alignment alignment = Alignment::right;
  int decimals = 1;  ///< of numbers; for Notation::significant the significant digits
  Notation notation = Notation::fixed;
  std::string key = {};  ///< for CSV and JSON; empty: made of name and unit, such as "peak_time_ms"
  Audience audience = Audience::everyone;
};

/// Letters, digits and single underscores: "J/(kg K)" becomes "J_per_kg_K", "%" "percent".
std::string key_text(const std::string& text);

/// A column of text, left-aligned.
Column text_column(std::string name);

/// Nothing, a text, a number, or a count.
using Cell = std::variant<std::monostate, std::string, double, std::int64_t>;

struct Table {
  std::string title = {};
  std::vector<Column> columns = {};
  std::vector<std::vector<Cell>> rows = {};  ///< a row may be short: the rest is empty
  std::vector<std::string> notes = {};       ///< sentences under the table; in text and Markdown only
};

/// The columns that programs read, named by their keys; every row is whole.
Table for_programs(const Table& table);

/// A cell as people read it.
std::string cell_text(const Cell& cell, const Column& column);
/// "T max [K]".
std::string heading_of(const Column& column);
/// Text in which nothing is markup to GitHub's Markdown.
std::string markdown_escaped(const std::string& text);

/// The keys of all columns, all different.
std::vector<std::string> keys_of(const Table& table);

/// For a terminal: title, header, rule, rows; numbers rounded as the columns say.
std::string to_text(const Table& table);

/// GitHub's Markdown. Whatever would be markup in a cell is escaped.
std::string to_markdown(const Table& table);

/// RFC 4180: a header of keys, lines ending in CR LF, quotes where needed, numbers exact, NaN as "NaN",
/// nothing as "".
std::string to_csv(const Table& table);

/// {"title", "columns": [{"key", "name", "unit"}], "rows": [{key: value}]}; numbers exact, NaN and nothing as
/// null.
nlohmann::ordered_json to_json(const Table& table);

/// Adds the rows of `to_json`, a line each, to a text that ends in an open array: a long table is never the
/// whole of it as objects in memory.
void append_json_rows(std::string& text, const Table& table);

}  // namespace launchsafe::report
