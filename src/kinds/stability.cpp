// What stress cases come to. Held, degraded, caught or WRONG: the rules.
#include "launchsafe/kinds/stability.hpp"

#include "launchsafe/run/validity_warnings.hpp"
#include "launchsafe/study/answer_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using namespace study;
namespace {

using Sentences = std::vector<std::string>;

std::string joined_text(const Sentences& parts) { return fmt::format("{}", fmt::join(parts, "; ")); }

// --- findings ---

Finding judge_reader(const StressCase& asked) {
  if (asked.refusal.empty())
    return {Outcome::wrong, "the reader took the scene, without \"" + asked.refused + "\""};
  if (asked.refusal.find(asked.refused) == std::string::npos)
    return {Outcome::wrong, fmt::format("refused, but not for \"{}\": {}", asked.refused, asked.refusal)};
  return {Outcome::caught, fmt::format("refused: \"{}\"; {}", asked.refused, asked.refusal)};
}

Finding judge_stopped(const StressCase& asked, const StressRun& run) {
  const std::uint64_t steps = run.answer.run.steps;
  const std::string text = fmt::format("{} after {} steps{}", run::to_string(run.answer.run.status), steps,
                                       run.reason.empty() ? "" : ", " + run.reason);
  if (asked.caught_within == 0 || steps <= asked.caught_within) return {Outcome::caught, text};
  return {Outcome::degraded,
          fmt::format("caught late, {} steps were allowed: {}", asked.caught_within, text)};
}

bool deviates(const StressCaseRow& row, std::size_t gap) {
  return row.asked.has(Invariant::same_temperature) &&
         std::abs(row.deviation(gap)) > row.run.answer.verdicts[gap].uncertainty.total();
}

std::string gap_text(const StressCaseRow& row, std::size_t i) {
  const GapVerdict& gap = row.run.answer.verdicts[i];
  std::string text = fmt::format("{:.6g} cm: T max {:.1f} K, {}", 100.0 * gap.gap, gap.maximum.temperature,
                                 to_string(gap.judgement.verdict));
  if (std::isfinite(row.deviation(i)))
    text += fmt::format(", {:+.2g} K against the safe computation, uncertainty {:.2g} K", row.deviation(i),
                        gap.uncertainty.total());
  return text;
}

/// Of the launch up to ignition. `compared`: there is nothing to compare with, or it completed.
Finding judge_launch(const StressCaseRow& row, bool compared) {
  const CaseAnswer& answer = row.run.answer;
  if (!answer.completed()) return judge_stopped(row.asked, row.run);
  Sentences faults = row.run.violations, reserves = row.run.validity_warnings, numbers;
  if (const std::string limited = run::to_string(answer.run.limiters); !limited.empty())
    reserves.push_back("limiters acted: " + limited);
  bool wrong = false;
  for (std::size_t i = 0; i < answer.verdicts.size(); ++i) {
    const GapVerdict& gap = answer.verdicts[i];
    const bool off = deviates(row, i);
    if (off)
      faults.push_back(fmt::format("off the safe computation by {:.3g} K, more than {:.3g} K",
                                   std::abs(row.deviation(i)), gap.uncertainty.total()));
    if (!std::isfinite(gap.maximum.temperature)) reserves.emplace_back("a temperature is not a number");
    if (gap.judgement.verdict != Verdict::indeterminate && (off || !row.run.violations.empty())) wrong = true;
    numbers.push_back(gap_text(row, i));
  }
  if (!compared) reserves.emplace_back("the safe computation is not there to compare with");
  const bool sound = faults.empty() && reserves.empty();
  faults.insert(faults.end(), reserves.begin(), reserves.end());
  faults.insert(faults.end(), numbers.begin(), numbers.end());
  return {wrong ? Outcome::wrong : sound ? Outcome::held : Outcome::degraded, joined_text(faults)};
}

std::string numbers_of(const run::CombustionHistory& c) {
  const double pressure = *std::max_element(c.pressure.begin(), c.pressure.end());
  return fmt::format("burnt {:.3g} g to {:.3g} mm, gas at {:.0f} K, up to {:.3g} MPa, energy residual {:.1e}",
                     1e3 * c.burnt_mass.back(), 1e3 * c.burnt_depth.back(), c.gas_temperature.back(),
                     1e-6 * pressure, c.energy_residual);
}

/// Of a run through the ignition of one gap.
Finding judge_burn(const StressCase& asked, const scene::Scene& scene, double gap,
                   const run::CaseResult& result) {
  const std::string head = fmt::format("through ignition at {:.6g} cm: ", 100.0 * gap);
  const run::MechanicsResult& mechanics = result.mechanics;
  if (mechanics.status != run::RunStatus::completed) {
    if (mechanics.reason.empty()) return {Outcome::wrong, head + "broke off without a reason"};
    return {Outcome::caught, head + run::to_string(mechanics.status) + ", " + mechanics.reason};
  }
  const auto& combustion = result.gaps.front().combustion;
  if (!combustion) return {Outcome::degraded, head + "nothing ignited"};
  const Sentences violations = violations_of({scene, mechanics, {gap}, &*combustion}, asked);
  if (!violations.empty()) return {Outcome::wrong, head + joined_text(violations)};
  Sentences all = run::combustion_validity_warnings(scene, *combustion);
  const Outcome outcome = all.empty() ? Outcome::held : Outcome::degraded;
  all.push_back(numbers_of(*combustion));
  return {outcome, head + joined_text(all)};
}

/// The worst first: the enumeration is in that order.
Finding worst_of(std::vector<Finding> findings) {
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.outcome > b.outcome; });
  Sentences texts;
  for (const Finding& each : findings) texts.push_back(each.text);
  return {findings.front().outcome, joined_text(texts)};
}

