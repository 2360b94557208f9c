// A thread team for the parallel loops of a step.
#pragma once

#include <atomic>
#include <cfenv>
#include <functional>
#include <thread>
#include <vector>

namespace launchsafe::mpm {

/// A fixed number of threads, the caller among them, that run the same function side by side. Threads start
/// at the first call and take over the caller's floating-point environment. Between calls they wait: first by
/// polling, then yielding the processor, then blocked.
class Team {
 public:
  explicit Team(int threads) : threads_(threads < 1 ? 1 : threads) {}
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int threads() const { return threads_; }

  /// Calls work(member) on every thread, member = 0 .. threads() - 1, and returns when all are done. `work`
  /// must not throw.
  void run(const std::function<void(int)>& work);

  /// Processor time (s) that the threads beside the caller have used.
  double helpers_processor_time() const;

  /// Inside `work`: waits until all members have come here.
  void wait_for_all();

 private:
  void start();
  void serve(int member);

  int threads_;
  mutable std::vector<std::thread> helpers_;
  std::fenv_t environment_{};
  const std::function<void(int)>* work_ = nullptr;
  std::atomic<unsigned> call_{0};     ///< number of calls so far
  std::atomic<int> running_{0};       ///< helpers that have not finished the present call
  std::atomic<int> arrived_{0};       ///< members at the present barrier
  std::atomic<unsigned> barrier_{0};  ///< number of barriers passed
  std::atomic<bool> ends_{false};
};

/// Whether steps use all threads or one, by which was faster at the last trial: on a machine that is busy
/// with other work, waiting for threads costs more than they gain. Trials of `trial` steps each are timed
/// every `between_trials` steps.
class ThreadingChoice {
 public:
  /// Whether the next step is to use all threads.
  bool parallel() const { return step_ < trial ? true : step_ < 2 * trial ? false : parallel_is_faster_; }
  /// Records the wall time (s) of a step.
  void record(double seconds);

 private:
  static constexpr int trial = 32, between_trials = 2000;  ///< steps
  int step_ = 0;
  double parallel_time_ = 0, serial_time_ = 0;  ///< s, of the last trials
  bool parallel_is_faster_ = true;
};

}  // namespace launchsafe::mpm
