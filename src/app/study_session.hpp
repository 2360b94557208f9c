// What `study` and `merge` share: the folder with its store, what a running study shows of itself, and the
// delivery of its outcome.
#pragma once

#include "console.hpp"
#include "launchsafe/store/case_store.hpp"
#include "launchsafe/store/study_record.hpp"
#include "launchsafe/study/options.hpp"

namespace launchsafe::app {

class StudyWatch;

/// What a user asks of a study, or of the merge of its shards.
struct StudyArguments {
  path study;                         ///< file
  path output;                        ///< folder of cases, tables and report; may be empty for a dry run
  int jobs = 0;                       ///< threads; 0: as many as there are processors for us
  std::optional<double> memory;       ///< bytes of all running cases together
  std::optional<double> time_limit;   ///< s of wall time, of one case
  std::optional<double> longest_run;  ///< s, predicted, of one case; a longer one is refused
  study::Shard shard;                 ///< the part that is ours
  std::optional<double> tolerance;    ///< K, of T max; picks a setting from the study's accuracy record
  std::optional<std::time_t> until;   ///< when it stops, with what it has
  bool dry_run = false;               ///< say what would be run, and run nothing
  bool update = false;                ///< the folder may hold the results of an earlier study
  std::string command;                ///< the whole command, to be repeated in a shell
};

/// A study's folder while it is ours, from before the runs to the report.
class StudySession {
 public:
  /// Takes the folder and opens its store, or ends the command; unless the machine failed nothing was written
  /// then.
  StudySession(const StudyArguments& asked, const study::StudyFile& file, int jobs, Console& console);
  ~StudySession();

  /// Where results are kept.
  store::CaseStore& store() { return *store_; }

  /// Runs the study, and shows how far it is.
  kinds::StudyOutcome run(study::StudyOptions options);

  /// What the store has to say since the last call.
  void print_remarks();

  /// Keeps what is to be kept and reports the outcome of the study: what an interruption left, what a shard
  /// did, or report, tables and answer of the whole.
  ExitCode conclude(const kinds::StudyOutcome& result);
  /// Tells whoever watches how a study ended that was run.
  ExitCode end(ExitCode code);

 private:
  /// Whether all that was to be kept is on disk; prints why not.
  bool kept();
  ExitCode report_interruption();
  ExitCode deliver_shard(const kinds::StudyOutcome& result);
  ExitCode deliver_whole(const kinds::StudyOutcome& result);
  ExitCode write_files(const kinds::StudyOutcome& result);

  const StudyArguments& asked_;
  const study::StudyFile& file_;
  Console& console_;
  store::StudyRecord record_;  ///< what manifest.json is to say before there is a report
  std::unique_ptr<store::CaseStore> store_;
  std::unique_ptr<StudyWatch> watch_;  ///< once it runs
  std::size_t remarks_printed_ = 0;
};

}  // namespace launchsafe::app
