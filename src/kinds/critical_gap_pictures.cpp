// The pictures of a critical-gap study that varies something: the critical gap over one or two axes.
#include "answer_tables.hpp"
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "launchsafe/study/case_uncertainty.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

constexpr std::size_t most_maps = 9;
/// What the pictures show, for who cannot see them.
constexpr const char* picture_text = "critical gap";

/// An axis of the study with its values in the unit shown, ascending, each once.
struct SweptAxis {
  std::size_t index;  ///< among the study's axes
  ShownKey key;
  std::vector<double> values;
};

std::vector<SweptAxis> swept_axes(const study::Study& study) {
  std::vector<SweptAxis> axes;
  for (std::size_t i = 0; i < study.axes.size(); ++i) {
    SweptAxis axis{i, shown(study.axes[i]), {}};
    for (const double value : study.axes[i].values) axis.values.push_back(axis.key.value(value));
    std::sort(axis.values.begin(), axis.values.end());
    axis.values.erase(std::unique(axis.values.begin(), axis.values.end()), axis.values.end());
    axes.push_back(std::move(axis));
  }
  return axes;
}

/// Tics at the values themselves, where these are few and stand far enough apart to be read.
std::vector<Tic> tics_at(const std::vector<double>& values, Scale scale) {
  constexpr std::size_t most = 12;
  constexpr double least_share = 0.07;
  const auto place = [scale](double value) { return scale == Scale::linear ? value : std::log10(value); };
  if (values.size() > most) return {};
  const double whole = place(values.back()) - place(values.front());
  std::vector<Tic> tics;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0 && place(values[i]) - place(values[i - 1]) < least_share * whole) return {};
    tics.push_back({values[i], report::significant(values[i], 6)});
  }
  return tics;
}

PlotAxis picture_axis(const SweptAxis& swept) {
  PlotAxis axis;
  axis.label = swept.key.label();
  if (swept.values.front() > 0 && swept.values.back() > 10.0 * swept.values.front())
    axis.scale = Scale::logarithmic;
  axis.tics = tics_at(swept.values, axis.scale);
  return axis;
}

/// "Critical gap at flaw size 1 mm": with the values of the axes that the picture does not show.
std::string title_of(const char* quantity, const std::vector<SweptAxis>& axes,
                     const std::vector<std::size_t>& shown_axes, const study::StudyCase& input) {
  std::string fixed;
  for (const SweptAxis& axis : axes) {
    const bool is_shown = std::find(shown_axes.begin(), shown_axes.end(), axis.index) != shown_axes.end();
    if (is_shown || axis.index >= input.coordinates.size()) continue;
    fixed += fmt::format("{}{} {}", fixed.empty() ? " at " : ", ", axis.key.heading,
                         axis.key.text(input.coordinates[axis.index]));
  }
  return quantity + fixed;
}

/// The critical gap as shown.
double shown_critical_gap(const CaseAnswer& answer) { return shown_gap(value_of(answer.critical)); }

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

/// What the marks of every kind mean, in the order of CriticalGapKind.
std::array<std::string, 5> kind_labels(const std::vector<CaseAnswer>& answers) {
  return {"computed value",
          bound_label(answers, CriticalGapKind::all_safe, "above the searched gaps") + " (bound)",
          bound_label(answers, CriticalGapKind::all_ignite, "ignites at every gap") + " (bound)",
          "indeterminate or failed", "the first of several crossings"};
}

/// The kind as it is drawn: a value that is not finite is none.
CriticalGapKind drawn_kind(const CriticalGap& gap) {
  const bool broken = gap.kind == CriticalGapKind::value && !std::isfinite(gap.value);
  return broken ? CriticalGapKind::indeterminate : gap.kind;
}

/// Where a gap stands, as shown: a bound at its end, what is not known at 0.
double position_of(const CriticalGap& gap) {
  switch (drawn_kind(gap)) {
    case CriticalGapKind::value:
      return shown_gap(gap.value);
    case CriticalGapKind::all_safe:
    case CriticalGapKind::several_crossings:
      return shown_gap(gap.lower);
    case CriticalGapKind::all_ignite:
      return shown_gap(gap.upper);
    case CriticalGapKind::indeterminate:
      break;
  }
  return 0;
}

/// One mark and colour for every kind, in the order of CriticalGapKind.
constexpr std::array<Mark, 5> kind_marks{Mark::circle, Mark::up_triangle, Mark::down_triangle, Mark::cross,
                                         Mark::diamond};
