#include "contour_bands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace launchsafe::report::detail {
namespace {

struct Corner {
  PlanePoint at;
  double z;
};

/// A cell with the values at its corners: lower left, lower right, upper left, upper right.
struct GridCell {
  double x0, x1, y0, y1;
  std::array<double, 4> z;

  /// Bilinear in the shares u and v; along an edge of the ends of that edge alone, so that neighbours agree.
  Corner at(double u, double v) const {
    const double below = (1.0 - u) * z[0] + u * z[1], above = (1.0 - u) * z[2] + u * z[3];
    return {{(1.0 - u) * x0 + u * x1, (1.0 - v) * y0 + v * y1}, (1.0 - v) * below + v * above};
  }
};

class Builder {
 public:
  Builder(const std::vector<double>& levels, int quarterings) : levels_(levels), quarterings_(quarterings) {
    bands_.filled.resize(levels.empty() ? 0 : levels.size() - 1);
    bands_.lines.resize(levels.size());
  }

  /// The part of a cell from share u, v on, `size` of it long.
  void add(const GridCell& cell, double u, double v, double size, int depth) {
    const Corner a = cell.at(u, v), b = cell.at(u + size, v), c = cell.at(u, v + size),
                 d = cell.at(u + size, v + size);
    const auto [low, high] = std::minmax({a.z, b.z, c.z, d.z});
    const std::size_t band = band_of(low);
    // Bilinear: all of it lies between its corners. One that reaches the next level exactly has a line there.
    if (high < levels_[band + 1] || band + 2 == levels_.size()) {
      bands_.filled[band].push_back({a.at, b.at, d.at, c.at});
    } else if (depth < quarterings_) {
      const double half = 0.5 * size;
      for (const double dv : {0.0, half})
        for (const double du : {0.0, half}) add(cell, u + du, v + dv, half, depth + 1);
    } else {
      add({a, b, d, c});
    }
  }

  Bands result() { return std::move(bands_); }

 private:
  /// The band that holds a value; the nearest one for a value outside.
  std::size_t band_of(double z) const {
    const auto above = std::upper_bound(levels_.begin(), levels_.end(), z);
    const auto index = std::max<std::ptrdiff_t>(above - levels_.begin() - 1, 0);
    return std::min(static_cast<std::size_t>(index), levels_.size() - 2);
  }

  /// A quarter so small that its edges say enough: four corners in order.
  void add(const std::vector<Corner>& corners) {
    const auto lower = [](const Corner& one, const Corner& other) { return one.z < other.z; };
    const auto [low, high] = std::minmax_element(corners.begin(), corners.end(), lower);
    for (std::size_t band = band_of(low->z); band + 1 < levels_.size() && levels_[band] <= high->z; ++band) {
      Polygon polygon = between(corners, levels_[band], levels_[band + 1]);
      if (polygon.size() > 2) bands_.filled[band].push_back(std::move(polygon));
    }
    for (std::size_t level = 0; level < levels_.size(); ++level) add_line(corners, level);
  }

  /// Two crossings of the edges make a segment; four, at a saddle, make two.
  void add_line(const std::vector<Corner>& corners, std::size_t level) {
    std::vector<PlanePoint> crossings;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Corner &from = corners[i], &to = corners[(i + 1) % corners.size()];
      if ((from.z < levels_[level]) != (to.z < levels_[level]))
        crossings.push_back(crossing(from, to, levels_[level]).at);
    }
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      if (crossings[i] != crossings[i + 1]) bands_.lines[level].push_back({crossings[i], crossings[i + 1]});
    }
  }

  /// The same point whichever way the edge is walked.
  static Corner crossing(const Corner& one, const Corner& other, double level) {
    const bool ordered = one.z < other.z;
    const Corner &low = ordered ? one : other, &high = ordered ? other : one;
    const double share = (level - low.z) / (high.z - low.z);
    return {{low.at.x + share * (high.at.x - low.at.x), low.at.y + share * (high.at.y - low.at.y)}, level};
  }

  /// The corners on one side of a level, and where the edges cross it.
  static std::vector<Corner> clipped(const std::vector<Corner>& corners, double level, bool keep_above) {
    std::vector<Corner> result;
    const auto inside = [&](const Corner& corner) {
      return keep_above ? corner.z >= level : corner.z <= level;
    };
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Corner &from = corners[i], &to = corners[(i + 1) % corners.size()];
      if (inside(from)) result.push_back(from);
      if (inside(from) != inside(to)) result.push_back(crossing(from, to, level));
    }
    return result;
  }

  static Polygon between(const std::vector<Corner>& corners, double low, double high) {
    Polygon polygon;
    for (const Corner& corner : clipped(clipped(corners, low, true), high, false))
      polygon.push_back(corner.at);
    return polygon;
  }

  const std::vector<double>& levels_;
  int quarterings_;
  Bands bands_;
};

