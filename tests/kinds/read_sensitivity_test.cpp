#include "launchsafe/kinds/sensitivity.hpp"
#include "launchsafe/math/sensitivity.hpp"
#include "launchsafe/study/calibration_record.hpp"
#include "launchsafe/study/case_answer.hpp"
#include "sensitivity_files.hpp"
#include "study/read_error.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
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
                     {8, "vary.deviation", "which is a temperature", "a temperature difference"});
}

TEST(ReadSensitivity, ReadsInputsAndMethod) {
  const StudyFile file = study_of(sensitivity_start +
                                  "method = \"sobol\"\ndesign = \"latin-hypercube\"\nsamples = 8\nseed = 7\n"
                                  "resamples = 500\nconfidence = 0.9\ntolerance = \"2 um\"\n" +
                                  crack + steepness + flaw);
  const Study& study = file.study;
  EXPECT_EQ(study.kind.name, kinds::traits_of("sensitivity").name);
  EXPECT_EQ(kinds::settings_of<kinds::SensitivitySettings>(study).design, math::Design::latin_hypercube);
  EXPECT_EQ(kinds::settings_of<kinds::SensitivitySettings>(study).samples, 8);
  EXPECT_EQ(kinds::settings_of<kinds::SensitivitySettings>(study).seed, 7u);
  EXPECT_EQ(kinds::settings_of<kinds::SensitivitySettings>(study).resamples, 500);
  EXPECT_EQ(kinds::settings_of<kinds::SensitivitySettings>(study).confidence, 0.9);
  EXPECT_EQ(study.tolerance, 2e-6);
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
  EXPECT_EQ(file.cases.size(), 8u * 5u);
}

TEST(ReadSensitivity, HasDefaults) {
  const StudyFile file = study_of(sensitivity_start + crack);
  EXPECT_EQ(kinds::settings_of<kinds::SensitivitySettings>(file.study).design, SensitivitySettings{}.design);
  EXPECT_EQ(file.cases.size(), 64u * 3u);
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

TEST(ReadSensitivity, SobolCasesFollowTheDesign) {
  const StudyFile file = study_of(
      sensitivity_start + "design = \"scrambled-sobol\"\nsamples = 4\nseed = 3\n" + crack + steepness + flaw);
  const auto design = math::saltelli_design(math::Design::scrambled_sobol, 4, {1, 1, 1}, 3);
  ASSERT_EQ(file.cases.size(), design.evaluations());
  for (std::size_t evaluation = 0; evaluation < file.cases.size(); ++evaluation) {
    const auto point = design.point(evaluation);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(file.cases[evaluation].coordinates[i],
                math::quantile(*file.study.axes[i].distribution, point[i]));
    }
  }
  const auto at = [&](std::size_t block, std::size_t row) { return row * design.blocks() + block; };
  EXPECT_EQ(file.cases[at(design.block_a, 0)].label, "sample 1 of A");
  EXPECT_EQ(file.cases[at(design.block_b, 1)].label, "sample 2 of B");
  EXPECT_EQ(file.cases[at(design.block_ab(1), 3)].label, "sample 4 of AB(load.steepness)");
  expect_scenes_of_coordinates(file);
}

TEST(ReadSensitivity, TheGapIsTheScenesOnlyOne) {
  const std::string without = sensitivity_start.substr(0, sensitivity_start.find("gaps = "));
  expect_error_in(without + crack, {0, "gaps", "6 gaps", "one gap", "gaps = \""});
  const StudyFile file = study_of(without + crack + "[set]\ngap.thickness = \"0.03 cm\"\n");
  EXPECT_EQ(file.study.gaps, std::vector<double>{3e-4});
}

TEST(ReadSensitivity, UncertainNumericsHaveNoStatedUncertainty) {
  const std::string uncertainty = "numerical_uncertainty = { value = \"1 K\", because = \"for a test\" }\n";
  EXPECT_FALSE(numerical_uncertainty_of(study_of(sensitivity_start + uncertainty + crack)).assumed);
  const std::string cells =
      input("key = \"numerics.cell_size\"\ndistribution = \"uniform\"\nrange = \"2 to 3 mm\"");
  EXPECT_TRUE(numerical_uncertainty_of(study_of(sensitivity_start + uncertainty + cells)).assumed);
}

TEST(ReadSensitivity, FaultsOfKeysNameFileLineKeyFoundAndAllowed) {
  expect_line_error("method = \"sobl\"", {4, "method", "\"sobl\"", "\"sobol\"", "sobol"});
  expect_line_error("design = \"sobol\"", {4, "design", "\"sobol\"", "latin-hypercube"});
  expect_line_error("samples = 1", {4, "samples", "1", "2 to 1e+06"});
  expect_line_error("samples = 8.5", {4, "samples", "8.5"});
  expect_line_error("samples = 400000", {4, "samples", "1200000 mechanical runs", "at most 1000000"});
  expect_line_error("seed = -1", {4, "seed", "-1"});
  expect_line_error("resamples = 0", {4, "resamples", "0"});
  expect_line_error("confidence = 0.4", {4, "confidence", "0.4", "0.5 to 0.999"});
  expect_line_error("confidence = 1", {4, "confidence", "1"});
  expect_line_error("reference = [{ gap = \"0 cm\" }]", {4, "reference", "\"critical-gap\"", "sensitivity"});
  expect_error_in(sensitivity_start + "gaps = \"0 cm\"\n" + crack, {4, "", "not TOML"});
}

