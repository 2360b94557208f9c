#include "launchsafe/report/table.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

namespace launchsafe::report {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Number, FixedRoundsToDecimals) {
  EXPECT_EQ(fixed(416.149, 1), "416.1");
  EXPECT_EQ(fixed(0.00039, 4), "0.0004");
  EXPECT_EQ(fixed(7, 0), "7");
}

TEST(Number, ZeroHasNoSign) {
  EXPECT_EQ(fixed(-0.04, 1), "0.0");
  EXPECT_EQ(fixed(-0.06, 1), "-0.1");
  EXPECT_EQ(scientific(-0.0, 1), "0.0e+00");
  EXPECT_EQ(significant(-0.0, 3), "0");
}

TEST(Number, WhatIsNoNumberSaysSo) {
  EXPECT_EQ(fixed(nan, 1), "n/a");
  EXPECT_EQ(scientific(infinity, 1), "inf");
  EXPECT_EQ(significant(-infinity, 1), "-inf");
  EXPECT_EQ(exact(nan), "NaN");
  EXPECT_EQ(exact(-infinity), "-Infinity");
}

TEST(Number, SignificantDropsWhatIsNotNeeded) {
  EXPECT_EQ(significant(1.5e-5, 3), "1.5e-05");
  EXPECT_EQ(significant(496e6, 3), "4.96e+08");
  EXPECT_EQ(significant(0.25, 3), "0.25");
  EXPECT_EQ(significant(184.4, 2), "180") << "no power of ten that people write out";
  EXPECT_EQ(significant(-99.6, 1), "-100");
}

TEST(Number, ExactReadsBackTheSame) {
  for (const double value : {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -2702.061, 1e22, 123456789.123}) {
    EXPECT_EQ(std::strtod(exact(value).c_str(), nullptr), value) << exact(value);
  }
  EXPECT_EQ(exact(0.1), "0.1");
}

TEST(Number, DurationsReadAsPeopleSayThem) {
  EXPECT_EQ(duration(0.25), "0.2 s");
  EXPECT_EQ(duration(9.96), "10 s");
  EXPECT_EQ(duration(59.6), "1 min 00 s");
  EXPECT_EQ(duration(185), "3 min 05 s");
  EXPECT_EQ(duration(2 * 3600 + 14 * 60), "2 h 14 min");
  EXPECT_EQ(duration(76 * 3600), "3 d 04 h");
  EXPECT_EQ(duration(nan), "n/a");
}

TEST(Number, WidthCountsCharactersNotBytes) {
  EXPECT_EQ(display_width("abc"), 3U);
  EXPECT_EQ(display_width("\u03c4_ex"), 4U);
  EXPECT_EQ(display_width("e\u0301"), 1U);
  EXPECT_EQ(display_width("\u00b5m\u00b2"), 3U);
}

}  // namespace
}  // namespace launchsafe::report
