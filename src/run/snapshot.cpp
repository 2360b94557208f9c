#include "charge_heat.hpp"
#include "monitor.hpp"

namespace launchsafe::run {
namespace {

using scene::Event;

/// m, of the cell of the particle at place `i` on a line of `count` particles: half its length at rest, times
/// present over initial distance between its neighbours, at an end between the particle and its one
/// neighbour; 1 for a particle without any. `now` and `at_rest` give places.
template <class Now, class AtRest>
double half_length(double at_rest_length, int i, int count, Now now, AtRest at_rest) {
  const int before = std::max(i - 1, 0), behind = std::min(i + 1, count - 1);
  const double stretch =
      before == behind ? 1.0 : (now(behind) - now(before)) / (at_rest(behind) - at_rest(before));
  return 0.5 * at_rest_length * stretch;
}

/// Of the particle in column i and row j.
double half_length_x(const mpm::ParticleFields& p, int i, int j) {
  const mpm::Lattice& l = p.lattice;
  return half_length(
      l.length_x(i), i, l.columns(), [&](int k) { return p.x[l.slot(k, j)]; },
      [&](int k) { return l.x_of(k); });
}
double half_length_r(const mpm::ParticleFields& p, int i, int j) {
  const mpm::Lattice& l = p.lattice;
  return half_length(
      l.length_r(j), j, l.rows(), [&](int k) { return p.r[l.slot(i, k)]; }, [&](int k) { return l.r_of(k); });
}

/// What `value` gives of a body and the slot of a particle, for all particles in the order of a snapshot: 0
/// where it gives nothing, and none where it gives nothing of any.
template <class Value>
std::vector<double> values_where_known(const mpm::Simulation& simulation, Value value) {
  std::vector<double> values;
  bool known = false;
  for (const mpm::AnyBody& body : simulation.bodies()) {
    const mpm::Lattice& lattice = mpm::particle_fields_of(body).lattice;
    for (int j = 0; j < lattice.rows(); ++j)
      for (int i = 0; i < lattice.columns(); ++i) {
        const std::optional<double> each = value(body, lattice.slot(i, j));
        known = known || each.has_value();
        values.push_back(each.value_or(0.0));
      }
  }
  return known ? values : std::vector<double>{};
}

std::vector<double> burnt_shares(const mpm::Simulation& simulation) {
  return values_where_known(simulation, [](const mpm::AnyBody& body, std::size_t slot) {
    const auto& burning = mpm::particle_fields_of(body).burning;
    const mpm::BurningParticle* particle = burning ? burning->find(slot) : nullptr;
    return particle != nullptr ? std::optional(particle->state.burnt_share) : std::nullopt;
  });
}

/// A state field, which not all laws have.
std::vector<double> state_of(const mpm::Simulation& simulation, std::string_view name) {
  return values_where_known(simulation, [name](const mpm::AnyBody& body, std::size_t slot) {
    const math::AlignedArray* field = field_of(body, name);
    return field != nullptr ? std::optional((*field)[slot]) : std::nullopt;
  });
}

void add_body(const mpm::AnyBody& any, Snapshot& shot) {
  const mpm::ParticleFields& p = mpm::particle_fields_of(any);
  const double density = std::visit([](const auto& body) { return body.law.initial_density(); }, any);
  for (int j = 0; j < p.lattice.rows(); ++j)
    for (int i = 0; i < p.lattice.columns(); ++i) {
      const std::size_t slot = p.lattice.slot(i, j);
      shot.x.push_back(p.x[slot]);
      shot.r.push_back(p.r[slot]);
      shot.velocity_x.push_back(p.velocity_x[slot]);
      shot.velocity_r.push_back(p.velocity_r[slot]);
      shot.density.push_back(density / p.volume_ratio[slot]);
      shot.pressure.push_back(p.pressure[slot]);
      shot.temperature.push_back(p.temperature[slot]);
      const auto deviator = std::visit([&](const auto& body) { return body.deviator(slot); }, any);
      shot.von_mises.push_back(math::von_mises(deviator));
      shot.deviator_rr.push_back(deviator.rr);
      shot.deviator_xx.push_back(deviator.xx);
      shot.deviator_rx.push_back(deviator.rx);
      shot.half_length_x.push_back(half_length_x(p, i, j));
      shot.half_length_r.push_back(half_length_r(p, i, j));
      shot.body.push_back(p.body);
    }
}

/// The charge that reaches the bottom over a radius (m); null where none does.
const mpm::ParticleFields* charge_at_bottom(const mpm::Simulation& simulation, double bottom, double r) {
  for (const auto& charge : simulation.bodies_of<materials::Charge>()) {
    const mpm::ParticleFields& p = charge.get().particles;
    if (p.lattice.x_end() >= bottom && p.lattice.r_begin() <= r && r <= p.lattice.r_end()) return &p;
  }
  return nullptr;
}

/// Where the bottom of the charge is now that was at radius r (m) at rest.
void add_place_of_bottom(const mpm::ParticleFields& p, double r, Snapshot& shot) {
  const mpm::Lattice& lattice = p.lattice;
  const int last = lattice.columns() - 1;
  const Bracket between = bracket_of(r, lattice.rows(), [&](int j) { return lattice.r_of(j); });
  const int upper = std::min(between.lower + 1, lattice.rows() - 1);
  const auto value = [&](auto at) {
    return (1.0 - between.share) * at(between.lower) + between.share * at(upper);
  };
  shot.bottom_x.push_back(
      value([&](int j) { return p.x[lattice.slot(last, j)] + half_length_x(p, last, j); }));
  shot.bottom_r.push_back(r + value([&](int j) { return p.r[lattice.slot(last, j)] - lattice.r_of(j); }));
}

void add_bottom(const mpm::Simulation& simulation, const std::vector<trace::Station>& stations,
                Snapshot& shot) {
  for (const scene::StationExtent& extent : scene::stations_of(simulation.scene())) {
    const bool recorded = std::ranges::any_of(stations, [&](const trace::Station& station) {
      return !station.observation && station.name == extent.name;
    });
    if (!recorded) continue;
    const mpm::ParticleFields* charge =
        charge_at_bottom(simulation, extent.x_end, 0.5 * (extent.r_begin + extent.r_end));
    for (const double r : {extent.r_begin, extent.r_end}) {
      if (charge != nullptr) {
        add_place_of_bottom(*charge, r, shot);
      } else {
        shot.bottom_x.push_back(extent.x_end);
        shot.bottom_r.push_back(r);
      }
    }
  }
}

FaceSnapshot face_snapshot(const mpm::Simulation& simulation, const mpm::TotalLagrangian& form,
                           std::size_t index) {
  FaceSnapshot face;
  face.body = simulation.scene().interfaces[form.contact().interface_of(index)].body;
  for (const mpm::FaceState& state : form.contact().state_of(index, form.nodes())) {
    face.x.push_back(state.x);
    face.r.push_back(state.r);
    face.slip.push_back(state.slip);
    face.pressure.push_back(state.pressure);
    face.shear.push_back(state.shear);
    face.opening.push_back(state.gap);
  }
  return face;
}

}  // namespace

Snapshot take_snapshot(const mpm::Simulation& simulation, const std::vector<trace::Station>& stations) {
  Snapshot shot;
  shot.time = simulation.time();
  for (const mpm::AnyBody& any : simulation.bodies()) add_body(any, shot);
  for (const SnapshotField& field : snapshot_fields()) {
    if (field.values != nullptr) continue;
    if (std::vector<double> values = state_of(simulation, field.name); !values.empty())
      shot.state.emplace(field.name, std::move(values));
  }
  shot.burnt_share = burnt_shares(simulation);
  add_bottom(simulation, stations, shot);
  if (const mpm::TotalLagrangian* form = simulation.total_lagrangian())
    for (std::size_t face = 0; face < form->contact().faces(); ++face)
      shot.faces.push_back(face_snapshot(simulation, *form, face));
  return shot;
}

void add_skin(Snapshot& shot, const GapResult& gap, const trace::BottomTrace& trace,
              double ignition_temperature) {
  const surface::SkinHistory& skin = gap.skin;
  if (skin.time.empty()) return;
  const auto next = std::ranges::lower_bound(skin.time, shot.time);
  const auto after = static_cast<std::size_t>(std::min(next, skin.time.end() - 1) - skin.time.begin());
  const std::size_t before = after == 0 ? 0 : after - 1;
  BottomSkin& bottom = shot.skins.emplace_back();
  bottom.gap = gap.gap;
  for (std::size_t s = 0; s < trace.stations.size(); ++s) {
    if (trace.stations[s].observation) continue;
    const double from = skin.temperature[before * trace.stations.size() + s],
                 to = skin.temperature[after * trace.stations.size() + s];
    const bool ignites = from < ignition_temperature && to >= ignition_temperature;
    const bool has_ignited = shot.time >= skin.time[after] || (skin.ignition && skin.ignition->station == s &&
                                                               skin.ignition->time <= shot.time);
    bottom.temperature.push_back(!ignites      ? surface::temperature_at_time(skin, trace, s, shot.time)
                                 : has_ignited ? to
                                               : from);
  }
}

SnapshotTaker::SnapshotTaker(const scene::Scene& scene)
    : tolerance_(2e-12 * scene::end_time(scene.load)),
      wants_ignition_(scene.output.asks_for(Event::ignition)) {
  for (const double time : scene.output.snapshot_times) due_.push_back({time, {}});
  if (scene.output.asks_for(Event::peak_pressure))
    due_.push_back({scene::PressureHistory(scene.load).peak_time(), Event::peak_pressure});
  std::ranges::stable_sort(due_, {}, &Due::time);
}

void SnapshotTaker::take_due(double time, const Take& take) {
  std::vector<Event> events;
  for (; is_due(time); ++next_)
    if (due_[next_].event) events.push_back(*due_[next_].event);
  keep(take(), std::move(events));
}

void SnapshotTaker::take_ignition(const Take& take) {
  if (std::exchange(wants_ignition_, false)) keep(take(), {Event::ignition});
}

void SnapshotTaker::keep(Snapshot shot, std::vector<Event> events) {
  shot.events = std::move(events);
  taken_.push_back(std::move(shot));
}

std::vector<Snapshot> SnapshotTaker::finish() {
  merge_instants(taken_);
  return std::move(taken_);
}

void merge_instants(std::vector<Snapshot>& snapshots) {
  std::ranges::stable_sort(snapshots, {}, &Snapshot::time);
  std::vector<Snapshot> merged;
  for (Snapshot& shot : snapshots) {
    if (merged.empty() || merged.back().time != shot.time) {
      merged.push_back(std::move(shot));
      continue;
    }
    std::vector<Event>& events = merged.back().events;
    events.insert(events.end(), shot.events.begin(), shot.events.end());
    std::ranges::sort(events);
  }
  snapshots = std::move(merged);
}

}  // namespace launchsafe::run
