#include "launchsafe/store/case_store.hpp"

#include "launchsafe/scene/toml_reader.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace launchsafe::store {

// --- tables ---

namespace {

constexpr std::array state_words{"done", "failed", "timed-out", "interrupted"};  // in the order of CaseState

constexpr const char* runs_table = "stored_runs";
constexpr std::tuple run_columns{SqlColumn{"hash", &RunRecord::hash},
                                 SqlColumn{"state", &RunRecord::state},
                                 SqlColumn{"label", &RunRecord::label},
                                 SqlColumn{"reason", &RunRecord::reason},
                                 SqlColumn{"model_version", &RunRecord::model_version},
                                 SqlColumn{"wall_time_s", &RunRecord::wall_time},
                                 SqlColumn{"processor_time_s", &RunRecord::processor_time},
                                 SqlColumn{"time_limit_s", &RunRecord::time_limit},
                                 SqlColumn{"program", &RunRecord::program},
                                 SqlColumn{"end_time", &RunRecord::end_time}};

constexpr const char* status_table = "stored_status";
constexpr std::tuple status_columns{SqlColumn{"shard", &StudyStatus::shard},
                                    SqlColumn{"command", &StudyStatus::command},
                                    SqlColumn{"time", &StudyStatus::time},
                                    SqlColumn{"cases", &StudyStatus::cases},
                                    SqlColumn{"cases_done", &StudyStatus::cases_done},
                                    SqlColumn{"cases_failed", &StudyStatus::cases_failed},
                                    SqlColumn{"time_left_s", &StudyStatus::time_left},
                                    SqlColumn{"exit_code", &StudyStatus::exit_code}};

}  // namespace

static SqlValue to_sql(CaseState state) { return state_words.at(static_cast<std::size_t>(state)); }

static void from_sql(const SqlValue& stored, CaseState& state) {
  const auto* found = std::ranges::find(state_words, std::get<std::string>(stored));
  if (found != state_words.end()) state = static_cast<CaseState>(found - state_words.begin());
}

namespace {

void write_table(Database& database, const PlainTable& table) {
  database.rows(fmt::format("CREATE TABLE \"{}\" (\"{}\")", table.name, fmt::join(table.columns, "\", \"")));
  const std::vector<const char*> marks(table.columns.size(), "?");
  for (const SqlRow& row : table.rows)
    database.rows(fmt::format("INSERT INTO \"{}\" VALUES ({})", table.name, fmt::join(marks, ", ")), row);
}

/// Drops all tables that are none of the store's own.
void drop_plain_tables(Database& database) {
  for (const SqlRow& row : database.rows("SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT "
                                         "GLOB 'stored_*' AND name NOT GLOB 'sqlite_*'"))
    database.rows(fmt::format("DROP TABLE \"{}\"", std::get<std::string>(row[0])));
}

std::vector<RunRecord> records_in(const std::filesystem::path& folder) {
  Database database(results_file(folder), false);
  return all_rows<RunRecord>(database, runs_table, run_columns);
}

/// What every case of this program has in common; what differs between equal runs is left out.
Manifest common_manifest() {
  Manifest manifest = make_manifest("");
  manifest.start_time.clear();
  return manifest;
}

// --- the lock ---

using File = std::shared_ptr<std::FILE>;

/// study.lock. It is locked by an open file rather than by a process, whose lock would go as soon as it
/// closed the file anywhere.
File lock_file(const std::filesystem::path& folder, const char* mode) {
  std::FILE* file = std::fopen((folder / "study.lock").c_str(), mode);
  return file == nullptr ? File() : File(file, std::fclose);
}

/// Whether `command` succeeds, with what it leaves in `bytes`.
bool control(const File& file, int command, flock& bytes) {
  bytes.l_type = F_WRLCK;
  bytes.l_whence = SEEK_SET;
  return file && ::fcntl(::fileno(file.get()), command, &bytes) == 0;
}

/// Held until the last owner of it goes, or the process ends.
File locked(const std::filesystem::path& folder) {
  File file = lock_file(folder, "a+e");
  flock bytes{};
  if (control(file, F_OFD_SETLK, bytes)) return file;
  if (errno != EAGAIN && errno != EACCES) throw write_error(folder / "study.lock", errno);
  throw Error{Error::Kind::conflict, fmt::format("{} is in use by another process", folder.string())};
}

bool is_locked(const std::filesystem::path& folder) {
  flock bytes{};
  return control(lock_file(folder, "re"), F_OFD_GETLK, bytes) && bytes.l_type != F_UNLCK;
}

}  // namespace

std::filesystem::path results_file(const std::filesystem::path& folder) { return folder / "study.db"; }

std::optional<StudyStatus> status_in(const std::filesystem::path& folder) {
  std::error_code none;  // a name that is no file's
  if (!std::filesystem::exists(results_file(folder), none)) return std::nullopt;
  const bool alive = is_locked(folder);  // before the file is read: a writer that ends in between has ended
  Database database(results_file(folder), false);
  const auto rows = all_rows<StudyStatus>(database, status_table, status_columns);
  if (rows.empty()) return std::nullopt;
  StudyStatus status = rows.front();
  status.alive = alive;
  return status;
}

// --- the store ---

CaseIdentity::CaseIdentity(std::string determining_input)
    : input(std::move(determining_input)), hash(sha256(input).substr(0, 32)) {}

CaseStore::CaseStore(std::filesystem::path folder, std::function<void(const Error&)> on_failure)
    : folder_(std::move(folder)), on_failure_(std::move(on_failure)), manifest_(common_manifest()) {}

std::filesystem::path CaseStore::case_file(const std::string& hash) const {
  return folder_ / "cases" / (hash + ".h5");
}

