#include "launchsafe/study/case_answer.hpp"

#include "case_runs.hpp"
#include "gap_analysis.hpp"

#include <cmath>

namespace launchsafe::study {
namespace {

double heated_temperature(const CaseOutcome& outcome, double gap) {
  const trace::BottomTrace& trace = outcome.result.mechanics.trace;
  const surface::SkinModel model = detail::without_reaction(surface::skin_model(outcome.input.scene.scene));
  return surface::maximum_at_observation_points(surface::integrate_skin(model, trace, gap), trace)
      .temperature;
}

CaseAnswer without_histories(CaseOutcome& outcome) {
  CaseAnswer answer;
  answer.failure = std::move(outcome.failure);
  answer.critical = std::move(outcome.critical);
  answer.critical_anywhere = std::move(outcome.critical_anywhere);
  answer.verdicts = std::move(outcome.verdicts);
  return answer;
}

}  // namespace

CaseAnswer answer_of(const Study& study, const StudyCase& input, const run::MechanicsResult& mechanics) {
  CaseOutcome outcome;
  outcome.input = input;
  outcome.result.mechanics = mechanics;
  outcome.failure = detail::failure_of(mechanics, {true, {}});
  detail::find_critical_gaps(study, outcome);
  detail::evaluate_gaps(study, outcome);
  detail::apply_confirmations(study, outcome);
  detail::conclude(study, outcome);
  std::vector<double> heated;
  for (const double gap : study.gaps) {
    heated.push_back(outcome.completed() ? heated_temperature(outcome, gap) : not_a_number);
  }
  CaseAnswer answer = without_histories(outcome);
  answer.heated_temperature = std::move(heated);
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

bool fits(const CaseAnswer& answer, const Study& study, const StudyCase& input) {
  const scene::Scene& scene = input.scene.scene;
  const double ignition_temperature = scene.charge.kinetics.ignition_temperature;
  // A step may end a little beyond the duration.
  const double end = scene.load.duration * (1.0 + 1e-6);
  const auto is_late = [end](const Peak& peak) { return peak.time > end; };
  if (answer.verdicts.size() != study.gaps.size()) return false;
  for (std::size_t i = 0; i < study.gaps.size(); ++i) {
    const GapVerdict& row = answer.verdicts[i];
    if (row.gap != study.gaps[i] || is_late(row.maximum) || is_late(row.early) || is_late(row.anywhere))
      return false;
    // Both are finite or both are not; the subtraction is the one by which the margin came about.
    const double margin = ignition_temperature - row.maximum.temperature;
    if (row.margin != margin && (std::isfinite(row.margin) || std::isfinite(margin))) return false;
    // Nothing cools a skin below where it began.
    if (row.maximum.temperature < scene.initial_temperature - 1.0) return false;
  }
  return true;
}

}  // namespace launchsafe::study
