// Names of lines in the plot itself, and what makes lines on each other seen.
#include "plot_names.hpp"

#include "launchsafe/report/table.hpp"

#include <array>

namespace launchsafe::report {
namespace {

bool is_line(const Series& series) {
  return series.style <= Style::line_and_points && series.style != Style::points;
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
                    const std::vector<Line>& lines) {
  Places places{axis};
  const auto add = [&](double value) {
    if (!drawable(value, axis.scale)) return;
    places.least = std::min(places.least, value);
    places.most = std::max(places.most, value);
  };
  for (const Series& series : plot.series) std::ranges::for_each(series.*values, add);
  for (const Line& line : lines) add(line.at);
  return places;
}

/// Whether a line lies under another that is drawn later, all along.
bool is_under(const Series& line, const Series& later, const Places& along_y) {
  constexpr double same = 0.008;  // of the height
  const bool hides = is_line(line) && is_line(later) &&
                     (later.style != Style::dashed_line || line.style == Style::dashed_line);
  if (!hides || later.x != line.x) return false;
  bool any = false;
  for (std::size_t i = 0; i < line.y.size(); ++i) {
    if (!drawable(line.y[i], along_y.axis.scale)) continue;
    any = true;
    if (!(std::abs(along_y.of(line.y[i]) - along_y.of(later.y[i])) < same)) return false;
  }
  return any;
}

/// What a line is called, beside the plot at the height where it ends.
struct EndName {
  std::string text;
  std::string_view colour;
  double place = 0;  ///< along y, 0 to 1
};

/// From the lowest to the highest, no two on each other.
std::vector<EndName> names_at_ends(const Plot& plot, const Places& along_y) {
  std::vector<EndName> names;
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& series = plot.series[i];
    if (!named_at_end(plot, series)) continue;
    for (std::size_t k = series.x.size(); k-- > 0;)
      if (drawable(series.x[k], plot.x.scale) && drawable(series.y[k], plot.y.scale)) {
        names.push_back({series.label, colour_of(series, i), along_y.of(series.y[k])});
        break;
      }
  }
  std::ranges::stable_sort(names, {}, &EndName::place);
  const double apart = 24.0 / (plot.height - 170.0);
  // Pushed up from below, then down from above.
  for (std::size_t i = 1; i < names.size(); ++i)
    names[i].place = std::max(names[i].place, names[i - 1].place + apart);
  double highest = 1.05;
  for (std::size_t i = names.size(); i-- > 0; highest = names[i].place - apart)
    names[i].place = std::min(names[i].place, highest);
  return names;
}

/// A part of the plot, each side as a share of its frame from the left and from below.
struct Box {
  double left, right, low, high;
};

/// What is drawn within the frame, for names that shall stand where nothing else is.
struct Surroundings {
  const Plot& plot;
  Places along_x, along_y;

  double x(double value) const { return share(along_x, value); }
  double y(double value) const { return share(along_y, value); }
  /// Data that make an end of their axis stand a little within the frame.
  static double share(const Places& along, double value) {
    const bool is_given = along.axis.minimum && along.axis.maximum;
    return is_given ? along.of(value) : (along.of(value) + 0.05) / 1.1;
  }

