// The folder of a study: one results file, and one file a case beside it. Killing the process at any instant
// loses at most what was in flight.
//
//   DIR/study[.PART].db     SQLite: runs, and the tables of the report
//   DIR/cases/HASH.h5       the result of one case, named by what determines it, whole or not there
//   DIR/status[.PART].json  who writes and how far it is; for whoever watches
//
// PART is "1-of-4" for a shard and absent for a whole study, which takes over what the parts stored. A result
// is on disk under its name before its row is committed. A results file is held by the process that writes
// it.
#pragma once

#include "launchsafe/store/case_file.hpp"
#include "launchsafe/store/database.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <mutex>
#include <set>

namespace launchsafe::store {

/// All that determines a result, as canonical text, and the name that follows from it.
class CaseIdentity {
 public:
  explicit CaseIdentity(std::string input);
  const std::string& input() const { return input_; }
  /// The first 32 hexadecimal digits of the SHA-256 of the input.
  const std::string& hash() const { return hash_; }

 private:
  std::string input_, hash_;
};

/// What became of an attempt. A run that ended by itself is done, also when its energy drifted away: computed
/// again it would do the same. Failed: it threw (memory, for example), and may succeed another time.
enum class CaseState { done, failed, timed_out, interrupted };
std::string to_string(CaseState state);

/// The newest attempt on a case.
struct RunRecord {
  std::string hash;
  CaseState state = CaseState::done;
  std::string label;   ///< of the case, for people
  std::string reason;  ///< why it is not done
  int model_version = 0;
  double wall_time = 0;       ///< s, of the run
  double processor_time = 0;  ///< s, of the run
  double time_limit = 0;      ///< s, of a case that was timed out
  /// Program that made the attempt, see `program_of`.
  std::string program;
  std::string end_time;  ///< ISO 8601, UTC
};

/// The names of a store's files.
struct StoreNames {
  std::filesystem::path folder;
  std::string part;

  std::filesystem::path cases() const { return folder / "cases"; }
  std::filesystem::path case_file(const std::string& hash) const { return cases() / (hash + ".h5"); }
  std::filesystem::path results() const { return folder / ("study" + suffix() + ".db"); }
  std::filesystem::path status() const { return folder / ("status" + suffix() + ".json"); }

 private:
  std::string suffix() const { return part.empty() ? "" : "." + part; }
};

/// A table for other programs: every row has a value for every column, perhaps nothing.
struct PlainTable {
  std::string name;
  std::vector<std::string> columns;
  std::vector<SqlRow> rows;
};

/// Any thread may call any member. What was saved or noted is seen at once by whoever asks. Nothing is taken
/// any more once something could not be written.
class CaseStore {
 public:
  /// Makes the folder and its results file, or goes on with it, and takes it for this process alone. A whole
  /// study takes over what parts stored in the folder, and deletes what killed writers left half written; a
  /// part takes over what a whole study stored. Errors: conflict (another living process writes this part or
  /// the whole, or any part for a whole study; or the results file is none of
  /// ours, or of another format), corrupt (the results file is damaged), write_failed, unreadable.
  /// `part`: "1-of-4" of a shard; empty for a whole study. `on_failure` is called once, from any thread, when
  /// something cannot be written: the study has to end.
  static Result<std::unique_ptr<CaseStore>> open(const std::filesystem::path& folder,
                                                 const std::string& part = {},
                                                 std::function<void(const Error&)> on_failure = {});
  /// A store that only looks at what the last commits left in the files of all parts, also where nothing may
  /// be written: nothing is held, repaired or replaced. Only const members, `holds` and `load` may be called.
  /// Errors: conflict (a process writes there), corrupt,
  /// unreadable.
  static Result<std::unique_ptr<CaseStore>> open_to_read(const std::filesystem::path& folder);
  /// Releases the results file.
  ~CaseStore();
  CaseStore(const CaseStore&) = delete;
  CaseStore& operator=(const CaseStore&) = delete;

  /// The newest attempt on a case; nothing where there was none.
  std::optional<RunRecord> record_of(const std::string& hash) const;
  /// Those of all cases, in the order of their hashes.
  std::vector<RunRecord> records() const;

