#include "launchsafe/trace/bottom_trace.hpp"

#include "launchsafe/math/numbers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace launchsafe::trace {
namespace {

/// Means over the longer intervals: the old means weighted by their lengths.
std::vector<double> combined_means(const std::vector<double>& time, const std::vector<double>& means,
                                   const std::vector<std::size_t>& kept) {
  std::vector<double> result;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const std::size_t before = k > 0 ? kept[k - 1] : kept[k];
    double weighted = 0.0;
    for (std::size_t sample = before + 1; sample <= kept[k]; ++sample)
      weighted += (time[sample] - time[sample - 1]) * means[sample];
    result.push_back(before == kept[k] ? means[kept[k]] : weighted / (time[kept[k]] - time[before]));
  }
  return result;
}

std::vector<double> picked_rows(const std::vector<double>& values, std::size_t width,
                                const std::vector<std::size_t>& kept) {
  std::vector<double> result;
  if (values.empty()) return result;  // not traced
  for (const std::size_t sample : kept) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(sample * width);
    result.insert(result.end(), begin, begin + static_cast<std::ptrdiff_t>(width));
  }
  return result;
}

BottomTrace with_samples(const BottomTrace& trace, const std::vector<std::size_t>& kept) {
  BottomTrace result = trace;
  for (auto* values : {&result.time, &result.chamber_pressure, &result.bottom_pressure})
    *values = picked_rows(*values, 1, kept);
  result.mean_bottom_pressure = combined_means(trace.time, result.mean_bottom_pressure, kept);
  result.friction = picked_rows(trace.friction, trace.stations.size(), kept);
  return result;
}

constexpr std::array histories{&BottomTrace::chamber_pressure, &BottomTrace::bottom_pressure,
                               &BottomTrace::mean_bottom_pressure, &BottomTrace::friction};

/// Whether two launches have the same stations and samples.
bool are_alike(const BottomTrace& a, const BottomTrace& b) {
  if (a.stations.size() != b.stations.size() || a.samples() != b.samples()) return false;
  return std::ranges::all_of(histories,
                             [&](const auto history) { return (a.*history).size() == (b.*history).size(); });
}

}  // namespace

BottomTrace of_rings(BottomTrace trace) {
  const std::vector<Station> stations = trace.stations;
  std::erase_if(trace.stations, &Station::observation);
  const std::vector<double> whole = std::exchange(trace.friction, {});
  for (std::size_t i = 0; i < whole.size(); ++i)
    if (!stations[i % stations.size()].observation) trace.friction.push_back(whole[i]);
  return trace;
}

BottomTrace until(const BottomTrace& trace, double time) {
  constexpr double round_off = 1e-12;  // s
  std::vector<std::size_t> kept;
  for (std::size_t sample = 0; sample < trace.samples() && trace.time[sample] <= time + round_off; ++sample)
    kept.push_back(sample);
  return with_samples(trace, kept);
}

BottomTrace stretched(BottomTrace trace, double factor) {
  for (double& time : trace.time) time *= factor;
  return trace;
}

std::optional<BottomTrace> mirrored(const BottomTrace& trace, const BottomTrace& other) {
  if (!are_alike(trace, other)) return std::nullopt;
  BottomTrace result = trace;
  for (const auto history : histories) {
    std::vector<double>& values = result.*history;
    const std::vector<double>& others = other.*history;
    for (std::size_t k = 0; k < values.size(); ++k)
      if (others[k] > 0.0) values[k] *= values[k] / others[k];
  }
  return result;
}

double interpolate(const std::vector<double>& time, const std::vector<double>& value, double t) {
  if (time.empty() || time.size() != value.size() || std::isnan(t)) return math::not_a_number;
  if (t <= time.front()) return value.front();
  if (t >= time.back()) return value.back();
  const auto after = static_cast<std::size_t>(std::upper_bound(time.begin(), time.end(), t) - time.begin());
  const double share = (t - time[after - 1]) / (time[after] - time[after - 1]);
  return value[after - 1] + share * (value[after] - value[after - 1]);
}

}  // namespace launchsafe::trace
