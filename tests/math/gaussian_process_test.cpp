#include "launchsafe/math/sampling.hpp"
#include "launchsafe/math/surrogates.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace launchsafe::math {
namespace {

const std::vector<ChaosBasis> two{ChaosBasis::legendre, ChaosBasis::hermite};

/// Smooth and no polynomial.
double bent(const std::vector<double>& u) {
  const double x = coordinate(two[0], u[0]), z = coordinate(two[1], u[1]);
  return 3.0 + x + std::sin(3.0 * x) * std::exp(0.3 * z) + 0.2 * std::abs(z) * z;
}

struct Data {
  std::vector<double> points, values;
  std::vector<double> point(std::size_t row) const { return point_of_row(points, row, 2); }
};
Data data_of(std::size_t count, const std::function<double(const std::vector<double>&)>& output = bent) {
  Data data{unit_points(Design::scrambled_sobol, count, 2, 3), {}};
  for (std::size_t row = 0; row < count; ++row) data.values.push_back(output(data.point(row)));
  return data;
}

GaussianProcess process_of(double nugget) { return {two, {0.7, 1.9}, nugget, 0.0, {}}; }

// Kriging without a nugget (Rasmussen & Williams, section 2.2).
TEST(GaussianProcess, MeetsItsPointsWithoutANuggetAndIsSureThere) {
  const Data data = data_of(20);
  const FittedProcess fitted(process_of(0.0), data.points, data.values);
  for (std::size_t row = 0; row < data.values.size(); ++row) {
    EXPECT_NEAR(fitted.at(data.point(row)).value, data.values[row], 1e-9) << row;
    EXPECT_NEAR(fitted.at(data.point(row)).leverage, 0.0, 1e-9) << row;
  }
  EXPECT_GT(fitted.at({0.5, 0.999}).leverage, 1e-3);
}

// Matern's function of order 5/2 between two points at a distance of one length is (1 + 5^0.5 + 5/3)
// exp(-5^0.5) = 0.523994. Of three points on a line with a constant and a slope fitted, the weight of the
// fourth follows from the 5 equations of universal kriging, which are solved here as they stand.
TEST(GaussianProcess, SolvesTheEquationsOfUniversalKriging) {
  const std::vector<double> points{0.1, 0.5, 0.6, 0.85}, values{1.0, 3.0, 2.0, 2.5};
  const GaussianProcess process{{ChaosBasis::legendre}, {0.8}, 0.01, 0.0, {}};
  const auto correlation = [](double a, double b) {
    const double r = std::sqrt(5.0) * std::abs(2.0 * (a - b)) / 0.8;
    return (1.0 + r + r * r / 3.0) * std::exp(-r);
  };
  EXPECT_NEAR(correlation(0.1, 0.5), 0.523994, 1e-6);
  const auto x = [](double u) { return 2.0 * u - 1.0; };
  Eigen::Matrix<double, 6, 6> equations = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> right;
  constexpr double at = 0.3;
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j)
      equations(i, j) = correlation(points[std::size_t(i)], points[std::size_t(j)]) + (i == j ? 0.01 : 0.0);
    equations(i, 4) = equations(4, i) = 1.0;
    equations(i, 5) = equations(5, i) = x(points[std::size_t(i)]);
    right(i) = correlation(points[std::size_t(i)], at);
  }
  right(4) = 1.0;
  right(5) = x(at);
  const Eigen::Matrix<double, 6, 1> weights = equations.fullPivLu().solve(right);
  const double expected = weights.head(4).dot(Eigen::Map<const Eigen::Vector4d>(values.data()));
  EXPECT_NEAR(FittedProcess(process, points, values).at({at}).value, expected, 1e-12);
}

// A fit to all points but one, with the same lengths and nugget, predicts that one.
TEST(GaussianProcess, WhatIsLeftOutIsWhatAFitToTheOthersMisses) {
  const Data data = data_of(24);
  const GaussianProcess process = process_of(1e-3);
  const FittedProcess all(process, data.points, data.values);
  double squares = 0.0;
  for (std::size_t row = 0; row < 24; ++row) {
    Data others = data;
    others.values.erase(others.values.begin() + std::ptrdiff_t(row));
    others.points.erase(others.points.begin() + std::ptrdiff_t(2 * row),
                        others.points.begin() + std::ptrdiff_t(2 * row + 2));
    const FittedProcess without(process, others.points, others.values);
    EXPECT_NEAR(all.left_out_errors()[row], data.values[row] - without.at(data.point(row)).value, 1e-9);
  }
  const GaussianProcess fit = fit_process(two, data.points, data.values);
  const FittedProcess fitted(fit, data.points, data.values);
  for (const double error : fitted.left_out_errors()) squares += error * error;
  EXPECT_NEAR(fit.leave_one_out, std::sqrt(squares / 24.0), 1e-12);
}

