#include "launchsafe/report/plot.hpp"

#include "gnuplot_text.hpp"
#include "launchsafe/report/number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace launchsafe::report {
namespace {

// --- series ---

bool has_bars(const Series& series) {
  return series.style == Style::vertical_bars || series.style == Style::horizontal_bars;
}

/// x, y, and the ends of the bar of styles that have one: the point itself where an end has no place.
std::string series_data(const Plot& plot, const Series& series) {
  const bool along_x = series.style == Style::horizontal_bars;
  const Scale bar_scale = along_x ? plot.x.scale : plot.y.scale;
  std::string lines;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    lines += coordinate(series.x[i], plot.x.scale) + " " + coordinate(series.y[i], plot.y.scale);
    if (has_bars(series)) {
      const double middle = along_x ? series.x[i] : series.y[i];
      for (const double end : {series.lower[i], series.upper[i]})
        lines += " " + coordinate(drawable(end, bar_scale) ? end : middle, bar_scale);
    }
    lines += "\n";
  }
  return lines;
}

std::string title_of(const std::string& label) {
  return label.empty() ? "notitle" : "title " + quoted(label);
}

std::string points_of(Mark mark) {
  // In the order of Mark: gnuplot's filled signs, open signs, and the cross.
  constexpr std::array<int, 9> types{7, 5, 9, 13, 11, 6, 4, 8, 2};
  // Open signs are larger, so that they show around filled ones at the same place.
  const double size = mark < Mark::open_circle ? 0.7 : 1.1;
  return fmt::format("pointtype {} pointsize {}", types[static_cast<std::size_t>(mark)], size);
}

std::string style_of(const Series& series, std::size_t index) {
  // Okabe and Ito's colours, told apart by the colour-blind too; grey for the yellow that white paper
  // swallows.
  constexpr std::array<std::string_view, 8> palette{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                    "#e69f00", "#56b4e9", "#000000", "#7f7f7f"};
  const std::size_t look = series.colour ? static_cast<std::size_t>(*series.colour) : index;
  const std::string colour = fmt::format("linecolor rgb '{}'", palette[look % palette.size()]);
  const std::string points = points_of(series.mark.value_or(static_cast<Mark>(look % 8)));
  switch (series.style) {
    case Style::line:
      return "with lines linewidth 2 " + colour;
    case Style::dashed_line:
      return "with lines linewidth 2 dashtype 2 " + colour;
    case Style::points:
      return fmt::format("with points linewidth 1.5 {} {}", points, colour);
    case Style::vertical_bars:
      return fmt::format("with yerrorbars linewidth 1.5 {} {}", points, colour);
    case Style::horizontal_bars:
      return fmt::format("with xerrorbars linewidth 1.5 {} {}", points, colour);
    case Style::steps:
      return "with steps linewidth 2 " + colour;
    case Style::line_and_points:
      break;
  }
  return fmt::format("with linespoints linewidth 2 {} {}", points, colour);
}

// --- commands ---

void add_series(const Plot& plot, Commands& commands) {
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    if (series.x.empty()) continue;
    commands.add(fmt::format("series{}", i), series_data(plot, series),
                 fmt::format("{} {} {}", has_bars(series) ? "1:2:3:4" : "1:2", style_of(series, i),
                             title_of(series.label)));
  }
}

void add_bands(const Plot& plot, Commands& commands) {
  for (std::size_t i = 0; i < plot.vertical_bands.size(); ++i) {
    const Band& band = plot.vertical_bands[i];
    const std::string from = coordinate(band.from, plot.x.scale), to = coordinate(band.to, plot.x.scale);
    commands.add(fmt::format("band{}", i), fmt::format("{0} 0\n{0} 1\n{1} 1\n{1} 0\n", from, to),
                 fmt::format("1:2 axes x1y2 with filledcurves closed fillcolor rgb '#e4e4e4' {}",
                             title_of(band.label)));
  }
}

/// Lines from edge to edge: along the second axes, which go from 0 to 1.
void add_lines(const Plot& plot, Commands& commands) {
  constexpr std::string_view style = "with lines linewidth 1.3 linecolor rgb '#444444'";
  for (std::size_t i = 0; i < plot.vertical_lines.size(); ++i) {
    const Line& line = plot.vertical_lines[i];
    const std::string at = coordinate(line.at, plot.x.scale);
    commands.add(fmt::format("vertical{}", i), fmt::format("{0} 0\n{0} 1\n", at),
                 fmt::format("1:2 axes x1y2 {} dashtype 2 {}", style, title_of(line.label)));
  }
  for (std::size_t i = 0; i < plot.horizontal_lines.size(); ++i) {
    const Line& line = plot.horizontal_lines[i];
    const std::string at = coordinate(line.at, plot.y.scale);
    commands.add(fmt::format("horizontal{}", i), fmt::format("0 {0}\n1 {0}\n", at),
                 fmt::format("1:2 axes x2y1 {} dashtype 4 {}", style, title_of(line.label)));
  }
}

