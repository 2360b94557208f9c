// The map of a plot: cells of colour, hatched cells, numbers or contour lines.
#include "gnuplot_text.hpp"
#include "launchsafe/report/number.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace launchsafe::report {
namespace {

/// Coordinates in which an axis is linear, and back.
double to_linear(double value, Scale scale) { return scale == Scale::linear ? value : std::log10(value); }
double from_linear(double value, Scale scale) {
  return scale == Scale::linear ? value : std::pow(10.0, value);
}

/// Where cells begin and end: half way between neighbouring points in the picture.
std::vector<double> cell_edges(const std::vector<double>& points, Scale scale) {
  const std::size_t last = points.size() - 1;
  const auto between = [&](std::size_t i, std::size_t k, double share) {
    return from_linear((1.0 - share) * to_linear(points[i], scale) + share * to_linear(points[k], scale),
                       scale);
  };
  std::vector<double> edges{between(0, 1, -0.5)};
  for (std::size_t i = 0; i < last; ++i) edges.push_back(between(i, i + 1, 0.5));
  edges.push_back(between(last - 1, last, 1.5));
  return edges;
}

/// Of the narrowest cell, as a share of the axis.
double least_width(const std::vector<double>& edges, Scale scale) {
  const auto width = [&](std::size_t from, std::size_t to) {
    return to_linear(edges[to], scale) - to_linear(edges[from], scale);
  };
  double least = 1.0;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i)
    least = std::min(least, width(i, i + 1) / width(0, edges.size() - 1));
  return least;
}

struct Cells {
  const Map& map;
  std::vector<double> x_edges, y_edges;

  explicit Cells(const Plot& plot)
      : map(*plot.map), x_edges(cell_edges(map.x, plot.x.scale)), y_edges(cell_edges(map.y, plot.y.scale)) {}

  /// A grid point and the ends of its cell.
  std::string line(std::size_t index) const {
    const std::size_t i = index % map.x.size(), j = index / map.x.size();
    return fmt::format("{} {} {} {} {} {}", exact(map.x[i]), exact(map.y[j]), exact(x_edges[i]),
                       exact(x_edges[i + 1]), exact(y_edges[j]), exact(y_edges[j + 1]));
  }

  /// Whether a number of three digits, and its uncertainty below it, has room in every cell.
  bool have_room(const Plot& plot) const {
    constexpr double share_of_width = 0.72, share_of_height = 0.68;  // that the cells fill, about
    const double number_width = map.uncertainty.empty() ? 50 : 64;   // pixels
    const double number_height = map.uncertainty.empty() ? 20 : 36;
    return share_of_width * plot.width * least_width(x_edges, plot.x.scale) > number_width &&
           share_of_height * plot.height * least_width(y_edges, plot.y.scale) > number_height;
  }
};

struct ValueRange {
  double lowest = HUGE_VAL, highest = -HUGE_VAL;
  bool any() const { return lowest <= highest; }
};

ValueRange range_of(const std::vector<double>& values) {
  ValueRange range;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    range.lowest = std::min(range.lowest, value);
    range.highest = std::max(range.highest, value);
  }
  return range;
}

void add_values(const Map& map, const Cells& cells, Commands& commands) {
  std::string lines;
  for (std::size_t index = 0; index < map.values.size(); ++index) {
    if (!std::isfinite(map.values[index])) continue;
    lines += cells.line(index) + " " + exact(map.values[index]);
    if (!map.uncertainty.empty()) lines += " " + coordinate(map.uncertainty[index], Scale::linear);
    lines += "\n";
  }
  commands.settings += data_block("cells", lines) + palette_command() +
                       fmt::format("set cblabel {}\nset rmargin at screen 0.82\n", quoted(map.label));
  if (map.minimum && map.maximum && *map.minimum < *map.maximum)
    commands.settings += fmt::format("set cbrange [{}:{}]\n", exact(*map.minimum), exact(*map.maximum));
  commands.plots.emplace_back(
      "$cells using 1:2:3:4:5:6:7 with boxxyerror fillstyle solid 1.0 noborder linecolor palette notitle");
}

