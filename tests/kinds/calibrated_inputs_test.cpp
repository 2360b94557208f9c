// The constants of a calibration as inputs, which vary together.
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

const std::string shipped_record = LAUNCHSAFE_SOURCE_DIR "/reports/calibrate_table8/calibration.json";
const std::string calibrated = input("calibration = \"../reports/calibrate_table8/calibration.json\"");

CalibrationRecord read_shipped_record() {
  return *parse_calibration_record(*scene::read_text_file(shipped_record), shipped_record);
}

TEST(CalibratedInputs, ACalibrationIsOneInput) {
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
TEST(CalibratedInputs, TheConstantsOfACalibrationHaveTheCovarianceOfItsRecord) {
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

TEST(CalibratedInputs, FaultsOfACalibrationAsInputNameFileLineKeyFoundAndAllowed) {
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

TEST(CalibratedInputs, ARecordWithoutCovarianceIsNoInput) {
  CalibrationRecord record = read_shipped_record();
  record.load_fitted = false;
  record.covariance.clear();
  const std::string file = ::testing::TempDir() + "read_sensitivity_calibration.json";
  std::ofstream(file) << to_json_text(record);
  expect_input_error("calibration = \"" + file + "\"",
                     {5, "vary.calibration", "without a covariance", "load_fitted = true"});
}

TEST(CalibratedInputs, AnotherShapeOfTheLoadHasNotTheConstantsOfTheBell) {
  const std::string file = ::testing::TempDir() + "read_sensitivity_bell.csv";
  std::ofstream(file) << "time_ms,pressure_MPa\n0,0\n5,400\n18,0\n";
  expect_error_in(sensitivity_start + calibrated + "[set]\nload.curve = \"" + file + "\"\n",
                  {5, "vary.calibration", "a measured curve", "load.shape = \"bell\""});
}

TEST(CalibratedInputs, ACovarianceThatIsNoneIsNoInput) {
  CalibrationRecord record = read_shipped_record();
  record.covariance[0] *= -1.0;
  const std::string file = ::testing::TempDir() + "read_sensitivity_no_covariance.json";
  std::ofstream(file) << to_json_text(record);
  const auto read = parse_calibration_record(*scene::read_text_file(file), file);
  const std::string found = read ? "not positive definite" : "covariance";
  expect_input_error("calibration = \"" + file + "\"", {5, "vary.calibration", found, ""});
}

}  // namespace
