// As many doubles as a register of the processor holds, computed together, and the few functions that let one
// template serve a double and a Pack.
//
// Material laws are written once as `template <class Real>`: with Real = double they are tested and
// tabulated, with Real = Pack they run inside the step. Branches become `select`, loops run `while
// (any(mask))`.
#pragma once

#include <boost/align/aligned_allocator.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace launchsafe::math {

/// Arrays that start on a cache line, so that reading a Pack never straddles two.
inline constexpr std::size_t cache_line = 64;
using AlignedArray = std::vector<double, boost::alignment::aligned_allocator<double, cache_line>>;

/// Doubles of a Pack: those of one register. Wider ones are compared and selected lane by lane by the
/// compiler.
#if defined(__AVX512F__)
inline constexpr std::size_t pack_width = 8;
#elif defined(__AVX__)
inline constexpr std::size_t pack_width = 4;
#else
inline constexpr std::size_t pack_width = 2;
#endif

/// Lane-wise truth values; all bits set where true.
struct Mask {
  using Lanes = std::int64_t __attribute__((vector_size(pack_width * sizeof(std::int64_t))));
  Lanes lanes;
  friend Mask operator&(Mask a, Mask b) { return {a.lanes & b.lanes}; }
  friend Mask operator|(Mask a, Mask b) { return {a.lanes | b.lanes}; }
  friend Mask operator!(Mask a) { return {~a.lanes}; }
};

/// `pack_width` double-precision lanes with element-wise arithmetic.
struct Pack {
  using Lanes = double __attribute__((vector_size(pack_width * sizeof(double))));
  Lanes lanes;

  Pack() = default;
  Pack(double value) : lanes(value - Lanes{}) {}  // NOLINT: a scalar broadcasts, as in a formula
  explicit Pack(Lanes value) : lanes(value) {}

  /// Reads consecutive doubles; no alignment is required.
  static Pack load(const double* source) {
    Pack result;
    std::memcpy(&result.lanes, source, sizeof(Lanes));
    return result;
  }
  void store(double* target) const { std::memcpy(target, &lanes, sizeof(Lanes)); }
  double operator[](std::size_t lane) const { return lanes[lane]; }
  void set(std::size_t lane, double value) { lanes[lane] = value; }

  friend Pack operator+(Pack a, Pack b) { return Pack(a.lanes + b.lanes); }
  friend Pack operator-(Pack a, Pack b) { return Pack(a.lanes - b.lanes); }
  friend Pack operator*(Pack a, Pack b) { return Pack(a.lanes * b.lanes); }
  friend Pack operator/(Pack a, Pack b) { return Pack(a.lanes / b.lanes); }
  friend Pack operator-(Pack a) { return Pack(-a.lanes); }
  Pack& operator+=(Pack b) { return *this = *this + b; }
  Pack& operator-=(Pack b) { return *this = *this - b; }
  Pack& operator*=(Pack b) { return *this = *this * b; }
  friend Mask operator<(Pack a, Pack b) { return {a.lanes < b.lanes}; }
  friend Mask operator<=(Pack a, Pack b) { return {a.lanes <= b.lanes}; }
  friend Mask operator>(Pack a, Pack b) { return {a.lanes > b.lanes}; }
  friend Mask operator>=(Pack a, Pack b) { return {a.lanes >= b.lanes}; }
};

/// `work` of all lane numbers at once, each a constant of its own type.
template <class Work>
constexpr auto each_lane(Work work) {
  return [&]<std::size_t... lane>(std::index_sequence<lane...>) {
    return work(std::integral_constant<std::size_t, lane>{}...);
  }
  (std::make_index_sequence<pack_width>{});
}

// ---- the shared vocabulary: the same names for double and Pack ----

inline double select(bool condition, double yes, double no) { return condition ? yes : no; }
inline Pack select(Mask condition, Pack yes, Pack no) { return Pack(condition.lanes ? yes.lanes : no.lanes); }

inline bool any(bool condition) { return condition; }
/// By one byte a lane, all bits set where true: narrowing is three instructions, a sum over the lanes ten.
inline bool any(Mask condition) {
  using Bytes = std::int8_t __attribute__((vector_size(pack_width)));
  const Bytes narrow = __builtin_convertvector(condition.lanes, Bytes);
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, &narrow, sizeof(narrow));
  return bytes != 0;
}

inline double max(double a, double b) { return a < b ? b : a; }
inline double min(double a, double b) { return b < a ? b : a; }
inline Pack max(Pack a, Pack b) { return select(a < b, b, a); }
inline Pack min(Pack a, Pack b) { return select(b < a, b, a); }

inline double abs(double x) { return std::abs(x); }
inline Pack abs(Pack x) { return max(x, -x); }

inline double sqrt(double x) { return std::sqrt(x); }
/// By `each_lane` rather than a loop, which stays one where the compiler favours size: this is one
/// instruction.
inline Pack sqrt(Pack x) {
  return each_lane([x](auto... lane) { return Pack(Pack::Lanes{std::sqrt(x[lane])...}); });
}

/// 0, 1, 2, ... in the lanes.
inline constexpr Mask::Lanes lane_numbers =
    each_lane([](auto... lane) { return Mask::Lanes{static_cast<std::int64_t>(lane)...}; });

