#include "case_store_files.hpp"

#include <cerrno>

namespace launchsafe::store {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto batch_time = std::chrono::seconds(1);  ///< of changes that can be made again

constexpr std::array states{"done", "failed", "timed-out", "interrupted"};  // in the order of CaseState

}  // namespace

static SqlValue to_sql(CaseState state) { return to_string(state); }

static bool from_sql(const SqlValue& stored, CaseState& state) {
  const auto* found = std::ranges::find(states, stored, [](const char* word) { return SqlValue(word); });
  if (found != states.end()) state = static_cast<CaseState>(found - states.begin());
  return found != states.end();
}

namespace {

constexpr const char* make_table =
    "CREATE TABLE IF NOT EXISTS stored_runs (hash TEXT, state TEXT NOT NULL, label TEXT, reason TEXT, "
    "model_version INTEGER, wall_time_s REAL, processor_time_s REAL, predicted_updates REAL, time_limit_s "
    "REAL, program INTEGER, end_time TEXT, file_bytes INTEGER, file_time_ns INTEGER, PRIMARY KEY (hash)) "
    "STRICT, "
    "WITHOUT ROWID";
/// The members of a record in the order of its columns.
constexpr std::tuple record_members{&RunRecord::hash,           &RunRecord::state,
                                    &RunRecord::label,          &RunRecord::reason,
                                    &RunRecord::model_version,  &RunRecord::wall_time,
                                    &RunRecord::processor_time, &RunRecord::predicted_updates,
                                    &RunRecord::time_limit,     &RunRecord::program,
                                    &RunRecord::end_time,       &RunRecord::file_size,
                                    &RunRecord::file_time};
constexpr std::size_t columns = std::tuple_size_v<decltype(record_members)>;
constexpr std::size_t program_column = 9;  ///< of texts that repeat

void put_record(Database& database, const RunRecord& record) {
  SqlRow row;
  std::apply([&](auto... member) { (row.push_back(to_sql(record.*member)), ...); }, record_members);
  row[program_column] = database.number_of_text(record.program);
  const std::vector<std::string> marks(columns, "?");
  database.run(fmt::format("INSERT OR REPLACE INTO stored_runs VALUES ({})", fmt::join(marks, ", ")), row);
}

/// From the columns and, behind them, the name of the program. Throws where a value is none of its member's.
RunRecord record_from(SqlRow row) {
  if (row.size() != columns + 1) throw Error{Error::Kind::corrupt, "stored_runs has other columns"};
  row[program_column] = std::move(row.back());
  RunRecord record;
  std::size_t next = 0;
  const auto read = [&](auto... member) { return (from_sql(row[next++], record.*member) && ...); };
  if (!std::apply(read, record_members))
    throw Error{Error::Kind::corrupt, "a value in stored_runs cannot be"};
  return record;
}

}  // namespace

std::vector<RunRecord> records_in(Database& database, const std::string& which, const SqlRow& values) try {
  const std::string with_programs =
      "SELECT stored_runs.*, iif(program, text, '') FROM stored_runs LEFT JOIN stored_texts ON number = "
      "program ";
  std::vector<RunRecord> records;
  for (SqlRow& row : database.rows(with_programs + which + " ORDER BY hash", values))
    records.push_back(record_from(std::move(row)));
  return records;
} catch (const Error&) {
  return {};
}

std::string to_string(CaseState state) { return states.at(static_cast<std::size_t>(state)); }

void CaseStore::take_over(const std::vector<std::filesystem::path>& others) {
  database_.run(make_table);
  for (const std::filesystem::path& other : others) of_results(other, [&] { database_.take_rows_of(other); });
}

void CaseStore::change(bool at_once, const std::function<void()>& make) try {
  const std::lock_guard lock(using_);
  if (failure_) return;
  if (!database_.in_transaction()) {
    database_.run("BEGIN IMMEDIATE");
    batch_began_ = Clock::now();
  }
  if (!std::exchange(has_said_who_, true))
    database_.run("INSERT INTO stored_events VALUES (?, ?, ?, 'began to write')",
                  {utc_now(), host_, std::int64_t{::getpid()}});
  make();
  if (at_once || Clock::now() - batch_began_ >= batch_time) database_.run("COMMIT");
} catch (const Error& error) {
  fail(error);
}

void CaseStore::fail(const Error& error) {
  {
    const std::lock_guard lock(using_);
    if (failure_) return;
    failure_ = error;
    if (database_.in_transaction()) database_.roll_back();
  }
  if (on_failure_) on_failure_(error);
}

MaybeError CaseStore::failure() const {
  const std::lock_guard lock(using_);
  return failure_;
}

MaybeError CaseStore::flush() {
  bool is_pending = false;
  {
    const std::lock_guard lock(using_);
    is_pending = database_.in_transaction();
  }
  if (is_pending) change(true, [] {});
  return failure();
}

std::optional<RunRecord> CaseStore::record_of(const std::string& hash) const {
  const std::lock_guard lock(using_);
  const std::vector<RunRecord> found = records_in(database_, "WHERE hash = ?", {hash});
  return found.empty() ? std::nullopt : std::optional(found.front());
}

