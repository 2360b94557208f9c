// The finite element decks that are written, and the output that is read, without CalculiX.
#include "launchsafe/verify/finite_elements.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace launchsafe::verify {
namespace {

/// A ring of two elements under 0.1 MPa inside, in plane strain.
FiniteElementModel ring() {
  FiniteElementModel model;
  model.edges_x = {0.0, 1e-3};
  model.edges_r = {0.065, 0.071, 0.0775};
  model.materials = {{166.4e9, 80e9, 7830.0, {}}};
  model.material_of = {0, 0};
  model.bore_pressure = 1e5;
  model.ends_held = true;
  return model;
}

/// What CalculiX 2.20 printed for it; point 5 to 8 mirror 1 to 4.
const std::string printed = R"(
 stresses (elem, integ.pnt.,sxx,syy,szz,sxy,sxz,syz) for set ELEMENTS and time  0.1000000E+01

         1   1 -8.716480E-02  1.389088E-01  5.615529E-01  9.535092E-11  6.539736E-03 -9.609217E-13
         1   2 -5.571942E-02  1.389089E-01  5.301074E-01  8.242888E-11  5.905815E-03 -8.306060E-13
         1   3 -8.716480E-02  1.389088E-01  5.615529E-01 -9.535226E-11  6.539736E-03  9.608566E-13
         1   4 -5.571942E-02  1.389089E-01  5.301074E-01 -8.242182E-11  5.905815E-03  8.306340E-13
         1   5 -8.716480E-02  1.389088E-01  5.615529E-01  9.534658E-11 -6.539736E-03  9.608031E-13
         1   6 -5.571942E-02  1.389089E-01  5.301074E-01  8.242780E-11 -5.905815E-03  8.306991E-13
         1   7 -8.716480E-02  1.389088E-01  5.615529E-01 -9.533492E-11 -6.539736E-03 -9.608058E-13
         1   8 -5.571942E-02  1.389089E-01  5.301074E-01 -8.241966E-11 -5.905815E-03 -8.306001E-13
         2   1 -3.474544E-02  1.389089E-01  5.091334E-01  7.398701E-11  5.482826E-03 -7.455920E-13
         2   2 -8.579073E-03  1.389090E-01  4.829669E-01  6.386438E-11  4.955328E-03 -6.436094E-13
         2   3 -3.474544E-02  1.389089E-01  5.091334E-01 -7.398893E-11  5.482826E-03  7.455556E-13
         2   4 -8.579073E-03  1.389090E-01  4.829669E-01 -6.385898E-11  4.955328E-03  6.435138E-13
         2   5 -3.474544E-02  1.389089E-01  5.091334E-01  7.398918E-11 -5.482826E-03  7.455920E-13
         2   6 -8.579073E-03  1.389090E-01  4.829669E-01  6.386329E-11 -4.955328E-03  6.436264E-13
         2   7 -3.474544E-02  1.389089E-01  5.091334E-01 -7.398893E-11 -5.482826E-03 -7.455218E-13
         2   8 -8.579073E-03  1.389090E-01  4.829669E-01 -6.386440E-11 -4.955328E-03 -6.435561E-13
)";

bool has_line(const std::string& deck, const std::string& line) {
  return ("\n" + deck).find("\n" + line + "\n") != std::string::npos;
}

TEST(FiniteElementDeck, NumbersCornersCounterclockwiseAndThenTheMidSides) {
  const std::string deck = deck_of(ring());
  // Nodes run along x first: three on each line of corners, two on each line of mid-sides.
  EXPECT_TRUE(has_line(deck, "1,0.065,0")) << deck;
  EXPECT_TRUE(has_line(deck, "3,0.065,0.001")) << deck;
  EXPECT_TRUE(has_line(deck, "10,0.07425,0")) << deck;
  EXPECT_EQ(deck.find("\n5,"), std::string::npos) << "the middle of an element is no node";
  EXPECT_TRUE(has_line(deck, "1,1,7,9,3,4,8,6,2")) << deck;
  EXPECT_TRUE(has_line(deck, "2,7,13,15,9,10,14,12,8")) << "shares the nodes 7, 8, 9 with its neighbour";
}

