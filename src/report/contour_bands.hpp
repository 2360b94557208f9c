// The geometry of a contour map: filled polygons between levels, contour lines, and places for their labels.
#pragma once

#include "launchsafe/report/contour.hpp"

#include <cstddef>
#include <vector>

namespace launchsafe::report::detail {

/// In coordinates in which the axes are linear (the logarithm of a logarithmic one).
struct PlanePoint {
  double x, y;
  bool operator==(const PlanePoint&) const = default;
};
using Polygon = std::vector<PlanePoint>;
struct Segment {
  PlanePoint from, to;
};

struct Bands {
  std::vector<std::vector<Polygon>> filled;  ///< of every band: between levels k and k + 1
  std::vector<std::vector<Segment>> lines;   ///< of every level
};

/// Values are bilinear between the corners of a cell, in the coordinates of the picture; so nothing
/// overshoots the computed values. Cells with a corner without a value stay empty. A cell is quartered up to
/// so often where a level runs through it.
Bands bands_of(const Contour& contour, int quarterings);

/// Coordinates in which an axis is linear, and back.
double to_plane(double value, Scale scale);
double from_plane(double value, Scale scale);

/// Where labels go: the plotted area in plane coordinates, and its size in pixels.
struct Frame {
  double left, right, bottom, top;
  double width, height;  ///< pixels
};

/// A place for the label of every level that has room for one: on its line, away from marks, other labels and
/// the edges.
struct LabelPlace {
  std::size_t level;
  PlanePoint at;
};
std::vector<LabelPlace> label_places(const Bands& bands, const std::vector<PlanePoint>& marks,
                                     const Frame& frame);

}  // namespace launchsafe::report::detail
