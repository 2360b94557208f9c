#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/read_scene.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

namespace launchsafe::scene {
namespace {

/// The shipped shell, and bodies behind its base.
Scene shell_with(const std::vector<Body>& more) {
  Scene scene;
  scene.bodies = {{"nose", "steel", 0.0, 0.118, 0.0, 0.0775},
                  {"charge", "charge", 0.118, 0.678, 0.0, 0.065},
                  {"wall", "steel", 0.118, 0.678, 0.065, 0.0775},
                  {"base", "steel", 0.678, 0.74, 0.0, 0.0775}};
  scene.bodies.insert(scene.bodies.end(), more.begin(), more.end());
  return scene;
}

const double full_area = std::numbers::pi * 0.0775 * 0.0775;

/// Gas presses axially on pi R^2 less nothing, whatever is drawn behind the band: what it finds less on faces
/// across x behind it finds more in front of it.
void expect_full_area(const Scene& scene, double band) {
  const Chamber chamber = chamber_of(scene);
  EXPECT_TRUE(chamber.sealed);
  EXPECT_NEAR(chamber.band, band, 1e-12);
  EXPECT_NEAR(base_area(scene), full_area, 1e-15);
}

/// Of all sides along x, m: those turned outward less those turned inward.
double length_of_sides(const Scene& scene) {
  double length = 0.0;
  for (const ChamberFace& face : chamber_of(scene).faces)
    if (!face.across_x()) length -= face.direction() * (face.end - face.begin);
  return length;
}

TEST(Chamber, ActsOnTheRearFaceOfAFlatBaseAlone) {
  const Scene scene = shell_with({});
  const Chamber chamber = chamber_of(scene);
  ASSERT_EQ(chamber.faces.size(), 1u);
  EXPECT_EQ(chamber.faces[0].body, 3u);
  EXPECT_EQ(chamber.faces[0].side, BodySide::x_end);
  EXPECT_EQ(chamber.faces[0].begin, 0.0);
  EXPECT_EQ(chamber.faces[0].end, 0.0775);
  expect_full_area(scene, 0.74);
}

TEST(Chamber, ActsBesideABoomAndOnItsSide) {
  const Scene scene = shell_with({{"boom", "steel", 0.74, 0.84, 0.0, 0.02}});
  expect_full_area(scene, 0.74);
  EXPECT_NEAR(length_of_sides(scene), 0.1, 1e-12);
}

TEST(Chamber, ActsOnEveryStepOfABoatTail) {
  const Scene scene =
      shell_with({{"tail", "steel", 0.74, 0.77, 0.0, 0.07}, {"end", "steel", 0.77, 0.8, 0.0, 0.06}});
  expect_full_area(scene, 0.74);
  EXPECT_NEAR(length_of_sides(scene), 0.06, 1e-12);
}

TEST(Chamber, ActsInsideASkirtAndInsideAWallBehindASetBackBase) {
  const Scene skirt = shell_with({{"skirt", "steel", 0.74, 0.8, 0.068, 0.0775}});
  expect_full_area(skirt, 0.8);
  EXPECT_NEAR(length_of_sides(skirt), -0.06, 1e-12);
  Scene set_back = shell_with({});
  set_back.bodies[2].x_end = 0.74;
  set_back.bodies[3] = {"base", "steel", 0.678, 0.72, 0.0, 0.065};
  expect_full_area(set_back, 0.74);
  EXPECT_NEAR(length_of_sides(set_back), -0.02, 1e-12);
}

/// Fins of full radius on a boom: gas is before and behind them.
TEST(Chamber, SealsAtTheForemostRingOfFullRadiusOrAtTheStatedOne) {
  Scene scene =
      shell_with({{"boom", "steel", 0.74, 0.84, 0.0, 0.02}, {"ring", "steel", 0.8, 0.82, 0.02, 0.0775}});
  expect_full_area(scene, 0.74);
  EXPECT_NEAR(length_of_sides(scene), 0.08, 1e-12);
  scene.load.obturation = 0.81;
  expect_full_area(scene, 0.82);
  EXPECT_NEAR(length_of_sides(scene), 0.02, 1e-12);
  scene.load.obturation = 0.77;
  EXPECT_FALSE(chamber_of(scene).sealed);
}

TEST(Chamber, IsUnclearWhereGasPassesTheBandOrReachesTheCharge) {
  Scene open;
  open.bodies = {{"tube", "steel", 0.0, 0.5, 0.01, 0.02}};
  EXPECT_FALSE(chamber_of(open).sealed);
  EXPECT_NEAR(base_area(open), std::numbers::pi * (0.02 * 0.02 - 0.01 * 0.01), 1e-18);  // its rear face
  Scene shorter = shell_with({});
  shorter.bodies[2].x_end = 0.6;
  EXPECT_FALSE(chamber_of(shorter).sealed);
  shorter.load.obturation = 0.7;
  expect_full_area(shorter, 0.74);
}

TEST(Chamber, LoadsNoMoreThanTheRearFaceOnAnEvenGrid) {
  Scene scene = shell_with({{"boom", "steel", 0.74, 0.84, 0.0, 0.02}});
  scene.numerics.formulation = Formulation::updated_lagrangian;
  EXPECT_FALSE(chamber_of(scene).sealed);
  EXPECT_EQ(chamber_of(scene).faces.size(), 1u);
}

}  // namespace
}  // namespace launchsafe::scene
