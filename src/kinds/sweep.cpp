#include "launchsafe/kinds/sweep.hpp"

#include "launchsafe/run/model_version.hpp"
#include "launchsafe/study/answer_cases.hpp"

#include <algorithm>
#include <numeric>

namespace launchsafe::kinds {

using namespace study;
using namespace report;

bool SweepResult::any_failed() const { return study::any_failed(answers); }

bool SweepResult::any_indeterminate() const {
  return std::any_of(answers.begin(), answers.end(), [](const CaseAnswer& answer) {
    return answer.critical.kind == CriticalGapKind::indeterminate ||
           std::any_of(answer.verdicts.begin(), answer.verdicts.end(),
                       [](const GapVerdict& row) { return row.judgement.verdict == Verdict::indeterminate; });
  });
}

namespace {

GapOrBound gap_or_bound(const CriticalGap& gap) {
  switch (gap.kind) {
    case CriticalGapKind::value:
      return gap.value;
    case CriticalGapKind::all_safe:
      return no_ignition;
    case CriticalGapKind::all_ignite:
      return 0.0;
    case CriticalGapKind::indeterminate:
      return not_a_number;
  }
  return not_a_number;
}

}  // namespace

std::optional<CriticalGapCurve> critical_gap_curve(const SweepResult& result) {
  const Study& study = result.study.study;
  if (study.axes.size() != 1 || study.axes[0].key.name != "load.peak" || result.interrupted ||
      result.answers.size() != result.study.cases.size())
    return std::nullopt;
  CriticalGapCurve curve;
  curve.title = study.title;
  curve.model_version = run::model_version;
  curve.scene = result.study.scene.scene;
  curve.largest_gap = study.largest_gap;
  std::vector<std::size_t> order(result.answers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return result.study.cases[a].peak_pressure < result.study.cases[b].peak_pressure;
  });
  for (const std::size_t i : order) {
    curve.peak_pressures.push_back(result.study.cases[i].peak_pressure);
    curve.critical_gap.push_back(gap_or_bound(result.answers[i].critical));
  }
  return curve;
}

SweepResult run_sweep(const StudyFile& study, const StudyOptions& options) {
  return run_answering<SweepResult>(study, options, [](SweepResult&) {});
}

}  // namespace launchsafe::kinds
