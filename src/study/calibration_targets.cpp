// Which published rows a calibration fits to; the study's reader asks too, before anything is computed.
#include "launchsafe/study/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::study {
namespace {

scene::InputError missing(const StudyFile& study, std::string found, std::string allowed) {
  const auto first = study.places.find("reference.0.gap");
  const auto kind = study.places.find("kind");
  const scene::Place place = first != study.places.end()  ? first->second
                             : kind != study.places.end() ? kind->second
                                                          : scene::Place{study.file};
  return scene::error_at(place, "reference", std::move(found), std::move(allowed));
}

}  // namespace

scene::Expected<CalibrationTargets> calibration_targets(const StudyFile& study) {
  CalibrationTargets targets;
  double safe = -1.0, igniting = 1e300;
  int zero = 0, wide = 0;
  for (const Reference& row : study.study.references) {
    if (row.ignited()) {
      igniting = std::min(igniting, row.gap);
      continue;
    }
    safe = std::max(safe, row.gap);
    if (!row.calibrated) continue;
    const bool is_zero = row.gap == 0.0;
    ++(is_zero ? zero : wide);
    (is_zero ? targets.zero_gap : targets.wide_gap) = row;
    if (!std::isfinite(row.maximum_temperature))
      return missing(study, "a calibrated row without maximum_temperature", "one with it");
  }
  if (zero != 1 || wide != 1) {
    return missing(study, fmt::format("{} calibrated rows at gap 0 and {} at other gaps", zero, wide),
                   "one calibrated row at gap 0 (sets the localisation) and one at another gap that does not "
                   "ignite (sets the exchange time)");
  }
  if (igniting > 1.0 || !(safe < igniting)) {
    return missing(study,
                   igniting > 1.0 ? "no row that ignites" : "a row that ignites below one that does not",
                   "rows with an ignition_time, all at larger gaps than the rows without");
  }
  const std::vector<double>& rise = study.study.fast_rise;
  if (!rise.empty() && !(rise.size() == 2 && rise[0] < rise[1])) {
    return missing(
        study,
        rise.size() == 2 ? fmt::format("{:.6g} and {:.6g} ms in fast_rise", 1e3 * rise[0], 1e3 * rise[1])
                         : fmt::format("{} instants in fast_rise", rise.size()),
        "two, the earlier one first: when the temperature without a gap begins and ceases to rise fast");
  }
  const bool early = targets.zero_gap.early_calibrated && std::isfinite(targets.zero_gap.early_temperature);
  if (!rise.empty() && (!early || !study.scene.scene.load.curve_time.empty())) {
    return missing(study,
                   early ? "fast_rise beside a measured curve"
                         : "fast_rise without an early temperature to fit the load to",
                   "an analytic load, and early_calibrated = true with early_temperature in the calibrated "
                   "row at gap 0");
  }
  targets.safe_gap = safe;
  targets.igniting_gap = igniting;
  return targets;
}

}  // namespace launchsafe::study
