// SQLite: values and statements.
#pragma once

#include "launchsafe/math/numbers.hpp"
#include "launchsafe/store/file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <unordered_map>

struct sqlite3;
struct sqlite3_stmt;

namespace launchsafe::store {

/// Nothing, a whole number, a number, or a text.
using SqlValue = std::variant<std::monostate, std::int64_t, double, std::string>;
using SqlRow = std::vector<SqlValue>;

/// A results file that is open. One thread at a time. Every Error is thrown: held (another process writes
/// it), conflict (it is no results file of this program and format), corrupt (it is damaged), write_failed
/// (the disk is full, for example), unreadable, failed.
class Database {
 public:
  /// Opens a file for this process alone, or makes it: the lock ends with the process, however that ends.
  /// What is no results file is left as it is.
  static Database open(const std::filesystem::path& path);
  /// Whether a living process has the file open to write. Throws nothing.
  static bool is_held(const std::filesystem::path& path);
  /// An empty one in memory, whose messages name `path`.
  static Database in_memory(const std::filesystem::path& path);
  /// A copy of a file in memory as the last commit left it. The file is held for as long as copying takes and
  /// may be on a disk that cannot be written to.
  static Database copy_of(const std::filesystem::path& path);

  /// The rows that a statement gives, with `values` for its question marks. Statements are kept, so that a
  /// second call is quick.
  std::vector<SqlRow> rows(const std::string& statement, const SqlRow& values = {});
  /// The same for a statement that gives none.
  void run(const std::string& statement, const SqlRow& values = {}) { rows(statement, values); }

  /// Takes the newer rows of `stored_runs` of another file, of which a result beats an attempt without one.
  void take_rows_of(const std::filesystem::path& other);

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
  static Database connect(const std::filesystem::path& path, int flags);
  void copy_into(const std::string& schema, const std::filesystem::path& source);
  void check_format();
  void lock_and_prepare();
  sqlite3_stmt* prepared(const std::string& statement);
  /// Runs a statement whose failure is of no consequence.
  void try_to_run(const char* statement);
  Error error(int code) const;

  std::filesystem::path path_;
  Handle handle_;
  std::unordered_map<std::string, Statement> statements_;
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

}  // namespace launchsafe::store