void add_hatching(const HatchedCells& hatched, std::size_t number, const Cells& cells, Commands& commands) {
  if (hatched.cells.empty()) return;
  std::string lines;
  for (const std::size_t index : hatched.cells) lines += cells.line(index) + "\n";
  // In the order of Hatching: gnuplot's fill patterns.
  constexpr std::array<int, 4> patterns{5, 4, 1, 2};
  commands.add(fmt::format("hatched{}", number), lines,
               fmt::format("1:2:3:4:5:6 with boxxyerror linecolor rgb '#777777' fillstyle pattern {} "
                           "border linecolor rgb '#555555' title {}",
                           patterns[static_cast<std::size_t>(hatched.hatching)], quoted(hatched.label)));
}

/// The values themselves, or moved by their uncertainty.
std::vector<double> moved(const Map& map, double uncertainties) {
  std::vector<double> values = map.values;
  for (std::size_t i = 0; uncertainties != 0.0 && i < values.size(); ++i)
    values[i] += uncertainties * map.uncertainty[i];
  return values;
}

/// Of contour lines, in the values' unit: one digit, about eight lines at most, and no finer than the values
/// are known.
double contour_step(const Map& map, const ValueRange& range) {
  const double known = std::max(map.least_step, range_of(map.uncertainty).highest);
  const double least = std::max(known, (range.highest - range.lowest) / 8.0);
  const double unit = std::pow(10.0, std::floor(std::log10(least)));
  for (const double digits : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0}) {
    if (digits * unit >= least * (1.0 - 1e-9)) return digits * unit;
  }
  return 10.0 * unit;
}

/// Multiples of the step between the lowest and the highest value.
std::vector<double> contour_levels(const ValueRange& range, double step) {
  std::vector<double> levels;
  for (double n = std::ceil(range.lowest / step); n * step < range.highest; ++n) {
    if (n * step > range.lowest) levels.push_back(n * step);
  }
  return levels;
}

/// gnuplot's contour lines as data of a name, in linear coordinates.
std::string contour_commands(const Plot& plot, const std::vector<double>& values,
                             const std::vector<double>& levels, const std::string& name) {
  const Map& map = *plot.map;
  std::string lines, listed;
  for (std::size_t j = 0; j < map.y.size(); ++j) {
    for (std::size_t i = 0; i < map.x.size(); ++i)
      lines += fmt::format("{} {} {}\n", exact(to_linear(map.x[i], plot.x.scale)),
                           exact(to_linear(map.y[j], plot.y.scale)), exact(values[j * map.x.size() + i]));
    lines += "\n";
  }
  // Levels as people write them: 0.06, not 0.060000000000000005.
  for (const double level : levels) listed += (listed.empty() ? "" : ",") + significant(level, 6);
  // Where no line runs, gnuplot needs a point to skip.
  return data_block("grid_of_" + name, lines) +
         fmt::format(
             "set contour base\nunset surface\nset cntrparam linear\nset cntrparam levels discrete {1}\n"
             "set table ${0}\nsplot $grid_of_{0} using 1:2:3\nunset table\n"
             "set print ${0} append\nprint \"NaN NaN NaN\"\nunset print\n",
             name, listed);
}

