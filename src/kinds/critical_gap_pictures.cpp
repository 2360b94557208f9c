// The pictures of a critical-gap study that varies something: the critical gap over one or two axes.
#include "launchsafe/kinds/critical_gap.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {

using report::Scale;

namespace {

constexpr std::size_t most_pictures = 9, most_lines = 6;

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

/// Tics at the values themselves, where these are few and stand far enough apart to be read.
std::vector<report::Tic> tics_at(const std::vector<double>& values, Scale scale) {
  constexpr std::size_t most = 12;
  constexpr double least_share = 0.07;
  const auto place = [scale](double value) { return scale == Scale::linear ? value : std::log10(value); };
  if (values.size() > most) return {};
  const double whole = place(values.back()) - place(values.front());
  std::vector<report::Tic> tics;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0 && place(values[i]) - place(values[i - 1]) < least_share * whole) return {};
    tics.push_back({values[i], report::significant(values[i], 6)});
  }
  return tics;
}

report::PlotAxis picture_axis(const SweptAxis& swept) {
  report::PlotAxis axis;
  axis.label = swept.key.label();
  if (swept.values.front() > 0 && swept.values.back() > 10.0 * swept.values.front())
    axis.scale = Scale::logarithmic;
  axis.tics = tics_at(swept.values, axis.scale);
  return axis;
}

/// ", flaw size 1 mm": with the values of the axes that the picture does not show.
std::string title_of(const std::vector<SweptAxis>& axes, const std::vector<std::size_t>& shown_axes,
                     const StudyCase& input) {
  std::string fixed;
  for (const SweptAxis& axis : axes) {
    const bool is_shown = std::ranges::find(shown_axes, axis.index) != shown_axes.end();
    if (is_shown || axis.index >= input.coordinates.size()) continue;
    fixed += fmt::format(", {} {}", axis.key.heading, axis.key.text(input.coordinates[axis.index]));
  }
  return fixed;
}

// --- marks ---

/// What a bound of one kind says, if all of them say the same.
std::string bound_label(const std::vector<CaseAnswer>& answers, CriticalGapKind kind,
                        const std::string& otherwise) {
  std::string label;
  for (const CaseAnswer& answer : answers) {
    if (answer.critical.kind != kind) continue;
    const std::string text = reads_as(answer.critical);
    if (!label.empty() && text != label) return otherwise;
    label = text;
  }
  return label;
}

