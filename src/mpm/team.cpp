#include "launchsafe/mpm/team.hpp"

#include <pthread.h>

#include <ctime>

namespace launchsafe::mpm {
namespace {

/// Looks before a waiting thread gives way to others: a step's phases take microseconds, and on a machine
/// with fewer free cores than threads spinning would only hold up whom it waits for.
constexpr int looks_before_yield = 256;
/// Times it gives way before it sleeps.
constexpr int yields_before_sleep = 2000;

template <class Changed>
void wait_awake(Changed&& changed) {
  for (int look = 0; !changed(); ++look)
    if (look >= looks_before_yield) std::this_thread::yield();
}

}  // namespace

Team::~Team() {
  ends_.store(true);
  call_.fetch_add(1);
  call_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

void Team::start() {
  std::fegetenv(&environment_);
  for (int member = 1; member < threads_; ++member) helpers_.emplace_back([this, member] { serve(member); });
}

void Team::serve(int member) {
  std::fesetenv(&environment_);
  for (unsigned seen = 0;; ++seen) {
    int look = 0;
    while (call_.load(std::memory_order_acquire) == seen) {
      if (++look < looks_before_yield) continue;
      if (look < looks_before_yield + yields_before_sleep)
        std::this_thread::yield();
      else
        call_.wait(seen);
    }
    if (ends_.load()) return;
    (*work_)(member);
    running_.fetch_sub(1, std::memory_order_acq_rel);
  }
}

double Team::helpers_processor_time() const {
  double total = 0.0;
  for (std::thread& helper : helpers_) {
    clockid_t clock{};
    timespec time{};
    if (pthread_getcpuclockid(helper.native_handle(), &clock) != 0 || clock_gettime(clock, &time) != 0)
      continue;
    total += static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  return total;
}

void Team::run(const std::function<void(int)>& work) {
  if (threads_ > 1) {
    if (helpers_.empty()) start();
    work_ = &work;
    running_.store(threads_ - 1, std::memory_order_relaxed);
    call_.fetch_add(1, std::memory_order_release);
    call_.notify_all();
  }
  work(0);
  wait_awake([this] { return running_.load(std::memory_order_acquire) == 0; });
}

void Team::wait_for_all() {
  if (threads_ == 1) return;
  const unsigned now = barrier_.load(std::memory_order_acquire);
  if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == threads_) {
    arrived_.store(0, std::memory_order_relaxed);
    barrier_.fetch_add(1, std::memory_order_release);
    return;
  }
  wait_awake([this, now] { return barrier_.load(std::memory_order_acquire) != now; });
}

void FasterWay::took(double seconds) {
  if (step_ == 0) together_ = alone_ = 0.0;
  if (step_ < trial)
    together_ += seconds;
  else if (step_ < 2 * trial)
    alone_ += seconds;
  ++step_;
  if (step_ == 2 * trial) together_is_faster_ = together_ < alone_;
  if (step_ == 2 * trial + between_trials) step_ = 0;
}

}  // namespace launchsafe::mpm
