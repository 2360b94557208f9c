// A quantity over a plane as bands of colour with labelled contour lines, drawn by gnuplot as SVG. Only where
// all four corners of a cell of the grid have a value is anything filled in between; everything else is
// white.
#pragma once

#include "launchsafe/report/plot.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace launchsafe::report {

/// Points that are marked over the map.
struct MarkedPoints {
  std::string label;  ///< in the legend
  Mark mark = Mark::circle;
  std::vector<double> x, y;
};

struct Contour {
  std::string title;
  Axis x, y;
  std::vector<double> x_values, y_values;  ///< of the grid, ascending
  std::vector<double> z;       ///< at every grid point, x the fastest; NaN where there is no value
  std::string z_label;         ///< of the colour bar, with its unit
  std::vector<double> levels;  ///< edges of the bands, ascending; see `contour_levels`
  std::vector<MarkedPoints> marks = {};
  int width = 860, height = 620;  ///< pixels
};

/// Round numbers, at most about ten bands, from below the lowest to above the highest finite value; empty
/// without one.
std::vector<double> contour_levels(const std::vector<double>& values);

/// The commands and data that `to_svg` gives to gnuplot.
std::string to_gnuplot(const Contour& contour);

/// The picture. Errors: missing (there is no such program), failed (values that do not fit the grid, nothing
/// to draw, gnuplot's own complaint).
store::Result<std::string> to_svg(const Contour& contour, const std::string& program = "gnuplot",
                                  const DrawingLimits& limits = {});

/// Draws into a file, whole or not at all. Errors: those of `to_svg`, and write_failed.
store::MaybeError write_svg(const Contour& contour, const std::filesystem::path& path,
                            const DrawingLimits& limits = {});

}  // namespace launchsafe::report
