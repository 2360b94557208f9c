#include "launchsafe/kinds/sensitivity.hpp"
#include "launchsafe/math/sensitivity.hpp"
#include "launchsafe/study/calibration_record.hpp"
#include "launchsafe/study/case_uncertainty.hpp"
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

/// Three lines.
const std::string sensitivity_start =
    "kind = \"sensitivity\"\nscene = \"scene_155mm.toml\"\ngaps = \"0.02 cm\"\n";

std::string input(const std::string& rest) { return "[[vary]]\n" + rest + "\n"; }

const std::string crack =
    input("key = \"crack_radius\"\ndistribution = \"uniform\"\nrange = \"10 to 100 um\"");
const std::string steepness =
    input("key = \"load.steepness\"\ndistribution = \"normal\"\nmean = 1.4\ndeviation = 0.02");
const std::string flaw =
    input("key = \"charge.flaw_size\"\ndistribution = \"log-uniform\"\nrange = \"0.5 mm to 2 mm\"");

/// One [[vary]] after the first three lines; its own first line is line 5.
void expect_input_error(const std::string& rest, const ExpectedError& expected) {
  expect_error_in(sensitivity_start + input(rest), expected);
}

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

/// A case is the study's scene with the coordinates set, whatever it was built from.
void expect_scenes_of_coordinates(const StudyFile& file) {
  const scene::Place place{"a.toml", 1, 1};
  for (const StudyCase& each : file.cases) {
    scene::SceneFile expected = file.scene;
    for (std::size_t i = 0; i < each.coordinates.size(); ++i)
      expected = *scene::with_keys(expected, {{file.study.axes[i].key.name, each.coordinates[i], place}});
    ASSERT_EQ(scene::to_toml(each.scene.scene), scene::to_toml(expected.scene)) << each.label;
  }
}

TEST(ReadSensitivity, SobolCasesFollowTheDesign) {
  const StudyFile file = study_of(
      sensitivity_start + "design = \"scrambled-sobol\"\nsamples = 4\nseed = 3\n" + crack + steepness + flaw);
  const auto design = math::saltelli_design(math::Design::scrambled_sobol, 4, 3, 3);
  ASSERT_EQ(file.cases.size(), design.evaluations());
  for (std::size_t evaluation = 0; evaluation < file.cases.size(); ++evaluation) {
    const auto point = design.point(evaluation);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(file.cases[evaluation].coordinates[i],
                math::quantile(*file.study.axes[i].distribution, point[i]));
    }
  }
  EXPECT_EQ(file.cases[design.index(design.block_a, 0)].label, "sample 1 of A");
  EXPECT_EQ(file.cases[design.index(design.block_b, 1)].label, "sample 2 of B");
  EXPECT_EQ(file.cases[design.index(design.block_ab(1), 3)].label, "sample 4 of AB(load.steepness)");
  expect_scenes_of_coordinates(file);
}

TEST(ReadSensitivity, TheGapIsTheScenesOnlyOne) {
  const std::string without = sensitivity_start.substr(0, sensitivity_start.find("gaps = "));
  expect_error_in(without + crack, {0, "gaps", "no gap, and the scene's 6 gaps", "one gap", "gaps = \""});
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
  expect_line_error("surrogate = true\nsamples = 8",
                    {4, "surrogate", "8 samples to be fitted", "30 to 2000 samples"});
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
                     {7, "vary.range", "and a peak of 496 MPa", "at most the peak"});
}

TEST(ReadSensitivity, TheAnalyticLoadIsNotUncertainUnderAMeasuredCurve) {
  const std::string file = ::testing::TempDir() + "read_sensitivity_curve.csv";
  std::ofstream(file) << "time_ms,pressure_MPa\n0,0\n5,400\n18,0\n";
  expect_error_in(sensitivity_start + steepness + "[set]\nload.curve = \"" + file + "\"\n",
                  {5, "vary.key", "which a measured curve does not have"});
}

// --- constants of a calibration, which vary together ---