TEST(FiniteElementDeck, IsInMetresAndMegapascal) {
  const std::string deck = deck_of(ring());
  EXPECT_TRUE(has_line(deck, "40000,1.201923077e-05")) << "G/2 and 2/K\n" << deck;
  EXPECT_TRUE(has_line(deck, "0.00783")) << "7830 kg/m3";
  EXPECT_TRUE(has_line(deck, "1,P4,0.1")) << "0.1 MPa on the face of the least radius";
  EXPECT_EQ(deck.find("GRAV"), std::string::npos);
}

TEST(FiniteElementDeck, HoldsTheAxisTheBarrelAndOneNodeAgainstDrift) {
  FiniteElementModel bar = ring();
  bar.edges_r = {0.0, 0.01, 0.02};
  bar.ends_held = false;
  bar.rigid_barrel = true;
  bar.bore_pressure = 0.0;
  bar.base_pressure = 50e6;
  bar.acceleration = 1000.0;
  const std::string deck = deck_of(bar);
  for (const char* line : {"1,1,1", "2,1,1", "3,1,1", "13,1,1", "14,1,1", "15,1,1", "1,2,2"})
    EXPECT_TRUE(has_line(deck, line)) << line;
  for (const char* line : {"4,1,1", "7,1,1", "3,2,2"}) EXPECT_FALSE(has_line(deck, line)) << line;
  EXPECT_TRUE(has_line(deck, "ELEMENTS,GRAV,1000,0.,1.,0.")) << "toward the base";
  EXPECT_TRUE(has_line(deck, "1,P3,50"));
  EXPECT_TRUE(has_line(deck, "2,P3,50"));
}

TEST(FiniteElementDeck, TabulatesWhatYields) {
  FiniteElementModel yielding = ring();
  yielding.materials.push_back({166.4e9, 80e9, 7830.0, {{0.0, 792e6}, {0.01, 900e6}}});
  yielding.material_of = {0, 1};
  const std::string deck = deck_of(yielding);
  // E = 9 K G/(3 K + G), nu = (3 K - 2 G)/(6 K + 2 G)
  EXPECT_NE(deck.find("*ELASTIC\n206850.8287,0.2928176796\n*PLASTIC\n792,0\n900,0.01\n"), std::string::npos)
      << deck;
  EXPECT_NE(deck.find("ELSET=PART1\n2,"), std::string::npos) << deck;
  yielding.material_of = {0, 0};
  EXPECT_EQ(deck_of(yielding).find("PART1"), std::string::npos) << "CalculiX refuses an empty set";
}

/// Two rings, one around the other, that can slide.
FiniteElementModel sliding_rings() {
  FiniteElementModel rings = ring();
  rings.body_of = {0, 1};
  rings.contacts = {{1, 0, 0.1}};
  rings.contact_stiffness = 2e14;
  rings.stick_stiffness = 3e14;
  return rings;
}

TEST(FiniteElementContact, GivesEachBodyItsOwnNodesOnTheirFaces) {
  const std::string deck = deck_of(sliding_rings());
  // 15 places for nodes: copies of 7, 8 and 9 are 22, 23 and 24.
  EXPECT_TRUE(has_line(deck, "1,1,7,9,3,4,8,6,2")) << deck;
  EXPECT_TRUE(has_line(deck, "2,22,13,15,24,10,14,12,23")) << deck;
  EXPECT_TRUE(has_line(deck, "7,0.071,0"));
  EXPECT_TRUE(has_line(deck, "22,0.071,0"));
  EXPECT_EQ(deck.find("\n16,"), std::string::npos) << "no copies elsewhere";
}

