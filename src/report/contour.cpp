#include "launchsafe/report/contour.hpp"

#include "contour_bands.hpp"
#include "gnuplot_text.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/store/atomic_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace launchsafe::report {
namespace {

using detail::Bands, detail::PlanePoint, detail::Range, detail::quoted;

/// Viridis without its darkest part, so that black lines and marks show everywhere: red, green, blue from 0
/// to 255.
constexpr std::array<std::array<double, 3>, 6> colours{
    {{72, 92, 158}, {49, 126, 161}, {42, 160, 148}, {92, 192, 110}, {168, 219, 68}, {246, 230, 60}}};

/// Where the plotted area lies in the picture, as shares of it.
constexpr double left_edge = 0.11, right_edge = 0.83, bottom_edge = 0.2, top_edge = 0.91;

/// Mean distance between neighbouring points of the grid, pixels, in the direction in which they are denser.
double cell_pixels(const Contour& contour) {
  const auto cells = [](const std::vector<double>& values) {
    return static_cast<double>(std::max<std::size_t>(values.size(), 2) - 1);
  };
  return std::min((right_edge - left_edge) * contour.width / cells(contour.x_values),
                  (top_edge - bottom_edge) * contour.height / cells(contour.y_values));
}

/// So that the smallest parts are a few pixels wide.
int quarterings_of(const Contour& contour) {
  return std::clamp(static_cast<int>(std::floor(std::log2(cell_pixels(contour) / 6.0))), 0, 3);
}

std::string colour_of(std::size_t band, std::size_t bands) {
  const double position =
      bands < 2 ? 2.5 : static_cast<double>((colours.size() - 1) * band) / static_cast<double>(bands - 1);
  const auto below = std::min(static_cast<std::size_t>(position), colours.size() - 2);
  const double share = position - static_cast<double>(below);
  std::string text = "#";
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = (1.0 - share) * colours[below][i] + share * colours[below + 1][i];
    text += fmt::format("{:02x}", static_cast<int>(std::lround(part)));
  }
  return text;
}

std::string point_text(const PlanePoint& point, const Contour& contour) {
  return fmt::format("{:.9g} {:.9g}\n", detail::from_plane(point.x, contour.x.scale),
                     detail::from_plane(point.y, contour.y.scale));
}

std::string block(const std::string& name, const std::string& lines) {
  return fmt::format("${} << END_OF_DATA\n{}END_OF_DATA\n", name, lines);
}

/// Coloured bands, their colour bar, and contour lines.
struct Elements {
  std::string data;                ///< blocks
  std::vector<std::string> plots;  ///< parts of the plot command
};

void add_bands(const Contour& contour, const Bands& bands, Elements& elements) {
  for (std::size_t band = 0; band < bands.filled.size(); ++band) {
    if (bands.filled[band].empty()) continue;
    std::string lines;
    for (const detail::Polygon& polygon : bands.filled[band]) {
      for (const PlanePoint& point : polygon) lines += point_text(point, contour);
      lines += point_text(polygon.front(), contour) + "\n";
    }
    elements.data += block(fmt::format("band{}", band), lines);
    // The border closes the seams between polygons.
    elements.plots.push_back(
        fmt::format("$band{0} using 1:2 with filledcurves closed fillcolor rgb '{1}' fillstyle solid 1.0 "
                    "border linecolor rgb '{1}' linewidth 0.5 notitle",
                    band, colour_of(band, bands.filled.size())));
  }
}

void add_lines(const Contour& contour, const Bands& bands, Elements& elements) {
  std::string lines;
  for (const auto& level : bands.lines) {
    for (const detail::Segment& segment : level)
      lines += point_text(segment.from, contour) + point_text(segment.to, contour) + "\n";
  }
  if (lines.empty()) return;
  elements.data += block("lines", lines);
  elements.plots.emplace_back("$lines using 1:2 with lines linewidth 1.2 linecolor rgb '#303030' notitle");
}

/// A line of one point: it draws nothing, but brings the colour bar.
void add_colour_bar(const Contour& contour, Elements& elements) {
  elements.data += block("bar", fmt::format("{} {} {}\n", exact(contour.x_values.front()),
                                            exact(contour.y_values.front()), exact(contour.levels.front())));
  elements.plots.emplace_back("$bar using 1:2:3 with lines linecolor palette notitle");
}

