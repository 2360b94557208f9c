#include "burning_bottom.hpp"

namespace launchsafe::run {
namespace {

/// An interval of a column ends once its pressure, or by conduction alone its volume, has changed by so much,
/// or at a sample of the trace.
constexpr double pressure_change = 0.05, volume_change = 0.02;
/// Where air flows, also once such a part of its volume has moved.
constexpr double part_moved = 0.02;
/// Largest part of an opening by which faces approach in a step.
constexpr double most_closed = 0.1;
/// Of the time that sound takes through the charge: the pressure of its bottom is a mean over it.
constexpr double smoothed_part = 0.05;

mpm::Contact& contact_of(mpm::Simulation& simulation) { return simulation.total_lagrangian()->contact(); }

surface::SkinModel model_of(const scene::Scene& scene) {
  surface::SkinModel model = surface::skin_model(scene);
  if (!scene.surface.ideal_air) model.surface.air = materials::hot_and_dense(model.surface.air);
  return model;
}

bool is_bottom(const scene::Scene& scene, const mpm::Contact& contact, std::size_t face) {
  return !contact.is_along_x(face) &&
         std::abs(contact.face_at(face) - scene::charge_extent(scene).x_end) < scene::length_tolerance(scene);
}

}  // namespace

HeldCharge::HeldCharge(mpm::Simulation& simulation) {
  const scene::Scene& scene = simulation.scene();
  if (scene.surface.model != scene::GapModel::closing || !(scene.surface.release > 0.0)) return;
  release_ = scene.surface.release;
  duration_ = scene.surface.release_duration.value_or(scene::transit_time(scene));
  mpm::Contact& contact = contact_of(simulation);
  for (std::size_t face = 0; face < contact.faces(); ++face)
    if (!is_bottom(scene, contact, face)) contact.hold(face);
}

void HeldCharge::advance(mpm::Simulation& simulation) const {
  const double late = simulation.time() - release_;
  if (!(release_ > 0.0) || late < 0.0) return;
  contact_of(simulation).loosen(late < duration_ ? 1.0 - late / duration_ : 0.0);
}

ClosingGap::ClosingGap(mpm::Simulation& simulation, const TraceRecorder& recorder, double gap)
    : model_(model_of(simulation.scene())),
      shares_air_(model_.surface.air_flow == scene::AirFlow::common_pressure),
      nodes_(nodes_of_bottom(simulation, recorder)),
      floor_(simulation.scene().surface.roughness),
      often_(simulation.scene().surface.turns),
      columns_(model_, nodes_.size(), gap, scene::end_time(simulation.scene().load),
               surface::GapColumns::numerics_of(model_.surface)),
      smoothing_time_(smoothed_part * scene::transit_time(simulation.scene())) {
  simulation.centre_kicks();
  mpm::Contact& contact = contact_of(simulation);
  for (std::size_t face = 0; face < contact.faces(); ++face)
    if (is_bottom(simulation.scene(), contact, face)) contact.part(face, gap, floor_);
  find_columns_of_stations(recorder);
  skin_.gap = gap;
  history_.smallest_opening = gap;
  for (std::size_t column = 0; column < nodes_.size(); ++column) {
    nodes_[column].opening = gap;
    nodes_[column].hottest = columns_[column].hottest();
    nodes_[column].pressure = model_.surface.air.initial_pressure;
    if (!shares_air_) start_interval(column, contact, 0.0);
  }
  if (shares_air_) share_air(contact, 0.0);
  record(recorder);
}

std::vector<ClosingGap::Node> ClosingGap::nodes_of_bottom(mpm::Simulation& simulation,
                                                          const TraceRecorder& recorder) {
  const scene::Scene& scene = simulation.scene();
  const mpm::Contact& contact = contact_of(simulation);
  const std::vector<scene::StationExtent> stations = scene::stations_of(scene);
  std::vector<Node> nodes;
  for (std::size_t face = 0; face < contact.faces(); ++face) {
    if (!is_bottom(scene, contact, face)) continue;
    const std::vector<mpm::FaceState> states = contact.state_of(face);
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (!(states[i].area > 0.0)) continue;
      const double place = states[i].place;
      const double begin = i > 0 ? 0.5 * (states[i - 1].place + place) : place;
      const double end = i + 1 < states.size() ? 0.5 * (place + states[i + 1].place) : place;
      const std::size_t first = nodes.size();
      for (std::size_t s = 0; s < stations.size(); ++s) {
        const double overlap = std::min(end, stations[s].r_end) - std::max(begin, stations[s].r_begin);
        if (!(overlap > 0.0)) continue;
        Node node{.face = face, .node = i, .station = s, .place = place};
        node.area = states[i].area * overlap / (end - begin);
        node.friction_before = friction_of(node, recorder);
        nodes.push_back(node);
      }
      const std::span own(nodes.begin() + static_cast<std::ptrdiff_t>(first), nodes.end());
      const auto largest = std::ranges::max_element(own, {}, &Node::area);
      if (largest == own.end()) continue;
      largest->states_gas = true;
      std::iter_swap(own.begin(), largest);
    }
  }
  return nodes;
}

