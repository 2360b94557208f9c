#include "launchsafe/study/case_answer.hpp"

#include "case_runs.hpp"
#include "gap_analysis.hpp"

namespace launchsafe::study {
namespace {

CaseAnswer without_histories(CaseOutcome& outcome) {
  CaseAnswer answer;
  answer.failure = std::move(outcome.failure);
  answer.critical = std::move(outcome.critical);
  answer.critical_anywhere = std::move(outcome.critical_anywhere);
  answer.verdicts = std::move(outcome.verdicts);
  return answer;
}

}  // namespace

CaseAnswer answer_of(const Study& study, const StudyCase& input, const run::MechanicsResult& mechanics,
                     const std::optional<run::MechanicsResult>& raised) {
  CaseOutcome outcome;
  outcome.input = input;
  outcome.result.mechanics = mechanics;
  outcome.failure = detail::failure_of(mechanics, {true, {}});
  outcome.raised = raised;
  detail::find_critical_gaps(study, outcome);
  detail::evaluate_gaps(study, outcome);
  detail::apply_confirmations(study, outcome);
  detail::conclude(study, outcome);
  CaseAnswer answer = without_histories(outcome);
  for (const GapVerdict& row : answer.verdicts)
    answer.heated_temperature.push_back(answer.completed() ? row.heated : not_a_number);
  answer.run = {mechanics.status, mechanics.steps, mechanics.particles, run::largest_energy_drift(mechanics),
                mechanics.limiters};
  return answer;
}

CaseAnswer failed_answer(const Study& study, const StudyCase& input, std::string failure) {
  CaseOutcome outcome;
  outcome.input = input;
  outcome.failure = std::move(failure);
  detail::find_critical_gaps(study, outcome);
  detail::evaluate_gaps(study, outcome);
  detail::conclude(study, outcome);
  CaseAnswer answer = without_histories(outcome);
  answer.heated_temperature.assign(study.gaps.size(), not_a_number);
  return answer;
}

}  // namespace launchsafe::study
