// What the series of error against run time share, and the parts they are of.
#pragma once

#include "launchsafe/verify/error_against_time.hpp"

#include <functional>
#include <string>
#include <vector>

namespace launchsafe::verify::parts {

/// One setting, and the work that gives its error.
struct Setting {
  std::string text;
  double size = 0;
  std::function<double()> error;  ///< one unit of work; the error in the series' unit, of either sign
};

/// Computes and times every setting of a series.
std::vector<PartSetting> measured(const ErrorSeries& series, const std::vector<Setting>& settings);

/// Least processor time (s) that one call takes. Short work is repeated until a clock can see it.
double least_processor_time(const std::function<void()>& work);

/// The series with `compute` made of settings.
ErrorSeries with_settings(ErrorSeries series, std::function<std::vector<Setting>()> settings);

/// "10 us", "0.5 ms"; of a time in s.
std::string time_text(double time);

// One file each.
std::vector<ErrorSeries> skin_series();
std::vector<ErrorSeries> solid_series();
std::vector<ErrorSeries> mechanics_series();
std::vector<ErrorSeries> shape_series();

}  // namespace launchsafe::verify::parts