  /// Whether the result of a case is there: a file under its name is whole. One that turned out to be damaged
  /// does not count.
  bool holds(const std::string& hash) const;
  /// The result of a case that is held, checked against its checksum, with the wall time from its record.
  /// Errors: missing; corrupt (from now on it does not count, see `remarks`, and the next result takes its
  /// place); unreadable.
  Result<run::CaseResult> load(const std::string& hash);

  /// Writes a result: the file under a temporary name, synced, renamed; then its record, committed. Host,
  /// times and wall time go to the record only, so that equal cases are equal files, bit by bit. `record`
  /// gives label and wall time; the rest is filled in, also a model version and a wall time of 0.
  /// A result whose arrays do not fit together counts as something that cannot be written.
  void save(const CaseIdentity& identity, const scene::Scene& scene, run::CaseResult result,
            RunRecord record);
  /// Records an attempt that left no result.
  void note(RunRecord record);

  /// Puts these in the place of all tables for other programs, at once.
  void replace_tables(const std::vector<PlainTable>& tables);

  /// The first thing that could not be written, if any; all else that was saved or noted is on disk.
  MaybeError flush() const;

  /// Members for status.json besides those of the store: how far the runs are that the process was asked for.
  /// Written once a second at most, unless `at_once`.
  void tell_progress(nlohmann::ordered_json progress, bool at_once = false);
  /// What a person should know of what was found, such as damaged files.
  std::vector<std::string> remarks() const;
  const std::filesystem::path& folder() const { return names_.folder; }

  /// Takes over what another folder holds and this one does not: case files (as a second name of the same
  /// file where the file system can), their records; of cases that are done in neither, the newest
  /// attempt. Errors: conflict (a process writes there; no record was taken), missing (no such store),
  /// corrupt, unreadable, write_failed.
  struct Imported {
    std::size_t cases = 0, already_there = 0;
  };
  Result<Imported> import_from(const std::filesystem::path& other);

 private:
  CaseStore(StoreNames names, std::function<void(const Error&)> on_failure, Database database, bool writes);

  /// Makes the table of runs where it is missing, and takes the rows of these files.
  void take_over(const std::vector<std::filesystem::path>& others);
  /// Makes a change, alone among the threads, unless something failed before; the first failure is kept and
  /// told. It is on disk before this returns.
  void change(const std::function<void()>& make);
  void fail(const Error& error);

  void put(const RunRecord& record);
  /// Takes over the result of another folder: a second name of its file where the file system can.
  MaybeError take_file(const std::filesystem::path& file, const std::string& hash);
  /// When an attempt ended, and by which program and model it was made.
  void fill_in(RunRecord& record) const;
  void write_status(bool ended = false);

  const StoreNames names_;
  const std::function<void(const Error&)> on_failure_;
  const Manifest manifest_;  ///< of every case, without its input
  const std::string host_;
  const bool writes_;
  mutable std::mutex using_;  ///< of all below
  mutable Database database_;
  const std::string since_;  ///< ISO 8601, UTC
  std::shared_ptr<const nlohmann::ordered_json> progress_;
  std::vector<std::string> remarks_;
  MaybeError failure_;
  std::set<std::string> damaged_;  ///< hashes
  std::chrono::steady_clock::time_point status_written_;
};

/// The results files in a folder, of the whole and of parts.
std::vector<std::filesystem::path> results_files_in(const std::filesystem::path& folder);

// --- status.json of a study's folder: how far the study is, since nobody else may read a results file that
// is being written; every writer has a status of its own ---

/// A writer's snapshot: the members of its status file.
struct StoreStatus {
  std::string part;  ///< "1-of-4" of a shard; empty for a whole study
  nlohmann::ordered_json members;
  bool alive = false;  ///< a process holds the results file, whose lock ends with the process
};

/// The file's text.
std::string to_text(const nlohmann::ordered_json& members);
/// What the content of a status file says; nothing for any other file.
std::optional<nlohmann::ordered_json> status_in(std::string_view content);

/// The snapshots in a folder that count: those of parts in the order of their names, or that of the whole
/// study, whichever was written last.
std::vector<StoreStatus> statuses_in(const std::filesystem::path& folder);

}  // namespace launchsafe::store
