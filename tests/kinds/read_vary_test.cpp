#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/study/case_rows.hpp"
#include "study/read_error.hpp"

#include <fstream>
#include <string>
#include <vector>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

/// One [[vary]] after two lines, its key at line 4.
std::string varied(const std::string& key, const std::string& rest) {
  return critical_kind + "[[vary]]\nkey = \"" + key + "\"\n" + rest + "\n";
}

void expect_key_error(const std::string& key, const ExpectedError& expected) {
  expect_error_in(varied(key, "values = \"1 mm\""), expected);
}

/// Of the values at line 5.
void expect_values_error(const std::string& key, const std::string& values, const ExpectedError& expected) {
  expect_error_in(varied(key, "values = " + values), expected);
}

std::string numbers(int count, double first, double step) {
  std::string text;
  for (int i = 0; i < count; ++i)
    text += (i > 0 ? ", " : "") + std::to_string(first + step * static_cast<double>(i));
  return text;
}

TEST(ReadVary, MakesTheProductOfTheAxesInTheOrderWritten) {
  const StudyFile study = study_of(critical_kind + "gaps = \"0, 0.02 cm\"\n" +
                                   vary({{"load.peak", "400, 496 MPa"},
                                         {"flaw_size", "[\"1 mm\", \"2 mm\"]"},
                                         {"charge.sliding_friction", "[0.5, 0.4, 0.3]"},
                                         {"crack_radius", "30 um"}}));
  EXPECT_EQ(study.study.gaps, (std::vector<double>{0.0, 2e-4}));
  ASSERT_EQ(study.study.axes.size(), 4u);
  const char* names[] = {"peak_pressure", "flaw_size", "charge.sliding_friction", "crack_radius"};
  const char* keys[] = {"load.peak", "charge.flaw_size", "charge.sliding_friction", "charge.crack_radius"};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(study.study.axes[i].name, names[i]);
    EXPECT_EQ(study.study.axes[i].key.name, keys[i]);
  }
  EXPECT_EQ(study.study.axes[2].values, (std::vector<double>{0.5, 0.4, 0.3}));
  ASSERT_EQ(study.cases.size(), 12u);
  const StudyCase& second = study.cases[1];
  EXPECT_EQ(second.label,
            "peak_pressure 400 MPa, flaw_size 0.1 cm, charge.sliding_friction 0.4, crack_radius 30 µm");
  EXPECT_EQ(second.coordinates, (std::vector<double>{400e6, 1e-3, 0.4, 30e-6}));
  EXPECT_EQ(second.peak_pressure, 400e6);
  EXPECT_EQ(second.strength().flaw_size, 1e-3);
  EXPECT_EQ(second.strength().initial_crack_radius, 30e-6);
  EXPECT_EQ(second.cell_size(), study.scene.scene.numerics.cell_size);
  const scene::Scene& last = study.cases.back().scene.scene;
  EXPECT_EQ(last.load.peak, 496e6);
  EXPECT_EQ(last.charge().strength.flaw_size, 2e-3);
  EXPECT_EQ(last.charge().sliding_friction, 0.3);
}

TEST(ReadVary, WithoutItIsTheSceneAlone) {
  const StudyFile study = study_of(critical_kind);
  EXPECT_EQ(study.study.gaps, study.scene.scene.surface.gaps);
  ASSERT_EQ(study.cases.size(), 1u);
  EXPECT_EQ(study.cases[0].label, "496 MPa, 30 µm, 1 mm");
  EXPECT_TRUE(study.cases[0].own_conditions);
  EXPECT_TRUE(study.cases[0].coordinates.empty());
}

// Few cases are confirmed and shown in detail; many are a sweep unless they ask for it.
TEST(ReadVary, ManyCasesAreNotConfirmedUnlessTheyAskForIt) {
  const std::string six = vary({{"peak_pressure", "400, 420, 440, 460, 480, 496 MPa"}});
  const std::string seven = vary({{"peak_pressure", "400, 420, 440, 460, 480, 496, 500 MPa"}});
  const auto confirmed = [](const std::string& text) {
    return study_of(critical_kind + text).confirmations_per_case;
  };
  EXPECT_EQ(confirmed(six), 2u);
  EXPECT_EQ(confirmed("confirm = false\n" + six), 0u);
  EXPECT_TRUE(study_of(critical_kind + "confirm = false\n" + six).study.in_detail);
  EXPECT_EQ(confirmed(seven), 0u);
  EXPECT_FALSE(study_of(critical_kind + seven).study.in_detail);
  EXPECT_EQ(confirmed("confirm = true\n" + seven), 2u);
  EXPECT_TRUE(study_of(critical_kind + "confirm = true\n" + seven).study.in_detail);
}

