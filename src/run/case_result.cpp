#include "launchsafe/run/case_result.hpp"

#include "launchsafe/scene/plan.hpp"

#include <fmt/format.h>

namespace launchsafe::run {

std::string to_string(RunStatus status) {
  // In the order of RunStatus.
  constexpr std::array words{
      "completed",   "non-finite", "energy drift",    "time step collapse",    "particles left the grid",
      "interrupted", "timed out",  "cells distorted", "outside of the gas law"};
  static_assert(words.size() == static_cast<std::size_t>(last_status) + 1);
  return words.at(static_cast<std::size_t>(status));
}

LimiterCounts& LimiterCounts::operator+=(const LimiterCounts& other) {
  for (const Limiter& each : limiters) this->*each.member += other.*each.member;
  return *this;
}

std::string to_string(const LimiterCounts& counts) {
  std::vector<std::string> acted;
  for (const Limiter& each : limiters)
    if (counts.*each.member > 0) acted.push_back(fmt::format("{} {}", each.words, counts.*each.member));
  return fmt::format("{}", fmt::join(acted, ", "));
}

void add_mass(std::vector<MaterialMass>& masses, const std::string& material, double mass) {
  const auto known = std::ranges::find(masses, material, &MaterialMass::material);
  if (known == masses.end())
    masses.push_back({material, mass});
  else
    known->mass += mass;
}

double mass_of(const MechanicsResult& mechanics, std::string_view material) {
  for (const MaterialMass& each : mechanics.masses)
    if (each.material == material) return each.mass;
  return 0.0;
}

namespace {

/// Pa. A hundredth of an atmosphere: it heats nothing.
constexpr double least_pressure = 1e3;

using materials::StateField;

/// What they hold whatever the laws are.
std::vector<SnapshotField> common_fields() {
  using keys::megapascal, keys::kelvin, keys::millimetre;
  constexpr keys::Unit density{keys::Dimension::density, "kg/m3"};
  constexpr std::string_view axial =
      "axial stress deviator; the stress, positive in tension, is deviator_xx - pressure";
  constexpr std::string_view radial =
      "radial stress deviator; the stress, positive in tension, is deviator_rr - pressure; of the hoop "
      "-(deviator_rr + deviator_xx) - pressure";
  constexpr std::string_view half_x = "of the particle's cell at present, axial";
  constexpr std::string_view half_r = "of the particle's cell at present, radial";
  constexpr std::string_view burnt = "burnt share of the particle's mass";
  return {
      {{"temperature", "K", "temperature", kelvin, true}, &Snapshot::temperature, true, "bulk temperature"},
      {{"pressure", "Pa", "pressure", megapascal, true},
       &Snapshot::pressure,
       true,
       {},
       "pressure, compression positive"},
      {{"von_mises", "Pa", "von Mises stress", megapascal, true}, &Snapshot::von_mises, true},
      {{"deviator_xx", "Pa", axial, megapascal}, &Snapshot::deviator_xx, true},
      {{"deviator_rr", "Pa", radial, megapascal}, &Snapshot::deviator_rr, true},
      {{"deviator_rx", "Pa", "shear stress", megapascal}, &Snapshot::deviator_rx, true},
      {{"density", "kg/m3", "density", density}, &Snapshot::density, true},
      {{"half_length_x", "m", half_x, millimetre}, &Snapshot::half_length_x, true},
      {{"half_length_r", "m", half_r, millimetre}, &Snapshot::half_length_r, true},
      {{"burnt_share", "1", "burnt share", {}, true}, &Snapshot::burnt_share, false, {}, burnt},
  };
}

std::vector<SnapshotField> all_fields() {
  std::vector<SnapshotField> fields = common_fields();
  // Before what burns: pictures follow each other in this order.
  const auto add = [&](const StateField& field) {
    const bool known = std::ranges::find(fields, field.name, &SnapshotField::name) != fields.end();
    if (!field.meaning.empty() && !known) fields.insert(fields.end() - 1, SnapshotField{field});
  };
  materials::for_each_law([&](const auto& law) { std::ranges::for_each(law.state, add); });
  return fields;
}

}  // namespace

double largest_energy_drift(const MechanicsResult& mechanics) {
  double largest = math::not_a_number, scale = 0;
  for (const MonitorSample& sample : mechanics.monitor) scale = std::max(scale, sample.energy.scale());
  for (const MonitorSample& sample : mechanics.monitor) {
    const double drift = std::abs(sample.energy.drift()) * sample.energy.scale() / scale;
    if (!(drift <= largest)) largest = drift;
  }
  return largest;
}

double least_judged_energy(const scene::Scene& scene) {
  const double pressure = std::max(0.01 * scene::PressureHistory(scene.load).peak(), least_pressure);
  double energy = 0.0;
  for (const scene::Material& material : scene::used_materials(scene)) {
    const double speed = scene::longitudinal_speed(material.law);
    const double density = initial_density(material.law);
    energy += 0.5 * pressure * pressure * scene::mass_of(scene, material.name) /
              (density * density * speed * speed);
  }
  return energy;
}

const std::vector<SnapshotField>& snapshot_fields() {
  static const std::vector<SnapshotField> fields = all_fields();
  return fields;
}

const std::vector<double>& values_of(const Snapshot& snapshot, const SnapshotField& field) {
  static const std::vector<double> none;
  if (field.values != nullptr) return snapshot.*field.values;
  const auto found = snapshot.state.find(field.name);
  return found != snapshot.state.end() ? found->second : none;
}

std::vector<double>& values_of(Snapshot& snapshot, const SnapshotField& field) {
  return field.values != nullptr ? snapshot.*field.values : snapshot.state[std::string(field.name)];
}

bool has_field(const scene::Scene& scene, const scene::Body& body, const SnapshotField& field) {
  if (field.values == nullptr) return materials::has_field(scene::law_of(scene, body), field.name);
  return field.values != &Snapshot::burnt_share || scene::is_charge(scene, body);
}

}  // namespace launchsafe::run
