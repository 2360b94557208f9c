#include "launchsafe/mpm/team.hpp"

#include <pthread.h>

#include <ctime>

namespace launchsafe::mpm {
namespace {

/// Polls before a waiting thread yields its processor: the phases of a step take microseconds, and on a
/// machine with fewer free cores than threads polling would delay the thread that is waited for.
constexpr int polls_before_yield = 256;
/// Yields before it blocks.
constexpr int yields_before_block = 2000;

template <class Changed>
void poll_until(Changed&& changed) {
  for (int poll = 0; !changed(); ++poll)
    if (poll >= polls_before_yield) std::this_thread::yield();
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
    int poll = 0;
    while (call_.load(std::memory_order_acquire) == seen) {
      if (++poll < polls_before_yield) continue;
      if (poll < polls_before_yield + yields_before_block)
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
  poll_until([this] { return running_.load(std::memory_order_acquire) == 0; });
}

void Team::wait_for_all() {
  if (threads_ == 1) return;
  const unsigned now = barrier_.load(std::memory_order_acquire);
  if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == threads_) {
    arrived_.store(0, std::memory_order_relaxed);
    barrier_.fetch_add(1, std::memory_order_release);
    return;
  }
  poll_until([this, now] { return barrier_.load(std::memory_order_acquire) != now; });
}

void ThreadingChoice::record(double seconds) {
  if (step_ == 0) parallel_time_ = serial_time_ = 0.0;
  if (step_ < trial)
    parallel_time_ += seconds;
  else if (step_ < 2 * trial)
    serial_time_ += seconds;
  ++step_;
  if (step_ == 2 * trial) parallel_is_faster_ = parallel_time_ < serial_time_;
  if (step_ == 2 * trial + between_trials) step_ = 0;
}

}  // namespace launchsafe::mpm
