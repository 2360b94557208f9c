#include "study_outcome.hpp"

#include "launchsafe/report/accuracy_report.hpp"
#include "launchsafe/report/calibration_report.hpp"
#include "launchsafe/report/critical_gap_report.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/sensitivity_report.hpp"
#include "launchsafe/report/stability_report.hpp"
#include "launchsafe/report/sweep_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace launchsafe::app {
namespace {

void add_failure(std::vector<Failure>& failures, const std::string& label, study::RunOutcome outcome,
                 const std::string& reason) {
  if (!reason.empty() && outcome != study::RunOutcome::other_shard)
    failures.push_back({label, reason, outcome});
}

std::vector<Failure> failures_in(const study::CriticalGapResult& result) {
  std::vector<Failure> failures;
  for (const study::CaseOutcome& each : result.cases) {
    add_failure(failures, each.input.label, each.outcome, each.failure);
    for (const study::Confirmation& confirmation : each.confirmations)
      add_failure(failures,
                  fmt::format("{}, coupled at {:.6g} cm", each.input.label, 100.0 * confirmation.gap),
                  confirmation.outcome, confirmation.failure);
  }
  return failures;
}

std::vector<Failure> failures_in(const study::CalibrationResult& result) {
  std::vector<Failure> failures;
  for (const study::CalibrationRun& run : result.runs)
    add_failure(failures, run.input.label, run.outcome, run.failure);
  return failures;
}

/// A hard case that is WRONG is the worst outcome of a study.
std::vector<Failure> failures_in(const study::StabilityResult& result) {
  std::vector<Failure> failures;
  for (const study::HardRow& row : result.rows) {
    const std::string label = row.group + ": " + row.name;
    if (!row.computed()) add_failure(failures, label, row.outcome, row.failure);
    if (row.is_wrong()) add_failure(failures, label, row.outcome, "WRONG: " + row.finding.text);
    if (row.computed() && !row.is_wrong() && !row.is_as_expected())
      add_failure(failures, label, row.outcome,
                  fmt::format("{}, which is not what the study expects: {}", to_string(row.finding.outcome),
                              row.finding.text));
  }
  return failures;
}

/// For the kinds that have an answer for every case.
template <class Result>
std::vector<Failure> failures_in(const Result& result) {
  std::vector<Failure> failures;
  for (std::size_t i = 0; i < result.answers.size(); ++i)
    add_failure(failures, result.study.cases[i].label, result.answers[i].outcome, result.answers[i].failure);
  return failures;
}

bool is_indeterminate(const study::CalibrationResult&) { return false; }
/// The outcome of its cases is not what they are for.
bool is_indeterminate(const study::StabilityResult&) { return false; }
template <class Result>
bool is_indeterminate(const Result& result) {
  return result.any_indeterminate();
}

}  // namespace

StudyResult run_study(const study::StudyFile& file, const study::StudyOptions& options) {
  switch (file.study.kind) {
    case study::StudyKind::critical_gap:
      return study::run_critical_gap(file, options);
    case study::StudyKind::calibration:
      return study::run_calibration(file, options);
    case study::StudyKind::sweep:
      return study::run_sweep(file, options);
    case study::StudyKind::sensitivity:
      return study::run_sensitivity(file, options);
    case study::StudyKind::accuracy:
      return study::run_accuracy(file, options);
    case study::StudyKind::stability:
      break;
  }
  return study::run_stability(file, options);
}

bool interrupted(const StudyResult& result) {
  return std::visit([](const auto& each) { return each.interrupted; }, result);
}

const study::Timing& timing_of(const StudyResult& result) {
  return std::visit([](const auto& each) -> const study::Timing& { return each.timing; }, result);
}

bool any_indeterminate(const StudyResult& result) {
  return std::visit([](const auto& each) { return is_indeterminate(each); }, result);
}

std::vector<Failure> failures_of(const StudyResult& result) {
  return std::visit([](const auto& each) { return failures_in(each); }, result);
}

report::Report report_of(const StudyResult& result) {
  return std::visit([](const auto& each) { return report::report_of(each); }, result);
}

nlohmann::ordered_json to_json(const StudyResult& result) {
  return std::visit([](const auto& each) { return report::to_json(each); }, result);
}

std::string timing_text(const study::Timing& timing) {
  std::string text = fmt::format("re-used {} mechanical run{}, ran {}", timing.reused,
                                 timing.reused == 1 ? "" : "s", timing.runs);
  if (timing.run_time > 0)
    text += fmt::format(" at {} particle updates per second and core",
                        report::scientific(timing.updates_per_second(), 2));
  return text + fmt::format("; {} of wall time with {} job{}", report::duration(timing.wall_time),
                            timing.jobs, timing.jobs == 1 ? "" : "s");
}

}  // namespace launchsafe::app