const std::string shipped_record = LAUNCHSAFE_SOURCE_DIR "/reports/calibrate_table8/calibration.json";
const std::string calibrated = input("calibration = \"../reports/calibrate_table8/calibration.json\"");

CalibrationRecord read_shipped_record() {
  return *parse_calibration_record(*scene::read_text_file(shipped_record), shipped_record);
}

TEST(ReadSensitivity, ACalibrationIsOneInput) {
  const StudyFile file = study_of(sensitivity_start + "samples = 4\n" + crack + calibrated);
  ASSERT_EQ(file.study.axes.size(), 6u);
  ASSERT_EQ(file.cases.size(), 4u * 4u);
  for (std::size_t row = 0; row < 4; ++row) {
    const auto at = [&](std::size_t block) { return file.cases[4 * row + block].coordinates; };
    const auto joined = [](double first, std::vector<double> rest) {
      rest[0] = first;
      return rest;
    };
    EXPECT_EQ(at(2), joined(at(1)[0], at(0))) << "the crack radius of B";
    EXPECT_EQ(at(3), joined(at(0)[0], at(1))) << "all five constants of B";
  }
  EXPECT_EQ(file.cases[3].label, "sample 1 of AB(calibration)");
  expect_scenes_of_coordinates(file);
}

// The errors of deviation and correlation from 512 draws are 1/sqrt(2 x 512) = 3 % and 1/sqrt(512) = 0.044 at
// most: three of them.
TEST(ReadSensitivity, TheConstantsOfACalibrationHaveTheCovarianceOfItsRecord) {
  const StudyFile file = study_of(sensitivity_start + "samples = 256\n" + calibrated);
  const CalibrationRecord record = read_shipped_record();
  constexpr std::size_t size = fitted_keys.size();
  std::vector<std::array<double, size>> draws;
  for (std::size_t i = 0; i < file.cases.size(); ++i) {
    if (!samples_inputs(file.study, i)) continue;
    auto& draw = draws.emplace_back();
    for (std::size_t k = 0; k < size; ++k)
      draw[k] = std::log(file.cases[i].coordinates[k] / file.study.axes[k].distribution->centre);
  }
  ASSERT_EQ(draws.size(), 512u);
  const auto covariance = [&](std::size_t i, std::size_t j) {
    double sum = 0;
    for (const auto& draw : draws) sum += draw[i] * draw[j];
    return sum / static_cast<double>(draws.size());
  };
  for (std::size_t i = 0; i < size; ++i) {
    EXPECT_EQ(file.study.axes[i].key.name, fitted_keys[i]);
    const double expected = std::sqrt(record.covariance[i * size + i]);
    EXPECT_NEAR(std::sqrt(covariance(i, i)), expected, 0.09 * expected) << fitted_keys[i];
    for (std::size_t j = 0; j < i; ++j) {
      const double scale = expected * std::sqrt(record.covariance[j * size + j]);
      EXPECT_NEAR(covariance(i, j) / scale, record.covariance[i * size + j] / scale, 0.13)
          << fitted_keys[i] << ", " << fitted_keys[j];
    }
  }
}

TEST(ReadSensitivity, FaultsOfACalibrationAsInputNameFileLineKeyFoundAndAllowed) {
  expect_input_error("calibration = \"nowhere.json\"",
                     {5, "vary.calibration", "cannot be read", "load_fitted = true"});
  expect_input_error("calibration = 3", {5, "vary.calibration", "3", "a text"});
  expect_input_error("calibration = \"a.json\"\nrange = \"1 to 2 K\"", {6, "vary.range", "unknown"});
  const std::string width = input("key = \"load.width\"\ndistribution = \"uniform\"\nrange = \"2 to 3 ms\"");
  expect_error_in(sensitivity_start + calibrated + width,
                  {7, "vary.key", "load.width a second time", "each scene key once"});
  expect_error_in(sensitivity_start + width + calibrated,
                  {9, "vary.calibration", "load.width a second time", "each scene key once"});
  expect_error_in(sensitivity_start + calibrated + calibrated,
                  {7, "vary.calibration", "a second calibration", "one calibration"});
  expect_error_in(sensitivity_start + calibrated + "[set]\nload.width = \"3 ms\"\n",
                  {5, "vary.calibration", "load.width, which [set]", "either"});
  expect_error_in(sensitivity_start + "calibration = \"" + shipped_record + "\"\n" + calibrated,
                  {6, "vary.calibration", "beside that of the study", "one of both", "leave out"});
}

