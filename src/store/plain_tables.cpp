#include "plain_tables.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace launchsafe::store {
namespace {

/// The type by which every value of a column can be declared.
std::string type_of_column(const PlainTable& table, std::size_t column) {
  bool any_text = false, any_number = false;
  for (const SqlRow& row : table.rows) {
    any_text = any_text || std::holds_alternative<std::string>(row[column]);
    any_number = any_number || std::holds_alternative<double>(row[column]);
  }
  if (any_text) return "ANY";
  return any_number ? "REAL" : "INTEGER";
}

}  // namespace

MaybeError write_table(Database& database, const PlainTable& table) {
  std::vector<std::string> declared;
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    declared.push_back(fmt::format("\"{}\" {}", table.columns[i], type_of_column(table, i)));
  if (MaybeError error =
          database.run(fmt::format("CREATE TABLE \"{}\" ({}) STRICT", table.name, fmt::join(declared, ", "))))
    return error;
  const std::vector<std::string> marks(table.columns.size(), "?");
  const std::string insert =
      fmt::format("INSERT INTO \"{}\" VALUES ({})", table.name, fmt::join(marks, ", "));
  for (const SqlRow& row : table.rows)
    if (MaybeError error = database.run(insert, row)) return error;
  return {};
}

MaybeError drop_plain_tables(Database& database) {
  const auto found = database.rows(
      "SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT GLOB 'stored_*' AND name NOT GLOB "
      "'sqlite_*'");
  if (!found) return found.error();
  for (const SqlRow& row : *found)
    if (MaybeError error = database.run(fmt::format("DROP TABLE \"{}\"", std::get<std::string>(row[0]))))
      return error;
  return {};
}

}  // namespace launchsafe::store
