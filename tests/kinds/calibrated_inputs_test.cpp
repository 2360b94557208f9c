// Fitted constants as inputs, which vary together.
#include "launchsafe/kinds/sensitivity.hpp"
#include "launchsafe/math/sensitivity.hpp"
#include "sensitivity_files.hpp"
#include "study/read_error.hpp"

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;
using math::Distribution;

const std::string calibrated = input("key = \"constants\"");
const scene::Constants& shipped() { return *scene::shipped_constants().front(); }

const std::vector<std::string> of_skin{"friction.localisation", "gap.exchange_time"};

/// Covariance of the two while the launch is held, by the formula of a partitioned normal distribution:
/// S_aa - S_ab S_bb^-1 S_ba, with a bordered determinant in place of the inverse.
double conditional(std::size_t i, std::size_t j) {
  const scene::Constants& constants = shipped();
  const auto size = static_cast<Eigen::Index>(constants.fitted_keys.size());
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Matrix all = Eigen::Map<const Matrix>(constants.covariance.data(), size, size);
  std::vector<Eigen::Index> others;
  for (Eigen::Index k = 0; k < size; ++k)
    if (std::ranges::count(of_skin, constants.fitted_keys[static_cast<std::size_t>(k)]) == 0)
      others.push_back(k);
  const auto place = [&](std::size_t k) {
    return std::ranges::find(constants.fitted_keys, of_skin[k]) - constants.fitted_keys.begin();
  };
  const Eigen::MatrixXd held = all(others, others);
  const Eigen::VectorXd left = all(others, place(i)), right = all(others, place(j));
  return all(place(i), place(j)) - left.dot(held.ldlt().solve(right));
}

TEST(CalibratedInputs, TheConstantsAreOneInput) {
  const StudyFile file = study_of(sensitivity_start + "samples = 16\n" + crack + calibrated);
  ASSERT_EQ(file.study.axes.size(), 1 + of_skin.size());
  ASSERT_EQ(file.cases.size(), 16u);
  ASSERT_EQ(inputs_of(file.study).size(), 2u);
  EXPECT_EQ(inputs_of(file.study)[1].count, of_skin.size());
  expect_scenes_of_coordinates(file);
}

// The errors of deviation and correlation from 512 draws are 1/sqrt(2 x 512) = 3 % and 1/sqrt(512) = 0.044 at
// most: three of them.
TEST(CalibratedInputs, TheConstantsHaveTheCovarianceOfTheirFile) {
  const StudyFile file = study_of(sensitivity_start + "samples = 512\n" + calibrated);
  const std::size_t size = of_skin.size();
  std::vector<std::vector<double>> draws;
  for (std::size_t i = 0; i < file.cases.size(); ++i) {
    auto& draw = draws.emplace_back(size);
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
    EXPECT_EQ(file.study.axes[i].key.name, of_skin[i]);
    const double expected = std::sqrt(conditional(i, i));
    EXPECT_NEAR(std::sqrt(covariance(i, i)), expected, 0.09 * expected) << of_skin[i];
    for (std::size_t j = 0; j < i; ++j) {
      const double scale = expected * std::sqrt(conditional(j, j));
      EXPECT_NEAR(covariance(i, j) / scale, conditional(i, j) / scale, 0.13)
          << of_skin[i] << ", " << of_skin[j];
    }
  }
}

TEST(CalibratedInputs, FaultsNameFileLineAndKey) {
  const std::string width =
      input("key = \"gap.exchange_time\"\ndistribution = \"uniform\"\nrange = \"0.2 to 0.3 ms\"");
  expect_error_in(sensitivity_start + calibrated + width, {7, "vary.key", "gap.exchange_time"});
  expect_error_in(sensitivity_start + calibrated + calibrated, {7, "vary.key", ""});
  expect_error_in(sensitivity_start + calibrated + "[set]\ngap.exchange_time = \"0.3 ms\"\n",
                  {5, "vary.key", "gap.exchange_time"});
  expect_error_in("constants = \"none\"\n" + sensitivity_start + calibrated, {6, "vary.key", ""});
}

}  // namespace