TEST(ReadSensitivity, ARecordWithoutCovarianceIsNoInput) {
  CalibrationRecord record = read_shipped_record();
  record.load_fitted = false;
  record.covariance.clear();
  const std::string file = ::testing::TempDir() + "read_sensitivity_calibration.json";
  std::ofstream(file) << to_json_text(record);
  expect_input_error("calibration = \"" + file + "\"",
                     {5, "vary.calibration", "without a covariance", "load_fitted = true"});
}

TEST(ReadSensitivity, AnotherShapeOfTheLoadHasNotTheConstantsOfTheBell) {
  const std::string file = ::testing::TempDir() + "read_sensitivity_bell.csv";
  std::ofstream(file) << "time_ms,pressure_MPa\n0,0\n5,400\n18,0\n";
  expect_error_in(sensitivity_start + calibrated + "[set]\nload.curve = \"" + file + "\"\n",
                  {5, "vary.calibration", "a measured curve", "load.shape = \"bell\""});
}

TEST(ReadSensitivity, ACovarianceThatIsNoneIsNoInput) {
  CalibrationRecord record = read_shipped_record();
  record.covariance[0] *= -1.0;
  const std::string file = ::testing::TempDir() + "read_sensitivity_no_covariance.json";
  std::ofstream(file) << to_json_text(record);
  const auto read = parse_calibration_record(*scene::read_text_file(file), file);
  const std::string found = read ? "not positive definite" : "covariance";
  expect_input_error("calibration = \"" + file + "\"", {5, "vary.calibration", found, ""});
}

TEST(ReadSensitivity, ErrorsAreAskedOfAFitThatHasRoomForMoreSamples) {
  const std::string fit = "method = \"polynomial-chaos\"\n";
  expect_line_error("error_of_temperature = \"1 K\"",
                    {4, "error_of_temperature", "fits nothing", "polynomial-chaos"});
  expect_line_error("error_of_critical_gap = \"0 cm\"",
                    {4, "error_of_critical_gap", "0 cm", "more than 0 cm"});
  expect_error_in(sensitivity_start + fit + "most_samples = 80\n" + crack,
                  {5, "most_samples", "no error that is asked", "error_of_temperature"});
  expect_error_in(sensitivity_start + fit + "error_of_temperature = \"1 K\"\nmost_samples = 60\n" + crack,
                  {6, "most_samples", "64 samples, and 60 at the most", "at least samples"});
}

TEST(ReadSensitivity, AFitNeedsEightSamplesOrTwoAnInput) {
  const std::string fit = "method = \"polynomial-chaos\"\n";
  expect_error_in(sensitivity_start + fit + "samples = 7\n" + crack,
                  {5, "samples", "7 samples for a fit", "at least 8: two an input, and 8"});
}

TEST(ReadSensitivity, AFitIsHeldAgainstThirtyLaunchesAtLeast) {
  const std::string fit = "method = \"polynomial-chaos\"\nsamples = 8\n";
  expect_error_in(sensitivity_start + fit + "held_out = 29\n" + crack, {6, "held_out", "29", "30 to 1"});
  EXPECT_EQ(study_of(sensitivity_start + fit + "held_out = 30\n" + crack).cases.size(), 38u);
}

// --- correlations that the study states ---

std::string correlation(const std::string& between, const std::string& coefficient) {
  return "[[correlation]]\nbetween = [" + between + "]\ncoefficient = " + coefficient + "\n";
}

const std::string peak =
    input("key = \"peak_pressure\"\ndistribution = \"normal\"\nmean = \"496 MPa\"\ndeviation = \"10 MPa\"");
