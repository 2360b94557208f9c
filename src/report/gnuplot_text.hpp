// Texts and numbers in gnuplot's words.
#pragma once

#include "launchsafe/report/plot.hpp"

namespace launchsafe::report {

/// A gnuplot string. All ASCII but letters, digits and a few harmless signs goes in as octal escapes, so that
/// no quote, backslash, backtick or line end is ever seen by gnuplot's scanner.
std::string quoted(const std::string& text);

/// Whether a value has a place on an axis of this scale.
bool drawable(double value, Scale scale);

/// A coordinate; NaN, which gnuplot leaves out, where it has no place.
std::string coordinate(double value, Scale scale);

/// What begins the commands of a picture of this size in pixels.
std::string page_commands(double width, double height);

/// Why a plot cannot be drawn; empty where it can.
std::string unfit(const Plot& plot);
std::string unfit(const CellPlot& plot);

/// Data and settings, and the parts of the plot command in the order in which they are drawn.
struct Commands {
  std::string settings;
  std::vector<std::string> plots;

  /// Lines of data under the name "$name".
  void add(const std::string& name, const std::string& lines, const std::string& how);
  std::string text() const;
};

}  // namespace launchsafe::report
