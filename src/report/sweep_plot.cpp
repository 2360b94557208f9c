// The pictures of a sweep: the critical gap over one or two axes.
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/sweep_report.hpp"
#include "study_text.hpp"
#include "sweep_text.hpp"
#include "verdict_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace launchsafe::report {
namespace {

using detail::ShownKey;
using study::CaseAnswer, study::CriticalGapKind, study::SweepResult;

constexpr std::size_t most_maps = 9;

/// An axis of the sweep with its values in the unit shown, ascending, each once.
struct SweptAxis {
  std::size_t index;  ///< among the study's axes
  ShownKey key;
  std::vector<double> values;
};

std::vector<SweptAxis> swept_axes(const study::Study& study) {
  std::vector<SweptAxis> axes;
  for (std::size_t i = 0; i < study.axes.size(); ++i) {
    SweptAxis axis{i, detail::shown(study.axes[i]), {}};
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
    tics.push_back({values[i], significant(values[i], 6)});
  }
  return tics;
}

Axis picture_axis(const SweptAxis& swept) {
  Axis axis;
  axis.label = swept.key.heading();
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
    fixed += fmt::format("{}{} {}", fixed.empty() ? " at " : ", ", axis.key.name,
                         axis.key.text(input.coordinates[axis.index]));
  }
  return quantity + fixed;
}

// --- marks ---

/// One mark for every kind, in the order of CriticalGapKind.
constexpr std::array<Mark, 4> kind_marks{Mark::circle, Mark::up_triangle, Mark::down_triangle, Mark::cross};

/// What a bound of one kind says, if all of them say the same.
std::string bound_label(const SweepResult& result, CriticalGapKind kind, const std::string& otherwise) {
  std::string label;
  for (const CaseAnswer& answer : result.answers) {
    if (answer.critical.kind != kind) continue;
    const std::string text = detail::reads_as(answer.critical);
    if (!label.empty() && text != label) return otherwise;
    label = text;
  }
  return label;
}

std::array<std::string, 4> kind_labels(const SweepResult& result) {
  return {"computed value",
          bound_label(result, CriticalGapKind::all_safe, "above the searched gaps") + " (bound)",
          bound_label(result, CriticalGapKind::all_ignite, "ignites at every gap") + " (bound)",
          "indeterminate or failed"};
}

/// The kind as it is drawn: a value that is not finite is none.
CriticalGapKind drawn_kind(const CaseAnswer& answer) {
  const bool broken = answer.critical.kind == CriticalGapKind::value && !std::isfinite(answer.critical.value);
  return broken ? CriticalGapKind::indeterminate : answer.critical.kind;
}

double value_in_cm(const CaseAnswer& answer) { return 100.0 * detail::value_of(answer.critical); }

/// Up to which gap nothing ignites in spite of the uncertainty, cm; NaN where that is not known.
double surely_safe_in_cm(const CaseAnswer& answer) {
  if (answer.critical.kind == CriticalGapKind::all_ignite) return 0.0;
  const double least = value_in_cm(answer) - 100.0 * answer.critical.uncertainty;
  return least < 0.0 ? 0.0 : least;
}

/// What a map shows.
struct Mapped {
  const char* title;
  const char* label;
  double (*value)(const CaseAnswer&);
};
constexpr Mapped critical_gap_map{"Critical gap", "critical gap [cm]", value_in_cm};
constexpr Mapped surely_safe_map{"Critical gap less its uncertainty",
                                 "critical gap less its uncertainty [cm]", surely_safe_in_cm};

// --- maps ---

std::size_t place_in(const std::vector<double>& values, double value) {
  return static_cast<std::size_t>(std::lower_bound(values.begin(), values.end(), value) - values.begin());
}

class MapMaker {
 public:
  MapMaker(const SweepResult& result, const std::vector<SweptAxis>& axes, const SweptAxis& x,
           const SweptAxis& y, const Mapped& mapped)
      : result_(result), axes_(axes), x_(x), y_(y), mapped_(mapped) {
    std::vector<double> values;
    for (const CaseAnswer& answer : result.answers) values.push_back(mapped.value(answer));
    levels_ = contour_levels(values);  // of all maps, so that their colours compare
    for (std::size_t i = 0; i < std::min(result.study.cases.size(), result.answers.size()); ++i) add(i);
  }

  SweepPictures pictures() {
    SweepPictures made;
    const std::size_t all = maps_.size();
    if (all > most_maps) {
      maps_.resize(most_maps);
      made.remarks.push_back(fmt::format(
          "The pictures show {} of the {} combinations of the other axes; critical_gaps.csv has all.",
          most_maps, all));
    }
    made.maps = std::move(maps_);
    for (Contour& map : made.maps)
      std::erase_if(map.marks, [](const MarkedPoints& marks) { return marks.x.empty(); });
    return made;
  }