/// Filled signs, black with a white rim, so that they stand out from every colour; smaller on a dense grid.
void add_marks(const Contour& contour, Elements& elements) {
  const double scale = std::clamp(cell_pixels(contour) / 45.0, 0.25, 1.0);
  for (std::size_t i = 0; i < contour.marks.size(); ++i) {
    const MarkedPoints& marks = contour.marks[i];
    std::string lines;
    for (std::size_t k = 0; k < std::min(marks.x.size(), marks.y.size()); ++k) {
      lines += fmt::format("{} {}\n", detail::coordinate(marks.x[k], contour.x.scale),
                           detail::coordinate(marks.y[k], contour.y.scale));
    }
    if (lines.empty()) continue;
    elements.data += block(fmt::format("marks{}", i), lines);
    const int type = detail::point_type(marks.mark);
    const double size = scale * (marks.mark == Mark::circle ? 0.6 : 1.0);
    if (marks.mark != Mark::cross) {
      elements.plots.push_back(
          fmt::format("$marks{} using 1:2 with points pointtype {} pointsize {} linecolor rgb '#ffffff' "
                      "notitle",
                      i, type, size + 0.4 * scale));
    }
    elements.plots.push_back(fmt::format(
        "$marks{} using 1:2 with points pointtype {} pointsize {} linewidth 1.5 linecolor rgb '#111111' "
        "title {}",
        i, type, size, quoted(marks.label)));
  }
}

Range range_of(const std::vector<double>& values, const Axis& axis) {
  Range range;
  for (const double value : values) range.include(value, axis.scale);
  return detail::with_limits(range, axis);
}

/// The marks that a label must not cover: on a dense grid it cannot help it.
std::vector<PlanePoint> marks_to_spare(const Contour& contour) {
  std::vector<PlanePoint> places;
  if (cell_pixels(contour) < 30.0) return places;
  for (const MarkedPoints& marks : contour.marks) {
    for (std::size_t i = 0; i < std::min(marks.x.size(), marks.y.size()); ++i)
      places.push_back(
          {detail::to_plane(marks.x[i], contour.x.scale), detail::to_plane(marks.y[i], contour.y.scale)});
  }
  return places;
}

detail::Frame frame_of(const Contour& contour) {
  const Range x = range_of(contour.x_values, contour.x), y = range_of(contour.y_values, contour.y);
  return {detail::to_plane(x.low, contour.x.scale), detail::to_plane(x.high, contour.x.scale),
          detail::to_plane(y.low, contour.y.scale), detail::to_plane(y.high, contour.y.scale),
          (right_edge - left_edge) * contour.width, (top_edge - bottom_edge) * contour.height};
}

std::string level_text(double level) { return significant(level, 6); }

std::string label_commands(const Contour& contour, const Bands& bands) {
  std::string text = "set style textbox opaque margins 0.8, 0.6 fillcolor rgb '#ffffff' noborder\n";
  for (const auto& [level, at] : detail::label_places(bands, marks_to_spare(contour), frame_of(contour))) {
    text += fmt::format(
        "set label {} at first {:.9g}, first {:.9g} center front boxed font ',12' textcolor rgb '#111111'\n",
        quoted(level_text(contour.levels[level])), detail::from_plane(at.x, contour.x.scale),
        detail::from_plane(at.y, contour.y.scale));
  }
  return text;
}

/// Whether a cell beside a grid point is filled.
bool has_filled_cell(const Contour& contour, std::size_t i, std::size_t j) {
  const std::size_t width = contour.x_values.size(), height = contour.y_values.size();
  const auto known = [&](std::size_t x, std::size_t y) { return std::isfinite(contour.z[y * width + x]); };
  for (std::size_t y = j > 0 ? j - 1 : 0; y <= j && y + 1 < height; ++y) {
    for (std::size_t x = i > 0 ? i - 1 : 0; x <= i && x + 1 < width; ++x) {
      if (known(x, y) && known(x + 1, y) && known(x, y + 1) && known(x + 1, y + 1)) return true;
    }
  }
  return false;
}

/// A value that no colour shows stands beside its point.
std::string value_commands(const Contour& contour) {
  std::string text;
  for (std::size_t k = 0; k < contour.z.size(); ++k) {
    const std::size_t i = k % contour.x_values.size(), j = k / contour.x_values.size();
    if (!std::isfinite(contour.z[k]) || has_filled_cell(contour, i, j)) continue;
    text += fmt::format(
        "set label {} at first {}, first {} left front offset character 0.8, 0.5 font ',12' textcolor rgb "
        "'#111111'\n",
        quoted(significant(contour.z[k], 3)), exact(contour.x_values[i]), exact(contour.y_values[j]));
  }
  return text;
}

