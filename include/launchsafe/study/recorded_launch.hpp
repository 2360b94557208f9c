// The launch that an accuracy study computed, and whether it says something of another one.
#pragma once

#include "launchsafe/scene/scene.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace launchsafe::study {

/// What numerical errors depend on besides shell and setting. Every run of an accuracy study that its record
/// keeps has the same launch, so these are values and no ranges.
struct RecordedLaunch {
  double peak_pressure = 0;   ///< Pa, largest over the duration
  double duration = 0;        ///< s
  std::vector<double> shape;  ///< pressure over its peak at `shape_instants` even instants of the duration
  double rise_time = 0;       ///< s, > 0: the peak over the largest rate of rise, at most the duration
  double roughness = 0;       ///< of the load, dimensionless, >= 0: see `scene::load_roughness`
  double crack_radius = 0;    ///< m, c(0)
  double flaw_size = 0;       ///< m, a
  std::vector<double> gaps;   ///< m, at which T max was compared
  double localisation = 0;    ///< factor on the friction heat
  /// K/(s m), per metre of gap: the rate at which air compressed by the peak pressure heats the cold skin.
  double air_heating = 0;
};

/// Instants at which the shape of a load is recorded, the first at 0, the last at the end.
inline constexpr std::size_t shape_instants = 65;

/// The launch of a scene, compared at gaps (m).
RecordedLaunch launch_of(const scene::Scene& scene, std::vector<double> gaps);

/// What a record of one launch says of another.
struct Coverage {
  std::string reason;  ///< why it says nothing, a clause; empty where it holds
  /// >= 1, by which the errors of the record grow. An extrapolation never makes them smaller.
  double growth = 1.0;
  /// m, up to which it holds: the air of no wider gap heats the skin three times as fast as that of the
  /// widest recorded one. Judged gap by gap, so that a verdict does not depend on what else a study lists.
  double largest_gap = 0;
};

/// How far a record is carried. Errors are those of the friction heat, which goes with p^2 and with the
/// localisation, and of the pressure that heats the air. Below the recorded launch they keep their size, in
/// kelvin. Above it they grow with p^2, with the root of the crack radius (as does the stress intensity that
/// drives crack growth) and with the localisation; what a wider gap adds is left to the rise of T max (see
/// StudyCase::rise_of_uncertainty). A record says nothing
/// - beyond 1.25 times the peak pressure: the recorded wall may just not have yielded;
/// - beyond three times the crack radius, in metres or in flaw sizes, the localisation, or the rate at which
///   the air of the widest gap heats the skin, or where it has no cracks or no gap and the launch has;
/// - of a load that lasts more than 1.1 times as long, rises in less than 1/1.25 of the time, differs in
///   shape by more than a tenth of the peak, or is rougher by more than 0.01 (a hundredth of the friction
///   heat).
Coverage coverage_of(const RecordedLaunch& recorded, const RecordedLaunch& launch);

}  // namespace launchsafe::study
