#include "launchsafe/store/database.hpp"

#include "posix_file.hpp"

#include <sqlite3.h>

#include <cerrno>

namespace launchsafe::store {
namespace {

constexpr int application_id = 0x4c534146;  // "LSAF", by which a results file of ours is known
constexpr int schema_version = 5;
constexpr int patience = 500;  // ms, for a reader that is about to be done

Error::Kind kind_of(int code) {
  switch (code & 0xff) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return Error::Kind::held;
    case SQLITE_CORRUPT:
      return Error::Kind::corrupt;
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
    case SQLITE_AUTH:
      return Error::Kind::unreadable;
    case SQLITE_FULL:
    case SQLITE_IOERR:
    case SQLITE_READONLY:
      return Error::Kind::write_failed;
    default:
      return Error::Kind::failed;
  }
}

void bind(sqlite3_stmt* statement, int place, const SqlValue& value) {
  if (const auto* count = std::get_if<std::int64_t>(&value)) {
    sqlite3_bind_int64(statement, place, *count);
  } else if (const auto* number = std::get_if<double>(&value)) {
    sqlite3_bind_double(statement, place, *number);
  } else if (const auto* text = std::get_if<std::string>(&value)) {
    sqlite3_bind_text64(statement, place, text->data(), text->size(), SQLITE_STATIC, SQLITE_UTF8);
  } else {
    sqlite3_bind_null(statement, place);
  }
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
      const auto bytes = static_cast<std::size_t>(sqlite3_column_bytes(statement, place));
      return text == nullptr ? std::string() : std::string(text, bytes);
    }
  }
}

}  // namespace

void Database::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }
void Database::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Database::Database(std::filesystem::path path, Handle handle)
    : path_(std::move(path)), handle_(std::move(handle)) {}

Error Database::error(int code) const {
  // Without the lock daemon of NFS, for example. SQLite calls that a file which another process holds.
  const bool has_no_locks = kind_of(code) == Error::Kind::held && errno == ENOLCK;
  const Error::Kind kind = has_no_locks ? Error::Kind::write_failed : kind_of(code);
  const bool is_told = sqlite3_errcode(handle_.get()) != SQLITE_OK;
  std::string text =
      fmt::format("{}: {}", path_.string(), is_told ? sqlite3_errmsg(handle_.get()) : sqlite3_errstr(code));
  if ((code & 0xff) == SQLITE_NOTADB)
    return refusal(path_, "is no results file of launchsafe, or its beginning is damaged");
  if (kind == Error::Kind::corrupt)
    text += "; it is damaged: move it away, and the study goes on with the case files beside it";
  return {kind, std::move(text)};
}

// --- opening ---

Database Database::connect(const std::filesystem::path& path, int flags) {
  sqlite3* opened = nullptr;
  const int code = sqlite3_open_v2(path.c_str(), &opened, flags, nullptr);
  Database database(path, Handle(opened));
  if (code != SQLITE_OK) throw database.error(code);
  sqlite3_extended_result_codes(opened, 1);
  sqlite3_busy_timeout(opened, patience);
  return database;
}

Database Database::open(const std::filesystem::path& path) {
  Database database = connect(path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE);
  database.check_format();
  database.lock_and_prepare();
  return database;
}

Database Database::in_memory(const std::filesystem::path& path) {
  Database database = connect(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_MEMORY);
  database.path_ = path;
  return database;
}

bool Database::is_held(const std::filesystem::path& path) try {
  Database database = connect(path, SQLITE_OPEN_READWRITE);
  database.run("PRAGMA busy_timeout = 0");
  database.check_format();
  return false;
} catch (const Error& error) {
  return error.kind == Error::Kind::held;
}

/// Reads only. A file without anything in it is one to be.
void Database::check_format() {
  const SqlRow found = rows(
                           "SELECT application_id, (SELECT count(*) FROM sqlite_schema), user_version FROM "
                           "pragma_application_id, pragma_user_version")
                           .front();
  const auto number = [&](std::size_t column) { return std::get<std::int64_t>(found[column]); };
  if (number(0) == 0 && number(1) == 0) return;
  if (number(0) != application_id) throw refusal(path_, "was not written by launchsafe");
  if (number(2) != schema_version)
    throw Error{Error::Kind::conflict,
                fmt::format("{} is a results file of format {}, and this program's is {}; run the study anew "
                            "into another folder",
                            path_.string(), number(2), schema_version)};
}

