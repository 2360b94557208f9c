#include "trace_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace launchsafe::run {
namespace {

/// Linear interpolation between lattice centres, held constant beyond the first and the last: the lower index
/// and the share of the upper one.
struct Bracket {
  int lower;
  double share;
};
Bracket bracket_of(double place, double first, double spacing, int count) {
  const double coordinate = std::clamp((place - first) / spacing, 0.0, static_cast<double>(count - 1));
  const int lower = std::min(static_cast<int>(coordinate), std::max(count - 2, 0));
  return {lower, coordinate - lower};
}

bool contains(const mpm::Lattice& lattice, double x, double r) {
  return x >= lattice.x_begin && x <= lattice.x_begin + lattice.columns * lattice.spacing_x &&
         r >= lattice.r_begin && r <= lattice.r_begin + lattice.rows * lattice.spacing_r;
}

}  // namespace

TraceRecorder::TraceRecorder(const mpm::Simulation& simulation, const scene::Scene& scene)
    : floor_(scene.surface.air.initial_pressure) {
  const double bottom =
      simulation.charges().empty() ? 0.0 : scene::extent_of(scene, scene::BodyMaterial::charge).x_end;
  for (std::size_t c = 0; c < simulation.charges().size(); ++c) {
    const auto body = static_cast<std::size_t>(simulation.charges()[c].kinematics.body);
    if (scene.bodies[body].x_end == bottom) add_bottom_row(simulation, scene, c);
  }
  double area = 0.0;
  for (const Share& share : bottom_) area += share.weight;
  for (Share& share : bottom_) share.weight /= area;
  if (!bottom_.empty())
    for (const scene::ObservationPoint& point : scene.output.observation_points)
      add_observation_point(simulation, point);
  bottom_pressure_ = measure_bottom_pressure(simulation);
  chamber_pressure_ = simulation.chamber_pressure();
  sample(simulation);
}

void TraceRecorder::add_bottom_row(const mpm::Simulation& simulation, const scene::Scene& scene,
                                   std::size_t charge) {
  const mpm::Lattice& lattice = simulation.charges()[charge].kinematics.lattice;
  for (int j = 0; j < lattice.rows; ++j) {
    const double r = lattice.r_of(j);
    const double area = scene.symmetry == scene::Symmetry::axisymmetric
                            ? 2.0 * std::numbers::pi * r * lattice.spacing_r
                            : lattice.spacing_r;
    const std::size_t slot = lattice.slot(lattice.columns - 1, j);
    trace_.stations.push_back(
        {"row " + std::to_string(trace_.stations.size()), lattice.x_of(lattice.columns - 1), r, area, false});
    shares_.push_back({{charge, slot, 1.0}});
    bottom_.push_back({charge, slot, area});
  }
}

void TraceRecorder::add_observation_point(const mpm::Simulation& simulation,
                                          const scene::ObservationPoint& point) {
  for (std::size_t c = 0; c < simulation.charges().size(); ++c) {
    const mpm::Lattice& lattice = simulation.charges()[c].kinematics.lattice;
    if (!contains(lattice, point.x, point.r)) continue;
    const Bracket x = bracket_of(point.x, lattice.x_of(0), lattice.spacing_x, lattice.columns);
    const Bracket r = bracket_of(point.r, lattice.r_of(0), lattice.spacing_r, lattice.rows);
    std::vector<Share> shares;
    for (int i = 0; i < std::min(2, lattice.columns); ++i)
      for (int j = 0; j < std::min(2, lattice.rows); ++j) {
        const double weight = (i == 0 ? 1.0 - x.share : x.share) * (j == 0 ? 1.0 - r.share : r.share);
        if (weight > 0.0) shares.push_back({c, lattice.slot(x.lower + i, r.lower + j), weight});
      }
    trace_.stations.push_back({point.name, point.x, point.r, 0.0, true});
    shares_.push_back(std::move(shares));
    return;
  }
}

double TraceRecorder::measure_bottom_pressure(const mpm::Simulation& simulation) const {
  if (bottom_.empty()) return simulation.chamber_pressure();
  double mean = 0.0;
  for (const Share& share : bottom_) {
    const mpm::ChargeBody& charge = simulation.charges()[share.charge];
    mean += share.weight * (charge.kinematics.pressure[share.slot] - mpm::axial_deviator(charge, share.slot));
  }
  // Not std::max: a mean that is no number must stay one.
  return mean < floor_ ? floor_ : mean;
}

void TraceRecorder::accumulate(const mpm::Simulation& simulation, double dt) {
  const double bottom = measure_bottom_pressure(simulation), chamber = simulation.chamber_pressure();
  bottom_integral_ += 0.5 * dt * (bottom_pressure_ + bottom);
  chamber_integral_ += 0.5 * dt * (chamber_pressure_ + chamber);
  bottom_pressure_ = bottom;
  chamber_pressure_ = chamber;
  steps_ += 1.0;
}

void TraceRecorder::sample(const mpm::Simulation& simulation) {
  const double length = simulation.time() - interval_begin_;
  trace_.time.push_back(simulation.time());
  trace_.chamber_pressure.push_back(chamber_pressure_);
  trace_.bottom_pressure.push_back(bottom_pressure_);
  trace_.mean_chamber_pressure.push_back(length > 0.0 ? chamber_integral_ / length : chamber_pressure_);
  trace_.mean_bottom_pressure.push_back(length > 0.0 ? bottom_integral_ / length : bottom_pressure_);
  trace_.steps.push_back(steps_);
  for (std::size_t closure = 0; closure < trace::traced_closures; ++closure)
    for (std::size_t station = 0; station < trace_.stations.size(); ++station)
      trace_.friction[closure].push_back(friction(simulation, closure, station));
  interval_begin_ = simulation.time();
  bottom_integral_ = chamber_integral_ = 0.0;
}

double TraceRecorder::friction(const mpm::Simulation& simulation, std::size_t closure,
                               std::size_t station) const {
  double energy = 0.0;
  for (const Share& share : shares_[station])
    energy += share.weight * simulation.charges()[share.charge].friction[closure][share.slot];
  return energy;
}

}  // namespace launchsafe::run
