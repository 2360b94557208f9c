// The folder of a study, or of a shard of it: one results file, and one file a case beside it. Killing the
// process at any instant loses at most what was in flight.
//
//   DIR/study.db        SQLite: runs, how far the study is, and the tables of the report
//   DIR/cases/HASH.h5   the result of one case, named by what determines it, whole or not there
//   DIR/study.lock      empty; locked by the process that writes
//
// A result is on disk under its name before its row is committed.
#pragma once

#include "launchsafe/store/case_file.hpp"
#include "launchsafe/store/database.hpp"

#include <chrono>
#include <map>
#include <mutex>
#include <set>

namespace launchsafe::store {

/// All that determines a result, as canonical text, and the name that follows from it.
struct CaseIdentity {
  explicit CaseIdentity(std::string determining_input);
  std::string input;
  std::string hash;  ///< the first 32 hexadecimal digits of the SHA-256 of the input
};

/// The outcome of an attempt. A run that ended by itself is done, also when its energy drifted away: computed
/// again it would do the same. Failed: it threw (memory, for example), and may succeed another time.
enum class CaseState { done, failed, timed_out, interrupted };

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
  std::string program;        ///< that made the attempt, see `program_of`
  std::string end_time;       ///< ISO 8601, UTC
};

/// How far a study is: the newest row that its writer stored.
struct StudyStatus {
  std::string shard = {};    ///< "1/4"; empty for a whole study
  std::string command = {};  ///< that goes on after an interruption
  std::string time = {};     ///< ISO 8601, UTC: when this was written
  std::int64_t cases = 0, cases_done = 0, cases_failed = 0;
  double time_left = math::not_a_number;  ///< s from `time` on, an estimate
  int exit_code = -1;                     ///< of a process that came to its end
  bool alive = false;                     ///< a process holds the study, whose lock ends with the process
};

/// The status of the study in a folder; nothing where none is. Errors: those of `Database`.
std::optional<StudyStatus> status_in(const std::filesystem::path& folder);

/// A table for other programs: every row has a value for every column, perhaps nothing.
struct PlainTable {
  std::string name;
  std::vector<std::string> columns;
  std::vector<SqlRow> rows;
};

/// Any thread may call any member. A result that was saved, or an attempt that was noted, is seen at once by
/// whoever asks. Nothing is taken any more once something could not be written.
class CaseStore {
 public:
  /// Makes the folder and its results file, or goes on with it, takes it for this process alone, and deletes
  /// files that killed writers left half written. `on_failure` is called once, from any thread, when
  /// something cannot be written: the study has to end. Errors: conflict (another living process writes
  /// there), write_failed, and those of `Database`.
  static std::unique_ptr<CaseStore> open(const std::filesystem::path& folder,
                                         std::function<void(const Error&)> on_failure = {});
  /// A store that only shows the last commit, also while somebody writes there and where nothing may be
  /// written. Only const members may be called. Errors: those of `Database`.
  static std::unique_ptr<CaseStore> open_to_read(const std::filesystem::path& folder);

  /// The newest attempt on a case; nothing where there was none.
  std::optional<RunRecord> record_of(const std::string& hash) const;
  /// The newest attempts on all cases, in the order of their hashes.
  std::vector<RunRecord> records() const;

  /// Whether the result of a case is there: a file under its name is whole.
  bool holds(const std::string& hash) const;
  /// The result of a case, checked against its checksum, with the wall time from its record; nothing where
  /// there is none that can be read. A damaged file gets the ending ".damaged", see `remarks`.
  std::optional<run::CaseResult> load(const std::string& hash);

  /// Writes a result: the file under a temporary name, synced, renamed; then its record, committed. Times go
  /// to the record only, so that equal cases are equal files, bit by bit. `record` gives label, model version
  /// and wall time; the rest is filled in.
  void save(const CaseIdentity& identity, run::CaseResult result, RunRecord record);
  /// Records an attempt that left no result.
  void note(RunRecord record);

  /// Puts these in the place of all tables for other programs, at once.
  void replace_tables(const std::vector<PlainTable>& tables);

  /// Stores how far the study is, once a second at most unless `at_once`; the time is filled in.
  void tell_status(StudyStatus status, bool at_once);

  /// The first error of writing, if any; all else that was saved or noted is on disk.
  std::optional<Error> flush() const;
  /// Remarks for a person, such as the names of damaged files.
  std::vector<std::string> remarks() const;

  /// Takes over what another folder holds and this one does not: case files (as a second name of the same
  /// file where the file system can), their records; of cases that are done in neither, the newest attempt.
  /// How many results came. Errors: missing (no such store), unreadable, write_failed, and those of
  /// `Database`.
  std::size_t import_from(const std::filesystem::path& other);

 private:
  CaseStore(std::filesystem::path folder, std::function<void(const Error&)> on_failure);

  std::filesystem::path case_file(const std::string& hash) const;
  /// Makes a change, alone among the threads, unless something failed before; the first failure is kept and
  /// told. It is on disk before this returns.
  void change(const std::function<void()>& make);
  void fail(const Error& error);

  const std::filesystem::path folder_;
  const std::function<void(const Error&)> on_failure_;
  const Manifest manifest_;  ///< of every case, without its input
  std::shared_ptr<const void> lock_;
  mutable std::mutex using_;          ///< of all below
  std::optional<Database> database_;  ///< none of a store that only shows
  std::map<std::string, RunRecord> records_;
  std::vector<std::string> remarks_;
  std::optional<Error> failure_;
  std::chrono::steady_clock::time_point status_written_;
};

/// The results file of a study in a folder.
std::filesystem::path results_file(const std::filesystem::path& folder);

}  // namespace launchsafe::store
