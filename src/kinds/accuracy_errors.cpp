// Errors of settings against what the reference meshes tend to.
#include "launchsafe/kinds/accuracy.hpp"
#include "launchsafe/trace/bottom_trace.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

/// One quantity on all meshes.
template <class Quantity>
ReferenceValue over_meshes(const std::vector<AccuracyMeasurement>& meshes, Quantity quantity) {
  std::vector<double> values, sizes;
  for (const AccuracyMeasurement& mesh : meshes) {
    values.push_back(quantity(mesh));
    sizes.push_back(mesh.cell);
  }
  return reference_value(std::move(values), sizes);
}

}  // namespace

double compared_temperature(const AccuracyMeasurement& measured, std::size_t gap, bool inert) {
  return inert ? measured.heated[gap] : measured.temperature[gap];
}

double relative_difference(const PressureTrace& p, const PressureTrace& q) {
  if (p.time.size() < 2 || q.time.size() < 2) return not_a_number;
  const double end = std::min(p.time.back(), q.time.back());
  double difference = 0.0, whole = 0.0;
  for (std::size_t i = 1; i < q.time.size() && q.time[i] <= end * (1.0 + 1e-12); ++i) {
    // The trapezoidal rule over the samples of q.
    for (const std::size_t k : {i - 1, i}) {
      const double half = 0.5 * (q.time[i] - q.time[i - 1]);
      const double off = trace::interpolate(p.time, p.pressure, q.time[k]) - q.pressure[k];
      difference += half * off * off;
      whole += half * q.pressure[k] * q.pressure[k];
    }
  }
  return std::sqrt(difference / whole);
}

AccuracyReference reference_of(const std::vector<AccuracyMeasurement>& meshes, std::size_t gaps,
                               const std::vector<bool>& inert) {
  AccuracyReference reference;
  reference.inert = inert;
  for (std::size_t gap = 0; gap < gaps; ++gap) {
    reference.temperature.push_back(over_meshes(meshes, [&](const AccuracyMeasurement& mesh) {
      return compared_temperature(mesh, gap, inert[gap]);
    }));
    reference.ignition_time.push_back(
        over_meshes(meshes, [&](const AccuracyMeasurement& mesh) { return mesh.ignition_time[gap]; }));
  }
  reference.critical_gap = over_meshes(meshes, [](const AccuracyMeasurement& mesh) {
    return mesh.critical.kind == CriticalGapKind::value ? mesh.critical.value : not_a_number;
  });
  reference.peak_pressure =
      over_meshes(meshes, [](const AccuracyMeasurement& mesh) { return mesh.peak_pressure; });
  for (std::size_t i = 0; i < meshes.front().at_times.size(); ++i) {
    reference.at_times.push_back(
        over_meshes(meshes, [i](const AccuracyMeasurement& mesh) { return mesh.at_times[i]; }));
  }
  for (std::size_t i = 0; i < meshes.front().points.size(); ++i) {
    reference.points.push_back(
        over_meshes(meshes, [i](const AccuracyMeasurement& mesh) { return mesh.points[i].temperature; }));
  }
  reference.bottom = meshes.front().bottom;
  return reference;
}

AccuracyRow row_against(const AccuracyReference& reference, const AccuracyMeasurement& measured) {
  AccuracyRow row;
  row.measured = measured;
  row.largest_temperature_error = row.temperature_bound = not_a_number;
  row.critical_gap_error = row.critical_gap_bound = not_a_number;
  row.pressure_error = row.peak_pressure_error = not_a_number;
  if (!measured.failure.empty()) return row;
  row.largest_temperature_error = row.temperature_bound = 0.0;
  for (std::size_t gap = 0; gap < reference.temperature.size(); ++gap) {
    const double value = compared_temperature(measured, gap, reference.inert[gap]);
    row.temperature_error.push_back(error_against(reference.temperature[gap], value));
    row.largest_temperature_error =
        larger_bound(row.largest_temperature_error, std::abs(row.temperature_error.back()));
    row.temperature_bound =
        larger_bound(row.temperature_bound, bound_against(reference.temperature[gap], value));
    row.ignition_time_error.push_back(
        error_against(reference.ignition_time[gap], measured.ignition_time[gap]));
  }
  if (measured.critical.kind == CriticalGapKind::value) {
    row.critical_gap_error = error_against(reference.critical_gap, measured.critical.value);
    row.critical_gap_bound = bound_against(reference.critical_gap, measured.critical.value);
  }
  row.pressure_error = relative_difference(measured.bottom, reference.bottom);
  row.peak_pressure_error = error_against(reference.peak_pressure, measured.peak_pressure) /
                            std::abs(reference.peak_pressure.limit.value);
  for (std::size_t i = 0; i < reference.at_times.size(); ++i)
    row.error_at_times.push_back(error_against(reference.at_times[i], measured.at_times[i]));
  return row;
}

void mark_front(std::vector<AccuracyRow>& rows) {
  const auto counts = [](const AccuracyRow& row) {
    return row.sound() && !row.other_model && std::isfinite(row.largest_temperature_error);
  };
  for (AccuracyRow& row : rows) {
    row.on_front = counts(row) && std::none_of(rows.begin(), rows.end(), [&](const AccuracyRow& other) {
                     return counts(other) && other.measured.processor_time < row.measured.processor_time &&
                            other.largest_temperature_error <= row.largest_temperature_error;
                   });
  }
}

}  // namespace launchsafe::kinds
