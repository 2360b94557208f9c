#include "launchsafe/study/scheduler.hpp"

#include "launchsafe/math/numbers.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <optional>

namespace launchsafe::study {
namespace {

constexpr double too_early = 2.0;  ///< s of work from which nothing is learned

/// One task from start to end, whatever it throws; nothing of one that is refused.
void perform(const Task& task, const std::string& refusal, TaskOutcome& outcome, ProgressTracker& tracker) {
  double reported = 0;
  const auto report_share = [&](double share) {
    const double now = std::clamp(share, reported, 1.0);
    tracker.advanced((now - reported) * task.cost);
    reported = now;
  };
  outcome = {refusal.empty(), !refusal.empty(), refusal};
  tracker.started();
  try {
    if (outcome.started) task.work(report_share);
  } catch (const std::exception& error) {
    outcome.failure = error.what();
    if (outcome.failure.empty()) outcome.failure = "an exception without a message";
  } catch (...) {
    outcome.failure = "an unknown exception";
  }
  report_share(1.0);
  tracker.finished();
}

/// The tasks that wait, the most costly first, and the memory that is left for them.
class Queue {
 public:
  Queue(const std::vector<WaitingTask>& tasks, double memory)
      : tasks_(tasks), made_(tasks.size()), limit_(memory), free_(memory) {
    waiting_.resize(tasks.size());
    std::iota(waiting_.begin(), waiting_.end(), std::size_t{0});
    // Reversed: the back is taken first, and taking it is cheap.
    std::ranges::stable_sort(waiting_, [&tasks](std::size_t a, std::size_t b) {
      return tasks[a].cost != tasks[b].cost ? tasks[a].cost < tasks[b].cost : a > b;
    });
  }

  /// The next task that fits, its memory taken; waits for one to fit. Nothing when none is left or `stop` is
  /// set.
  std::optional<std::pair<std::size_t, Task>> take(const std::atomic<bool>* stop) {
    std::unique_lock lock(mutex_);
    while (!waiting_.empty() && !(stop != nullptr && stop->load(std::memory_order_relaxed))) {
      // One that is refused is taken at once.
      const auto fits = [this](std::size_t index) {
        const Task& task = made(index);
        // Sums of rounded numbers may end a bit short of the limit that they began with.
        return task.memory <= free_ || running_ == 0 || !why_refused(task).empty();
      };
      const auto found = std::find_if(waiting_.rbegin(), waiting_.rend(), fits);
      if (found != waiting_.rend()) {
        std::pair taken{*found, std::move(*made_[*found])};
        made_[*found].reset();
        waiting_.erase(std::next(found).base());
        if (why_refused(taken.second).empty()) {
          free_ -= taken.second.memory;
          ++running_;
        }
        return taken;
      }
      // With a time limit, since a signal handler that sets `stop` cannot notify.
      changed_.wait_for(lock, std::chrono::milliseconds(100));
    }
    return std::nullopt;
  }

  void give_back(const Task& task) {
    const std::lock_guard lock(mutex_);
    free_ += task.memory;
    --running_;
    changed_.notify_all();
  }

  /// Why a task must not be begun, as it does not fit even alone; empty for one that may.
  std::string why_refused(const Task& task) const {
    if (!(task.memory > limit_)) return {};
    return fmt::format("it needs about {:.3g} GB of memory, and the limit is {:.3g} GB", 1e-9 * task.memory,
                       1e-9 * limit_);
  }

 private:
  const Task& made(std::size_t index) {
    std::optional<Task>& task = made_[index];
    if (!task) task = tasks_[index].make();
    return *task;
  }

  const std::vector<WaitingTask>& tasks_;
  std::vector<std::optional<Task>> made_;  ///< those that did not fit
  double limit_, free_;
  std::size_t running_ = 0;
  std::vector<std::size_t> waiting_;
  std::mutex mutex_;
  std::condition_variable changed_;
};

// --- What this process may use of its machine. ---

namespace fs = std::filesystem;

/// The root of the control groups and, below it, the process's own ones (version 2) from the top down.
std::vector<fs::path> control_groups() {
  std::vector<fs::path> groups{"/sys/fs/cgroup"};
  std::ifstream stream("/proc/self/cgroup");
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("0::/")) continue;
    for (const fs::path& part : fs::path(line.substr(4))) groups.push_back(groups.back() / part);
    break;
  }
  return groups;
}

/// Cores that a quota per period allows, rounded up; `cores` where there is no quota.
int limited(int cores, double quota, double period) {
  if (!(quota > 0) || !(period > 0)) return cores;
  return std::min(cores, std::max(1, static_cast<int>(std::ceil(quota / period - 1e-9))));
}

constexpr double unlimited = math::infinity;

/// The number in a file; infinity where there is none ("max", no such file).
double number_read_from(const fs::path& file) {
  std::ifstream stream(file);
  double number = 0;
  return stream >> number ? number : unlimited;
}

