// What stress cases come to. Held, degraded, caught or WRONG: the rules.
#include "launchsafe/kinds/stability.hpp"

#include "launchsafe/run/validity_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace launchsafe::kinds {

using study::CaseAnswer, study::not_a_number, study::StudyFile;

namespace {

/// What a run says by itself: all that judging needs, and no histories.
struct StressRun {
  CaseAnswer answer;
  double end_time = not_a_number;  ///< s, reached
  Sentences violations;            ///< of invariants
  Sentences reserves;              ///< what the result says against itself
  std::vector<Finding> findings;   ///< of a launch that was stopped, or of the gaps' own launches
};

/// Of the heat and work of a closing gap's air.
constexpr double most_made_in_air = 1e-6;

std::string joined_text(const Sentences& parts) { return fmt::format("{}", fmt::join(parts, "; ")); }

bool was_computed(const CaseAnswer& answer) {
  return answer.outcome == study::RunOutcome::ran || answer.outcome == study::RunOutcome::reused;
}

// --- of a run by itself ---

Finding judge_reader(const StressCase& asked) {
  if (asked.refusal.empty())
    return {Outcome::wrong, "the reader took the scene, without \"" + asked.refused + "\""};
  if (asked.refusal.find(asked.refused) == std::string::npos)
    return {Outcome::wrong, fmt::format("refused, but not for \"{}\": {}", asked.refused, asked.refusal)};
  return {Outcome::caught, fmt::format("refused: \"{}\"; {}", asked.refused, asked.refusal)};
}

Finding judge_stopped(const StressCase& asked, const run::MechanicsResult& mechanics) {
  const std::string text =
      fmt::format("{} after {} steps{}", run::to_string(mechanics.status), mechanics.steps,
                  mechanics.reason.empty() ? "" : ", " + mechanics.reason);
  if (asked.caught_within == 0 || mechanics.steps <= asked.caught_within) return {Outcome::caught, text};
  return {Outcome::degraded,
          fmt::format("caught late, {} steps were allowed: {}", asked.caught_within, text)};
}

std::string numbers_of(const run::CombustionHistory& c) {
  const double pressure = *std::ranges::max_element(c.pressure);
  return fmt::format("burnt {:.3g} g to {:.3g} mm, gas at {:.0f} K, up to {:.3g} MPa, energy residual {:.1e}",
                     1e3 * c.burnt_mass.back(), 1e3 * c.burnt_depth.back(), c.gas_temperature.back(),
                     1e-6 * pressure, c.energy_residual);
}

/// Of a run through the ignition of one gap.
Finding judge_burn(const StressCase& asked, const scene::Scene& scene, double gap,
                   const run::CaseResult& result) {
  const auto& combustion = result.gaps.front().combustion;
  if (!combustion) return {Outcome::degraded, "nothing ignited"};
  const Sentences violations = violations_of({scene, result.mechanics, {gap}, &*combustion}, asked);
  if (!violations.empty()) return {Outcome::wrong, joined_text(violations)};
  Sentences all = run::combustion_validity_warnings(scene, *combustion);
  const Outcome outcome = all.empty() ? Outcome::held : Outcome::degraded;
  all.push_back(numbers_of(*combustion));
  return {outcome, joined_text(all)};
}

/// Of a launch in which a gap closes.
Finding judge_closing(const StressCase& asked, const scene::Scene& scene, double gap,
                      const run::CaseResult& result) {
  const run::GapResult& closed = result.gaps.front();
  Sentences violations = violations_of({scene, result.mechanics, {gap}}, asked);
  if (!std::isfinite(closed.at_stations.temperature))
    violations.emplace_back("a temperature is not a number");
  if (closed.skin.energy_residual > most_made_in_air)
    violations.push_back(fmt::format("the air made or lost a share {:.2g}", closed.skin.energy_residual));
  Sentences all = run::validity_warnings(scene, result.mechanics);
  const Outcome outcome = !all.empty()         ? Outcome::degraded
                          : violations.empty() ? Outcome::held
                                               : Outcome::wrong;
  all.insert(all.begin(), violations.begin(), violations.end());
  all.push_back(fmt::format("T max {:.1f} K", closed.at_stations.temperature));
  if (closed.closing)
    all.back() +=
        fmt::format(", down to {:.3g} µm at up to {:.3g} MPa", 1e6 * closed.closing->smallest_opening,
                    1e-6 * closed.closing->largest_gas_pressure);
  return {outcome, joined_text(all)};
}

/// Of the launch of one gap alone.
Finding judge_gap(const StressCase& asked, const study::StudyCase& input, double gap,
                  const run::CaseResult& result) {
  const run::MechanicsResult& mechanics = result.mechanics;
  Finding finding{Outcome::caught, run::to_string(mechanics.status) + ", " + mechanics.reason};
  if (mechanics.status == run::RunStatus::completed)
    finding = (input.closing ? judge_closing : judge_burn)(asked, input.scene.scene, gap, result);
  else if (mechanics.reason.empty())
    finding = {Outcome::wrong, "broke off without a reason"};
  finding.text = fmt::format("{} {:.6g} cm: {}", input.closing ? "closing from" : "through ignition at",
                             100.0 * gap, finding.text);
  return finding;
}

Sentences reserves_of(const scene::Scene& scene, const run::MechanicsResult& mechanics,
                      const CaseAnswer& answer) {
  Sentences reserves = run::validity_warnings(scene, mechanics);
  if (const std::string limited = run::to_string(mechanics.limiters); !limited.empty())
    reserves.push_back("limiters acted: " + limited);
  for (const study::GapVerdict& gap : answer.verdicts)
    if (!std::isfinite(gap.maximum.temperature)) reserves.emplace_back("a temperature is not a number");
  return reserves;
}

/// `runs`: the launch, then those through the ignition of gaps or in which they close. How far one came that
/// was cut off depends on the machine, and says nothing of the computation: that leaves the case without a
/// finding.
StressRun run_from(const StudyFile& study, std::size_t index, std::vector<study::FinishedRun>& runs) {
  StressRun run;
  // After a launch that was stopped no other is begun.
  const std::size_t begun = runs.front().failure.empty() ? runs.size() : 1;
  for (std::size_t i = 0; i < begun; ++i) {
    if (runs[i].has_result() && !was_cut_off(runs[i])) continue;
    run.answer.failure = (i == 0 ? "" : "in the launch of a gap: ") + runs[i].failure;
    run.answer.outcome = runs[i].outcome;
    return run;
  }
  // The case that asked for the run, by itself or as its safe computation.
  const StressCase& asked = *std::ranges::find_if(
      settings_of<StabilitySettings>(study.study).cases,
      [index](const StressCase& each) { return each.run == index || each.against == index; });
  const scene::Scene& scene = study.cases[index].scene.scene;
  const run::MechanicsResult& mechanics = runs.front().result.mechanics;
  study::Study judged = study.study;
  judged.gaps = asked.gaps;
  run.answer = answer_of(judged, study.cases[index], mechanics);
  run.answer.outcome = runs.front().outcome;
  run.end_time = mechanics.end_time;
  if (!run.answer.completed()) {
    run.findings = {judge_stopped(asked, mechanics)};
    runs.front().expected = asked.run == index && asked.expects(run.findings.front().outcome);
    return run;
  }
  run.violations = violations_of({scene, mechanics, asked.gaps}, asked);
  run.reserves = reserves_of(scene, mechanics, run.answer);
  for (std::size_t i = 1; i < begun; ++i)
    run.findings.push_back(judge_gap(asked, study.cases[index], scene.surface.gaps[i - 1], runs[i].result));
  return run;
}

// --- of a case ---

/// Of a launch that completed. `compared`: there is nothing to compare with, or it completed.
Finding judge_launch(const StressCaseRow& row, const StressRun& run, bool compared) {
  Sentences faults = run.violations, numbers;
  const bool checked = compared && !row.deviations.empty() && row.asked.has("same-temperature");
  bool wrong = false;
  for (std::size_t i = 0; i < row.answer.verdicts.size(); ++i) {
    const study::GapVerdict& gap = row.answer.verdicts[i];
    const double deviation = row.deviations.empty() ? not_a_number : row.deviations[i];
    const double uncertainty = gap.uncertainty.total();
    const bool off = checked && std::abs(deviation) > uncertainty;
    if (checked && std::isnan(deviation))
      faults.emplace_back("a temperature to compare with is not a number");
    if (off)
      faults.push_back(fmt::format("off the safe computation by {:.3g} K, more than {:.3g} K",
                                   std::abs(deviation), uncertainty));
    if (gap.judgement.verdict != study::Verdict::indeterminate && (off || !run.violations.empty()))
      wrong = true;
    numbers.push_back(fmt::format("{:.6g} cm: T max {:.1f} K, {}", 100.0 * gap.gap, gap.maximum.temperature,
                                  to_string(gap.judgement.verdict)));
    if (std::isfinite(deviation))
      numbers.back() += fmt::format(", {:+.2g} K against the safe computation, uncertainty {:.2g} K",
                                    deviation, uncertainty);
  }
  faults.insert(faults.end(), run.reserves.begin(), run.reserves.end());
  if (!compared) faults.emplace_back("the safe computation is not there to compare with");
  const Outcome outcome = wrong ? Outcome::wrong : faults.empty() ? Outcome::held : Outcome::degraded;
  faults.insert(faults.end(), numbers.begin(), numbers.end());
  return {outcome, joined_text(faults)};
}

/// The worst first: the enumeration is in that order.
Finding worst_of(std::vector<Finding> findings) {
  std::ranges::stable_sort(findings, std::ranges::greater{}, &Finding::outcome);
  Sentences texts;
  for (const Finding& each : findings) texts.push_back(each.text);
  return {findings.front().outcome, joined_text(texts)};
}

/// `against`: the safe computation; nullptr without one. Both ignite at `ignition_temperature`, K.
StressCaseRow judge(const StressCase& asked, const StressRun& run, const StressRun* against,
                    double ignition_temperature) {
  StressCaseRow row{asked, run.answer, run.end_time, {}, {}, {}};
  if (against != nullptr && row.computed() && !was_computed(against->answer)) row.answer = against->answer;
  if (!row.computed()) return row;
  for (std::size_t i = 0; against != nullptr && i < against->answer.verdicts.size(); ++i) {
    row.heated_against.push_back(against->answer.verdicts[i].heated);
    row.deviations.push_back(std::min(run.answer.verdicts[i].heated, ignition_temperature) -
                             std::min(row.heated_against[i], ignition_temperature));
  }
  std::vector<Finding> findings = run.findings;
  if (run.answer.completed())
    findings.insert(findings.begin(),
                    judge_launch(row, run, against == nullptr || against->answer.completed()));
  row.finding = worst_of(std::move(findings));
  return row;
}

}  // namespace

