// SQLite: values, statements, and tables whose columns are bound to the members of a struct, so that a new
// stored column is a member and a line.
#pragma once

#include "launchsafe/store/result.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <type_traits>
#include <unordered_map>

struct sqlite3;
struct sqlite3_stmt;

namespace launchsafe::store {

/// Nothing, a whole number, a number, or a text.
using SqlValue = std::variant<std::monostate, std::int64_t, double, std::string>;
using SqlRow = std::vector<SqlValue>;

/// A results file that is open. One thread at a time. Every error is a value: held (another process writes
/// it), conflict (it is no results file of this program and format), corrupt (it is damaged), write_failed
/// (the disk is full, for example), unreadable, failed.
class Database {
 public:
  /// Opens a file for this process alone, or makes it: the lock ends with the process, however that ends.
  /// Links are not followed. What is no results file is left as it is.
  static Result<Database> open(const std::filesystem::path& path);
  /// Why a file that is there may not be opened to write. Changes nothing.
  static MaybeError obstacle(const std::filesystem::path& path);
  /// An empty one in memory, whose messages name `path`.
  static Result<Database> in_memory(const std::filesystem::path& path);
  /// A copy of a file in memory as the last commit left it. The file is held for as long as copying takes and
  /// may be on a disk that cannot be written to.
  static Result<Database> copy_of(const std::filesystem::path& path);

  /// The rows that a statement gives, with `values` for its question marks. Statements are kept, so that a
  /// second call is quick.
  Result<std::vector<SqlRow>> rows(const std::string& statement, const SqlRow& values = {});
  /// The same for a statement that gives none.
  MaybeError run(const std::string& statement, const SqlRow& values = {});
  bool has_table(const std::string& name);

  /// Texts that repeat are stored once, in `stored_texts`; 0 stands for an empty one. The number follows from
  /// the text, so that it means the same in every file.
  Result<std::int64_t> number_of_text(const std::string& text);
  Result<std::string> text_of_number(std::int64_t number);

  /// Takes the rows of another file: the newer ones of `stored_runs`, of which a result beats an attempt
  /// without one, and what it has more in the other `stored_` tables.
  MaybeError take_rows_of(const std::filesystem::path& other);

  /// Whether changes since the last commit are pending.
  bool in_transaction() const;
  /// Takes them back.
  void roll_back();

 private:
  struct Close {
    void operator()(sqlite3* database) const;
  };
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  using Handle = std::unique_ptr<sqlite3, Close>;
  using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

  Database(std::filesystem::path path, Handle handle);
  static Result<Database> connect(const std::filesystem::path& path, int flags);
  MaybeError copy_into(const std::string& schema, const std::filesystem::path& source);
  MaybeError check_format();
  MaybeError lock_and_prepare();
  MaybeError make_tables();
  MaybeError check_pages(const std::string& schema);
  MaybeError take_attached_rows();
  Result<sqlite3_stmt*> prepared(const std::string& statement);
  Error error(int code) const;

