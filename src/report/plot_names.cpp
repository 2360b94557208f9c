// Names in the plot itself, where nothing else is drawn.
#include "plot_names.hpp"

#include "launchsafe/math/numbers.hpp"
#include "launchsafe/report/table.hpp"

#include <array>

namespace launchsafe::report {
namespace {

bool is_line(const Series& series) {
  return series.style <= Style::line_and_points && series.style != Style::points;
}

/// At its right end, if not beside itself.
bool named_at_end(const Plot& plot, const Series& series) {
  return plot.named_in_place && is_line(series) && !series.label.empty();
}

/// Where values stand along an axis, as shares of the frame.
struct Places {
  const PlotAxis& axis;
  double least = HUGE_VAL, most = -HUGE_VAL;

  double of(double value) const {
    const double low = scaled(axis.minimum.value_or(least)), high = scaled(axis.maximum.value_or(most));
    const double place = (scaled(value) - low) / (high > low ? high - low : 1.0);
    // Data that make an end of their axis stand a little within the frame.
    return axis.minimum && axis.maximum ? place : (place + 0.05) / 1.1;
  }
  double scaled(double value) const { return axis.scale == Scale::linear ? value : std::log10(value); }
};

/// Where lines across an axis stand, and edges of bands.
std::vector<double> edges_of(const std::vector<Line>& lines, const std::vector<Band>& bands) {
  std::vector<double> edges;
  for (const Line& line : lines) edges.push_back(line.at);
  for (const Band& band : bands) edges.insert(edges.end(), {band.from, band.to});
  return edges;
}

Places places_along(const Plot& plot, const PlotAxis& axis, std::vector<double> Series::*values,
                    const std::vector<double>& edges) {
  Places places{axis};
  const auto add = [&](double value) {
    if (!drawable(value, axis.scale)) return;
    places.least = std::min(places.least, value);
    places.most = std::max(places.most, value);
  };
  for (const Series& series : plot.series)
    for (std::size_t i = 0; i < series.x.size(); ++i)
      if (drawable(series.x[i], plot.x.scale) && drawable(series.y[i], plot.y.scale))
        add((series.*values)[i]);
  std::ranges::for_each(edges, add);
  return places;
}

/// Pixels of the frame, as gnuplot lays it out.
double frame_width(const Plot& plot) {
  return plot.width - 9.8 * static_cast<double>(10 + right_margin(longest_end_name(plot)));
}
double frame_height(const Plot& plot) { return plot.height - (plot.subtitle.empty() ? 200.0 : 230.0); }

/// Share of the frame: a line that ends before is not named at the edge, or has a leader.
constexpr double beside = 0.85;

/// A part of the plot, each side as a share of its frame from the left and from below.
struct Box {
  double left, right, low, high;

  bool meets(const Box& other) const {
    return left < other.right && other.left < right && low < other.high && other.low < high;
  }
};

/// A place in the frame, as shares of it and as gnuplot has it.
struct Anchor {
  double x, y;
  std::string at;
};

/// Where a name may stand: to the right of an anchor (1), to its left (-1) or over its middle (0).
struct NamePlace {
  const Anchor& anchor;
  int side;
  double up;  ///< lines
};

/// The end of a line, and how high its name stands.
struct LineEnd {
  Anchor end;
  double place;
  std::size_t series;
};

/// Names so near to their ends as `apart` lets them: half-way between those pushed up from below and those
/// pushed down from above, within the frame. Ends are in ascending order.
void spread(std::vector<LineEnd>& ends, double apart) {
  std::vector<double> raised;
  for (const LineEnd& each : ends)
    raised.push_back(raised.empty() ? each.end.y : std::max(each.end.y, raised.back() + apart));
  double lowered = math::infinity;
  for (std::size_t i = ends.size(); i-- > 0; lowered -= apart) {
    lowered = std::min(ends[i].end.y, lowered);
    const double lowest = apart * static_cast<double>(i),
                 highest = 1.0 - apart * static_cast<double>(ends.size() - 1 - i);
    ends[i].place = 0.5 * (std::min(raised[i], highest) + std::max(lowered, lowest));
  }
}

/// Names that stand where nothing else is drawn.
struct FreeNames {
  const Plot& plot;
  std::vector<double> uprights = edges_of(plot.vertical_lines, plot.vertical_bands),
                      levels = edges_of(plot.horizontal_lines, plot.horizontal_bands);
  Places along_x = places_along(plot, plot.x, &Series::x, uprights),
         along_y = places_along(plot, plot.y, &Series::y, levels);
  // Shares of the frame; half of a mark.
  double letter = letter_width / frame_width(plot), line_height = 20.0 / frame_height(plot);
  double mark_width = 7.0 / frame_width(plot), mark_height = 7.0 / frame_height(plot);
  std::vector<Box> taken = {};
  std::string commands = {};

