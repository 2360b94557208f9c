#include "launchsafe/kinds/sensitivity.hpp"
#include "sensitivity_files.hpp"
#include "study/read_error.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;
using math::Distribution;

const std::string steepness =
    input("key = \"load.steepness\"\ndistribution = \"normal\"\nmean = 1.4\ndeviation = 0.02");
const std::string flaw =
    input("key = \"charge.flaw_size\"\ndistribution = \"log-uniform\"\nrange = \"0.5 mm to 2 mm\"");

/// One line of the study, line 4, before a good input.
void expect_line_error(const std::string& line, const ExpectedError& expected) {
  expect_error_in(sensitivity_start + line + "\n" + crack, expected);
}

// 252 degrees Celsius are 525.15 K, a deviation of 5 degrees Celsius would be one of 278 K.
TEST(ReadSensitivity, ATemperatureMayBeInCelsiusButItsDeviationMayNot) {
  const std::string ignition = "key = \"kinetics.ignition_temperature\"\ndistribution = \"normal\"\n";
  const StudyFile file = study_of(
      sensitivity_start +
      input(ignition + "mean = \"252 \u00b0C\"\nrange = \"250 to 254 \u00b0C\"\ndeviation = \"5 K\""));
  ASSERT_EQ(file.study.axes.size(), 1u);
  EXPECT_EQ(file.study.axes[0].distribution->centre, 525.15);
  EXPECT_EQ(file.study.axes[0].distribution->lower, 523.15);
  EXPECT_EQ(file.study.axes[0].distribution->deviation, 5.0);
  expect_input_error(ignition + "mean = \"252 \u00b0C\"\ndeviation = \"5 \u00b0C\"",
                     {8, "vary.deviation", ""});
}

TEST(ReadSensitivity, ReadsInputs) {
  const StudyFile file = study_of(sensitivity_start + "samples = 8\nseed = 7\nlargest_gap = \"0.2 cm\"\n" +
                                  crack + steepness + flaw);
  const Study& study = file.study;
  EXPECT_EQ(study.kind.name, kinds::traits_of("sensitivity").name);
  EXPECT_EQ(kinds::settings_of<kinds::SensitivitySettings>(study).samples, 8);
  EXPECT_EQ(kinds::settings_of<kinds::SensitivitySettings>(study).seed, 7u);
  EXPECT_EQ(study.largest_gap, 2e-3);
  EXPECT_EQ(study.gaps, std::vector<double>{2e-4});
  ASSERT_EQ(study.axes.size(), 3u);
  EXPECT_EQ(study.axes[0].name, "crack_radius");
  EXPECT_EQ(study.axes[0].key.name, "charge.crack_radius");
  EXPECT_EQ(study.axes[0].distribution->kind, Distribution::Kind::uniform);
  EXPECT_EQ(study.axes[0].distribution->lower, 10e-6);
  EXPECT_EQ(study.axes[0].distribution->upper, 100e-6);
  EXPECT_EQ(study.axes[1].distribution->kind, Distribution::Kind::normal);
  EXPECT_EQ(study.axes[1].distribution->centre, 1.4);
  EXPECT_EQ(study.axes[1].distribution->deviation, 0.02);
  EXPECT_TRUE(std::isinf(study.axes[1].distribution->upper));
  EXPECT_EQ(study.axes[2].distribution->kind, Distribution::Kind::log_uniform);
  EXPECT_EQ(study.axes[2].distribution->lower, 5e-4);
  EXPECT_EQ(file.cases.size(), 8u);
}

TEST(ReadSensitivity, ANormalMayBeCutOff) {
  const StudyFile file = study_of(
      sensitivity_start + input("key = \"initial_temperature\"\ndistribution = \"normal\"\nmean = \"300 K\"\n"
                                "deviation = \"40 K\"\nrange = \"250 to 350 K\""));
  const Distribution& distribution = *file.study.axes.at(0).distribution;
  EXPECT_EQ(distribution.lower, 250.0);
  EXPECT_EQ(distribution.upper, 350.0);
  for (const StudyCase& each : file.cases) {
    EXPECT_GE(each.coordinates.at(0), 250.0);
    EXPECT_LE(each.coordinates.at(0), 350.0);
  }
}

