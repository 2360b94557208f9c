// Box means of particles on made-up fields, and what counts as a missed target.
#include "launchsafe/verify/static_stress_comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

namespace launchsafe::verify {
namespace {

/// A charge of 20 mm x 20 mm with one station in the middle of its bottom.
StaticCase block() {
  StaticCase block;
  block.name = "block";
  block.scene.bodies = {{"charge", "charge", 0.0, 0.02, 0.0, 0.02}};
  block.stations = {{"S", 0.01}};
  return block;
}

using Field = std::function<double(double x, double r)>;

/// Particles in the middle of cells between these lines, with a pressure, and a shear stress that makes the
/// von Mises stress twice that.
run::Snapshot snapshot(const std::vector<double>& edges_x, const std::vector<double>& edges_r,
                       const Field& pressure) {
  run::Snapshot snapshot;
  for (std::size_t j = 1; j < edges_r.size(); ++j)
    for (std::size_t i = 1; i < edges_x.size(); ++i) {
      snapshot.x.push_back(0.5 * (edges_x[i - 1] + edges_x[i]));
      snapshot.r.push_back(0.5 * (edges_r[j - 1] + edges_r[j]));
      snapshot.pressure.push_back(pressure(snapshot.x.back(), snapshot.r.back()));
      snapshot.deviator_rr.push_back(0.0);
      snapshot.deviator_xx.push_back(0.0);
      snapshot.deviator_rx.push_back(2.0 / std::sqrt(3.0) * snapshot.pressure.back());
      snapshot.body.push_back(0);
    }
  return snapshot;
}

/// Cells that shrink toward the bottom and the edge; no line but the outer ones is one of the box.
const std::vector<double> graded_x{0.0, 0.008, 0.014, 0.017, 0.019, 0.02};
const std::vector<double> graded_r{0.0, 0.006, 0.011, 0.015, 0.018, 0.02};

TEST(ParticleMeans, WeighCellsByTheirShareOfTheBox) {
  const StaticCase compared = block();
  const auto field = [](double x, double r) { return 1e6 + 1e8 * x + 3e8 * r; };
  const run::Snapshot rest = snapshot(graded_x, graded_r, [](double, double) { return 0.0; });
  const ParticleMeans means = particle_means(compared, {rest, snapshot(graded_x, graded_r, field)});
  // By hand: the box is 15 to 20 mm in x, 7.5 to 12.5 mm in r. Columns of cells in x: 14..17 (2 mm
  // inside), 17..19, 19..20; in r: 6..11 (7.5 to 11 inside), 11..15 (11 to 12.5 inside), weighed by
  // differences of r^2/2.
  const double x = (2.0 * 15.5 + 2.0 * 18.0 + 1.0 * 19.5) / 5.0 * 1e-3;
  const double inner = 11.0 * 11.0 - 7.5 * 7.5, outer = 12.5 * 12.5 - 11.0 * 11.0;
  const double r = (inner * 8.5 + outer * 13.0) / (inner + outer) * 1e-3;
  EXPECT_NEAR(means.means[0].pressure, field(x, r), 1e-3);
  EXPECT_NEAR(means.means[0].von_mises, 2.0 * field(x, r), 1e-3);
  EXPECT_EQ(means.ringing_pressure, 0.0);
}

TEST(ParticleMeans, AverageInTimeAndTellWhatStillMoves) {
  const run::Snapshot rest = snapshot(graded_x, graded_r, [](double, double) { return 0.0; });
  const auto uniform = [](double value) { return [value](double, double) { return value; }; };
  const ParticleMeans means = particle_means(block(), {rest, snapshot(graded_x, graded_r, uniform(0.9e6)),
                                                       snapshot(graded_x, graded_r, uniform(1.1e6))});
  EXPECT_NEAR(means.means[0].pressure, 1e6, 1e-3);
  EXPECT_NEAR(means.ringing_pressure, 0.1, 1e-9);
  EXPECT_NEAR(means.ringing_von_mises, 0.1, 1e-9);
}

TEST(ParticleMeans, FindTheAmplitudeByWhichNeighboursAlternate) {
  std::vector<double> lines;
  for (int k = 0; k <= 16; ++k) lines.push_back(1.25e-3 * k);
  StaticCase compared = block();
  compared.stations = {{"1", 0.0025}, {"2", 0.0075}, {"3", 0.0125}, {"4", 0.0175}};
  const run::Snapshot rest = snapshot(lines, lines, [](double, double) { return 0.0; });
  const auto field = [](double x, double r) {
    const int cell = static_cast<int>(x / 1.25e-3) + static_cast<int>(r / 1.25e-3);
    return 1e6 + (cell % 2 == 0 ? 5e3 : -5e3);
  };
  const ParticleMeans checkered = particle_means(compared, {rest, snapshot(lines, lines, field)});
  EXPECT_NEAR(checkered.alternation, 5e-3, 1e-6);
  const ParticleMeans cubic = particle_means(
      compared, {rest, snapshot(lines, lines, [](double, double r) { return 1e6 + 1e12 * r * r * r; })});
  EXPECT_NEAR(cubic.alternation, 0.0, 1e-12);
}

TEST(ParticleMeans, AreOfStressesNotOfTheirVonMises) {
  const run::Snapshot rest = snapshot(graded_x, graded_r, [](double, double) { return 0.0; });
  run::Snapshot sheared =
      snapshot(graded_x, graded_r, [](double, double r) { return r < 0.011 ? 1e6 : -1e6; });
  const ParticleMeans means = particle_means(block(), {rest, sheared});
  // 7.5 to 11 mm one way, 11 to 12.5 mm the other, weighed by differences of r^2/2.
  const double one_way = 11.0 * 11.0 - 7.5 * 7.5, other_way = 12.5 * 12.5 - 11.0 * 11.0;
  EXPECT_NEAR(means.means[0].von_mises, 2e6 * (one_way - other_way) / (one_way + other_way), 1e-3);
}

StaticComparison compared_by(double pressure_error, double alternation) {
  StaticComparison comparison;
  comparison.compared = block();
  comparison.fine.means = {{1e6, 2e6}};
  ParticleMeans mesh;
  mesh.means = {{1e6 * (1.0 + pressure_error), 2e6}};
  mesh.alternation = alternation;
  comparison.meshes = {mesh};
  return comparison;
}

TEST(StressTarget, IsMissedByErrorsAlternationMotionFailureAndNoNumber) {
  EXPECT_TRUE(missed_targets(compared_by(0.009, 0.0009)).empty());
  EXPECT_EQ(missed_targets(compared_by(0.011, 0.0)).size(), 1U);
  EXPECT_EQ(missed_targets(compared_by(-0.011, 0.0)).size(), 1U);
  EXPECT_EQ(missed_targets(compared_by(0.0, 0.0011)).size(), 1U);
  EXPECT_EQ(missed_targets(compared_by(std::nan(""), 0.0)).size(), 1U);
  StaticComparison moving = compared_by(0.0, 0.0);
  moving.meshes[0].ringing_von_mises = 0.002;
  EXPECT_EQ(missed_targets(moving).size(), 1U);
  StaticComparison failed = compared_by(0.0, 0.0);
  failed.meshes[0].failure = "non-finite";
  failed.meshes[0].means.clear();
  EXPECT_EQ(missed_targets(failed).size(), 1U);
}

TEST(StressTarget, IsWiderBesideTheWall) {
  StaticComparison beside = compared_by(0.03, 0.0);
  EXPECT_EQ(missed_targets(beside).size(), 1U);
  beside.compared.stations[0].r = 0.0625;
  EXPECT_TRUE(missed_targets(beside).empty());
}

TEST(StaticCase, HasABarWhoseStressIsTheClosedFormAndShellsWithAllPoints) {
  const std::vector<StaticCase> cases = static_cases();
  ASSERT_EQ(cases.size(), 7U);
  for (const StaticCase& each : cases) {
    EXPECT_DOUBLE_EQ(scene::PressureHistory(each.scene.load).at(each.scene.load.duration), each.pressure);
    const FiniteElementModel model = finite_element_model(each);
    // Force on the base = mass x acceleration, per radian, but for the bore of 10 um in models with contact.
    const double radius = model.edges_r.back();
    double weight = 0.0;
    for (int element = 0; element < model.elements(); ++element)
      for (int point = 0; point < integration_points; ++point)
        weight +=
            integration_point(model, element, point).weight * model.acceleration *
            model.materials[static_cast<std::size_t>(model.material_of[static_cast<std::size_t>(element)])]
                .density;
    EXPECT_NEAR(weight / (0.5 * each.pressure * radius * radius), 1.0, model.contacts.empty() ? 1e-9 : 1e-7)
        << each.name;
  }
  EXPECT_EQ(cases[0].stations.size(), 13U);
  EXPECT_NEAR(cases[0].stations[0].r, 0.0625, 1e-12);
  EXPECT_NEAR(cases[0].stations[12].r, 0.0025, 1e-12);
  EXPECT_NEAR(cases[2].exact[0].von_mises, 48.75e6, 1.0);  // 50 MPa at 97.5 of 100 mm
}

TEST(StaticCase, WithContactHasItBetweenTheChargeAndWhatItCanSlideOn) {
  const FiniteElementModel sliding = finite_element_model(sliding_shell(0.07)),
                           smooth = finite_element_model(smooth_wall_shell());
  ASSERT_EQ(sliding.contacts.size(), 3U);
  for (const FiniteElementContact& contact : sliding.contacts) {
    EXPECT_EQ(contact.body, 1) << "the charge is the second body";
    EXPECT_EQ(contact.friction, 0.07);
  }
  EXPECT_EQ(smooth.contacts.size(), 2U);
  EXPECT_EQ(smooth.contact_between(1, 3), nullptr) << "the base is bonded";
  ASSERT_NE(smooth.contact_between(2, 1), nullptr);
  EXPECT_EQ(smooth.contact_between(2, 1)->friction, 0.0);
  EXPECT_TRUE(finite_element_model(static_cases()[0]).contacts.empty());
}

TEST(StressTarget, IsNarrowerBesideAWallOnWhichTheChargeCanSlide) {
  StaticComparison beside = compared_by(0.035, 0.0);
  beside.compared.stations[0].r = 0.0625;
  EXPECT_TRUE(missed_targets(beside).empty());
  beside.compared.targets = sliding_shell(0.1).targets;
  EXPECT_EQ(missed_targets(beside).size(), 1U);
}

}  // namespace
}  // namespace launchsafe::verify
