// Friction closures: which strain of the charge the sliding of its layers is (paper Eq. 39). A new one is an
// enumerator and a row here; scene files, traces, case files, calibrations and reports take it from the
// table.
#pragma once

#include "launchsafe/math/deviator.hpp"

#include <array>
#include <string_view>

namespace launchsafe::materials {

/// `none` is the last: the others are the indices of the table below.
enum class FrictionClosure { total_strain_rate, none };

/// What a step did to the charge at a place.
struct SlidingStep {
  double pressure = 0;              ///< Pa at its end, compression positive
  double volume_ratio = 0;          ///< V at its end
  math::Deviator<double> strain{};  ///< increment
};

struct FrictionClosureRow {
  std::string_view word;                      ///< in scene files and reports
  std::string_view stored_word;               ///< in case files
  double (*strain)(const SlidingStep& step);  ///< increment of the equivalent strain that slides
};

inline constexpr std::array friction_closures{
    FrictionClosureRow{"total strain rate", "literal",
                       [](const SlidingStep& step) { return math::equivalent_strain(step.strain); }},
};
static_assert(friction_closures.size() == static_cast<std::size_t>(FrictionClosure::none));

/// All of them, `none` last.
inline constexpr auto all_closures = [] {
  std::array<FrictionClosure, friction_closures.size() + 1> all{};
  for (std::size_t row = 0; row < all.size(); ++row) all[row] = static_cast<FrictionClosure>(row);
  return all;
}();

/// The word of a closure: that of its row, or "none".
constexpr std::string_view word_of(FrictionClosure closure) {
  const auto row = static_cast<std::size_t>(closure);
  return row < friction_closures.size() ? friction_closures[row].word : std::string_view("none");
}

/// Friction heat of a step by closure, J per m3 of the charge at rest, with localisation 1: mu_d p V times
/// the strain. None in tension.
inline std::array<double, friction_closures.size()> sliding_heat(double sliding_friction,
                                                                 const SlidingStep& step) {
  const double pressure = step.pressure < 0.0 ? 0.0 : step.pressure;  // NaN stays one
  const double sliding = sliding_friction * pressure * step.volume_ratio;
  std::array<double, friction_closures.size()> heat{};
  for (std::size_t row = 0; row < heat.size(); ++row)
    heat[row] = sliding * friction_closures[row].strain(step);
  return heat;
}

}  // namespace launchsafe::materials
