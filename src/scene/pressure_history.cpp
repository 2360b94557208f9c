// The chamber pressure over time: an analytic shape, or a measured curve, smoothed where the scene asks for
// it.
#include "launchsafe/scene/load_roughness.hpp"
#include "launchsafe/scene/scene.hpp"

// clang-format off
#include <math.h>  // Boost 1.74's pchip.hpp calls ::isnan without including it, so this comes first.
#include <boost/math/interpolators/pchip.hpp>
#include <boost/math/tools/minima.hpp>
// clang-format on

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace launchsafe::scene {
namespace {

/// Straight lines through the points of a curve too short for a spline.
std::function<double(double)> straight_lines(std::vector<double> time, std::vector<double> pressure) {
  return [time = std::move(time), pressure = std::move(pressure)](double t) {
    const auto after = std::upper_bound(time.begin(), time.end() - 1, t);
    const auto i = static_cast<std::size_t>(after - time.begin());
    const double share = (t - time[i - 1]) / (time[i] - time[i - 1]);
    return pressure[i - 1] + share * (pressure[i] - pressure[i - 1]);
  };
}

std::function<double(double)> interpolant(std::vector<double> time, std::vector<double> pressure) {
  if (time.size() < 4) return straight_lines(std::move(time), std::move(pressure));
  return boost::math::interpolators::pchip<std::vector<double>>(std::move(time), std::move(pressure));
}

/// A curve's moving average over a window (s), its ends mirrored, so that the impulse from the first point to
/// the last stays what it was, and nothing is delayed. The integral over the window is exact: the curve is
/// cubic between its points, which Simpson's rule integrates exactly.
class MovingAverage {
 public:
  MovingAverage(std::vector<double> time, std::function<double(double)> curve, double window)
      : time_(std::move(time)), curve_(std::move(curve)), window_(window), impulse_{0.0} {
    assert(window >= least_smoothing_share * (time_.back() - time_.front()));
    assert(window <= time_.back() - time_.front());
    for (std::size_t i = 0; i + 1 < time_.size(); ++i)
      impulse_.push_back(impulse_[i] + simpson(time_[i], time_[i + 1]));
  }

  /// At a time between the first point and the last. A sum of pressures is none below 0 but by round-off.
  double operator()(double t) const {
    return std::max(0.0, (mirrored(t + 0.5 * window_) - mirrored(t - 0.5 * window_)) / window_);
  }

 private:
  double simpson(double begin, double end) const {
    return (end - begin) / 6.0 * (curve_(begin) + 4.0 * curve_(0.5 * (begin + end)) + curve_(end));
  }

  /// Integral (Pa s) from the first point to a time between the first and the last.
  double integral(double t) const {
    const auto after = std::upper_bound(time_.begin() + 1, time_.end() - 1, t);
    const auto i = static_cast<std::size_t>(after - time_.begin()) - 1;
    return impulse_[i] + simpson(time_[i], t);
  }

  /// The same of the curve continued by its mirror images; the window is at most twice as long as the curve.
  double mirrored(double t) const {
    const double first = time_.front(), last = time_.back();
    if (t < first) return -integral(std::min(2.0 * first - t, last));
    if (t > last) return 2.0 * impulse_.back() - integral(std::max(2.0 * last - t, first));
    return integral(t);
  }

  std::vector<double> time_;
  std::function<double(double)> curve_;
  double window_;
  std::vector<double> impulse_;  ///< Pa s, from the first point to each
};

/// Times from `begin` to `end` (s) between which a curve has at most one maximum, about: those of its points,
/// and those at which a point enters or leaves the window of its average.
std::vector<double> marks_between(const Load& load, double begin, double end) {
  std::vector<double> marks{begin, end};
  const auto add = [&](double time) {
    if (time > begin && time < end) marks.push_back(time);
  };
  for (const double time : load.curve_time) {
    add(time);
    if (load.smoothing > 0.0) add(time - 0.5 * load.smoothing);
    if (load.smoothing > 0.0) add(time + 0.5 * load.smoothing);
  }
  std::ranges::sort(marks);
  return marks;
}

/// Largest value at the marks and, where an average may be larger between them, beside the largest mark,
/// after the time at which it is.
std::pair<double, double> largest_at(const std::vector<double>& marks,
                                     const std::function<double(double)>& pressure, bool smoothed) {
  std::size_t best = 0;
  std::vector<double> values;
  for (const double mark : marks) values.push_back(pressure(mark));
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] > values[best]) best = i;
  const std::pair<double, double> at_mark{marks[best], values[best]};
  if (!smoothed || marks.size() < 2) return at_mark;
  const double begin = marks[best > 0 ? best - 1 : 0], end = marks[std::min(best + 1, marks.size() - 1)];
  constexpr int digits = std::numeric_limits<double>::digits / 2;
  const auto below =
      boost::math::tools::brent_find_minima([&](double t) { return -pressure(t); }, begin, end, digits);
  return -below.second > values[best] ? std::pair{below.first, -below.second} : at_mark;
}

