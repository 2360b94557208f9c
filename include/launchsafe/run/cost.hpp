// What is known of a run beforehand: what it takes, before anything is allocated, and whether that is within
// reach.
#pragma once

#include "launchsafe/math/numbers.hpp"
#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/read_scene.hpp"

namespace launchsafe::run {

/// Particle updates per second on a core that any machine is trusted to do, a third of what a good one does.
/// A constant: what is refused must not depend on how busy a machine is.
inline constexpr double cautious_update_rate = 1e7;

/// What one mechanical run takes.
struct Cost {
  double work = 0;        ///< particle updates
  double coupled = 0;     ///< the same, at most, of the runs on through ignition of all the scene's gaps
  double particles = 0;   ///< bytes of particles and grid
  double trace = 0;       ///< bytes of the trace, with the copies that exist while it is stored
  double kept_trace = 0;  ///< bytes of the trace alone
  double snapshots = 0;   ///< bytes of the snapshots, likewise
  double skins = 0;       ///< bytes of the skin temperatures of all the scene's gaps, where they are kept
  double memory() const { return particles + trace + snapshots; }          ///< bytes of the mechanics
  double time() const { return (work + coupled) / cautious_update_rate; }  ///< s on a core
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

/// How much a run may take.
struct Reach {
  double longest_run = 30.0 * 86400.0;  ///< s, predicted with cautious_update_rate
  double memory = math::infinity;       ///< bytes
  bool keeps_skins = false;             ///< the skin temperatures of all gaps are kept, as run_case does
};

/// Why a run must not be begun: it takes too long or too much memory. The error names the key that has most
/// to do with it, and no place.
std::optional<scene::InputError> out_of_reach(const scene::Scene& scene, const Reach& reach);
/// The same with the place where the user gave the key.
std::optional<scene::InputError> out_of_reach(const scene::SceneFile& file, const Reach& reach);

}  // namespace launchsafe::run
