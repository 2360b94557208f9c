// The picture of a critical-gap study that varies something: the critical gap over one or two axes.
#include "launchsafe/kinds/critical_gap.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {

using report::Scale;

namespace {

constexpr std::size_t most_lines = 6;

/// An axis of the study with its values in the unit shown, ascending, each once.
struct SweptAxis {
  std::size_t index;  ///< among the study's axes
  ShownKey key;
  std::vector<double> values;
};

std::vector<SweptAxis> swept_axes(const Study& study) {
  std::vector<SweptAxis> axes;
  for (const Axis& each : study.axes) {
    SweptAxis& axis = axes.emplace_back(SweptAxis{axes.size(), report::shown(each), {}});
    axis.key.heading = report::plain_words(axis.key.heading);
    axis.values = of_each(each.values, [&](double value) { return axis.key.value(value); });
    std::ranges::sort(axis.values);
    axis.values.erase(std::unique(axis.values.begin(), axis.values.end()), axis.values.end());
  }
  return axes;
}

report::PlotAxis picture_axis(const SweptAxis& swept) {
  report::PlotAxis axis;
  axis.label = swept.key.label();
  if (swept.values.front() > 0 && swept.values.back() > 10.0 * swept.values.front())
    axis.scale = Scale::logarithmic;
  return axis;
}

/// ", flaw size 1 mm": with the axes of a single value.
std::string title_of(const std::vector<SweptAxis>& axes, const Study& study) {
  std::string fixed;
  for (const SweptAxis& axis : axes)
    if (axis.values.size() == 1)
      fixed += fmt::format(", {} {}", axis.key.heading, axis.key.text(study.axes[axis.index].values.front()));
  return fixed;
}

// --- marks ---

/// Critical gaps that are no values as marks along an axis, one series for every kind, in a colour that no
/// line has.
std::map<CriticalGapKind, Series> all_marks() {
  using enum CriticalGapKind;
  const auto mark = [](const char* label, Mark look) {
    return Series{.label = label, .style = Style::points, .colour = 6, .mark = look};
  };
  return {{all_safe, mark("no ignition up to here", Mark::up_triangle)},
          {all_ignite, mark("ignites at every gap", Mark::down_triangle)},
          {several_crossings, mark("the first of several crossings", Mark::diamond)}};
}

// --- lines ---

std::size_t place_in(const std::vector<double>& values, double value) {
  return static_cast<std::size_t>(std::ranges::lower_bound(values, value) - values.begin());
}

/// So many of the values that lines can be told apart, evenly, the first and the last among them.
std::vector<double> some_of(const std::vector<double>& values) {
  if (values.size() <= most_lines) return values;
  std::vector<double> some;
  for (std::size_t i = 0; i < most_lines; ++i)
    some.push_back(values[i * (values.size() - 1) / (most_lines - 1)]);
  return some;
}

/// A line for each value of `across`, if there is one, and for its lower bound.
Plot plot_of(const CriticalGapResult& result, const std::vector<SweptAxis>& axes, const SweptAxis& along,
             const SweptAxis* across) {
  const std::vector<double> values = across == nullptr ? std::vector{0.0} : some_of(across->values);
  Plot plot{
      .title = fmt::format("Critical gap over {}{}", along.key.heading, title_of(axes, result.study.study)),
      .x = picture_axis(along),
      .y = {.label = report::quantity::critical_gap.label(), .minimum = 0.0},
      .width = 1000,
      .height = 620};
  const std::vector<double> none(along.values.size(), not_a_number);
  for (const bool bound : {false, true})
    for (std::size_t line = 0; line < values.size(); ++line) {
      const std::string name = bound               ? "lower bound"
                               : across == nullptr ? "critical gap"
                                                   : across->key.heading;
      const std::string of = across == nullptr ? ""
                                               : fmt::format(" {} {}", report::significant(values[line], 6),
                                                             across->key.form.unit);
      plot.series.push_back({.label = name + (bound && across != nullptr ? "," : "") + of,
                             .x = along.values,
                             .y = none,
                             .style = bound ? Style::dashed_line : Style::line_and_points,
                             .colour = static_cast<int>(line),
                             .mark = Mark::circle});
    }
  std::map<CriticalGapKind, Series> marks = all_marks();
  std::int64_t unknown = 0;
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const StudyCase& input = result.study.cases[i];
    if (input.coordinates.size() < axes.size()) continue;
    const double of = across == nullptr ? 0.0 : across->key.value(input.coordinates[across->index]);
    const std::size_t line = place_in(values, of);
    if (line == values.size() || values[line] != of) continue;
    const CriticalGap& gap = result.rows[i].critical;
    const double x = along.key.value(input.coordinates[along.index]);
    if (const auto mark = marks.find(gap.kind); mark != marks.end()) {
      mark->second.add(x, shown_gap(gap.value));
    } else if (const double value = report::value_of(gap); std::isfinite(value)) {
      const std::size_t place = place_in(along.values, x);
      plot.series[line].y[place] = shown_gap(value);
      plot.series[values.size() + line].y[place] = shown_gap(result.rows[i].bounds.at_least);
    } else {
      ++unknown;
    }
  }
  for (auto& [kind, series] : marks)
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  if (across != nullptr && across->values.size() > values.size())
    plot.subtitle = fmt::format("{} of {} values of {}; critical_gaps.csv has all", values.size(),
                                across->values.size(), across->key.heading);
  if (unknown > 0)
    plot.subtitle += fmt::format("{}not drawn: {} without a critical gap", plot.subtitle.empty() ? "" : "; ",
                                 report::counted(unknown, "case"));
  return plot;
}

}  // namespace

std::optional<report::Picture> gap_picture(const CriticalGapResult& result) {
  const std::vector<SweptAxis> axes = swept_axes(result.study.study);
  std::vector<const SweptAxis*> several;
  for (const SweptAxis& axis : axes)
    if (axis.values.size() > 1) several.push_back(&axis);
  if (several.empty() || several.size() > 2 || result.rows.empty()) return std::nullopt;
  const SweptAxis *along = several.front(), *across = several.size() == 1 ? nullptr : several.back();
  if (across != nullptr && across->values.size() > along->values.size()) std::swap(along, across);
  Plot plot = plot_of(result, axes, *along, across);
  const bool tells = std::ranges::any_of(plot.series, [](const Series& each) {
    return std::ranges::count_if(each.y, [](double y) { return std::isfinite(y); }) > 1;
  });
  if (!tells) return std::nullopt;
  std::string shows = plot.title;
  return report::Picture{"critical_gap.svg", std::move(plot), std::move(shows)};
}

}  // namespace launchsafe::kinds
