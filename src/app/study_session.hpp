// What `study` and `merge` share: the folder with its store, what a running study shows of itself, and the
// delivery of its outcome.
#pragma once

#include "console.hpp"
#include "launchsafe/store/case_store.hpp"
#include "launchsafe/store/study_record.hpp"
#include "launchsafe/study/scheduler.hpp"

namespace launchsafe::app {

class StudyWatch;

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
  ~StudySession();

  /// Takes the folder and opens its store, or ends the command; unless the machine failed nothing was written
  /// then.
  void open();
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
