// What a running study shows of itself: a line on the terminal, status.json and index.html in its folder.
#pragma once

#include "launchsafe/store/case_store.hpp"
#include "launchsafe/study/scheduler.hpp"
#include "progress.hpp"

#include <nlohmann/json.hpp>

#include <chrono>
#include <condition_variable>
#include <ctime>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace launchsafe::app {

/// The names of reports in a study's folder that its page links.
std::vector<std::string> reports_in(const std::filesystem::path& folder);

/// The line of progress, "" while nothing is known; `width`: columns that it may take.
std::string progress_line(const study::Progress& progress, std::time_t now, std::size_t width);

/// From before the runs to the end of the study. A thread of its own shows what was told last, also while
/// runs tell nothing.
class StudyWatch {
 public:
  /// `command` goes on after an interruption. At the time `until` the study is asked to stop, as by a signal.
  StudyWatch(store::CaseStore& store, std::string command, ProgressStyle style,
             std::optional<std::time_t> until);
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

}  // namespace launchsafe::app
