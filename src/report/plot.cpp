#include "launchsafe/report/plot.hpp"

#include "gnuplot_text.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/store/atomic_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string_view>

namespace launchsafe::report {
namespace {

using detail::Range, detail::coordinate, detail::drawable, detail::quoted, detail::with_limits;

// --- ranges ---

struct Ranges {
  Range x, y;
};

bool has_intervals(const Series& series) {
  return series.style == Style::intervals || series.style == Style::horizontal_intervals;
}

struct Bar {
  double low, high;
};

/// Ends of the bar at a point; the point itself where there is none, or where an end has no place.
Bar bar_of(const Plot& plot, const Series& series, std::size_t point) {
  const bool along_x = series.style == Style::horizontal_intervals;
  const double middle = along_x ? series.x[point] : series.y[point];
  Bar bar{middle, middle};
  if (has_intervals(series) && point < series.lower.size() && point < series.upper.size())
    bar = {series.lower[point], series.upper[point]};
  if (series.style == Style::error_bars && point < series.error.size())
    bar = {middle - series.error[point], middle + series.error[point]};
  const Scale scale = along_x ? plot.x.scale : plot.y.scale;
  if (!drawable(bar.low, scale)) bar.low = middle;
  if (!drawable(bar.high, scale)) bar.high = middle;
  return bar;
}

/// Of all points that can be drawn; empty when there is none. Marker lines and annotations widen it.
Ranges data_ranges(const Plot& plot) {
  Ranges ranges;
  for (const Series& series : plot.series) {
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
      if (!drawable(series.x[i], plot.x.scale) || !drawable(series.y[i], plot.y.scale)) continue;
      ranges.x.include(series.x[i], plot.x.scale);
      ranges.y.include(series.y[i], plot.y.scale);
      const Bar bar = bar_of(plot, series, i);
      const bool along_x = series.style == Style::horizontal_intervals;
      for (const double end : {bar.low, bar.high}) {
        (along_x ? ranges.x : ranges.y).include(end, along_x ? plot.x.scale : plot.y.scale);
      }
    }
  }
  if (ranges.x.empty()) return ranges;
  for (const Line& line : plot.vertical_lines) ranges.x.include(line.at, plot.x.scale);
  for (const Line& line : plot.horizontal_lines) ranges.y.include(line.at, plot.y.scale);
  for (const Annotation& annotation : plot.annotations) {
    ranges.x.include(annotation.x, plot.x.scale);
    ranges.y.include(annotation.y, plot.y.scale);
  }
  return ranges;
}

// --- commands ---

std::size_t labelled(const Plot& plot) {
  return static_cast<std::size_t>(std::count_if(plot.series.begin(), plot.series.end(),
                                                [](const Series& series) { return !series.label.empty(); }));
}

std::string legend_commands(const Plot& plot) {
  const auto at = [](std::string_view place) {
    return fmt::format("set key {} Left reverse samplen 2.2 spacing 1.25 opaque\n", place);
  };
  switch (plot.legend) {
    case Legend::top_left:
      return at("inside top left");
    case Legend::top_right:
      return at("inside top right");
    case Legend::bottom_left:
      return at("inside bottom left");
    case Legend::bottom_right:
      return at("inside bottom right");
    case Legend::right_of_plot:
      return at("outside right top");
    case Legend::below_plot:
      return detail::legend_below(plot.height, labelled(plot), 0.5);
    case Legend::none:
      break;
  }
  return "unset key\n";
}

std::string line_commands(const Plot& plot, const Ranges& ranges) {
  constexpr std::string_view style = "nohead linewidth 1.2 dashtype 2 linecolor rgb '#555555'";
  constexpr std::string_view text_style = "front font ',12' textcolor rgb '#333333'";
  std::string text;
  for (const Line& line : plot.vertical_lines) {
    if (!ranges.x.contains(line.at)) continue;
    const std::string at = exact(line.at);
    text += fmt::format("set arrow from first {0}, graph 0 to first {0}, graph 1 {1}\n", at, style);
    text += fmt::format("set label {} at first {}, graph 0.03 rotate left offset character 0.9, 0 {}\n",
                        quoted(line.label), at, text_style);
  }
  for (const Line& line : plot.horizontal_lines) {
    if (!ranges.y.contains(line.at)) continue;
    const std::string at = exact(line.at);
    text += fmt::format("set arrow from graph 0, first {0} to graph 1, first {0} {1}\n", at, style);
    text += fmt::format("set label {} at graph 0.99, first {} right offset character 0, 0.55 {}\n",
                        quoted(line.label), at, text_style);
  }
  for (const Annotation& annotation : plot.annotations) {
    text += fmt::format("set label {} at first {}, first {} left offset character 0.8, 0.5 {}\n",
                        quoted(annotation.text), exact(annotation.x), exact(annotation.y), text_style);
  }
  return text;
}

/// x, y, and the ends of the bar of styles that have one.
std::string data_block(const Plot& plot, std::size_t index) {
  const Series& series = plot.series[index];
  const Scale bar_scale = series.style == Style::horizontal_intervals ? plot.x.scale : plot.y.scale;
  std::string text = fmt::format("$series{} << END_OF_DATA\n", index);
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
    const Bar bar = bar_of(plot, series, i);
    text += fmt::format("{} {} {} {}\n", coordinate(series.x[i], plot.x.scale),
                        coordinate(series.y[i], plot.y.scale), coordinate(bar.low, bar_scale),
                        coordinate(bar.high, bar_scale));
  }
  return text + "END_OF_DATA\n";
}

