// The causes that make the critical gap of a case uncertain: the launches that they take beside the case's
// own, and the share of each, all computed on these launches.
#pragma once

#include "launchsafe/study/rows.hpp"

namespace launchsafe::study {

/// Observed order of the critical gap of the 155 mm shell over the cells, the smallest on either set of
/// constants (reports/accuracy), and the factor of safety of Roache's grid convergence index.
inline constexpr double order_of_cells = 0.3, factor_of_safety = 1.25;

/// Heat grows with the square of the pressure where the steel stays elastic; near 496 MPa, where the wall of
/// the 155 mm shell yields, with its power of 3.6 (17 K of 116 K for 4 %). Rounded up.
inline constexpr double heat_exponent = 4.0;

/// Random causes are taken at this many standard deviations: 97.7 % one-sided of a normal distribution.
inline constexpr double coverage_factor = 2.0;

/// Ratio of the cells of the companion launch to those of a scene: 2, or 1/2 where cells twice as large would
/// be fewer than two across a station.
double companion_ratio(const scene::Scene& scene);

/// A launch that the bounds of a case rest on.
struct SideLaunch {
  Part part = Part::companion;
  std::string name = {};  ///< of the other constants
  /// Of the scene of a case. Throws an InputError where other constants make no valid scene.
  std::function<scene::Scene(const StudyCase& input)> scene;
};
/// Those of a case of a study, none where it gives no verdicts.
std::vector<SideLaunch> side_launches(const Study& study, const StudyCase& input);

/// The shares of all causes in the critical gap of a case, from the finished launches of the case, the first
/// being its own; NaN where a launch did not complete.
std::vector<CauseShare> causes_of(const Study& study, const StudyCase& input,
                                  const std::vector<FinishedRun>& runs, const CriticalGap& critical);

/// The critical gaps of a case under the other constants of its study; NaN for launches that did not
/// complete.
std::vector<ModelGap> gaps_of_models(const Study& study, const StudyCase& input,
                                     const std::vector<FinishedRun>& runs, const CriticalGap& critical);

/// Which launches beside the case's own did not complete and why; empty where all did.
std::string incomplete_launches(const std::vector<FinishedRun>& runs);

/// A skin that air and friction heat, and nothing else.
surface::SkinModel without_reaction(surface::SkinModel model);
/// T max (K) of such a skin under a gap (m), over the stations that tile the bottom.
double heated_temperature(const surface::SkinModel& model, const trace::BottomTrace& trace, double gap);

}  // namespace launchsafe::study