/// Where the legend covers nothing: below the label of the x axis, or to the right where its entries are so
/// long that two columns have no room below.
std::string legend_command(const Plot& plot) {
  constexpr double letter = 8.4, sample = 60;  // pixels, as gnuplot reckons
  std::size_t longest = 0;
  const auto add = [&](const std::string& label) { longest = std::max(longest, display_width(label)); };
  for (const Series& series : plot.series) add(series.label);
  for (const Band& band : plot.vertical_bands) add(band.label);
  for (const Line& line : plot.vertical_lines) add(line.label);
  for (const Line& line : plot.horizontal_lines) add(line.label);
  const bool two_columns = 2.0 * (sample + letter * static_cast<double>(longest)) < 0.85 * plot.width;
  return fmt::format("set key outside {} Left reverse samplen 2 spacing 1.25\n",
                     two_columns ? "bottom center horizontal height 1.5" : "right top vertical");
}

std::string subtitle_command(const Plot& plot) {
  if (plot.subtitle.empty()) return {};
  return fmt::format(
      "set tmargin 4.6\nset label 1 {} at graph 0.5, graph 1 center offset 0, 0.9 font ',12' textcolor rgb "
      "'#444444'\n",
      quoted(plot.subtitle));
}

std::string frame_commands(const Plot& plot) {
  return fmt::format(
             "set border 3 linewidth 1 linecolor rgb '#444444'\n"
             "set tics nomirror out scale 0.6 textcolor rgb '#222222'\n"
             "set grid linewidth 0.7 dashtype 1 linecolor rgb '#dddddd'\n"
             "set autoscale fix\nset offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05\n"
             "set x2range [0:1]\nset y2range [0:1]\n"
             "set title {} font ',16'{}\n",
             quoted(plot.title), plot.subtitle.empty() ? "" : " offset 0, 0.4") +
         subtitle_command(plot) + legend_command(plot);
}

/// Label, limits, scale and tics of the axis "x" or "y".
std::string axis_commands(const std::string& name, const PlotAxis& axis) {
  std::string text = fmt::format("set {}label {}\n", name, quoted(axis.label));
  if (axis.minimum) text += fmt::format("set {}range [{}:]\n", name, exact(*axis.minimum));
  if (axis.maximum) text += fmt::format("set {}range [:{}]\n", name, exact(*axis.maximum));
  if (axis.scale == Scale::logarithmic) text += fmt::format("set logscale {0}\nset format {0} '%g'\n", name);
  std::string tics;
  for (const Tic& tic : axis.tics) {
    if (!drawable(tic.at, axis.scale)) continue;
    tics += fmt::format("{}{} {}", tics.empty() ? "" : ", ", quoted(tic.label), exact(tic.at));
  }
  return tics.empty() ? text : text + fmt::format("unset m{0}tics\nset {0}tics ({1})\n", name, tics);
}

/// Why a plot cannot be drawn; empty where it can.
std::string unfit(const Plot& plot) {
  for (const Plot& panel : plot.panels)
    if (std::string why = unfit(panel); !why.empty()) return panel.title + ": " + why;
  if (!plot.panels.empty()) return {};
  for (const PlotAxis* axis : {&plot.x, &plot.y}) {
    const bool fits = drawable(axis->minimum.value_or(1.0), axis->scale) &&
                      drawable(axis->maximum.value_or(1.0), axis->scale);
    if (!fits) return "a limit has no place on its axis: " + axis->label;
  }
  for (const Series& series : plot.series) {
    const std::size_t points = series.x.size();
    if (series.y.size() != points) return "a series has as many x as y: " + series.label;
    if (has_bars(series) && (series.lower.size() != points || series.upper.size() != points))
      return "a series has a bar for every point: " + series.label;
  }
  const bool has_points = std::any_of(plot.series.begin(), plot.series.end(),
                                      [](const Series& series) { return !series.x.empty(); });
  return has_points ? "" : "it has no points";
}

std::string drawing_commands(const Plot& plot) {
  std::string text = frame_commands(plot);
  Commands commands;
  text += axis_commands("x", plot.x) + axis_commands("y", plot.y);
  add_bands(plot, commands);
  add_series(plot, commands);
  add_lines(plot, commands);
  return text + commands.settings + fmt::format("plot {}\n", fmt::join(commands.plots, ", \\\n     "));
}

/// Two panels a row, each in a place as large as the largest of them.
std::string panel_commands(const Plot& plot) {
  constexpr int columns = 2, title_height = 40;
  const int rows = (static_cast<int>(plot.panels.size()) + columns - 1) / columns;
  int width = 0, height = 0;
  for (const Plot& panel : plot.panels) {
    width = std::max(width, panel.width);
    height = std::max(height, panel.height);
  }
  std::string text =
      page_commands(columns * width, rows * height + title_height) +
      fmt::format("set multiplot layout {},{} title {} font ',18'\n", rows, columns, quoted(plot.title));
  for (const Plot& panel : plot.panels) text += "reset\n" + drawing_commands(panel);
  return text + "unset multiplot\n";
}

}  // namespace

std::string to_gnuplot(const Plot& plot) {
  if (!plot.panels.empty()) return panel_commands(plot);
  return page_commands(plot.width, plot.height) + drawing_commands(plot);
}

store::Result<std::string> to_svg(const Plot& plot, const std::string& program, const DrawingLimits& limits) {
  return drawn(plot, unfit(plot), program, limits);
}

}  // namespace launchsafe::report
