// The frequencies of a shell against those of rods in a row, and rings against what launches with them came
// to.
#include "launchsafe/materials/laws.hpp"
#include "launchsafe/run/cost.hpp"
#include "launchsafe/scene/read_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace launchsafe::run {
namespace {

scene::Scene the_shell() {
  return scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").value().scene;
}

/// A rod that a rigid barrel holds; elements of shear that relax at a rate (1/s).
struct Rod {
  double length, density, bulk;  // SI
  std::vector<std::pair<double, double>> shear_and_rate;

  /// Of a Maxwell solid that swings with the angular frequency w, in phase: each element has G w2/(w2 +
  /// rate2).
  double modulus(double angular) const {
    double shear = 0.0;
    for (const auto& [size, rate] : shear_and_rate)
      shear += size * angular * angular / (angular * angular + rate * rate);
    return bulk + 4.0 / 3.0 * shear;
  }
};

/// Stress (of any size) at the far end of rods that swing freely at the near one: displacement and stress go
/// through each as u' = u cos kL + s/(M k) sin kL, s' = s cos kL - M k u sin kL. It is 0 at the frequencies
/// of the row.
double stress_at_end(const std::vector<Rod>& rods, double frequency) {
  const double angular = 2.0 * std::numbers::pi * frequency;
  double displacement = 1.0, stress = 0.0;
  for (const Rod& rod : rods) {
    const double modulus = rod.modulus(angular), k = angular * std::sqrt(rod.density / modulus);
    const double cosine = std::cos(k * rod.length), sine = std::sin(k * rod.length), stiff = modulus * k;
    const double before = displacement;
    displacement = before * cosine + stress / stiff * sine;
    stress = stress * cosine - stiff * before * sine;
  }
  return stress;
}

std::vector<double> frequencies_of(const std::vector<Rod>& rods, std::size_t count) {
  std::vector<double> found;
  for (double frequency = 50.0; found.size() < count; frequency += 1.0)
    if (stress_at_end(rods, frequency) * stress_at_end(rods, frequency + 1.0) <= 0.0)
      found.push_back(frequency + 0.5);
  return found;
}

TEST(AxialModes, AreThoseOfThreeFreeRodsInARow) {
  scene::Scene row = the_shell();
  row.interfaces.clear();
  row.bodies = {{"front", "steel", 0.0, 0.2, 0.0, 0.02},
                {"filling", "charge", 0.2, 0.6, 0.0, 0.02},
                {"rear", "steel", 0.6, 0.7, 0.0, 0.02}};
  row.output = {};
  row.numerics.cell_size = 0.01;
  const materials::Law steel = row.steel(), charge = row.charge();
  const auto rod = [](const materials::Law& law, double length) {
    return Rod{length,
               materials::initial_density(law),
               materials::bulk_modulus(law),
               {{materials::shear_modulus(law), 0.0}}};
  };
  Rod filling = rod(charge, 0.4);
  filling.shear_and_rate.clear();
  const auto& elements = row.charge().strength;
  for (std::size_t i = 0; i < elements.shear_moduli.size(); ++i)
    filling.shear_and_rate.emplace_back(elements.shear_moduli[i], elements.relaxation_rates[i]);
  const auto expected = frequencies_of({rod(steel, 0.2), filling, rod(steel, 0.1)}, 2);
  const std::vector<AxialMode> modes = axial_modes(row);
  ASSERT_GE(modes.size(), 2u);
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(modes[i].frequency, expected[i], 25.0 + 0.01 * expected[i]) << i;  // sought in steps of 25
}

// Launches at 496 MPa with a ring on the load: those that ignited the charge without a gap.
TEST(AxialModes, OfTheShellAreThoseAtWhichRingsIgnited) {
  scene::Scene scene = the_shell();
  scene.numerics.cell_size = 2.5e-3;
  const std::vector<AxialMode> modes = axial_modes(scene);
  for (const double frequency : {2.4e3, 3.2e3, 9.8e3})
    EXPECT_NE(mode_near({frequency, 1e6}, modes), nullptr) << frequency;
  for (const double frequency : {4.8e3, 9.4e3})
    EXPECT_EQ(mode_near({frequency, 1e6}, modes), nullptr) << frequency;
}

TEST(AxialModes, NoneIsFoundWithoutACharge) {
  scene::Scene scene = the_shell();
  std::erase_if(scene.bodies, [&](const scene::Body& body) { return scene::is_charge(scene, body); });
  EXPECT_TRUE(axial_modes(scene).empty());
}

}  // namespace
}  // namespace launchsafe::run