/// Lines that no uncertainty blurs together: none where the values are not known well enough for two.
void add_contours(const Plot& plot, const ValueRange& range, Commands& commands) {
  const Map& map = *plot.map;
  const double step = contour_step(map, range);
  const std::vector<double> levels = contour_levels(range, step);
  if (levels.empty()) return;
  commands.settings += contour_commands(plot, map.values, levels, "contours");
  commands.settings += "set style textbox opaque margins 0.5, 0.3 fillcolor rgb '#ffffff' noborder\n";
  const auto back = [](int column, Scale scale) {
    return scale == Scale::linear ? fmt::format("{}", column) : fmt::format("(10**${})", column);
  };
  const std::string places = back(1, plot.x.scale) + ":" + back(2, plot.y.scale);
  const std::size_t along = std::min(map.x.size(), map.y.size());
  if (range_of(map.uncertainty).any()) {
    commands.settings += contour_commands(plot, moved(map, -1.0), levels, "lower") +
                         contour_commands(plot, moved(map, 1.0), levels, "upper");
    const auto add_moved = [&](const char* name, const char* sign, int dashes, const char* label) {
      commands.plots.push_back(
          fmt::format("${} using {} with lines linewidth 1.2 dashtype {} linecolor rgb '#222222' title {}",
                      name, places, dashes, quoted(label)));
      // Which line it belongs to, as that may not be the nearest one.
      commands.plots.push_back(fmt::format(
          "${} using {}:(sprintf('{} %g', $3)) every 100000::{} with labels font ',11' boxed notitle", name,
          places, sign, along / 2));
    };
    add_moved("lower", ">", 2, "more than that, less the uncertainty");
    add_moved("upper", "<", 3, "less than that, with the uncertainty");
  }
  commands.plots.push_back(
      fmt::format("$contours using {} with lines linewidth 1.6 linecolor rgb '#222222' title {}", places,
                  quoted(fmt::format("contour lines, every {}", significant(step, 6)))));
  // Labels of neighbouring levels stand at different places along their lines.
  for (const std::size_t parity : {0, 1}) {
    commands.plots.push_back(
        fmt::format("$contours using {}:3 index {}::2 every 100000::{} with labels font ',12' boxed notitle",
                    places, parity, (1 + parity) * along / 3));
  }
}

/// Black on light colours, white on dark ones.
void add_numbers(const Map& map, const ValueRange& range, Commands& commands) {
  const double lowest = map.minimum.value_or(range.lowest), highest = map.maximum.value_or(range.highest);
  const std::string text =
      map.uncertainty.empty() ? "sprintf('%.3g', $7)" : "sprintf(\"%.3g\\n+-%.2g\", $7, $8)";
  commands.plots.push_back(
      fmt::format("$cells using 1:2:({}):($7 < {} ? 0xffffff : 0x111111) with labels font ',13' "
                  "textcolor rgb variable notitle",
                  text, exact(lowest + 0.3 * (highest - lowest))));
}

}  // namespace

std::string unfit(const Map& map, const Plot& plot) {
  if (map.x.size() < 2 || map.y.size() < 2) return "a map has at least two values on each axis";
  if (map.values.size() != map.x.size() * map.y.size())
    return "a map has a value, or NaN, for every point of its grid";
  if (!map.uncertainty.empty() && map.uncertainty.size() != map.values.size())
    return "a map has an uncertainty for every value, or for none";
  const auto fits = [](const std::vector<double>& values, Scale scale) {
    return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end() &&
           std::all_of(values.begin(), values.end(), [&](double value) { return drawable(value, scale); });
  };
  if (!fits(map.x, plot.x.scale) || !fits(map.y, plot.y.scale))
    return "the values of an axis are ascending, finite, and positive on a logarithmic axis";
  return {};
}

Commands map_commands(const Plot& plot) {
  const Map& map = *plot.map;
  const Cells cells(plot);
  Commands commands;
  const ValueRange range = range_of(map.values);
  if (range.any()) add_values(map, cells, commands);
  for (std::size_t i = 0; i < map.hatched.size(); ++i) add_hatching(map.hatched[i], i, cells, commands);
  if (range.any() && cells.have_room(plot)) {
    add_numbers(map, range, commands);
  } else if (range.lowest < range.highest) {
    add_contours(plot, range, commands);
  }
  commands.settings +=
      fmt::format("unset grid\nset xrange [{}:{}]\nset yrange [{}:{}]\n", exact(cells.x_edges.front()),
                  exact(cells.x_edges.back()), exact(cells.y_edges.front()), exact(cells.y_edges.back()));
  return commands;
}

}  // namespace launchsafe::report