const std::string initial =
    input("key = \"initial_temperature\"\ndistribution = \"uniform\"\nrange = \"288 to 312 K\"");

/// Normal scores of the draws of an input; of a record's constants likewise, since they are log-normal.
std::vector<double> scores_of(const StudyFile& file, const std::string& key) {
  std::vector<double> scores;
  for (std::size_t axis = 0; axis < file.study.axes.size(); ++axis)
    for (std::size_t i = 0; i < file.cases.size() && file.study.axes[axis].key.name == key; ++i)
      if (samples_inputs(file.study, i))
        scores.push_back(math::quantile(
            Distribution::normal(0, 1),
            math::cumulative(*file.study.axes[axis].distribution, file.cases.coordinates(i)[axis])));
  return scores;
}

double mean_product(const std::vector<double>& one, const std::vector<double>& other) {
  double sum = 0.0;
  for (std::size_t i = 0; i < one.size(); ++i) sum += one[i] * other[i];
  return sum / static_cast<double>(one.size());
}

// Inputs that vary together stand next to each other, and are one input of the design.
TEST(ReadSensitivity, StatedInputsVaryTogetherAndAreOneInput) {
  const std::string design = "samples = 512\ndesign = \"scrambled-sobol\"\n";
  const StudyFile file = study_of(sensitivity_start + design + peak + crack + initial +
                                  correlation("\"load.peak\", \"initial_temperature\"", "0.6"));
  ASSERT_EQ(file.study.axes.size(), 3u);
  EXPECT_EQ(file.study.axes[1].key.name, "initial_temperature");
  ASSERT_EQ(inputs_of(file.study).size(), 2u);
  EXPECT_EQ(inputs_of(file.study)[0].count, 2u);
  EXPECT_EQ(file.cases.label(2), "sample 1 of AB(peak_pressure + initial_temperature)");
  EXPECT_EQ(file.cases.coordinates(2)[0], file.cases.coordinates(1)[0]);
  EXPECT_EQ(file.cases.coordinates(2)[1], file.cases.coordinates(1)[1]);
  EXPECT_EQ(file.cases.coordinates(2)[2], file.cases.coordinates(0)[2]);
  const auto pressure = scores_of(file, "load.peak"), temperature = scores_of(file, "initial_temperature"),
             radius = scores_of(file, "charge.crack_radius");
  ASSERT_EQ(pressure.size(), 1024u);
  EXPECT_NEAR(mean_product(pressure, temperature), 0.6, 0.03);
  EXPECT_NEAR(mean_product(temperature, temperature), 1.0, 0.03);
  EXPECT_NEAR(mean_product(pressure, radius), 0.0, 0.03);
}

// One matrix: the record's block stays what it is, and the coefficient is that of the constant itself.
TEST(ReadSensitivity, AConstantOfACalibrationMayVaryTogetherWithAnotherInput) {
  const std::string design = "samples = 1024\ndesign = \"scrambled-sobol\"\n";
  const StudyFile with = study_of(sensitivity_start + design + peak + crack + calibrated +
                                  correlation("\"peak_pressure\", \"friction.localisation\"", "-0.4"));
  const StudyFile without = study_of(sensitivity_start + design + peak + crack + calibrated);
  ASSERT_EQ(inputs_of(with.study).size(), 2u);
  EXPECT_EQ(inputs_of(with.study)[0].count, 6u);
  EXPECT_NEAR(mean_product(scores_of(with, "load.peak"), scores_of(with, "friction.localisation")), -0.4,
              0.03);
  EXPECT_NEAR(mean_product(scores_of(with, "load.peak"), scores_of(with, "load.width")), 0.0, 0.03);
  for (const char* one : fitted_keys)
    for (const char* other : fitted_keys)
      EXPECT_NEAR(mean_product(scores_of(with, one), scores_of(with, other)),
                  mean_product(scores_of(without, one), scores_of(without, other)), 0.05)
          << one << ", " << other;
}

