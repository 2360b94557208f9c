// Names in the plot itself, where nothing else is drawn.
#pragma once

#include "launchsafe/report/plot.hpp"

namespace launchsafe::report {

/// What is named where it is drawn and not in the legend, and the labels that do so.
struct PlotNames {
  std::vector<bool> series;  ///< whether that one is
  std::string commands = {};
};

/// Lines at their right ends, few points and dashed lines beside them, lines across and bands at their edges:
/// where nothing else is drawn.
PlotNames names_in_place(const Plot& plot);

/// Index into the palette, and into the signs of points.
std::size_t look_of(const Series& series, std::size_t index);
std::string_view colour_of(const Series& series, std::size_t index);

/// Pixels of a letter, as gnuplot reckons.
constexpr double letter_width = 8.4;

/// Characters beside the plot, where lines are named at their ends.
std::size_t right_margin(std::size_t longest_name);
/// Letters of the longest name of a line.
std::size_t longest_end_name(const Plot& plot);

}  // namespace launchsafe::report