/// Takes the lock, which no commit gives back, and marks a new file as ours.
void Database::lock_and_prepare() {
  // A log beside the file (WAL) does not work on shared disks.
  for (const char* statement :
       {"PRAGMA locking_mode = EXCLUSIVE", "PRAGMA synchronous = FULL", "BEGIN EXCLUSIVE"})
    run(statement);
  if (rows("PRAGMA application_id").front() == SqlRow{std::int64_t{0}}) {
    run(fmt::format("PRAGMA application_id = {}", application_id));
    run(fmt::format("PRAGMA user_version = {}", schema_version));
  }
  run("COMMIT");
  run("PRAGMA journal_mode = DELETE");
}

Database Database::copy_of(const std::filesystem::path& path) {
  Database database = in_memory(path);
  database.copy_into("main", path);
  return database;
}

void Database::copy_into(const std::string& schema, const std::filesystem::path& source) {
  // What a killed writer left is rolled back, for which the file is written to; where it cannot be, it opens
  // to be read.
  Database file = connect(source, SQLITE_OPEN_READWRITE);
  file.check_format();
  sqlite3_backup* backup = sqlite3_backup_init(handle_.get(), schema.c_str(), file.handle_.get(), "main");
  if (backup == nullptr) throw error(sqlite3_errcode(handle_.get()));
  const int code = sqlite3_backup_step(backup, -1);
  sqlite3_backup_finish(backup);
  if (code != SQLITE_DONE) throw file.error(code);
}

// --- statements ---

sqlite3_stmt* Database::prepared(const std::string& statement) {
  Statement& known = statements_[statement];
  if (known) return known.get();
  sqlite3_stmt* made = nullptr;
  const int code =
      sqlite3_prepare_v3(handle_.get(), statement.c_str(), -1, SQLITE_PREPARE_PERSISTENT, &made, nullptr);
  if (code != SQLITE_OK) throw error(code);
  known.reset(made);
  return made;
}

std::vector<SqlRow> Database::rows(const std::string& statement, const SqlRow& values) {
  sqlite3_stmt* const found = prepared(statement);
  for (std::size_t i = 0; i < values.size(); ++i) bind(found, static_cast<int>(i) + 1, values[i]);
  std::vector<SqlRow> rows;
  int code = SQLITE_ROW;
  while ((code = sqlite3_step(found)) == SQLITE_ROW) {
    SqlRow& row = rows.emplace_back(static_cast<std::size_t>(sqlite3_column_count(found)));
    for (std::size_t i = 0; i < row.size(); ++i) row[i] = column_of(found, static_cast<int>(i));
  }
  MaybeError failure;
  if (code != SQLITE_DONE) failure = error(code);
  sqlite3_reset(found);
  if (failure) throw *failure;
  return rows;
}

void Database::try_to_run(const char* statement) {
  sqlite3_exec(handle_.get(), statement, nullptr, nullptr, nullptr);
}

bool Database::in_transaction() const { return sqlite3_get_autocommit(handle_.get()) == 0; }

void Database::roll_back() { try_to_run("ROLLBACK"); }

void Database::take_rows_of(const std::filesystem::path& other) {
  run("ATTACH ':memory:' AS other");
  try {
    copy_into("other", other);
    // A writer that was killed at its beginning has left no table.
    if (!rows("SELECT 1 FROM other.sqlite_schema WHERE name = 'stored_runs'").empty())
      run("INSERT OR REPLACE INTO main.stored_runs SELECT theirs.* FROM other.stored_runs AS theirs "
          "LEFT JOIN main.stored_runs AS ours USING (hash) WHERE ours.hash IS NULL OR "
          "(theirs.state = 'done') > (ours.state = 'done') OR ((theirs.state = 'done') = "
          "(ours.state = 'done') AND theirs.end_time > ours.end_time)");
  } catch (const Error&) {
    try_to_run("DETACH other");
    throw;
  }
  run("DETACH other");
}

}  // namespace launchsafe::store
