#include "launchsafe/store/case_store.hpp"

#include "case_store_files.hpp"
#include "launchsafe/store/atomic_file.hpp"
#include "launchsafe/store/case_file.hpp"
#include "launchsafe/store/sha256.hpp"
#include "store_status.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <mutex>
#include <set>

namespace launchsafe::store {
namespace {

constexpr std::size_t hash_digits = 32;
using Clock = std::chrono::steady_clock;
constexpr auto batch_time = std::chrono::seconds(1);  ///< of changes that can be made again

constexpr std::array<std::pair<CaseState, const char*>, 4> states{{{CaseState::done, "done"},
                                                                   {CaseState::failed, "failed"},
                                                                   {CaseState::timed_out, "timed-out"},
                                                                   {CaseState::interrupted, "interrupted"}}};

SqlColumn<RunRecord> state_column() {
  return {"state", "TEXT NOT NULL", [](const RunRecord& record) { return SqlValue(to_string(record.state)); },
          [](RunRecord& record, const SqlValue& stored) {
            const auto found = std::find_if(states.begin(), states.end(), [&](const auto& each) {
              return SqlValue(std::string(each.second)) == stored;
            });
            if (found != states.end()) record.state = found->first;
            return found != states.end();
          }};
}

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

/// What every case of this program has in common; what differs between equal runs is left out.
Manifest common_manifest() {
  Manifest manifest = make_manifest("", 1);
  manifest.host.clear();
  manifest.start_time.clear();
  return manifest;
}

MaybeError make_folder(const std::filesystem::path& folder) {
  std::error_code status;
  const bool is_new = std::filesystem::create_directories(folder, status);
  if (is_new) sync_folder((folder / "..").lexically_normal());
  if (!status) return {};
  return Error{Error::Kind::write_failed,
               fmt::format("cannot make the folder {}: {}", folder.string(), status.message())};
}

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

}  // namespace

bool is_case_hash(std::string_view text) {
  return text.size() == hash_digits && text.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

CaseIdentity::CaseIdentity(std::string input)
    : input_(std::move(input)), hash_(sha256(input_).substr(0, hash_digits)) {}

std::string to_string(CaseState state) {
  for (const auto& [each, word] : states)
    if (each == state) return word;
  return "unknown";
}

// --- the content ---

struct CaseStore::Content {
  Content(StoreNames all_names, StoreOptions chosen, Database opened, bool may_write)
      : names(std::move(all_names)),
        options(std::move(chosen)),
        manifest(common_manifest()),
        host(host_name()),
        writes(may_write),
        database(std::move(opened)) {}

  /// Makes the table of runs where it is missing, and takes the rows of these files.
  MaybeError take_over(const std::vector<std::filesystem::path>& others);

  /// Makes a change, alone among the threads, unless something failed before; the first failure is kept and
  /// told. `at_once`: it is on disk before this returns.
  void change(bool at_once, const std::function<MaybeError()>& make);
  void fail(const Error& error);
  MaybeError failure() const;
  MaybeError flush();

  std::optional<RunRecord> record_of(const std::string& hash) const;
  void put(const RunRecord& record) {
    change(true, [&] { return run_table().put(database, {}, record); });
  }
  /// Whether the record states a file of this size and time.
  bool knows(const std::string& hash, const struct stat& status) const;
  /// Reads and checks a file of another size or time than its record states; records it if it is whole.
  bool adopt(const std::string& hash);
  /// A file that is damaged, unless another thread has replaced it, counts no more. Returns its error.
  Error give_up(const std::string& hash, const Error& damage);
  MaybeError write_file(const std::string& hash, std::string_view bytes);
  void keep(const Result<std::string>& bytes, RunRecord record);
  /// Where and when an attempt ended, and of which model it was.
  void fill_in(RunRecord& record) const;

  bool is_given_up(const std::string& hash) const {
    const std::lock_guard lock(using_);
    return damaged_.contains(hash);
  }
  /// Takes over the whole result of another folder: a second name of its file where the file system can.
  MaybeError take_file(const std::filesystem::path& file, const std::string& hash);

  void remark(const std::string& text);
  void tell_progress(std::size_t done, std::size_t running, std::size_t total);
  void write_status();

  const StoreNames names;
  const StoreOptions options;
  const Manifest manifest;  ///< of every case, without its input
  const std::string host;
  const bool writes;
  mutable std::mutex naming;  ///< held while files get their names; locked before `using_`
  mutable std::mutex using_;  ///< of all below
  mutable Database database;
  StoreStatus status;
  std::vector<std::string> remarks;

 private:
  MaybeError make_change(bool at_once, const std::function<MaybeError()>& make);

  MaybeError failure_;
  std::set<std::string> damaged_;  ///< hashes
  Clock::time_point batch_began_, status_written_;
  bool has_said_who_ = false;
};

MaybeError CaseStore::Content::take_over(const std::vector<std::filesystem::path>& others) {
  if (!database.has_table(run_table().name)) {
    if (MaybeError error = database.run(run_table().create_statement())) return error;
  }
  for (const std::filesystem::path& other : others)
    if (MaybeError error = database.take_rows_of(other)) return told_who_writes(*error, other);
  return {};
}

void CaseStore::Content::change(bool at_once, const std::function<MaybeError()>& make) {
  MaybeError failed;
  {
    const std::lock_guard lock(using_);
    if (!failure_) failed = make_change(at_once, make);
  }
  if (failed) fail(*failed);
}

void CaseStore::Content::fail(const Error& error) {
  {
    const std::lock_guard lock(using_);
    if (failure_) return;
    failure_ = error;
    if (database.in_transaction()) database.roll_back();
  }
  if (options.on_failure) options.on_failure(error);
}

MaybeError CaseStore::Content::make_change(bool at_once, const std::function<MaybeError()>& make) {
  if (!database.in_transaction()) {
    if (MaybeError error = database.run("BEGIN IMMEDIATE")) return error;
    batch_began_ = Clock::now();
  }
  if (!std::exchange(has_said_who_, true)) {
    if (MaybeError error = database.run("INSERT INTO stored_events VALUES (?, ?, ?, 'began to write')",
                                        {utc_now(), host, std::int64_t{::getpid()}}))
      return error;
  }
  if (MaybeError error = make()) return error;
  if (!at_once && Clock::now() - batch_began_ < batch_time) return {};
  return database.run("COMMIT");
}

MaybeError CaseStore::Content::failure() const {
  const std::lock_guard lock(using_);
  return failure_;
}

MaybeError CaseStore::Content::flush() {
  bool is_pending = false;
  {
    const std::lock_guard lock(using_);
    is_pending = database.in_transaction();
  }
  if (is_pending) change(true, [] { return MaybeError(); });
  return failure();
}

std::optional<RunRecord> CaseStore::Content::record_of(const std::string& hash) const {
  const std::lock_guard lock(using_);
  auto found = run_table().select(database, {hash});
  if (!found || found->empty()) return std::nullopt;
  return std::move(found->front());
}

bool CaseStore::Content::knows(const std::string& hash, const struct stat& file) const {
  const std::optional<RunRecord> record = record_of(hash);
  return record && record->state == CaseState::done && record->file_size == size_of(file) &&
         record->file_time == time_of(file);
}

bool CaseStore::Content::adopt(const std::string& hash) {
  const std::filesystem::path path = names.case_file(hash);
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
    record.host = host;
    record.end_time = utc_now();
  }
  record.model_version = checked->manifest.model_version;
  record.file_size = size_of(file);
  record.file_time = time_of(file);
  put(record);
  return true;
}

Error CaseStore::Content::give_up(const std::string& hash, const Error& damage) {
  const std::lock_guard no_new_names(naming);
  const Result<CheckedFile> again = read_checked(names.case_file(hash), hash);
  if (again || again.error().kind != Error::Kind::corrupt) return damage;
  {
    const std::lock_guard lock(using_);
    damaged_.insert(hash);
  }
  remark(damage.message +
         (writes ? "; it does not count, and a new result takes its place" : "; it would be computed again"));
  return damage;
}

MaybeError CaseStore::Content::write_file(const std::string& hash, std::string_view bytes) {
  const std::filesystem::path path = names.case_file(hash);
  const std::string name = hash + "." + names.mark();
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

void CaseStore::Content::keep(const Result<std::string>& bytes, RunRecord record) {
  const std::lock_guard one_at_a_time(naming);
  if (failure()) return;
  if (!bytes) return fail(of_file(names.case_file(record.hash), bytes.error()));
  if (const MaybeError error = write_file(record.hash, *bytes)) return fail(*error);
  struct stat file {};
  if (::stat(names.case_file(record.hash).c_str(), &file) != 0)
    return fail(write_error(names.case_file(record.hash), errno));
  record.file_size = size_of(file);
  record.file_time = time_of(file);
  put(record);
  const std::lock_guard lock(using_);
  damaged_.erase(record.hash);
}

MaybeError CaseStore::Content::take_file(const std::filesystem::path& file, const std::string& hash) {
  const std::lock_guard one_at_a_time(naming);
  if (::link(file.c_str(), names.case_file(hash).c_str()) == 0)
    return sync_folder(names.cases()) ? MaybeError() : write_error(names.case_file(hash), errno);
  const Result<std::string> bytes = read_file(file);
  return bytes ? write_file(hash, *bytes) : bytes.error();
}

void CaseStore::Content::fill_in(RunRecord& record) const {
  if (record.model_version == 0) record.model_version = options.model_version;
  record.host = host;
  record.end_time = utc_now();
}

void CaseStore::Content::remark(const std::string& text) {
  const std::lock_guard lock(using_);
  if (std::find(remarks.begin(), remarks.end(), text) != remarks.end()) return;
  remarks.push_back(text);
}

void CaseStore::Content::tell_progress(std::size_t done, std::size_t running, std::size_t total) {
  const std::lock_guard lock(using_);
  status.done = done;
  status.running = running;
  status.total = total;
  if (Clock::now() - status_written_ < batch_time) return;
  status_written_ = Clock::now();
  write_status();
}

void CaseStore::Content::write_status() {
  const std::string done = "SELECT count(*) FROM stored_runs WHERE state = 'done'";
  if (const auto count = database.rows(done))
    status.stored = static_cast<std::size_t>(std::get<std::int64_t>(count->front().front()));
  status.time = utc_now();
  // It helps people alone, so a failure to write it is none of the store.
  write_file_atomically(names.status(), to_text(status), IfExists::replace);
}

// --- the store ---

Result<std::unique_ptr<CaseStore>> CaseStore::open(const std::filesystem::path& folder,
                                                   const StoreOptions& options) {
  StoreNames names{folder, options.part};
  if (const MaybeError error = obstacle_in(names)) return *error;
  for (const std::filesystem::path& each : {folder, names.cases()}) {
    if (const MaybeError error = make_folder(each)) return *error;
  }
  Result<Database> database = Database::open(names.results());
  if (!database) return told_who_writes(database.error(), names.results());
  std::vector<std::filesystem::path> others = results_files_in(folder);
  std::erase_if(others, [&](const std::filesystem::path& each) {
    return each == names.results() || (!options.part.empty() && each != StoreNames{folder, {}}.results());
  });
  auto content = std::make_unique<Content>(std::move(names), options, std::move(*database), true);
  if (const MaybeError error = content->take_over(others)) return *error;
  remove_leftovers_of(content->names);
  content->status.host = content->host;
  content->status.process = ::getpid();
  content->status.since = utc_now();
  content->write_status();
  return std::unique_ptr<CaseStore>(new CaseStore(std::move(content)));
}

Result<std::unique_ptr<CaseStore>> CaseStore::open_to_read(const std::filesystem::path& folder,
                                                           int model_version) {
  if (const MaybeError error = obstacle_of_older(folder)) return *error;
  std::error_code status;
  list_folder(folder, status);
  if (status)
    return Error{Error::Kind::unreadable,
                 fmt::format("cannot read {}: {}", folder.string(), status.message())};
  std::vector<std::filesystem::path> files = results_files_in(folder);
  Result<Database> database = files.empty() ? Database::in_memory(StoreNames{folder, {}}.results())
                                            : Database::copy_of(files.front());
  if (!database) return told_who_writes(database.error(), files.empty() ? folder : files.front());
  if (!files.empty()) files.erase(files.begin());
  auto content = std::make_unique<Content>(StoreNames{folder, {}}, StoreOptions{{}, model_version, {}},
                                           std::move(*database), false);
  if (const MaybeError error = content->take_over(files)) return *error;
  return std::unique_ptr<CaseStore>(new CaseStore(std::move(content)));
}

CaseStore::CaseStore(std::unique_ptr<Content> content) : content_(std::move(content)) {}

CaseStore::~CaseStore() {
  content_->flush();
  if (!content_->writes) return;
  content_->status.ended = true;
  content_->write_status();
}

std::optional<RunRecord> CaseStore::record_of(const std::string& hash) const {
  return content_->record_of(hash);
}

std::vector<RunRecord> CaseStore::records() const {
  const std::lock_guard lock(content_->using_);
  auto found = run_table().select(content_->database, {});
  return found ? std::move(*found) : std::vector<RunRecord>{};
}

bool CaseStore::holds(const std::string& hash) {
  struct stat file {};
  if (::stat(content_->names.case_file(hash).c_str(), &file) != 0 || content_->is_given_up(hash))
    return false;
  return content_->knows(hash, file) || content_->adopt(hash);
}

Result<run::CaseResult> CaseStore::load(const std::string& hash) {
  const std::filesystem::path path = content_->names.case_file(hash);
  Result<StoredCase> stored = read_case_file(path);
  if (stored && !belongs_to(stored->manifest, hash)) stored = of_another_case(path);
  if (!stored && stored.error().kind == Error::Kind::corrupt) return content_->give_up(hash, stored.error());
  if (!stored) return stored.error();
  const std::optional<RunRecord> record = content_->record_of(hash);
  if (record && record->state == CaseState::done) {
    stored->result.mechanics.wall_time = record->wall_time;
    stored->result.mechanics.processor_time = record->processor_time;
  }
  return std::move(stored->result);
}

Result<std::string> CaseStore::input_of(const std::string& hash) {
  Result<CheckedFile> file = read_checked(content_->names.case_file(hash), hash);
  if (file) return std::move(file->manifest.input_text);
  if (file.error().kind != Error::Kind::corrupt) return file.error();
  return content_->give_up(hash, file.error());
}

void CaseStore::save(const CaseIdentity& identity, const scene::Scene& scene, run::CaseResult result,
                     RunRecord record) {
  assert(content_->writes);
  record.hash = identity.hash();
  record.state = CaseState::done;
  content_->fill_in(record);
  Manifest manifest = content_->manifest;
  manifest.input_text = identity.input();
  manifest.input_sha256 = sha256(identity.input());
  manifest.model_version = record.model_version;
  if (record.wall_time == 0) {
    record.wall_time = result.mechanics.wall_time;
    record.processor_time = result.mechanics.processor_time;
  }
  result.mechanics.wall_time = 0;
  content_->keep(case_bytes(scene, result, manifest), std::move(record));
}

void CaseStore::note(RunRecord record) {
  assert(content_->writes);
  content_->fill_in(record);
  content_->put(record);
}

void CaseStore::write(const std::function<MaybeError(Database&)>& change) {
  content_->change(false, [&] { return change(content_->database); });
}

void CaseStore::read(const std::function<void(Database&)>& look) const {
  const std::lock_guard lock(content_->using_);
  look(content_->database);
}

void CaseStore::replace_tables(const std::vector<PlainTable>& tables) {
  content_->change(true, [&] {
    MaybeError error = drop_plain_tables(content_->database);
    for (const PlainTable& table : tables)
      if (!error) error = write_table(content_->database, table);
    return error;
  });
}

MaybeError CaseStore::flush() { return content_->flush(); }

void CaseStore::tell_progress(std::size_t done, std::size_t running, std::size_t total) {
  content_->tell_progress(done, running, total);
}

std::vector<std::string> CaseStore::remarks() const {
  const std::lock_guard lock(content_->using_);
  return content_->remarks;
}

const std::filesystem::path& CaseStore::folder() const { return content_->names.folder; }

Result<CaseStore::Imported> CaseStore::import_from(const std::filesystem::path& other) {
  Imported imported;
  std::error_code status;
  if (std::filesystem::equivalent(other, folder(), status)) return imported;
  if (const MaybeError error = obstacle_of_older(other)) return *error;
  const std::vector<std::filesystem::path> files = results_files_in(other);
  if (files.empty())
    return Error{Error::Kind::missing, fmt::format("{} holds no results of a study", other.string())};
  for (const std::filesystem::path& file : files)
    if (const MaybeError error = Database::obstacle(file)) return told_who_writes(*error, file);
  const StoreNames theirs{other, {}};
  std::vector<std::string> absent;
  for (const std::string& hash : stored_hashes(theirs, status)) {
    if (holds(hash))
      ++imported.already_there;
    else
      absent.push_back(hash);
  }
  std::vector<std::string> remarks;
  const auto whole = whole_ones(theirs, absent, content_->options.model_version, remarks);
  if (!whole) return whole.error();
  for (const std::string& remark : remarks) content_->remark(remark);
  for (const std::string& hash : *whole)
    if (const MaybeError error = content_->take_file(theirs.case_file(hash), hash)) return *error;
  imported.cases = whole->size();
  if (const MaybeError error = flush()) return *error;
  const std::lock_guard lock(content_->using_);
  if (const MaybeError error = content_->take_over(files)) return *error;
  return imported;
}

}  // namespace launchsafe::store
