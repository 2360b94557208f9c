#include "launchsafe/study/scheduler.hpp"

#include "facts_in_text.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace {

using namespace launchsafe::study;

std::vector<WaitingTask> waiting(const std::vector<Task>& tasks) {
  std::vector<WaitingTask> all;
  for (const Task& task : tasks) all.push_back({task.cost, [&task] { return task; }});
  return all;
}

Task task_of(double cost, std::function<void()> work) {
  return {cost, [work = std::move(work)](const ReportShare&) { work(); }};
}

TEST(Scheduler, StartsTheMostCostlyFirst) {
  std::vector<int> order;
  std::vector<Task> tasks;
  for (const int cost : {2, 5, 1, 4, 3})
    tasks.push_back(task_of(cost, [&order, cost] { order.push_back(cost); }));
  ProgressTracker tracker({});
  run_tasks(waiting(tasks), {1}, tracker);
  EXPECT_EQ(order, (std::vector<int>{5, 4, 3, 2, 1}));
}

TEST(Scheduler, AFailureIsThatTasksAlone) {
  std::atomic<int> done{0};
  std::vector<Task> tasks;
  for (int i = 0; i < 8; ++i) {
    tasks.push_back(task_of(1, [&done, i] {
      if (i == 3) throw std::runtime_error("broken");
      if (i == 5) throw 5;
      ++done;
    }));
  }
  ProgressTracker tracker({});
  const auto outcomes = run_tasks(waiting(tasks), {2}, tracker);
  EXPECT_EQ(done, 6);
  EXPECT_EQ(outcomes[3].failure, "broken");
  EXPECT_EQ(outcomes[5].failure, "an unknown exception");
  for (const std::size_t i : {0u, 1u, 2u, 4u, 6u, 7u}) EXPECT_TRUE(outcomes[i].failure.empty()) << i;
}

