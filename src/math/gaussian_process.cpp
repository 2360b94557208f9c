#include "launchsafe/math/statistics.hpp"
#include "launchsafe/math/surrogates.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace launchsafe::math {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// No process is fitted to more: the time goes with their cube.
constexpr std::size_t most_points = 256;
constexpr double root5 = 2.23606797749978969;
/// Of lengths, in coordinates from -1 to 1 or of standard normals; and of nuggets, the least of which leaves
/// the inverse of the correlations enough digits.
constexpr double least_length = 0.1, greatest_length = 100.0, least_nugget = 1e-6, greatest_nugget = 1.0;

double matern(double distance) {
  const double r = root5 * distance;
  return (1.0 + r + r * r / 3.0) * std::exp(-r);
}

/// Derivative of the logarithm of Matern's function by that of its length.
double matern_slope(double distance) {
  const double r = root5 * distance;
  return r * r * (1.0 + r) / (3.0 + 3.0 * r + r * r);
}

Rows coordinates_of(const std::vector<ChaosBasis>& inputs, const std::vector<double>& points) {
  const auto columns = static_cast<Eigen::Index>(inputs.size());
  Rows coordinates(static_cast<Eigen::Index>(points.size()) / columns, columns);
  for (std::size_t i = 0; i < points.size(); ++i)
    coordinates.data()[i] = coordinate(inputs[i % inputs.size()], points[i]);
  return coordinates;
}

/// Of two places by their coordinates.
double correlation(const double* a, const double* b, const std::vector<double>& lengths) {
  double product = 1.0;
  for (std::size_t k = 0; k < lengths.size(); ++k) product *= matern(std::abs(a[k] - b[k]) / lengths[k]);
  return product;
}

Matrix correlations(const Rows& at, const std::vector<double>& lengths) {
  Matrix matrix = Matrix::Identity(at.rows(), at.rows());
  for (Eigen::Index i = 0; i < at.rows(); ++i)
    for (Eigen::Index j = 0; j < i; ++j)
      matrix(i, j) = matrix(j, i) = correlation(&at(i, 0), &at(j, 0), lengths);
  return matrix;
}

/// The process on its points. In the products with `contrast` the line does not show.
struct Kriging {
  Matrix correlation;           ///< without the nugget
  Matrix inverse, trend, line;  ///< of all, and of the line's functions: coefficients from values
  Matrix line_inverse, contrast;
  Vector contrasted;
  double freedom = 0, variance = 0, likelihood = -infinity;
};

Kriging kriging_of(const GaussianProcess& process, const Rows& at, const Vector& values) {
  Kriging of;
  const Eigen::Index rows = at.rows();
  of.trend.resize(rows, at.cols() + 1);
  of.trend << Vector::Ones(rows), at;
  of.freedom = static_cast<double>(rows - of.trend.cols());
  of.correlation = correlations(at, process.lengths);
  const Eigen::LLT<Matrix> factor((of.correlation + process.nugget * Matrix::Identity(rows, rows)).eval());
  if (factor.info() != Eigen::Success) return of;
  of.inverse = factor.solve(Matrix::Identity(rows, rows));
  const Matrix weighted = of.inverse * of.trend;
  const Eigen::LLT<Matrix> reduced((of.trend.transpose() * weighted).eval());
  if (reduced.info() != Eigen::Success) return of;
  of.line_inverse = reduced.solve(Matrix::Identity(of.trend.cols(), of.trend.cols()));
  of.line = of.line_inverse * weighted.transpose();
  of.contrast = of.inverse - weighted * of.line;
  of.contrasted = of.contrast * values;
  of.variance = values.dot(of.contrasted) / of.freedom;
  if (!(of.variance > 0.0)) return of;
  const auto log_determinant = [](const Eigen::LLT<Matrix>& of_matrix) {
    return 2.0 * of_matrix.matrixLLT().diagonal().array().log().sum();
  };
  of.likelihood =
      -0.5 * (of.freedom * std::log(of.variance) + log_determinant(factor) + log_determinant(reduced));
  return of;
}

