#include "launchsafe/report/table.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>

namespace launchsafe::report {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Number, IsWrittenWithTheDigitsThatAreAskedFor) {
  for (const auto& [text, expected] : {std::pair{fixed(416.149, 1), "416.1"},
                                       {fixed(7, 0), "7"},
                                       {fixed(-0.04, 1), "0.0"},
                                       {fixed(-0.06, 1), "-0.1"},
                                       {fixed(nan, 1), "n/a"},
                                       {scientific(-0.0, 1), "0.0e+00"},
                                       {scientific(infinity, 1), "inf"},
                                       {significant(-0.0, 3), "0"},
                                       {significant(-infinity, 1), "-inf"},
                                       {significant(1.5e-5, 3), "1.5e-05"},
                                       {significant(496e6, 3), "4.96e+08"},
                                       {significant(0.25, 3), "0.25"},
                                       {significant(184.4, 2), "180"},
                                       {significant(-99.6, 1), "-100"}})
    EXPECT_EQ(text, expected);
}

TEST(Number, ExactReadsBackTheSame) {
  for (const double value : {0.1, 1.0 / 3, 5e-324, 1.7976931348623157e308, -2702.061, 1e22, 123456789.123}) {
    EXPECT_EQ(std::strtod(exact(value).c_str(), nullptr), value) << exact(value);
  }
  EXPECT_EQ(exact(0.1), "0.1");
  EXPECT_EQ(exact(-infinity), "-Infinity");
}

TEST(Number, DurationsReadAsPeopleSayThem) {
  for (const auto& [seconds, expected] : {std::pair{0.25, "0.2 s"},
                                          {9.96, "10 s"},
                                          {59.6, "1 min 00 s"},
                                          {185.0, "3 min 05 s"},
                                          {8040.0, "2 h 14 min"},
                                          {273600.0, "3 d 04 h"},
                                          {nan, "n/a"}})
    EXPECT_EQ(duration(seconds), expected);
}

TEST(Number, WidthCountsCharactersNotBytes) {
  EXPECT_EQ(display_width("abc"), 3U);
  EXPECT_EQ(display_width("\u03c4_ex"), 4U);
  EXPECT_EQ(display_width("e\u0301"), 1U);
  EXPECT_EQ(display_width("\u00b5m\u00b2"), 3U);
}

}  // namespace
}  // namespace launchsafe::report
