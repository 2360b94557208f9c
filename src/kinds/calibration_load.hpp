// The bell that meets, with localisation and exchange time, what is published of the calibrated rows.
#pragma once

#include "launchsafe/kinds/calibration.hpp"

namespace launchsafe::kinds {

/// Why constants must not be fitted to a run that completed, a clause: it has validity warnings, or its scene
/// has values that are not plausible and that nobody accepted. Empty for a sound one.
std::string calibration_validity_warnings(const scene::Scene& scene, const run::MechanicsResult& mechanics);

/// Fits peak time, width and steepness of the scene's bell, with localisation and exchange time, to all
/// `weighted_misfits`, starting from the scene: one mechanical run on its mesh for every load that is tried,
/// those of one Jacobian at once. `timing` counts them.
FittedLoad fit_load(const study::StudyFile& study, const CalibrationTargets& targets,
                    const study::StudyOptions& options, study::Timing& timing);

/// A scene under that load. Only of one without a failure.
scene::SceneFile with_load(const scene::SceneFile& scene, const FittedLoad& load);

}  // namespace launchsafe::kinds
