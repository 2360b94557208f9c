// What `study` and `merge` share: the folder with its store, what a running study shows of itself, and the
// delivery of its outcome.
#pragma once

#include "commands.hpp"
#include "launchsafe/store/case_store.hpp"
#include "launchsafe/store/study_record.hpp"
#include "launchsafe/study/scheduler.hpp"

#include <condition_variable>
#include <thread>

namespace launchsafe::app {

/// From before the runs to the end of the study. A thread of its own shows what was told last, also while
/// runs tell nothing.
class StudyWatch {
 public:
  /// `command` goes on after an interruption. At the time `until` the study is asked to stop, as by a signal.
  StudyWatch(store::CaseStore& store, std::string command, bool quiet, std::optional<std::time_t> until);
  ~StudyWatch() { end_line(); }
  StudyWatch(const StudyWatch&) = delete;
  StudyWatch& operator=(const StudyWatch&) = delete;

  /// For the runs: remembers how far they are.
  study::ProgressCallback callback();
  /// Removes the line; nothing is shown any more but the end.
  void end_line();
  /// Tells the folder how the study ended.
  void tell_end(int exit_code);

 private:
  void show_until_ended();
  void show();
  study::Progress progress_now();
  nlohmann::ordered_json members(const study::Progress& progress) const;
  void write_page();

  store::CaseStore& store_;
  std::string command_;
  std::optional<std::time_t> until_;
  std::mutex mutex_;  ///< of what follows
  std::condition_variable changed_;
  bool ended_ = false;
  study::Progress progress_;
  std::chrono::steady_clock::time_point told_;
  std::optional<std::chrono::steady_clock::time_point> page_written_;
  std::optional<Progress> line_;
  std::thread thread_;
};

/// How a study uses its folder.
struct SessionRequest {
  std::filesystem::path study;  ///< file
  std::filesystem::path folder;
  const kinds::Kind& kind;
  bool update = false;  ///< the folder may hold the results of an earlier study
  std::string part;     ///< of a shard
  std::string command;  ///< to be repeated after an interruption
  store::Manifest manifest;
  std::optional<std::time_t> until = {};  ///< when the study is to stop
};

/// A study's folder while it is ours, from before the runs to the report.
class StudySession {
 public:
  StudySession(SessionRequest request, Console& console);

  /// Takes the folder and opens its store. Anything but `done` is the end; then the reason was printed, and
  /// unless the machine failed nothing was written.
  ExitCode open();
  /// Where results are kept; only once open.
  store::CaseStore& store() { return *store_; }

  /// Runs the study, and shows how far it is.
  kinds::StudyOutcome run(const study::StudyFile& file, study::StudyOptions options);

  /// What the store has to say since the last call.
  void print_remarks();

  /// Keeps what is to be kept and reports the outcome of the study: what an interruption left, what a shard
  /// did, or report, tables and answer of the whole.
  ExitCode conclude(const kinds::StudyOutcome& result, const study::Shard& shard);
  /// Tells whoever watches how a study ended that was run.
  ExitCode end(ExitCode code);

 private:
  ExitCode deliver(const kinds::StudyOutcome& result, const study::Shard& shard);
  /// Whether all that was to be kept is on disk; prints why not.
  bool kept();
  ExitCode report_interruption();
  ExitCode deliver_shard(const kinds::StudyOutcome& result, const study::Shard& shard);
  ExitCode deliver_whole(const kinds::StudyOutcome& result);
  /// What manifest.json is to say before there is a report.
  store::StudyRecord record() const;
  ExitCode write_files(const kinds::StudyOutcome& result);

  SessionRequest request_;
  Console& console_;
  std::unique_ptr<store::CaseStore> store_;
  std::unique_ptr<StudyWatch> watch_;  ///< once it runs
  std::size_t remarks_printed_ = 0;
};

}  // namespace launchsafe::app
