#include "launchsafe/scene/pressure_curve.hpp"

#include <gtest/gtest.h>

namespace launchsafe::scene {
namespace {

void expect_fault(const std::string& text, int line, std::string_view key, std::string_view found,
                  std::string_view allowed) {
  const auto curve = parse_pressure_curve(text, "gun.csv");
  ASSERT_FALSE(curve) << text;
  const InputError& error = curve.error();
  const std::string message = error.message();
  EXPECT_TRUE(message.starts_with("gun.csv:" + std::to_string(line) + ":")) << message;
  EXPECT_EQ(error.key, key) << message;
  EXPECT_NE(error.found.find(found), std::string::npos) << message;
  EXPECT_NE(error.allowed.find(allowed), std::string::npos) << message;
}

TEST(PressureCurve, ReadsItsUnitsFromTheHeader) {
  for (const char* text : {"time_ms,pressure_MPa\n0,0.1\n5,300\n18,10\n",
                           "# gauge 3\n\ntime (ms), pressure (MPa)\r\n0, 0.1\r\n5, 3e2\r\n18, 10\r\n",
                           "pressure [MPa];time [ms]\n0.1;0\n300;5\n10;18\n"}) {
    const auto curve = parse_pressure_curve(text, "gun.csv");
    ASSERT_TRUE(curve) << curve.error().message();
    EXPECT_EQ(curve->time, (std::vector<double>{0.0, 5e-3, 18e-3}));
    EXPECT_EQ(curve->pressure, (std::vector<double>{1e5, 3e8, 1e7}));
  }
}

TEST(PressureCurve, OnePointIsRefused) {
  expect_fault("time_ms,pressure_MPa\n0,0.1\n", 2, "time", "1 point", "at least two points");
  expect_fault("time_ms,pressure_MPa\n", 1, "time", "0 points", "at least two points");
}

TEST(PressureCurve, UnorderedTimesAreRefused) {
  expect_fault("time_ms,pressure_MPa\n0,0.1\n5,3\n4,3\n", 4, "time", "4 ms", "later than 5 ms");
  expect_fault("time_ms,pressure_MPa\n0,0.1\n5,3\n5,4\n", 4, "time", "5 ms", "increasing");
}

TEST(PressureCurve, WhatIsNoFiniteNumberIsRefused) {
  expect_fault("time_ms,pressure_MPa\n0,0.1\n5,nan\n", 3, "pressure", "\"nan\"", "a finite number of MPa");
  expect_fault("time_ms,pressure_MPa\n0,0.1\ninf,3\n", 3, "time", "\"inf\"", "a finite number of ms");
  expect_fault("time_ms,pressure_MPa\n0,0.1\n5,\n", 3, "pressure", "\"\"", "a finite number of MPa");
  expect_fault("time_ms,pressure_MPa\n0,0.1\n5 s,3\n", 3, "time", "\"5 s\"", "a finite number of ms");
  expect_fault("time_ms,pressure_MPa\n0,-0.1\n5,3\n", 2, "pressure", "-0.1 MPa", "at least 0");
  expect_fault("time_ms,pressure_MPa\n0,1,2\n5,3\n", 2, "", "3 values", "two values");
}

TEST(PressureCurve, UnknownUnitsAreRefused) {
  expect_fault("time_ms,pressure_psi\n0,1\n1,2\n", 1, "pressure", "unknown unit \"psi\"", "MPa");
  expect_fault("time_min,pressure_MPa\n0,1\n1,2\n", 1, "time", "unknown unit \"min\"", "ms");
  expect_fault("time,pressure\n0,1\n1,2\n", 1, "time", "without a unit", "ms");
}

TEST(PressureCurve, MissingHeaderIsRefused) {
  expect_fault("0,0.1\n5,300\n", 1, "", "0,0.1", "a header");
  expect_fault("", 1, "", "no header", "a header");
}

}  // namespace
}  // namespace launchsafe::scene