std::unique_ptr<CaseStore> CaseStore::open(const std::filesystem::path& folder,
                                           std::function<void(const Error&)> on_failure) {
  std::error_code status;
  std::filesystem::create_directories(folder / "cases", status);
  if (status) throw write_error(folder / "cases", status.value());
  std::unique_ptr<CaseStore> store(new CaseStore(folder, std::move(on_failure)));
  store->lock_ = locked(folder);
  Database& database = store->database_.emplace(results_file(folder), true);
  make_table(database, runs_table, run_columns);
  make_table(database, status_table, status_columns);
  for (RunRecord& each : all_rows<RunRecord>(database, runs_table, run_columns))
    store->records_[each.hash] = std::move(each);
  remove_leftovers(folder / "cases");
  return store;
}

std::unique_ptr<CaseStore> CaseStore::open_to_read(const std::filesystem::path& folder) {
  std::unique_ptr<CaseStore> store(new CaseStore(folder, {}));
  for (RunRecord& each : records_in(folder)) store->records_[each.hash] = std::move(each);
  return store;
}

void CaseStore::change(const std::function<void()>& make) try {
  const std::lock_guard lock(using_);
  if (!failure_) database_->change(make);
} catch (const Error& error) {
  fail(error);
}

void CaseStore::fail(const Error& error) {
  {
    const std::lock_guard lock(using_);
    if (failure_) return;
    failure_ = error;
  }
  if (on_failure_) on_failure_(error);
}

std::optional<Error> CaseStore::flush() const {
  const std::lock_guard lock(using_);
  return failure_;
}

std::vector<std::string> CaseStore::remarks() const {
  const std::lock_guard lock(using_);
  return remarks_;
}

std::optional<RunRecord> CaseStore::record_of(const std::string& hash) const {
  const std::lock_guard lock(using_);
  const auto found = records_.find(hash);
  return found == records_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<RunRecord> CaseStore::records() const {
  const std::lock_guard lock(using_);
  std::vector<RunRecord> all;
  for (const auto& [hash, record] : records_) all.push_back(record);
  return all;
}

bool CaseStore::holds(const std::string& hash) const {
  std::error_code failed;
  return std::filesystem::exists(case_file(hash), failed);
}

std::optional<run::CaseResult> CaseStore::load(const std::string& hash) try {
  StoredCase stored = read_case_file(case_file(hash));
  const std::optional<RunRecord> record = record_of(hash);
  if (record && record->state == CaseState::done) {
    stored.result.mechanics.wall_time = record->wall_time;
    stored.result.mechanics.processor_time = record->processor_time;
  }
  return std::move(stored.result);
} catch (const Error& error) {
  if (error.kind == Error::Kind::corrupt) {
    const std::lock_guard lock(using_);
    std::error_code failed;
    std::filesystem::rename(case_file(hash), case_file(hash).string() + ".damaged", failed);
    remarks_.push_back(error.message + "; it does not count, and is computed again");
  }
  return std::nullopt;
}

void CaseStore::save(const CaseIdentity& identity, run::CaseResult result, RunRecord record) {
  if (flush()) return;
  record.hash = identity.hash;
  record.state = CaseState::done;
  StoredCase stored{manifest_, std::move(result)};
  stored.manifest.input_text = identity.input;
  stored.manifest.input_sha256 = sha256(identity.input);
  stored.result.mechanics.wall_time = stored.result.mechanics.processor_time = 0;
  const std::filesystem::path path = case_file(record.hash);
  try {
    write_file_atomically(path, case_bytes(stored), IfExists::replace);
  } catch (const Error& error) {
    return fail({error.kind, fmt::format("{}: {}", path.string(), error.message)});
  }
  note(std::move(record));
}

void CaseStore::note(RunRecord record) {
  record.program = program_of(manifest_);
  record.end_time = utc_now();
  change([&] {
    put(*database_, runs_table, run_columns, record);
    records_[record.hash] = record;
  });
}

void CaseStore::replace_tables(const std::vector<PlainTable>& tables) {
  change([&] {
    drop_plain_tables(*database_);
    for (const PlainTable& table : tables) write_table(*database_, table);
  });
}

void CaseStore::tell_status(StudyStatus status, bool at_once) {
  const auto now = std::chrono::steady_clock::now();
  status.time = utc_now();
  change([&] {
    if (!at_once && now - status_written_ < std::chrono::seconds(1)) return;
    status_written_ = now;
    database_->rows(fmt::format("DELETE FROM {}", status_table));
    put(*database_, status_table, status_columns, status);
  });
}

std::size_t CaseStore::import_from(const std::filesystem::path& other) {
  std::size_t imported = 0;
  std::error_code status;
  if (std::filesystem::equivalent(other, folder_, status)) return imported;
  if (!std::filesystem::exists(results_file(other), status))
    throw Error{Error::Kind::missing, fmt::format("{} holds no results of a study", other.string())};
  for (const std::string& name : scene::list_folder(other / "cases")) {
    const std::filesystem::path theirs = other / "cases" / name, ours = case_file(theirs.stem());
    if (theirs.extension() != ".h5" || std::filesystem::exists(ours, status)) continue;
    if (::link(theirs.c_str(), ours.c_str()) != 0)
      write_file_atomically(ours, read_file(theirs), IfExists::replace);
    ++imported;
  }
  const auto worth = [](const RunRecord& each) {
    return std::tuple(each.state == CaseState::done, each.end_time);
  };
  const std::vector<RunRecord> records = records_in(other);
  change([&] {
    for (const RunRecord& each : records) {
      const auto [found, is_new] = records_.try_emplace(each.hash, each);
      if (!is_new && worth(each) <= worth(found->second)) continue;
      found->second = each;
      put(*database_, runs_table, run_columns, each);
    }
  });
  return imported;
}

}  // namespace launchsafe::store
