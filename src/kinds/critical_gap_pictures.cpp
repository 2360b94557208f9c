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

/// "30, 120 µm"; in the unit shown.
std::string numbers_text(const ShownKey& key, const std::vector<double>& shown) {
  const auto number = [](double value) { return report::significant(value, 6); };
  return fmt::format("{}{}{}", fmt::join(of_each(shown, number), ", "), key.form.unit.empty() ? "" : " ",
                     key.form.unit);
}

/// Lines that lie on each other, by their places among all.
using Alike = std::vector<std::size_t>;

/// Critical gaps along one axis with their lower bounds; where there is another axis, for some of its values.
struct GapLines {
  const CriticalGapResult& result;
  Plot plot;
  const SweptAxis& along;
  const SweptAxis* across;
  std::vector<double> values_across = across == nullptr ? std::vector{0.0} : some_of(across->values);
  std::vector<std::vector<double>> values{
      values_across.size(), std::vector<double>(along.values.size(), not_a_number)};  ///< cm, a line each
  std::vector<std::vector<double>> lower_bounds = values;                             ///< cm
  std::vector<std::vector<double>> assumed = values;  ///< 1 where a bound rests on an assumption, 0 where not
  study::AssumedShares shares = {};                   ///< of any bound that is drawn
  std::map<CriticalGapKind, Series> marks = all_marks();
  std::map<CriticalGapKind, std::set<std::size_t>> marked = {};  ///< lines, of which each mark is
  std::int64_t unknown = 0;
  double lowest = HUGE_VAL, highest = 0.0;  ///< cm, of all that is drawn but lower bounds
  double least_uncertainty = HUGE_VAL;      ///< cm, of all values

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
    if (kind != CriticalGapKind::value) {
      Series& mark = marks.at(kind);
      bool is_new = true;
      for (std::size_t i = 0; i < mark.x.size(); ++i) is_new &= mark.x[i] != x || mark.y[i] != drawn;
      if (is_new) mark.add(x, drawn);
      marked[kind].insert(line);
      return;
    }
    const std::size_t place = place_in(along.values, x);
    const double lower = shown_gap(gap.bounds.at_least);
    values[line][place] = drawn;
    least_uncertainty = std::min(least_uncertainty, std::isfinite(lower) ? drawn - lower : 0.0);
    if (!std::isfinite(lower)) return;
    lower_bounds[line][place] = lower;
    const auto own = assumed_shares(result.study.study, input, gap.value);
    assumed[line][place] = own.any() ? 1.0 : 0.0;
    if (lower > 0.0) shares = {shares.computation || own.computation, shares.model_form || own.model_form};
  }

  /// Whether a line joins two values, and they do not all differ by less than the best of them is known to.
  bool tells() const {
    return highest - lowest >= least_uncertainty &&
           std::ranges::any_of(values, [](const auto& line) { return known_of(line) > 1; });
  }

  Plot drawn() {
    Alike all;
    while (all.size() < values.size()) all.push_back(all.size());
    plot.title = finding(all) + plot.title;
    std::vector<Series> bounds;
    std::string unsafe;
    for (const Alike& group : alike(all, {&values})) {
      const int colour = static_cast<int>(group.front());
      plot.series.push_back(
          {.label = across == nullptr ? "critical gap" : across->key.heading + " " + text_of(group),
           .x = along.values,
           .y = values[group.front()],
           .colour = colour,
           .mark = Mark::circle});
      for (const Alike& each : alike(group, {&lower_bounds, &assumed})) {
        std::ranges::move(bounds_of(each, colour), std::back_inserter(bounds));
        if (const std::string where = nothing_safe(each); !where.empty())
          unsafe += (unsafe.empty() ? "nothing shown safe" : ",") + where;
      }
    }
    if (!bounds.empty()) plot.subtitle = "squares: lower bounds";
    const bool both = shares.computation && shares.model_form;
    if (shares.any())
      plot.subtitle +=
          fmt::format(", open where {} is assumed", both ? "computation or model form" : shares.text());
    add_to_subtitle(unsafe);
    if (unknown > 0)
      add_to_subtitle(fmt::format("not drawn: {} indeterminate or failed", report::counted(unknown, "case")));
    std::ranges::move(bounds, std::back_inserter(plot.series));
    for (auto& [kind, series] : marks) {
      if (series.x.empty()) continue;
      if (marked[kind].size() < values_across.size())
        series.label = text_of(marked[kind]) + ": " + series.label;
      if (marked[kind].size() == 1) series.colour = *marked[kind].begin();
      plot.series.push_back(std::move(series));
    }
    return std::move(plot);
  }

  void add_to_subtitle(const std::string& words) {
    if (!words.empty()) plot.subtitle += (plot.subtitle.empty() ? "" : "; ") + words;
  }

  /// A lower bound as dashes, its points open where something is assumed. What is 0 is not drawn.
  std::vector<Series> bounds_of(const Alike& group, int colour) const {
    const std::size_t line = group.front();
    Series dashes{.label = across == nullptr ? "lower bound" : "lower bound, " + text_of(group),
                  .style = Style::dashed_line,
                  .colour = colour};
    Series open{.style = Style::points, .colour = colour, .mark = Mark::open_square}, filled = open;
    filled.mark = Mark::square;
    for (std::size_t place = 0; place < along.values.size(); ++place) {
      const double x = along.values[place], bound = lower_bounds[line][place],
                   is_assumed = assumed[line][place];
      // No dashes where a share begins or ends to be assumed: that step says nothing of the launches.
      if (place > 0 && is_assumed + assumed[line][place - 1] == 1.0) dashes.add(x, not_a_number);
      dashes.add(x, bound > 0.0 ? bound : not_a_number);
      if (bound > 0.0) (is_assumed > 0.0 ? open : filled).add(x, bound);
    }
    std::vector<Series> made{dashes, open, filled};
    std::erase_if(made, [](const Series& each) { return known_of(each.y) == 0; });
    return made;
  }

  /// " at 120, 500 µm from 475 MPa on": where a lower bound is 0; empty where it is nowhere.
  std::string nothing_safe(const Alike& group) const {
    std::vector<std::size_t> known, zeros;
    for (std::size_t place = 0; place < along.values.size(); ++place) {
      const double bound = lower_bounds[group.front()][place];
      if (std::isfinite(bound)) known.push_back(place);
      if (bound == 0.0) zeros.push_back(place);
    }
    if (zeros.empty()) return {};
    const bool all = zeros.size() == known.size(),
               stays = zeros.front() == known[known.size() - zeros.size()];
    return fmt::format("{}{}", across == nullptr ? "" : " at " + text_of(group),
                       all     ? " at all"
                       : stays ? " from " + numbers_text(along.key, {along.values[zeros.front()]}) + " on"
                               : fmt::format(" at {} of {} values", zeros.size(), known.size()));
  }

  /// "30, 120 µm"; empty without another axis.
  std::string text_of(const auto& lines) const {
    if (across == nullptr) return {};
    return numbers_text(across->key, of_each(lines, [&](std::size_t line) { return values_across[line]; }));
  }

  /// Of some lines, those that are drawn as one; a bound of 0 is none that is drawn.
  std::vector<Alike> alike(const Alike& lines,
                           const std::vector<const std::vector<std::vector<double>>*>& in) const {
    const auto is_near = [seen = 0.008 * highest](double a, double b) {
      return (a > 0.0) == (b > 0.0) && std::isfinite(a) == std::isfinite(b) && !(std::abs(a - b) > seen);
    };
    std::vector<Alike> groups;
    for (const std::size_t line : lines) {
      const auto like = std::ranges::find_if(groups, [&](const Alike& group) {
        return std::ranges::all_of(in, [&](const auto* each) {
          return std::ranges::equal((*each)[group.front()], (*each)[line], is_near);
        });
      });
      (like == groups.end() ? groups.emplace_back() : *like).push_back(line);
    }
    return groups;
  }

  static std::size_t known_of(const std::vector<double>& line) {
    return static_cast<std::size_t>(std::ranges::count_if(line, [](double y) { return std::isfinite(y); }));
  }

  /// "Critical gap falls from 0.046 cm at 400 MPa to 0.018 cm at 550 MPa, initial temperature 336 K": the
  /// lowest of the lines that have most values.
  std::string finding(const Alike& all) const {
    const std::size_t best = study::places_by(values.size(), [&](std::size_t i) {
                               double sum = 0.0;
                               for (const double gap : values[i]) sum += std::isfinite(gap) ? gap : 0.0;
                               return std::tuple(-static_cast<double>(known_of(values[i])), sum);
                             }).front();
    const auto has_best = [best](const Alike& group) { return std::ranges::count(group, best) > 0; };
    const std::vector<Alike> groups = alike(all, {&values});
    const Alike& drawn_with = *std::ranges::find_if(groups, has_best);
    const std::vector<double>& line = values[drawn_with.front()];
    std::vector<double> known, at;
    for (std::size_t i = 0; i < along.values.size(); ++i)
      if (std::isfinite(line[i])) known.push_back(line[i]), at.push_back(along.values[i]);
    const char* how = std::ranges::is_sorted(known, std::greater()) ? "falls"
                      : std::ranges::is_sorted(known)               ? "rises"
                                                                    : "goes";
    const auto text = [&](double gap, double x) {
      return report::significant(gap, 2) + " cm at " + numbers_text(along.key, {x});
    };
    return fmt::format("Critical gap {} from {} to {}{}", how, text(known.front(), at.front()),
                       text(known.back(), at.back()),
                       across == nullptr ? "" : ", " + across->key.heading + " " + text_of(drawn_with));
  }
};

