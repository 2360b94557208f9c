// What accepted constants of the surface do: the same skin with them as they are calibrated, on the same
// trace.
#pragma once

#include "launchsafe/scene/plausibility.hpp"
#include "launchsafe/trace/bottom_trace.hpp"

#include <string>
#include <vector>

namespace launchsafe::study {

/// A skin with one constant as calibrated.
struct AsCalibrated {
  std::string key;         ///< the constant; empty: all that heat or cool the skin, together
  double temperature = 0;  ///< K, T max over the stations
  bool ignites = false;
};

/// Of what has to be accepted, the constants that heat or cool the skin on a given trace: those of gap and
/// friction, and single ones of the charge. Accepting them makes no gap safe.
std::vector<std::string> skin_keys(const std::vector<scene::Implausible>& to_be_accepted);
/// What a skin can be evaluated anew with: all of these together (""), where there are any, then each, then
/// each constant of the kinetics.
std::vector<std::string> keys_as_calibrated(const std::vector<scene::Implausible>& to_be_accepted);

/// The scene with these keys as calibrated. Its trace keeps the heat of its own sliding friction, for which
/// the localisation makes up.
scene::Scene with_calibrated(const scene::Scene& scene, const scene::Scene& calibrated,
                             const std::vector<std::string>& keys);

/// The skin of a gap (m) with each of keys_as_calibrated as calibrated.
std::vector<AsCalibrated> as_calibrated(const scene::Scene& scene, const scene::Scene& calibrated,
                                        const std::vector<scene::Implausible>& to_be_accepted,
                                        const trace::BottomTrace& trace, double gap);

/// K from there to ignition with all skin_keys as calibrated; infinite where there are none, minus
/// infinite where it ignites.
double margin_as_calibrated(const std::vector<AsCalibrated>& all, double ignition_temperature);

}  // namespace launchsafe::study
