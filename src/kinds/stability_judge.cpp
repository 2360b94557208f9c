#include "stability_judge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

using verify::Finding, verify::Outcome;

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

}  // namespace

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
  return row;
}

}  // namespace launchsafe::kinds
