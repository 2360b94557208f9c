// Heat of the charge's layers that slide (paper Eq. 39).
#pragma once

#include "launchsafe/math/deviator.hpp"

#include <string_view>

namespace launchsafe::materials {

/// Which strain rate of the charge is the sliding of its layers.
enum class FrictionClosure { total_strain_rate, none };

/// Its word in scene files and reports.
constexpr std::string_view word_of(FrictionClosure closure) {
  return closure == FrictionClosure::none ? "none" : "total strain rate";
}

/// What a step did to the charge at a place.
struct SlidingStep {
  double pressure = 0;              ///< Pa at its end, compression positive
  double volume_ratio = 0;          ///< V at its end
  math::Deviator<double> strain{};  ///< increment
};

/// Friction heat of a step by the total strain, J per m3 of the charge at rest, with localisation 1: mu_d p V
/// times the equivalent strain. None in tension.
inline double sliding_heat(double sliding_friction, const SlidingStep& step) {
  const double pressure = step.pressure < 0.0 ? 0.0 : step.pressure;  // NaN stays one
  return sliding_friction * pressure * step.volume_ratio * math::equivalent_strain(step.strain);
}

}  // namespace launchsafe::materials
