// Values that are allowed but that no launch has: a verdict that rests on one is indeterminate, unless the
// scene says why it is meant.
#pragma once

#include "launchsafe/scene/acceptance.hpp"

namespace launchsafe::scene {

/// "gap.exchange_time = 100 s is not plausible (0.05 ms to 2 ms, because ...)".
std::string validity_warning(const Implausible& value);

/// Whether a value is what is expected of its key. NaN never is.
bool is_plausible(const KeyDescription& key, const Value& value);

/// A quantity that follows from several keys and that they may make meaningless while each of them is
/// plausible.
struct DerivedQuantity {
  KeyDescription description;
  /// SI, of a scene and of its motion as one rigid body until scene::read_time; none where a scene has no
  /// such quantity.
  std::function<std::optional<double>(const Scene& scene, const RigidMotion& launch)> value;
};
const std::vector<DerivedQuantity>& derived_quantities();

/// All values of a scene that are not plausible, accepted or not: keys in the order of their declaration,
/// bodies, then derived quantities. They depend on the scene alone, whatever file or study it came from.
std::vector<Implausible> implausible_values(const Scene& scene);
/// The same where the motion until scene::read_time is known.
std::vector<Implausible> implausible_values(const Scene& scene, const RigidMotion& launch);

/// What `accept` may name: scene keys, "body.<name>.x" and ".r", derived quantities, and what of a
/// calibration is foreign.
std::vector<KeyDescription> acceptable_keys(const Scene& scene);

}  // namespace launchsafe::scene
