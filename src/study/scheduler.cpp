#include "launchsafe/study/scheduler.hpp"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <exception>
#include <numeric>

namespace launchsafe::study {

ProgressTracker::ProgressTracker(ProgressCallback callback)
    : callback_(std::move(callback)), start_(std::chrono::steady_clock::now()) {}

void ProgressTracker::expect(std::ptrdiff_t tasks, double cost) {
  const std::lock_guard lock(mutex_);
  progress_.total = static_cast<std::size_t>(
      std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(progress_.total) + tasks));
  cost_ += cost;
  report();
}

void ProgressTracker::started() {
  const std::lock_guard lock(mutex_);
  ++progress_.running;
  report();
}

void ProgressTracker::advanced(double cost) {
  const std::lock_guard lock(mutex_);
  cost_done_ += cost;
  report();
}

void ProgressTracker::finished() {
  const std::lock_guard lock(mutex_);
  --progress_.running;
  ++progress_.done;
  report();
}

void ProgressTracker::report() {
  if (!callback_) return;
  const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const double fraction = cost_ > 0 ? std::clamp(cost_done_ / cost_, 0.0, 1.0) : 0.0;
  progress_.fraction = fraction;
  progress_.seconds_elapsed = elapsed;
  progress_.seconds_left = fraction > 0 ? elapsed * (1.0 - fraction) / fraction : -1.0;
  callback_(progress_);
}

namespace {

/// One task from start to end, whatever it throws.
void perform(const Task& task, TaskOutcome& outcome, ProgressTracker& tracker) {
  double reported = 0;
  const auto report_share = [&](double share) {
    const double now = std::clamp(share, reported, 1.0);
    tracker.advanced((now - reported) * task.cost);
    reported = now;
  };
  outcome.started = true;
  tracker.started();
  try {
    task.work(report_share);
  } catch (const std::exception& error) {
    outcome.failure = error.what();
    if (outcome.failure.empty()) outcome.failure = "an exception without a message";
  } catch (...) {
    outcome.failure = "an unknown exception";
  }
  report_share(1.0);
  tracker.finished();
}

}  // namespace

std::vector<TaskOutcome> run_tasks(const std::vector<Task>& tasks, int jobs, ProgressTracker& tracker,
                                   const std::atomic<bool>* stop) {
  std::vector<TaskOutcome> outcomes(tasks.size());
  std::vector<std::size_t> order(tasks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return tasks[a].cost > tasks[b].cost; });
  std::atomic<std::size_t> next{0};
  const auto pull = [&] {
    for (std::size_t at = next++; at < order.size(); at = next++) {
      if (stop != nullptr && stop->load(std::memory_order_relaxed)) return;
      perform(tasks[order[at]], outcomes[order[at]], tracker);
    }
  };
  const int most = static_cast<int>(std::min<std::size_t>(std::max<std::size_t>(tasks.size(), 1), 1024));
  const int pullers = std::clamp(jobs > 0 ? jobs : available_cores(), 1, most);
  // TBB by itself starts no more threads than there are cores; the caller may want more.
  const auto parallelism = tbb::global_control::max_allowed_parallelism;
  const tbb::global_control allowed(parallelism, std::max(static_cast<std::size_t>(pullers),
                                                          tbb::global_control::active_value(parallelism)));
  tbb::task_arena arena(pullers);
  arena.execute([&] {
    tbb::task_group group;
    for (int i = 0; i < pullers; ++i) group.run(pull);
    group.wait();
  });
  return outcomes;
}

}  // namespace launchsafe::study