TEST(ReadSensitivity, FaultsOfCorrelationsNameFileLineKeyFoundAndAllowed) {
  const auto expect_fault = [](const std::string& rest, const ExpectedError& expected) {
    expect_error_in(sensitivity_start + peak + initial + crack + rest, expected);  // rest from line 17 on
  };
  const std::string pair = "\"load.peak\", \"initial_temperature\"";
  expect_fault(correlation("\"load.peak\", \"initial_temperatur\"", "0.6"),
               {18, "correlation.between", "\"initial_temperatur\", which the study does not sample",
                "\"load.peak\", \"initial_temperature\" or \"charge.crack_radius\"", "initial_temperature"});
  expect_fault(correlation("\"load.peak\", \"load.width\"", "0.6"),
               {18, "correlation.between", "\"load.width\", which the study does not sample"});
  expect_fault(correlation("\"load.peak\", \"variants\"", "0.6"),
               {18, "correlation.between", "\"variants\", which the study does not sample"});
  expect_fault(correlation("\"load.peak\", \"peak_pressure\"", "0.6"),
               {18, "correlation.between", "load.peak twice", "two inputs"});
  expect_fault(
      correlation(pair, "0.6") + correlation("\"initial_temperature\", \"peak_pressure\"", "0.5"),
      {21, "correlation.between", "initial_temperature and load.peak a second time", "each pair once"});
  for (const char* beyond : {"1", "-1", "1.5", "nan"})
    expect_fault(correlation(pair, beyond),
                 {19, "correlation.coefficient", beyond, "-1 (excluded) to 1 (excluded)"});
  expect_fault(correlation("\"load.peak\"", "0.6"), {18, "correlation.between", "[ \"load.peak\" ]",
                                                     "an array of 2 texts, such as [\"load.peak\""});
  expect_fault("[[correlation]]\nbetween = \"load.peak, initial_temperature\"\ncoefficient = 0.6\n",
               {18, "correlation.between", "\"load.peak, initial_temperature\"", "an array of 2 texts"});
  expect_fault("[[correlation]]\nbetween = [" + pair + "]\n",
               {17, "correlation.coefficient", "missing", "a number"});
  expect_fault("[[correlation]]\ncoefficient = 0.6\n", {17, "correlation.between", "missing"});
  expect_fault("[[correlation]]\nbetwen = [" + pair + "]\n",
               {18, "correlation.betwen", "unknown", "", "between"});
  expect_fault("correlation = 0.6\n", {17, "vary.correlation", "unknown"});
  expect_error_in(sensitivity_start + "correlation = 3\n" + peak, {4, "correlation", "3", "[[correlation]]"});
  // 0.9 and 0.9 leave the third 0.62 at least.
  const std::string chain = correlation(pair, "0.9") + correlation("\"load.peak\", \"crack_radius\"", "0.9");
  expect_fault(chain + correlation("\"initial_temperature\", \"crack_radius\"", "0.6"),
               {25, "correlation.coefficient",
                "load.peak, initial_temperature, charge.crack_radius that no inputs have", "nearer to 0"});
  EXPECT_TRUE(parse_here(sensitivity_start + peak + initial + crack + chain +
                         correlation("\"initial_temperature\", \"crack_radius\"", "0.7")));
}

TEST(ReadSensitivity, ACorrelationThatARecordHasIsNotStated) {
  expect_error_in(
      sensitivity_start + calibrated + correlation("\"load.width\", \"gap.exchange_time\"", "0.1"),
      {7, "correlation.between", "whose correlation the record of the calibration has", "one at the most"});
}

TEST(ReadSensitivity, OtherKindsOfStudyHaveNoCorrelations) {
  expect_error_in("kind = \"critical-gap\"\nscene = \"scene_155mm.toml\"\ngaps = \"0.02 cm\"\n" +
                      correlation("\"load.peak\", \"initial_temperature\"", "0.6"),
                  {4, "correlation", "kind \"sensitivity\"", "critical-gap"});
}

}  // namespace
