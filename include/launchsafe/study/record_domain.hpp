// How one scene differs from another, and what of that a record of the other one does not speak of; and where
// the constants that scenes start from were calibrated.
#pragma once

#include "launchsafe/scene/read_scene.hpp"
#include "launchsafe/study/bracket.hpp"

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

enum class RecordKind { calibration, accuracy };

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

/// The published rows that localisation and exchange time were fitted to, and how well the launch with these
/// constants meets what nothing was fitted to. As of reports/calibrate_table8.
struct CalibrationEvidence {
  double friction_rise = 116.1;  ///< K, of T max without a gap above the initial temperature: localisation
  double air_rise = 51.6;        ///< K, that 0.02 cm of air add: exchange time
  double largest_gap = 4e-4;     ///< m, of the rows
  /// K, of T max by the constants on this launch; taken where no fit uncertainty is stated. Half the distance
  /// between the temperatures that T1 separates, or the bound of the misfits of what nothing was fitted to,
  /// whichever is larger.
  double fit_uncertainty = 2.86;
};

/// A launch with its calibrated constants: they hold where they were found.
struct Calibration {
  scene::Scene scene;
  CalibrationEvidence evidence;
};

/// The launch of the constants that ship as the default: the 155 mm shell of the paper.
Calibration shipped_calibration();

}  // namespace launchsafe::study
