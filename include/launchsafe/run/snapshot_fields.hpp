// What snapshots hold of every particle besides its body, place and velocity.
#pragma once

#include "launchsafe/materials/law.hpp"
#include "launchsafe/run/case_result.hpp"

#include <string_view>
#include <vector>

namespace launchsafe::run {

/// A quantity of the particles, described once: case files, XDMF, pictures and tables go through the list.
struct SnapshotField : materials::StateField {
  std::vector<double> Snapshot::*values = nullptr;  ///< where it is; null for a law's, in Snapshot::state
  bool always = false;                ///< whether files have it always, or where it was recorded
  std::string_view title = {};        ///< of pictures; the meaning where there is none
  std::string_view description = {};  ///< in files, likewise
};

/// All of them, in the order in which files list them and pictures are drawn.
const std::vector<SnapshotField>& snapshot_fields();

/// Its values in a snapshot, in SI, as many as particles; empty where the snapshot has not got it.
const std::vector<double>& values_of(const Snapshot& snapshot, const SnapshotField& field);
/// Likewise, to be filled.
std::vector<double>& values_of(Snapshot& snapshot, const SnapshotField& field);

/// Whether particles of a body have it.
bool has_field(const scene::Scene& scene, const scene::Body& body, const SnapshotField& field);

}  // namespace launchsafe::run