 private:
  void add(std::size_t index) {
    const study::StudyCase& input = result_.study.cases[index];
    const CaseAnswer& answer = result_.answers[index];
    if (input.coordinates.size() < axes_.size()) return;
    const double x = x_.key.value(input.coordinates[x_.index]);
    const double y = y_.key.value(input.coordinates[y_.index]);
    Contour& map = map_for(input);
    map.z[place_in(y_.values, y) * x_.values.size() + place_in(x_.values, x)] = mapped_.value(answer);
    MarkedPoints& marks = map.marks[static_cast<std::size_t>(drawn_kind(answer))];
    marks.x.push_back(x);
    marks.y.push_back(y);
  }

  /// The map of the case's values on the other axes.
  Contour& map_for(const study::StudyCase& input) {
    std::vector<double> others = input.coordinates;
    others[x_.index] = others[y_.index] = 0;
    const auto found = std::find(others_.begin(), others_.end(), others);
    if (found != others_.end()) return maps_[static_cast<std::size_t>(found - others_.begin())];
    others_.push_back(std::move(others));
    maps_.push_back(empty_map(input));
    return maps_.back();
  }

  Contour empty_map(const study::StudyCase& input) const {
    Contour map;
    map.title = title_of(mapped_.title, axes_, {x_.index, y_.index}, input);
    map.x = picture_axis(x_);
    map.y = picture_axis(y_);
    map.x_values = x_.values;
    map.y_values = y_.values;
    map.z.assign(x_.values.size() * y_.values.size(), study::not_a_number);
    map.z_label = mapped_.label;
    map.levels = levels_;
    const auto labels = kind_labels(result_);
    for (std::size_t kind = 0; kind < labels.size(); ++kind)
      map.marks.push_back({labels[kind], kind_marks[kind], {}, {}});
    return map;
  }

  const SweepResult& result_;
  const std::vector<SweptAxis>& axes_;
  const SweptAxis &x_, &y_;
  const Mapped& mapped_;
  std::vector<double> levels_;
  std::vector<std::vector<double>> others_;  ///< coordinates of every map, those of its plane zero
  std::vector<Contour> maps_;
};

// --- one axis ---

/// Where the mark of a case without a value stands, cm: a bound at its end, anything else on the ground line.
double height_of(const CaseAnswer& answer) {
  switch (drawn_kind(answer)) {
    case CriticalGapKind::value:
      return value_in_cm(answer);
    case CriticalGapKind::all_safe:
      return 100.0 * answer.critical.lower;
    case CriticalGapKind::all_ignite:
      return 100.0 * answer.critical.upper;
    case CriticalGapKind::indeterminate:
      break;
  }
  return 0;
}

Plot curve_of(const SweepResult& result, const std::vector<SweptAxis>& axes, const SweptAxis& axis) {
  Plot plot;
  plot.x = picture_axis(axis);
  plot.y.label = "critical gap [cm]";
  plot.legend = Legend::below_plot;
  Series line{"", axis.values, std::vector<double>(axis.values.size(), study::not_a_number), Style::line};
  line.colour = 0;
  const auto labels = kind_labels(result);
  constexpr std::array<int, 4> colours{0, 2, 1, 7};
  std::vector<Series> marks;
  for (std::size_t kind = 0; kind < labels.size(); ++kind) {
    marks.push_back({labels[kind], {}, {}, kind == 0 ? Style::error_bars : Style::points});
    marks.back().colour = colours[kind];
    marks.back().mark = kind_marks[kind];
  }
  for (std::size_t i = 0; i < std::min(result.study.cases.size(), result.answers.size()); ++i) {
    const study::StudyCase& input = result.study.cases[i];
    if (input.coordinates.size() < axes.size()) continue;
    if (plot.title.empty()) plot.title = title_of("Critical gap", axes, {axis.index}, input);
    const CaseAnswer& answer = result.answers[i];
    const double x = axis.key.value(input.coordinates[axis.index]);
    line.y[place_in(axis.values, x)] = value_in_cm(answer);
    Series& series = marks[static_cast<std::size_t>(drawn_kind(answer))];
    series.x.push_back(x);
    series.y.push_back(height_of(answer));
    series.error.push_back(100.0 * answer.critical.uncertainty);
  }
  plot.series.push_back(std::move(line));
  for (Series& series : marks) {
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace

SweepPictures pictures(const SweepResult& result) {
  const std::vector<SweptAxis> axes = swept_axes(result.study.study);
  std::vector<const SweptAxis*> several;
  for (const SweptAxis& axis : axes) {
    if (axis.values.size() > 1) several.push_back(&axis);
  }
  if (several.empty() || result.answers.empty()) return {};
  if (several.size() == 1) return {{}, {}, curve_of(result, axes, *several.front()), {}};
  const auto drawn = [&](const Mapped& mapped) {
    return MapMaker(result, axes, *several[0], *several[1], mapped).pictures();
  };
  SweepPictures made = drawn(critical_gap_map);
  made.surely_safe = drawn(surely_safe_map).maps;
  return made;
}

}  // namespace launchsafe::report