TEST(FiniteElementContact, PairsTheFacesInMegapascal) {
  const std::string deck = deck_of(sliding_rings());
  EXPECT_NE(deck.find("*SURFACE,NAME=OWN0,TYPE=ELEMENT\n2,S4\n*SURFACE,NAME=OTHER0,TYPE=ELEMENT\n1,S2\n"),
            std::string::npos)
      << deck;
  EXPECT_TRUE(has_line(deck, "OWN0,OTHER0"));
  EXPECT_NE(deck.find("PRESSURE-OVERCLOSURE=LINEAR\n200000000\n*FRICTION\n0.1,30000000\n"), std::string::npos)
      << deck;
  FiniteElementModel rougher = sliding_rings();
  rougher.contacts[0].friction = 0.3;
  EXPECT_NE(deck_of(rougher).find("*FRICTION\n0.3,30000000\n"), std::string::npos)
      << "no stiffer from 0.1 on";
  FiniteElementModel smooth = sliding_rings();
  smooth.contacts[0].friction = 0.0;
  EXPECT_EQ(deck_of(smooth).find("*FRICTION"), std::string::npos);
}

/// A body (1) in the corner of two that are bonded to each other (0 below, 2 beside).
FiniteElementModel corner() {
  FiniteElementModel corner = ring();
  corner.edges_x = {0.0, 1e-3, 2e-3};
  corner.material_of = {0, 0, 0, 0};
  corner.body_of = {1, 0, 2, 0};
  corner.contacts = {{1, 2, 0.0}};
  return corner;
}

TEST(FiniteElementContact, EndsInANodeOfAllWhereABondBegins) {
  // Places are 5 a row: the corner is 13, the mid-side between 1 and 2 on its left 12, with a copy 12 + 25.
  const std::string bonded_below = deck_of(corner());
  EXPECT_EQ(bonded_below.find("\n38,"), std::string::npos) << bonded_below;
  EXPECT_NE(bonded_below.find("\n37,"), std::string::npos) << bonded_below;
  FiniteElementModel free = corner();
  free.contacts.push_back({1, 0, 0.0});
  const std::string all_around = deck_of(free);
  EXPECT_NE(all_around.find("\n38,"), std::string::npos) << "two copies of the corner\n" << all_around;
  EXPECT_EQ(all_around.find("\n63,"), std::string::npos) << "0 and 2 share theirs\n" << all_around;
}

