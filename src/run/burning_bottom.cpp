#include "burning_bottom.hpp"

#include "launchsafe/scene/read_scene.hpp"

namespace launchsafe::run {
namespace {

/// A flame passes at most this share of the skin in a step.
constexpr double skin_share_per_step = 0.05;
/// Share of a particle with which it begins to burn; less gas would be round-off of the explosive's volume.
constexpr double least_start = 1e-6;

/// A step is no shorter than one in which a flame passes this share of the thinnest cell at the bottom: a
/// thinner skin is no matter of the mechanics.
constexpr double least_cell_share = 0.05;

/// Masses, volume and energies of what burns, kg, m3 and J per radian or metre.
struct BurningTotals {
  double burnt_mass = 0;                      ///< with what burns in the next step
  double gas_mass = 0, mass_temperature = 0;  ///< of the gas that is there, and times its temperature
  double gas_volume = 0;
  double residual = 0;  ///< sum of what every particle has made or lost
};

BurningTotals totals_of(const mpm::Simulation& simulation) {
  BurningTotals totals;
  simulation.for_each_body([&](const mpm::ParticleFields& p) {
    if (!p.burning) return;
    const materials::BurningMixture& law = p.burning->law();
    for (const mpm::BurningParticle& each : p.burning->particles()) {
      const materials::BurningState& state = each.state;
      const double mass = each.rest_volume * law.solid_density();
      totals.burnt_mass += mass * std::min(1.0, state.burnt_share + each.to_burn);
      if (!(state.burnt_share > 0.0)) continue;
      const double volume = p.volume_ratio[each.slot];
      totals.gas_mass += mass * state.burnt_share;
      totals.mass_temperature += mass * state.burnt_share * state.gas_temperature;
      totals.gas_volume += each.rest_volume * (volume - (1.0 - state.burnt_share) * state.solid_volume);
      const double solid = (1.0 - state.burnt_share) * law.solid_energy(state.solid_volume);
      const double gas = law.solid_density() * state.burnt_share * law.gas_of(state).energy;
      totals.residual +=
          each.rest_volume * std::abs(solid + gas - each.start_energy - each.added + state.work);
    }
  });
  return totals;
}

/// Whether the plan follows the bulk's temperature. Snapshots follow it too, but what burns must not depend
/// on what is written.
bool heats_bulk(const scene::Scene& scene) {
  const scene::Plan plan = scene::make_plan(scene);
  return plan.conduction.in || plan.bulk_reaction.in;
}

}  // namespace

BurningBottom::BurningBottom(const mpm::Simulation& simulation, const TraceRecorder& recorder)
    : charge_(simulation.scene().charge()),
      flame_kinetics_(scene::flame_kinetics(simulation.scene())),
      release_(simulation.scene().combustion.release),
      skin_thickness_(simulation.scene().surface.skin_thickness),
      initial_temperature_(simulation.scene().initial_temperature),
      reads_bulk_(heats_bulk(simulation.scene())),
      whole_(simulation.axisymmetric() ? 2.0 * std::numbers::pi : 1.0) {
  const std::vector<trace::Station>& stations = recorder.trace().stations;
  flames_.resize(stations.size());
  for (const trace::Station& station : stations) tiles_.push_back(!station.observation);
  history_.complete_time = math::not_a_number;
  const double bottom = scene::charge_extent(simulation.scene()).x_end;
  rooms_.resize(stations.size(), 0.0);
  const auto measure = [&](double begin, double end) {
    return simulation.axisymmetric() ? 0.5 * (end * end - begin * begin) : end - begin;
  };
  for (const auto& charge : simulation.bodies_of<materials::Charge>()) {
    const mpm::ParticleFields& p = charge.get().particles;
    if (simulation.scene().bodies[static_cast<std::size_t>(p.body)].x_end < bottom) continue;
    double length = 0;
    for (int i = 0; i < p.lattice.columns(); ++i) length += p.lattice.length_x(i);
    thinnest_cell_ = std::min(thinnest_cell_, p.lattice.length_x(p.lattice.columns() - 1));
    for (int j = 0; j < p.lattice.rows(); ++j) {
      const auto row = static_cast<std::size_t>(j);
      const double low = p.lattice.r_edges[row], high = p.lattice.r_edges[row + 1];
      Column column{p.body, j, {}, std::vector<double>(static_cast<std::size_t>(p.lattice.columns()), 0.0)};
      for (const scene::StationExtent& extent : scene::stations_of(simulation.scene())) {
        const double begin = std::max(low, extent.r_begin), end = std::min(high, extent.r_end);
        const auto station = std::ranges::find_if(stations, [&](const trace::Station& each) {
          return !each.observation && each.name == extent.name;
        });
        if (!(end > begin) || station == stations.end()) continue;
        const auto index = static_cast<std::size_t>(station - stations.begin());
        column.stations.emplace_back(index, measure(begin, end) / measure(low, high));
        rooms_[index] = std::max(rooms_[index], length);
      }
      columns_.push_back(std::move(column));
    }
  }
}

void BurningBottom::ignite(const mpm::Simulation& simulation, const SteppedSkin& skin, std::size_t station) {
  double temperature = 0, share = 0;
  for (const Column& column : columns_)
    for (const auto& [index, part] : column.stations) {
      if (index != station) continue;
      const mpm::ParticleFields& p =
          mpm::particle_fields_of(simulation.bodies()[static_cast<std::size_t>(column.body)]);
      temperature += part * p.temperature[p.lattice.slot(p.lattice.columns() - 1, column.row)];
      share += part;
    }
  Flame& flame = flames_[station];
  flame.room = rooms_[station];
  // A station over no body that reaches the bottom has nothing that burns.
  flame.bulk_temperature = reads_bulk_ && share > 0.0 ? temperature / share : initial_temperature_;
  const auto speed = [&](double unburnt) {
    return materials::deflagration_speed(flame_kinetics_, charge_.conductivity, charge_.initial_density(),
                                         charge_.specific_heat, unburnt);
  };
  flame.burns = true;
  flame.skin_speed = speed(skin.unburnt_temperature(station));
  flame.bulk_speed = speed(flame.bulk_temperature);
  for (const double each : {flame.skin_speed, flame.bulk_speed})
    fastest_ = std::isfinite(each) ? std::max(fastest_, each) : math::infinity;
  if (history_.skin_flame_speed > 0.0) return;
  history_.skin_flame_speed = flame.skin_speed;
  history_.bulk_flame_speed = flame.bulk_speed;
}

BurningBottom::Burnt BurningBottom::burn(Flame& flame, double unburnt, double dt) const {
  const double burnt_temperature = charge_.kinetics.burnt_temperature;
  Burnt burnt;
  // No flame goes beyond the body that it is in.
  const auto take = [&](double length, double temperature) {
    const double before = std::min(temperature, burnt_temperature);
    const double all = charge_.kinetics.heat_of_reaction;
    const double heat = release_ == scene::HeatRelease::full
                            ? all
                            : std::min(all, charge_.specific_heat * (burnt_temperature - before));
    length = std::min(length, flame.room - flame.depth);
    flame.depth += length;
    burnt.depth += length;
    burnt.fresh += length * (charge_.specific_heat * before + heat);
    burnt.released += length * heat;
    burnt.kept_back += length * (all - heat);
    burnt.brought += length * charge_.specific_heat * (before - initial_temperature_);
  };
  double left = dt;
  if (flame.depth < skin_thickness_) {
    const double rest = skin_thickness_ - flame.depth;
    // All of it where it has reached T2 by itself.
    const bool by_itself = unburnt >= burnt_temperature;
    const double length = by_itself ? rest : std::min(rest, flame.skin_speed * dt);
    left = by_itself || !(flame.skin_speed > 0.0) ? 0.0 : dt - length / flame.skin_speed;
    take(length, unburnt);
    if (flame.depth < skin_thickness_) return burnt;
  }
  if (left > 0.0) take(flame.bulk_speed * left, flame.bulk_temperature);
  return burnt;
}

void BurningBottom::burn_column(mpm::Simulation& simulation, Column& column,
                                const std::vector<Burnt>& burnt) {
  const mpm::ParticleFields& p =
      mpm::particle_fields_of(simulation.bodies()[static_cast<std::size_t>(column.body)]);
  double depth = 0;
  Burnt sum;
  for (const auto& [station, share] : column.stations) {
    depth += share * flames_[station].depth;
    for (double Burnt::*part :
         {&Burnt::depth, &Burnt::fresh, &Burnt::released, &Burnt::kept_back, &Burnt::brought})
      sum.*part += share * burnt[station].*part;
  }
  const double length = sum.depth;
  if (!(length > 0.0)) return;
  double mass = 0;
  const int last = p.lattice.columns() - 1;
  double below = 0;
  for (int i = last; i >= 0 && below < depth; --i) {
    const double extent = p.lattice.length_x(i);
    const std::size_t slot = p.lattice.slot(i, column.row);
    double& share = column.burnt[static_cast<std::size_t>(last - i)];
    const double now = std::min(1.0, (depth - below) / extent);
    if (now > share && now >= least_start) {
      simulation.burn(column.body, slot, now - share, sum.fresh / length);
      mass += (now - share) * p.mass[slot];
      share = now;
    }
    below += extent;
  }
  released_ += whole_ * mass * sum.released / length;
  brought_ += whole_ * mass * sum.brought / length;
  kept_back_ += whole_ * mass * sum.kept_back / length;
}

void BurningBottom::advance(mpm::Simulation& simulation, const SteppedSkin& skin, double dt) {
  std::vector<Burnt> burnt(flames_.size());
  for (std::size_t s = 0; s < flames_.size(); ++s) {
    if (!tiles_[s] || !skin.ignited(s)) continue;
    if (!flames_[s].burns) ignite(simulation, skin, s);
    const bool had_skin = flames_[s].depth < skin_thickness_;
    burnt[s] = burn(flames_[s], skin.unburnt_temperature(s), dt);
    constexpr double all = 1.0 - 1e-12;  // but for round-off of many steps
    burnt_through_ = burnt_through_ || (flames_[s].room > 0.0 && flames_[s].depth >= all * flames_[s].room);
    if (had_skin && flames_[s].depth >= skin_thickness_ && std::isnan(history_.complete_time))
      history_.complete_time = simulation.time();
  }
  for (Column& column : columns_) burn_column(simulation, column, burnt);
}

double BurningBottom::longest_step() const {
  return skin_share_per_step * std::max(skin_thickness_, least_cell_share * thinnest_cell_) / fastest_;
}

double BurningBottom::reaction_degree(const SteppedSkin& skin, std::size_t station) const {
  if (!flames_[station].burns) return 0.0;
  const double burnt = std::min(1.0, flames_[station].depth / skin_thickness_);
  return burnt +
         (1.0 - burnt) * materials::reaction_degree(charge_.kinetics, skin.unburnt_temperature(station));
}

void BurningBottom::record(const mpm::Simulation& simulation, const TraceRecorder& recorder,
                           const SteppedSkin& skin) {
  const BurningTotals totals = totals_of(simulation);
  double depth = 0;
  for (std::size_t s = 0; s < flames_.size(); ++s) {
    depth = std::max(depth, flames_[s].depth);
    history_.reaction_degree.push_back(reaction_degree(skin, s));
  }
  history_.time.push_back(simulation.time());
  history_.burnt_mass.push_back(whole_ * totals.burnt_mass);
  history_.burnt_depth.push_back(depth);
  history_.gas_volume.push_back(whole_ * totals.gas_volume);
  history_.gas_temperature.push_back(totals.gas_mass > 0.0 ? totals.mass_temperature / totals.gas_mass
                                                           : charge_.kinetics.burnt_temperature);
  history_.pressure.push_back(recorder.bottom_pressure());
  history_.released.push_back(released_);
  history_.kept_back.push_back(kept_back_);
  history_.brought.push_back(brought_);
  if (!(totals.gas_mass > 0.0)) return;
  const double share = totals.residual / (charge_.kinetics.heat_of_reaction * totals.gas_mass);
  if (!(share <= history_.energy_residual)) history_.energy_residual = share;  // also one that is no number
}

}  // namespace launchsafe::run
