#include "charge_heat.hpp"

namespace launchsafe::run {
namespace {

/// Where the part of a lattice's interval `index` between two places begins and ends.
std::pair<double, double> overlap(const std::vector<double>& edges, int index, double begin, double end) {
  const auto i = static_cast<std::size_t>(index);
  return {std::max(edges[i], begin), std::min(edges[i + 1], end)};
}

/// Makes the weights of some sum to 1.
template <class Shares>
void normalise(Shares& shares) {
  double sum = 0.0;
  for (const auto& share : shares) sum += share.weight;
  for (auto& share : shares) share.weight /= sum;
}

}  // namespace

TraceRecorder::TraceRecorder(mpm::Simulation& simulation, const scene::Scene& scene)
    : floor_(scene.surface.air.initial_pressure) {
  for (const Charge& charge : simulation.bodies_of<materials::Charge>()) charges_.push_back(&charge);
  const double bottom = charges_.empty() ? 0.0 : scene::charge_extent(scene).x_end;
  for (const Charge* charge : charges_)
    if (scene.bodies[static_cast<std::size_t>(charge->particles.body)].x_end >= bottom)
      add_bottom_row(*charge);
  normalise(bottom_);
  if (!bottom_.empty()) {
    add_stations(scene);
    for (const scene::ObservationPoint& point : scene.output.observation_points) add_observation_point(point);
  }
  for (Charge& charge : simulation.bodies_of<materials::Charge>())
    for (const std::vector<Share>& shares : shares_)
      for (const Share& share : shares)
        if (share.charge == &charge) mpm::record(charge.particles, share.slot);
  heat_.assign(trace_.stations.size(), 0.0);
  bottom_pressure_ = measure_bottom_pressure(simulation);
  chamber_pressure_ = simulation.chamber_pressure();
  sample(simulation);
}

std::vector<TraceRecorder::Share> TraceRecorder::shares_at(const Charge& charge, double x, double r) {
  const mpm::Lattice& lattice = charge.particles.lattice;
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

void TraceRecorder::add_bottom_row(const Charge& charge) {
  const mpm::Lattice& lattice = charge.particles.lattice;
  for (int j = 0; j < lattice.rows(); ++j) {
    const double r = lattice.r_of(j);
    const double area = 2.0 * std::numbers::pi * r * lattice.length_r(j);
    for (Share share : shares_at(charge, lattice.x_end(), r)) {
      share.weight *= area;
      bottom_.push_back(share);
    }
  }
}

/// Particles by the volume of their rectangles at rest that lies in the station.
void TraceRecorder::add_stations(const scene::Scene& scene) {
  for (const scene::StationExtent& extent : scene::stations_of(scene)) {
    std::vector<Share> shares;
    for (const Charge* charge : charges_) {
      const mpm::Lattice& lattice = charge->particles.lattice;
      for (int i = 0; i < lattice.columns(); ++i) {
        const auto [x_begin, x_end] = overlap(lattice.x_edges, i, extent.x_begin, extent.x_end);
        for (int j = 0; j < lattice.rows(); ++j) {
          const auto [r_begin, r_end] = overlap(lattice.r_edges, j, extent.r_begin, extent.r_end);
          if (!(x_end > x_begin) || !(r_end > r_begin)) continue;
          const double radius = 0.5 * (r_begin + r_end);
          shares.push_back({charge, lattice.slot(i, j), (x_end - x_begin) * (r_end - r_begin) * radius});
        }
      }
    }
    if (shares.empty()) continue;
    normalise(shares);
    const double width = extent.r_end - extent.r_begin, middle = 0.5 * (extent.r_begin + extent.r_end);
    trace_.stations.push_back(
        {extent.name, extent.x_end, middle, width * (2.0 * std::numbers::pi * middle), false});
    shares_.push_back(std::move(shares));
  }
}

void TraceRecorder::add_observation_point(const scene::ObservationPoint& point) {
  for (const Charge* charge : charges_) {
    const mpm::Lattice& lattice = charge->particles.lattice;
    if (point.x < lattice.x_begin() || point.x > lattice.x_end()) continue;
    if (point.r < lattice.r_begin() || point.r > lattice.r_end()) continue;
    trace_.stations.push_back({point.name, point.x, point.r, 0.0, true});
    shares_.push_back(shares_at(*charge, point.x, point.r));
    return;
  }
}

double TraceRecorder::measure_bottom_pressure(const mpm::Simulation& simulation) const {
  if (bottom_.empty()) return simulation.chamber_pressure();
  double mean = 0.0;
  for (const Share& share : bottom_)
    mean +=
        share.weight * (share.charge->particles.pressure[share.slot] - share.charge->deviator(share.slot).xx);
  // Not std::max: a mean that is no number must stay one.
  return mean < floor_ ? floor_ : mean;
}

void TraceRecorder::accumulate(const mpm::Simulation& simulation, double dt) {
  const double bottom = measure_bottom_pressure(simulation);
  bottom_integral_ += 0.5 * dt * (bottom_pressure_ + bottom);
  bottom_pressure_ = bottom;
  chamber_pressure_ = simulation.chamber_pressure();
  heat_stations();
}

void TraceRecorder::sample(const mpm::Simulation& simulation) {
  const double length = simulation.time() - interval_begin_;
  trace_.time.push_back(simulation.time());
  trace_.chamber_pressure.push_back(chamber_pressure_);
  trace_.bottom_pressure.push_back(bottom_pressure_);
  trace_.mean_bottom_pressure.push_back(length > 0.0 ? bottom_integral_ / length : bottom_pressure_);
  trace_.friction.insert(trace_.friction.end(), heat_.begin(), heat_.end());
  interval_begin_ = simulation.time();
  bottom_integral_ = 0.0;
}

/// Strain is averaged as a tensor before its norm is taken: that of one particle beside a corner never
/// settles as the mesh is refined.
void TraceRecorder::heat_stations() {
  for (std::size_t station = 0; station < trace_.stations.size(); ++station) {
    materials::SlidingStep step;
    for (const Share& share : shares_[station]) add(step, *share.charge, share.slot, share.weight);
    heat_[station] += materials::sliding_heat(shares_[station].front().charge->law.sliding_friction, step);
  }
}

SteppedSkin::SteppedSkin(const scene::Scene& scene, double gap, const TraceRecorder& recorder)
    : model_(surface::skin_model(scene)) {
  history_.gap = gap;
  const std::size_t stations = recorder.trace().stations.size();
  points_.assign(stations, surface::SkinPoint{model_.initial_temperature});
  friction_.assign(stations, 0.0);
  air_pressure_ = recorder.bottom_pressure();
  record(recorder);
}

void SteppedSkin::advance(const mpm::Simulation& simulation, const TraceRecorder& recorder, double dt) {
  const double begin = materials::adiabatic_temperature(model_.surface.air, air_pressure_);
  air_pressure_ = recorder.bottom_pressure();
  const double end = materials::adiabatic_temperature(model_.surface.air, air_pressure_);
  for (std::size_t s = 0; s < points_.size(); ++s) {
    surface::SkinPoint& point = points_[s];
    const bool had_ignited = point.ignited;
    point = surface::advance_skin(model_, history_.gap, point, dt, begin, end, heating(recorder, s, dt));
    if (had_ignited || !point.ignited) continue;
    if (!history_.ignition && !recorder.trace().stations[s].observation)
      history_.note_ignition(s, simulation.time() - dt + point.ignition_time, point.chemical_share);
  }
}

void SteppedSkin::record(const TraceRecorder& recorder) {
  history_.time.push_back(recorder.trace().time.back());
  history_.air_temperature.push_back(materials::adiabatic_temperature(model_.surface.air, air_pressure_));
  for (const surface::SkinPoint& point : points_) history_.temperature.push_back(point.temperature);
}

double SteppedSkin::heating(const TraceRecorder& recorder, std::size_t station, double dt) {
  if (model_.surface.friction == scene::FrictionClosure::none) return 0.0;
  const double before = friction_[station];
  friction_[station] = recorder.friction(station);
  return (friction_[station] - before) * model_.surface.localisation /
         (model_.charge_density * model_.specific_heat * dt);
}

BulkHeat::BulkHeat(mpm::Simulation& simulation) : charge_(simulation.scene().charge()) {
  const scene::Plan plan = scene::make_plan(simulation.scene());
  reaction_ = plan.reacts;
  if (plan.conducts) conduction_.emplace(simulation);
  const bool is_read = reaction_ || conduction_ || simulation.scene().output.asks_for_snapshots();
  if (!is_read || simulation.scene().surface.friction == scene::FrictionClosure::none) return;
  for (Charge& body : simulation.bodies_of<materials::Charge>()) {
    for (std::size_t slot = 0; slot < body.particles.mass.size(); slot += math::pack_width)
      mpm::record(body.particles, slot);
    friction_.emplace_back(body.particles.mass.size(), 0.0);
  }
}

void BulkHeat::accumulate(const mpm::Simulation& simulation) {
  auto energy = friction_.begin();
  if (energy == friction_.end()) return;
  for (const Charge& charge : simulation.bodies_of<materials::Charge>()) {
    for (std::size_t slot = 0; slot < energy->size(); ++slot) {
      materials::SlidingStep step;
      add(step, charge, slot, 1.0);
      (*energy)[slot] += materials::sliding_heat(charge.law.sliding_friction, step);
    }
    ++energy;
  }
}

void BulkHeat::advance_to(mpm::Simulation& simulation, double time) {
  const double dt = time - time_;
  time_ = time;
  if (!(dt > 0.0)) return;
  auto energy = friction_.begin();
  for (Charge& charge : simulation.bodies_of<materials::Charge>()) {
    if (energy != friction_.end()) {
      for (std::size_t i = 0; i < energy->size(); ++i)
        charge.particles.temperature[i] += (*energy)[i] / (charge_.density * charge_.specific_heat);
      std::ranges::fill(*energy++, 0.0);
    }
    if (reaction_) react(charge, dt);
  }
  if (conduction_) conduction_->advance(simulation, dt);
}

void BulkHeat::react(Charge& charge, double dt) const {
  // The skin equation without air is the bulk's: a gap of nothing exchanges nothing.
  surface::SkinModel model;
  model.kinetics = charge_.kinetics;
  model.charge_density = charge_.density;
  model.specific_heat = charge_.specific_heat;
  for (double& temperature : charge.particles.temperature)
    temperature =
        surface::advance_skin(model, 0.0, surface::SkinPoint{temperature}, dt, temperature, temperature, 0.0)
            .temperature;
}

}  // namespace launchsafe::run
