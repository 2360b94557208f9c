// A small result in which every field has a value of its own, some of them not numbers.
#pragma once

#include "launchsafe/run/case_result.hpp"
#include "launchsafe/store/case_file.hpp"

#include <limits>

namespace launchsafe::testing {

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinite = std::numeric_limits<double>::infinity();

inline trace::BottomTrace sample_trace() {
  trace::BottomTrace trace;
  trace.stations = {{"G1", 0.6, 0.0, 0.0, true}, {"S1", 0.6, 0.00125, 4.9e-6, false}};
  trace.time = {0, 1e-5, 2e-5};
  trace.chamber_pressure = {101325, 2e5, 0.1};
  trace.bottom_pressure = {101325, not_a_number, -0.0};
  trace.mean_bottom_pressure = {101325, 5e-324, infinite};
  trace.friction = {0, 0, 1.1, 2.2, 3.3, 4.4};
  return trace;  // the other closure was not traced
}

inline run::Snapshot sample_snapshot(double time) {
  run::Snapshot snapshot;
  snapshot.time = time;
  snapshot.x = {0.1, 0.2, 0.3};
  snapshot.r = {0.01, 0.02, 0.03};
  snapshot.velocity_x = {1, -2, 3};
  snapshot.velocity_r = {0.5, not_a_number, -0.5};
  snapshot.density = {7830, 7830, 1717};
  snapshot.pressure = {1e8, 2e8, 3e8};
  snapshot.von_mises = {4e8, 5e8, 1e6};
  snapshot.deviator_rr = {-1e8, 1e8, 2e5};
  snapshot.deviator_xx = {2e8, -3e8, not_a_number};
  snapshot.deviator_rx = {-0.0, 2e8, 1e5};
  snapshot.temperature = {300, 301, 302};
  snapshot.state["plastic_strain"] = {0, 0.01, 0};
  snapshot.half_length_x = {0.05, 0.025, 0.125};
  snapshot.half_length_r = {0.005, 0.0025, 0.0125};
  snapshot.body = {0, 0, 1};
  return snapshot;  // no crack radius
}

/// The same while something burns.
inline run::Snapshot sample_snapshot_of_flame(double time) {
  run::Snapshot snapshot = sample_snapshot(time);
  snapshot.burnt_share = {0, 0, 0.75};
  return snapshot;
}

/// Of two events, with two stations, the skin of a gap that burns, and a face of three nodes.
inline run::Snapshot sample_snapshot_of_events(double time) {
  run::Snapshot snapshot = sample_snapshot_of_flame(time);
  snapshot.events = {scene::Event::peak_pressure, scene::Event::ignition};
  snapshot.bottom_x = {0.6, 0.61, 0.61, 0.62};
  snapshot.bottom_r = {0.02, 0.04, 0, 0.02};
  snapshot.skins = {{.gap = 0.0004, .temperature = {784, not_a_number}, .reaction_degree = {0.5, 0}}};
  snapshot.faces = {{.body = "wall",
                     .x = {0.1, 0.2, 0.3},
                     .r = {0.06, 0.06, 0.07},
                     .slip = {0, -1e-4, 2e-4},
                     .pressure = {1e8, 2e8, 0},
                     .shear = {0, -1e7, 0},
                     .opening = {0, -1e-12, 1e-6}}};
  return snapshot;
}

inline run::MechanicsResult sample_mechanics() {
  run::MechanicsResult mechanics;
  mechanics.status = run::RunStatus::energy_drift;
  mechanics.reason = "drift 0.06 at 0.017 s";
  mechanics.end_time = 0.017;
  mechanics.steps = (std::uint64_t{1} << 53) + 1;
  mechanics.particles = 9021;
  mechanics.wall_time = 61.5;
  mechanics.masses = {{"steel", 36.1}, {"charge", 7.2}};
  mechanics.trace = sample_trace();
  run::MonitorSample sample;
  sample.time = 1e-5;
  sample.time_step = 5e-7;
  sample.energy.kinetic = 1;
  sample.energy.internal = 2;
  sample.energy.external = 3;
  sample.energy.body_force = 4;
  sample.energy.damping = 5;
  sample.energy.plastic = 6;
  sample.energy.viscous = 7;
  sample.energy.crack = 8;
  sample.energy.contact = 9;
  sample.energy.charge_work = 10;
  sample.energy.charge_friction = 21;
  sample.largest_plastic_strain = 0.01;
  sample.largest_crack_radius = 3e-5;
  sample.momentum = -1e-300;
  mechanics.monitor = {run::MonitorSample{}, sample};
  mechanics.snapshots = {sample_snapshot(0.001), sample_snapshot(0.002)};
  mechanics.limiters = {11, 12, 13};
  mechanics.yielded_wall = 0.0875;
  mechanics.interfaces = {{.body = "wall", .overlap = 1e-9}};
  return mechanics;
}

inline run::GapResult sample_gap(double thickness) {
  run::GapResult gap;
  gap.gap = gap.skin.gap = thickness;
  gap.skin.time = {0, 1e-5, 2e-5};
  gap.skin.air_temperature = {300, 350, 400};
  gap.skin.temperature = {300, 300, 310, 311, 320, not_a_number};
  gap.at_points = {523.3, 0.0179, 0};
  gap.at_stations = {530.5, 0.018, 1};
  gap.air = {32700.0, 925.0};
  return gap;
}

inline run::CaseResult sample_case() {
  run::CaseResult result;
  result.mechanics = sample_mechanics();
  result.gaps = {sample_gap(0.00039), sample_gap(0.0004)};
  result.gaps[1].skin.ignition = {0.0176, 1, surface::IgnitionCause::arrhenius, 0.75};
  return result;
}

inline store::StoredCase sample_stored(run::CaseResult result = sample_case(),
                                       const std::string& input = "title = \"155 mm shell\"\n") {
  store::StoredCase stored{store::make_manifest(input), std::move(result)};
  stored.manifest.wall_time = 62.25;
  return stored;
}

}  // namespace launchsafe::testing
