#include "launchsafe/kinds/comparison.hpp"

#include "launchsafe/study/gap_analysis.hpp"
#include "launchsafe/study/run_cases.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

namespace launchsafe::kinds {

using namespace study;

std::size_t ComparisonResult::counterpart(std::size_t index) const {
  return index - variants()[cases[index].variant].first;
}

bool ComparisonResult::any_indeterminate() const {
  return std::any_of(cases.begin(), cases.end(), [](const ComparedCase& each) {
    const auto& rows = each.answer.verdicts;
    return each.answer.critical.kind == CriticalGapKind::indeterminate ||
           std::any_of(rows.begin(), rows.end(),
                       [](const GapVerdict& row) { return row.judgement.verdict == Verdict::indeterminate; });
  });
}

namespace {

std::size_t variant_of(const std::vector<Variant>& variants, std::size_t index) {
  const auto next = std::upper_bound(variants.begin(), variants.end(), index,
                                     [](std::size_t i, const Variant& each) { return i < each.first; });
  return static_cast<std::size_t>(next - variants.begin()) - 1;
}

/// Of the stations that tile the bottom; observation points lie in them.
std::vector<StationTemperature> station_temperatures(const surface::SkinModel& model,
                                                     const trace::BottomTrace& trace, double gap) {
  const surface::SkinHistory skin = surface::integrate_skin(model, trace, gap);
  const std::size_t count = trace.stations.size();
  std::vector<StationTemperature> stations;
  for (std::size_t station = 0; station < count; ++station) {
    if (trace.stations[station].observation) continue;
    StationTemperature each{trace.stations[station].name, 0.0};
    for (std::size_t i = station; i < skin.temperature.size(); i += count)
      each.temperature = std::max(each.temperature, skin.temperature[i]);
    stations.push_back(std::move(each));
  }
  return stations;
}

void judge(const Variant& variant, const StudyCase& input, std::vector<FinishedRun>& runs, ComparedCase& of) {
  if (const FinishedRun* missing = run_without_result(runs)) {
    of.answer = failed_answer(variant.judged, input, missing->outcome, missing->failure);
    return;
  }
  const FinishedRun& own = runs.front();
  if (own.outcome == RunOutcome::timed_out || own.outcome == RunOutcome::interrupted) {
    // How far it came depends on the machine, and is no part of the result.
    of.answer = failed_answer(variant.judged, input, own.outcome, own.failure);
    return;
  }
  const run::MechanicsResult& mechanics = own.result.mechanics;
  std::optional<run::MechanicsResult> raised;
  if (runs.size() > 1 && own.failure.empty()) raised = runs[1].result.mechanics;
  of.answer = answer_of(variant.judged, input, mechanics, raised);
  of.answer.outcome = own.outcome;
  of.processor_time = mechanics.processor_time > 0 ? mechanics.processor_time : mechanics.wall_time;
  if (!own.failure.empty()) return;
  const surface::SkinModel model = without_reaction(surface::skin_model(input.scene.scene));
  for (const double gap : variant.judged.gaps)
    of.stations.push_back(station_temperatures(model, mechanics.trace, gap));
}

}  // namespace

ComparisonResult run_comparison(const StudyFile& study, const StudyOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  ComparisonResult result;
  result.study = study;
  result.timing.jobs = jobs_of(options);
  result.cases.resize(study.cases.size());
  for (std::size_t i = 0; i < study.cases.size(); ++i)
    result.cases[i].variant = variant_of(result.variants(), i);
  ProgressTracker tracker(options.progress);
  const std::vector<CaseRuns> runs = case_runs(study, options.shard.count);
  run_cases(runs, options, tracker, result.timing, [&](std::size_t i, std::vector<FinishedRun>& finished) {
    for (const std::size_t member : runs[i].members) {
      ComparedCase& of = result.cases[member];
      judge(result.variants()[of.variant], study.cases[member], finished, of);
    }
  });
  result.interrupted = stop_requested(options);
  result.timing.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace launchsafe::kinds
