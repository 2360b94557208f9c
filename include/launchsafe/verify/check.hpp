// A number the program must reproduce: what it computes, what it should be, and where that comes from.
#pragma once

#include <cmath>
#include <string>

namespace launchsafe::verify {

struct Check {
  std::string group;  ///< what it belongs to, e.g. "air"
  std::string name;   ///< one line for people
  double computed = 0;
  double expected = 0;
  double tolerance = 0;  ///< > 0; in `unit` if absolute, else relative to the expected value
  std::string unit;      ///< of both numbers; empty for a pure number
  std::string source;    ///< where the expected number comes from
  bool absolute = true;  ///< what the tolerance means

  /// Distance from the expected value, in the measure of the tolerance.
  double error() const {
    const double distance = std::abs(computed - expected);
    return absolute ? distance : distance / std::abs(expected);
  }
  /// False for anything that is not a number.
  bool pass() const { return error() <= tolerance; }
};

}  // namespace launchsafe::verify
