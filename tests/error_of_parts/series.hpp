// Error over a series of settings (a step, a tolerance, a mesh) of the parts that have exact solutions.
#pragma once

#include <functional>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

namespace launchsafe::error_of_parts {

/// One setting of a part, and the work that gives its error.
struct Setting {
  std::string text;              ///< for people: "step 10 us"
  double size = 0;               ///< > 0, what the order is in: step (s), cell (m) or relative tolerance
  std::function<double()> work;  ///< one unit of it; the error in the series' unit, of either sign
};

/// `ErrorSeries::order` of a method without error, and of one from which no order is to be expected.
inline constexpr double exact_order = std::numeric_limits<double>::infinity();
inline constexpr double no_order = std::numeric_limits<double>::quiet_NaN();

/// One quantity of one part over its settings, coarsest first; its errors are not yet computed.
struct ErrorSeries {
  std::string part;        ///< "skin equation"
  std::string quantity;    ///< what the error is of: "induction time"
  std::string work;        ///< what the processor time is of
  std::string reference;   ///< the exact solution, or what stands for it
  std::string error_unit;  ///< empty: relative
  std::string theory;      ///< why the order is what it is
  double order = 0;        ///< of the error in the size, by theory
  double round_off = 0;    ///< errors up to this, in `error_unit`, are of round-off
  std::vector<Setting> settings = {};
};

/// All of them: some seconds on one core.
std::vector<ErrorSeries> error_series();
std::vector<ErrorSeries> skin_series();
std::vector<ErrorSeries> solid_series();
std::vector<ErrorSeries> mechanics_series();  ///< conduction, waves, shape functions

/// ln(error ratio)/ln(size ratio) of two settings' sizes and errors (>= 0); NaN where the finer error is of
/// round-off, which does not depend on the method.
double order_between(double coarse_size, double coarse_error, double fine_size, double fine_error,
                     double round_off);

/// A duration (s) divided into so many steps.
Setting with_steps(double duration, int steps, std::function<double()> work);
/// A mesh of cells of this size (m).
Setting with_cell(double cell, std::function<double()> work);
/// A setting for every value.
template <class Value, class Make>
std::vector<Setting> settings_for(std::initializer_list<Value> values, const Make& make) {
  std::vector<Setting> settings;
  for (const Value value : values) settings.push_back(make(value));
  return settings;
}

}  // namespace launchsafe::error_of_parts