TEST(ReadSensitivity, CasesFollowTheDesign) {
  const StudyFile file = study_of(sensitivity_start + "samples = 8\nseed = 3\n" + crack + steepness + flaw);
  const std::vector<double> points = math::unit_points(8, 3, 3);
  ASSERT_EQ(file.cases.size(), 8u);
  for (std::size_t evaluation = 0; evaluation < file.cases.size(); ++evaluation)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_EQ(file.cases[evaluation].coordinates[i],
                math::quantile(*file.study.axes[i].distribution, points[3 * evaluation + i]));
  EXPECT_EQ(file.cases[3].label, "sample 4");
  expect_scenes_of_coordinates(file);
}

TEST(ReadSensitivity, TheGapIsTheScenesOnlyOne) {
  const std::string without = sensitivity_start.substr(0, sensitivity_start.find("gaps = "));
  expect_error_in(without + crack, {0, "gaps", "6"});
  const StudyFile file = study_of(without + crack + "[set]\ngap.thickness = \"0.03 cm\"\n");
  EXPECT_EQ(file.study.gaps, std::vector<double>{3e-4});
}

TEST(ReadSensitivity, FaultsOfKeysNameFileLineAndKey) {
  expect_line_error("samples = 1", {4, "samples", "1"});
  expect_line_error("samples = 8.5", {4, "samples", "8.5"});
  expect_line_error("reference = [{ gap = \"0 cm\" }]", {4, "reference", ""});
  expect_error_in(sensitivity_start, {1, "vary", ""});
}

TEST(ReadSensitivity, FaultsOfInputsNameFileLineAndKey) {
  const std::string uniform = "distribution = \"uniform\"\n", radius = "key = \"crack_radius\"\n";
  expect_input_error("key = \"flaw_sise\"", {5, "vary.key", "\"flaw_sise\"", "flaw_size", "flaw_size"});
  expect_input_error("key = \"barrel\"", {5, "vary.key", ""});
  expect_input_error("key = \"numerics.particles_per_cell\"", {5, "vary.key", ""});
  expect_input_error("key = \"crack_radius\"", {4, "vary.distribution", ""});
  expect_input_error(radius + "distribution = \"normall\"",
                     {6, "vary.distribution", "normall", "uniform", "normal"});
  expect_input_error(radius + uniform, {4, "vary.range", ""});
  expect_input_error(radius + uniform + "range = \"10 to 100\"", {7, "vary.range", ""});
  expect_input_error(radius + uniform + "range = \"100 to 10 um\"", {7, "vary.range", ""});
  expect_input_error(radius + uniform + "range = \"-1 to 10 um\"", {7, "vary.range", "-1", "0 cm to 100 cm"});
  expect_input_error(radius + uniform + "range = \"1 to 10 um\"\nmean = \"5 um\"", {8, "vary.mean", ""});
  expect_input_error(radius + "distribution = \"log-uniform\"\nrange = \"0 to 10 um\"",
                     {7, "vary.range", ""});
}

TEST(ReadSensitivity, FaultsOfNormalsAskForARange) {
  const std::string normal = "key = \"crack_radius\"\ndistribution = \"normal\"\n";
  expect_input_error(normal, {4, "vary.mean", ""});
  expect_input_error(normal + "mean = \"30 um\"\ndeviation = \"0 um\"", {8, "vary.deviation", "0 um"});
  expect_input_error(normal + "mean = \"30 um\"\ndeviation = \"10 um\"",
                     {8, "vary.deviation", "", "", "range = \"0 cm to 70 µm\""});
  const std::string narrow = normal + "mean = \"30 um\"\ndeviation = \"5 um\"\n";
  EXPECT_TRUE(parse_here(sensitivity_start + input(narrow)));
  expect_input_error(narrow + "range = \"50 to 60 cm\"", {9, "vary.range", ""});
}

TEST(ReadSensitivity, AFitNeedsEightSamplesOrTwoAnInput) {
  expect_error_in(sensitivity_start + "samples = 7\n" + crack, {4, "samples", "7", "8"});
  EXPECT_EQ(study_of(sensitivity_start + "samples = 8\n" + crack).cases.size(), 8u);
}

}  // namespace
