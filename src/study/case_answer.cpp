#include "launchsafe/study/case_answer.hpp"

#include "launchsafe/study/case_uncertainty.hpp"
#include "launchsafe/study/closing_gaps.hpp"
#include "launchsafe/study/gap_analysis.hpp"
#include "launchsafe/study/run_cases.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace launchsafe::study {
namespace {

/// Whether a row that was read was evaluated with the constants that have to be accepted, and states no less
/// uncertainty than the study and the constants have at the least.
bool is_as_uncertain(const GapVerdict& row, const std::vector<std::string>& calibrated_keys,
                     const CaseStatements& statements, const Study& study, const StudyCase& input) {
  const Uncertainty& u = row.uncertainty;
  return std::ranges::equal(row.as_calibrated, calibrated_keys, {}, &AsCalibrated::key) &&
         !(u.numerical < input.numerical_uncertainty) &&
         !(u.fit < fit_share(study, statements.distance, {}, 1.0)) &&
         !(u.model_form < stated_model_form_share(study, input, statements.model_form).value_or(0.0)) &&
         !(u.input < stated_input_share(study, input));
}

/// Whether the shares of a critical gap that was read are all there that the study's case must have.
bool has_all_shares(const CriticalGap& critical, const Study& study, const StudyCase& input,
                    const CaseStatements& statements) {
  const bool is_film = input.scene.scene.surface.air_model == scene::AirModel::film;
  const bool bounded = critical.kind == CriticalGapKind::value || critical.kind == CriticalGapKind::all_safe;
  if (!study.kind.bounds_critical_gaps || is_film || !bounded) return true;
  const auto has = [&](ShareKind kind) {
    return std::any_of(critical.shares.begin(), critical.shares.end(),
                       [kind](const GapShare& share) { return share.kind == kind; });
  };
  if (propagates_spread(study) &&
      !(has(ShareKind::peak_pressure) && has(ShareKind::pulse_length) && has(ShareKind::initial_temperature)))
    return false;
  if (!skin_keys(statements.to_be_accepted()).empty() && !has(ShareKind::accepted)) return false;
  return (has(ShareKind::computation) || !(input.numerical_uncertainty > 0.0)) &&
         (has(ShareKind::fit) || !(fit_share(study, statements.distance, {}, 1.0) > 0.0)) &&
         (has(ShareKind::stated_inputs) || !(stated_input_share(study, input) > 0.0)) &&
         (has(ShareKind::model_form) ||
          !(stated_model_form_share(study, input, statements.model_form).value_or(1.0) > 0.0));
}

/// Whether an answer that was read can be that of the study's case: its gaps, and margins and times that the
/// case's scene allows, and no less uncertainty and no fewer validity warnings than its input has.
bool fits(const CaseAnswer& answer, const Study& study, const StudyCase& input,
          const CaseStatements& statements) {
  const scene::Scene& scene = input.scene.scene;
  const double ignition_temperature = scene.charge().kinetics.ignition_temperature;
  // A step may end a little beyond the duration.
  const double end = scene::end_time(scene.load) * (1.0 + 1e-6);
  const auto is_late = [end](const Peak& peak) { return peak.time > end; };
  if (answer.verdicts.size() != study.gaps.size()) return false;
  if (answer.critical.kind == CriticalGapKind::value &&
      answer.critical.upper > largest_gap(study) * (1.0 + 1e-9))
    return false;
  const auto has_warning = [&](const std::string& warning) {
    return std::ranges::find(answer.validity_warnings, warning) != answer.validity_warnings.end();
  };
  std::vector<std::string> calibrated_keys;
  if (study.kind.gives_verdicts) calibrated_keys = keys_as_calibrated(statements.to_be_accepted());
  const bool is_asked = !study.kind.gives_verdicts || std::isfinite(answer.friction_rise);
  if (answer.completed() && !(is_asked && std::ranges::all_of(statements.uncovered_load, has_warning) &&
                              has_all_shares(answer.critical, study, input, statements)))
    return false;
  for (std::size_t i = 0; i < study.gaps.size(); ++i) {
    const GapVerdict& row = answer.verdicts[i];
    if (row.gap != study.gaps[i] || is_late(row.maximum) || is_late(row.early)) return false;
    // Both are finite or both are not; the subtraction is the one by which the margin came about.
    const double margin = ignition_temperature - row.maximum.temperature;
    if (row.margin != margin && (std::isfinite(row.margin) || std::isfinite(margin))) return false;
    if (std::isfinite(row.maximum.temperature) &&
        !(std::isfinite(row.air.taken) && std::isfinite(row.air.supplied)))
      return false;
    if (answer.completed() && !is_as_uncertain(row, calibrated_keys, statements, study, input)) return false;
    // Nothing cools a skin below where it began.
    if (row.maximum.temperature < scene.initial_temperature - 1.0) return false;
  }
  return true;
}

}  // namespace

CaseAnswer answer_of(const Study& study, const StudyCase& input, const run::MechanicsResult& mechanics,
                     const std::optional<run::MechanicsResult>& raised) {
  CaseOutcome outcome;
  outcome.input = input;
  outcome.result.mechanics = mechanics;
  outcome.failure = failure_of(mechanics);
  outcome.raised = raised;
  evaluate(study, outcome);
  apply_confirmations(study, outcome);
  conclude(study, outcome);
  return answer_of(outcome);
}

CaseAnswer answer_of(const CaseOutcome& outcome) {
  CaseAnswer answer;
  answer.outcome = outcome.outcome;
  answer.failure = outcome.failure;
  answer.validity_warnings = outcome.evidence->validity_warnings;
  answer.friction_rise = outcome.evidence->friction_rise;
  answer.critical = outcome.critical;
  answer.verdicts = outcome.verdicts;
  answer.closing = outcome.closing;
  for (const GapVerdict& row : answer.verdicts)
    answer.heated_temperature.push_back(answer.completed() ? row.heated : not_a_number);
  const run::MechanicsResult& mechanics = outcome.result.mechanics;
  answer.run = {mechanics.status, mechanics.steps, mechanics.particles, run::largest_energy_drift(mechanics),
                mechanics.limiters};
  return answer;
}

void take_closing(const StudyCase& input, std::vector<ClosingAnswer> closing, CaseAnswer& answer) {
  answer.closing = std::move(closing);
  const double ignition = input.scene.scene.charge().kinetics.ignition_temperature;
  for (GapVerdict& row : answer.verdicts) {
    row.evidence.closing = closing_evidence(answer.closing, row.gap, ignition);
    row.judgement = judge(row.evidence, answer.critical);
  }
}

CaseAnswer failed_answer(const Study& study, const StudyCase& input, RunOutcome of_run, std::string failure) {
  CaseOutcome outcome = without_result(study, input, of_run, std::move(failure));
  conclude(study, outcome);
  return answer_of(outcome);
}

std::optional<CaseAnswer> judged(CaseAnswer answer, const Study& study, const StudyCase& input) {
  CaseStatements statements = statements_of(study, input);
  if (!fits(answer, study, input, statements)) return std::nullopt;
  const auto evidence = std::make_shared<const CaseEvidence>(
      CaseEvidence{answer.completed(), answer.failure, answer.run.limiters, answer.validity_warnings,
                   answer.friction_rise, std::move(statements)});
  answer.critical.reason.of_case = evidence;
  judge_rows(study, evidence, answer.critical, answer.verdicts);
  return answer;
}

}  // namespace launchsafe::study
