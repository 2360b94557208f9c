// Pairing of two faces: every node's share of a uniform traction, whatever the two are divided into.
#include "launchsafe/mpm/contact.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace launchsafe::mpm;

/// Integral of a node's hat function with the measure over a stretch of the face, by the midpoint rule.
double hat_integral(const std::vector<double>& along, std::size_t node, double begin, double end, bool ring) {
  const int pieces = 20000;
  double sum = 0.0;
  for (int i = 0; i < pieces; ++i) {
    const double place = begin + (end - begin) * (i + 0.5) / pieces;
    double hat = 0.0;
    if (node > 0 && place >= along[node - 1] && place <= along[node])
      hat = (place - along[node - 1]) / (along[node] - along[node - 1]);
    if (node + 1 < along.size() && place > along[node] && place <= along[node + 1])
      hat = (along[node + 1] - place) / (along[node + 1] - along[node]);
    sum += hat * (ring ? place : 1.0);
  }
  return sum * (end - begin) / pieces;
}

FaceLine line(std::vector<double> along) {
  FaceLine face{std::move(along), {}};
  face.across.assign(face.along.size(), 1.0);
  return face;
}

TEST(ContactPairing, AUniformTractionGivesEveryNodeItsShare) {
  // The patch test of Papadopoulos & Taylor 1992: both faces get the integral of their hats.
  const FaceLine other = line({-0.2, 0.35, 0.9, 1.7, 2.2, 3.1, 4.0, 5.5});
  for (const FaceLine& own : {line({0.0, 1.0, 2.0, 3.0, 4.0}), line({0.13, 0.4, 1.9, 2.0, 3.35, 5.2}),
                              line({0.0, 4.0}), line({-0.7, 0.4, 1.1, 4.9, 6.3})})
    for (const bool ring : {false, true}) {
      std::vector<PairRow> rows;
      pair_faces(own, other, !ring, rows);
      std::vector<double> own_force(own.along.size()), other_force(other.along.size());
      for (const PairRow& row : rows) {
        for (const PairShare& each : row.own) own_force[each.node] += row.area * each.share;
        for (const PairShare& each : row.other) other_force[each.node] += row.area * each.share;
      }
      const double begin = std::max(own.along.front(), other.along.front()),
                   end = std::min(own.along.back(), other.along.back());
      for (std::size_t i = 0; i < own.along.size(); ++i)
        EXPECT_NEAR(own_force[i], hat_integral(own.along, i, begin, end, ring), 1e-6);
      for (std::size_t i = 0; i < other.along.size(); ++i)
        EXPECT_NEAR(other_force[i], hat_integral(other.along, i, begin, end, ring), 1e-6);
    }
}

TEST(ContactPairing, NodesThatCoincideMeetEachOtherAlone) {
  FaceLine own = line({0.0, 0.005, 0.012, 0.02}), other = line({0.0, 0.005, 0.012, 0.02, 0.03});
  other.along[1] += 1e-18;
  own.along[3] -= 3e-18;
  std::vector<PairRow> rows;
  pair_faces(own, other, false, rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].own.size(), 1u);
    ASSERT_EQ(rows[i].other.size(), 1u);
    EXPECT_EQ(rows[i].other[0].node, i);
    EXPECT_EQ(rows[i].other[0].share, 1.0);
  }
}

TEST(ContactPairing, SharesReproduceALinearFace) {
  // Dual functions are exact for what is linear along the face: a sloped one touches everywhere.
  FaceLine own = line({0.0, 0.7, 1.1, 2.0, 3.2}), other = line({0.0, 0.4, 1.3, 1.9, 3.2});
  for (FaceLine* face : {&own, &other})
    for (std::size_t i = 0; i < face->along.size(); ++i) face->across[i] = 0.5 + 0.1 * face->along[i];
  std::vector<PairRow> rows;
  pair_faces(own, other, true, rows);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double place = 0.0;
    for (const PairShare& each : rows[i].other) place += each.share * other.across[each.node];
    EXPECT_NEAR(place, own.across[i], 1e-14);
    EXPECT_NEAR(rows[i].slope, 0.1, 1e-14);
  }
}

TEST(ContactPairing, AFaceReachesALittleOverTheOthersEnd) {
  // By less than a tenth of a cell: held whole. By more: its last node meets nothing.
  std::vector<PairRow> rows;
  for (const auto& [over, meets] : {std::pair{0.05, true}, {0.3, false}}) {
    pair_faces(line({0.0, 1.0, 2.0 + over}), line({0.0, 1.0, 2.0}), true, rows);
    EXPECT_EQ(rows[2].area > 0.0, meets);
    EXPECT_GT(rows[1].area, 0.9);
  }
}

}  // namespace