// The restricted likelihood is the density of the values in an orthonormal basis of what is orthogonal to the
// line, with the best variance; |F'F| of the line's functions makes up the rest of the determinants (Harville
// 1974).
double likelihood_by_projection(const GaussianProcess& process, const Data& data) {
  const auto rows = static_cast<Eigen::Index>(data.values.size());
  Eigen::MatrixXd correlation(rows, rows), line(rows, 3);
  for (Eigen::Index i = 0; i < rows; ++i) {
    const auto a = data.point(static_cast<std::size_t>(i));
    line.row(i) << 1.0, coordinate(two[0], a[0]), coordinate(two[1], a[1]);
    for (Eigen::Index j = 0; j < rows; ++j) {
      const auto b = data.point(static_cast<std::size_t>(j));
      correlation(i, j) = i == j ? 1.0 + process.nugget : 1.0;
      for (std::size_t k = 0; k < 2; ++k) {
        const double r = std::sqrt(5.0) * std::abs(coordinate(two[k], a[k]) - coordinate(two[k], b[k])) /
                         process.lengths[k];
        correlation(i, j) *= (1.0 + r + r * r / 3.0) * std::exp(-r);
      }
    }
  }
  const Eigen::MatrixXd q = line.householderQr().householderQ();
  const Eigen::MatrixXd rest = q.rightCols(rows - 3);
  const Eigen::MatrixXd covariance = rest.transpose() * correlation * rest;
  const Eigen::VectorXd values =
      rest.transpose() * Eigen::Map<const Eigen::VectorXd>(data.values.data(), rows);
  const double freedom = static_cast<double>(rows - 3);
  const double variance = values.dot(covariance.ldlt().solve(values)) / freedom;
  return -0.5 * (freedom * std::log(variance) + std::log(covariance.determinant()) +
                 std::log((line.transpose() * line).determinant()));
}

TEST(GaussianProcess, FitsWhereTheRestrictedLikelihoodIsGreatest) {
  const Data data = data_of(24, [](const std::vector<double>& u) {
    return bent(u) + 0.1 * std::sin(1e4 * u[0] + 3e4 * u[1]);  // an uneven rest, for the nugget
  });
  const GaussianProcess fit = fit_process(two, data.points, data.values);
  ASSERT_EQ(fit.reason, "");
  for (std::size_t which = 0; which < 3; ++which) {
    const auto likelihood = [&](double by) {
      GaussianProcess process = fit;
      (which < 2 ? process.lengths[which] : process.nugget) *= std::exp(by);
      return likelihood_by_projection(process, data);
    };
    constexpr double step = 1e-3;
    EXPECT_NEAR((likelihood(step) - likelihood(-step)) / (2.0 * step), 0.0, 1e-2) << which;
    for (const double by : {-0.3, 0.3}) EXPECT_LT(likelihood(by), likelihood(0.0)) << which;
  }
}

TEST(GaussianProcess, PredictsPointsThatItHasNotSeen) {
  const Data data = data_of(64);
  const GaussianProcess fit = fit_process(two, data.points, data.values);
  const FittedProcess fitted(fit, data.points, data.values);
  const PolynomialChaos polynomial = fit_chaos(two, data.points, data.values);
  const FittedChaos chaos(polynomial, data.points);
  std::vector<double> unseen = unit_points(Design::monte_carlo, 200, 2, 9);
  for (double& each : unseen) each = 0.02 + 0.96 * each;  // among the points, not beyond them
  double squares = 0.0, of_chaos = 0.0;
  for (std::size_t row = 0; row < 200; ++row) {
    const auto point = point_of_row(unseen, row, 2);
    squares += std::pow(fitted.at(point).value - bent(point), 2) / 200.0;
    of_chaos += std::pow(chaos.at(point).value - bent(point), 2) / 200.0;
  }
  EXPECT_LT(std::sqrt(squares), 3.0 * fit.leave_one_out);
  EXPECT_LT(std::sqrt(squares), std::sqrt(of_chaos));
  EXPECT_LT(fit.leave_one_out, polynomial.leave_one_out);
}

TEST(GaussianProcess, OfAStraightLineOrTooFewPointsThereIsNone) {
  const Data line = data_of(20, [](const std::vector<double>& u) { return 2.0 + 6.0 * u[0]; });
  EXPECT_NE(fit_process(two, line.points, line.values).reason, "");
  const Data few = data_of(7);
  EXPECT_NE(fit_process(two, few.points, few.values).reason, "");
}

}  // namespace
}  // namespace launchsafe::math
