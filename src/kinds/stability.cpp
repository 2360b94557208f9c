// What stress cases come to. Held, degraded, caught or WRONG: the rules.
#include "launchsafe/kinds/stability.hpp"

#include "launchsafe/run/validity_warnings.hpp"
#include "launchsafe/study/answer_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace launchsafe::kinds {

using namespace study;
namespace {

/// What is known of one launch.
struct LaunchRecord {
  RunOutcome outcome = RunOutcome::ran;
  std::string failure;                         ///< why it was not run at all; then nothing else is known
  std::string reason;                          ///< when and where it was stopped, if it was
  double end_time = not_a_number;              ///< s, reached
  double ignition_temperature = not_a_number;  ///< K
  CaseAnswer answer;
  std::vector<std::string> violations;  ///< of invariants
  std::vector<std::string> validity_warnings;
  std::vector<Burn> burns;  ///< through ignition, by gap
};

std::string sentences(const std::vector<std::string>& parts) {
  return fmt::format("{}", fmt::join(parts, "; "));
}

Finding judge_reader(const StressCase& launch) {
  if (launch.refusal.empty())
    return {Outcome::wrong, "the reader took the scene, without \"" + launch.must_refuse + "\""};
  if (launch.refusal.find(launch.must_refuse) == std::string::npos)
    return {Outcome::wrong,
            fmt::format("refused, but not for \"{}\": {}", launch.must_refuse, launch.refusal)};
  return {Outcome::caught, "refused before anything was computed: " + launch.refusal};
}

Finding judge_stopped(const StressCase& launch, const LaunchRecord& record) {
  const std::string text =
      fmt::format("{} after {} steps{}", run::to_string(record.answer.run.status), record.answer.run.steps,
                  record.reason.empty() ? "" : ", " + record.reason);
  if (launch.caught_within == 0 || record.answer.run.steps <= launch.caught_within)
    return {Outcome::caught, text};
  return {Outcome::degraded,
          fmt::format("caught late, {} steps were allowed: {}", launch.caught_within, text)};
}

bool decides(const StressCaseGap& gap) { return gap.judgement.verdict != Verdict::indeterminate; }

std::string gap_text(const StressCaseGap& gap) {
  std::string text = fmt::format("{:.6g} cm: T max {:.1f} K, {}", 100.0 * gap.gap, gap.temperature,
                                 to_string(gap.judgement.verdict));
  if (std::isfinite(gap.deviation()))
    text += fmt::format(", {:+.2g} K against the safe computation, uncertainty {:.2g} K", gap.deviation(),
                        gap.uncertainty);
  return text;
}

std::string gaps_text(const std::vector<StressCaseGap>& gaps) {
  std::vector<std::string> texts;
  for (const StressCaseGap& gap : gaps) texts.push_back(gap_text(gap));
  return sentences(texts);
}

/// Why a completed run does not stand for itself; empty where it does.
std::vector<std::string> reserves_of(const StressCaseRow& row) {
  std::vector<std::string> reserves = row.validity_warnings;
  if (const std::string limited = run::to_string(row.run.limiters); !limited.empty())
    reserves.push_back("limiters acted: " + limited);
  for (const StressCaseGap& gap : row.gaps) {
    if (!std::isfinite(gap.temperature)) reserves.emplace_back("a temperature is not a number");
  }
  return reserves;
}

/// What is wrong with a completed run, whether or not its verdicts say so.
std::vector<std::string> faults_of(const StressCaseRow& row) {
  std::vector<std::string> faults = row.violations;
  for (const StressCaseGap& gap : row.gaps) {
    if (gap.deviates())
      faults.push_back(fmt::format("off the safe computation by {:.3g} K, more than {:.3g} K",
                                   std::abs(gap.deviation()), gap.uncertainty));
  }
  return faults;
}

/// Verdicts that a fault makes WRONG: all of them for a broken invariant, else those of the gaps that
/// deviate.
bool decides_wrongly(const StressCaseRow& row) {
  return std::any_of(row.gaps.begin(), row.gaps.end(), [&](const StressCaseGap& gap) {
    return decides(gap) && (!row.violations.empty() || gap.deviates());
  });
}

Finding judge_completed(const StressCaseRow& row, bool compared) {
  const std::vector<std::string> faults = faults_of(row), reserves = reserves_of(row);
  const std::string numbers = gaps_text(row.gaps);
  if (!faults.empty()) {
    const bool wrong = decides_wrongly(row);
    return {wrong ? Outcome::wrong : Outcome::degraded,
            sentences(faults) + (reserves.empty() ? "" : "; " + sentences(reserves)) + "; " + numbers};
  }
  if (!reserves.empty()) return {Outcome::degraded, sentences(reserves) + "; " + numbers};
  if (!compared) return {Outcome::degraded, "the safe computation is not there to compare with; " + numbers};
  return {Outcome::held, numbers};
}

std::vector<StressCaseGap> stress_case_gaps(const LaunchRecord& record, const LaunchRecord* against) {
  std::vector<StressCaseGap> gaps;
  for (std::size_t i = 0; i < record.answer.verdicts.size(); ++i) {
    const GapVerdict& verdict = record.answer.verdicts[i];
    StressCaseGap gap;
    gap.gap = verdict.gap;
    gap.temperature = verdict.maximum.temperature;
    gap.uncertainty = verdict.uncertainty.total();
    gap.judgement = verdict.judgement;
    gap.ignition = record.ignition_temperature;
    gap.heated = record.answer.heated_temperature[i];
    if (against != nullptr && i < against->answer.heated_temperature.size())
      gap.heated_against = against->answer.heated_temperature[i];
    gaps.push_back(std::move(gap));
  }
  return gaps;
}

/// The row of a launch. `record` is nullptr for a case of the reader, `against` for one without a safe
/// computation to compare with.
///
/// Caught: the run was stopped, or the reader refused the scene. WRONG: an invariant is violated, or T max is
/// further from the safe computation than its uncertainty, and a verdict says SAFE or UNSAFE. Degraded: the
/// same with an indeterminate verdict; validity warnings, limiters, a temperature that is no number, a stop
/// that came later than it must, or nothing left to compare with. Held: everything else.
StressCaseRow judge_stress_case(const StressCase& launch, const LaunchRecord* record,
                                const LaunchRecord* against) {
  StressCaseRow row;
  row.group = launch.group;
  row.name = launch.name;
  row.must_hold = launch.must_hold;
  row.expected = launch.expected;
  if (record == nullptr) {
    row.finding = judge_reader(launch);
    return row;
  }
  const LaunchRecord& missing = record->failure.empty() && against != nullptr ? *against : *record;
  row.failure = missing.failure;
  row.outcome = missing.outcome;
  if (!row.computed()) return row;
  row.ran = true;
  row.run = record->answer.run;
  row.end_time = record->end_time;
  row.violations = record->violations;
  row.validity_warnings = record->validity_warnings;
  row.gaps = stress_case_gaps(*record, against);
  const bool compared = against == nullptr || against->answer.completed();
  row.finding = record->answer.completed() ? judge_completed(row, compared) : judge_stopped(launch, *record);
  row.finding = joined_finding(std::move(row.finding), record->burns);
  return row;
}

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

/// A run through ignition that did not come to its end by itself leaves the case without a record.
void add_burns(const StudyFile& study, std::size_t index, const std::vector<FinishedRun>& runs,
               LaunchRecord& record) {
  const scene::Scene& scene = study.cases[index].scene.scene;
  if (!record.failure.empty() || !record.answer.completed()) return;
  for (std::size_t i = 1; i < runs.size(); ++i) {
    if (!runs[i].has_result() || was_cut_off(runs[i])) {
      record.failure = "through ignition: " + runs[i].failure;
      record.outcome = runs[i].outcome;
      return;
    }
    const double gap = scene.surface.gaps[i - 1];
    record.burns.push_back({gap, judge_burn(scene, gap, runs[i].result)});
  }
}

/// The records of all cases.
std::vector<LaunchRecord> run_launches(const StudyFile& study, const StudyOptions& options, Timing& timing) {
  std::vector<LaunchRecord> records(study.cases.size());
  run_every_case(study, options, timing, [&](std::size_t i, std::vector<FinishedRun>& runs) {
    if (runs.front().has_result())
      records[i] = record_of(study, i, runs.front().result.mechanics);
    else
      records[i].failure = runs.front().failure;
    records[i].outcome = runs.front().outcome;
    add_burns(study, i, runs, records[i]);
  });
  return records;
}

}  // namespace

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

StabilityResult run_stability(const StudyFile& study, const StudyOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  StabilityResult result;
  result.study = study;
  result.timing.jobs = jobs_of(options);
  const auto records = run_launches(study, options, result.timing);
  result.interrupted = stop_requested(options);
  for (const StressCase& launch : settings_of<StabilitySettings>(study.study).cases)
    result.rows.push_back(judge_stress_case(launch, launch.run ? &records[*launch.run] : nullptr,
                                            launch.against ? &records[*launch.against] : nullptr));
  result.timing.wall_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace launchsafe::kinds