  std::filesystem::path path_;
  Handle handle_;
  std::unordered_map<std::string, Statement> statements_;
  std::unordered_map<std::int64_t, std::string> texts_;
};

/// Name of the type of a column that holds such values.
template <class Value>
constexpr const char* sql_type() {
  if constexpr (std::is_same_v<Value, double>) return "REAL";
  if constexpr (std::is_same_v<Value, std::string>) return "TEXT";
  return "INTEGER";
}

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

/// False for what is no such value.
template <class Value>
bool from_sql(const SqlValue& stored, Value& value) {
  if constexpr (std::is_same_v<Value, double>) {
    const bool is_nothing = std::holds_alternative<std::monostate>(stored);
    if (!is_nothing && !std::holds_alternative<double>(stored)) return false;
    value = is_nothing ? std::numeric_limits<double>::quiet_NaN() : std::get<double>(stored);
  } else if constexpr (std::is_same_v<Value, std::string>) {
    if (!std::holds_alternative<std::string>(stored)) return false;
    value = std::get<std::string>(stored);
  } else {
    if (!std::holds_alternative<std::int64_t>(stored)) return false;
    value = static_cast<Value>(std::get<std::int64_t>(stored));
    return static_cast<std::int64_t>(value) == std::get<std::int64_t>(stored);
  }
  return true;
}

/// A column bound to a member of a row.
template <class Row>
struct SqlColumn {
  std::string name;  ///< with its unit: "gap_m"
  std::string type;
  std::function<SqlValue(const Row&)> get;
  std::function<bool(Row&, const SqlValue&)> set;  ///< false for what the member cannot be
  bool is_repeated = false;                        ///< a text, which is stored once for all rows
};

/// `member`: a pointer to it, or a function of a row, const or not, that returns a reference to it.
template <class Row, class Member>
SqlColumn<Row> sql_column(std::string name, Member member) {
  using Value = std::remove_cvref_t<std::invoke_result_t<Member, Row&>>;
  return {std::move(name), sql_type<Value>(),
          [member](const Row& row) { return to_sql(std::invoke(member, row)); },
          [member](Row& row, const SqlValue& stored) { return from_sql(stored, std::invoke(member, row)); }};
}

/// A column of texts that repeat.
template <class Row, class Member>
SqlColumn<Row> repeated_text(std::string name, Member member) {
  SqlColumn<Row> column = sql_column<Row>(std::move(name), member);
  column.type = "INTEGER";
  column.is_repeated = true;
  return column;
}

/// The column, whose values may be none below 0.
template <class Row>
SqlColumn<Row> not_negative(SqlColumn<Row> column) {
  column.set = [set = column.set](Row& row, const SqlValue& stored) {
    const double* number = std::get_if<double>(&stored);
    const std::int64_t* count = std::get_if<std::int64_t>(&stored);
    if ((number != nullptr && *number < 0.0) || (count != nullptr && *count < 0)) return false;
    return set(row, stored);
  };
  return column;
}

/// A value byte by byte, for a checksum.
void append_bytes(std::string& bytes, const SqlValue& value);

/// A table of such rows. CREATE TABLE, INSERT and SELECT follow from the columns.
template <class Row>
struct SqlTable {
  std::string name;
  std::vector<std::string>
      keys;                 ///< whole numbers before the row's own columns, such as of what it is a part
  std::string primary_key;  ///< names of columns
  std::vector<SqlColumn<Row>> columns;

  std::string create_statement() const {
    std::string text = fmt::format("CREATE TABLE IF NOT EXISTS {} (", name);
    for (const std::string& key : keys) text += key + " INTEGER NOT NULL, ";
    for (const SqlColumn<Row>& column : columns) text += fmt::format("{} {}, ", column.name, column.type);
    return text + fmt::format("PRIMARY KEY ({})) STRICT, WITHOUT ROWID", primary_key);
  }

  /// Puts a row in, in the place of one with the same primary key.
  MaybeError put(Database& database, const std::vector<std::int64_t>& key_values, const Row& row) const {
    SqlRow values(key_values.begin(), key_values.end());
    for (const SqlColumn<Row>& column : columns) {
      values.push_back(column.get(row));
      if (!column.is_repeated) continue;
      const auto number = database.number_of_text(std::get<std::string>(values.back()));
      if (!number) return number.error();
      values.back() = *number;
    }
    const std::vector<std::string> marks(values.size(), "?");
    return database.run(fmt::format("INSERT OR REPLACE INTO {} VALUES ({})", name, fmt::join(marks, ", ")),
                        values);
  }

  /// The rows with these values of the first keys, or of the first column, in the order of the primary key.
  /// Errors: corrupt also where a value is none of its member's.
  Result<std::vector<Row>> select(Database& database, const SqlRow& first_values) const {
    auto stored = database.rows(select_statement(first_values.size()), first_values);
    if (!stored) return stored.error();
    std::vector<Row> rows(stored->size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (MaybeError error = fill(database, rows[i], (*stored)[i])) return *error;
    return rows;
  }

  /// What a row says, for a checksum.
  void append_bytes_of(const Row& row, std::string& bytes) const {
    for (const SqlColumn<Row>& column : columns) append_bytes(bytes, column.get(row));
  }

 private:
  std::string select_statement(std::size_t given) const {
    std::vector<std::string> names, conditions;
    for (const SqlColumn<Row>& column : columns) names.push_back(column.name);
    for (std::size_t i = 0; i < given; ++i)
      conditions.push_back((i < keys.size() ? keys[i] : columns[i - keys.size()].name) + " = ?");
    return fmt::format("SELECT {} FROM {}{}{} ORDER BY {}", fmt::join(names, ", "), name,
                       given > 0 ? " WHERE " : "", fmt::join(conditions, " AND "), primary_key);
  }

  MaybeError fill(Database& database, Row& row, SqlRow& stored) const {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].is_repeated) {
        const std::int64_t* number = std::get_if<std::int64_t>(&stored[i]);
        auto text = database.text_of_number(number != nullptr ? *number : -1);
        if (!text) return text.error();
        stored[i] = std::move(*text);
      }
      if (!columns[i].set(row, stored[i]))
        return Error{Error::Kind::corrupt, fmt::format("a {} in {} cannot be", columns[i].name, name)};
    }
    return {};
  }
};

}  // namespace launchsafe::store
