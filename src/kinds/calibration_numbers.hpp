// What is published of a row as computed on a trace, for fits and for comparison.
#pragma once

#include "launchsafe/kinds/calibration.hpp"
#include "launchsafe/math/nonlinear_least_squares.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace launchsafe::kinds {

/// Weights of the fit: standard deviations of what is published.
inline constexpr double temperature_weight = 0.5;  ///< K
inline constexpr double instant_weight = 0.5e-3;   ///< s: the text reads to half a millisecond

/// Step of the forward differences, in the logarithms of the unknowns.
inline constexpr double difference_step = 5e-3;

/// When the highest temperature of the stations rises fast: where its rate, over half a millisecond, is more
/// than 15 % of its largest.
struct FastRise {
  double begins = study::not_a_number;  ///< s
  double ends = study::not_a_number;    ///< s; where it is `unfinished`, the last instant that has a rate
  bool unfinished = false;              ///< it is still fast there
};
FastRise fast_rise(const surface::SkinHistory& history, const trace::BottomTrace& trace);

/// Without the trigger: nothing happens at T1, and self-heating that runs away ends at T2.
surface::SkinModel untriggered(surface::SkinModel model);

/// How many numbers a fit of the load has of a row.
std::size_t fitted_numbers(const study::Reference& row);
/// Computed minus published, each over its weight, of those of the row without a gap and of the wide one:
/// highest temperature, that at the early time, and the instants at which its fast rise begins and ends, as
/// far as they are published. Without a trigger.
std::vector<double> weighted_misfits(const surface::SkinModel& model, const trace::BottomTrace& trace,
                                     const CalibrationTargets& targets);

/// Why a fit failed, a clause; empty where it did not.
std::string text_of(const math::NonlinearFit& fit);

}  // namespace launchsafe::kinds