/// The last lane of `before`, then all lanes of `x` but its last.
inline Pack moved_up(Pack before, Pack x) {
  return each_lane([&](auto... lane) {
    return Pack(__builtin_shufflevector(before.lanes, x.lanes, (pack_width - 1 + lane)...));
  });
}

/// Sum over the lanes, pairwise, so that the order of addition is fixed on a processor.
template <std::size_t count = pack_width>
double sum(Pack x, std::size_t first = 0) {
  if constexpr (count == 1) {
    return x[first];
  } else {
    return sum<count / 2>(x, first) + sum<count / 2>(x, first + count / 2);
  }
}
inline double sum(double x) { return x; }
inline double largest(double x) { return x; }
inline double largest(Pack x) {
  double result = x[0];
  for (std::size_t lane = 1; lane < pack_width; ++lane) result = result < x[lane] ? x[lane] : result;
  return result;
}

inline double exp(double x) { return std::exp(x); }
inline double log(double x) { return std::log(x); }

/// e^x to 2 ulp for -708 <= x <= 709; 0 below, infinity above, NaN for NaN. Cody-Waite reduction by ln 2 and
/// a degree-13 Taylor polynomial on |r| <= ln(2)/2, whose remainder is below 2^-57.
inline Pack exp(Pack x) {
  constexpr double shifter =
      6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer held in the low bits
  constexpr double log2_e = 1.4426950408889634074;
  constexpr double ln2_high = 6.93147180369123816490e-01;
  constexpr double ln2_low = 1.90821492927058770002e-10;
  const Pack clamped = min(max(x, Pack(-708.0)), Pack(709.0));
  const Pack shifted = clamped * log2_e + shifter;
  const Pack n = shifted - shifter;
  const Pack r = (clamped - n * ln2_high) - n * ln2_low;
  constexpr double coefficients[] = {1.0 / 6227020800.0,
                                     1.0 / 479001600.0,
                                     1.0 / 39916800.0,
                                     1.0 / 3628800.0,
                                     1.0 / 362880.0,
                                     1.0 / 40320.0,
                                     1.0 / 5040.0,
                                     1.0 / 720.0,
                                     1.0 / 120.0,
                                     1.0 / 24.0,
                                     1.0 / 6.0,
                                     0.5,
                                     1.0,
                                     1.0};
  Pack polynomial(coefficients[0]);
  for (int k = 1; k < 14; ++k) polynomial = polynomial * r + coefficients[k];
  Mask::Lanes bits;
  std::memcpy(&bits, &shifted.lanes, sizeof(bits));
  bits = (bits + 1023) << 52;  // the low bits of `shifted` hold n in two's complement
  Pack scale;
  std::memcpy(&scale.lanes, &bits, sizeof(bits));
  Pack result = polynomial * scale;
  result = select(x < Pack(-708.0), Pack(0.0), result);
  result = select(x > Pack(709.0), Pack(HUGE_VAL), result);
  return select(x >= Pack(-HUGE_VAL), result, x);
}

/// Natural logarithm to 2 ulp for positive normal x; -infinity for 0, infinity for infinity, NaN below.
/// Mantissa in [sqrt(1/2), sqrt(2)), then the series of 2 atanh(s), s = (m-1)/(m+1), |s| <= 0.1716.
inline Pack log(Pack x) {
  // Unsigned, as the bits of a negative number or NaN would overflow; their result is not used.
  using Bits = std::uint64_t __attribute__((vector_size(sizeof(Mask::Lanes))));
  Bits bits;
  std::memcpy(&bits, &x.lanes, sizeof(bits));
  constexpr std::uint64_t sqrt_half_bits = 0x3FE6A09E667F3BCD;
  const Bits above_sqrt_half = bits - sqrt_half_bits;
  const Mask::Lanes exponent = reinterpret_cast<Mask::Lanes>(above_sqrt_half) >> 52;
  const Bits mantissa_bits = bits - (reinterpret_cast<Bits>(exponent) << 52);
  Pack m;
  std::memcpy(&m.lanes, &mantissa_bits, sizeof(mantissa_bits));
  const Pack e(__builtin_convertvector(exponent, Pack::Lanes));
  const Pack f = m - 1.0;
  const Pack s = f / (m + 1.0);
  const Pack z = s * s;
  Pack series(2.0 / 21.0);
  for (int k = 19; k >= 3; k -= 2) series = series * z + 2.0 / k;
  constexpr double ln2_high = 6.93147180369123816490e-01;
  constexpr double ln2_low = 1.90821492927058770002e-10;
  // ln m = f - s (f - z series): the leading term is exact, so no digits are lost near m = 1.
  Pack result = e * ln2_high + (f - (s * (f - z * series) - e * ln2_low));
  result = select(x < Pack(HUGE_VAL), result, x);
  result = select(x > Pack(0.0), result, select(x >= Pack(0.0), Pack(-HUGE_VAL), Pack(NAN)));
  return result;
}

/// x^y for x >= 0 by exp(y log x); 0^y = 0 for y > 0. Relative error about |y log x| ulp.
template <class Real>
Real pow(Real x, Real y) {
  return exp(y * log(x));
}
inline double pow(double x, double y) { return std::pow(x, y); }

}  // namespace launchsafe::math
