#include "signals.hpp"

#include <csignal>

namespace launchsafe::app {
namespace {

static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

void request_stop(int) { stop_requested().store(true, std::memory_order_relaxed); }

void stop_on(int signal) {
  struct sigaction action {};
  action.sa_handler = request_stop;
  sigemptyset(&action.sa_mask);
  action.sa_flags = static_cast<int>(SA_RESTART | SA_RESETHAND);
  sigaction(signal, &action, nullptr);
}

/// `nohup` has SIGHUP ignored, and means it.
bool is_ignored(int signal) {
  struct sigaction present {};
  return sigaction(signal, nullptr, &present) == 0 && present.sa_handler == SIG_IGN;
}

}  // namespace

void catch_signals() {
  stop_on(SIGINT);
  stop_on(SIGTERM);
  if (!is_ignored(SIGHUP)) stop_on(SIGHUP);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

std::atomic<bool>& stop_requested() {
  static constinit std::atomic<bool> flag{false};
  return flag;
}

}  // namespace launchsafe::app
