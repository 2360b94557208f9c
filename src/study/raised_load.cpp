#include "launchsafe/study/raised_load.hpp"

#include "launchsafe/study/case_uncertainty.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace launchsafe::study {
namespace {

/// The axis over the peak pressure of a full factorial, and how many cases lie between neighbours on it.
struct PressureAxis {
  std::vector<double> peaks;  ///< Pa, in the order written
  std::size_t stride = 1;
};

/// Nothing where launches under other loads end at other times.
std::optional<PressureAxis> pressure_axis(const StudyFile& study) {
  if (study.scene.scene.load.muzzle_travel) return std::nullopt;
  std::optional<PressureAxis> found;
  std::size_t cases = 1;
  for (std::size_t i = study.study.axes.size(); i-- > 0;) {
    const Axis& axis = study.study.axes[i];
    if (axis.key.name == "load.peak") found = {axis.values, cases};
    cases *= axis.values.size();
  }
  return cases == study.cases.size() ? found : std::nullopt;
}

bool are_neighbours(double lower, double upper) {
  const double ratio = upper / lower;
  return ratio >= least_load_ratio && ratio <= largest_load_ratio;
}

/// The place of the pressure nearest to one among those that are its neighbours on one side.
std::optional<std::size_t> neighbour_of(double peak, const std::vector<double>& peaks, bool above) {
  std::optional<std::size_t> nearest;
  for (std::size_t i = 0; i < peaks.size(); ++i) {
    if (!(above ? are_neighbours(peak, peaks[i]) : are_neighbours(peaks[i], peak))) continue;
    if (!nearest || std::abs(peaks[i] - peak) < std::abs(peaks[*nearest] - peak)) nearest = i;
  }
  return nearest;
}

}  // namespace

bool propagates_spread(const Study& study) {
  return study.kind.gives_verdicts && study.kind.bounds_critical_gaps &&
         !std::isfinite(study.input_uncertainty);
}

std::string label_of_raised(const StudyCase& input) {
  return fmt::format("{}, load +{:.3g} %", input.label, 100.0 * assumed_load_spread);
}

scene::Scene with_raised_load(const scene::Scene& scene) {
  scene::Scene raised = scene;
  const double factor = 1.0 + assumed_load_spread;
  scene::Load& load = raised.load;
  load.peak *= factor;
  if (!load.rescale_to_peak) {
    for (double& pressure : load.curve_pressure) pressure *= factor;
  }
  return raised;
}

std::optional<NeighbouringLoads> neighbouring_loads(const StudyFile& study, std::size_t index) {
  if (study.study.raised_load != RaisedLoad::interpolated) return std::nullopt;
  const auto axis = pressure_axis(study);
  if (!axis) return std::nullopt;
  const std::vector<double>& peaks = axis->peaks;
  const std::size_t own = index / axis->stride % peaks.size();
  const auto above = neighbour_of(peaks[own], peaks, true);
  auto beside = neighbour_of(peaks[own], peaks, false);
  if (above && !beside) beside = neighbour_of(peaks[*above], peaks, true);
  if (!above || !beside) return std::nullopt;
  const auto at = [&](std::size_t place) { return index + (place - own) * axis->stride; };
  const NeighbouringLoads loads{at(*above), at(*beside), peaks[own], peaks[*above], peaks[*beside]};
  // One with a scene of its own may differ in more.
  for (const std::size_t each : {index, loads.above, loads.beside})
    if (study.cases.has_own_scene(each)) return std::nullopt;
  return loads;
}

void interpolate_raised_load(const NeighbouringLoads& loads, std::vector<FinishedRun>& runs) {
  const auto beside = runs.begin() + 2;
  FinishedRun &own = runs[0], &raised = runs[1];
  if (raised.has_result() && raised.failure.empty()) {
    const auto trace = [](const FinishedRun& run) -> const trace::BottomTrace& {
      return run.result.mechanics.trace;
    };
    if (!beside->has_result() || !beside->failure.empty()) {
      raised = *beside;
    } else if (auto between =
                   trace::at_load((1.0 + assumed_load_spread) * loads.own_peak, {loads.own_peak, trace(own)},
                                  {loads.above_peak, trace(raised)}, {loads.beside_peak, trace(*beside)})) {
      raised.result.mechanics.trace = std::move(*between);
    } else {
      raised = {};
      raised.failure = "the run failed: launches at neighbouring peak pressures end at other times";
    }
  }
  runs.erase(beside);
}

}  // namespace launchsafe::study
