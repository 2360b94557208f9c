// Plots, and fields over the section of a shell as filled cells, as values, drawn by gnuplot as SVG.
#pragma once

#include "launchsafe/store/file.hpp"

namespace launchsafe::report {

/// What ends gnuplot. A report is whole without its pictures: one that is not drawn is a remark.
using DrawingLimits = store::ProgramLimits;

enum class Scale { linear, logarithmic };

/// A place on an axis with a word of its own.
struct Tic {
  double at = 0;
  std::string label;
};

struct PlotAxis {
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
  vertical_bars,    ///< points with bars along y from `lower` to `upper`
  horizontal_bars,  ///< points with bars along x from `lower` to `upper`
  filled_bars       ///< likewise, filled, without points
};

enum class Mark {
  circle,
  square,
  up_triangle,
  diamond,
  down_triangle,
  open_circle,
  open_square,
  cross,
  none  ///< a bar alone
};

struct Series {
  std::string label = {};  ///< not in the legend when empty
  std::vector<double> x = {}, y = {};
  Style style = Style::line_and_points;
  std::vector<double> lower = {}, upper = {};  ///< ends of the bars; only for the styles of bars
  std::optional<int> colour = {};  ///< index into the palette of eight; the series' own number where absent
  std::optional<Mark> mark = {};   ///< goes with the colour where absent

  void add(double at, double value) {
    x.push_back(at);
    y.push_back(value);
  }
  /// A point with the ends of its bar.
  void add(double at, double value, double low, double high) {
    add(at, value);
    lower.push_back(low);
    upper.push_back(high);
  }
};

/// A dashed line across the whole picture.
struct Line {
  double at = 0;
  std::string label = {};
};

/// A grey band from edge to edge, behind all else.
struct Band {
  double from = 0, to = 0;
  std::string label = {};
};

struct Plot {
  std::string title;
  PlotAxis x, y;
  std::vector<Series> series = {};
  std::vector<Line> vertical_lines = {}, horizontal_lines = {};
  int width = 800, height = 560;  ///< pixels, with one line of a legend; further ones come on top
  std::string subtitle = {};      ///< small, below the title
  std::vector<Band> vertical_bands = {};
  /// Pictures below each other; of the plot itself only title and subtitle.
  std::vector<Plot> panels = {};
};

/// Ends the y axis beyond a line across: how hot a burning skin is says nothing of a gap, and how far a bar
/// goes nothing of the points. What is hotter stands in a row of its series above the line, where the axis
/// has no numbers, and a bar that goes on beyond has an arrow at its end.
void cut_axis(double line, Plot& plot);

/// A rectangle with a value; one without a value (NaN) is drawn in plain grey.
struct FieldCell {
  double x = 0, r = 0;            ///< mm, of its middle; r >= 0
  double half_x = 0, half_r = 0;  ///< mm
  double value = 0;
  std::size_t scale = 0;  ///< of its colour, see CellPlot::scales
};

/// What colours mean.
struct ColourScale {
  std::string label;  ///< of the colour bar, with its unit
  /// Equal ones are drawn as a range around the value. Cells above are orange, cells below pink.
  double minimum = 0, maximum = 0;
};

struct Place {
  double x = 0, r = 0;  ///< mm
};

/// The edge of a body, once around; where it lies on the axis it begins and ends there, and is left open.
struct Outline {
  std::vector<Place> path;
  bool open_at_axis = false;
};

/// The part of the section, on one side of the axis, that is all there is to see: it is drawn in the place of
/// the whole, stretched along x.
struct Window {
  double x_begin = 0, x_end = 0;  ///< mm
  double r_end = 0;               ///< mm, from the axis
};

/// The section is mirrored about the axis and drawn to scale, equally along x and r, but for a window.
struct CellPlot {
  std::string title;
  std::string subtitle = {};
  /// One or two, each with its bar: the first in colours, the second in greys. Both read in grey print.
  std::vector<ColourScale> scales;
  std::vector<FieldCell> cells;
  std::vector<Outline> outlines;
  std::optional<Window> window = {};
  std::string without_value = {};  ///< what grey cells are, for the subtitle
};

using Drawing = std::variant<Plot, CellPlot>;

/// The commands and data that `to_svg` gives to gnuplot.
std::string to_gnuplot(const Plot& plot);
std::string to_gnuplot(const CellPlot& plot);

/// The picture. Points that are not finite, or not positive on a logarithmic axis, are gaps. Errors: missing
/// (there is no such program), failed (nothing to draw, gnuplot's own complaint).
store::Result<std::string> to_svg(const Drawing& drawing, const DrawingLimits& limits = {},
                                  const std::string& program = "gnuplot");

// --- texts and numbers in gnuplot's words ---

/// A gnuplot string. All ASCII but letters, digits and a few harmless signs goes in as octal escapes, so that
/// no quote, backslash, backtick or line end is ever seen by gnuplot's scanner.
std::string quoted(const std::string& text);

/// Whether a value has a place on an axis of this scale.
bool drawable(double value, Scale scale);

/// A coordinate; NaN, which gnuplot leaves out, where it has no place.
std::string coordinate(double value, Scale scale);

/// What begins the commands of a picture of this size in pixels.
std::string page_commands(double width, double height);

/// Data and settings, and the parts of the plot command in the order in which they are drawn.
struct Commands {
  std::string settings;
  std::vector<std::string> plots;

  /// Lines of data under the name "$name".
  void add(const std::string& name, const std::string& lines, const std::string& how);
  std::string text() const;
};

}  // namespace launchsafe::report
