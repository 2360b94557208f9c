#include "critical_gap_marks.hpp"

#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/verdict_text.hpp"

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

/// What a bound of one kind says, if all of them say the same.
std::string bound_label(const std::vector<const CriticalGap*>& gaps, CriticalGapKind kind,
                        const std::string& otherwise) {
  std::string label;
  for (const CriticalGap* gap : gaps) {
    if (gap->kind != kind) continue;
    const std::string text = reads_as(*gap);
    if (!label.empty() && text != label) return otherwise;
    label = text;
  }
  return label;
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

}  // namespace

std::array<std::string, 5> kind_labels(const std::vector<const CriticalGap*>& gaps) {
  return {"computed value",
          bound_label(gaps, CriticalGapKind::all_safe, "above the searched gaps") + " (bound)",
          bound_label(gaps, CriticalGapKind::all_ignite, "ignites at every gap") + " (bound)",
          "indeterminate or failed", "the first of several crossings"};
}

CriticalGapKind drawn_kind(const CriticalGap& gap) {
  const bool broken = gap.kind == CriticalGapKind::value && !std::isfinite(gap.value);
  return broken ? CriticalGapKind::indeterminate : gap.kind;
}

GapMarks::GapMarks(const std::vector<const CriticalGap*>& gaps, Style bars)
    : along_x_(bars == Style::horizontal_bars) {
  const auto labels = kind_labels(gaps);
  for (std::size_t kind = 0; kind < labels.size(); ++kind) {
    series_.push_back({labels[kind], {}, {}, kind == 0 ? bars : Style::points});
    series_.back().colour = kind_colours[kind];
    series_.back().mark = kind_marks[kind];
  }
}

void GapMarks::add(const CriticalGap& gap, double place) {
  Series& series = series_[static_cast<std::size_t>(drawn_kind(gap))];
  const double position = position_of(gap);
  const auto bound = [&](double of_gap) {
    const bool known = drawn_kind(gap) == CriticalGapKind::value && std::isfinite(of_gap);
    return known ? shown_gap(of_gap) : position;
  };
  series.x.push_back(along_x_ ? position : place);
  series.y.push_back(along_x_ ? place : position);
  series.lower.push_back(bound(gap.bounds.at_least));
  series.upper.push_back(bound(gap.bounds.at_most));
}

void GapMarks::put_into(Plot& plot) {
  for (Series& series : series_) {
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  }
}

}  // namespace launchsafe::kinds