TEST(ReadVary, OnlyAnotherLaunchIsNotTheReferences) {
  const auto own = [](const std::string& key, const std::string& value) {
    return study_of(critical_kind + vary({{key, value}})).cases[0].own_conditions;
  };
  EXPECT_TRUE(own("numerics.cell_size", "5 mm"));
  EXPECT_TRUE(own("charge.density", "1717 kg/m3"));
  EXPECT_FALSE(own("charge.density", "1700 kg/m3"));
  EXPECT_FALSE(own("initial_temperature", "310 K"));
}

TEST(ReadVary, FaultsNameFileLineAndKey) {
  expect_error_in(critical_kind + "vary = 3\n", {3, "vary", "3"});
  expect_error_in(critical_kind + "[[vary]]\nvalues = \"1 mm\"\n", {3, "vary.key", ""});
  expect_key_error("gap.thickness", {4, "vary.key", ""});
  expect_key_error("peak_presure", {4, "vary.key", "", "load.steepness", "peak_pressure"});
  expect_key_error("body.nose.x", {4, "vary.key", ""});
  expect_error_in(varied("peak_pressure", ""), {3, "vary.values", ""});
  expect_error_in(varied("peak_pressure", "valus = \"1 MPa\""), {5, "vary.valus", "", "", "values"});
  expect_values_error("peak_pressure", "\"400, 400 MPa\"", {5, "vary.values", ""});
  expect_values_error("peak_pressure", "[400]", {5, "vary.values", "", "MPa"});
  expect_values_error("peak_pressure", "\"-1 MPa\"", {5, "vary.values", "-1 MPa", "0 MPa"});
  expect_values_error("peak_pressure", "[]", {5, "vary.values", ""});
  expect_values_error("numerics.particles_per_cell", "[1, 1.5]", {5, "vary.values", "1.5"});
  const std::string twice = varied("peak_pressure", "values = \"400 MPa\"");
  expect_error_in(twice + "[[vary]]\nkey = \"load.peak\"\nvalues = \"500 MPa\"\n",
                  {7, "vary.key", "peak_pressure"});
  expect_error_in(varied("crack_radius", "values = \"30 um\"\n[set]\ncharge.crack_radius = \"20 um\""),
                  {4, "vary.key", "[set]"});
}

TEST(ReadVary, AValueThatTheSceneCannotHaveNamesTheValues) {
  expect_values_error("load.base", "\"1, 900 MPa\"", {5, "vary.values", "900 MPa"});
  expect_values_error("numerics.cell_size", "\"50 cm\"", {5, "vary.values", "body.charge.r"});
}

// Distributions are of sensitivity.
TEST(ReadVary, WhatAKindCannotMakeUseOfIsRefused) {
  expect_error_in(varied("crack_radius", "distribution = \"uniform\"\nrange = \"10 to 20 um\""),
                  {5, "vary.distribution", "critical-gap"});
  expect_error_in("kind = \"sensitivity\"\nscene = \"scene_155mm.toml\"\ngaps = \"0 cm\"\n" +
                      vary({{"crack_radius", "10, 20 um"}}),
                  {4, "vary.values", "sensitivity"});
  expect_error_in(
      "kind = \"calibration\"\nscene = \"scene_155mm.toml\"\n" + vary({{"crack_radius", "10 um"}}),
      {3, "vary", "\"critical-gap\""});
}

TEST(ReadVary, TheAnalyticLoadDoesNotVaryUnderAMeasuredCurve) {
  const std::string file = ::testing::TempDir() + "read_vary_curve.csv";
  std::ofstream(file) << "time_ms,pressure_MPa\n0,0\n5,400\n18,0\n";
  const std::string curve = "[set]\nload.curve = \"" + file + "\"\nload.expected_velocity = \"1063 m/s\"\n";
  const std::string peak = varied("peak_pressure", "values = \"300 MPa\"\n" + curve);
  expect_error_in(peak, {4, "vary.key", "load.peak"});
  expect_error_in(varied("load.steepness", "values = [10]\n" + curve), {4, "vary.key", ""});
  const std::string scaled = "values = \"300 MPa\"\n[set]\nload.curve = \"" + file +
                             "\"\nload.rescale_to_peak = true\nload.expected_velocity = \"1318 m/s\"\n";
  const StudyFile study = study_of(varied("peak_pressure", scaled));
  EXPECT_EQ(study.cases[0].peak_pressure, 300e6);
  EXPECT_TRUE(study_of(critical_kind + curve).cases[0].own_conditions);
}

TEST(ReadVary, ThereIsAMostOfCases) {
  expect_error_in(critical_kind + vary({{"charge.sliding_friction", "[" + numbers(101, 0.1, 0.01) + "]"},
                                        {"charge.face_friction", "[" + numbers(101, 0.0, 0.01) + "]"},
                                        {"steel.gruneisen", "[" + numbers(101, 1.0, 0.01) + "]"}}),
                  {3, "vary.key", "1030301", "1000000"});
}

}  // namespace