/// A ring has the nodes whose part of the bottom lies in it; an observation point that nearest to it.
void ClosingGap::find_columns_of_stations(const TraceRecorder& recorder) {
  const std::vector<trace::Station>& stations = recorder.trace().stations;
  columns_of_station_.resize(stations.size());
  for (std::size_t column = 0; column < nodes_.size(); ++column)
    columns_of_station_[nodes_[column].station].push_back(column);
  for (std::size_t s = 0; s < stations.size(); ++s) {
    if (!columns_of_station_[s].empty()) continue;
    const auto nearest = std::ranges::min_element(
        nodes_, {}, [&](const Node& node) { return std::abs(node.place - stations[s].r); });
    columns_of_station_[s].push_back(static_cast<std::size_t>(nearest - nodes_.begin()));
  }
}

double ClosingGap::friction_of(const Node& node, const TraceRecorder& recorder) const {
  const auto closure = static_cast<std::size_t>(model_.surface.friction);
  return closure < trace::traced_closures ? recorder.friction(closure, node.station) : 0.0;
}

void ClosingGap::advance(mpm::Simulation& simulation, const TraceRecorder& recorder, double dt,
                         bool samples) {
  mpm::Contact& contact = contact_of(simulation);
  const double time = simulation.time();
  bool touches = false, due = shares_air_ && samples;
  const double mean_opening = shares_air_ ? contact.mean_opening() : 0.0;
  double moved = 0.0, volume = 0.0;      // m3 per radian or metre
  const bool follows = !skin_.ignition;  // else at samples alone: how the other columns fare decides nothing
  longest_step_ = math::infinity;
  for (std::size_t column = 0; column < nodes_.size(); ++column) {
    Node& node = nodes_[column];
    const mpm::GapGas& gas = shares_air_ ? contact.common_gas() : contact.gas(node.face, node.node);
    // Air that flows leaves an opening before its molecules fill that.
    const double opening = contact.opening(node.face, node.node), covolume = shares_air_ ? 0.0 : gas.covolume,
                 pressure = node.pressure_ratio * gas.at(shares_air_ ? mean_opening : opening);
    node.closing_speed = (node.opening - opening) / dt;
    node.opening = opening;
    // Faces that were paired anew may leave the air no volume.
    const bool has_volume = opening > covolume && std::isfinite(pressure);
    failed_ = failed_ || !has_volume;
    if (!has_volume) return;
    if (node.closing_speed > 0.0)
      longest_step_ =
          std::min(longest_step_, most_closed / often_ * (opening - covolume) / node.closing_speed);
    node.pressure_integral += 0.5 * dt * (node.pressure + pressure);
    node.pressure = pressure;
    touches = touches || opening <= floor_ * (1.0 + 1e-9);
    if (shares_air_) {
      due = due || (follows && is_due(node, gas));
      moved += node.area * std::abs(opening - node.opening_before);
      volume += node.area * opening;
      continue;
    }
    // The first column of a contact node has its gas, and decides for the others.
    if (node.states_gas) due = samples || is_due(node, gas);
    if (!due) continue;
    follow_heat(column, recorder, time);
    start_interval(column, contact, time);
  }
  if (shares_air_ && (due || (follows && often_ * moved > part_moved * volume))) {
    for (std::size_t column = 0; column < nodes_.size(); ++column) follow_heat(column, recorder, time);
    share_air(contact, time);
  }
  note_motion(touches, time);
  note_pressure(contact, dt);
}

bool ClosingGap::is_due(const Node& node, const mpm::GapGas& gas) const {
  return often_ * std::abs(std::log(node.pressure / node.air.pressure)) > pressure_change ||
         often_ * std::abs(gas.volume / node.air.volume - 1.0) > volume_change;
}

void ClosingGap::follow_heat(std::size_t column, const TraceRecorder& recorder, double time) {
  Node& node = nodes_[column];
  const double length = time - node.begin, friction = friction_of(node, recorder);
  const double heating = (friction - node.friction_before) * model_.surface.localisation /
                         (model_.charge_density * model_.specific_heat * length);
  const bool was_ignited = columns_[column].ignited();
  columns_.advance(column, length, node.air.pressure, node.pressure, node.pressure_integral / length,
                   heating);
  failed_ = failed_ || columns_[column].failed();
  node.hottest = std::max(node.hottest, columns_[column].hottest());
  history_.largest_gas_temperature = std::max(history_.largest_gas_temperature, columns_[column].mean_air());
  if (columns_[column].ignited() && !was_ignited)
    skin_.note_ignition(node.station, node.begin + columns_[column].ignition_time(),
                        columns_[column].chemical_share());
  node.friction_before = friction;
}