/// Critical gaps that are no values as marks along an axis, one series for every kind, in a colour that no
/// line has. `answers`: all that the picture will have, which decide the labels.
std::map<CriticalGapKind, Series> marks_for(const std::vector<CaseAnswer>& answers) {
  using enum CriticalGapKind;
  const auto mark = [](std::string label, Mark look) {
    return Series{.label = std::move(label), .style = Style::points, .colour = 6, .mark = look};
  };
  const auto bound = [&](CriticalGapKind kind, const char* otherwise) {
    return bound_label(answers, kind, otherwise) + " (bound)";
  };
  return {{all_safe, mark(bound(all_safe, "above the searched gaps"), Mark::up_triangle)},
          {all_ignite, mark(bound(all_ignite, "ignites at every gap"), Mark::down_triangle)},
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

/// Critical gaps along one axis with their lower bounds; where there is another axis, for some of its values.
struct GapLines {
  const CriticalGapResult& result;
  Plot plot;
  const SweptAxis& along;
  const SweptAxis* across;
  std::vector<double> values_across = across == nullptr ? std::vector{0.0} : some_of(across->values);
  std::vector<Series> values = {}, lower_bounds = {};             ///< a line each
  std::set<std::pair<std::size_t, std::size_t>> assumed_at = {};  ///< of which line, at which value
  Series assumed = {.style = Style::points, .colour = 7, .mark = Mark::open_circle};
  Series recorded = {
      .label = "nothing assumed", .style = Style::points, .colour = 7, .mark = Mark::open_square};
  study::AssumedShares shares = {};  ///< of any that is `assumed`
  std::map<CriticalGapKind, Series> marks = marks_for(result.answers);
  std::map<CriticalGapKind, std::set<double>> marked = {};  ///< values across, of which each mark is
  std::int64_t unknown = 0;
  double lowest = HUGE_VAL, highest = 0.0;  ///< cm, of all that is drawn but lower bounds
  double least_uncertainty = HUGE_VAL;      ///< cm, of all values

  void begin() {
    const std::vector<double> nothing(along.values.size(), not_a_number);
    for (int i = 0; i < static_cast<int>(values_across.size());) {
      values.push_back({.x = along.values, .y = nothing, .colour = i++});
      lower_bounds.emplace_back(values.back()).style = Style::dashed_line;
    }
  }

  void add(const StudyCase& input, const CaseAnswer& answer) {
    const double of = across == nullptr ? 0.0 : across->key.value(input.coordinates[across->index]);
    const std::size_t line = place_in(values_across, of);
    if (line == values_across.size() || values_across[line] != of) return;
    const CriticalGap& gap = answer.critical;
    const double x = along.key.value(input.coordinates[along.index]);
    const CriticalGapKind kind = gap.kind;
    const bool broken = kind == CriticalGapKind::value && !std::isfinite(gap.value);
    if (broken || kind == CriticalGapKind::indeterminate) {
      ++unknown;
      return;
    }
    // A bound stands at its end.
    const double drawn = shown_gap(kind == CriticalGapKind::value        ? gap.value
                                   : kind == CriticalGapKind::all_ignite ? gap.upper
                                                                         : gap.lower);
    lowest = std::min(lowest, drawn);
    highest = std::max(highest, drawn);
    const double lower = kind == CriticalGapKind::value ? shown_gap(gap.bounds.at_least) : not_a_number;
    const std::size_t place = place_in(along.values, x);
    if (const auto own = assumed_shares(result.study.study, input, gap.value); own.any()) {
      assumed.add(x, std::isfinite(lower) ? lower : drawn);
      assumed_at.insert({line, place});
      shares = {shares.computation || own.computation, shares.model_form || own.model_form};
    } else if (std::isfinite(lower)) {
      recorded.add(x, lower);
    }
    if (kind != CriticalGapKind::value) {
      marks.at(kind).add(x, drawn);
      marked[kind].insert(of);
      return;
    }
    values[line].y[place] = drawn;
    least_uncertainty = std::min(least_uncertainty, std::isfinite(lower) ? drawn - lower : 0.0);
    if (std::isfinite(lower)) lower_bounds[line].y[place] = lower;
  }

  /// Values on lines of two and more; none where all differ by less than the best of them is known to.
  std::size_t joined() const {
    std::size_t joined = 0;
    if (highest - lowest < least_uncertainty) return joined;
    for (const Series& line : values)
      if (const std::size_t known = known_of(line); known > 1) joined += known;
    return joined;
  }

  Plot drawn() {
    plot.title = finding() + plot.title;
    // No dashes where a share begins or ends to be assumed: that step says nothing of the launches.
    std::vector<Series> assumed_bounds = lower_bounds;
    for (std::size_t line = 0; line < lower_bounds.size(); ++line)
      for (std::size_t place = 0; place < along.values.size(); ++place)
        (assumed_at.contains({line, place}) ? lower_bounds : assumed_bounds)[line].y[place] = not_a_number;
    const std::string value = across == nullptr ? "critical gap" : across->key.heading + " ",
                      bound = across == nullptr ? "" : "at least ";
    for (const auto& [lines, name] :
         {std::pair{&values, value}, {&assumed_bounds, bound}, {&lower_bounds, bound}})
      for (Series& line : joined_alike(*lines, name)) plot.series.push_back(std::move(line));
    assumed.label =
        (shares.computation && shares.model_form ? "computation or model form" : shares.text()) + " assumed";
    for (Series* bounds : {&assumed, &recorded})
      if (!bounds->x.empty()) plot.series.push_back(std::move(*bounds));
    plot.subtitle = across == nullptr ? "dashed: its lower bound" : "dashed: the lower bound of each";
    if (unknown > 0)
      plot.subtitle +=
          fmt::format("; not drawn: {} indeterminate or failed", report::counted(unknown, "case"));
    for (auto& [kind, series] : marks) {
      if (series.x.empty()) continue;
      if (marked[kind].size() < values_across.size())
        series.label = text_of(marked[kind]) + ": " + series.label;
      if (marked[kind].size() == 1) series.colour = place_in(values_across, *marked[kind].begin());
      plot.series.push_back(std::move(series));
    }
    return std::move(plot);
  }

  /// "30, 120 µm"; empty without another axis.
  std::string text_of(const std::set<double>& shown) const {
    if (across == nullptr) return {};
    const auto number = [](double value) { return report::significant(value, 6); };
    return fmt::format("{}{}{}", fmt::join(of_each(shown, number), ", "),
                       across->key.form.unit.empty() ? "" : " ", across->key.form.unit);
  }

  /// Lines that lie on each other are one, with the names of all.
  std::vector<Series> joined_alike(const std::vector<Series>& lines, const std::string& what) const {
    const auto is_near = [seen = 0.008 * highest](double a, double b) {
      return std::isfinite(a) == std::isfinite(b) && !(std::abs(a - b) > seen);
    };
    std::vector<Series> joined;
    std::vector<std::set<double>> names;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto like = std::ranges::find_if(joined, [&](const Series& each) {
        return known_of(each) > 0 && std::ranges::equal(each.y, lines[i].y, is_near);
      });
      const auto place = static_cast<std::size_t>(like - joined.begin());
      if (like == joined.end()) joined.push_back(lines[i]), names.emplace_back();
      names[place].insert(values_across[i]);
      joined[place].label = what + text_of(names[place]);
    }
    return joined;
  }

  static std::size_t known_of(const Series& line) {
    return static_cast<std::size_t>(std::ranges::count_if(line.y, [](double y) { return std::isfinite(y); }));
  }

  /// "Critical gap at 30 µm: 0.09 to 0.02 cm, at least 0.03 cm at 250 MPa, 0 cm from 500 MPa
  /// on": the lowest of the bounds that have most values.
  std::string finding() const {
    const std::size_t best = study::places_by(values.size(), [&](std::size_t i) {
                               return std::tuple(-static_cast<double>(known_of(lower_bounds[i])),
                                                 sum_of(lower_bounds[i]), sum_of(values[i]));
                             }).front();
    const Series& line = lower_bounds[best];
    std::vector<std::size_t> known;
    for (std::size_t i = 0; i < line.y.size(); ++i)
      if (std::isfinite(line.y[i])) known.push_back(i);
    // Also where the study looks at gaps that close: they have bounds of their own.
    std::string what = "Critical gap by a reservoir of air";
    if (across != nullptr) what += " at " + text_of({values_across[best]});
    if (known.empty()) return what + ": no lower bound is known";
    what += fmt::format(": {} to {} cm, ", report::significant(values[best].y[known.front()], 2),
                        report::significant(values[best].y[known.back()], 2));
    const auto text = [&](std::size_t place) {
      return report::significant(report::rounded_down(line.y[known[place]], 4), 3) + " cm";
    };
    const auto at = [&](std::size_t place) {
      return report::significant(line.x[known[place]], 6) + " " + along.key.form.unit;
    };
    std::size_t last = known.size() - 1;
    while (last > 0 && text(last - 1) == text(last)) --last;
    const bool stays = last + 1 < known.size();
    if (last == 0)
      return fmt::format("{}at least {} from {} to {}", what, text(0), at(0), at(known.size() - 1));
    return fmt::format("{}at least {} at {}, {} {} {}{}", what, text(0), at(0), text(last),
                       stays ? "from" : "at", at(last), stays ? " on" : "");
  }

  static double sum_of(const Series& line) {
    double sum = 0.0;
    for (const double y : line.y) sum += std::isfinite(y) ? y : 0.0;
    return sum;
  }
};

struct Drawn {
  const SweptAxis* across = nullptr;
  std::vector<Plot> plots = {};
  std::size_t joined = 0;  ///< values that their lines join
};

/// A picture for every combination of the other axes, in the order of the cases, where a line joins values.
Drawn plots_of(const CriticalGapResult& result, const std::vector<SweptAxis>& axes, const SweptAxis& along,
               const SweptAxis* across) {
  std::vector<std::size_t> shown{along.index};
  if (across != nullptr) shown.push_back(across->index);
  std::map<std::vector<double>, std::size_t> combinations;  // their places among the lines
  std::vector<GapLines> lines;
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const StudyCase& input = result.study.cases[i];
    if (input.coordinates.size() < axes.size()) continue;
    std::vector<double> others = input.coordinates;
    for (const std::size_t axis : shown) others[axis] = 0;
    const auto [place, is_new] = combinations.try_emplace(std::move(others), lines.size());
    if (is_new) {
      lines.push_back({result,
                       {.title = title_of(axes, shown, input),
                        .x = picture_axis(along),
                        .y = {.label = report::quantity::critical_gap.label(), .minimum = 0.0},
                        .width = 1000,
                        .height = 620,
                        .named_in_place = true},
                       along,
                       across});
      lines.back().begin();
    }
    lines[place->second].add(input, result.answers[i]);
  }
  Drawn drawn{across};
  for (GapLines& each : lines)
    if (const std::size_t joined = each.joined(); joined > 0) {
      drawn.joined += joined;
      drawn.plots.push_back(each.drawn());
    }
  return drawn;
}

