#include "launchsafe/math/statistics.hpp"

#include <Eigen/Dense>
#include <unsupported/Eigen/NonLinearOptimization>

#include <algorithm>

namespace launchsafe::math {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

std::vector<double> listed(const VectorXd& values) { return {values.begin(), values.end()}; }

VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const VectorXd>(values.data(), static_cast<Index>(values.size()));
}

/// What Eigen's Levenberg-Marquardt asks for. A negative return value stops it.
class Problem {
 public:
  Problem(const ResidualsAtPoints& residuals, double step) : residuals_(residuals), step_(step) {}

  Index values() const { return count_; }

  int operator()(const VectorXd& point, VectorXd& values) {
    const auto found = at({listed(point)});
    if (!found) return -1;
    values = vector_of(found->front());
    count_ = values.size();
    return 0;
  }

  int df(const VectorXd& point, MatrixXd& jacobian) {
    std::vector<std::vector<double>> points{listed(point)};
    for (Index k = 0; k < point.size(); ++k) {
      points.push_back(points.front());
      points.back()[static_cast<std::size_t>(k)] += step_;
    }
    const auto found = at(points);
    if (!found) return -1;
    const VectorXd here = vector_of(found->front());
    jacobian.resize(here.size(), point.size());
    for (Index k = 0; k < point.size(); ++k)
      jacobian.col(k) = (vector_of((*found)[static_cast<std::size_t>(k) + 1]) - here) / step_;
    return 0;
  }

 private:
  std::optional<std::vector<std::vector<double>>> at(const std::vector<std::vector<double>>& points) {
    auto found = residuals_(points);
    return found && std::ranges::all_of(*found, all_finite) ? found : std::nullopt;
  }

  const ResidualsAtPoints& residuals_;
  double step_;
  Index count_ = 0;  ///< of residuals, known once they were computed
};

/// Of the unknowns and of the sum of squares, relative: derivatives by forward differences tell no more, and
/// what is published of a launch determines its numbers to half a per cent at best.
constexpr double settled = 1e-4;
constexpr double largest_condition = 1e6;

/// Jacobian, condition and covariance where the search ended.
void describe_minimum(NonlinearFit& fit, const MatrixXd& jacobian) {
  for (Index i = 0; i < jacobian.rows(); ++i) fit.jacobian.push_back(listed(jacobian.row(i)));
  const VectorXd singular = Eigen::JacobiSVD<MatrixXd>(jacobian).singularValues();
  fit.condition = singular(0) / singular(singular.size() - 1);
  const auto linear = least_squares(fit.jacobian, fit.residuals);
  if (!linear || !(fit.condition <= largest_condition))
    fit.failure = FitFailure::singular;
  else
    fit.covariance = linear->inverse_normal;
}

}  // namespace

double NonlinearFit::sum_of_squares() const { return math::sum_of_squares(residuals); }

NonlinearFit fit_nonlinear(const ResidualsAtPoints& residuals, const std::vector<double>& start,
                           double step) {
  using namespace Eigen::LevenbergMarquardtSpace;
  Problem problem(residuals, step);
  VectorXd point = vector_of(start), values;
  if (problem(point, values) < 0) return NonlinearFit{FitFailure::not_computable};
  if (values.size() < point.size()) return NonlinearFit{FitFailure::too_few_residuals};
  Eigen::LevenbergMarquardt<Problem> search(problem);
  search.parameters.ftol = search.parameters.xtol = settled;
  search.parameters.maxfev = 100;
  const Status status = search.minimize(point);
  if (status == UserAsked) return NonlinearFit{FitFailure::not_computable};
  if (status == TooManyFunctionEvaluation) return NonlinearFit{FitFailure::does_not_settle};
  NonlinearFit fit;
  fit.unknowns = listed(point);
  MatrixXd jacobian;
  if (problem(point, values) < 0 || problem.df(point, jacobian) < 0)
    return NonlinearFit{FitFailure::not_computable};
  fit.residuals = listed(values);
  describe_minimum(fit, jacobian);
  return fit;
}

}  // namespace launchsafe::math
