#include "launchsafe/run/cost.hpp"

#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/plan.hpp"

namespace launchsafe::run {
namespace {

constexpr double bytes_per_number = 8.0;
/// While it is stored, a result exists a few times: as it is, as the image of its file, and being written.
constexpr double copies = 4.0;

}  // namespace

Cost cost_of(const scene::Scene& scene) {
  const scene::Plan plan = scene::make_plan(scene);
  const auto gaps = static_cast<double>(scene.surface.gaps.size());
  // The trace has six histories of the bottom, and those of friction at every station: the observation
  // points, and as many others as particles in the bottom row at most. A step is sampled once at most.
  const double samples = 2.0 + std::min(scene::end_time(scene.load) / scene.output.trace_interval,
                                        static_cast<double>(plan.steps));
  const double stations =
      static_cast<double>(scene.output.observation_points.size()) +
      charge_extent(scene).r_end / scene.numerics.cell_size * scene.numerics.particles_per_cell;
  const double trace = bytes_per_number * samples * (6.0 + stations);
  // Of every gap time, air and skins.
  const double skins = bytes_per_number * gaps * samples * (2.0 + stations);
  return {.work = plan.work,
          .coupled = plan.coupled_work * gaps,
          .particles = plan.memory,
          .trace = copies * trace,
          .snapshots = scene.output.asks_for_snapshots() ? copies * snapshot_size(scene).bytes() : 0.0,
          .skins = copies * skins};
}

SnapshotSize snapshot_size(const scene::Scene& scene) {
  // Of a particle, besides its fields: place and velocity, its cell with four corners, and as half numbers
  // its body and the corners of its cell.
  constexpr double of_particle = 2 + 2 + 8 + 0.5 * (1 + 4);
  constexpr double of_station = 4;  // x and r of its ends
  const auto& output = scene.output;
  const auto gaps = static_cast<double>(scene.surface.gaps.size());
  const bool burns = scene.coupling == scene::Coupling::two_way;
  double numbers = of_particle;
  for (const SnapshotField& field : snapshot_fields()) {
    if (field.values == &Snapshot::burnt_share && !burns) continue;
    const bool recorded = std::ranges::any_of(
        scene.bodies, [&](const scene::Body& body) { return has_field(scene, body, field); });
    if (recorded) numbers += 1.0;
  }
  SnapshotSize size;
  size.of_launch = output.snapshot_times.size() + output.snapshot_events.size();
  if (burns) {
    size.of_combustion = scene.surface.gaps.size() * size.of_launch;
    size.of_launch -= output.asks_for(scene::Event::ignition) ? 1 : 0;
  }
  size.bytes_each =
      bytes_per_number * (numbers * static_cast<double>(scene::particle_count(scene)) +
                          (of_station + gaps) * static_cast<double>(scene::stations_of(scene).size()));
  return size;
}

}  // namespace launchsafe::run