TEST(FiniteElementContact, StaysInPlaceWhereTheMeshIsRefined) {
  EXPECT_EQ(refined(sliding_rings()).body_of, (std::vector<int>{0, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(refined(sliding_rings()).contacts.size(), 1U);
}

TEST(FiniteElementMesh, IsGradedFromOneDistanceToTheOther) {
  const std::vector<double> edges = graded_edges(1.0, 2.0, 0.2, 0.05);
  EXPECT_EQ(edges.front(), 1.0);
  EXPECT_EQ(edges.back(), 2.0);
  EXPECT_LE(edges[1] - edges[0], 0.2);
  EXPECT_GE(edges[1] - edges[0], 0.15);
  const std::size_t last = edges.size() - 1;
  EXPECT_LE(edges[last] - edges[last - 1], 0.06);  // 0.05 lies at its end
  const double ratio = (edges[2] - edges[1]) / (edges[1] - edges[0]);
  for (std::size_t k = 3; k <= last; ++k)
    EXPECT_NEAR((edges[k] - edges[k - 1]) / (edges[k - 1] - edges[k - 2]), ratio, 1e-12);
  EXPECT_EQ(graded_edges(0.0, 1.0, 0.25, 0.25), (std::vector<double>{0.0, 0.25, 0.5, 0.75, 1.0}));
}

TEST(FiniteElementMesh, RefinedKeepsItsMaterialsInPlace) {
  FiniteElementModel model = ring();
  model.material_of = {0, 1};
  const FiniteElementModel finer = refined(model);
  EXPECT_EQ(finer.edges_x, (std::vector<double>{0.0, 0.5e-3, 1e-3}));
  EXPECT_EQ(finer.material_of, (std::vector<int>{0, 0, 0, 0, 1, 1, 1, 1}));
}

/// The weights integrate any cubic exactly, hence the volume per radian.
TEST(FiniteElementMesh, PointsWeighTheVolume) {
  const FiniteElementModel model = ring();
  double volume = 0.0, moment = 0.0;
  for (int element = 0; element < model.elements(); ++element)
    for (int point = 0; point < integration_points; ++point) {
      const IntegrationPoint at = integration_point(model, element, point);
      volume += at.weight;
      moment += at.weight * at.r * at.x;
    }
  const double inner = 0.065, outer = 0.0775, length = 1e-3;
  EXPECT_NEAR(volume, 0.5 * length * (outer * outer - inner * inner), 1e-18);
  EXPECT_NEAR(moment, length * length / 6.0 * (std::pow(outer, 3) - std::pow(inner, 3)), 1e-20);
}

TEST(FiniteElementOutput, GivesTheStressesInThePlaneOfTheirPoint) {
  const FiniteElementModel model = ring();
  const auto result = read_finite_element_output(printed, model.elements());
  ASSERT_TRUE(result) << result.error().message;
  ASSERT_EQ(result->stress.size(), 8U);
  // Lame: sigma_rr, sigma_tt = a (1 -+ R^2/r^2), a = p bore^2/(R^2 - bore^2); two elements are coarse.
  const double a = 1e5 * 0.065 * 0.065 / (0.0775 * 0.0775 - 0.065 * 0.065);
  const double poisson = (3.0 * 166.4 - 2.0 * 80.0) / (6.0 * 166.4 + 2.0 * 80.0);
  for (int element = 0; element < 2; ++element)
    for (int point = 0; point < integration_points; ++point) {
      const double r = integration_point(model, element, point).r;
      const CauchyStress& stress = result->at(element, point);
      EXPECT_NEAR(stress.rr, a * (1.0 - std::pow(0.0775 / r, 2)), 60.0);
      EXPECT_NEAR(stress.tt, a * (1.0 + std::pow(0.0775 / r, 2)), 60.0);
      EXPECT_NEAR(stress.xx, 2.0 * poisson * a, 60.0);
      EXPECT_NEAR(stress.rx, 0.0, 1e-2);
      EXPECT_NEAR(stress.measures().pressure, -(stress.rr + stress.tt + stress.xx) / 3.0, 1e-6);
    }
}

TEST(FiniteElementOutput, OfTheLastIncrementCounts) {
  std::string twice = printed;
  for (std::size_t at = twice.find("E-0"); at != std::string::npos; at = twice.find("E-0", at + 3))
    twice.replace(at, 3, "E-1");
  const auto last = read_finite_element_output(twice + printed, 2),
             alone = read_finite_element_output(printed, 2);
  ASSERT_TRUE(last && alone);
  EXPECT_EQ(last->at(1, 3).tt, alone->at(1, 3).tt);
}

TEST(FiniteElementOutput, ThatIsCutOffOrOfAnotherMeshIsRefused) {
  for (const std::string& text : {std::string(), printed.substr(0, printed.size() / 3)}) {
    const auto result = read_finite_element_output(text, 2);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, store::Error::Kind::corrupt);
  }
  EXPECT_FALSE(read_finite_element_output(printed, 1));
  EXPECT_FALSE(read_finite_element_output(printed, 3));
}

TEST(CauchyStressMeasures, OfPureShearAreItsOwn) {
  const StressMeasures shear = CauchyStress{0.0, 0.0, 0.0, 2.0}.measures();
  EXPECT_EQ(shear.pressure, 0.0);
  EXPECT_DOUBLE_EQ(shear.von_mises, 2.0 * std::sqrt(3.0));
  const StressMeasures pull = CauchyStress{0.0, 3.0, 0.0, 0.0}.measures();
  EXPECT_DOUBLE_EQ(pull.pressure, -1.0);
  EXPECT_DOUBLE_EQ(pull.von_mises, 3.0);
}

}  // namespace
}  // namespace launchsafe::verify
