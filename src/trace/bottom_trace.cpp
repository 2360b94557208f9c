#include "launchsafe/trace/bottom_trace.hpp"

#include "launchsafe/math/numbers.hpp"

#include <algorithm>

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
  if (values.empty()) return result;  // a closure that was not traced
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
  for (auto* means : {&result.mean_chamber_pressure, &result.mean_bottom_pressure})
    *means = combined_means(trace.time, *means, kept);
  for (auto& energy : result.friction) energy = picked_rows(energy, trace.stations.size(), kept);
  return result;
}

constexpr std::array pressures{&BottomTrace::chamber_pressure, &BottomTrace::bottom_pressure,
                               &BottomTrace::mean_chamber_pressure, &BottomTrace::mean_bottom_pressure};
/// All pressures and energies of a trace: so many histories, with as many values at each sample or as many a
/// station.
constexpr std::size_t histories = pressures.size() + traced_closures;

template <class Trace>
auto& history(Trace& trace, std::size_t index) {
  return index < pressures.size() ? trace.*pressures[index] : trace.friction[index - pressures.size()];
}

/// Whether two launches have the same stations and closures, and as many samples unless `resampled`.
bool are_alike(const BottomTrace& a, const BottomTrace& b, bool resampled = false) {
  if (a.stations.size() != b.stations.size() || (!resampled && a.samples() != b.samples())) return false;
  for (std::size_t i = 0; i < histories; ++i)
    if (history(a, i).size() * b.samples() != history(b, i).size() * a.samples()) return false;
  return true;
}

/// Linear between samples, and constant beyond the last.
BottomTrace sampled_at(const std::vector<double>& times, const BottomTrace& trace) {
  BottomTrace result = trace;
  result.time = times;
  for (std::size_t i = 0; i < histories; ++i) history(result, i).clear();
  std::size_t after = 0;
  for (const double time : times) {
    while (after + 1 < trace.samples() && trace.time[after] < time) ++after;
    const std::size_t before = after > 0 ? after - 1 : 0;
    const double interval = trace.time[after] - trace.time[before];
    const double share = interval > 0.0 ? std::clamp((time - trace.time[before]) / interval, 0.0, 1.0) : 0.0;
    for (std::size_t i = 0; i < histories; ++i) {
      const std::vector<double>& values = history(trace, i);
      const std::size_t width = values.size() / trace.samples();
      for (std::size_t k = 0; k < width; ++k)
        history(result, i).push_back(std::lerp(values[before * width + k], values[after * width + k], share));
    }
  }
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
  const std::vector<Station> stations = trace.stations;
  std::erase_if(trace.stations, &Station::observation);
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
  return trace;
}

std::optional<BottomTrace> mirrored(const BottomTrace& trace, const BottomTrace& other) {
  if (!are_alike(trace, other)) return std::nullopt;
  BottomTrace result = trace;
  for (std::size_t i = 0; i < histories; ++i) {
    std::vector<double>& values = history(result, i);
    const std::vector<double>& others = history(other, i);
    for (std::size_t k = 0; k < values.size(); ++k)
      if (others[k] > 0.0) values[k] *= values[k] / others[k];
  }
  return result;
}

std::optional<BottomTrace> at_load(double load, const LoadedTrace& own, const LoadedTrace& other,
                                   const LoadedTrace& third) {
  if (own.trace.samples() < 2) return std::nullopt;
  const double interval = own.trace.time.back() / static_cast<double>(own.trace.samples() - 1);
  for (const LoadedTrace* each : {&other, &third})
    if (each->trace.samples() < 2 || !are_alike(own.trace, each->trace, true) ||
        std::abs(each->trace.time.back() - own.trace.time.back()) > interval)
      return std::nullopt;
  const BottomTrace of_other = sampled_at(own.trace.time, other.trace),
                    of_third = sampled_at(own.trace.time, third.trace);
  const std::array launches{own, LoadedTrace{other.load, of_other}, LoadedTrace{third.load, of_third}};
  std::array ordered{&launches[0], &launches[1], &launches[2]};
  std::ranges::sort(ordered, {}, &LoadedTrace::load);
  const auto [lowest, middle, highest] = ordered;
  const double share = (load - own.load) / (other.load - own.load);
  const double middle_share = (middle->load - lowest->load) / (highest->load - lowest->load);
  // Of a leap between own and other the middle one shows this share; all of it must be on top of the line.
  const double seen = middle == &launches[0] ? middle_share : 1.0 - middle_share;
  const double weight = std::max(1.0, (1.0 - share) / seen);
  BottomTrace result = own.trace;
  for (std::size_t i = 0; i < histories; ++i) {
    std::vector<double>& values = history(result, i);
    const std::vector<double>&others = history(of_other, i), &low = history(lowest->trace, i),
          &between = history(middle->trace, i), &high = history(highest->trace, i);
    const std::size_t width = values.size() / std::max<std::size_t>(result.samples(), 1);
    std::vector<double> missed(width, 0.0);  // so far, of each station
    for (std::size_t k = 0; k < values.size(); ++k) {
      double& most = missed[k % width];
      most = std::max(most, std::abs(between[k] - std::lerp(low[k], high[k], middle_share)));
      values[k] = std::lerp(values[k], others[k], share) + weight * most;
    }
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
