// Independent tasks on all cores, longest first; one task's failure is its own.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace launchsafe::study {

/// What the runs of a study are for at the moment.
enum class Phase { launches, following_runs, report };
std::string to_string(Phase phase);

struct Progress {
  Phase phase = Phase::launches;
  std::size_t done = 0, running = 0, total = 0;  ///< runs
  std::size_t cases = 0, cases_done = 0;         ///< of the study; done with those that failed
  std::size_t cases_failed = 0;
  double fraction = 0;       ///< of all work, 0..1, with the shares of running tasks
  double seconds_left = -1;  ///< estimate; negative while nothing is known
};
/// Called from any running thread, one call at a time, a few times a second and at every change.
using ProgressCallback = std::function<void(const Progress&)>;

/// Cores this process may use: its CPU affinity, and the CPU quota of its control groups. At least 1.
int available_cores();

/// Adds up what tasks of several batches, and the cases that they are run for, report. How long the rest
/// takes is learned from the time that the runs so far took for their work.
class ProgressTracker {
 public:
  using Clock = std::function<double()>;  ///< s, from any zero on

  explicit ProgressTracker(ProgressCallback callback, Clock clock = {});
  void begin(Phase phase);
  /// Work that is known to come; may be taken back with negative numbers when it turns out not to be needed.
  void expect(std::ptrdiff_t tasks, double cost);
  /// Cases of the study.
  void expect_cases(std::size_t cases);
  /// So many cases came to an end, or failed; negative of those that go on.
  void cases_ended(std::ptrdiff_t cases, bool failed);
  void started();
  /// A running task has done `share` (0..1) of its work since its last report.
  void advanced(double cost);
  void finished();

 private:
  void report();
  void count_busy();
  double seconds_left();
  ProgressCallback callback_;
  Clock clock_;
  std::mutex mutex_;
  double busy_since_ = 0;  ///< s, up to when the running tasks are counted
  double busy_ = 0;        ///< s, of all tasks together until then
  std::size_t most_running_ = 0;
  Progress progress_;
  double cost_ = 0, cost_done_ = 0;
};

/// Bytes that this process may take without swapping: what the machine has free, and what the memory limit of
/// its control groups leaves. Infinity where neither can be read.
double available_memory();

/// Takes the share of its work (0..1) that a task has done.
using ReportShare = std::function<void(double)>;

struct Task {
  double cost = 1;  ///< relative, > 0
  std::function<void(const ReportShare& report)> work;
  double memory = 0;  ///< bytes while it runs
};

/// A task that waits, which is made when it is its turn to be begun: there may be a million.
struct WaitingTask {
  double cost = 1;             ///< about that of the task
  std::function<Task()> make;  ///< quick
};

struct TaskOutcome {
  bool started = false;  ///< false when the stop flag came first, or when it was refused
  bool refused = false;  ///< it is too large for the memory even alone: see `failure`
  std::string failure;   ///< what an exception said, or why it was refused; empty when all went well
};

struct Resources {
  int jobs = 0;             ///< tasks at a time; <= 0: available_cores()
  double memory_limit = 0;  ///< bytes of all running tasks together; <= 0: nine tenths of available_memory()
};

/// Runs all tasks, those first that wait with the largest cost. A task that would not fit into the memory
/// limit beside those that run waits, and less costly ones that fit go first; one that is too large even
/// alone fails. Never throws for a task's exception. Where there are fewer tasks left than jobs, they share
/// the jobs' threads. Once `stop` is set no further task starts. Outcomes are in the order of the tasks.
std::vector<TaskOutcome> run_tasks(const std::vector<WaitingTask>& tasks, const Resources& resources,
                                   ProgressTracker& tracker, const std::atomic<bool>* stop = nullptr);

/// So many parts of a task, which are independent. Cores that find no further task help; a thread that waits
/// for them must not start one.
void run_parts(std::size_t count, const std::function<void(std::size_t)>& part);

}  // namespace launchsafe::study
