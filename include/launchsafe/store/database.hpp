// SQLite: values, statements, and tables whose rows are objects.
#pragma once

#include "launchsafe/math/numbers.hpp"
#include "launchsafe/store/file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <functional>
#include <memory>

struct sqlite3;

namespace launchsafe::store {

/// Nothing, a whole number, a number, or a text.
using SqlValue = std::variant<std::monostate, std::int64_t, double, std::string>;
using SqlRow = std::vector<SqlValue>;

/// A results file that is open. One thread at a time. Errors: conflict (it is no results file of this program
/// and format), corrupt (it is damaged), write_failed (the disk is full, for example), unreadable, failed.
class Database {
 public:
  /// Opens a results file, or with `writes` makes it where it is missing. A file of another kind is left as
  /// it is.
  Database(const std::filesystem::path& path, bool writes);

  /// The rows that a statement gives, with `values` for its question marks.
  std::vector<SqlRow> rows(const std::string& statement, const SqlRow& values = {});
  /// All changes that `make` makes, or none where it throws.
  void change(const std::function<void()>& make);

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  void check_format();
  Error error(int code) const;
  Error other_format() const;

  std::filesystem::path path_;
  std::unique_ptr<sqlite3, Close> handle_;
};

/// Not a number is nothing, and -0 is 0: SQLite knows neither.
template <class Value>
SqlValue to_sql(const Value& value) {
  if constexpr (std::is_same_v<Value, double>) {
    if (std::isnan(value)) return std::monostate();
    return value + 0.0;
  } else if constexpr (std::is_same_v<Value, std::string>) {
    return value;
  } else {
    return static_cast<std::int64_t>(value);
  }
}

/// The value of a column that was written with `to_sql`.
template <class Value>
void from_sql(const SqlValue& stored, Value& value) {
  if constexpr (std::is_same_v<Value, double>) {
    const double* number = std::get_if<double>(&stored);
    value = number != nullptr ? *number : math::not_a_number;
  } else if constexpr (std::is_same_v<Value, std::string>) {
    value = std::get<std::string>(stored);
  } else {
    value = static_cast<Value>(std::get<std::int64_t>(stored));
  }
}

/// A column of a table, and the member of its rows that it holds.
template <class Member>
struct SqlColumn {
  const char* name;
  Member member;
};
template <class Member>
SqlColumn(const char*, Member) -> SqlColumn<Member>;

/// Makes a table where it is missing. The first of its columns is the key.
template <class Columns>
void make_table(Database& database, const char* table, const Columns& columns) {
  const auto names = std::apply([](const auto&... each) { return std::vector{each.name...}; }, columns);
  database.rows(fmt::format("CREATE TABLE IF NOT EXISTS {} ({}, PRIMARY KEY ({})) WITHOUT ROWID", table,
                            fmt::join(names, ", "), names.front()));
}

/// Puts a row in the place of the one with its key.
template <class Row, class Columns>
void put(Database& database, const char* table, const Columns& columns, const Row& row) {
  const SqlRow values =
      std::apply([&](const auto&... each) { return SqlRow{to_sql(row.*each.member)...}; }, columns);
  database.rows(fmt::format("INSERT OR REPLACE INTO {} VALUES ({})", table,
                            fmt::join(std::vector<const char*>(values.size(), "?"), ", ")),
                values);
}

/// All rows, in the order of their keys; none where there is no such table.
template <class Row, class Columns>
std::vector<Row> all_rows(Database& database, const char* table, const Columns& columns) {
  std::vector<Row> found;
  if (database.rows("SELECT 1 FROM sqlite_schema WHERE name = ?", {std::string(table)}).empty()) return found;
  for (const SqlRow& values : database.rows(fmt::format("SELECT * FROM {} ORDER BY 1", table))) {
    std::size_t next = 0;
    Row& row = found.emplace_back();
    std::apply([&](const auto&... each) { (from_sql(values.at(next++), row.*each.member), ...); }, columns);
  }
  return found;
}

}  // namespace launchsafe::store
