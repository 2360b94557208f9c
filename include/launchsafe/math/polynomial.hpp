// Polynomials that stand in for costly functions on an interval.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace launchsafe::math {

namespace detail {

template <std::size_t first, std::size_t terms, class Real, std::size_t count>
[[gnu::always_inline]] inline Real polynomial(const std::array<double, count>& c, const Real* powers) {
  if constexpr (terms == 1) {
    return Real(c[first]);
  } else {
    return polynomial<first + terms / 2, terms / 2>(c, powers - 1) * *powers +
           polynomial<first, terms / 2>(c, powers - 1);
  }
}

}  // namespace detail

/// c[0] + c[1] x + c[2] x^2 + ...; halves go side by side (Estrin's scheme), so that the chain of dependent
/// operations grows with the logarithm of the degree. The number of coefficients is a power of two.
template <class Real, std::size_t count>
[[gnu::always_inline]] inline Real polynomial(const std::array<double, count>& c, Real x) {
  static_assert(count >= 2 && std::has_single_bit(count));
  constexpr auto squarings = static_cast<std::size_t>(std::countr_zero(count));
  Real powers[squarings];  // x, x^2, x^4, ...
  powers[0] = x;
  for (std::size_t k = 1; k < squarings; ++k) powers[k] = powers[k - 1] * powers[k - 1];
  return detail::polynomial<0, count>(c, powers + squarings - 1);
}

/// Coefficients of the polynomial that meets f (long double to long double) at the `count` Chebyshev nodes of
/// [low, high]: for a smooth f within a small factor of the best one. Powers of x, so that an interval that
/// lies around 0 and whose width is below 1 loses no digits; computed in long double.
template <std::size_t count, class Function>
std::array<double, count> chebyshev_fit(Function f, double low, double high) {
  using Coefficients = std::array<long double, count>;
  const long double middle = 0.5L * (static_cast<long double>(low) + high),
                    half = 0.5L * (static_cast<long double>(high) - low);
  const auto angle = [](std::size_t node) {
    return std::numbers::pi_v<long double> * (static_cast<long double>(node) + 0.5L) / count;
  };
  // f = sum of series[k] T_k(t), t in [-1, 1].
  Coefficients series{};
  for (std::size_t node = 0; node < count; ++node) {
    const long double value = f(middle + half * std::cos(angle(node)));
    for (std::size_t k = 0; k < count; ++k)
      series[k] +=
          (k == 0 ? 1.0L : 2.0L) / count * value * std::cos(static_cast<long double>(k) * angle(node));
  }
  // Powers of t, by T_{k+1} = 2 t T_k - T_{k-1}.
  Coefficients powers{}, before{}, current{};
  current[0] = 1.0L;
  for (std::size_t k = 0; k < count; ++k) {
    Coefficients next{};
    for (std::size_t i = 0; i < count; ++i) {
      powers[i] += series[k] * current[i];
      next[i] = (i > 0 ? (k == 0 ? 1.0L : 2.0L) * current[i - 1] : 0.0L) - before[i];
    }
    before = current;
    current = next;
  }
  // Powers of x, by Horner's scheme in t = (x - middle)/half.
  Coefficients result{};
  for (std::size_t k = count; k-- > 0;) {
    Coefficients next{};
    for (std::size_t i = 0; i < count; ++i)
      next[i] = ((i > 0 ? result[i - 1] : 0.0L) - middle * result[i]) / half;
    next[0] += powers[k];
    result = next;
  }
  std::array<double, count> rounded;
  for (std::size_t i = 0; i < count; ++i) rounded[i] = static_cast<double>(result[i]);
  return rounded;
}

}  // namespace launchsafe::math
