// Numbers that the program must reproduce: what it computes, what it should be, and where that comes from.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

namespace launchsafe::verify {

/// What the tolerance of a check is a bound on.
enum class Tolerance { absolute, relative };

struct Check {
  std::string name;  ///< one line for people
  double computed = 0;
  double expected = 0;
  double tolerance = 0;  ///< > 0; in `unit` if absolute, else relative to the expected value
  std::string unit;      ///< of both numbers; empty for a pure number
  std::string source;    ///< where the expected number comes from
  Tolerance measure = Tolerance::absolute;
  std::string group = {};  ///< what it belongs to, e.g. "air"; filled in by Computation::run

  bool absolute() const { return measure == Tolerance::absolute; }
  /// Distance from the expected value, in the measure of the tolerance.
  double error() const {
    const double distance = std::abs(computed - expected);
    return absolute() ? distance : distance / std::abs(expected);
  }
  /// False for anything that is not a number.
  bool pass() const { return error() <= tolerance; }
};

/// Checks that are computed together.
struct Computation {
  std::string group;
  std::function<std::vector<Check>()> compute;
  /// The checks with their group: up to some seconds on one core.
  std::vector<Check> run() const;
};

/// All of them, not yet run: the material laws, the skin at the charge bottom, and the assembled mechanics,
/// the latter by small simulations.
std::vector<Computation> computations();

}  // namespace launchsafe::verify
