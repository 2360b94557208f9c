#include "launchsafe/kinds/stability.hpp"

#include "launchsafe/run/validity_warnings.hpp"
#include "launchsafe/study/answer_cases.hpp"
#include "stability_judge.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>

namespace launchsafe::kinds {

using namespace study;
using namespace report;

using verify::Outcome;

bool StressCaseRow::is_as_expected() const {
  if (!computed() || is_wrong()) return false;
  return expected.empty() || std::find(expected.begin(), expected.end(), finding.outcome) != expected.end();
}

std::size_t StabilityResult::count(Outcome outcome) const {
  return static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(),
      [outcome](const StressCaseRow& row) { return row.computed() && row.finding.outcome == outcome; }));
}

std::size_t StabilityResult::unexpected() const {
  return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), [](const StressCaseRow& row) {
    return row.computed() && !row.is_wrong() && !row.is_as_expected();
  }));
}

std::size_t StabilityResult::failed() const {
  return static_cast<std::size_t>(
      std::count_if(rows.begin(), rows.end(), [](const StressCaseRow& row) { return !row.computed(); }));
}

namespace {

/// Gaps that are asked of a case of the study, by itself or as the safe computation of another.
std::vector<double> gaps_of(const StudyFile& study, std::size_t index) {
  for (const StressCase& launch : settings_of<StabilitySettings>(study.study).cases) {
    if (launch.run == index || launch.against == index) return launch.gaps;
  }
  return study.study.gaps;
}

/// What one run says of a case: all that judging needs, and no histories.
LaunchRecord record_of(const StudyFile& study, std::size_t index, const run::MechanicsResult& mechanics) {
  const StudyCase& input = study.cases[index];
  Study judged = study.study;
  judged.gaps = gaps_of(study, index);
  LaunchRecord record;
  record.reason = mechanics.reason;
  record.end_time = mechanics.end_time;
  record.ignition_temperature = input.scene.scene.charge().kinetics.ignition_temperature;
  if (mechanics.status == run::RunStatus::interrupted || mechanics.status == run::RunStatus::timed_out) {
    // How far it came depends on the machine, and says nothing of the computation.
    record.failure = failure_of(mechanics);
    return record;
  }
  record.answer = answer_of(judged, input, mechanics);
  if (mechanics.status != run::RunStatus::completed) return record;
  record.violations = violations_of(input.scene.scene, mechanics, judged.gaps);
  record.validity_warnings = run::validity_warnings(input.scene.scene, mechanics);
  return record;
}

/// The records of all cases.
std::vector<LaunchRecord> run_launches(const StudyFile& study, const StudyOptions& options, Timing& timing) {
  std::vector<LaunchRecord> records(study.cases.size());
  ProgressTracker tracker(options.progress);
  const std::vector<CaseRuns> runs = case_runs(study, options.shard.count);
  run_cases(runs, options, tracker, timing, [&](std::size_t i, std::vector<FinishedRun>& finished) {
    const FinishedRun& run = finished.front();
    for (const std::size_t member : runs[i].members) {
      if (run.has_result())
        records[member] = record_of(study, member, run.result.mechanics);
      else
        records[member].failure = run.failure;
      records[member].outcome = run.outcome;
    }
  });
  return records;
}

std::vector<StressCaseRow> rows_of_laws(const StudyOptions& options) {
  const std::vector<verify::StressTest> laws = verify::law_stress_tests();
  std::vector<StressCaseRow> rows(laws.size());
  tbb::task_arena arena(jobs_of(options));
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, laws.size(), [&](std::size_t i) {
      StressCaseRow& row = rows[i];
      row.group = laws[i].group;
      row.name = laws[i].name;
      row.must_hold = laws[i].must_hold;
      try {
        row.finding = laws[i].compute();
      } catch (const std::exception& error) {
        row.failure = std::string("the computation failed: ") + error.what();
      }
    });
  });
  return rows;
}

}  // namespace

StabilityResult run_stability(const StudyFile& study, const StudyOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  StabilityResult result;
  result.study = study;
  result.timing.jobs = jobs_of(options);
  const auto records = run_launches(study, options, result.timing);
  result.interrupted = stop_requested(options);
  if (!result.interrupted && options.shard.whole() && settings_of<StabilitySettings>(study.study).laws)
    result.rows = rows_of_laws(options);
  for (const StressCase& launch : settings_of<StabilitySettings>(study.study).cases)
    result.rows.push_back(judge_stress_case(launch, launch.run ? &records[*launch.run] : nullptr,
                                            launch.against ? &records[*launch.against] : nullptr));
  result.timing.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace launchsafe::kinds
