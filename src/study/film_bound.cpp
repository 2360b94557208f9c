// The optimistic bound of a case: its gaps with air that conserves energy.
#include "launchsafe/study/gap_analysis.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace launchsafe::study {
namespace {

/// None of some gaps up to the last one ignites.
CriticalGap none_up_to(double largest, std::size_t gaps) {
  CriticalGap bound;
  bound.kind = CriticalGapKind::all_safe;
  bound.lower = largest;
  bound.reason = fmt::format("none of {} gaps up to {:.6g} cm ignites", gaps, 100.0 * largest);
  return bound;
}

}  // namespace

void evaluate_film(const Study& study, CaseOutcome& outcome) {
  const scene::Scene& scene = outcome.input.scene.scene;
  const trace::BottomTrace& trace = outcome.result.mechanics.trace;
  if (!outcome.completed() || trace.samples() == 0 || scene.surface.air_model != scene::AirModel::reservoir)
    return;
  surface::SkinModel model = surface::skin_model(scene);
  model.surface.air_model = scene::AirModel::film;
  std::vector<double> gaps = study.gaps;
  gaps.push_back(largest_gap(study));
  std::vector<double> temperatures(gaps.size());
  std::vector<GapState> states(gaps.size());
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(std::size_t{0}, gaps.size(), [&](std::size_t i) {
      const auto history = surface::integrate_skin(model, trace, gaps[i]);
      temperatures[i] = surface::maximum_at_stations(history, trace).temperature;
      states[i] = state_of(history);
    });
  });
  FilmBound film;
  film.maximum_temperature.assign(temperatures.begin(), temperatures.end() - 1);
  const bool all_safe =
      std::all_of(states.begin(), states.end(), [](GapState state) { return state == GapState::safe; });
  film.critical =
      all_safe ? none_up_to(gaps.back(), gaps.size())
               : find_critical_gap([&](double gap) { return state_of(surface::ignites(model, trace, gap)); },
                                   gaps.back(), study.tolerance);
  outcome.film = std::move(film);
}

}  // namespace launchsafe::study
