// How the series of error against processor time write their settings, and the series by topic.
#pragma once

#include "launchsafe/verify/error_against_time.hpp"

#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

namespace launchsafe::verify {

/// `ErrorSeries::order` of a method without error.
inline constexpr double exact_order = std::numeric_limits<double>::infinity();

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

std::vector<ErrorSeries> skin_series();
std::vector<ErrorSeries> solid_series();
std::vector<ErrorSeries> conduction_series();
std::vector<ErrorSeries> wave_series();
std::vector<ErrorSeries> flight_series();
std::vector<ErrorSeries> shape_series();

}  // namespace launchsafe::verify
