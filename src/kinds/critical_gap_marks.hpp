// Critical gaps as marks in a picture: values with their uncertainty, bounds as bounds.
#pragma once

#include "launchsafe/report/plot.hpp"
#include "launchsafe/study/bracket.hpp"

#include <array>
#include <string>
#include <vector>

namespace launchsafe::kinds {

/// What the marks of every kind mean, in the order of CriticalGapKind.
std::array<std::string, 5> kind_labels(const std::vector<const study::CriticalGap*>& gaps);

/// The critical gaps of outcomes or answers, in their order.
template <class Case>
std::vector<const study::CriticalGap*> critical_gaps_of(const std::vector<Case>& cases) {
  std::vector<const study::CriticalGap*> gaps;
  for (const Case& each : cases) gaps.push_back(&each.critical);
  return gaps;
}

/// The kind as it is drawn: a value that is not finite is none.
study::CriticalGapKind drawn_kind(const study::CriticalGap& gap);

/// One series for every kind. Gaps (cm) go along y with vertical bars, along x with horizontal ones.
class GapMarks {
 public:
  /// `gaps`: all that the picture will have, which decide the labels.
  GapMarks(const std::vector<const study::CriticalGap*>& gaps, report::Style bars);
  /// `place`: on the other axis.
  void add(const study::CriticalGap& gap, double place);
  /// The kinds that occur.
  void put_into(report::Plot& plot);

 private:
  std::vector<report::Series> series_;
  bool along_x_;
};

}  // namespace launchsafe::kinds
