// A progress line on stderr: rewritten in place on a terminal, a plain line now and then elsewhere.
#pragma once

#include <chrono>
#include <mutex>
#include <string>

namespace launchsafe::app {

enum class ProgressStyle { none, terminal, plain };

/// `none` when quiet; else what stderr is. A terminal that cannot move its cursor (TERM=dumb) counts as none.
ProgressStyle progress_style(bool quiet);

/// Any thread may report.
class Progress {
 public:
  explicit Progress(ProgressStyle style);
  /// Removes the line from the terminal.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows the line, unless the last one is too fresh: a fifth of a second on a terminal, where the first is
  /// shown at once; ten seconds elsewhere, from the beginning on.
  void show(const std::string& line);

 private:
  ProgressStyle style_;
  std::mutex mutex_;
  std::chrono::steady_clock::duration pause_;
  std::chrono::steady_clock::time_point last_;
  bool shown_ = false;
};

/// "12 s left" when a share 0..1 took `elapsed` seconds; "" while it is too early
/// to say.
std::string time_left(double share, double elapsed);

}  // namespace launchsafe::app
