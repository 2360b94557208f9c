#include "launchsafe/study/surrogate.hpp"

#include "launchsafe/math/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace launchsafe::study {
namespace {

using Kind = math::Distribution::Kind;

const math::Distribution& standard_normal() {
  static const auto normal = math::Distribution::normal(0.0, 1.0);
  return normal;
}

/// Of the launches that were fitted those that have a number.
std::vector<double> fitted_points(const SurrogateRecord& record, const SurrogateOutput& output) {
  std::vector<double> points;
  for (std::size_t row = 0; row < record.fitted; ++row) {
    if (!std::isfinite(output.values[row])) continue;
    const auto point = math::point_of_row(record.points, row, record.keys.size());
    points.insert(points.end(), point.begin(), point.end());
  }
  return points;
}

}  // namespace

std::vector<double> UncertainInputs::values_at(const std::vector<double>& point) const {
  std::vector<double> values;
  for (std::size_t i = 0; i < distributions.size(); ++i)
    values.push_back(math::quantile(distributions[i], point[i]));
  if (!correlated) return values;
  for (std::size_t i = 0; i < correlated->count; ++i) {
    double logarithm = 0.0;
    for (std::size_t j = 0; j <= i; ++j)
      logarithm += correlated->factor[i * correlated->count + j] *
                   math::quantile(standard_normal(), point[correlated->first + j]);
    values[correlated->first + i] = distributions[correlated->first + i].centre * std::exp(logarithm);
  }
  return values;
}

std::vector<double> UncertainInputs::point_of(const std::vector<double>& values) const {
  std::vector<double> point;
  for (std::size_t i = 0; i < distributions.size(); ++i)
    point.push_back(math::cumulative(distributions[i], values[i]));
  if (!correlated) return point;
  // The factor is triangular.
  std::vector<double> normal;
  for (std::size_t i = 0; i < correlated->count; ++i) {
    const std::size_t input = correlated->first + i;
    double rest = std::log(values[input] / distributions[input].centre);
    for (std::size_t j = 0; j < i; ++j) rest -= correlated->factor[i * correlated->count + j] * normal[j];
    normal.push_back(rest / correlated->factor[i * correlated->count + i]);
    point[input] = math::cumulative(standard_normal(), normal.back());
  }
  return point;
}

std::vector<math::ChaosBasis> UncertainInputs::bases() const {
  std::vector<math::ChaosBasis> bases;
  for (const math::Distribution& each : distributions)
    bases.push_back(each.kind == Kind::normal || each.kind == Kind::log_normal ? math::ChaosBasis::hermite
                                                                               : math::ChaosBasis::legendre);
  return bases;
}

const SurrogateOutput* SurrogateRecord::predicted(const std::string& name) const {
  const auto found = std::ranges::find(outputs, name, &SurrogateOutput::name);
  return found == outputs.end() || !found->reason.empty() ? nullptr : &*found;
}

Surrogate::Surrogate(const SurrogateRecord& record, const SurrogateOutput& output)
    : fit_(output.fit, fitted_points(record, output)) {
  constexpr double share = 0.99, confidence = 0.95;
  double sum = 0.0, largest = 0.0;
  int held_out = 0;
  for (std::size_t row = record.fitted; row < output.values.size(); ++row) {
    if (!std::isfinite(output.values[row])) continue;
    const auto [value, leverage] = fit_.at(math::point_of_row(record.points, row, record.keys.size()));
    const double miss = std::abs(value - output.values[row]) / std::sqrt(1.0 + leverage);
    sum += miss;
    largest = std::max(largest, miss);
    largest_leverage_ = std::max(largest_leverage_, leverage);
    ++held_out;
  }
  error_ =
      std::max(largest, math::exponential_tolerance_factor(held_out, share, confidence) * sum / held_out);
}

Prediction Surrogate::at(const std::vector<double>& point) const {
  const auto [value, leverage] = fit_.at(point);
  return {value, error_ * std::sqrt(1.0 + leverage), leverage <= largest_leverage_};
}

InputRange range_of(const SurrogateRecord& record, std::size_t input) {
  const math::Distribution& distribution = record.inputs.distributions[input];
  if (record.inputs.bases()[input] == math::ChaosBasis::legendre)
    return {distribution.lower, distribution.upper};
  InputRange range;
  for (std::size_t row = 0; row < record.fitted; ++row) {
    const double value =
        record.inputs.values_at(math::point_of_row(record.points, row, record.keys.size()))[input];
    range = row == 0 ? InputRange{value, value}
                     : InputRange{std::min(range.lower, value), std::max(range.upper, value)};
  }
  return range;
}

PredictedIgnitions predicted_ignitions(const SurrogateRecord& record, double gap,
                                       const std::vector<std::optional<double>>& fixed) {
  constexpr std::uint64_t seed = 1;
  PredictedIgnitions ignitions{.draws = 4096};
  const Surrogate critical_gap(record, *record.predicted("critical_gap"));
  const std::size_t inputs = record.keys.size();
  const std::vector<double> points =
      math::unit_points(math::Design::scrambled_sobol, ignitions.draws, inputs, seed);
  for (std::size_t row = 0; row < ignitions.draws; ++row) {
    std::vector<double> point = math::point_of_row(points, row, inputs);
    for (std::size_t i = 0; i < inputs; ++i) point[i] = fixed[i].value_or(point[i]);
    const Prediction predicted = critical_gap.at(point);
    ignitions.at_least += predicted.value + predicted.error <= gap;
    ignitions.predicted += predicted.value <= gap;
    ignitions.at_most += predicted.value - predicted.error <= gap;
    ignitions.uncovered += !predicted.covered;
  }
  return ignitions;
}

}  // namespace launchsafe::study
