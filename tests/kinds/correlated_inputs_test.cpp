// Inputs that vary together, by the record of a calibration or as the study file states it.
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

// --- constants of a calibration, which vary together ---

const std::string shipped_record = LAUNCHSAFE_SOURCE_DIR "/reports/calibrate_table8/calibration.json";
const std::string calibrated = input("calibration = \"../reports/calibrate_table8/calibration.json\"");

CalibrationRecord read_shipped_record() {
  return *parse_calibration_record(*scene::read_text_file(shipped_record), shipped_record);
}

TEST(CorrelatedInputs, ACalibrationIsOneInput) {
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
TEST(CorrelatedInputs, TheConstantsOfACalibrationHaveTheCovarianceOfItsRecord) {
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

TEST(CorrelatedInputs, FaultsOfACalibrationAsInputNameFileLineKeyFoundAndAllowed) {
  expect_input_error("calibration = \"nowhere.json\"",
                     {5, "vary.calibration", "does not exist", "load_fitted = true"});
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

TEST(CorrelatedInputs, ARecordWithoutCovarianceIsNoInput) {
  CalibrationRecord record = read_shipped_record();
  record.load_fitted = false;
  record.covariance.clear();
  const std::string file = ::testing::TempDir() + "read_sensitivity_calibration.json";
  std::ofstream(file) << to_json_text(record);
  expect_input_error("calibration = \"" + file + "\"",
                     {5, "vary.calibration", "without a covariance", "load_fitted = true"});
}

TEST(CorrelatedInputs, AnotherShapeOfTheLoadHasNotTheConstantsOfTheBell) {
  const std::string file = ::testing::TempDir() + "read_sensitivity_bell.csv";
  std::ofstream(file) << "time_ms,pressure_MPa\n0,0\n5,400\n18,0\n";
  expect_error_in(sensitivity_start + calibrated + "[set]\nload.curve = \"" + file + "\"\n",
                  {5, "vary.calibration", "a measured curve", "load.shape = \"bell\""});
}

TEST(CorrelatedInputs, ACovarianceThatIsNoneIsNoInput) {
  CalibrationRecord record = read_shipped_record();
  record.covariance[0] *= -1.0;
  const std::string file = ::testing::TempDir() + "read_sensitivity_no_covariance.json";
  std::ofstream(file) << to_json_text(record);
  const auto read = parse_calibration_record(*scene::read_text_file(file), file);
  const std::string found = read ? "not positive definite" : "covariance";
  expect_input_error("calibration = \"" + file + "\"", {5, "vary.calibration", found, ""});
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
TEST(CorrelatedInputs, StatedInputsVaryTogetherAndAreOneInput) {
  const std::string design = "samples = 512\ndesign = \"scrambled-sobol\"\n";
  const StudyFile file = study_of(sensitivity_start + design + peak + crack + initial +
                                  correlation("\"load.peak\", \"initial_temperature\"", "0.6"));
  ASSERT_EQ(file.study.axes.size(), 3u);
  EXPECT_EQ(file.scene.notes, std::vector<std::string>{"load.peak and initial_temperature vary together, "
                                                       "with a coefficient of 0.6"});
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
TEST(CorrelatedInputs, AConstantOfACalibrationMayVaryTogetherWithAnotherInput) {
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

TEST(CorrelatedInputs, FaultsOfCorrelationsNameFileLineKeyFoundAndAllowed) {
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
  expect_fault(
      chain + correlation("\"initial_temperature\", \"crack_radius\"", "0.6"),
      {25, "correlation.coefficient",
       "load.peak, initial_temperature, charge.crack_radius that contradict each other", "at least 0.01"});
  // Two inputs have eigenvalues of 1 - 0.99 and 1 + 0.99.
  expect_fault(correlation(pair, "-0.991"),
               {19, "correlation.coefficient", "of their matrix is 0.009", "from -0.99 to 0.99"});
  EXPECT_TRUE(parse_here(sensitivity_start + peak + initial + crack + correlation(pair, "-0.99")));
  EXPECT_TRUE(parse_here(sensitivity_start + peak + initial + crack + chain +
                         correlation("\"initial_temperature\", \"crack_radius\"", "0.7")));
}

TEST(CorrelatedInputs, ACorrelationThatARecordHasIsNotStated) {
  expect_error_in(
      sensitivity_start + calibrated + correlation("\"load.width\", \"gap.exchange_time\"", "0.1"),
      {7, "correlation.between", "whose correlation the record of the calibration has", "one at the most"});
}

TEST(CorrelatedInputs, OtherKindsOfStudyHaveNoCorrelations) {
  expect_error_in("kind = \"critical-gap\"\nscene = \"scene_155mm.toml\"\ngaps = \"0.02 cm\"\n" +
                      correlation("\"load.peak\", \"initial_temperature\"", "0.6"),
                  {4, "correlation", "kind \"sensitivity\"", "critical-gap"});
}

}  // namespace
