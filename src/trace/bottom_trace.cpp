#include "launchsafe/trace/bottom_trace.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace launchsafe::trace {

namespace {

/// Means over the longer intervals: the old means weighted by their lengths.
std::vector<double> combined_means(const std::vector<double>& time, const std::vector<double>& means,
                                   const std::vector<std::size_t>& kept) {
  std::vector<double> result;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (k == 0 || kept[k] == kept[k - 1]) {
      result.push_back(means[kept[k]]);
      continue;
    }
    double weighted = 0.0;
    for (std::size_t sample = kept[k - 1] + 1; sample <= kept[k]; ++sample) {
      weighted += (time[sample] - time[sample - 1]) * means[sample];
    }
    result.push_back(weighted / (time[kept[k]] - time[kept[k - 1]]));
  }
  return result;
}

std::vector<double> picked_rows(const std::vector<double>& values, std::size_t width,
                                const std::vector<std::size_t>& kept) {
  std::vector<double> result;
  if (values.empty()) return result;  // a closure that was not traced
  for (const std::size_t sample : kept) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(sample * width);
    result.insert(result.end(), begin, begin + static_cast<std::ptrdiff_t>(width));
  }
  return result;
}

BottomTrace with_samples(const BottomTrace& trace, const std::vector<std::size_t>& kept) {
  BottomTrace result = trace;
  for (auto* values : {&result.time, &result.chamber_pressure, &result.bottom_pressure, &result.steps})
    *values = picked_rows(*values, 1, kept);
  for (auto* means : {&result.mean_chamber_pressure, &result.mean_bottom_pressure})
    *means = combined_means(trace.time, *means, kept);
  for (auto& energy : result.friction) energy = picked_rows(energy, trace.stations.size(), kept);
  return result;
}

}  // namespace

BottomTrace thinned(const BottomTrace& trace) {
  std::vector<std::size_t> kept;
  for (std::size_t sample = 0; sample < trace.samples(); sample += 2) kept.push_back(sample);
  if (trace.samples() % 2 == 0 && trace.samples() > 0) kept.push_back(trace.samples() - 1);
  return with_samples(trace, kept);
}

BottomTrace of_rings(BottomTrace trace) {
  const std::vector<Station> stations = std::move(trace.stations);
  trace.stations.clear();
  for (const Station& station : stations)
    if (!station.observation) trace.stations.push_back(station);
  for (std::vector<double>& energy : trace.friction) {
    const std::vector<double> whole = std::move(energy);
    energy.clear();
    for (std::size_t i = 0; i < whole.size(); ++i)
      if (!stations[i % stations.size()].observation) energy.push_back(whole[i]);
  }
  return trace;
}

BottomTrace until(const BottomTrace& trace, double time) {
  constexpr double round_off = 1e-12;  // s
  std::vector<std::size_t> kept;
  for (std::size_t sample = 0; sample < trace.samples() && trace.time[sample] <= time + round_off; ++sample)
    kept.push_back(sample);
  return with_samples(trace, kept);
}

BottomTrace delayed(const BottomTrace& trace, double instant, double delay) {
  constexpr double round_off = 1e-12;  // s
  std::vector<std::size_t> kept;
  std::size_t moved = 0;  // the first sample that comes later or sooner
  for (std::size_t sample = 0; sample < trace.samples(); ++sample) {
    const bool before = trace.time[sample] < instant - round_off;
    if (before && delay < 0.0 && trace.time[sample] > instant + delay - round_off) continue;
    if (before) moved = kept.size() + 1;
    kept.push_back(sample);
  }
  if (moved == 0 || moved == kept.size()) return trace;
  // The state at the instant once more, from which it holds.
  if (delay > 0.0) kept.insert(kept.begin() + static_cast<std::ptrdiff_t>(moved), kept[moved]);
  BottomTrace result = with_samples(trace, kept);
  if (delay > 0.0) {
    ++moved;
    result.mean_chamber_pressure[moved] = result.chamber_pressure[moved];
    result.mean_bottom_pressure[moved] = result.bottom_pressure[moved];
  }
  for (std::size_t sample = moved; sample < result.samples(); ++sample) result.time[sample] += delay;
  return result;
}

BottomTrace stretched(BottomTrace trace, double factor) {
  for (double& time : trace.time) time *= factor;
  for (double& steps : trace.steps) steps *= factor;
  return trace;
}

std::optional<BottomTrace> mirrored(const BottomTrace& trace, const BottomTrace& other) {
  BottomTrace result = trace;
  bool same = trace.samples() == other.samples() && trace.stations.size() == other.stations.size();
  const auto mirror = [&same](std::vector<double>& values, const std::vector<double>& others) {
    same = same && values.size() == others.size();
    for (std::size_t i = 0; same && i < values.size(); ++i)
      if (others[i] > 0.0) values[i] *= values[i] / others[i];
  };
  for (const auto pressure : {&BottomTrace::chamber_pressure, &BottomTrace::bottom_pressure,
                              &BottomTrace::mean_chamber_pressure, &BottomTrace::mean_bottom_pressure})
    mirror(result.*pressure, other.*pressure);
  for (std::size_t closure = 0; closure < traced_closures; ++closure)
    mirror(result.friction[closure], other.friction[closure]);
  if (!same) return std::nullopt;
  return result;
}

double interpolate(const std::vector<double>& time, const std::vector<double>& value, double t) {
  if (time.empty() || time.size() != value.size() || std::isnan(t))
    return std::numeric_limits<double>::quiet_NaN();
  if (t <= time.front()) return value.front();
  if (t >= time.back()) return value.back();
  const auto after = static_cast<std::size_t>(std::upper_bound(time.begin(), time.end(), t) - time.begin());
  const double share = (t - time[after - 1]) / (time[after] - time[after - 1]);
  return value[after - 1] + share * (value[after] - value[after - 1]);
}

}  // namespace launchsafe::trace