// --- runs ---

/// The case that asked for a run of the study, by itself or as its safe computation.
const StressCase& case_of_run(const StudyFile& study, std::size_t index) {
  const auto& cases = settings_of<StabilitySettings>(study.study).cases;
  return *std::find_if(cases.begin(), cases.end(), [index](const StressCase& each) {
    return each.run == index || each.against == index;
  });
}

StressRun run_from(const StudyFile& study, std::size_t index, const run::MechanicsResult& mechanics) {
  const StudyCase& input = study.cases[index];
  const StressCase& asked = case_of_run(study, index);
  StressRun run;
  run.reason = mechanics.reason;
  run.end_time = mechanics.end_time;
  run.ignition_temperature = input.scene.scene.charge().kinetics.ignition_temperature;
  if (mechanics.status == run::RunStatus::interrupted || mechanics.status == run::RunStatus::timed_out) {
    // How far it came depends on the machine, and says nothing of the computation.
    run.failure = failure_of(mechanics);
    return run;
  }
  Study judged = study.study;
  judged.gaps = asked.gaps;
  run.answer = answer_of(judged, input, mechanics);
  if (mechanics.status != run::RunStatus::completed) return run;
  run.violations = violations_of({input.scene.scene, mechanics, asked.gaps}, asked);
  run.validity_warnings = run::validity_warnings(input.scene.scene, mechanics);
  return run;
}

/// A run through ignition that did not come to its end by itself leaves the case without a finding.
void add_burns(const StudyFile& study, std::size_t index, const std::vector<FinishedRun>& runs,
               StressRun& run) {
  const scene::Scene& scene = study.cases[index].scene.scene;
  if (!run.failure.empty() || !run.answer.completed()) return;
  for (std::size_t i = 1; i < runs.size(); ++i) {
    if (!runs[i].has_result() || was_cut_off(runs[i])) {
      run.failure = "through ignition: " + runs[i].failure;
      run.outcome = runs[i].outcome;
      return;
    }
    run.burns.push_back(
        judge_burn(case_of_run(study, index), scene, scene.surface.gaps[i - 1], runs[i].result));
  }
}

/// `against`: the safe computation; nullptr without one.
StressCaseRow judge(const StressCase& asked, const StressRun& run, const StressRun* against) {
  StressCaseRow row{asked, run, {}, {}};
  if (!asked.run) {
    row.finding = judge_reader(asked);
    return row;
  }
  if (row.computed() && against != nullptr) {
    row.run.failure = against->failure;
    row.run.outcome = against->outcome;
    row.heated_against = against->answer.heated_temperature;
  }
  if (!row.computed()) return row;
  std::vector<Finding> findings{judge_launch(row, against == nullptr || against->answer.completed())};
  findings.insert(findings.end(), run.burns.begin(), run.burns.end());
  row.finding = worst_of(std::move(findings));
  return row;
}

}  // namespace

bool StressCase::has(Invariant invariant) const {
  return std::find(invariants.begin(), invariants.end(), invariant) != invariants.end();
}

bool StressCaseRow::is_as_expected() const {
  if (!computed() || is(Outcome::wrong)) return false;
  const std::vector<Outcome>& expected = asked.expected;
  return expected.empty() || std::find(expected.begin(), expected.end(), finding.outcome) != expected.end();
}

double StressCaseRow::deviation(std::size_t gap) const {
  if (gap >= heated_against.size()) return not_a_number;
  return std::min(run.answer.heated_temperature[gap], run.ignition_temperature) -
         std::min(heated_against[gap], run.ignition_temperature);
}

std::size_t StabilityResult::count(Outcome outcome) const {
  return static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(), [outcome](const StressCaseRow& row) { return row.is(outcome); }));
}

StabilityResult run_stability(const StudyFile& study, const StudyOptions& options) {
  const auto compute = [&](StabilityResult& result) {
    std::vector<StressRun> runs(study.cases.size());
    run_every_case(study, options, result.timing, [&](std::size_t i, std::vector<FinishedRun>& finished) {
      if (finished.front().has_result())
        runs[i] = run_from(study, i, finished.front().result.mechanics);
      else
        runs[i].failure = finished.front().failure;
      runs[i].outcome = finished.front().outcome;
      add_burns(study, i, finished, runs[i]);
    });
    for (const StressCase& asked : settings_of<StabilitySettings>(study.study).cases)
      result.rows.push_back(judge(asked, asked.run ? runs[*asked.run] : StressRun{},
                                  asked.against ? &runs[*asked.against] : nullptr));
  };
  return run_timed<StabilityResult>(study, options, compute, [](StabilityResult&) {});
}

}  // namespace launchsafe::kinds