/// MemAvailable of the machine, bytes.
double machine_memory() {
  std::ifstream stream("/proc/meminfo");
  for (std::string line; std::getline(stream, line);) {
    constexpr std::string_view name = "MemAvailable:";
    if (line.starts_with(name)) return 1024.0 * std::strtod(line.c_str() + name.size(), nullptr);
  }
  return unlimited;
}

/// What a limit leaves beside what is used, by the numbers in two files (bytes).
double left_of(const fs::path& limit_file, const fs::path& used_file) {
  const double limit = number_read_from(limit_file), used = number_read_from(used_file);
  return std::max(0.0, limit - (used == unlimited ? 0.0 : used));
}

}  // namespace

int available_cores() {
  int cores = std::max(1, tbb::info::default_concurrency());  // by affinity
  double quota = 0, period = 0;
  // cpu.max of a control group (version 2): "max 100000" or "200000 100000".
  for (const fs::path& group : control_groups())
    if (std::ifstream stream(group / "cpu.max"); stream >> quota >> period)
      cores = limited(cores, quota, period);
  return cores;
}

double available_memory() {
  double memory = machine_memory();
  for (const fs::path& group : control_groups())
    memory = std::min(memory, left_of(group / "memory.max", group / "memory.current"));
  return memory;
}

std::string to_string(Phase phase) {
  constexpr std::array words{"launches", "runs that follow", "report"};
  return words.at(static_cast<std::size_t>(phase));
}

ProgressTracker::ProgressTracker(ProgressCallback callback, Clock clock)
    : callback_(std::move(callback)), clock_(clock ? std::move(clock) : [] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
      }) {}

void ProgressTracker::begin(Phase phase) {
  const std::lock_guard lock(mutex_);
  progress_.phase = phase;
  report();
}

void ProgressTracker::expect(std::ptrdiff_t tasks, double cost) {
  const std::lock_guard lock(mutex_);
  progress_.total = static_cast<std::size_t>(
      std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(progress_.total) + tasks));
  cost_ += cost;
}

void ProgressTracker::expect_cases(std::size_t cases) {
  const std::lock_guard lock(mutex_);
  progress_.cases += cases;
}

void ProgressTracker::cases_ended(std::ptrdiff_t cases, bool failed) {
  const std::lock_guard lock(mutex_);
  progress_.cases_done = static_cast<std::size_t>(
      std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(progress_.cases_done) + cases));
  if (failed) progress_.cases_failed += static_cast<std::size_t>(cases);
  report();
}

void ProgressTracker::count_busy() {
  const double now = clock_();
  busy_ += static_cast<double>(progress_.running) * (now - busy_since_);
  busy_since_ = now;
}

void ProgressTracker::started() {
  const std::lock_guard lock(mutex_);
  count_busy();
  ++progress_.running;
  most_running_ = std::max(most_running_, progress_.running);
  report();
}

void ProgressTracker::advanced(double cost) {
  const std::lock_guard lock(mutex_);
  cost_done_ += cost;
  report();
}

void ProgressTracker::finished() {
  const std::lock_guard lock(mutex_);
  count_busy();
  --progress_.running;
  ++progress_.done;
  report();
}

/// The time that tasks took for their work, for the work that is left, on as many threads as there are tasks
/// for.
double ProgressTracker::seconds_left() {
  count_busy();
  const double left = std::max(0.0, cost_ - cost_done_);
  const std::size_t tasks_left = progress_.total - std::min(progress_.total, progress_.done);
  if (!(cost_done_ > 0) || (busy_ < too_early && left > 0)) return -1.0;
  const std::size_t at_a_time =
      std::clamp<std::size_t>(tasks_left, 1, std::max<std::size_t>(most_running_, 1));
  return busy_ * left / cost_done_ / static_cast<double>(at_a_time);
}

void ProgressTracker::report() {
  if (!callback_) return;
  progress_.fraction = cost_ > 0 ? std::clamp(cost_done_ / cost_, 0.0, 1.0) : 0.0;
  progress_.seconds_left = seconds_left();
  callback_(progress_);
}

std::vector<TaskOutcome> run_tasks(const std::vector<WaitingTask>& tasks, const Resources& resources,
                                   ProgressTracker& tracker, const std::atomic<bool>* stop) {
  std::vector<TaskOutcome> outcomes(tasks.size());
  constexpr double usable_share = 0.9;
  const double memory =
      resources.memory_limit > 0 ? resources.memory_limit : usable_share * available_memory();
  Queue queue(tasks, memory);
  const int jobs = resources.jobs > 0 ? resources.jobs : available_cores();
  const auto pull = [&] {
    while (const auto taken = queue.take(stop)) {
      const auto& [index, task] = *taken;
      tracker.expect(0, task.cost - tasks[index].cost);
      const std::string refusal = queue.why_refused(task);
      perform(task, refusal, outcomes[index], tracker);
      if (refusal.empty()) queue.give_back(task);
    }
  };
  const int most = static_cast<int>(std::min<std::size_t>(std::max<std::size_t>(tasks.size(), 1), 1024));
  const int pullers = std::clamp(jobs, 1, most);
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

void run_parts(std::size_t count, const std::function<void(std::size_t)>& part) {
  tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, count, part); });
}

}  // namespace launchsafe::study
