#include "launchsafe/store/database.hpp"

#include <sqlite3.h>

namespace launchsafe::store {
namespace {

constexpr std::int64_t application_id = 0x4c534146;  // "LSAF", by which a results file of ours is known
constexpr std::int64_t schema_version = 6;
constexpr int patience = 10'000;  // ms, for others that read or write for a moment

int bind(sqlite3_stmt* statement, int place, const SqlValue& value) {
  if (const auto* count = std::get_if<std::int64_t>(&value))
    return sqlite3_bind_int64(statement, place, *count);
  if (const auto* number = std::get_if<double>(&value)) return sqlite3_bind_double(statement, place, *number);
  if (const auto* text = std::get_if<std::string>(&value))
    return sqlite3_bind_text64(statement, place, text->data(), text->size(), SQLITE_STATIC, SQLITE_UTF8);
  return sqlite3_bind_null(statement, place);
}

SqlValue column_of(sqlite3_stmt* statement, int place) {
  switch (sqlite3_column_type(statement, place)) {
    case SQLITE_INTEGER:
      return std::int64_t{sqlite3_column_int64(statement, place)};
    case SQLITE_FLOAT:
      return sqlite3_column_double(statement, place);
    case SQLITE_NULL:
      return std::monostate();
    default: {
      const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(statement, place));
      return std::string(text, static_cast<std::size_t>(sqlite3_column_bytes(statement, place)));
    }
  }
}

}  // namespace

void Database::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

Database::Database(const std::filesystem::path& path, bool writes) : path_(path) {
  sqlite3* opened = nullptr;
  // A reader, too, rolls back what a killed writer left; where it may not write, the file opens to be read.
  const int flags = SQLITE_OPEN_READWRITE | (writes ? SQLITE_OPEN_CREATE : 0);
  const int code = sqlite3_open_v2(path.c_str(), &opened, flags, nullptr);
  handle_.reset(opened);
  if (code != SQLITE_OK) throw error(code);
  sqlite3_busy_timeout(opened, patience);
  check_format();
  if (!writes) return;
  // A log beside the file (WAL) does not work on shared disks.
  rows("PRAGMA journal_mode = DELETE");
  rows("PRAGMA synchronous = FULL");
  if (rows("PRAGMA user_version").front() == SqlRow{schema_version}) return;
  change([&] {
    rows(fmt::format("PRAGMA application_id = {}", application_id));
    rows(fmt::format("PRAGMA user_version = {}", schema_version));
  });
}

Error Database::error(int code) const {
  const std::string text = fmt::format("{}: {}", path_.string(), sqlite3_errmsg(handle_.get()));
  if (code == SQLITE_NOTADB) return other_format();
  if (code == SQLITE_CANTOPEN || code == SQLITE_PERM) return {Error::Kind::unreadable, text};
  if (code != SQLITE_CORRUPT) return {Error::Kind::write_failed, text};
  return {Error::Kind::corrupt, text + "; move it away, and the study goes on with the case files beside it"};
}

Error Database::other_format() const {
  return {Error::Kind::conflict,
          fmt::format("{} is no results file of this version of launchsafe; run the study anew into another "
                      "folder: launchsafe study STUDY.toml -o DIR",
                      path_.string())};
}

/// Reads only. A file without anything in it is one to be.
void Database::check_format() {
  const SqlRow found = rows(
                           "SELECT application_id, user_version, (SELECT count(*) FROM sqlite_schema) FROM "
                           "pragma_application_id, pragma_user_version")
                           .front();
  const SqlRow empty{std::int64_t{0}, std::int64_t{0}, std::int64_t{0}};
  if (found != empty && (found[0] != SqlValue(application_id) || found[1] != SqlValue(schema_version)))
    throw other_format();
}

std::vector<SqlRow> Database::rows(const std::string& statement, const SqlRow& values) {
  sqlite3_stmt* prepared = nullptr;
  int code = sqlite3_prepare_v2(handle_.get(), statement.c_str(), -1, &prepared, nullptr);
  const std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)> owned(prepared, sqlite3_finalize);
  for (int i = 0; code == SQLITE_OK && i < static_cast<int>(values.size()); ++i)
    code = bind(prepared, i + 1, values[static_cast<std::size_t>(i)]);
  std::vector<SqlRow> rows;
  while (code == SQLITE_OK || code == SQLITE_ROW) {
    code = sqlite3_step(prepared);
    if (code != SQLITE_ROW) break;
    SqlRow& row = rows.emplace_back();
    for (int i = 0; i < sqlite3_column_count(prepared); ++i) row.push_back(column_of(prepared, i));
  }
  if (code != SQLITE_DONE) throw error(code);
  return rows;
}

void Database::change(const std::function<void()>& make) {
  rows("BEGIN IMMEDIATE");
  try {
    make();
    rows("COMMIT");
  } catch (...) {
    sqlite3_exec(handle_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
    throw;
  }
}

}  // namespace launchsafe::store
