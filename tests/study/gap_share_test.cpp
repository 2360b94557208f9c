#include "launchsafe/study/bracket.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace launchsafe::study;

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Random moves of 3 and 4 parts are 5 together; those of knowledge, 1 and 2, are added.
TEST(GapShare, RandomMovesAreCombinedAsRootsAndKnowledgeIsAdded) {
  const GapBounds bounds = bounds_of(100e-6, 110e-6,
                                     {{ShareKind::peak_pressure, 97e-6, 113e-6},
                                      {ShareKind::initial_temperature, 96e-6, 114e-6},
                                      {ShareKind::computation, 99e-6, 111e-6},
                                      {ShareKind::fit, 98e-6, 112e-6}});
  EXPECT_NEAR(bounds.at_least, (100 - 5 - 3) * 1e-6, 1e-12);
  EXPECT_NEAR(bounds.at_most, (110 + 5 + 3) * 1e-6, 1e-12);
}

TEST(GapShare, NoShareMovesABoundTheOtherWay) {
  const GapBounds bounds =
      bounds_of(100e-6, 110e-6, {{ShareKind::fit, 120e-6, 90e-6}, {ShareKind::sliding, no_ignition, 110e-6}});
  EXPECT_EQ(bounds.at_least, 100e-6);
  EXPECT_EQ(bounds.at_most, 110e-6);
}

TEST(GapShare, AnEndThatIgnitesWithoutAGapLeavesNoneAndOneThatIsNotKnownNoBound) {
  EXPECT_EQ(bounds_of(100e-6, 110e-6, {{ShareKind::model_form, 0.0, 110e-6}}).at_least, 0.0);
  const GapBounds unknown = bounds_of(100e-6, 110e-6, {{ShareKind::fit, not_a_number, not_a_number}});
  EXPECT_TRUE(std::isnan(unknown.at_least));
  EXPECT_TRUE(std::isnan(unknown.at_most));
}

TEST(GapShare, TheUpperBoundIsInfiniteWhereAnEndNeverIgnites) {
  EXPECT_EQ(bounds_of(100e-6, 110e-6, {{ShareKind::peak_pressure, 90e-6, no_ignition}}).at_most, no_ignition);
}

TEST(GapShare, EveryKindHasAName) {
  for (std::size_t kind = 0; kind < share_kinds; ++kind)
    EXPECT_FALSE(traits_of(static_cast<ShareKind>(kind)).name.empty()) << kind;
}

}  // namespace
