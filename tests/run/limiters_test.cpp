#include "launchsafe/run/case_result.hpp"

#include <gtest/gtest.h>

namespace launchsafe::run {
namespace {

TEST(Limiters, EachThatActedIsToldAndAddedUp) {
  LimiterCounts all;
  EXPECT_FALSE(all.acted());
  EXPECT_EQ(to_string(all), "");
  for (const Limiter& each : limiters) {
    LimiterCounts one;
    one.*each.member = 12;
    EXPECT_TRUE(one.acted()) << each.name;
    EXPECT_EQ(to_string(one), std::string(each.words) + " 12");
    all += one;
    all += one;
    EXPECT_EQ(all.*each.member, 24u) << each.name;
  }
}

}  // namespace
}  // namespace launchsafe::run