  double x(double value) const { return along_x.of(value); }
  double y(double value) const { return along_y.of(value); }

  /// In the first place by an anchor that is free; else `otherwise` by the first of all, or nowhere.
  bool add(const std::string& label, std::string_view colour, const std::vector<Anchor>& anchors,
           bool otherwise) {
    std::vector<NamePlace> places;
    for (const Anchor& anchor : anchors) {
      for (const double up : {0.0, 0.4, -0.4, 0.8, -0.8})
        for (const int side : {1, -1}) places.push_back({anchor, side, up});
      for (const double up : {1.0, -1.0}) places.push_back({anchor, 0, up});
    }
    const auto free =
        std::ranges::find_if(places, [&](const NamePlace& each) { return is_free(box_of(label, each)); });
    if (label.empty() || (free == places.end() && !otherwise)) return false;
    put(label, colour, free == places.end() ? places.front() : *free);
    return true;
  }

  void put(const std::string& label, std::string_view colour, const NamePlace& place) {
    taken.push_back(box_of(label, place));
    commands += fmt::format("set label {} at {} {} offset {}, {} front textcolor rgb '{}'\n", quoted(label),
                            place.anchor.at,
                            place.side > 0   ? "left"
                            : place.side < 0 ? "right"
                                             : "center",
                            place.side, place.up, colour);
  }

  /// Of lines that are not `named` yet, at the right edge; one that is off its line's end has a thin leader.
  void add_line_ends(std::vector<bool>& named) {
    std::vector<LineEnd> ends;
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
      if (named[i] || !named_at_end(plot, plot.series[i])) continue;
      named[i] = true;
      if (const auto anchors = on_points(plot.series[i]); !anchors.empty())
        ends.push_back({anchors.front(), 0.0, i});
    }
    std::ranges::sort(ends, {}, [](const LineEnd& each) { return each.end.y; });
    spread(ends, 1.2 * line_height);
    for (const auto& [end, place, i] : ends) {
      const std::string at = "graph 1, graph " + exact(place);
      put(plot.series[i].label, colour_of(plot.series[i], i), {{1.0, place, at}, 1, 0.0});
      if (std::abs(place - end.y) > 0.3 * line_height || end.x < beside)
        commands +=
            fmt::format("set arrow from {} to {} nohead linewidth 0.8 dashtype 3 linecolor rgb '{}'\n",
                        end.at, at, colour_of(plot.series[i], i));
    }
  }

  Box box_of(const std::string& label, const NamePlace& place) const {
    const double length = letter * static_cast<double>(display_width(label));
    const double left = place.anchor.x + place.side * letter - 0.5 * (1 - place.side) * length;
    const double middle = place.anchor.y + line_height * place.up;
    return {left, left + length, middle - 0.5 * line_height, middle + 0.5 * line_height};
  }

  bool is_free(const Box& box) const {
    if (box.left < 0.0 || box.right > 1.0 || box.low < 0.0 || box.high > 1.0) return false;
    const auto between = [](double from, double place, double to) { return from <= place && place <= to; };
    for (const Series& series : plot.series)
      for (std::size_t i = 0; i < series.x.size(); ++i)
        if (meets_point(box, series, i)) return false;
    return std::ranges::none_of(taken, [&](const Box& other) { return box.meets(other); }) &&
           std::ranges::none_of(levels, [&](double at) { return between(box.low, y(at), box.high); }) &&
           std::ranges::none_of(uprights, [&](double at) { return between(box.left, x(at), box.right); });
  }