/// Along the longer of the first two axes, a line for each value of the other; where no line joins values,
/// along the axes that join most.
Drawn most_joined(const CriticalGapResult& result, const std::vector<SweptAxis>& axes,
                  std::vector<const SweptAxis*> several) {
  if (several.size() == 1) return plots_of(result, axes, *several[0], nullptr);
  if (several[1]->values.size() > several[0]->values.size()) std::swap(several[0], several[1]);
  Drawn most = plots_of(result, axes, *several[0], several[1]);
  if (most.joined > 0) return most;
  for (const SweptAxis* along : several)
    for (const SweptAxis* across : several) {
      if (along == across) continue;
      Drawn drawn = plots_of(result, axes, *along, across);
      if (drawn.joined > most.joined ||
          (drawn.joined == most.joined && drawn.plots.size() < most.plots.size()))
        most = std::move(drawn);
    }
  return most;
}

}  // namespace

GapPictures gap_pictures(const CriticalGapResult& result) {
  const std::vector<SweptAxis> axes = swept_axes(result.study.study);
  std::vector<const SweptAxis*> several;
  for (const SweptAxis& axis : axes)
    if (axis.values.size() > 1) several.push_back(&axis);
  if (several.empty() || result.answers.empty()) return {};
  auto [across, plots, joined] = most_joined(result, axes, several);
  GapPictures made;
  if (plots.size() > most_pictures)
    made.remarks.push_back(fmt::format(
        "The pictures show {} of the {} combinations of the other axes; critical_gaps.csv has all.",
        most_pictures, plots.size()));
  if (across != nullptr && across->values.size() > most_lines)
    made.remarks.push_back(
        fmt::format("The pictures have lines for {} of {} values of {}; critical_gaps.csv has all.",
                    most_lines, across->values.size(), across->key.heading));
  for (std::size_t i = 0; i < std::min(plots.size(), most_pictures); ++i) {
    std::string shows = plots[i].title;
    made.pictures.push_back({fmt::format("critical_gap{}.svg", i == 0 ? "" : fmt::format("_{}", i + 1)),
                             std::move(plots[i]), std::move(shows)});
  }
  return made;
}

}  // namespace launchsafe::kinds
