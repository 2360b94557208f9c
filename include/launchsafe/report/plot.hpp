// Plots as values, drawn by gnuplot as SVG.
#pragma once

#include "launchsafe/report/drawing_limits.hpp"
#include "launchsafe/store/result.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace launchsafe::report {

enum class Scale { linear, logarithmic };

/// A place on an axis with a word of its own.
struct Tic {
  double at = 0;
  std::string label;
};

struct Axis {
  std::string label;  ///< with its unit: "gap [cm]"
  Scale scale = Scale::linear;
  std::optional<double> minimum = {}, maximum = {};  ///< from the data where absent
  std::vector<Tic> tics = {};                        ///< made of the range where empty
};

enum class Style {
  line,
  dashed_line,
  points,
  line_and_points,
  error_bars,            ///< points with y - error to y + error
  intervals,             ///< points with bars along y from `lower` to `upper`
  horizontal_intervals,  ///< points with bars along x from `lower` to `upper`
  steps
};

enum class Mark {
  circle,
  square,
  up_triangle,
  diamond,
  down_triangle,
  open_circle,
  open_square,
  open_triangle,
  cross
};

struct Series {
  std::string label;  ///< not in the legend when empty
  std::vector<double> x, y;
  Style style = Style::line_and_points;
  std::vector<double> error = {};  ///< half length of the bars; only for Style::error_bars
  std::optional<int> colour = {};  ///< index into the palette of eight; the series' own number where absent
  std::optional<Mark> mark = {};   ///< goes with the colour where absent
  std::vector<double> lower = {}, upper = {};  ///< ends of the bars; only for the two styles of intervals
};

/// A dashed grey line across the whole picture.
struct Line {
  double at = 0;
  std::string label = {};
};

struct Annotation {
  double x = 0, y = 0;
  std::string text;
};

enum class Legend { top_left, top_right, bottom_left, bottom_right, right_of_plot, below_plot, none };

struct Plot {
  std::string title;
  Axis x, y;
  std::vector<Series> series;
  std::vector<Line> vertical_lines = {}, horizontal_lines = {};
  std::vector<Annotation> annotations = {};
  Legend legend = Legend::top_left;
  int width = 800, height = 520;  ///< pixels
};

/// The commands and data that `to_svg` gives to gnuplot.
std::string to_gnuplot(const Plot& plot);

/// The picture. Points that are not finite, or not positive on a logarithmic axis, are gaps. Errors: missing
/// (there is no such program), failed (a series whose x and y differ in length, nothing to draw, gnuplot's
/// own complaint).
store::Result<std::string> to_svg(const Plot& plot, const std::string& program = "gnuplot",
                                  const DrawingLimits& limits = {});

/// Draws into a file, whole or not at all. Errors: those of `to_svg`, and write_failed.
store::MaybeError write_svg(const Plot& plot, const std::filesystem::path& path,
                            const DrawingLimits& limits = {});

}  // namespace launchsafe::report