/// A line for each value of `across`, if there is one; nothing where no line joins two values.
std::optional<Plot> plot_of(const CriticalGapResult& result, const std::vector<SweptAxis>& axes,
                            const SweptAxis& along, const SweptAxis* across) {
  GapLines lines{result,
                 {.title = title_of(axes, result.study.study),
                  .x = picture_axis(along),
                  .y = {.label = report::quantity::critical_gap.label(), .minimum = 0.0},
                  .width = 1000,
                  .height = 620,
                  .named_in_place = true},
                 along,
                 across};
  for (std::size_t i = 0; i < result.answers.size(); ++i)
    if (const StudyCase& input = result.study.cases[i]; input.coordinates.size() >= axes.size())
      lines.add(input, result.answers[i]);
  return lines.tells() ? std::optional(lines.drawn()) : std::nullopt;
}

}  // namespace

GapPictures gap_pictures(const CriticalGapResult& result) {
  const std::vector<SweptAxis> axes = swept_axes(result.study.study);
  std::vector<const SweptAxis*> several;
  for (const SweptAxis& axis : axes)
    if (axis.values.size() > 1) several.push_back(&axis);
  if (several.empty() || several.size() > 2 || result.answers.empty()) return {};
  const SweptAxis *along = several.front(), *across = several.size() == 1 ? nullptr : several.back();
  if (across != nullptr && across->values.size() > along->values.size()) std::swap(along, across);
  std::optional<Plot> plot = plot_of(result, axes, *along, across);
  if (!plot && across != nullptr) {
    std::swap(along, across);
    plot = plot_of(result, axes, *along, across);
  }
  if (!plot) return {};
  GapPictures made;
  if (across != nullptr && across->values.size() > most_lines)
    made.remarks.push_back(
        fmt::format("The picture has lines for {} of {} values of {}; critical_gaps.csv has all.", most_lines,
                    across->values.size(), across->key.heading));
  std::string shows = plot->title;
  made.pictures.push_back({"critical_gap.svg", std::move(*plot), std::move(shows)});
  return made;
}

}  // namespace launchsafe::kinds
