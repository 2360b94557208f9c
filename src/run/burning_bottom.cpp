#include "burning_bottom.hpp"

namespace launchsafe::run {
namespace {

/// At most this share of a skin burns in a step, so that the gas presses on its neighbours little by little.
constexpr double skin_share_per_step = 0.05;
/// Share of a particle with which it begins to burn; less gas would be round-off of the explosive's volume.
constexpr double least_start = 1e-6;

constexpr double whole_circle = 2.0 * std::numbers::pi;

/// Masses, volume and energies of what burns, kg, m3 and J per radian.
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

}  // namespace

BurningBottom::BurningBottom(const mpm::Simulation& simulation, const TraceRecorder& recorder)
    : charge_(simulation.scene().charge()), skin_thickness_(simulation.scene().surface.skin_thickness) {
  const double burnt = charge_.kinetics.burnt_temperature;
  const double before = std::min(charge_.kinetics.ignition_temperature, burnt);
  brought_heat_ = charge_.specific_heat * (before - simulation.scene().initial_temperature);
  released_heat_ = std::min(charge_.kinetics.heat_of_reaction, charge_.specific_heat * (burnt - before));
  fresh_energy_ = charge_.specific_heat * before + released_heat_;
  const std::vector<trace::Station>& stations = recorder.trace().stations;
  burnt_.resize(stations.size(), 0.0);
  for (const trace::Station& station : stations) tiles_.push_back(!station.observation);
  const double bottom = scene::charge_extent(simulation.scene()).x_end;
  const auto measure = [](double begin, double end) { return 0.5 * (end * end - begin * begin); };
  for (const auto& charge : simulation.bodies_of<materials::Charge>()) {
    const mpm::ParticleFields& p = charge.get().particles;
    if (simulation.scene().bodies[static_cast<std::size_t>(p.body)].x_end < bottom) continue;
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
        column.stations.emplace_back(static_cast<std::size_t>(station - stations.begin()),
                                     measure(begin, end) / measure(low, high));
      }
      columns_.push_back(std::move(column));
    }
  }
}

void BurningBottom::burn_column(mpm::Simulation& simulation, Column& column) {
  const mpm::ParticleFields& p =
      mpm::particle_fields_of(simulation.bodies()[static_cast<std::size_t>(column.body)]);
  double depth = 0;
  for (const auto& [station, share] : column.stations) depth += share * burnt_[station] * skin_thickness_;
  const int last = p.lattice.columns() - 1;
  double below = 0;
  for (int i = last; i >= 0 && below < depth; --i) {
    const double extent = p.lattice.length_x(i);
    const std::size_t slot = p.lattice.slot(i, column.row);
    double& share = column.burnt[static_cast<std::size_t>(last - i)];
    const double now = std::min(1.0, (depth - below) / extent);
    if (now > share && now >= least_start) {
      simulation.burn(column.body, slot, now - share, fresh_energy_);
      burnt_mass_ += (now - share) * p.mass[slot];
      share = now;
    }
    below += extent;
  }
}

void BurningBottom::advance(mpm::Simulation& simulation, const SteppedSkin& skin) {
  for (std::size_t s = 0; s < burnt_.size(); ++s)
    if (tiles_[s] && skin.ignited(s)) burnt_[s] = std::min(1.0, burnt_[s] + skin_share_per_step);
  for (Column& column : columns_) burn_column(simulation, column);
}

void BurningBottom::record(const mpm::Simulation& simulation, const TraceRecorder& recorder) {
  const BurningTotals totals = totals_of(simulation);
  history_.reaction_degree.insert(history_.reaction_degree.end(), burnt_.begin(), burnt_.end());
  history_.time.push_back(simulation.time());
  history_.burnt_mass.push_back(whole_circle * totals.burnt_mass);
  history_.gas_volume.push_back(whole_circle * totals.gas_volume);
  history_.gas_temperature.push_back(totals.gas_mass > 0.0 ? totals.mass_temperature / totals.gas_mass
                                                           : charge_.kinetics.burnt_temperature);
  history_.pressure.push_back(recorder.bottom_pressure());
  history_.released.push_back(whole_circle * burnt_mass_ * released_heat_);
  history_.brought.push_back(whole_circle * burnt_mass_ * brought_heat_);
  if (!(totals.gas_mass > 0.0)) return;
  const double share = totals.residual / (charge_.kinetics.heat_of_reaction * totals.gas_mass);
  if (!(share <= history_.energy_residual)) history_.energy_residual = share;  // also one that is no number
}

}  // namespace launchsafe::run