/// The sign of a series' points: its own, or one of eight that go with the colours.
Mark mark_of(const Series& series, std::size_t look) {
  return series.mark.value_or(static_cast<Mark>(look % 8));
}

std::string style_of(const Series& series, std::size_t index) {
  const std::size_t look = series.colour ? static_cast<std::size_t>(std::abs(*series.colour)) : index;
  const std::string colour = fmt::format("linecolor rgb '{}'", detail::palette_colour(look));
  const std::string points =
      fmt::format("pointtype {} pointsize 0.7", detail::point_type(mark_of(series, look)));
  switch (series.style) {
    case Style::line:
      return fmt::format("with lines linewidth 2 {}", colour);
    case Style::dashed_line:
      return fmt::format("with lines linewidth 2 dashtype 2 {}", colour);
    case Style::points:
      return fmt::format("with points {} {}", points, colour);
    case Style::error_bars:
    case Style::intervals:
      return fmt::format("with yerrorbars linewidth 1.5 {} {}", points, colour);
    case Style::horizontal_intervals:
      return fmt::format("with xerrorbars linewidth 1.5 {} {}", points, colour);
    case Style::steps:
      return fmt::format("with steps linewidth 2 {}", colour);
    case Style::line_and_points:
      break;
  }
  return fmt::format("with linespoints linewidth 2 {} {}", points, colour);
}

bool has_bars(const Series& series) { return series.style == Style::error_bars || has_intervals(series); }

bool has_points(const Series& series) { return !series.x.empty() && !series.y.empty(); }

std::string plot_command(const Plot& plot) {
  std::string text;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    if (!has_points(series)) continue;
    const std::string title = series.label.empty() ? "notitle" : "title " + quoted(series.label);
    text += fmt::format("{}$series{} using {} {} {}", text.empty() ? "plot " : ", \\\n     ", i,
                        has_bars(series) ? "1:2:3:4" : "1:2", style_of(series, i), title);
  }
  return text + "\n";
}

store::MaybeError unfit(const Plot& plot) {
  const auto failed = [&](const std::string& why) {
    return store::Error{store::Error::Kind::failed, fmt::format("cannot draw '{}': {}", plot.title, why)};
  };
  for (const Series& series : plot.series) {
    if (series.x.size() != series.y.size()) return failed("a series has as many x as y: " + series.label);
    if (series.style == Style::error_bars && series.error.size() != series.y.size()) {
      return failed("a series has an error for every point: " + series.label);
    }
    if (has_intervals(series) &&
        (series.lower.size() != series.y.size() || series.upper.size() != series.y.size())) {
      return failed("a series has an interval for every point: " + series.label);
    }
  }
  if (data_ranges(plot).x.empty()) return failed("it has no points");
  for (const Axis* axis : {&plot.x, &plot.y}) {
    const Range range = with_limits(axis == &plot.x ? data_ranges(plot).x : data_ranges(plot).y, *axis);
    if (!drawable(range.low, axis->scale) || !std::isfinite(range.high) || range.high <= range.low) {
      return failed("the limits of an axis leave nothing between them: " + axis->label);
    }
  }
  return {};
}

}  // namespace

std::string to_gnuplot(const Plot& plot) {
  const Ranges data = data_ranges(plot);
  const Ranges ranges{with_limits(data.x, plot.x), with_limits(data.y, plot.y)};
  std::string text = detail::page_commands(plot.width, plot.height, plot.title);
  text += legend_commands(plot);
  text += detail::axis_commands("x", plot.x, ranges.x);
  text += detail::axis_commands("y", plot.y, ranges.y);
  text += line_commands(plot, ranges);
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    if (has_points(plot.series[i])) text += data_block(plot, i);
  }
  return text + plot_command(plot);
}

store::Result<std::string> to_svg(const Plot& plot, const std::string& program, const DrawingLimits& limits) {
  if (const store::MaybeError error = unfit(plot)) return *error;
  return detail::drawn(program, to_gnuplot(plot), plot.title, limits);
}

store::MaybeError write_svg(const Plot& plot, const std::filesystem::path& path,
                            const DrawingLimits& limits) {
  const auto svg = to_svg(plot, "gnuplot", limits);
  if (!svg) return svg.error();
  return store::write_file_atomically(path, {*svg});
}

}  // namespace launchsafe::report
