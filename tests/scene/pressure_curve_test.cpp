#include "launchsafe/scene/load.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace launchsafe::scene {
namespace {

/// Three points in any layout.
void expect_pulse(const std::string& text) {
  const auto curve = parse_pressure_curve(text, "gun.csv");
  EXPECT_EQ(curve.time, (std::vector<double>{0.0, 5e-3, 18e-3})) << text;
  EXPECT_EQ(curve.pressure, (std::vector<double>{1e5, 3e8, 1e7})) << text;
}

TEST(PressureCurve, ReadsTheHeadersThatPeopleWrite) {
  for (const std::string header :
       {"time_ms,pressure_MPa", "Time (ms),Pressure (MPa)", "TIME [ms],PRESSURE [MPa]", "t [ms],p [MPa]",
        "t_ms,p_MPa", "t / ms,p / MPa", "time in ms,pressure in MPa", "\"Time (ms)\",\"Pressure (MPa)\"",
        "time since ignition (ms),pressure breech (MPa)"})
    expect_pulse(header + "\n0,0.1\n5,300\n18,10\n");
  expect_pulse("pressure [MPa];time [ms]\n0.1;0\n300;5\n10;18\n");
}

TEST(PressureCurve, ReadsTheFilesThatProgramsWrite) {
  for (const std::string text : {"\xEF\xBB\xBFtime_ms,pressure_MPa\n0,0.1\n5,300\n18,10\n",
                                 "# gauge 3\n\ntime (ms), pressure (MPa)\r\n0, 0.1\r\n5, 3e2\r\n18, 10\r\n",
                                 "\"time_ms\",\"pressure_MPa\"\r\n\"0\",\"0.1\"\r\n\"5\", \"300\" \r\n18,10",
                                 "Time (ms);Pressure (MPa)\n0;0,1\n5,0;300\n18;10,0\n",
                                 "Time (ms);Pressure (MPa)\n0;0.1\n5.0;300\n18;10\n",
                                 "time_ms\tpressure_MPa\n0\t0,1\n5\t300\n18\t10\n"})
    expect_pulse(text);
}

// psi, ksi and atm by their definitions.
TEST(PressureCurve, ReadsTheUnitsThatGaugesHave) {
  const auto peak = [](const std::string& unit, const std::string& value) {
    return parse_pressure_curve("t [ms],p [" + unit + "]\n0,0\n5," + value + "\n", "gun.csv").pressure.back();
  };
  EXPECT_NEAR(peak("psi", "72000"), 496.4225251e6, 1.0);
  EXPECT_NEAR(peak("ksi", "72"), 496.4225251e6, 1.0);
  EXPECT_EQ(peak("atm", "4000"), 405.3e6);
  EXPECT_EQ(peak("bar", "4960"), 496e6);
  EXPECT_EQ(peak("kbar", "4.96"), 496e6);
}

struct CurveFault {
  const char* text;
  int line;
  const char* key;
};

TEST(PressureCurve, FaultsNameTheirLineAndQuantity) {
  for (const auto& [text, line, key] : std::vector<CurveFault>{
           // Decimal commas between commas, another separator than the header's, two decimal marks.
           {"time_ms,pressure_MPa\n0,5,12,3\n1,5,13,3\n", 2, ""},
           {"time_ms,pressure_MPa\n0,5,12\n1,5,13\n", 2, ""},
           {"time_ms;pressure_MPa\n0,5\n1,6\n", 2, ""},
           {"time_ms;pressure_MPa\n0,5;1.000\n1,5;2.000\n", 2, "pressure"},
           {"time_ms;pressure_MPa\n0.5;1\n1.5;2,5\n", 3, "pressure"},
           {"time_ms;pressure_Pa\n0;1.000,5\n1;2\n", 2, "pressure"},
           {"time_ms;pressure_Pa\n0;1,000,000\n1;2\n", 2, "pressure"},
           // Between points so near to each other a slope would overflow.
           {"time_s,pressure_MPa\n0,0\n1e-13,5\n", 3, "time"},
           {"time_s,pressure_MPa\n0,0\n1e-320,5\n", 3, "time"},
           {"time_ms,pressure_MPa\n0,0.1\n5,3\n4,3\n", 4, "time"},
           {"time_ms,pressure_MPa\n0,0.1\n5,3\n5,4\n", 4, "time"},
           {"time_ms,pressure_MPa\n0,0.1\n", 2, "time"},
           {"time_ms,pressure_MPa\n", 1, "time"},
           {"time_ms,pressure_MPa\n0,0.1\n5,nan\n", 3, "pressure"},
           {"time_ms,pressure_MPa\n0,0.1\ninf,3\n", 3, "time"},
           {"time_ms,pressure_MPa\n0,0.1\n5,\n", 3, "pressure"},
           {"time_ms,pressure_MPa\n0,0.1\n5 s,3\n", 3, "time"},
           {"time_ms,pressure_MPa\n0,-0.1\n5,3\n", 2, "pressure"},
           {"time_ms,pressure_GPa\n0,0\n1,10.1\n", 3, "pressure"},
           {"time_ms,pressure_torr\n0,1\n1,2\n", 1, "pressure"},
           {"time_ms,pressure (bar(g))\n0,1\n1,2\n", 1, "pressure"},
           {"time_ms,pressure (MPa) x 10\n0,1\n1,2\n", 1, "pressure"},
           {"time_ms,p [K]\n0,1\n1,2\n", 1, "pressure"},
           {"time_min,pressure_MPa\n0,1\n1,2\n", 1, "time"},
           {"time,pressure\n0,1\n1,2\n", 1, "time"},
           {"time (ms),time (ms)\n0,1\n1,2\n", 1, "time"},
           {"time (ms),pressure (MPa),strain\n0,1,2\n", 1, ""},
           {"# a gauge\ntime_s,pressure_MPa\n0,0.4\n1.5,12\n4,300\n9,40\n", 2, "time"},  // a rise of 2.5 s
           {"0,0.1\n5,300\n", 1, "time"},
           {"", 1, ""}}) {
    const auto curve = caught([&, &csv = text] { return parse_pressure_curve(csv, "gun.csv"); });
    ASSERT_FALSE(curve) << text;
    EXPECT_EQ(curve.error().file, "gun.csv");
    EXPECT_EQ(curve.error().line, line) << curve.error().message();
    EXPECT_EQ(curve.error().key, key) << curve.error().message();
  }
}

TEST(PressureCurve, OtherEncodingsAreAnError) {
  const std::string text = "time_ms,pressure_MPa\n0,0.1\n5,300\n";
  std::string wide;
  for (const char letter : text) wide += std::string{letter, '\0'};
  for (const std::string& other :
       {"\xFF\xFE" + wide, wide, "# Druckmesser \xE4\n" + text, text + std::string(3, '\0')})
    EXPECT_FALSE(caught([&] { return parse_pressure_curve(other, "gun.csv"); })) << other;
}

}  // namespace
}  // namespace launchsafe::scene