/// The correlations' derivatives by the logarithms of the lengths and of the nugget.
std::vector<Matrix> derivatives_of(const GaussianProcess& process, const Rows& at,
                                   const Matrix& correlation) {
  std::vector<Matrix> derivatives;
  for (Eigen::Index k = 0; k < at.cols(); ++k) {
    const double length = process.lengths[static_cast<std::size_t>(k)];
    Matrix& matrix = derivatives.emplace_back(correlation);
    for (Eigen::Index i = 0; i < at.rows(); ++i)
      for (Eigen::Index j = 0; j < at.rows(); ++j)
        matrix(i, j) *= matern_slope(std::abs(at(i, k) - at(j, k)) / length);
  }
  derivatives.push_back(process.nugget * Matrix::Identity(at.rows(), at.rows()));
  return derivatives;
}

/// Derivatives of the likelihood, and the expectation of its second ones with the sign turned.
struct Slope {
  Vector gradient;
  Matrix information;
};
Slope slope_of(const GaussianProcess& process, const Rows& at, const Kriging& of) {
  std::vector<Matrix> products;
  const std::vector<Matrix> derivatives = derivatives_of(process, at, of.correlation);
  const auto count = static_cast<Eigen::Index>(derivatives.size());
  Slope slope{Vector(count), Matrix(count, count)};
  Vector traces(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Matrix& derivative = derivatives[static_cast<std::size_t>(i)];
    products.emplace_back(of.contrast * derivative);
    traces(i) = products.back().trace();
    slope.gradient(i) = 0.5 * (of.contrasted.dot(derivative * of.contrasted) / of.variance - traces(i));
    for (Eigen::Index j = 0; j <= i; ++j)
      slope.information(i, j) = slope.information(j, i) =
          0.5 * (products.back().cwiseProduct(products[static_cast<std::size_t>(j)].transpose()).sum() -
                 traces(i) * traces(j) / of.freedom);
  }
  return slope;
}

/// Moves by logarithms, no farther than the limits.
GaussianProcess moved(GaussianProcess process, const Vector& by) {
  const std::size_t inputs = process.lengths.size();
  for (std::size_t i = 0; i < inputs; ++i)
    process.lengths[i] = std::clamp(process.lengths[i] * std::exp(by(static_cast<Eigen::Index>(i))),
                                    least_length, greatest_length);
  process.nugget = std::clamp(process.nugget * std::exp(by(by.size() - 1)), least_nugget, greatest_nugget);
  return process;
}

/// Newton's steps with the expected second derivatives, shortened until the likelihood rises.
std::pair<GaussianProcess, double> climbed(GaussianProcess process, const Rows& at, const Vector& values) {
  constexpr int most_steps = 50;
  constexpr double least_rise = 1e-6;
  Kriging here = kriging_of(process, at, values);
  double damping = 0.1;
  for (int step = 0; step < most_steps && std::isfinite(here.likelihood); ++step) {
    const Slope slope = slope_of(process, at, here);
    double rise = 0.0;
    for (; damping < 1e6 && !(rise > 0.0); damping *= 4.0) {
      Matrix damped = slope.information;
      damped.diagonal() += (damping * damped.diagonal().array() + 1e-6).matrix();
      const Vector newton = damped.ldlt().solve(slope.gradient);
      const GaussianProcess next = moved(process, newton.cwiseMax(-2.0).cwiseMin(2.0));
      Kriging there = kriging_of(next, at, values);
      rise = there.likelihood - here.likelihood;
      if (!(rise > 0.0)) continue;
      process = next;
      here = std::move(there);
      damping /= 16.0;
    }
    if (!(rise > least_rise)) break;
  }
  return {std::move(process), here.likelihood};
}

}  // namespace

