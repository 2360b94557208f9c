// Numbers as text.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace launchsafe::report {

/// `decimals` digits after the point: 416.10. Never "-0.0". Not a number is "n/a", infinity "inf".
std::string fixed(double value, int decimals);

/// `decimals` digits after the first: 1.50e-05. Not a number and infinity as in `fixed`.
std::string scientific(double value, int decimals);

/// `digits` significant digits, in whichever of the two notations is shorter; without trailing zeros.
std::string significant(double value, int digits);

/// The shortest text that reads back as exactly the same number; "NaN", "Infinity", "-Infinity" for the
/// others.
std::string exact(double value);

/// A duration in seconds for people: "0.3 s", "42 s", "3 min 05 s", "2 h 14 min", "3 d 04 h".
std::string duration(double seconds);

/// "1 case", "3 cases".
std::string counted(std::int64_t count, std::string_view noun);

/// Columns that a UTF-8 text takes in a terminal, with one for every code point but combining ones.
std::size_t display_width(std::string_view text);

}  // namespace launchsafe::report
