// How long gnuplot may take.
#pragma once

#include <atomic>

namespace launchsafe::report {

/// What ends a program that draws a picture. A report is whole without its pictures: one that is not drawn is
/// a remark.
struct DrawingLimits {
  double time = 60.0;  ///< s of wall time, for one picture
  /// Set from another thread (or a signal handler) to stop: the picture being drawn is given up.
  const std::atomic<bool>* stop = nullptr;
};

}  // namespace launchsafe::report
