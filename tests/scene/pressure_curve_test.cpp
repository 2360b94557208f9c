#include "launchsafe/scene/load.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace launchsafe::scene {
namespace {

void expect_fault(const std::string& text, int line, std::string_view key) {
  const auto curve = parse_pressure_curve(text, "gun.csv");
  ASSERT_FALSE(curve) << text;
  const InputError& error = curve.error();
  const std::string message = error.message();
  EXPECT_TRUE(message.starts_with("gun.csv:" + std::to_string(line) + ":")) << message;
  EXPECT_EQ(error.key, key) << message;
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

TEST(PressureCurve, ReadsTheHeadersThatPeopleWrite) {
  for (const std::string header :
       {"Time (ms),Pressure (MPa)", "TIME [ms],PRESSURE [MPa]", "t [ms],p [MPa]", "t_ms,p_MPa",
        "t / ms,p / MPa", "time in ms,pressure in MPa", "\"Time (ms)\",\"Pressure (MPa)\"",
        "time since ignition (ms),pressure breech (MPa)", "Time(msec),P(MPa)"}) {
    const auto curve = parse_pressure_curve(header + "\n0,0.1\n5,300\n18,10\n", "gun.csv");
    ASSERT_TRUE(curve) << curve.error().message();
    EXPECT_EQ(curve->time, (std::vector<double>{0.0, 5e-3, 18e-3})) << header;
    EXPECT_EQ(curve->pressure, (std::vector<double>{1e5, 3e8, 1e7})) << header;
  }
  for (const std::string header :
       {"temperature (ms),pressure (MPa)", "time (ms),time (ms)", "pressure (MPa),pressure (MPa)",
        "time (ms),pressure2 (MPa)", "time (ms),pressure (MPa),strain", "tp (ms),p (MPa)"})
    EXPECT_FALSE(parse_pressure_curve(header + "\n0,0.1\n5,300\n", "gun.csv")) << header;
}

TEST(PressureCurve, ReadsTheFilesThatProgramsWrite) {
  const std::vector<std::string> lines{"time_ms,pressure_MPa", "0,0.1", "5,300", "18,10"};
  const auto joined = [&](const std::string& end) {
    std::string text;
    for (const std::string& line : lines) text += line + end;
    return text;
  };
  const std::string quoted = "\"time_ms\",\"pressure_MPa\"\r\n\"0\",\"0.1\"\r\n\"5\", \"300\" \r\n18,10";
  for (const std::string& text :
       {"\xEF\xBB\xBF" + joined("\n"), joined("\r\n"), joined("\r"), joined("\n\n"), joined(" \n"), quoted,
        std::string("Time (ms);Pressure (MPa)\n0;0,1\n5,0;300\n18;10,0\n"),
        std::string("Time (ms);Pressure (MPa)\n0;0.1\n5.0;300\n18;10\n"),
        std::string("time_ms\tpressure_MPa\n0\t0,1\n5\t300\n18\t10\n")}) {
    const auto curve = parse_pressure_curve(text, "gun.csv");
    ASSERT_TRUE(curve) << curve.error().message() << "\n" << text;
    EXPECT_EQ(curve->time, (std::vector<double>{0.0, 5e-3, 18e-3})) << text;
    EXPECT_EQ(curve->pressure, (std::vector<double>{1e5, 3e8, 1e7})) << text;
  }
}

// psi, ksi and atm by their definitions.
TEST(PressureCurve, ReadsTheUnitsThatGaugesHave) {
  const auto peak = [](const std::string& unit, const std::string& value) {
    const auto curve = parse_pressure_curve("t [ms],p [" + unit + "]\n0,0\n5," + value + "\n", "gun.csv");
    EXPECT_TRUE(curve) << curve.error().message();
    return curve ? curve->pressure.back() : 0.0;
  };
  EXPECT_NEAR(peak("psi", "72000"), 496.4225251e6, 1.0);
  EXPECT_NEAR(peak("ksi", "72"), 496.4225251e6, 1.0);
  EXPECT_EQ(peak("atm", "4000"), 405.3e6);
  EXPECT_EQ(peak("bar", "4960"), 496e6);
  EXPECT_EQ(peak("kbar", "4.96"), 496e6);
}

TEST(PressureCurve, ACommaIsNeverReadAsSomethingElse) {
  // Decimal commas between commas: too many values, and the message says why.
  expect_fault("time_ms,pressure_MPa\n0,5,12,3\n1,5,13,3\n", 2, "");
  expect_fault("time_ms,pressure_MPa\n0,5,12\n1,5,13\n", 2, "");
  // Another separator than the header's.
  expect_fault("time_ms;pressure_MPa\n0,5\n1,6\n", 2, "");
  // Points and commas in one file: one of them divides thousands.
  expect_fault("time_ms;pressure_MPa\n0,5;1.000\n1,5;2.000\n", 2, "pressure");
  expect_fault("time_ms;pressure_MPa\n0.5;1\n1.5;2,5\n", 3, "pressure");
  expect_fault("time_ms;pressure_Pa\n0;1.000,5\n1;2\n", 2, "pressure");
  // Nothing shows whether these are thousands.
  expect_fault("time_ms\tpressure_kPa\n0\t100\n1\t1,250\n2\t12,500\n", 3, "pressure");
  expect_fault("time_ms;pressure_Pa\n0;1,000,000\n1;2\n", 2, "pressure");
  // These show it.
  for (const char* rows : {"0;100\n1;1,250\n2;12,5\n", "0,000;1,250\n1,000;2,250\n", "0;1,2500\n1;2,250\n"})
    EXPECT_TRUE(parse_pressure_curve(std::string("time_ms;pressure_kPa\n") + rows, "gun.csv")) << rows;
}

TEST(PressureCurve, OtherEncodingsAreAnError) {
  const std::string text = "time_ms,pressure_MPa\n0,0.1\n5,300\n";
  std::string wide;
  for (const char letter : text) wide += std::string{letter, '\0'};
  expect_fault("\xFF\xFE" + wide, 1, "");
  expect_fault(wide, 1, "");
  expect_fault("# Druckmesser \xE4\n" + text, 1, "");
  expect_fault("time_ms,pressure_MPa\n0,0.1\n5,300" + std::string(3, '\0'), 3, "");
}

// Between points so near to each other a slope would overflow.
TEST(PressureCurve, PointsThatAreTooNearAreRefused) {
  expect_fault("time_s,pressure_MPa\n0,0\n1e-13,5\n", 3, "time");
  expect_fault("time_s,pressure_MPa\n0,0\n1e-320,5\n", 3, "time");
}

TEST(PressureCurve, APeakThatRisesInSecondsIsRefusedAtItsHeader) {
  const std::string points = "-2,0.4\n0,0.4\n1.5,12\n4,300\n9,40\n20,0.4\n";
  EXPECT_TRUE(parse_pressure_curve("time_ms,pressure_MPa\n" + points, "curve.csv"));
  const std::string in_seconds = "# a gauge\ntime_s,pressure_MPa\n" + points;
  for (const auto& read :
       {parse_pressure_curve(in_seconds, "curve.csv"), parse_gauge_record(in_seconds, "curve.csv", "")}) {
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().line, 2);
    EXPECT_EQ(read.error().key, "time");
    EXPECT_NE(read.error().found.find(" 2.5 s"), std::string::npos) << read.error().found;
  }
}

TEST(PressureCurve, OnePointIsRefused) {
  expect_fault("time_ms,pressure_MPa\n0,0.1\n", 2, "time");
  expect_fault("time_ms,pressure_MPa\n", 1, "time");
}

TEST(PressureCurve, UnorderedTimesAreRefused) {
  expect_fault("time_ms,pressure_MPa\n0,0.1\n5,3\n4,3\n", 4, "time");
  expect_fault("time_ms,pressure_MPa\n0,0.1\n5,3\n5,4\n", 4, "time");
}

TEST(PressureCurve, WhatIsNoFiniteNumberIsRefused) {
  expect_fault("time_ms,pressure_MPa\n0,0.1\n5,nan\n", 3, "pressure");
  expect_fault("time_ms,pressure_MPa\n0,0.1\ninf,3\n", 3, "time");
  expect_fault("time_ms,pressure_MPa\n0,0.1\n5,\n", 3, "pressure");
  expect_fault("time_ms,pressure_MPa\n0,0.1\n5 s,3\n", 3, "time");
  expect_fault("time_ms,pressure_MPa\n0,-0.1\n5,3\n", 2, "pressure");
  expect_fault("time_ms,pressure_MPa\n0,1,2\n5,3\n", 2, "");
}

TEST(PressureCurve, UnknownUnitsAreRefused) {
  expect_fault("time_ms,pressure_torr\n0,1\n1,2\n", 1, "pressure");
  expect_fault("time_ms,pressure (bar(g))\n0,1\n1,2\n", 1, "pressure");
  expect_fault("time_ms,pressure (MPa) x 10\n0,1\n1,2\n", 1, "pressure");
  expect_fault("time_ms,p [K]\n0,1\n1,2\n", 1, "pressure");
  expect_fault("time_min,pressure_MPa\n0,1\n1,2\n", 1, "time");
  expect_fault("time,pressure\n0,1\n1,2\n", 1, "time");
}

TEST(PressureCurve, MissingHeaderIsRefused) {
  expect_fault("0,0.1\n5,300\n", 1, "");
  expect_fault("", 1, "");
}

}  // namespace
}  // namespace launchsafe::scene