  bool is_free(const Box& box) const {
    if (box.left < 0.0 || box.right > 1.0) return false;
    for (const Series& series : plot.series)
      for (std::size_t i = 0; i < series.x.size(); ++i) {
        const std::size_t before = i > 0 && series.style != Style::points ? i - 1 : i;
        if (crosses(box, {x(series.x[before]), y(series.y[before])}, {x(series.x[i]), y(series.y[i])}))
          return false;
      }
    const auto across = [](double place, double from, double to) { return from <= place && place <= to; };
    return std::ranges::none_of(plot.horizontal_lines,
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
};

}  // namespace

bool named_at_end(const Plot& plot, const Series& series) {
  return plot.named_in_place && is_line(series) && !series.label.empty();
}

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

int line_width(const Plot& plot, std::size_t index) {
  constexpr int usual = 2, rims = 3, most = 3;
  const Places along_y = places_along(plot, plot.y, &Series::y, plot.horizontal_lines);
  int over = 0;
  for (std::size_t later = index + 1; later < plot.series.size(); ++later)
    if (colour_of(plot.series[later], later) != colour_of(plot.series[index], index) &&
        is_under(plot.series[index], plot.series[later], along_y))
      ++over;
  return usual + rims * std::min(over, most);
}

std::size_t right_margin(std::size_t longest_name) { return 3 + 17 * longest_name / 20; }

std::size_t longest_end_name(const Plot& plot) {
  std::size_t longest = 0;
  for (const Series& series : plot.series)
    if (named_at_end(plot, series)) longest = std::max(longest, display_width(series.label));
  return longest;
}

std::string names_in_place(const Plot& plot, std::size_t width) {
  if (!plot.named_in_place) return {};
  const Surroundings around{plot, places_along(plot, plot.x, &Series::x, plot.vertical_lines),
                            places_along(plot, plot.y, &Series::y, plot.horizontal_lines)};
  const double letter = 7.2 / (plot.width - 8.0 * static_cast<double>(12 + right_margin(width))),
               line_height = 20.0 / (plot.height - 170.0);
  std::string text;
  const auto add = [&text](const std::string& label, const std::string& x, const std::string& y,
                           const std::string& how, std::string_view colour = "#444444") {
    text +=
        fmt::format("set label {} at {}, {} {} front textcolor rgb '{}'\n", quoted(label), x, y, how, colour);
  };
  const auto first = [](double value) { return "first " + exact(value); };
  for (const EndName& name : names_at_ends(plot, around.along_y))
    add(name.text, "graph 1", first(around.along_y.at(name.place)), "left offset 1, 0", name.colour);
  // The first place in which nothing is drawn, or the first of all.
  struct NamePlace {
    Box box;
    std::string x, y, how;
  };
  const auto add_name = [&](const std::string& label, const std::vector<NamePlace>& places) {
    const auto free =
        std::ranges::find_if(places, [&](const NamePlace& each) { return around.is_free(each.box); });
    const NamePlace& place = free == places.end() ? places.front() : *free;
    add(label, place.x, place.y, place.how);
  };
  for (const Line& line : plot.horizontal_lines) {
    const double length = letter * static_cast<double>(display_width(line.label)), y = around.y(line.at);
    std::vector<NamePlace> places;
    for (const auto& [low, offset] : {std::pair{y + 0.1 * line_height, 0.6}, {y - 1.1 * line_height, -0.7}}) {
      places.push_back({{0.01, 0.01 + length, low, low + line_height},
                        "graph 0.01",
                        first(line.at),
                        fmt::format("left offset 0, {}", offset)});
      places.push_back({{0.99 - length, 0.99, low, low + line_height},
                        "graph 0.99",
                        first(line.at),
                        fmt::format("right offset 0, {}", offset)});
    }
    add_name(line.label, places);
  }
  for (const Line& line : plot.vertical_lines) {
    const double length = letter * static_cast<double>(display_width(line.label)), x = around.x(line.at);
    std::vector<NamePlace> places;
    for (double y = 0.97; y > line_height; y -= line_height) {
      const double low = y - 0.5 * line_height, high = y + 0.5 * line_height;
      places.push_back({{x + letter, x + letter + length, low, high},
                        first(line.at),
                        "graph " + exact(y),
                        "left offset 0.8, 0"});
      places.push_back({{x - letter - length, x - letter, low, high},
                        first(line.at),
                        "graph " + exact(y),
                        "right offset -0.8, 0"});
      if (!(x < 0.5)) std::swap(places[places.size() - 2], places.back());
    }
    add_name(line.label, places);
  }
  return text + fmt::format("set rmargin {}\n", right_margin(width));
}

}  // namespace launchsafe::report
