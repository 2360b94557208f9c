#include "sensitivity_chaos.hpp"

#include "launchsafe/run/model_version.hpp"
#include "sensitivity_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

namespace {

using study::Study, study::Axis, study::SurrogateRecord, study::UncertainInputs;

constexpr std::size_t fewest_held_out = 10;
constexpr double most_unexplained = 0.1;

/// How far a fit is off the evaluations from `fitted` on.
void find_error(const std::vector<double>& points, const std::vector<double>& values, std::size_t fitted,
                SurrogateFit& fit) {
  double squares = 0.0, largest = 0.0;
  for (std::size_t row = fitted; row < values.size(); ++row) {
    if (!std::isfinite(values[row])) continue;
    const double miss =
        std::abs(fit.chaos.at(math::point_of_row(points, row, fit.chaos.inputs.size())) - values[row]);
    squares += miss * miss;
    largest = std::max(largest, miss);
    ++fit.held_out;
  }
  if (fit.held_out == 0) return;
  const double mean_square = squares / static_cast<double>(fit.held_out);
  fit.error = std::sqrt(mean_square);
  fit.largest_error = largest;
  fit.unexplained = mean_square / fit.chaos.variance();
}

std::string why_no_indices(const SurrogateFit& fit) {
  if (fit.held_out < fewest_held_out)
    return fmt::format("only {} evaluations that were not fitted have a number, at least {} are needed",
                       fit.held_out, fewest_held_out);
  if (fit.unexplained <= most_unexplained) return {};
  return fmt::format("the fit misses {:.2g} % of the variance at evaluations that it has not seen",
                     100.0 * fit.unexplained);
}

void widen(math::Estimate& estimate, double by) {
  estimate.lower = std::max(0.0, estimate.lower - by);
  estimate.upper = std::min(1.0, estimate.upper + by);
}

}  // namespace

std::vector<double> chaos_points(const Study& study) {
  const SensitivitySettings& own = sensitivity_settings(study);
  const auto of = [&](math::Design design, int count, std::uint64_t seed) {
    return math::unit_points(design, static_cast<std::size_t>(count), study.axes.size(), seed);
  };
  std::vector<double> points = of(own.design, own.samples, own.seed);
  const std::vector<double> held_out = of(math::Design::monte_carlo, own.held_out, math::hashed(own.seed, 1));
  points.insert(points.end(), held_out.begin(), held_out.end());
  return points;
}

void estimate_by_chaos(const Study& study, OutputSensitivity& output) {
  const SensitivitySettings& own = sensitivity_settings(study);
  const std::vector<double> points = chaos_points(study);
  const auto fitted = static_cast<std::size_t>(own.samples);
  const std::vector<double> fitted_points(
      points.begin(), points.begin() + static_cast<std::ptrdiff_t>(fitted * study.axes.size()));
  const std::vector<double> values(output.values.begin(),
                                   output.values.begin() + static_cast<std::ptrdiff_t>(fitted));
  std::vector<std::size_t> begins;
  for (const SensitivityInput& input : inputs_of(study)) begins.push_back(input.first);
  begins.push_back(study.axes.size());
  SurrogateFit& fit = output.fit.emplace();
  fit.chaos = math::fit_chaos(uncertain_inputs(study).bases(), fitted_points, values);
  output.sobol = math::chaos_indices(
      fit.chaos, fitted_points, values, begins,
      {.level = own.confidence, .resamples = static_cast<std::size_t>(own.resamples), .seed = own.seed});
  output.reason = output.sobol.reason;
  if (!output.reason.empty()) return;
  find_error(points, output.values, fitted, fit);
  output.reason = why_no_indices(fit);
  for (math::InputIndices& each : output.sobol.inputs)
    for (math::Estimate* estimate : {&each.first, &each.total}) widen(*estimate, fit.unexplained);
}

SurrogateRecord surrogate_record(const SensitivityResult& result) {
  const Study& study = result.study.study;
  SurrogateRecord record{.model_version = run::model_version,
                         .scene = result.study.scene.scene,
                         .gap = study.gaps.front(),
                         .inputs = uncertain_inputs(study),
                         .fitted = static_cast<std::size_t>(sensitivity_settings(study).samples),
                         .points = chaos_points(study)};
  scene::clear_remarks(record.scene);
  for (const Axis& axis : study.axes) record.keys.push_back(axis.key.name);
  for (const OutputSensitivity& output : result.outputs) {
    if (output.output == SensitivityOutput::margin) continue;  // of T max and the ignition temperature
    record.outputs.push_back({.name = shown_output(output.output).column.name,
                              .inert = output.inert,
                              .values = output.values,
                              .reason = output.reason});
    if (output.fit) record.outputs.back().fit = output.fit->chaos;
  }
  return record;
}

}  // namespace launchsafe::kinds