/// From the state that the column has between the faces as they are.
void ClosingGap::start_interval(std::size_t column, mpm::Contact& contact, double time) {
  Node& node = nodes_[column];
  node.air = columns_.fit(column, node.opening);
  node.pressure = node.air.pressure;
  node.pressure_integral = 0.0;
  node.begin = time;
  if (!node.states_gas) {
    node.pressure_ratio = node.pressure / contact.gas(node.face, node.node).at(node.opening);
    return;
  }
  contact.set_gas(node.face, node.node, gas_of(node.air, columns_[column].column().covolume()));
}

mpm::GapGas ClosingGap::gas_of(const surface::EnclosedAir& air, double covolume) const {
  return {.outside = model_.surface.air.initial_pressure,
          .pressure = air.pressure,
          .volume = air.volume,
          .exponent = air.exponent,
          .covolume = covolume,
          .exchange = air.exchange,
          .energy_at_walls = air.pressure * air.volume_at_walls};
}

/// The same of all columns, between which air flows meanwhile. Contact may have another mean opening than
/// they have, by how faces are paired: the pressure is theirs.
void ClosingGap::share_air(mpm::Contact& contact, double time) {
  std::vector<double> openings, areas;
  for (const Node& node : nodes_) {
    openings.push_back(node.opening);
    areas.push_back(node.area);
  }
  const double covolume = mean([&](std::size_t column) { return columns_[column].column().covolume(); });
  surface::EnclosedAir air = columns_.fit_together(nodes_.front().pressure, openings, areas);
  air.volume = contact.mean_opening() - covolume;
  for (Node& node : nodes_) {
    node.air = air;
    node.pressure = air.pressure;
    node.pressure_integral = 0.0;
    node.opening_before = node.opening;
    node.begin = time;
  }
  contact.set_common_gas(gas_of(air, covolume));
}

void ClosingGap::note_motion(bool touches, double time) {
  for (std::size_t column = 0; column < nodes_.size(); ++column) {
    const Node& node = nodes_[column];
    history_.smallest_opening = std::min(history_.smallest_opening, node.opening);
    history_.largest_gas_pressure = std::max(history_.largest_gas_pressure, node.pressure);
    if (history_.contacts == 0)
      history_.approach_speed = std::max(history_.approach_speed, node.closing_speed);
  }
  if (touches && !touched_) {
    if (history_.contacts == 0) {
      history_.contact_time = time;
      bottom_.length = bottom_.integral = 0.0;
    }
    ++history_.contacts;
  }
  touched_ = touches;
}

/// When the faces first meet an interval begins, whose rise is from the whole one before.
void ClosingGap::note_pressure(const mpm::Contact& contact, double dt) {
  bottom_.length += dt;
  bottom_.integral += dt * contact.mean_pressure();
  if (bottom_.length < smoothing_time_) return;
  const double mean = bottom_.integral / bottom_.length;
  // Of nothing and a number the larger is the number.
  history_.largest_pressure = std::fmax(history_.largest_pressure, mean);
  history_.steepest_rise = std::fmax(history_.steepest_rise, (mean - bottom_.last) / bottom_.length);
  if (history_.contacts > 0 && std::isnan(history_.pressure_at_contact)) history_.pressure_at_contact = mean;
  bottom_ = {.last = mean};
}

void ClosingGap::record(const TraceRecorder& recorder) {
  history_.time.push_back(recorder.trace().time.back());
  history_.opening.push_back(mean([&](std::size_t column) { return nodes_[column].opening; }));
  history_.gas_pressure.push_back(mean([&](std::size_t column) { return nodes_[column].pressure; }));
  skin_.time.push_back(history_.time.back());
  skin_.air_temperature.push_back(mean([&](std::size_t column) { return columns_[column].mean_air(); }));
  for (const std::vector<std::size_t>& columns : columns_of_station_) {
    double hottest = 0.0;
    for (const std::size_t column : columns) hottest = std::max(hottest, nodes_[column].hottest);
    skin_.temperature.push_back(hottest);
  }
  for (std::size_t column = 0; column < nodes_.size(); ++column)
    nodes_[column].hottest = columns_[column].hottest();
}

ClosingHistory ClosingGap::take_history(mpm::Simulation& simulation) {
  using surface::FilmEnergy;
  const mpm::Contact& contact = contact_of(simulation);
  for (double FilmEnergy::*part : {&FilmEnergy::charge, &FilmEnergy::base, &FilmEnergy::gas,
                                   &FilmEnergy::work, &FilmEnergy::friction, &FilmEnergy::reaction})
    history_.energy.*part = mean([&](std::size_t column) { return columns_[column].energy().*part; });
  history_.work_on_gas =
      mean([&](std::size_t column) { return contact.gas_work(nodes_[column].face, nodes_[column].node); });
  // What flows between columns is none to all of them together.
  if (shares_air_) skin_.energy_residual = history_.energy.residual();
  for (std::size_t column = 0; column < nodes_.size(); ++column)
    skin_.energy_residual = std::max(skin_.energy_residual, columns_[column].energy().residual());
  return std::move(history_);
}

}  // namespace launchsafe::run
