// What the sources of a calibration share: what is published of a row as computed on a trace, and the bell
// that meets, with localisation and exchange time, what is published of the calibrated rows.
#pragma once

#include "launchsafe/kinds/calibration.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {

/// Weights of the fit: standard deviations of what is published.
inline constexpr double temperature_weight = 0.5;  ///< K
inline constexpr double instant_weight = 0.5e-3;   ///< s: the text reads to half a millisecond

/// When the highest temperature of the stations rises fast: where its rate, over half a millisecond, is more
/// than 15 % of its largest.
struct FastRise {
  double begins = not_a_number;  ///< s
  double ends = not_a_number;    ///< s; where it is `unfinished`, the last instant that has a rate
  bool unfinished = false;       ///< it is still fast there
};
FastRise fast_rise(const surface::SkinHistory& history, const BottomTrace& trace);

/// Without the trigger: nothing happens at T1, and self-heating that runs away ends at T2.
SkinModel untriggered(SkinModel model);

/// How many numbers a fit of the load has of a row.
std::size_t fitted_numbers(const Reference& row);
/// Computed minus published, each over its weight, of those of the row without a gap and of the wide one:
/// highest temperature, that at the early time, and the instants at which its fast rise begins and ends, as
/// far as they are published. Without a trigger.
std::vector<double> weighted_misfits(const SkinModel& model, const BottomTrace& trace,
                                     const CalibrationTargets& targets);

/// Why constants must not be fitted to a run that completed, a clause: it has validity warnings, or its scene
/// has values that are not plausible and that nobody accepted. Empty for a sound one.
std::string calibration_validity_warnings(const Scene& scene, const MechanicsResult& mechanics);

/// The targets among a study's references; throws what is missing.
CalibrationTargets calibration_targets(const StudyFile& study);

/// Fills the compared numbers and the root mean squares of a row.
void compare(const Study& study, const SkinModel& model, const BottomTrace& trace, CalibrationRow& row);

/// How the runs of a calibration went.
Table run_table(const std::vector<CalibrationRun>& runs);

/// Fits peak time, width and steepness of the scene's bell, with localisation and exchange time, to all
/// `weighted_misfits`, starting from the scene: one mechanical run on its mesh for every load that is tried,
/// those of one Jacobian at once. `timing` counts them.
FittedLoad fit_load(const StudyFile& study, const CalibrationTargets& targets, const StudyOptions& options,
                    study::Timing& timing);

}  // namespace launchsafe::kinds
