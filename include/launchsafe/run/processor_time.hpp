// Processor time of a thread.
#pragma once

#include <ctime>

namespace launchsafe::run {

/// Processor time (s) that the calling thread has used: other work on the machine does not count.
inline double thread_processor_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

}  // namespace launchsafe::run
