// The gaps of a case on other terms than those of its verdicts: with air that conserves energy, and in a
// launch that goes on for longer.
#include "launchsafe/scene/launch_end.hpp"
#include "launchsafe/study/gap_analysis.hpp"
#include "launchsafe/study/run_cases.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::study {
namespace {

/// None of some gaps up to the last one ignites.
CriticalGap none_up_to(double largest, std::size_t gaps) {
  CriticalGap bound;
  bound.kind = CriticalGapKind::all_safe;
  bound.lower = largest;
  bound.reason = {.code = GapReason::Code::none_of_gaps, .gap = largest, .gaps = gaps};
  return bound;
}

OtherAnswer answer_on(const Study& study, const surface::SkinModel& model, const trace::BottomTrace& whole) {
  const trace::BottomTrace trace = trace::of_rings(whole);
  std::vector<double> gaps = study.gaps;
  gaps.push_back(largest_gap(study));
  std::vector<double> temperatures(gaps.size());
  std::vector<GapState> states(gaps.size());
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, gaps.size(), [&](std::size_t i) {
      const auto history = surface::integrate_skin(model, trace, gaps[i]);
      temperatures[i] =
          std::max(surface::maximum_at_stations(history, trace).temperature, history.hottest_depth);
      states[i] = state_of(history);
    });
  });
  OtherAnswer answer;
  answer.maximum_temperature.assign(temperatures.begin(), temperatures.end() - 1);
  const surface::IgnitionOfGaps ignites(model, trace);
  const bool all_safe =
      std::all_of(states.begin(), states.end(), [](GapState state) { return state == GapState::safe; });
  answer.critical = all_safe ? none_up_to(gaps.back(), gaps.size())
                             : find_critical_gap([&](double gap) { return state_of(ignites(gap)); },
                                                 gaps.back(), study.tolerance);
  return answer;
}

}  // namespace

void evaluate_film(const Study& study, CaseOutcome& outcome) {
  const scene::Scene& scene = outcome.input.scene.scene;
  const trace::BottomTrace& trace = outcome.result.mechanics.trace;
  if (!outcome.completed() || trace.samples() == 0 || scene.surface.air_model != scene::AirModel::reservoir)
    return;
  surface::SkinModel model = surface::skin_model(scene);
  model.surface.air_model = scene::AirModel::film;
  outcome.film = answer_on(study, model, trace);
}

void evaluate_longer_launch(const Study& study, const run::MechanicsResult& mechanics, CaseOutcome& outcome) {
  const std::optional<scene::Scene> longer = with_longer_launch(outcome.input.scene.scene);
  if (longer && mechanics.status == run::RunStatus::completed && mechanics.trace.samples() > 0) {
    outcome.longer_launch = answer_on(study, surface::skin_model(*longer), mechanics.trace);
    return;
  }
  OtherAnswer none{std::vector<double>(study.gaps.size(), not_a_number), {}};
  none.critical.reason = {.code = GapReason::Code::longer_launch_failed, .detail = failure_of(mechanics)};
  outcome.longer_launch = std::move(none);
}

double when_launch_is_over(const CaseOutcome& outcome, std::size_t gap) {
  if (!outcome.longer_launch || !scene::is_cut_short(outcome.input.scene.scene.load)) return not_a_number;
  return outcome.longer_launch->maximum_temperature.at(gap);
}

}  // namespace launchsafe::study
