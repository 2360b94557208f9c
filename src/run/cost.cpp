#include "launchsafe/run/cost.hpp"

#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/plan.hpp"

namespace launchsafe::run {
namespace {

constexpr double bytes_per_number = 8.0;
/// While it is stored, a result exists a few times: as it is, as the image of its file, and being written.
constexpr double copies = 4.0;

std::string duration_text(double seconds) {
  constexpr double hour = 3600.0, day = 24.0 * hour;
  if (seconds < hour) return fmt::format("{:.3g} s", seconds);
  return seconds < day ? fmt::format("{:.3g} h", seconds / hour) : fmt::format("{:.3g} days", seconds / day);
}
std::string gigabytes(double bytes) { return fmt::format("{:.3g} GB", 1e-9 * bytes); }

/// What follows ignition is the reason where the launch alone would do, a short step where steps as long as
/// usual would do.
const char* key_of_time(const scene::Scene& scene, const Cost& cost, double longest) {
  const double time = cost.time();
  if (time - cost.coupled / cautious_update_rate <= longest) return "combustion.duration";
  const double usual = scene::Numerics{}.time_step_factor, given = scene.numerics.time_step_factor;
  return given < usual && time * given / usual <= longest ? "numerics.time_step_factor"
                                                          : "numerics.cell_size";
}

const char* key_of_memory(const Cost& cost, double skins) {
  const double largest = std::max({cost.particles, cost.trace, cost.snapshots, skins});
  if (largest == skins) return "gap.thickness";
  if (largest == cost.trace) return "output.trace_interval";
  return largest == cost.snapshots ? "output.snapshots" : "numerics.cell_size";
}

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
  const double trace = bytes_per_number * samples * (6.0 + stations * trace::traced_closures);
  // Of every gap time, air and skins.
  const double skins = bytes_per_number * gaps * samples * (2.0 + stations);
  return {.work = plan.work,
          .coupled = plan.coupled_work * gaps,
          .particles = plan.memory,
          .trace = copies * trace,
          .kept_trace = trace,
          .snapshots = scene.output.asks_for_snapshots() ? copies * snapshot_size(scene).bytes() : 0.0,
          .skins = copies * skins};
}

SnapshotSize snapshot_size(const scene::Scene& scene) {
  // Of a particle, besides its fields: its body, place and velocity as rows of three, stress tensor, and its
  // cell with four corners.
  constexpr double of_particle = 1 + 3 + 3 + 6 + 4 + 8;
  // Of a station: its radius, two ends as rows of three, their numbers.
  constexpr double of_station = 1 + 6 + 2;
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
    for (const scene::Event event : {scene::Event::ignition, scene::Event::burnt})
      size.of_launch -= output.asks_for(event) ? 1 : 0;
  }
  size.bytes_each =
      bytes_per_number * (numbers * static_cast<double>(scene::particle_count(scene)) +
                          (of_station + gaps) * static_cast<double>(scene::stations_of(scene).size()));
  return size;
}

std::optional<scene::InputError> out_of_reach(const scene::Scene& scene, const Reach& reach) {
  const Cost cost = cost_of(scene);
  // Written so that what is no number is out of reach.
  if (!(cost.time() <= reach.longest_run) || std::isinf(cost.time())) {
    const scene::Plan plan = scene::make_plan(scene);
    std::string found = fmt::format(
        "{:.3g} particles and {} steps of {:.3g} s (sound at {:.3g} m/s), which take {} at {:.3g} million "
        "particle updates per second",
        static_cast<double>(plan.particles()),
        plan.steps < scene::most_counted ? fmt::format("{}", plan.steps) : "countless", plan.time_step,
        scene::longitudinal_speed(scene), duration_text(cost.time()), 1e-6 * cautious_update_rate);
    if (cost.coupled > 0.0)
      found += fmt::format(", {} of it where every gap ignites and goes on through {:.3g} s of combustion",
                           duration_text(cost.coupled / cautious_update_rate), scene.combustion.duration);
    return scene::error_at(
        {}, key_of_time(scene, cost, reach.longest_run), found,
        fmt::format(
            "a run of at most {}; larger cells or longer steps take less, and --longest-run allows more",
            duration_text(reach.longest_run)));
  }
  const double skins = reach.keeps_skins ? cost.skins : 0.0;
  if (cost.memory() + skins <= reach.memory) return std::nullopt;
  return scene::error_at(
      {}, key_of_memory(cost, skins),
      fmt::format("a run that needs {} of memory: {} for particles and grid, {} for the trace, {} "
                  "for snapshots, {} for skin temperatures",
                  gigabytes(cost.memory() + skins), gigabytes(cost.particles), gigabytes(cost.trace),
                  gigabytes(cost.snapshots), gigabytes(skins)),
      fmt::format("at most {}, what this machine has left", gigabytes(reach.memory)));
}

std::optional<scene::InputError> out_of_reach(const scene::SceneFile& file, const Reach& reach) {
  auto error = out_of_reach(file.scene, reach);
  if (!error) return error;
  return scene::error_at(scene::place_of_key(file, error->key), error->key, error->found, error->allowed);
}

}  // namespace launchsafe::run
