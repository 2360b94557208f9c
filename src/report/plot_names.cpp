// Names in the plot itself, where nothing else is drawn.
#include "plot_names.hpp"

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

/// Where a value stands between the lowest and the highest of an axis that its data make.
struct Places {
  const PlotAxis& axis;
  double least = HUGE_VAL, most = -HUGE_VAL;

  double of(double value) const { return (scaled(value) - low()) / span(); }
  double at(double place) const {
    const double value = low() + place * span();
    return axis.scale == Scale::linear ? value : std::pow(10.0, value);
  }

  double scaled(double value) const { return axis.scale == Scale::linear ? value : std::log10(value); }
  double low() const { return scaled(axis.minimum.value_or(least)); }
  double span() const {
    const double span = scaled(axis.maximum.value_or(most)) - low();
    return span > 0 ? span : 1.0;
  }
};

Places places_along(const Plot& plot, const PlotAxis& axis, std::vector<double> Series::*values,
                    const std::vector<Line>& lines, const std::vector<Band>& bands) {
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
  for (const Line& line : lines) add(line.at);
  for (const Band& band : bands) add(band.from), add(band.to);
  return places;
}

/// Where lines end that are not `named` otherwise, of each series: along y, 0 to 1, from the lowest to the
/// highest, no two on each other.
std::vector<std::pair<double, std::size_t>> line_ends(const Plot& plot, const Places& along_y, double apart,
                                                      const std::vector<bool>& named) {
  std::vector<std::pair<double, std::size_t>> ends;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    if (named[i] || !named_at_end(plot, series)) continue;
    for (std::size_t k = series.x.size(); k-- > 0;)
      if (drawable(series.x[k], plot.x.scale) && drawable(series.y[k], plot.y.scale)) {
        ends.emplace_back(along_y.of(series.y[k]), i);
        break;
      }
  }
  std::ranges::sort(ends);
  // Pushed up from below, then down from above.
  for (std::size_t i = 1; i < ends.size(); ++i)
    ends[i].first = std::max(ends[i].first, ends[i - 1].first + apart);
  double highest = 1.05;
  for (std::size_t i = ends.size(); i-- > 0; highest = ends[i].first - apart)
    ends[i].first = std::min(ends[i].first, highest);
  return ends;
}

/// Pixels of the frame, as gnuplot lays it out.
double frame_width(const Plot& plot) {
  return plot.width - 9.8 * static_cast<double>(10 + right_margin(longest_end_name(plot)));
}
double frame_height(const Plot& plot) { return plot.height - (plot.subtitle.empty() ? 200.0 : 230.0); }

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

/// Names that stand where nothing else is drawn.
struct FreeNames {
  const Plot& plot;
  Places along_x = places_along(plot, plot.x, &Series::x, plot.vertical_lines, plot.vertical_bands),
         along_y = places_along(plot, plot.y, &Series::y, plot.horizontal_lines, plot.horizontal_bands);
  double letter = 7.2 / frame_width(plot), line_height = 20.0 / frame_height(plot);  // shares of the frame
  std::vector<Box> taken = {};
  std::string commands = {};

  double x(double value) const { return share(along_x, value); }
  double y(double value) const { return share(along_y, value); }
  /// Data that make an end of their axis stand a little within the frame.
  static double share(const Places& along, double value) {
    const bool is_given = along.axis.minimum && along.axis.maximum;
    return is_given ? along.of(value) : (along.of(value) + 0.05) / 1.1;
  }

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

  Box box_of(const std::string& label, const NamePlace& place) const {
    const auto capitals = std::ranges::count_if(label, [](char each) { return each >= 'A' && each <= 'Z'; });
    const double length =
        letter * (static_cast<double>(display_width(label)) + 0.3 * static_cast<double>(capitals));
    const double left = place.anchor.x + place.side * letter - 0.5 * (1 - place.side) * length;
    const double middle = place.anchor.y + line_height * place.up;
    return {left, left + length, middle - 0.5 * line_height, middle + 0.5 * line_height};
  }

  bool is_free(const Box& box) const {
    constexpr double highest = 1.1;  // a little above the frame is nothing
    if (box.left < 0.0 || box.right > 1.0 || box.low < 0.0 || box.high > highest) return false;
    for (const Series& series : plot.series)
      for (std::size_t i = 0; i < series.x.size(); ++i) {
        const bool is_bar = series.style == Style::vertical_bars;
        const std::size_t before = i > 0 && !is_bar && series.style != Style::points ? i - 1 : i;
        if (crosses(box, {x(series.x[before]), y(is_bar ? series.lower[i] : series.y[before])},
                    {x(series.x[i]), y(is_bar ? series.upper[i] : series.y[i])}))
          return false;
      }
    const auto across = [](double place, double from, double to) { return from <= place && place <= to; };
    return std::ranges::none_of(taken, [&](const Box& other) { return box.meets(other); }) &&
           std::ranges::none_of(plot.horizontal_lines,
                                [&](const Line& line) { return across(y(line.at), box.low, box.high); }) &&
           std::ranges::none_of(plot.vertical_lines,
                                [&](const Line& line) { return across(x(line.at), box.left, box.right); });
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

  /// From above.
  std::vector<Anchor> on_upright(double value) const {
    std::vector<Anchor> anchors;
    for (double share = 0.97; share > line_height; share -= line_height)
      anchors.push_back({x(value), share, fmt::format("first {}, graph {}", exact(value), exact(share))});
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
  if (!plot.named_in_place) return made;
  FreeNames names{plot};
  for (const Line& line : plot.horizontal_lines) names.add(line.label, dark, names.on_level(line.at), true);
  for (const Band& band : plot.horizontal_bands) names.add(band.label, dark, names.on_level(band.to), true);
  for (const Line& line : plot.vertical_lines) names.add(line.label, dark, names.on_upright(line.at), true);
  for (const Band& band : plot.vertical_bands) names.add(band.label, dark, names.on_upright(band.from), true);
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& each = plot.series[i];
    if (each.style == Style::dashed_line || (!is_line(each) && each.x.size() <= few))
      made.series[i] = names.add(each.label, colour_of(each, i), names.on_points(each), false);
  }
  for (const auto& [place, i] : line_ends(plot, names.along_y, 1.2 * names.line_height, made.series)) {
    const std::string at = "graph 1, first " + exact(names.along_y.at(place));
    names.put(plot.series[i].label, colour_of(plot.series[i], i), {{1.0, place, at}, 1, 0.0});
  }
  for (std::size_t i = 0; i < plot.series.size(); ++i)
    made.series[i] = made.series[i] || named_at_end(plot, plot.series[i]);
  made.commands = std::move(names.commands);
  return made;
}

}  // namespace launchsafe::report
