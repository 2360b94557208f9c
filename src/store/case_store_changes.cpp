#include "case_store_files.hpp"

#include <cerrno>

namespace launchsafe::store {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto status_pause = std::chrono::seconds(1);  ///< between two texts of status.json

constexpr std::array states{"done", "failed", "timed-out", "interrupted"};  // in the order of CaseState

}  // namespace

static SqlValue to_sql(CaseState state) { return to_string(state); }

static void from_sql(const SqlValue& stored, CaseState& state) {
  const auto* found = std::ranges::find(states, stored, [](const char* word) { return SqlValue(word); });
  if (found != states.end()) state = static_cast<CaseState>(found - states.begin());
}

namespace {

constexpr const char* make_table =
    "CREATE TABLE IF NOT EXISTS stored_runs (hash TEXT, state TEXT NOT NULL, label TEXT, reason TEXT, "
    "model_version INTEGER, wall_time_s REAL, processor_time_s REAL, time_limit_s REAL, "
    "program TEXT, end_time TEXT, PRIMARY KEY (hash)) STRICT, WITHOUT ROWID";
/// The members of a record in the order of its columns.
constexpr std::tuple record_members{
    &RunRecord::hash,          &RunRecord::state,     &RunRecord::label,          &RunRecord::reason,
    &RunRecord::model_version, &RunRecord::wall_time, &RunRecord::processor_time, &RunRecord::time_limit,
    &RunRecord::program,       &RunRecord::end_time};

void put_record(Database& database, const RunRecord& record) {
  SqlRow row;
  std::apply([&](auto... member) { (row.push_back(to_sql(record.*member)), ...); }, record_members);
  const std::vector<std::string> marks(row.size(), "?");
  database.run(fmt::format("INSERT OR REPLACE INTO stored_runs VALUES ({})", fmt::join(marks, ", ")), row);
}

RunRecord record_from(const SqlRow& row) {
  RunRecord record;
  std::size_t next = 0;
  std::apply([&](auto... member) { (from_sql(row[next++], record.*member), ...); }, record_members);
  return record;
}

}  // namespace

std::vector<RunRecord> records_in(Database& database, const std::string& which, const SqlRow& values) try {
  std::vector<RunRecord> records;
  for (const SqlRow& row : database.rows("SELECT * FROM stored_runs " + which + " ORDER BY hash", values))
    records.push_back(record_from(row));
  return records;
} catch (const Error&) {
  return {};
}

std::string to_string(CaseState state) { return states.at(static_cast<std::size_t>(state)); }

void CaseStore::take_over(const std::vector<std::filesystem::path>& others) {
  database_.run(make_table);
  for (const std::filesystem::path& other : others) of_results(other, [&] { database_.take_rows_of(other); });
}

void CaseStore::change(const std::function<void()>& make) try {
  const std::lock_guard lock(using_);
  if (failure_) return;
  database_.run("BEGIN IMMEDIATE");
  make();
  database_.run("COMMIT");
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

MaybeError CaseStore::flush() const {
  const std::lock_guard lock(using_);
  return failure_;
}

std::optional<RunRecord> CaseStore::record_of(const std::string& hash) const {
  const std::lock_guard lock(using_);
  const std::vector<RunRecord> found = records_in(database_, "WHERE hash = ?", {hash});
  return found.empty() ? std::nullopt : std::optional(found.front());
}

void CaseStore::put(const RunRecord& record) {
  change([&] { put_record(database_, record); });
}

MaybeError CaseStore::take_file(const std::filesystem::path& file, const std::string& hash) {
  if (::link(file.c_str(), names_.case_file(hash).c_str()) == 0)
    return sync_folder(names_.cases()) ? MaybeError() : write_error(names_.case_file(hash), errno);
  const Result<std::string> bytes = read_file(file);
  if (!bytes) return bytes.error();
  return write_file_atomically(names_.case_file(hash), *bytes, IfExists::replace);
}

void CaseStore::fill_in(RunRecord& record) const {
  if (record.model_version == 0) record.model_version = run::model_version;
  record.program = program_of(manifest_);
  record.end_time = utc_now();
}

void CaseStore::tell_progress(nlohmann::ordered_json progress, bool at_once) {
  const std::lock_guard lock(using_);
  progress_ = std::make_shared<const nlohmann::ordered_json>(std::move(progress));
  if (!at_once && Clock::now() - status_written_ < status_pause) return;
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