constexpr std::array<int, 5> kind_colours{0, 2, 1, 7, 3};

/// Critical gaps as marks along an axis, one series for every kind: values with their bounds, bounds as
/// bounds.
class GapMarks {
 public:
  /// `answers`: all that the picture will have, which decide the labels.
  explicit GapMarks(const std::vector<CaseAnswer>& answers) {
    const auto labels = kind_labels(answers);
    for (std::size_t kind = 0; kind < labels.size(); ++kind) {
      series_.push_back({labels[kind], {}, {}, kind == 0 ? Style::vertical_bars : Style::points});
      series_.back().colour = kind_colours[kind];
      series_.back().mark = kind_marks[kind];
    }
  }

  /// `place`: on the axis.
  void add(const CriticalGap& gap, double place) {
    Series& series = series_[static_cast<std::size_t>(drawn_kind(gap))];
    const double position = position_of(gap);
    const auto bound = [&](double of_gap) {
      const bool known = drawn_kind(gap) == CriticalGapKind::value && std::isfinite(of_gap);
      return known ? shown_gap(of_gap) : position;
    };
    series.add(place, position, bound(gap.bounds.at_least), bound(gap.bounds.at_most));
  }

  /// The kinds that occur.
  void put_into(Plot& plot) {
    for (Series& series : series_)
      if (!series.x.empty()) plot.series.push_back(std::move(series));
  }

 private:
  std::vector<Series> series_;
};

// --- maps ---

/// What a map shows: NaN where there is no value, for which the kind of the answer is the reason, or else
/// `without_value`.
struct MappedQuantity {
  const char* file;  ///< start of its name
  const char* title;
  double (*value)(const CaseAnswer&);
  const char* without_value;
};
constexpr MappedQuantity critical_gap{"critical_gap", "Critical gap", shown_critical_gap, "not known"};

/// Up to which gap nothing ignites in spite of the uncertainty; NaN where there is no such gap.
double surely_safe(const CaseAnswer& answer) {
  const double least = shown_gap(answer.critical.bounds.at_least);
  return answer.critical.kind == CriticalGapKind::value && least > 0.0 ? least : study::not_a_number;
}
/// By which the critical gap may be smaller.
double uncertainty_of(const CaseAnswer& answer) {
  return shown_critical_gap(answer) - shown_gap(answer.critical.bounds.at_least);
}
constexpr MappedQuantity safe_gap{"safe_gap", "Lower bound of the critical gap", surely_safe,
                                  "no gap surely safe"};

std::size_t place_in(const std::vector<double>& values, double value) {
  return static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), value) - values.begin());
}

/// The map of a case's plane, without values.
Plot empty_map(const CriticalGapResult& result, const std::vector<SweptAxis>& axes, const SweptAxis& x,
               const SweptAxis& y, const MappedQuantity& mapped, const study::StudyCase& input) {
  Plot plot;
  plot.title = title_of(mapped.title, axes, {x.index, y.index}, input);
  plot.x = picture_axis(x);
  plot.y = picture_axis(y);
  plot.width = 900;
  plot.height = 620;
  Map map;
  map.x = x.values;
  map.y = y.values;
  map.values.assign(x.values.size() * y.values.size(), study::not_a_number);
  map.label = quantity::critical_gap().label();
  if (mapped.value == surely_safe) map.label = "lower bound of the " + map.label;
  if (mapped.value == shown_critical_gap) map.uncertainty = map.values;
  for (const CaseAnswer& answer : result.answers) {  // of all maps, so that their colours compare
    const double value = mapped.value(answer);
    if (!std::isfinite(value)) continue;
    map.minimum = std::min(map.minimum.value_or(value), value);
    map.maximum = std::max(map.maximum.value_or(value), value);
    const double uncertainty = uncertainty_of(answer);
    if (std::isfinite(uncertainty)) map.least_step = std::max(map.least_step, uncertainty);
  }
  auto labels = kind_labels(result.answers);
  labels[static_cast<std::size_t>(CriticalGapKind::value)] = mapped.without_value;
  constexpr std::array<Hatching, 5> hatchings{Hatching::rising, Hatching::dense, Hatching::falling,
                                              Hatching::crossed, Hatching::crossed};
  for (std::size_t kind = 0; kind < labels.size(); ++kind)
    map.hatched.push_back({labels[kind], hatchings[kind], {}});
  if (mapped.value == surely_safe)
    map.hatched.push_back({"computation or model form assumed", Hatching::falling, {}});
  plot.map = std::move(map);
  return plot;
}

