// The constants of a calibration as inputs, which vary together.
#include "launchsafe/kinds/sensitivity.hpp"
#include "launchsafe/math/sensitivity.hpp"
#include "launchsafe/study/calibration_record.hpp"
#include "launchsafe/study/case_answer.hpp"
#include "sensitivity_files.hpp"
#include "study/read_error.hpp"

#include <array>
#include <cmath>
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
  const StudyFile file = study_of(sensitivity_start + "samples = 16\n" + crack + calibrated);
  ASSERT_EQ(file.study.axes.size(), 6u);
  ASSERT_EQ(file.cases.size(), 16u);
  ASSERT_EQ(inputs_of(file.study).size(), 2u);
  EXPECT_EQ(inputs_of(file.study)[1].count, 5u);
  expect_scenes_of_coordinates(file);
}

// The errors of deviation and correlation from 512 draws are 1/sqrt(2 x 512) = 3 % and 1/sqrt(512) = 0.044 at
// most: three of them.
TEST(CalibratedInputs, TheConstantsOfACalibrationHaveTheCovarianceOfItsRecord) {
  const StudyFile file = study_of(sensitivity_start + "samples = 512\n" + calibrated);
  const CalibrationRecord record = read_shipped_record();
  constexpr std::size_t size = fitted_keys.size();
  std::vector<std::array<double, size>> draws;
  for (std::size_t i = 0; i < file.cases.size(); ++i) {
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

TEST(CalibratedInputs, FaultsOfACalibrationAsInputNameFileLineAndKey) {
  expect_input_error("calibration = \"nowhere.json\"", {5, "vary.calibration", ""});
  const std::string width = input("key = \"load.width\"\ndistribution = \"uniform\"\nrange = \"2 to 3 ms\"");
  expect_error_in(sensitivity_start + calibrated + width, {7, "vary.key", "load.width"});
  expect_error_in(sensitivity_start + calibrated + calibrated, {7, "vary.calibration", ""});
  expect_error_in(sensitivity_start + calibrated + "[set]\nload.width = \"3 ms\"\n",
                  {5, "vary.calibration", "load.width"});
}

}  // namespace