GaussianProcess fit_process(const std::vector<ChaosBasis>& inputs, const std::vector<double>& points,
                            const std::vector<double>& values) {
  assert(!inputs.empty() && points.size() == inputs.size() * values.size());
  GaussianProcess best{.inputs = inputs, .lengths = std::vector<double>(inputs.size(), 1.0), .reason = {}};
  const FiniteRows rows = finite_rows(inputs.size(), points, values);
  if (rows.values.size() < fewest_chaos_points(inputs.size()) || rows.values.size() > most_points) {
    best.reason = "too few or too many evaluations have a number for a process";
    return best;
  }
  const Rows at = coordinates_of(inputs, rows.points);
  const Vector of = Eigen::Map<const Vector>(rows.values.data(), at.rows());
  double greatest = -infinity;
  for (const double length : {1.0, 5.0}) {
    GaussianProcess start = best;
    start.lengths.assign(inputs.size(), length);
    start.nugget = 1e-4;
    auto [found, likelihood] = climbed(std::move(start), at, of);
    if (!(likelihood > greatest)) continue;
    best = std::move(found);
    greatest = likelihood;
  }
  const double spread = (of.array() - of.mean()).matrix().norm();
  const double residual = std::sqrt(std::max(0.0, kriging_of(best, at, of).variance));
  // The variance of a straight line is round-off: of matrices with a condition of up to 1e8, 1e-8 of the
  // spread's.
  if (!std::isfinite(greatest) || !(residual > 1e-4 * spread)) {
    best.reason = "the output is a straight line";
    return best;
  }
  const FittedProcess fitted(best, rows.points, rows.values);
  const std::vector<double>& errors = fitted.left_out_errors();
  best.leave_one_out = std::sqrt(sum_of_squares(errors) / static_cast<double>(errors.size()));
  return best;
}

FittedProcess::FittedProcess(GaussianProcess process, const std::vector<double>& points,
                             const std::vector<double>& values)
    : process_(std::move(process)) {
  const Rows at = coordinates_of(process_.inputs, points);
  const Kriging of = kriging_of(process_, at, Eigen::Map<const Vector>(values.data(), at.rows()));
  coordinates_.assign(at.data(), at.data() + at.size());
  if (of.contrast.size() == 0) {  // no process: points that all lie in a plane
    const auto functions = static_cast<std::size_t>(at.rows() + of.trend.cols());
    form_.offset = not_a_number;
    form_.weights.assign(functions, form_.offset);
    form_.matrix.assign(functions * functions, form_.offset);
    return;
  }
  double left_out_variance = 0.0;  // mean, as a share of that of the deviations
  for (Eigen::Index i = 0; i < at.rows(); ++i) {
    left_out_errors_.push_back(of.contrasted(i) / of.contrast(i, i));
    left_out_variance += 1.0 / (of.contrast(i, i) * static_cast<double>(at.rows()));
  }
  const Vector line = of.line * Eigen::Map<const Vector>(values.data(), at.rows());
  form_.weights.assign(of.contrasted.begin(), of.contrasted.end());
  form_.weights.insert(form_.weights.end(), line.begin(), line.end());
  Matrix whole(at.rows() + line.size(), at.rows() + line.size());
  whole << -of.contrast, -of.line.transpose(), -of.line, of.line_inverse;
  whole /= left_out_variance;
  form_.matrix.assign(whole.data(), whole.data() + whole.size());
  form_.offset = (1.0 + process_.nugget) / left_out_variance;
}

std::vector<double> FittedProcess::functions_at(const std::vector<double>& point) const {
  const std::size_t inputs = process_.inputs.size();
  assert(point.size() == inputs);
  std::vector<double> line{1.0};
  for (std::size_t i = 0; i < inputs; ++i) line.push_back(coordinate(process_.inputs[i], point[i]));
  std::vector<double> functions;
  for (std::size_t row = 0; row < coordinates_.size(); row += inputs)
    functions.push_back(correlation(&line[1], &coordinates_[row], process_.lengths));
  functions.insert(functions.end(), line.begin(), line.end());
  return functions;
}

FitValue FittedProcess::at(const std::vector<double>& point) const { return form_.at(functions_at(point)); }

}  // namespace launchsafe::math