TEST(ReadSensitivity, ThereIsAnInput) {
  expect_error_in(sensitivity_start, {1, "vary", "no vary", "[[vary]]"});
  expect_error_in(sensitivity_start + "vary = []\n", {4, "vary", "no vary", "[[vary]]"});
  expect_error_in(sensitivity_start + "vary = 3\n", {4, "vary", "3", "[[vary]]"});
  expect_error_in(sensitivity_start + "[vary]\nkey = \"crack_radius\"\n", {4, "vary", "a table", "[[vary]]"});
}

TEST(ReadSensitivity, FaultsOfInputsNameFileLineKeyFoundAndAllowed) {
  const std::string uniform = "distribution = \"uniform\"\n";
  expect_input_error(uniform, {4, "vary.key", "missing"});
  expect_input_error("key = 3", {5, "vary.key", "3", "a text"});
  expect_input_error("key = \"flaw_sise\"", {5, "vary.key", "\"flaw_sise\"", "flaw_size", "flaw_size"});
  expect_input_error("key = \"load.stepness\"", {5, "vary.key", "unknown", "[load]", "load.steepness"});
  expect_input_error("key = \"symmetry\"", {5, "vary.key", "takes a word", "takes one number"});
  expect_input_error("key = \"gap\"", {5, "vary.key", "all cases share", "the study's key gaps"});
  expect_input_error("key = \"numerics.particles_per_cell\"", {5, "vary.key", "a whole number"});
  expect_input_error("key = \"crack_radius\"", {4, "vary.distribution", "needs it", "log-uniform"});
  const std::string radius = "key = \"crack_radius\"\n";
  expect_input_error(radius + "distribution = \"normall\"",
                     {6, "vary.distribution", "normall", "uniform", "normal"});
  expect_input_error(radius + uniform, {4, "vary.range", "a uniform distribution needs it", "range"});
  expect_input_error(radius + uniform + "range = \"10 to 100 MPa\"", {7, "vary.range", "a pressure"});
  expect_input_error(radius + uniform + "range = \"10 to 100\"", {7, "vary.range", "without a unit"});
  expect_input_error(radius + uniform + "range = \"100 to 10 um\"", {7, "vary.range", "no extent"});
  expect_input_error(radius + uniform + "range = \"-1 to 10 um\"", {7, "vary.range", "-1", "0 cm to 100 cm"});
  expect_input_error(radius + uniform + "rang = \"1 to 10 um\"", {7, "vary.rang", "unknown", "", "range"});
  expect_input_error(radius + uniform + "range = \"1 to 10 um\"\nmean = \"5 um\"",
                     {8, "vary.mean", "distribution \"normal\"", "range alone"});
  expect_input_error(radius + "distribution = \"log-uniform\"\nrange = \"0 to 10 um\"",
                     {7, "vary.range", "no logarithm", "above 0"});
  expect_error_in(sensitivity_start + crack +
                      input("key = \"charge.crack_radius\"\n" + uniform + "range = \"1 to 2 um\""),
                  {9, "vary.key", "second time, after crack_radius", "once"});
  expect_error_in(sensitivity_start + crack + "[set]\ncharge.crack_radius = \"1 um\"\n",
                  {5, "vary.key", "[set]", "either"});
}

TEST(ReadSensitivity, FaultsOfNormalsAskForARange) {
  const std::string normal = "key = \"crack_radius\"\ndistribution = \"normal\"\n";
  expect_input_error(normal, {4, "vary.mean", "a normal distribution needs it"});
  expect_input_error(normal + "mean = \"30 um\"", {4, "vary.deviation", "a normal distribution needs it"});
  expect_input_error(normal + "mean = \"30 um\"\ndeviation = \"0 um\"", {8, "vary.deviation", "0 um"});
  expect_input_error(normal + "mean = \"30 um\"\ndeviation = 3", {8, "vary.deviation", "without a unit"});
  expect_input_error(
      normal + "mean = \"30 um\"\ndeviation = \"10 um\"",
      {8, "vary.deviation", "within 4 deviations", "a range that cuts", "range = \"0 cm to 70 µm\""});
  const std::string narrow = normal + "mean = \"30 um\"\ndeviation = \"5 um\"\n";
  EXPECT_TRUE(parse_here(sensitivity_start + input(narrow)));
  expect_input_error(narrow + "range = \"50 to 60 cm\"", {9, "vary.range", "has no share", "near the mean"});
}

TEST(ReadSensitivity, AValueThatTheSceneCannotHaveNamesTheInput) {
  expect_input_error("key = \"load.base\"\ndistribution = \"uniform\"\nrange = \"0.1 to 900 MPa\"",
                     {7, "vary.range", "496 MPa"});
}

TEST(ReadSensitivity, TheAnalyticLoadIsNotUncertainUnderAMeasuredCurve) {
  const std::string file = ::testing::TempDir() + "read_sensitivity_curve.csv";
  std::ofstream(file) << "time_ms,pressure_MPa\n0,0\n5,400\n18,0\n";
  expect_error_in(sensitivity_start + steepness + "[set]\nload.curve = \"" + file + "\"\n",
                  {5, "vary.key", ""});
}

TEST(ReadSensitivity, AFitNeedsEightSamplesOrTwoAnInput) {
  const std::string fit = "method = \"polynomial-chaos\"\n";
  expect_error_in(sensitivity_start + fit + "samples = 7\n" + crack, {5, "samples", "7", "8"});
  EXPECT_EQ(study_of(sensitivity_start + fit + "samples = 8\n" + crack).cases.size(), 8u);
}

}  // namespace
