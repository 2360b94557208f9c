#include "trace_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace launchsafe::run {
namespace {

/// A place between two neighbouring centres of a lattice: the lower index and the share of the upper one.
/// Beyond the first and the last centre, up to half a cell, the share lies outside of 0 to 1: values are
/// continued by the straight line through the two nearest centres, so that they are of second order
/// everywhere.
struct Bracket {
  int lower;
  double share;
};
template <class Centre>
Bracket bracket_of(double place, int count, Centre&& centre) {
  if (count < 2) return {0, 0.0};
  int lower = 0;
  while (lower + 2 < count && centre(lower + 1) <= place) ++lower;
  return {lower, (place - centre(lower)) / (centre(lower + 1) - centre(lower))};
}

bool contains(const mpm::Lattice& lattice, double x, double r) {
  return x >= lattice.x_begin() && x <= lattice.x_end() && r >= lattice.r_begin() && r <= lattice.r_end();
}

}  // namespace

TraceRecorder::TraceRecorder(const mpm::Simulation& simulation, const scene::Scene& scene)
    : floor_(scene.surface.air.initial_pressure) {
  for (const Charge& charge : simulation.bodies_of<materials::Charge>()) charges_.push_back(&charge);
  const double bottom = charges_.empty() ? 0.0 : scene::charge_extent(scene).x_end;
  for (const Charge* charge : charges_)
    if (scene.bodies[static_cast<std::size_t>(charge->kinematics.body)].x_end >= bottom)
      add_bottom_row(*charge, scene.symmetry == scene::Symmetry::axisymmetric);
  double area = 0.0;
  for (const Share& share : bottom_) area += share.weight;
  for (Share& share : bottom_) share.weight /= area;
  if (!bottom_.empty())
    for (const scene::ObservationPoint& point : scene.output.observation_points) add_observation_point(point);
  for (auto* energies : {&energy_, &heat_}) energies->fill(std::vector<double>(trace_.stations.size(), 0.0));
  bottom_pressure_ = measure_bottom_pressure(simulation);
  chamber_pressure_ = simulation.chamber_pressure();
  sample(simulation);
}

std::vector<TraceRecorder::Share> TraceRecorder::shares_at(const Charge& charge, double x, double r) {
  const mpm::Lattice& lattice = charge.kinematics.lattice;
  const Bracket along = bracket_of(x, lattice.columns(), [&](int i) { return lattice.x_of(i); });
  const Bracket across = bracket_of(r, lattice.rows(), [&](int j) { return lattice.r_of(j); });
  std::vector<Share> shares;
  for (int i = 0; i < std::min(2, lattice.columns()); ++i)
    for (int j = 0; j < std::min(2, lattice.rows()); ++j)
      shares.push_back(
          {&charge, lattice.slot(along.lower + i, across.lower + j),
           (i == 0 ? 1.0 - along.share : along.share) * (j == 0 ? 1.0 - across.share : across.share)});
  std::erase_if(shares, [](const Share& share) { return std::abs(share.weight) <= 0.0; });
  return shares;
}

void TraceRecorder::add_bottom_row(const Charge& charge, bool axisymmetric) {
  const mpm::Lattice& lattice = charge.kinematics.lattice;
  for (int j = 0; j < lattice.rows(); ++j) {
    const double r = lattice.r_of(j);
    const double area = (axisymmetric ? 2.0 * std::numbers::pi * r : 1.0) * lattice.length_r(j);
    trace_.stations.push_back(
        {"row " + std::to_string(trace_.stations.size()), lattice.x_end(), r, area, false});
    shares_.push_back(shares_at(charge, lattice.x_end(), r));
    for (Share share : shares_.back()) {
      share.weight *= area;
      bottom_.push_back(share);
    }
  }
}

void TraceRecorder::add_observation_point(const scene::ObservationPoint& point) {
  for (const Charge* charge : charges_) {
    if (!contains(charge->kinematics.lattice, point.x, point.r)) continue;
    trace_.stations.push_back({point.name, point.x, point.r, 0.0, true});
    shares_.push_back(shares_at(*charge, point.x, point.r));
    return;
  }
}

double TraceRecorder::measure_bottom_pressure(const mpm::Simulation& simulation) const {
  if (bottom_.empty()) return simulation.chamber_pressure();
  double mean = 0.0;
  for (const Share& share : bottom_)
    mean += share.weight *
            (share.charge->kinematics.pressure[share.slot] - share.charge->deviator(share.slot).xx);
  // Not std::max: a mean that is no number must stay one.
  return mean < floor_ ? floor_ : mean;
}

void TraceRecorder::accumulate(const mpm::Simulation& simulation, double dt) {
  const double bottom = measure_bottom_pressure(simulation), chamber = simulation.chamber_pressure();
  bottom_integral_ += 0.5 * dt * (bottom_pressure_ + bottom);
  chamber_integral_ += 0.5 * dt * (chamber_pressure_ + chamber);
  bottom_pressure_ = bottom;
  chamber_pressure_ = chamber;
  heat_stations();
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
      trace_.friction[closure].push_back(friction(closure, station));
  interval_begin_ = simulation.time();
  bottom_integral_ = chamber_integral_ = 0.0;
}

/// Friction only heats: where the straight line through the gains of two neighbours falls below nothing,
/// nothing is gained.
void TraceRecorder::heat_stations() {
  for (std::size_t closure = 0; closure < trace::traced_closures; ++closure)
    for (std::size_t station = 0; station < trace_.stations.size(); ++station) {
      const double now = energy_at(closure, station);
      double& before = energy_[closure][station];
      if (!(now <= before)) heat_[closure][station] += now - before;
      before = now;
    }
}

double TraceRecorder::energy_at(std::size_t closure, std::size_t station) const {
  double energy = 0.0;
  for (const Share& share : shares_[station])
    energy += share.weight * (*share.charge)[materials::Charge::friction_literal + closure][share.slot];
  return energy;
}

}  // namespace launchsafe::run
