// A field over the section of a shell as filled cells, drawn by gnuplot as SVG.
#pragma once

#include "launchsafe/report/plot.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace launchsafe::report {

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
  /// Equal ones are drawn as a range around the value. Cells beyond have the last
  /// colour, those by more than a tenth of the range a cross too.
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

/// A part of the section on one side of the axis, drawn again below the whole at a larger scale.
struct Enlargement {
  std::string label;              ///< what it shows: "at the bottom of the charge"
  double x_begin = 0, x_end = 0;  ///< mm
};

/// The section is mirrored about the axis and drawn to scale, equally along x and r; so is its enlargement.
struct CellPlot {
  std::string title;
  std::string subtitle = {};
  /// One or two, each with its bar: the first in colours, the second in greys. Both read in grey print.
  std::vector<ColourScale> scales;
  std::vector<FieldCell> cells;
  std::vector<Outline> outlines;
  std::optional<Enlargement> enlargement = {};
  std::string without_value = {};  ///< what grey cells are, for the subtitle
};

/// The commands and data that `to_svg` gives to gnuplot.
std::string to_gnuplot(const CellPlot& plot);

/// The picture. Errors: as those of a Plot (missing, failed).
store::Result<std::string> to_svg(const CellPlot& plot, const std::string& program = "gnuplot",
                                  const DrawingLimits& limits = {});

}  // namespace launchsafe::report