void CaseStore::put(const RunRecord& record) {
  change(true, [&] { put_record(database_, record); });
}

bool CaseStore::is_given_up(const std::string& hash) const {
  const std::lock_guard lock(using_);
  return damaged_.contains(hash);
}

bool CaseStore::knows(const std::string& hash, const struct stat& file) const {
  const std::optional<RunRecord> record = record_of(hash);
  return record && record->state == CaseState::done && record->file_size == size_of(file) &&
         record->file_time == time_of(file);
}

bool CaseStore::adopt(const std::string& hash) {
  const std::filesystem::path path = names_.case_file(hash);
  struct stat file {};
  if (::stat(path.c_str(), &file) != 0) return false;
  const Result<Manifest> checked = read_checked(path, hash);
  if (!checked) {
    give_up(hash, checked.error());
    if (checked.error().kind == Error::Kind::unreadable) remark(checked.error().message);
    return false;
  }
  if (knows(hash, file)) return true;  // by now: another thread has just stored it
  RunRecord record = record_of(hash).value_or(RunRecord{});
  if (record.state != CaseState::done || record.hash.empty()) {
    record.hash = hash;
    record.state = CaseState::done;
    record.reason.clear();
    record.wall_time = record.processor_time = 0;  // whatever took them was another attempt
    record.end_time = utc_now();
  }
  record.program = program_of(*checked);
  record.model_version = checked->model_version;
  record.file_size = size_of(file);
  record.file_time = time_of(file);
  put(record);
  return true;
}

Error CaseStore::give_up(const std::string& hash, const Error& damage) {
  if (damage.kind != Error::Kind::corrupt) return damage;
  const std::lock_guard no_new_names(naming_);
  const Result<Manifest> again = read_checked(names_.case_file(hash), hash);
  if (again || again.error().kind != Error::Kind::corrupt) return damage;
  {
    const std::lock_guard lock(using_);
    damaged_.insert(hash);
  }
  remark(damage.message + (writes_ ? "; it does not count, and a new result takes its place"
                                   : "; it would be computed again"));
  return damage;
}

MaybeError CaseStore::write_file(const std::string& hash, std::string_view bytes) {
  const std::filesystem::path path = names_.case_file(hash);
  const std::string name = hash + "." + names_.mark();
  MaybeError error = write_file_atomically(path, bytes, IfExists::refuse, name);
  if (!error || error->kind != Error::Kind::conflict) return error;
  // Another thread may have stored the same result meanwhile; a damaged one has done its time.
  if (read_checked(path, hash)) return {};
  if (began_as_case(path)) return write_file_atomically(path, bytes, IfExists::replace, name);
  const std::optional<RunRecord> record = record_of(hash);
  if (!record || record->state != CaseState::done) return Error{Error::Kind::write_failed, error->message};
  // Somebody put something else in the place of ours, which is kept.
  if (const auto kept = move_to_numbered_name(path, path.string() + ".edited"); !kept) return kept.error();
  return write_file_atomically(path, bytes, IfExists::refuse, name);
}

MaybeError CaseStore::take_file(const std::filesystem::path& file, const std::string& hash) {
  const std::lock_guard one_at_a_time(naming_);
  if (::link(file.c_str(), names_.case_file(hash).c_str()) == 0)
    return sync_folder(names_.cases()) ? MaybeError() : write_error(names_.case_file(hash), errno);
  const Result<std::string> bytes = read_file(file);
  return bytes ? write_file(hash, *bytes) : bytes.error();
}

void CaseStore::fill_in(RunRecord& record) const {
  if (record.model_version == 0) record.model_version = run::model_version;
  record.program = program_of(manifest_);
  record.end_time = utc_now();
}

void CaseStore::remark(const std::string& text) {
  const std::lock_guard lock(using_);
  if (std::ranges::find(remarks_, text) != remarks_.end()) return;
  remarks_.push_back(text);
}

void CaseStore::tell_progress(nlohmann::ordered_json progress, bool at_once) {
  const std::lock_guard lock(using_);
  progress_ = std::make_shared<const nlohmann::ordered_json>(std::move(progress));
  if (!at_once && Clock::now() - status_written_ < batch_time) return;
  status_written_ = Clock::now();
  write_status();
}

void CaseStore::write_status(bool ended) {
  nlohmann::ordered_json members{{"host", host_},     {"process", ::getpid()}, {"since", since_},
                                 {"time", utc_now()}, {"ended", ended},        {"runs_done", 0},
                                 {"runs_running", 0}, {"runs_total", 0}};
  try {
    const auto count = database_.rows("SELECT count(*) FROM stored_runs WHERE state = 'done'");
    members["runs_stored"] = std::get<std::int64_t>(count.front()[0]);
  } catch (const Error&) {  // the status lacks it
  }
  if (progress_) members.update(*progress_);
  // It helps people alone, so a failure to write it is none of the store.
  write_file_atomically(names_.status(), to_text(members), IfExists::replace);
}

}  // namespace launchsafe::store
