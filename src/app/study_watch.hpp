// What a running study shows of itself: a line of progress and a status file.
#pragma once

#include "console.hpp"
#include "launchsafe/report/study_text.hpp"

#include <unistd.h>

#include <condition_variable>
#include <thread>

namespace launchsafe::app {

using namespace std::chrono_literals;

/// From before the runs to the end of the study. A thread of its own shows what was told last, also while
/// runs tell nothing.
class StudyWatch {
 public:
  /// `command` goes on after an interruption. At the time `until` the study is asked to stop, as by a signal.
  StudyWatch(store::CaseStore& store, std::string command, bool quiet, std::optional<std::time_t> until)
      : store_(store),
        command_(std::move(command)),
        until_(until),
        told_(std::chrono::steady_clock::now()),
        line_(quiet) {
    thread_ = std::jthread([this](const std::stop_token& ended) { show_until(ended); });
  }
  ~StudyWatch() { end_line(); }

  /// For the runs: remembers how far they are.
  study::ProgressCallback callback() {
    return [this](const study::Progress& progress) {
      const std::lock_guard lock(mutex_);
      progress_ = progress;
      told_ = std::chrono::steady_clock::now();
    };
  }

  /// Removes the line; nothing is shown any more but the end.
  void end_line() {
    thread_ = {};  // which ends it and waits
    line_.reset();
  }

  /// Tells the folder how the study ended.
  void tell_end(int exit_code) {
    end_line();
    Json told = members(progress_);
    told["runs_running"] = 0;
    told["time_left_s"] = nullptr;
    told["exit_code"] = exit_code;
    store_.tell_progress(std::move(told), true);
  }

 private:
  void show_until(const std::stop_token& ended) {
    std::mutex idle;
    std::unique_lock lock(idle);
    std::condition_variable_any wakened;
    while (true) {
      wakened.wait_for(lock, ended, 200ms, [] { return false; });
      if (ended.stop_requested()) return;
      if (until_ && std::time(nullptr) >= *until_) stop_requested() = true;
      // What watches the study must not end it.
      try {
        show();
      } catch (const std::exception&) {
      }
    }
  }

  void show() {
    std::unique_lock lock(mutex_);
    study::Progress now = progress_;
    const double since = std::chrono::duration<double>(std::chrono::steady_clock::now() - told_).count();
    lock.unlock();
    if (now.seconds_left >= 0) now.seconds_left = std::max(0.0, now.seconds_left - since);
    if (now.total > 0 && now.done == now.total) now.phase = study::Phase::report;
    line_->show(report::progress_line(now, std::time(nullptr)));
    store_.tell_progress(members(now));
  }

  Json members(const study::Progress& progress) const {
    Json members = report::progress_row(progress);
    members["command"] = command_;
    return members;
  }

  store::CaseStore& store_;
  std::string command_;
  std::optional<std::time_t> until_;
  std::mutex mutex_;  ///< of what follows
  study::Progress progress_;
  std::chrono::steady_clock::time_point told_;
  std::optional<Progress> line_;
  std::jthread thread_;
};

}  // namespace launchsafe::app