/// Of the analytic shapes: the pressure over the base as a share of that at the peak.
double share_of_peak(const Load& load, double time) {
  if (load.shape == LoadShape::bell)
    return std::exp(-std::pow(std::abs((time - load.peak_time) / load.width), load.steepness));
  if (time <= 0.0) return 0.0;
  const double ratio = time / load.peak_time;
  return std::exp(load.exponent * (std::log(ratio) + 1.0 - ratio));
}

}  // namespace

PressureHistory::PressureHistory(const Load& load) : load_(load) {
  if (load_.curve_time.size() >= 2) {
    curve_ = interpolant(load_.curve_time, load_.curve_pressure);
    const bool smoothed = load_.smoothing > 0.0;
    if (smoothed) curve_ = MovingAverage(load_.curve_time, std::move(curve_), load_.smoothing);
    if (load_.rescale_to_peak) {
      const auto marks = marks_between(load_, load_.curve_time.front(), load_.curve_time.back());
      const double largest = largest_at(marks, curve_, smoothed).second;
      if (largest > 0.0) scale_ = load_.peak / largest;
    }
  }
  const std::optional<double> exit = exit_time(load_);
  if (!exit) return;
  exit_ = *exit;
  exit_pressure_ = in_the_barrel(exit_);
  pressure_outside_ = load_.curve_time.empty() ? load_.base : 0.0;
}

double PressureHistory::at(double time) const {
  if (!(time > exit_)) return in_the_barrel(time);
  return pressure_outside_ +
         (exit_pressure_ - pressure_outside_) * std::exp(-(time - exit_) / load_.exit_decay);
}

double PressureHistory::in_the_barrel(double time) const {
  if (load_.curve_time.empty()) return load_.base + (load_.peak - load_.base) * share_of_peak(load_, time);
  if (!curve_) return scale_ * load_.curve_pressure.front();
  const double first = load_.curve_time.front(), last = load_.curve_time.back();
  // An interpolant's round-off at its ends is that of the average; without one the points are met exactly.
  if (load_.smoothing > 0.0) return scale_ * curve_(std::clamp(time, first, last));
  if (time <= first) return scale_ * load_.curve_pressure.front();
  if (time >= last) return scale_ * load_.curve_pressure.back();
  return scale_ * curve_(time);
}

std::vector<double> PressureHistory::marks() const {
  const double end = end_time(load_);
  std::vector<double> marks = marks_between(load_, 0.0, end);
  if (exit_ > 0.0 && exit_ < end) marks.insert(std::upper_bound(marks.begin(), marks.end(), exit_), exit_);
  return marks;
}

std::pair<double, double> PressureHistory::largest() const {
  if (load_.curve_time.empty()) {
    const double time = std::min({load_.peak_time, end_time(load_), exit_});
    return {time, at(time)};
  }
  return largest_at(
      marks(), [this](double t) { return at(t); }, load_.smoothing > 0.0);
}

double PressureHistory::stated_peak() const {
  if (load_.curve_time.empty()) return load_.peak;
  return scale_ * *std::ranges::max_element(load_.curve_pressure);
}

}  // namespace launchsafe::scene
