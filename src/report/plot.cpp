#include "launchsafe/report/plot.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/store/atomic_file.hpp"
#include "program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <string_view>

namespace launchsafe::report {
namespace {

/// Okabe and Ito's colours, told apart by the colour-blind too; grey for the yellow that white paper
/// swallows.
constexpr std::array<std::string_view, 8> palette{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                  "#e69f00", "#56b4e9", "#000000", "#7f7f7f"};
/// gnuplot's filled circle, square, triangle, diamond, triangle down; open circle, square, triangle.
constexpr std::array<int, 8> point_types{7, 5, 9, 13, 11, 6, 4, 8};

/// A gnuplot string. All ASCII but letters, digits and a few harmless signs goes in as octal escapes, so that
/// no quote, backslash, backtick or line end is ever seen by gnuplot's scanner.
std::string quoted(const std::string& text) {
  constexpr std::string_view harmless = " ,.:;()[]+-=/_<>";
  std::string result = "\"";
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (byte < 0x20 || byte == 0x7f) {
      result += ' ';
    } else if (byte >= 0x80 || std::isalnum(byte) != 0 ||
               harmless.find(character) != std::string_view::npos) {
      result += character;
    } else {
      result += fmt::format("\\{:03o}", byte);
    }
  }
  return result + "\"";
}

bool drawable(double value, Scale scale) {
  return std::isfinite(value) && (scale == Scale::linear || value > 0);
}

std::string number(double value, Scale scale) { return drawable(value, scale) ? exact(value) : "NaN"; }

// --- ranges ---

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;

  bool empty() const { return low > high; }
  bool contains(double value) const { return low <= value && value <= high; }
  void include(double value, Scale scale) {
    if (!drawable(value, scale)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// With air around the data, and a width also where all values are the same.
Range widened(Range range, Scale scale) {
  constexpr double share = 0.05;
  if (scale == Scale::logarithmic) {
    const double factor = range.high > range.low ? std::pow(range.high / range.low, share) : 2.0;
    return {range.low / factor, range.high * factor};
  }
  const double width = range.high - range.low;
  const double margin = width > 0 ? share * width : std::max(0.1 * std::abs(range.high), 1e-12);
  return {range.low - margin, range.high + margin};
}

Range with_limits(Range range, const Axis& axis) {
  range = widened(range, axis.scale);
  if (axis.minimum) range.low = *axis.minimum;
  if (axis.maximum) range.high = *axis.maximum;
  return range;
}

struct Ranges {
  Range x, y;
};

/// Of all points that can be drawn; empty when there is none. Marker lines and annotations widen it.
Ranges data_ranges(const Plot& plot) {
  Ranges ranges;
  for (const Series& series : plot.series) {
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
      if (!drawable(series.x[i], plot.x.scale) || !drawable(series.y[i], plot.y.scale)) continue;
      ranges.x.include(series.x[i], plot.x.scale);
      const double error = i < series.error.size() && std::isfinite(series.error[i]) ? series.error[i] : 0;
      for (const double y : {series.y[i] - error, series.y[i], series.y[i] + error}) {
        ranges.y.include(y, plot.y.scale);
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

std::string legend_commands(Legend legend) {
  const auto at = [](std::string_view place) {
    return fmt::format("set key {} Left reverse samplen 2.2 spacing 1.25 opaque\n", place);
  };
  switch (legend) {
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
    case Legend::none:
      break;
  }
  return "unset key\n";
}

std::string axis_commands(const std::string& name, const Axis& axis, const Range& range) {
  std::string text = fmt::format("set {}label {}\nset {}range [{}:{}]\n", name, quoted(axis.label), name,
                                 exact(range.low), exact(range.high));
  if (axis.scale == Scale::logarithmic) text += fmt::format("set logscale {}\n", name);
  return text;
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

std::string data_block(const Plot& plot, std::size_t index) {
  const Series& series = plot.series[index];
  std::string text = fmt::format("$series{} << END_OF_DATA\n", index);
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
    const double error = i < series.error.size() ? series.error[i] : 0;
    text += fmt::format("{} {} {}\n", number(series.x[i], plot.x.scale), number(series.y[i], plot.y.scale),
                        number(error, Scale::linear));
  }
  return text + "END_OF_DATA\n";
}

std::string style_of(const Series& series, std::size_t index) {
  const std::size_t look =
      (series.colour ? static_cast<std::size_t>(std::abs(*series.colour)) : index) % palette.size();
  const std::string colour = fmt::format("linecolor rgb '{}'", palette[look]);
  const std::string points = fmt::format("pointtype {} pointsize 0.7", point_types[look]);
  switch (series.style) {
    case Style::line:
      return fmt::format("with lines linewidth 2 {}", colour);
    case Style::dashed_line:
      return fmt::format("with lines linewidth 2 dashtype 2 {}", colour);
    case Style::points:
      return fmt::format("with points {} {}", points, colour);
    case Style::error_bars:
      return fmt::format("with yerrorbars linewidth 1.5 {} {}", points, colour);
    case Style::steps:
      return fmt::format("with steps linewidth 2 {}", colour);
    case Style::line_and_points:
      break;
  }
  return fmt::format("with linespoints linewidth 2 {} {}", points, colour);
}

bool has_points(const Series& series) { return !series.x.empty() && !series.y.empty(); }

std::string plot_command(const Plot& plot) {
  std::string text;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    if (!has_points(series)) continue;
    const std::string title = series.label.empty() ? "notitle" : "title " + quoted(series.label);
    text += fmt::format("{}$series{} using {} {} {}", text.empty() ? "plot " : ", \\\n     ", i,
                        series.style == Style::error_bars ? "1:2:3" : "1:2", style_of(series, i), title);
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
  std::string text = fmt::format(
      "set encoding utf8\n"
      "set terminal svg size {},{} noenhanced font 'sans-serif,14' background rgb '#ffffff' rounded\n"
      "set border 3 linewidth 1 linecolor rgb '#444444'\n"
      "set tics nomirror out scale 0.6 textcolor rgb '#222222'\n"
      "set grid linewidth 0.7 dashtype 1 linecolor rgb '#dddddd'\n"
      "set title {} font ',16'\n",
      plot.width, plot.height, quoted(plot.title));
  text += legend_commands(plot.legend);
  text += axis_commands("x", plot.x, ranges.x);
  text += axis_commands("y", plot.y, ranges.y);
  text += line_commands(plot, ranges);
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    if (has_points(plot.series[i])) text += data_block(plot, i);
  }
  return text + plot_command(plot);
}

store::Result<std::string> to_svg(const Plot& plot, const std::string& program) {
  if (const store::MaybeError error = unfit(plot)) return *error;
  // --default-settings: the user's own start-up file must not change a report.
  auto run = run_program(program, {"--default-settings", "-"}, to_gnuplot(plot));
  if (!run) return run.error();
  if (!run->succeeded || run->output.find("</svg>") == std::string::npos) {
    return store::Error{store::Error::Kind::failed,
                        fmt::format("{} could not draw '{}': {}", program, plot.title, run->errors)};
  }
  return run->output;
}

store::MaybeError write_svg(const Plot& plot, const std::filesystem::path& path) {
  const auto svg = to_svg(plot);
  if (!svg) return svg.error();
  return store::write_file_atomically(path, {*svg});
}

}  // namespace launchsafe::report
