#include "launchsafe/run/snapshot_fields.hpp"

#include <algorithm>

namespace launchsafe::run {
namespace {

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
      {{"half_length_x", "m", half_x, millimetre}, &Snapshot::half_length_x},
      {{"half_length_r", "m", half_r, millimetre}, &Snapshot::half_length_r},
      {{"burnt_share", "1", "burnt share", {}, true}, &Snapshot::burnt_share, false, {}, burnt},
  };
}

std::vector<SnapshotField> all_fields() {
  std::vector<SnapshotField> fields = common_fields();
  // Before what burns: pictures follow each other in this order.
  const auto add = [&](const StateField& field) {
    const bool known = std::any_of(fields.begin(), fields.end(),
                                   [&](const SnapshotField& each) { return each.name == field.name; });
    if (!field.meaning.empty() && !known) fields.insert(fields.end() - 1, SnapshotField{field});
  };
  materials::for_each_law([&](const auto& law) { std::for_each(law.state.begin(), law.state.end(), add); });
  return fields;
}

}  // namespace

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
