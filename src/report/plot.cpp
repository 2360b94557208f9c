#include "launchsafe/report/plot.hpp"

#include "launchsafe/report/table.hpp"

#include <array>

namespace launchsafe::report {
namespace {

/// Pixels of a letter, as gnuplot reckons.
constexpr double letter_width = 8.4;

// --- series ---

/// Index into the palette, and into the signs of points.
std::size_t look_of(const Series& series, std::size_t index) {
  return series.colour ? static_cast<std::size_t>(*series.colour) : index;
}

std::string_view colour_of(const Series& series, std::size_t index) {
  // Okabe and Ito's colours, told apart by the colour-blind too; grey for the yellow that white paper
  // swallows.
  constexpr std::array<std::string_view, 8> palette{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                    "#e69f00", "#56b4e9", "#000000", "#7f7f7f"};
  return palette[look_of(series, index) % palette.size()];
}

bool has_bars(const Series& series) {
  return series.style >= Style::vertical_bars && series.style <= Style::filled_bars;
}

/// x, y, and the ends of the bar of styles that have one: the point itself where an end has no place. What
/// has no place widens no axis.
std::string series_data(const Plot& plot, const Series& series) {
  const bool along_x = series.style != Style::vertical_bars;
  const Scale bar_scale = along_x ? plot.x.scale : plot.y.scale;
  std::string lines;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const bool is_drawn = drawable(series.x[i], plot.x.scale) && drawable(series.y[i], plot.y.scale);
    lines += is_drawn ? exact(series.x[i]) + " " + exact(series.y[i]) : "NaN NaN";
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
  // In the order of Mark: gnuplot's filled signs, open signs, the cross, and nothing.
  constexpr std::array<int, 9> types{7, 5, 9, 13, 11, 6, 4, 2, -1};
  // Open signs are larger, so that they show around filled ones at the same place.
  const double size = mark < Mark::open_circle ? 0.7 : 1.1;
  return fmt::format("pointtype {} pointsize {}", types[static_cast<std::size_t>(mark)], size);
}

std::string style_of(const Series& series, std::size_t index) {
  // In the order of Style: {0} is the sign of points, {1} the colour.
  constexpr std::array<const char*, 7> styles{"with lines linewidth 2 {1}",
                                              "with lines linewidth 2 dashtype 2 {1}",
                                              "with points linewidth 1.5 {0} {1}",
                                              "with linespoints linewidth 2 {0} {1}",
                                              "with yerrorbars linewidth 1.5 {0} {1}",
                                              "with xerrorbars linewidth 1.5 {0} {1}",
                                              "with boxxyerror fillstyle solid 1.0 noborder {1}"};
  const auto sign = series.mark.value_or(static_cast<Mark>(look_of(series, index) % 8));
  return fmt::format(fmt::runtime(styles.at(static_cast<std::size_t>(series.style))), points_of(sign),
                     fmt::format("linecolor rgb '{}'", colour_of(series, index)));
}

// --- commands ---

void add_series(const Plot& plot, Commands& commands) {
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    if (series.x.empty()) continue;
    constexpr std::string_view box = "1:2:3:4:($2-0.3):($2+0.3)";
    const std::string_view columns = series.style == Style::filled_bars ? box
                                     : has_bars(series)                 ? "1:2:3:4"
                                                                        : "1:2";
    commands.add(fmt::format("series{}", i), series_data(plot, series),
                 fmt::format("{} {} {}", columns, style_of(series, i), title_of(series.label)));
  }
}

/// Bands from edge to edge: along the second axes, which go from 0 to 1.
void add_bands(const Plot& plot, Commands& commands) {
  for (std::size_t i = 0; i < plot.vertical_bands.size(); ++i) {
    const Band& band = plot.vertical_bands[i];
    commands.add(fmt::format("band{}", i),
                 fmt::format("{0} 0\n{0} 1\n{1} 1\n{1} 0\n", coordinate(band.from, plot.x.scale),
                             coordinate(band.to, plot.x.scale)),
                 fmt::format("1:2 axes x1y2 with filledcurves closed fillcolor rgb '#e4e4e4' {}",
                             title_of(band.label)));
  }
}

/// Lines, likewise.
void add_lines(const Plot& plot, Commands& commands) {
  const auto add = [&](const char* name, const std::vector<Line>& lines, Scale scale, const char* ends,
                       const char* axes, int dashes) {
    for (std::size_t i = 0; i < lines.size(); ++i)
      commands.add(fmt::format("{}{}", name, i),
                   fmt::format(fmt::runtime(ends), coordinate(lines[i].at, scale)),
                   fmt::format("1:2 axes {} with lines linewidth 1.3 linecolor rgb '#444444' dashtype {} {}",
                               axes, dashes, title_of(lines[i].label)));
  };
  add("vertical", plot.vertical_lines, plot.x.scale, "{0} 0\n{0} 1\n", "x1y2", 2);
  add("horizontal", plot.horizontal_lines, plot.y.scale, "0 {0}\n1 {0}\n", "x2y1", 4);
}

// --- the legend ---

/// Entries of the legend in so many columns that the longest has room, below the label of the x axis.
struct Legend {
  std::size_t columns = 1, rows = 0;
};

Legend legend_of(const Plot& plot) {
  constexpr double sample = 60;  // pixels
  std::size_t longest = 0, entries = 0;
  const auto add = [&](const std::string& label) {
    longest = std::max(longest, display_width(label));
    entries += label.empty() ? 0 : 1;
  };
  for (const Series& series : plot.series)
    if (!series.x.empty()) add(series.label);
  for (const auto* lines : {&plot.vertical_lines, &plot.horizontal_lines})
    for (const Line& line : *lines) add(line.label);
  for (const Band& band : plot.vertical_bands) add(band.label);
  const double room = 0.95 * plot.width / (sample + letter_width * static_cast<double>(longest));
  const auto columns =
      std::clamp<std::size_t>(static_cast<std::size_t>(room), 1, std::max<std::size_t>(entries, 1));
  return {columns, (entries + columns - 1) / columns};
}

/// Pixels of a plot with its legend.
int whole_height(const Plot& plot) {
  constexpr int row = 20;
  return plot.height + row * std::max(0, static_cast<int>(legend_of(plot).rows) - 1);
}

/// The legend, if there is anything to say.
std::string key_commands(const Plot& plot) {
  const Legend legend = legend_of(plot);
  if (legend.rows == 0) return "unset key\n";
  return fmt::format(
      "set key outside bottom center horizontal height 1.5 maxcols {} Left reverse samplen 2 spacing 1.25\n",
      legend.columns);
}

std::string frame_commands(const Plot& plot) {
  // So large that it is on the page, in whose middle it stands.
  const auto size = [&](const std::string& text, double most) {
    return std::clamp(1.7 * plot.width / static_cast<double>(display_width(text) + 1), 9.0, most);
  };
  std::size_t longest_tic = 0;
  for (const Tic& tic : plot.y.tics) longest_tic = std::max(longest_tic, display_width(tic.label));
  const double left = std::max<double>(10.0, 4.0 + 0.85 * static_cast<double>(longest_tic));
  const double aside = 0.5 * (3.0 - left);
  std::string text = fmt::format(
      "set border 3 linewidth 1 linecolor rgb '#444444'\n"
      "set tics nomirror out scale 0.6 textcolor rgb '#222222'\n"
      "set grid linewidth 0.7 dashtype 1 linecolor rgb '#dddddd'\n"
      "set autoscale fix\nset offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05\n"
      "set x2range [0:1]\nset y2range [0:1]\n"
      "set title {} font ',{:.0f}' offset {:.1f}, {}\n",
      quoted(plot.title), size(plot.title, 16.0), aside, plot.subtitle.empty() ? 0.0 : 0.4);
  if (!plot.subtitle.empty())
    text += fmt::format(
        "set tmargin 4.6\nset label 1 {} at graph 0.5, graph 1 center offset {:.1f}, 0.9 font ',{:.0f}' "
        "textcolor rgb '#444444'\n",
        quoted(plot.subtitle), aside, size(plot.subtitle, 12.0));
  return text + key_commands(plot);
}

/// Label, limits, scale and tics of the axis "x" or "y".
std::string axis_commands(const std::string& name, const PlotAxis& axis) {
  std::string text = fmt::format("set {}label {}\n", name, quoted(axis.label));
  if (axis.minimum) text += fmt::format("set {}range [{}:]\n", name, exact(*axis.minimum));
  if (axis.maximum) text += fmt::format("set {}range [:{}]\n", name, exact(*axis.maximum));
  if (axis.scale == Scale::logarithmic) text += fmt::format("set logscale {0}\nset format {0} '%g'\n", name);
  std::vector<std::string> tics;
  for (const Tic& tic : axis.tics)
    if (drawable(tic.at, axis.scale)) tics.push_back(quoted(tic.label) + " " + exact(tic.at));
  if (tics.empty()) return text;
  return text + fmt::format("unset m{0}tics\nset {0}tics ({1})\n", name, fmt::join(tics, ", "));
}

std::string drawing_commands(const Plot& plot) {
  Commands commands;
  add_bands(plot, commands);
  add_series(plot, commands);
  add_lines(plot, commands);
  return frame_commands(plot) + axis_commands("x", plot.x) + axis_commands("y", plot.y) + commands.text();
}

/// Below each other, as wide as the widest of them.
std::string panel_commands(const Plot& plot) {
  const int title_height = plot.subtitle.empty() ? 40 : 64;
  int width = 0, height = title_height;
  for (const Plot& panel : plot.panels) {
    width = std::max(width, panel.width);
    height += whole_height(panel);
  }
  const double page_height = height;
  std::string text =
      page_commands(width, page_height) + "set multiplot\n" +
      fmt::format("set label 1 {} at screen 0.5, screen {} center font ',18'\n", quoted(plot.title),
                  exact(1 - 24 / page_height)) +
      fmt::format("set label 2 {} at screen 0.5, screen {} center font ',13' textcolor rgb '#444444'\n",
                  quoted(plot.subtitle), exact(1 - 50 / page_height)) +
      "unset border\nunset tics\nset xrange [0:1]\nset yrange [0:1]\nplot NaN notitle\n";
  int bottom = title_height;
  for (const Plot& panel : plot.panels) {
    bottom += whole_height(panel);
    text += fmt::format(
        "reset\nset lmargin 10\nset rmargin 3\nset tmargin 4.6\nset size 1, {}\nset origin 0, {}\n",
        exact(whole_height(panel) / page_height), exact(1 - bottom / page_height));
    text += drawing_commands(panel);
  }
  return text + "unset multiplot\n";
}

/// At most ten round values.
std::vector<Tic> tics_between(double least, double most) {
  const double step = round_distance((most - least) / 9.0);
  std::vector<Tic> tics;
  for (double at = step * std::ceil(least / step); at < most; at += step)
    tics.push_back({at, significant(at, 6)});
  return tics;
}

}  // namespace

