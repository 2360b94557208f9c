// Error against processor time of the parts that have exact solutions: each over a series of settings (a
// step, a tolerance, a mesh), with the observed order of convergence.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace launchsafe::verify {

/// One setting of a part, and the work that gives its error.
struct Setting {
  std::string text;              ///< for people: "step 10 us"
  double size = 0;               ///< > 0, what the order is in: step (s), cell (m) or relative tolerance
  std::function<double()> work;  ///< one unit of it; the error in the series' unit, of either sign
};

/// One quantity of one part over its settings, coarsest first; not yet computed.
struct ErrorSeries {
  std::string part;        ///< "skin equation"
  std::string quantity;    ///< what the error is of: "induction time"
  std::string work;        ///< what the processor time is of
  std::string reference;   ///< the exact solution, or what stands for it
  std::string error_unit;  ///< empty: relative
  std::string theory;      ///< why the order is what it is
  /// Of the error in the size, by theory; infinite where the method is exact, NaN where no order is to be
  /// expected.
  double order = 0;
  double round_off = 0;  ///< errors up to this, in `error_unit`, are of round-off
  std::function<std::vector<Setting>()> settings = {};
};

/// What one setting gave.
struct MeasuredSetting {
  std::string text;
  double size = 0;
  double error = 0;           ///< >= 0, in the series' `error_unit`
  double processor_time = 0;  ///< s, of one unit of work, the least of several
  /// ln(error ratio)/ln(size ratio) to the setting before; NaN for the first and where round-off is reached.
  double order = 0;
};

/// Computes and times every setting of a series.
std::vector<MeasuredSetting> measured(const ErrorSeries& series);

/// All of them: some seconds on one core.
std::vector<ErrorSeries> error_series();

}  // namespace launchsafe::verify
