// The progress of a running study: a line of a terminal, and its status in the results file.
#pragma once

#include "console.hpp"

#include <condition_variable>
#include <thread>

namespace launchsafe::app {

/// From before the runs to the end of the study. A thread of its own shows the newest progress.
class StudyWatch {
 public:
  /// `status`: shard, command and begin. At the time `until` the study is asked to stop, as by a signal.
  StudyWatch(store::CaseStore& store, store::StudyStatus status, bool quiet,
             std::optional<std::time_t> until);
  ~StudyWatch();

  /// For the runs, which tell how far they are.
  study::ProgressCallback callback();
  /// Removes the line; nothing is shown any more.
  void end_line();
  /// Stores how the study ended.
  void tell_end(ExitCode code);

 private:
  void show();
  store::StudyStatus status_of(const study::Progress& progress) const;

  store::CaseStore& store_;
  const store::StudyStatus status_;
  const std::optional<std::time_t> until_;
  std::mutex mutex_;  ///< of both below
  study::Progress progress_;
  std::chrono::steady_clock::time_point told_;
  std::optional<Progress> line_;
  std::jthread thread_;
};

}  // namespace launchsafe::app