TEST(Scheduler, NeverRunsMoreThanTheJobsAskedFor) {
  for (const int jobs : {1, 2}) {
    std::atomic<int> running{0}, most{0};
    std::vector<Task> tasks;
    for (int i = 0; i < 12; ++i) {
      tasks.push_back(task_of(1, [&] {
        const int now = ++running;
        int before = most;
        while (now > before && !most.compare_exchange_weak(before, now)) {
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        --running;
      }));
    }
    ProgressTracker tracker({});
    run_tasks(waiting(tasks), {jobs}, tracker);
    EXPECT_LE(most, jobs);
  }
}

TEST(Scheduler, StartsNothingAfterTheStopFlag) {
  std::atomic<bool> stop{false};
  std::vector<Task> tasks;
  for (int i = 0; i < 4; ++i) tasks.push_back(task_of(4 - i, [&stop, i] { stop = i == 1; }));
  ProgressTracker tracker({});
  const auto outcomes = run_tasks(waiting(tasks), {1}, tracker, &stop);
  EXPECT_TRUE(outcomes[0].started);
  EXPECT_TRUE(outcomes[1].started);
  EXPECT_FALSE(outcomes[2].started);
  EXPECT_FALSE(outcomes[3].started);
}

TEST(Scheduler, ReportsProgressThatEndsAtOne) {
  std::vector<Progress> reports;
  ProgressTracker tracker([&reports](const Progress& progress) { reports.push_back(progress); });
  std::vector<Task> tasks;
  for (int i = 0; i < 3; ++i) {
    tasks.push_back({1.0 + i, [](const ReportShare& report) {
                       report(0.5);
                       report(0.25);  // never goes back
                     }});
    tracker.expect(1, tasks.back().cost);
  }
  run_tasks(waiting(tasks), {1}, tracker);
  ASSERT_FALSE(reports.empty());
  EXPECT_TRUE(std::is_sorted(reports.begin(), reports.end(),
                             [](const Progress& a, const Progress& b) { return a.fraction < b.fraction; }));
  EXPECT_EQ(reports.back().done, 3u);
  EXPECT_EQ(reports.back().total, 3u);
  EXPECT_EQ(reports.back().running, 0u);
  EXPECT_NEAR(reports.back().fraction, 1.0, 1e-12);
  EXPECT_NEAR(reports.back().seconds_left, 0.0, 1e-9);
}

/// A tracker of two tasks at a time, and what it told last, on a clock of its own.
struct Tracked {
  double now = 100.0;
  Progress told;
  ProgressTracker tracker{[this](const Progress& progress) { told = progress; }, [this] { return now; }};
};

TEST(ProgressTracker, LearnsTheTimeLeftFromTheRunsSoFar) {
  Tracked of;
  of.tracker.expect(6, 600.0);
  of.now += 50.0;  // planning does not count
  of.tracker.started();
  of.tracker.started();
  EXPECT_LT(of.told.seconds_left, 0.0);
  of.now += 0.5;
  of.tracker.advanced(1.0);
  EXPECT_LT(of.told.seconds_left, 0.0) << "half a second of two runs says nothing yet";
  of.now += 9.5;
  of.tracker.advanced(99.0);
  of.tracker.finished();
  // 20 s of runs for 100 of 600: 100 s for the rest, on two threads.
  EXPECT_NEAR(of.told.seconds_left, 50.0, 1e-9);
  of.tracker.expect(0, 200.0);
  of.tracker.advanced(0.0);
  EXPECT_NEAR(of.told.seconds_left, 70.0, 1e-9);
}

TEST(ProgressTracker, CountsCasesAndFailures) {
  Tracked of;
  of.tracker.expect_cases(70);
  of.tracker.cases_ended(5, false);  // stored before
  of.tracker.expect(1, 1.0);
  of.tracker.started();
  of.now += 10.0;
  of.tracker.cases_ended(3, true);
  of.tracker.cases_ended(1, false);
  of.tracker.finished();
  EXPECT_EQ(of.told.cases, 70u);
  EXPECT_EQ(of.told.cases_done, 9u);
  EXPECT_EQ(of.told.cases_failed, 3u);
}

/// Tasks that record how much memory they and those beside them take, and go on once it was `awaited`.
struct MemoryUse {
  double awaited = 0;
  std::mutex mutex;
  std::condition_variable changed;
  double now = 0, most = 0;
  std::vector<Task> tasks;

  void add(double cost, double memory) {
    tasks.push_back({cost,
                     [this, memory](const ReportShare&) {
                       std::unique_lock lock(mutex);
                       now += memory;
                       most = std::max(most, now);
                       changed.notify_all();
                       changed.wait(lock, [this] { return most >= awaited; });
                       now -= memory;
                     },
                     memory});
  }
};

TEST(Scheduler, NeverTakesMoreThanTheMemoryLimit) {
  MemoryUse use;
  use.awaited = 5.0;  // several at a time all the same
  for (int i = 0; i < 20; ++i) use.add(1 + i % 3, 1.0 + i % 4);
  ProgressTracker tracker({});
  const auto outcomes = run_tasks(waiting(use.tasks), {4, 5.0}, tracker);
  for (const TaskOutcome& outcome : outcomes) EXPECT_TRUE(outcome.started && outcome.failure.empty());
  EXPECT_EQ(use.most, 5.0);
}

TEST(Scheduler, RefusesATaskThatIsTooLargeEvenAlone) {
  MemoryUse use;
  use.add(2, 9e9);
  use.add(1, 1e9);
  ProgressTracker tracker({});
  const auto outcomes = run_tasks(waiting(use.tasks), {2, 5e9}, tracker);
  EXPECT_TRUE(launchsafe::testing::in_order(outcomes[0].failure, {"9 GB", "5 GB"}));
  EXPECT_TRUE(outcomes[1].failure.empty());
  EXPECT_EQ(use.most, 1e9);
}

TEST(Scheduler, FindsMemoryThatIsAvailable) {
  EXPECT_GT(available_memory(), 1e6);
  EXPECT_LT(available_memory(), 1e15);  // this machine says what it has
}

TEST(Scheduler, FindsAtLeastOneCore) { EXPECT_GE(available_cores(), 1); }

}  // namespace
