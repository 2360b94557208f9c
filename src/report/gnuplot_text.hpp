// What all pictures share: texts, numbers, ranges and axes in gnuplot's words, and calling it.
#pragma once

#include "launchsafe/report/drawing_limits.hpp"
#include "launchsafe/report/plot.hpp"

#include <cstddef>
#include <limits>
#include <string>
#include <string_view>

namespace launchsafe::report::detail {

/// A gnuplot string. All ASCII but letters, digits and a few harmless signs goes in as octal escapes, so that
/// no quote, backslash, backtick or line end is ever seen by gnuplot's scanner.
std::string quoted(const std::string& text);

/// Whether a value has a place on an axis of this scale.
bool drawable(double value, Scale scale);
/// A coordinate for gnuplot; NaN, a gap, where it has no place.
std::string coordinate(double value, Scale scale);

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  bool empty() const { return low > high; }
  bool contains(double value) const { return low <= value && value <= high; }
  void include(double value, Scale scale);
};
/// With air around the data, and a width also where all values are the same; an axis' own limits go first.
Range with_limits(Range range, const Axis& axis);

/// Okabe and Ito's colours in the order of `Series::colour`.
std::string_view palette_colour(std::size_t index);
/// gnuplot's number of a mark.
int point_type(Mark mark);

/// Terminal, border, grid and title of a picture.
std::string page_commands(int width, int height, const std::string& title);
/// Label, range, scale and tics of the axis "x" or "y".
std::string axis_commands(const std::string& name, const Axis& axis, const Range& range);

/// A legend of so many entries in one or two rows below the label of the x axis, and the room that it needs.
std::string legend_below(int height, std::size_t entries, double centre);

/// Runs gnuplot on commands. Errors: missing, failed; `title` is named in both.
store::Result<std::string> drawn(const std::string& program, const std::string& commands,
                                 const std::string& title, const DrawingLimits& limits);

}  // namespace launchsafe::report::detail
