// The analytic load that meets what is published of the rise without a gap: its duration and an early
// temperature.
#pragma once

#include "launchsafe/kinds/calibration.hpp"

namespace launchsafe::kinds {

/// Why constants must not be fitted to a run that completed, a clause: it has validity warnings, or its scene
/// has values that are not plausible and that nobody accepted. Empty for a sound one.
std::string calibration_validity_warnings(const scene::Scene& scene, const run::MechanicsResult& mechanics);

/// Fits exponent and peak time to Study::fast_rise and to the row without a gap whose early temperature is to
/// be met, with localisation, exchange time and T1 calibrated on every load that is tried: each is a
/// mechanical run on the mesh of the scene. `timing` counts them.
FittedLoad fit_load(const study::StudyFile& study, const CalibrationTargets& targets,
                    const study::StudyOptions& options, study::Timing& timing);

/// A scene under that load. Only of one without a failure.
scene::SceneFile with_load(const scene::SceneFile& scene, const FittedLoad& load);

}  // namespace launchsafe::kinds
