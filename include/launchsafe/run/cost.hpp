// What a run takes, before anything is allocated.
#pragma once

#include "launchsafe/math/numbers.hpp"
#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/read_scene.hpp"

namespace launchsafe::run {

/// Particle updates per second on a core that any machine is trusted to do, a third of what a good one does.
inline constexpr double cautious_update_rate = 1e7;

/// What one mechanical run takes.
struct Cost {
  double work = 0;       ///< particle updates
  double coupled = 0;    ///< the same, at most, of the runs on through ignition of all the scene's gaps
  double particles = 0;  ///< bytes of particles and grid
  double trace = 0;      ///< bytes of the trace, with the copies that exist while it is stored
  double snapshots = 0;  ///< bytes of the snapshots, likewise
  double skins = 0;      ///< bytes of the skin temperatures of all the scene's gaps, where they are kept
  double memory() const { return particles + trace + snapshots; }  ///< bytes of the mechanics
};
Cost cost_of(const scene::Scene& scene);

/// What the snapshots of a case take in its file, before compression.
struct SnapshotSize {
  std::size_t of_launch = 0;      ///< at most: an event may never happen
  std::size_t of_combustion = 0;  ///< at most, of all gaps, should each ignite; 0 without two-way coupling
  double bytes_each = 0;  ///< but for faces that can slide and, of what burns, two more numbers a particle
  double bytes() const { return bytes_each * static_cast<double>(of_launch + of_combustion); }
};
SnapshotSize snapshot_size(const scene::Scene& scene);

}  // namespace launchsafe::run