bool StressCase::has(std::string_view invariant) const {
  return std::ranges::any_of(invariants,
                             [invariant](std::size_t i) { return all_invariants()[i].name == invariant; });
}

bool StressCase::expects(Outcome outcome) const {
  if (outcome == Outcome::wrong) return false;
  return expected.empty() || std::ranges::count(expected, outcome) > 0;
}

bool StressCaseRow::computed() const { return was_computed(answer); }

bool StressCaseRow::is_as_expected() const { return computed() && asked.expects(finding.outcome); }

std::size_t StabilityResult::count(Outcome outcome) const {
  return static_cast<std::size_t>(
      std::ranges::count_if(rows, [outcome](const StressCaseRow& row) { return row.is(outcome); }));
}

StabilityResult run_stability(const StudyFile& study, const study::StudyOptions& options) {
  const auto compute = [&](StabilityResult& result) {
    std::vector<StressRun> runs(study.cases.size());
    run_every_case(study, options, result.timing,
                   [&](std::size_t i, std::vector<study::FinishedRun>& finished) {
                     runs[i] = run_from(study, i, finished);
                   });
    for (const StressCase& asked : settings_of<StabilitySettings>(study.study).cases) {
      if (asked.run)
        result.rows.push_back(
            judge(asked, runs[*asked.run], asked.against ? &runs[*asked.against] : nullptr,
                  study.cases[*asked.run].scene.scene.charge().kinetics.ignition_temperature));
      else
        result.rows.push_back({asked, {}, not_a_number, {}, {}, judge_reader(asked)});
    }
  };
  return run_timed<StabilityResult>(study, options, compute);
}

}  // namespace launchsafe::kinds
