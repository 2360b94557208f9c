// How one scene differs from another, and what of that a record of the other one does not speak of.
#pragma once

#include "launchsafe/scene/acceptance.hpp"
#include "launchsafe/scene/scene.hpp"

#include <string>
#include <vector>

namespace launchsafe::study {

/// One input that two scenes have otherwise.
struct Difference {
  /// Under its full name: "load.peak", "material.second.yield_stress"; scene::foreign_shell for bodies at
  /// other places or of other laws, scene::foreign_interfaces for faces that hold each other otherwise,
  /// "observation_point" for these.
  scene::KeyDescription key;
  scene::Value value, recorded;
  bool of_material = false;  ///< a number of a material
};

/// Everything that a scene has otherwise than a recorded one: keys; bodies by place and law, and every number
/// of the material of each; interfaces by the bodies that they hold; observation points. Numbers are compared
/// up to the round-off of units. Names of bodies and materials are the user's and make no difference.
std::vector<Difference> differences(const scene::Scene& scene, const scene::Scene& recorded);

enum class RecordKind { calibration, firings, accuracy, model_form };

/// What a record does with a difference: nothing, as it does not matter to it or as the record judges it by
/// its own numbers; it carries its errors over; it says nothing.
enum class Effect { none, carried, foreign };
Effect effect_on(RecordKind record, const Difference& difference);

/// How far a scene lies outside of a record.
struct RecordDistance {
  /// What nothing carries the record over, each with what the scene says of it: keys of the scene, and
  /// scene::foreign_shell, foreign_material (where several numbers differ), foreign_interfaces.
  std::vector<scene::Implausible> foreign;
  /// Differences over which relative errors are carried, for people: "peak pressure".
  std::vector<std::string> carried;
  bool other_load_shape = false;  ///< among `carried`
  bool other_numerics = false;    ///< among `carried`: the constants hold the mesh error of their own grid
  bool inside() const { return foreign.empty() && carried.empty(); }
  /// The names of both, those that are foreign first.
  std::vector<std::string> names() const;
};
RecordDistance distance_to_record(RecordKind record, const scene::Scene& scene, const scene::Scene& recorded);

}  // namespace launchsafe::study
