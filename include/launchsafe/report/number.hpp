// Numbers as text.
#pragma once

#include <fmt/ranges.h>

#include <cstdint>
#include <optional>

namespace launchsafe::report {

/// `decimals` digits after the point: 416.10. Never "-0.0". Not a number is "n/a", infinity "inf".
std::string fixed(double value, int decimals);

/// `decimals` digits after the first: 1.50e-05. Not a number and infinity as in `fixed`.
std::string scientific(double value, int decimals);

/// `digits` significant digits without trailing zeros; with a power of ten below 1e-4 and from 1e6 on.
std::string significant(double value, int digits);

/// The shortest text that reads back as exactly the same number; "NaN", "Infinity", "-Infinity" for the
/// others.
std::string exact(double value);

/// The smallest of 1, 2 and 5 times the powers of ten that is at least so large (> 0): for marks on an axis.
double round_distance(double least);

/// A duration in seconds for people: "0.3 s", "42 s", "3 min 05 s", "2 h 14 min", "3 d 04 h".
std::string duration(double seconds);

/// "1 case", "3 cases".
std::string counted(std::int64_t count, std::string_view noun);

/// Columns that a UTF-8 text takes in a terminal, with one for every code point but combining ones.
std::size_t display_width(std::string_view text);

// A value with its uncertainty in digits that mean something. Rounding never makes an allowed gap larger or
// an uncertainty smaller.

/// Digits after the point with which an uncertainty (> 0) is told: two significant digits. At least 0.
int decimals_for(double uncertainty);

/// `value` cut to so many digits after the point, towards minus infinity; what is a decimal number already
/// stays. Never above `value` by more than round-off.
double rounded_down(double value, int decimals);
/// Likewise towards plus infinity.
double rounded_up(double value, int decimals);

/// As it is printed.
struct Measured {
  double value = 0;            ///< rounded down
  double minus = 0, plus = 0;  ///< rounded up
  int decimals = 0;
  double lower() const { return value - minus; }
  double upper() const { return value + plus; }
  /// "0.039 ± 0.010 cm", or "0.039 +0.010 −0.012 cm" where the two differ.
  std::string text(const std::string& unit) const;
};

/// A value that may be smaller by `minus` and larger by `plus` (both finite, >= 0, not both 0).
Measured measured(double value, double minus, double plus);

/// A critical gap between its bounds, all in cm. Nothing where one of them is not known.
std::optional<Measured> measured_gap(double value, double at_least, double at_most);

/// `value` rounded down with so many decimals, as text: what is allowed. Never "-0.0".
std::string allowed_text(double value, int decimals);
/// `value` rounded up to so many significant digits, as text: what is uncertain. 0 stays 0.
std::string uncertain_text(double value, int digits = 2);

}  // namespace launchsafe::report