  /// A point's mark, its bar, or the line from the one before it.
  bool meets_point(const Box& box, const Series& series, std::size_t i) const {
    const std::pair here{x(series.x[i]), y(series.y[i])};
    const bool is_bar = series.style == Style::vertical_bars, is_points = series.style == Style::points;
    if (is_bar && crosses(box, {here.first, y(series.lower[i])}, {here.first, y(series.upper[i])}))
      return true;
    if (!is_bar && !is_points && i > 0) {
      const std::pair before{x(series.x[i - 1]), y(series.y[i - 1])};
      const std::pair corner{series.style == Style::steps ? here.first : before.first, before.second};
      if (crosses(box, before, corner) || crosses(box, corner, here)) return true;
    }
    const bool has_mark = is_bar || is_points || series.style == Style::line_and_points;
    const Box around{box.left - mark_width, box.right + mark_width, box.low - mark_height,
                     box.high + mark_height};
    return has_mark && crosses(around, here, here);
  }

  static bool crosses(const Box& box, std::pair<double, double> a, std::pair<double, double> b) {
    if (a.first > b.first) std::swap(a, b);
    const double from = std::max(a.first, box.left), to = std::min(b.first, box.right);
    if (!(from <= to)) return false;
    const double slope = b.first > a.first ? (b.second - a.second) / (b.first - a.first) : 0.0;
    const auto at = [&](double x) { return a.second + slope * (x - a.first); };
    const auto [low, high] =
        b.first > a.first ? std::minmax({at(from), at(to)}) : std::minmax({a.second, b.second});
    return low <= box.high && high >= box.low;
  }

  std::vector<Anchor> on_level(double value) const {
    const auto at = [&](double share) {
      return Anchor{share, y(value), fmt::format("graph {}, first {}", share, exact(value))};
    };
    return {at(0.0), at(1.0)};
  }

  /// From above, at each of some values, or at the edge of the frame where one is beyond.
  std::vector<Anchor> on_uprights(const std::vector<double>& values) const {
    std::vector<Anchor> anchors;
    for (const double value : values)
      for (double up = 0.97, at = std::min(x(value), 1.0); up > line_height; up -= line_height)
        anchors.push_back({at, up, fmt::format("graph {}, graph {}", exact(at), exact(up))});
    return anchors;
  }

  /// The last one first.
  std::vector<Anchor> on_points(const Series& series) const {
    std::vector<Anchor> anchors;
    for (std::size_t i = series.x.size(); i-- > 0;)
      if (drawable(series.x[i], plot.x.scale) && drawable(series.y[i], plot.y.scale))
        anchors.push_back({x(series.x[i]), y(series.y[i]),
                           fmt::format("first {}, first {}", exact(series.x[i]), exact(series.y[i]))});
    return anchors;
  }
};

}  // namespace

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

std::size_t right_margin(std::size_t longest_name) { return 3 + 17 * longest_name / 20; }

std::size_t longest_end_name(const Plot& plot) {
  std::size_t longest = 0;
  for (const Series& series : plot.series)
    if (named_at_end(plot, series)) longest = std::max(longest, display_width(series.label));
  return longest;
}

PlotNames names_in_place(const Plot& plot) {
  constexpr std::string_view dark = "#444444";
  constexpr std::size_t few = 6;
  PlotNames made{std::vector<bool>(plot.series.size()), {}};
  FreeNames names{plot};
  for (const Line& line : plot.horizontal_lines) names.add(line.label, dark, names.on_level(line.at), true);
  for (const Band& band : plot.horizontal_bands) names.add(band.label, dark, names.on_level(band.to), true);
  for (const Line& line : plot.vertical_lines)
    names.add(line.label, dark, names.on_uprights({line.at}), true);
  for (const auto& [from, to, label] : plot.vertical_bands)
    names.add(label, dark, names.on_uprights({from, to, 0.5 * (from + to)}), true);
  for (std::size_t i = 0; plot.named_in_place && i < plot.series.size(); ++i) {
    const Series& each = plot.series[i];
    std::vector<Anchor> anchors = names.on_points(each);
    const bool by_its_end = is_line(each) && each.style != Style::dashed_line && !anchors.empty();
    if (by_its_end ? anchors.front().x > beside : !is_line(each) && each.x.size() > few) continue;
    if (by_its_end) anchors.resize(1);
    made.series[i] = names.add(each.label, colour_of(each, i), anchors, false);
  }
  names.add_line_ends(made.series);
  made.commands = std::move(names.commands);
  return made;
}

}  // namespace launchsafe::report