// --- labels ---

/// Distance between two places in units of a box of `width` x `height` pixels: below 1 the boxes touch.
double boxes_apart(const PlanePoint& a, const PlanePoint& b, const Frame& frame, double width,
                   double height) {
  const double dx = std::abs(a.x - b.x) / (frame.right - frame.left) * frame.width;
  const double dy = std::abs(a.y - b.y) / (frame.top - frame.bottom) * frame.height;
  return std::max(dx / width, dy / height);
}

/// Distance from the edges in units of the room that half a label needs.
double from_edges(const PlanePoint& at, const Frame& frame) {
  const double x = std::min(at.x - frame.left, frame.right - at.x) / (frame.right - frame.left);
  const double y = std::min(at.y - frame.bottom, frame.top - at.y) / (frame.top - frame.bottom);
  return std::min(x * frame.width / 32.0, y * frame.height / 14.0);
}

PlanePoint middle_of(const Segment& segment) {
  return {0.5 * (segment.from.x + segment.to.x), 0.5 * (segment.from.y + segment.to.y)};
}

/// At most so many of a level's segments are looked at, evenly taken.
constexpr std::size_t looked_at = 150;

std::vector<PlanePoint> middles_of(const std::vector<Segment>& line) {
  const std::size_t stride = 1 + line.size() / looked_at;
  std::vector<PlanePoint> middles;
  for (std::size_t i = 0; i < line.size(); i += stride) middles.push_back(middle_of(line[i]));
  return middles;
}

class LabelSearch {
 public:
  LabelSearch(const Bands& bands, const std::vector<PlanePoint>& marks, const Frame& frame)
      : marks_(marks), frame_(frame) {
    for (const auto& line : bands.lines) middles_.push_back(middles_of(line));
  }

  std::vector<LabelPlace> places() {
    for (std::size_t level = 0; level < middles_.size(); ++level) {
      if (const auto best = best_of(level)) placed_.push_back({level, *best});
    }
    return placed_;
  }

 private:
  /// How free a place is; 1 is just enough. More than twice that is no better.
  double room(const PlanePoint& at, std::size_t level) const {
    double room = std::min(2.0, from_edges(at, frame_));
    for (const PlanePoint& mark : marks_) room = std::min(room, boxes_apart(at, mark, frame_, 32, 15));
    for (const LabelPlace& label : placed_) room = std::min(room, boxes_apart(at, label.at, frame_, 60, 24));
    for (std::size_t other = 0; other < middles_.size(); ++other) {
      if (other == level) continue;
      for (const PlanePoint& point : middles_[other])
        room = std::min(room, 0.6 + boxes_apart(at, point, frame_, 26, 10));
    }
    return room;
  }

  std::optional<PlanePoint> best_of(std::size_t level) const {
    std::optional<PlanePoint> best;
    double most = 0.85;  // below that a label would cover something
    for (const PlanePoint& at : middles_[level]) {
      const double here = room(at, level);
      if (here <= most) continue;
      most = here;
      best = at;
    }
    return best;
  }

  const std::vector<PlanePoint>& marks_;
  Frame frame_;
  std::vector<std::vector<PlanePoint>> middles_;
  std::vector<LabelPlace> placed_;
};

}  // namespace

double to_plane(double value, Scale scale) { return scale == Scale::linear ? value : std::log10(value); }

double from_plane(double value, Scale scale) {
  return scale == Scale::linear ? value : std::pow(10.0, value);
}

Bands bands_of(const Contour& contour, int quarterings) {
  Builder builder(contour.levels, quarterings);
  const std::size_t width = contour.x_values.size(), height = contour.y_values.size();
  if (contour.levels.size() < 2) return builder.result();
  for (std::size_t j = 0; j + 1 < height; ++j) {
    for (std::size_t i = 0; i + 1 < width; ++i) {
      const double* lower = &contour.z[j * width + i];
      const double* upper = lower + width;
      const GridCell cell{to_plane(contour.x_values[i], contour.x.scale),
                          to_plane(contour.x_values[i + 1], contour.x.scale),
                          to_plane(contour.y_values[j], contour.y.scale),
                          to_plane(contour.y_values[j + 1], contour.y.scale),
                          {lower[0], lower[1], upper[0], upper[1]}};
      const bool whole = std::all_of(cell.z.begin(), cell.z.end(), [](double z) { return std::isfinite(z); });
      if (whole) builder.add(cell, 0.0, 0.0, 1.0, 0);
    }
  }
  return builder.result();
}

std::vector<LabelPlace> label_places(const Bands& bands, const std::vector<PlanePoint>& marks,
                                     const Frame& frame) {
  return LabelSearch(bands, marks, frame).places();
}

}  // namespace launchsafe::report::detail
