#include "case_store_files.hpp"
#include "launchsafe/store/atomic_file.hpp"
#include "launchsafe/store/store_status.hpp"

#include <array>
#include <cerrno>

namespace launchsafe::store {
namespace {

using Clock = std::chrono::steady_clock;
constexpr auto batch_time = std::chrono::seconds(1);  ///< of changes that can be made again

constexpr std::array<std::pair<CaseState, const char*>, 4> states{{{CaseState::done, "done"},
                                                                   {CaseState::failed, "failed"},
                                                                   {CaseState::timed_out, "timed-out"},
                                                                   {CaseState::interrupted, "interrupted"}}};

SqlColumn<RunRecord> state_column() {
  return {"state", "TEXT NOT NULL", [](const RunRecord& record) { return SqlValue(to_string(record.state)); },
          [](RunRecord& record, const SqlValue& stored) {
            const auto found = std::ranges::find_if(
                states, [&](const auto& each) { return SqlValue(std::string(each.second)) == stored; });
            if (found != states.end()) record.state = found->first;
            return found != states.end();
          }};
}

}  // namespace

const SqlTable<RunRecord>& run_table() {
  static const SqlTable<RunRecord> table{
      "stored_runs",
      {},
      "hash",
      {sql_column<RunRecord>("hash", &RunRecord::hash), state_column(),
       sql_column<RunRecord>("label", &RunRecord::label), sql_column<RunRecord>("reason", &RunRecord::reason),
       sql_column<RunRecord>("model_version", &RunRecord::model_version),
       sql_column<RunRecord>("wall_time_s", &RunRecord::wall_time),
       sql_column<RunRecord>("processor_time_s", &RunRecord::processor_time),
       sql_column<RunRecord>("predicted_updates", &RunRecord::predicted_updates),
       sql_column<RunRecord>("time_limit_s", &RunRecord::time_limit),
       repeated_text<RunRecord>("host", &RunRecord::host),
       sql_column<RunRecord>("end_time", &RunRecord::end_time),
       sql_column<RunRecord>("file_bytes", &RunRecord::file_size),
       sql_column<RunRecord>("file_time_ns", &RunRecord::file_time)}};
  return table;
}

std::string to_string(CaseState state) {
  for (const auto& [each, word] : states)
    if (each == state) return word;
  return "unknown";
}

MaybeError CaseStore::take_over(const std::vector<std::filesystem::path>& others) {
  if (!database_.has_table(run_table().name)) {
    if (MaybeError error = database_.run(run_table().create_statement())) return error;
  }
  for (const std::filesystem::path& other : others)
    if (MaybeError error = database_.take_rows_of(other)) return told_who_writes(*error, other);
  return {};
}

void CaseStore::change(bool at_once, const std::function<MaybeError()>& make) {
  MaybeError failed;
  {
    const std::lock_guard lock(using_);
    if (!failure_) failed = make_change(at_once, make);
  }
  if (failed) fail(*failed);
}

void CaseStore::fail(const Error& error) {
  {
    const std::lock_guard lock(using_);
    if (failure_) return;
    failure_ = error;
    if (database_.in_transaction()) database_.roll_back();
  }
  if (options_.on_failure) options_.on_failure(error);
}

MaybeError CaseStore::make_change(bool at_once, const std::function<MaybeError()>& make) {
  if (!database_.in_transaction()) {
    if (MaybeError error = database_.run("BEGIN IMMEDIATE")) return error;
    batch_began_ = Clock::now();
  }
  if (!std::exchange(has_said_who_, true)) {
    if (MaybeError error = database_.run("INSERT INTO stored_events VALUES (?, ?, ?, 'began to write')",
                                         {utc_now(), host_, std::int64_t{::getpid()}}))
      return error;
  }
  if (MaybeError error = make()) return error;
  if (!at_once && Clock::now() - batch_began_ < batch_time) return {};
  return database_.run("COMMIT");
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
  if (is_pending) change(true, [] { return MaybeError(); });
  return failure();
}

std::optional<RunRecord> CaseStore::record_of(const std::string& hash) const {
  const std::lock_guard lock(using_);
  auto found = run_table().select(database_, {hash});
  if (!found || found->empty()) return std::nullopt;
  return std::move(found->front());
}

void CaseStore::put(const RunRecord& record) {
  change(true, [&] { return run_table().put(database_, {}, record); });
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
  const Result<CheckedFile> checked = read_checked(path, hash);
  if (!checked) {
    if (checked.error().kind == Error::Kind::corrupt) give_up(hash, checked.error());
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
    record.host = host_;
    record.end_time = utc_now();
  }
  record.model_version = checked->manifest.model_version;
  record.file_size = size_of(file);
  record.file_time = time_of(file);
  put(record);
  return true;
}

Error CaseStore::give_up(const std::string& hash, const Error& damage) {
  const std::lock_guard no_new_names(naming_);
  const Result<CheckedFile> again = read_checked(names_.case_file(hash), hash);
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

void CaseStore::keep(const Result<std::string>& bytes, RunRecord record) {
  const std::lock_guard one_at_a_time(naming_);
  if (failure()) return;
  if (!bytes) return fail(of_file(names_.case_file(record.hash), bytes.error()));
  if (const MaybeError error = write_file(record.hash, *bytes)) return fail(*error);
  struct stat file {};
  if (::stat(names_.case_file(record.hash).c_str(), &file) != 0)
    return fail(write_error(names_.case_file(record.hash), errno));
  record.file_size = size_of(file);
  record.file_time = time_of(file);
  put(record);
  const std::lock_guard lock(using_);
  damaged_.erase(record.hash);
}

MaybeError CaseStore::take_file(const std::filesystem::path& file, const std::string& hash) {
  const std::lock_guard one_at_a_time(naming_);
  if (::link(file.c_str(), names_.case_file(hash).c_str()) == 0)
    return sync_folder(names_.cases()) ? MaybeError() : write_error(names_.case_file(hash), errno);
  const Result<std::string> bytes = read_file(file);
  return bytes ? write_file(hash, *bytes) : bytes.error();
}

void CaseStore::fill_in(RunRecord& record) const {
  if (record.model_version == 0) record.model_version = options_.model_version;
  record.host = host_;
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
  const auto sums =
      database_.rows("SELECT count(*), coalesce(sum(file_bytes), 0) FROM stored_runs WHERE state = 'done'");
  if (sums) {
    members["runs_stored"] = std::get<std::int64_t>(sums->front()[0]);
    members["case_files_bytes"] = std::get<std::int64_t>(sums->front()[1]);
  }
  if (progress_) members.update(*progress_);
  // It helps people alone, so a failure to write it is none of the store.
  write_file_atomically(names_.status(), to_text(members), IfExists::replace);
}

void CaseStore::write_page(const std::string& page) {
  if (!obstacle_in_place(names_.page(), is_page))
    write_file_atomically(names_.page(), page, IfExists::replace);
}

}  // namespace launchsafe::store
