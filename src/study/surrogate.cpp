#include "launchsafe/study/surrogate.hpp"

#include "launchsafe/math/statistics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::study {
namespace {

using Kind = math::Distribution::Kind;

const math::Distribution& standard_normal() {
  static const auto normal = math::Distribution::normal(0.0, 1.0);
  return normal;
}

/// The launches that were fitted and have a number, by what was chosen.
std::variant<math::FittedChaos, math::FittedProcess> fitted(const SurrogateRecord& record,
                                                            const SurrogateOutput& output) {
  const math::FiniteRows all = record.fitted_rows(output.values);
  const math::FiniteRows rows = math::finite_rows(record.keys.size(), all.points, all.values);
  if (output.fit.by_process()) return math::FittedProcess(output.fit.process, rows.points, rows.values);
  return math::FittedChaos(output.fit.chaos, rows.points);
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

math::FiniteRows SurrogateRecord::fitted_rows(const std::vector<double>& values) const {
  math::FiniteRows rows;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (std::ranges::binary_search(held_out, row)) continue;
    const auto point = math::point_of_row(points, row, keys.size());
    rows.points.insert(rows.points.end(), point.begin(), point.end());
    rows.values.push_back(values[row]);
  }
  return rows;
}

const SurrogateOutput* SurrogateRecord::predicted(const std::string& name) const {
  const auto found = std::ranges::find(outputs, name, &SurrogateOutput::name);
  return found == outputs.end() || !found->reason.empty() ? nullptr : &*found;
}

void fit_output(const SurrogateRecord& record, SurrogateOutput& output, std::size_t fewest_held_out) {
  constexpr double most_unexplained = 0.1;
  const math::FiniteRows rows = record.fitted_rows(output.values);
  output.fit = {math::fit_chaos(record.inputs.bases(), rows.points, rows.values),
                math::fit_process(record.inputs.bases(), rows.points, rows.values)};
  output.error = {};
  output.reason = output.fit.chaos.reason;
  if (!output.reason.empty()) return;
  const math::FiniteRows known = math::finite_rows(record.keys.size(), rows.points, rows.values);
  const Surrogate surrogate(record, output);
  HeldOutError& error = output.error;
  double squares = 0.0, largest = 0.0;
  for (const std::size_t row : record.held_out) {
    if (!std::isfinite(output.values[row])) continue;
    const double miss = std::abs(
        surrogate.at(math::point_of_row(record.points, row, record.keys.size())).value - output.values[row]);
    squares += miss * miss;
    largest = std::max(largest, miss);
    ++error.launches;
  }
  if (error.launches < fewest_held_out) {
    output.reason =
        fmt::format("only {} evaluations that were not fitted have a number, at least {} are needed",
                    error.launches, fewest_held_out);
    return;
  }
  const double mean_square = squares / static_cast<double>(error.launches);
  error.root_mean_square = std::sqrt(mean_square);
  error.largest = largest;
  error.unexplained =
      mean_square * static_cast<double>(known.values.size()) / math::moments_of(known.values).squares;
  if (!(error.unexplained <= most_unexplained))
    output.reason = fmt::format("the fit misses {:.2g} % of the variance at evaluations that it has not seen",
                                100.0 * error.unexplained);
}

Surrogate::Surrogate(const SurrogateRecord& record, const SurrogateOutput& output)
    : fit_(fitted(record, output)) {
  constexpr double share = 0.99, confidence = 0.95;
  double sum = 0.0, largest = 0.0;
  int launches = 0;
  for (const std::size_t row : record.held_out) {
    if (!std::isfinite(output.values[row])) continue;
    const auto [value, leverage] = fitted_at(math::point_of_row(record.points, row, record.keys.size()));
    const double miss = std::abs(value - output.values[row]) / std::sqrt(1.0 + leverage);
    sum += miss;
    largest = std::max(largest, miss);
    largest_leverage_ = std::max(largest_leverage_, leverage);
    ++launches;
  }
  error_ =
      std::max(largest, math::exponential_tolerance_factor(launches, share, confidence) * sum / launches);
}

math::FitValue Surrogate::fitted_at(const std::vector<double>& point) const {
  return std::visit([&point](const auto& fit) { return fit.at(point); }, fit_);
}

Prediction Surrogate::at(const std::vector<double>& point) const {
  const auto [value, leverage] = fitted_at(point);
  return {value, error_ * std::sqrt(1.0 + leverage), leverage <= largest_leverage_};
}

double Surrogate::largest_error() const { return error_ * std::sqrt(1.0 + largest_leverage_); }

std::vector<double> least_sure_points(SurrogateRecord record, SurrogateOutput output, std::size_t count,
                                      std::uint64_t seed) {
  constexpr std::size_t draws = 512;
  const std::size_t inputs = record.keys.size();
  const std::vector<double> candidates = math::unit_points(math::Design::monte_carlo, draws, inputs, seed);
  std::vector<double> chosen;
  for (std::size_t i = 0; i < count; ++i) {
    const Surrogate surrogate(record, output);
    std::vector<double> worst;
    Prediction there{0.0, -1.0};
    for (std::size_t row = 0; row < draws; ++row) {
      const auto point = math::point_of_row(candidates, row, inputs);
      const Prediction prediction = surrogate.at(point);
      if (prediction.error <= there.error) continue;
      there = prediction;
      worst = point;
    }
    for (std::vector<double>* points : {&chosen, &record.points})
      points->insert(points->end(), worst.begin(), worst.end());
    output.values.push_back(there.value);
  }
  return chosen;
}

std::vector<math::Interval> ranges_of(const SurrogateRecord& record) {
  const std::size_t inputs = record.keys.size();
  std::vector<math::Interval> ranges(inputs, {math::infinity, -math::infinity});
  for (std::size_t row = 0; row < record.points.size() / inputs; ++row) {
    if (std::ranges::binary_search(record.held_out, row)) continue;
    const auto values = record.inputs.values_at(math::point_of_row(record.points, row, inputs));
    for (std::size_t i = 0; i < inputs; ++i)
      ranges[i] = {std::min(ranges[i].lower, values[i]), std::max(ranges[i].upper, values[i])};
  }
  const std::vector<math::ChaosBasis> bases = record.inputs.bases();
  for (std::size_t i = 0; i < inputs; ++i)
    if (bases[i] == math::ChaosBasis::legendre)
      ranges[i] = {record.inputs.distributions[i].lower, record.inputs.distributions[i].upper};
  return ranges;
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