/// A palette of steps, one for each band, and a bar with a tic at every level.
std::string colour_bar_commands(const Contour& contour) {
  const std::size_t bands = contour.levels.size() - 1;
  std::string steps, tics;
  for (std::size_t band = 0; band < bands; ++band) {
    const std::string colour = colour_of(band, bands);
    steps += fmt::format("{}{} '{}', {} '{}'", band == 0 ? "" : ", ", band, colour, band + 1, colour);
  }
  for (const double level : contour.levels)
    tics += fmt::format("{}{} {}", tics.empty() ? "" : ", ", quoted(level_text(level)), exact(level));
  return fmt::format(
      "set palette defined ({})\nset cbrange [{}:{}]\nset cblabel {} offset character 1.2, 0\n"
      "set cbtics ({})\nset colorbox user origin screen {}, {} size screen 0.028, {}\n",
      steps, exact(contour.levels.front()), exact(contour.levels.back()), quoted(contour.z_label), tics,
      right_edge + 0.02, bottom_edge, top_edge - bottom_edge);
}

store::MaybeError unfit(const Contour& contour) {
  const auto failed = [&](const std::string& why) {
    return store::Error{store::Error::Kind::failed, fmt::format("cannot draw '{}': {}", contour.title, why)};
  };
  if (contour.x_values.empty() || contour.y_values.empty()) return failed("it has no points");
  if (contour.z.size() != contour.x_values.size() * contour.y_values.size())
    return failed("a map has a value, or NaN, for every point of its grid");
  const auto fits = [](const std::vector<double>& values, Scale scale) {
    return std::is_sorted(values.begin(), values.end()) &&
           std::all_of(values.begin(), values.end(),
                       [scale](double value) { return detail::drawable(value, scale); });
  };
  if (!fits(contour.x_values, contour.x.scale) || !fits(contour.y_values, contour.y.scale))
    return failed("the values of an axis are ascending, finite, and positive on a logarithmic axis");
  return {};
}

}  // namespace

std::vector<double> contour_levels(const std::vector<double>& values) {
  Range range;
  for (const double value : values) range.include(value, Scale::linear);
  if (range.empty()) return {};
  const double width = std::max(range.high - range.low, 1e-6 * std::max(std::abs(range.high), 1e-12));
  constexpr double most_bands = 10.0;
  double step = std::pow(10.0, std::floor(std::log10(width / most_bands)));
  for (const double factor : {1.0, 2.0, 2.5, 5.0, 10.0}) {
    if (factor * step * most_bands < width * (1.0 - 1e-9)) continue;
    step *= factor;
    break;
  }
  // A value at the very edge of a level belongs to the band beside it, rather than opening one of its own.
  const auto first = static_cast<long long>(std::floor(range.low / step + 1e-9));
  const auto last = std::max(static_cast<long long>(std::ceil(range.high / step - 1e-9)), first + 1);
  std::vector<double> levels;
  for (long long i = first; i <= last; ++i) levels.push_back(static_cast<double>(i) * step);
  return levels;
}

std::string to_gnuplot(const Contour& contour) {
  const bool coloured = contour.levels.size() >= 2;
  std::string text = detail::page_commands(contour.width, contour.height, contour.title);
  text += fmt::format(
      "unset grid\nset lmargin at screen {}\nset rmargin at screen {}\nset tmargin at screen {}\n", left_edge,
      right_edge, top_edge);
  text += detail::legend_below(contour.height, contour.marks.size(), 0.5 * (left_edge + right_edge));
  text += fmt::format("set bmargin at screen {}\n", bottom_edge);
  text += detail::axis_commands("x", contour.x, range_of(contour.x_values, contour.x));
  text += detail::axis_commands("y", contour.y, range_of(contour.y_values, contour.y));
  Elements elements;
  if (coloured) {
    const Bands bands = detail::bands_of(contour, quarterings_of(contour));
    text += colour_bar_commands(contour) + label_commands(contour, bands) + value_commands(contour);
    add_bands(contour, bands, elements);
    add_lines(contour, bands, elements);
    add_colour_bar(contour, elements);
  }
  add_marks(contour, elements);
  return text + elements.data + fmt::format("plot {}\n", fmt::join(elements.plots, ", \\\n     "));
}

store::Result<std::string> to_svg(const Contour& contour, const std::string& program,
                                  const DrawingLimits& limits) {
  if (const store::MaybeError error = unfit(contour)) return *error;
  return detail::drawn(program, to_gnuplot(contour), contour.title, limits);
}

store::MaybeError write_svg(const Contour& contour, const std::filesystem::path& path,
                            const DrawingLimits& limits) {
  const auto svg = to_svg(contour, "gnuplot", limits);
  if (!svg) return svg.error();
  return store::write_file_atomically(path, {*svg});
}

}  // namespace launchsafe::report
