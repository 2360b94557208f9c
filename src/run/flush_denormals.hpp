// Denormal numbers cost a hundred times a normal one and carry nothing here: relaxing stresses decay through
// them.
#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace launchsafe::run {

/// Flushes denormals to zero on this thread during its lifetime. Without SSE it does nothing.
class FlushDenormals {
 public:
#if defined(__SSE2__)
  FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | flush_to_zero | denormals_are_zero); }
  ~FlushDenormals() { _mm_setcsr(saved_); }

 private:
  static constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
  unsigned saved_;
#else
  FlushDenormals() {}
  ~FlushDenormals() {}
#endif
 public:
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;
};

}  // namespace launchsafe::run