std::string to_gnuplot(const Plot& plot) {
  if (!plot.panels.empty()) return panel_commands(plot);
  return page_commands(plot.width, whole_height(plot)) + drawing_commands(plot);
}

void cut_axis(double line, Plot& plot) {
  double lowest = line;
  for (const Series& series : plot.series)
    for (const double temperature : series.y) lowest = std::min(lowest, temperature);
  const double row = std::max(0.2 * (line - lowest), 12.0), bottom = lowest - row;
  double level = line;
  for (Series& series : plot.series) {
    if (std::ranges::none_of(series.y, [&](double temperature) { return temperature > line; })) continue;
    level += row;
    for (double& temperature : series.y) temperature = temperature > line ? level : temperature;
  }
  const double top = std::max(level, line + row) + 0.5 * row;
  std::vector<Series> arrows;
  const auto cut = [&](const Series& series, std::vector<double>& ends, double at, Mark mark) {
    Series heads{.style = Style::points, .colour = series.colour, .mark = mark};
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (ends[i] > top || ends[i] < bottom) heads.add(series.x[i], at);
      ends[i] = std::clamp(ends[i], bottom, top);
    }
    if (heads.x.empty()) return;
    plot.subtitle = "arrows: the bar goes on beyond";
    arrows.push_back(std::move(heads));
  };
  for (Series& series : plot.series) {
    cut(series, series.upper, top, Mark::up_triangle);
    cut(series, series.lower, bottom, Mark::down_triangle);
  }
  std::ranges::move(arrows, std::back_inserter(plot.series));
  plot.y.maximum = top;
  plot.y.tics = tics_between(bottom, line);
}

}  // namespace launchsafe::report
