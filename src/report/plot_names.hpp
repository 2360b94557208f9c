// Names of lines in the plot itself, and what makes lines on each other seen.
#pragma once

#include "launchsafe/report/plot.hpp"

namespace launchsafe::report {

/// Whether a series is named where it is, not in the legend.
bool named_at_end(const Plot& plot, const Series& series);

/// Index into the palette, and into the signs of points.
std::size_t look_of(const Series& series, std::size_t index);
std::string_view colour_of(const Series& series, std::size_t index);

/// Of a series: wider than lines that lie on it, so that its colour shows on both sides of theirs.
int line_width(const Plot& plot, std::size_t index);

/// Characters beside the plot, where lines are named at their ends.
std::size_t right_margin(std::size_t longest_name);
/// Letters of the longest name of a line.
std::size_t longest_end_name(const Plot& plot);
/// Labels of lines: at their right ends, and beside lines across where nothing is drawn. `width`: letters of
/// the names at the right.
std::string names_in_place(const Plot& plot, std::size_t width);

}  // namespace launchsafe::report
