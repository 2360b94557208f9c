#include "launchsafe/study/constants_of_study.hpp"

namespace launchsafe::study {
namespace {

constexpr double not_found = -1.0;

/// Largest published temperature (K) of a gap (m), whenever it was; `not_found` without one.
double published_temperature(const scene::Constants& constants, double gap) {
  double highest = not_found;
  for (const scene::FittedNumber& row : constants.rows)
    if (row.is_fitted && row.quantity.starts_with("T at") && row.gap == gap)
      highest = std::max(highest, row.published);
  return highest;
}

/// The published gap (m) with a temperature that is nearest to half of the largest: air heats it, and it does
/// not yet react.
double middle_gap(const scene::Constants& constants, double largest) {
  double middle = 0.0;
  for (const scene::FittedNumber& row : constants.rows)
    if (std::abs(row.gap - 0.5 * largest) < std::abs(middle - 0.5 * largest)) middle = row.gap;
  return middle;
}

/// K, T max by the constants: twice the root mean square of what the fit missed, or half the distance between
/// the temperatures that the ignition temperature separates.
double fit_uncertainty_of(const scene::Constants& constants) {
  double squares = 0.0;
  int count = 0;
  for (const scene::FittedNumber& row : constants.rows) {
    if (!row.is_fitted || !row.quantity.starts_with("T at")) continue;
    squares += row.misfit() * row.misfit();
    ++count;
  }
  const double missed = count > 0 ? 2.0 * std::sqrt(squares / count) : 0.0;
  return std::max(missed, 0.5 * (constants.ignition_highest - constants.ignition_lowest));
}

}  // namespace

Calibration calibration_of(const scene::Constants& constants) {
  Calibration calibration{constants.scene, {}};
  CalibrationEvidence& evidence = calibration.evidence;
  double largest = 0.0;
  for (const scene::FittedNumber& row : constants.rows) largest = std::max(largest, row.gap);
  if (!(largest > 0.0)) return calibration;
  const double without_gap = published_temperature(constants, 0.0);
  evidence.friction_rise = without_gap - constants.scene.initial_temperature;
  evidence.air_rise = published_temperature(constants, middle_gap(constants, largest)) - without_gap;
  evidence.largest_gap = largest;
  evidence.fit_uncertainty = fit_uncertainty_of(constants);
  return calibration;
}

Calibration shipped_calibration() { return calibration_of(*scene::shipped_constants().front()); }

void use_constants(StudyFile& study, const std::filesystem::path& folder) {
  constexpr const char* key = "constants";
  if (const std::string& name = study.study.constants; !name.empty()) {
    auto constants = scene::find_constants(name, folder, place_of_key(study, key), key);
    study.scene = scene::with_constants(study.scene, std::move(constants)).or_throw();
  }
  if (study.scene.constants != nullptr) study.study.calibration = calibration_of(*study.scene.constants);
}

}  // namespace launchsafe::study