/// One map over two axes for every combination of the others.
std::vector<Plot> maps_of(const CriticalGapResult& result, const std::vector<SweptAxis>& axes,
                          const SweptAxis& x, const SweptAxis& y, const MappedQuantity& mapped) {
  std::vector<std::vector<double>> combinations;
  std::vector<Plot> plots;
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const study::StudyCase& input = result.study.cases[i];
    if (input.coordinates.size() < axes.size()) continue;
    std::vector<double> others = input.coordinates;
    others[x.index] = others[y.index] = 0;
    const auto found = std::find(combinations.begin(), combinations.end(), others);
    const auto number = static_cast<std::size_t>(found - combinations.begin());
    if (found == combinations.end()) {
      combinations.push_back(std::move(others));
      plots.push_back(empty_map(result, axes, x, y, mapped, input));
    }
    Map& map = *plots[number].map;
    const std::size_t cell = place_in(y.values, y.key.value(input.coordinates[y.index])) * x.values.size() +
                             place_in(x.values, x.key.value(input.coordinates[x.index]));
    map.values[cell] = mapped.value(result.answers[i]);
    if (!map.uncertainty.empty()) map.uncertainty[cell] = uncertainty_of(result.answers[i]);
    const CriticalGap& gap = result.answers[i].critical;
    if (mapped.value == surely_safe && std::isfinite(map.values[cell]) &&
        !assumed_shares(result.study.study, input, gap.value).empty())
      map.hatched.back().cells.push_back(cell);
    if (!std::isfinite(map.values[cell]))
      map.hatched[static_cast<std::size_t>(drawn_kind(result.answers[i].critical))].cells.push_back(cell);
  }
  return plots;
}

/// Names the maps, and leaves out what would be too many.
void add_maps(std::vector<Plot> plots, const MappedQuantity& mapped, GapPictures& made) {
  for (std::size_t i = 0; i < std::min(plots.size(), most_maps); ++i) {
    made.pictures.push_back({fmt::format("{}{}.svg", mapped.file, i == 0 ? "" : fmt::format("_{}", i + 1)),
                             std::move(plots[i]), picture_text});
  }
}

// --- one axis ---

Plot curve_of(const CriticalGapResult& result, const std::vector<SweptAxis>& axes, const SweptAxis& axis) {
  Plot plot;
  plot.x = picture_axis(axis);
  plot.y.label = quantity::critical_gap().label();
  Series line{"", axis.values, std::vector<double>(axis.values.size(), study::not_a_number), Style::line};
  line.colour = 0;
  GapMarks marks(result.answers);
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const study::StudyCase& input = result.study.cases[i];
    if (input.coordinates.size() < axes.size()) continue;
    if (plot.title.empty()) plot.title = title_of(critical_gap.title, axes, {axis.index}, input);
    const CaseAnswer& answer = result.answers[i];
    const double x = axis.key.value(input.coordinates[axis.index]);
    line.y[place_in(axis.values, x)] = shown_critical_gap(answer);
    marks.add(answer.critical, x);
  }
  plot.series.push_back(std::move(line));
  marks.put_into(plot);
  return plot;
}

}  // namespace

GapPictures gap_pictures(const CriticalGapResult& result) {
  const std::vector<SweptAxis> axes = swept_axes(result.study.study);
  std::vector<const SweptAxis*> several;
  for (const SweptAxis& axis : axes) {
    if (axis.values.size() > 1) several.push_back(&axis);
  }
  if (several.empty() || result.answers.empty()) return {};
  if (several.size() == 1)
    return {{{"critical_gap.svg", curve_of(result, axes, *several.front()), picture_text}}, {}};
  GapPictures made;
  for (const MappedQuantity* mapped : {&critical_gap, &safe_gap}) {
    std::vector<Plot> maps = maps_of(result, axes, *several[0], *several[1], *mapped);
    if (maps.size() > most_maps && made.remarks.empty()) {
      made.remarks.push_back(fmt::format(
          "The pictures show {} of the {} combinations of the other axes; critical_gaps.csv has all.",
          most_maps, maps.size()));
    }
    add_maps(std::move(maps), *mapped, made);
  }
  return made;
}

}  // namespace launchsafe::kinds
