// The chamber pressure over time, an analytic shape or a measured curve, smoothed where the scene asks for
// it; how it drives the projectile, and when it is over.
#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/quantity.hpp"

#include <boost/math/quadrature/tanh_sinh.hpp>
#include <boost/math/tools/minima.hpp>

#include <complex>

namespace launchsafe::scene {

namespace {

/// Cubics through the points of a curve, monotone between neighbours (Fritsch and Butland); straight lines
/// through fewer than four points.
class Interpolant {
 public:
  Interpolant(std::vector<double> time, std::vector<double> pressure)
      : time_(std::move(time)), pressure_(std::move(pressure)) {
    const std::size_t last = time_.size() - 1;
    if (last < 3) return;
    slope_.assign(time_.size(), 0.0);
    slope_.front() = chord(0);
    slope_.back() = chord(last - 1);
    for (std::size_t i = 1; i < last; ++i) {
      const double before = chord(i - 1), after = chord(i);
      const bool turns = !(before > 0.0 && after > 0.0) && !(before < 0.0 && after < 0.0);
      if (turns) continue;
      const double left = 2.0 * length(i) + length(i - 1), right = length(i) + 2.0 * length(i - 1);
      slope_[i] = (left + right) / (left / before + right / after);
    }
  }

  const std::vector<double>& time() const { return time_; }

  /// Index of the point at or before a time between the first point and the last.
  std::size_t interval_of(double t) const {
    const auto next = std::upper_bound(time_.begin() + 1, time_.end() - 1, t);
    return static_cast<std::size_t>(next - time_.begin()) - 1;
  }

  double operator()(double t) const { return at(interval_of(t), t); }

  /// Integral (Pa s) from point i to a time before the next: Simpson's rule is exact for cubics.
  double integral(std::size_t i, double t) const {
    const double begin = time_[i];
    return (t - begin) / 6.0 * (pressure_[i] + 4.0 * at(i, 0.5 * (begin + t)) + at(i, t));
  }

 private:
  double length(std::size_t i) const { return time_[i + 1] - time_[i]; }
  double chord(std::size_t i) const { return (pressure_[i + 1] - pressure_[i]) / length(i); }

  double at(std::size_t i, double t) const {
    const double since = t - time_[i], share = since / length(i);
    if (slope_.empty()) return pressure_[i] + share * (pressure_[i + 1] - pressure_[i]);
    return (1.0 - share) * (1.0 - share) * (pressure_[i] * (1.0 + 2.0 * share) + slope_[i] * since) +
           share * share *
               (pressure_[i + 1] * (3.0 - 2.0 * share) + length(i) * slope_[i + 1] * (share - 1.0));
  }

  std::vector<double> time_, pressure_, slope_;
};

/// A curve's moving average over a window (s), its ends mirrored, so that the impulse from the first point to
/// the last stays what it was, and nothing is delayed. The integral over the window is exact.
class MovingAverage {
 public:
  MovingAverage(Interpolant curve, double window) : curve_(std::move(curve)), window_(window), impulse_{0.0} {
    const std::vector<double>& time = curve_.time();
    for (std::size_t i = 0; i + 1 < time.size(); ++i)
      impulse_.push_back(impulse_[i] + curve_.integral(i, time[i + 1]));
  }

  /// At a time between the first point and the last. A sum of pressures is none below 0 but by round-off.
  double operator()(double t) const {
    return std::max(0.0, (mirrored(t + 0.5 * window_) - mirrored(t - 0.5 * window_)) / window_);
  }

 private:
  /// Integral (Pa s) from the first point to a time between the first and the last.
  double integral(double t) const {
    const std::size_t i = curve_.interval_of(t);
    return impulse_[i] + curve_.integral(i, t);
  }

  /// The same of the curve continued by its mirror images; the window is at most twice as long as the curve.
  double mirrored(double t) const {
    const double first = curve_.time().front(), last = curve_.time().back();
    if (t < first) return -integral(std::min(2.0 * first - t, last));
    if (t > last) return 2.0 * impulse_.back() - integral(std::max(2.0 * last - t, first));
    return integral(t);
  }

  Interpolant curve_;
  double window_;
  std::vector<double> impulse_;  ///< Pa s, from the first point to each
};

constexpr double same_time = 1e-9;  // share, the round-off of times that were written in decimals

/// Times from `begin` to `end` (s) between which a load has at most one maximum, about, and is smooth: the
/// peak of an analytic shape, or the points of a curve, and where one enters or leaves the window of its
/// average; and the exit.
std::vector<double> marks_of(const Load& load, double begin, double end, std::optional<double> exit) {
  std::vector<double> marks{begin, end};
  const auto add = [&](double time) {
    if (time > begin && time < end) marks.push_back(time);
  };
  if (exit) add(*exit);
  if (load.curve_time.empty()) add(load.peak_time);
  std::ranges::sort(marks);
  std::vector<double> shifts{0.0};
  if (load.smoothing > 0.0) shifts.insert(shifts.end(), {-0.5 * load.smoothing, 0.5 * load.smoothing});
  for (const double shift : shifts) {
    const auto known = static_cast<std::ptrdiff_t>(marks.size());
    for (const double time : load.curve_time) add(time + shift);
    std::inplace_merge(marks.begin(), marks.begin() + known, marks.end());
  }
  return marks;
}

/// The time of the largest value at the marks and, where an average may be larger between them, beside the
/// largest mark; and that value.
std::pair<double, double> largest_at(const std::vector<double>& marks,
                                     const std::function<double(double)>& pressure, bool smoothed) {
  std::vector<double> values;
  for (const double mark : marks) values.push_back(pressure(mark));
  const auto best = static_cast<std::size_t>(std::ranges::max_element(values) - values.begin());
  if (!smoothed || marks.size() < 2) return {marks[best], values[best]};
  const double begin = marks[best > 0 ? best - 1 : 0], end = marks[std::min(best + 1, marks.size() - 1)];
  constexpr int digits = std::numeric_limits<double>::digits / 2;
  const auto below =
      boost::math::tools::brent_find_minima([&](double t) { return -pressure(t); }, begin, end, digits);
  if (-below.second > values[best]) return {below.first, -below.second};
  return {marks[best], values[best]};
}

/// Of the analytic shapes: the pressure over the base as a share of that at the peak.
double share_of_peak(const Load& load, double time) {
  if (load.shape == LoadShape::bell)
    return std::exp(-std::pow(std::abs((time - load.peak_time) / load.width), load.steepness));
  if (time <= 0.0) return 0.0;
  const double ratio = time / load.peak_time;
  return std::exp(load.exponent * (std::log(ratio) + 1.0 - ratio));
}

/// From where x - ln x = 1 + ln(1/share)/n on, ((t/t_m) exp(1 - t/t_m))^n with x = t/t_m stays below the
/// share. The root is approached from above, where Newton's method on a convex function cannot miss it.
double end_of_power_exponential(const Load& load) {
  const double excess = -std::log(share_when_over) / load.exponent;
  double ratio = 1.0 + excess + std::sqrt(2.0 * excess);
  constexpr int iterations = 60;
  for (int i = 0; i < iterations; ++i)
    ratio -= (ratio - std::log(ratio) - 1.0 - excess) / (1.0 - 1.0 / ratio);
  return load.peak_time * ratio;
}

double end_in_the_barrel(const Load& load) {
  if (!load.curve_time.empty()) return load.curve_time.back();
  if (load.shape == LoadShape::power_exponential) return end_of_power_exponential(load);
  return load.peak_time + load.width * std::pow(-std::log(share_when_over), 1.0 / load.steepness);
}

}  // namespace

PressureHistory::PressureHistory(const Load& load) : load_(load) {
  if (load.curve_time.size() > 1) {
    Interpolant through_points(load.curve_time, load.curve_pressure);
    if (load.smoothing > 0.0)
      curve_ = MovingAverage(std::move(through_points), load.smoothing);
    else
      curve_ = std::move(through_points);
  }
  if (curve_ && load.rescale_to_peak) {
    const auto marks = marks_of(load, load.curve_time.front(), load.curve_time.back(), {});
    const double largest_point = largest_at(marks, curve_, load.smoothing > 0.0).second;
    if (largest_point > 0.0) scale_ = load.peak / largest_point;
  }
  if (!load.muzzle_exit) return;
  exit_pressure_ = in_barrel(*load.muzzle_exit);
  pressure_outside_ = is_measured() ? 0.0 : load.base;
}

double PressureHistory::in_barrel(double time) const {
  if (!is_measured()) return load_.base + (load_.peak - load_.base) * share_of_peak(load_, time);
  if (!curve_) return scale_ * load_.curve_pressure.front();
  const double first = load_.curve_time.front(), last = load_.curve_time.back();
  // An interpolant's round-off at its ends is that of the average; without one the points are met exactly.
  if (load_.smoothing > 0.0) return scale_ * curve_(std::clamp(time, first, last));
  if (time <= first) return scale_ * load_.curve_pressure.front();
  if (time >= last) return scale_ * load_.curve_pressure.back();
  return scale_ * curve_(time);
}

double PressureHistory::at(double time) const {
  if (!(time > exit())) return in_barrel(time);
  return pressure_outside_ +
         (exit_pressure_ - pressure_outside_) * std::exp(-(time - exit()) / load_.exit_decay);
}

std::vector<double> PressureHistory::marks() const {
  return marks_of(load_, 0.0, load_.duration.value_or(launch_end()), load_.muzzle_exit);
}

RigidMotion PressureHistory::drive(double until) const {
  // Where an analytic shape has no derivative, or rises within a small share of the launch, is at the ends of
  // the parts, where this rule has most of its nodes: some 60 a part, and 1e-8 of the integral for
  // steepnesses from 0.3 to 100 and exponents from 0.1 to 1000.
  using boost::math::policies::domain_error, boost::math::policies::evaluation_error;
  constexpr auto ignored = boost::math::policies::ignore_error;  // of a load without end, which is refused
  static boost::math::quadrature::tanh_sinh<
      double, boost::math::policies::policy<domain_error<ignored>, evaluation_error<ignored>>>
      shape_rule;
  constexpr double tolerance = 1e-4;  // of its last step but one; each step squares the error
  // Gauss's rule of two nodes: a curve is cubic between its points, and of cubics it is exact.
  const auto curve_rule = [](const auto& push, double begin, double end) {
    const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin),
                 beside = half / std::numbers::sqrt3;
    return half * (push(middle - beside) + push(middle + beside));
  };
  const std::vector<double> marks = marks_of(load_, 0.0, until, load_.muzzle_exit);
  RigidMotion motion;
  for (std::size_t i = 1; i < marks.size(); ++i) {
    const double begin = marks[i - 1], end = marks[i];
    const auto push = [&](double time) { return std::complex(1.0, end - time) * at(time); };
    const std::complex<double> gained =
        is_measured() ? curve_rule(push, begin, end) : shape_rule.integrate(push, begin, end, tolerance);
    motion = {motion.velocity + gained.real(),
              motion.travel + motion.velocity * (end - begin) + gained.imag(), end};
  }
  return motion;
}

std::pair<double, double> PressureHistory::largest() const {
  if (is_measured())
    return largest_at(
        marks(), [this](double t) { return at(t); }, load_.smoothing > 0.0);
  const double time = std::min({load_.peak_time, load_.duration.value_or(launch_end()), exit()});
  return {time, at(time)};
}

double PressureHistory::stated_peak() const {
  return is_measured() ? scale_ * std::ranges::max(load_.curve_pressure) : load_.peak;
}

double PressureHistory::launch_end() const {
  if (!load_.muzzle_exit) return end_in_the_barrel(load_);
  const double height = stated_peak() - pressure_outside_;
  const double share = height > 0.0 ? (exit_pressure_ - pressure_outside_) / height : 0.0;
  return exit() + load_.exit_decay * std::log(std::max(1.0, share / share_when_over));
}

double launch_end(const Load& load) {
  return load.muzzle_exit ? PressureHistory(load).launch_end() : end_in_the_barrel(load);
}

double end_time(const Load& load) { return load.duration ? *load.duration : launch_end(load); }

double read_time(const Load& load) {
  const double end = end_time(load);
  return std::min(load.muzzle_exit.value_or(end), end);
}

double share_left(const Load& load, double time) {
  const PressureHistory history(load);
  // What an analytic load falls to when it is over, and a measured curve when the gauge's pressure is gone.
  const double base = load.curve_time.empty() ? load.base : 0.0, height = history.stated_peak() - base;
  return height > 0.0 ? (history.at(time) - base) / height : 0.0;
}

bool is_cut_short(const Load& load) {
  if (!load.duration || *load.duration >= launch_end(load) * (1.0 - same_time)) return false;
  if (load.curve_time.empty() || load.muzzle_exit) return true;
  // A gauge may have gone on after the pressure was gone.
  const PressureHistory history(load);
  const double over = share_when_over * history.stated_peak();
  return history.at(*load.duration) > over || std::ranges::any_of(load.curve_time, [&](double time) {
           return time > *load.duration && history.at(time) > over;
         });
}

Load without_exit(Load load) {
  load.muzzle_exit.reset();
  load.muzzle_travel.reset();
  return load;
}

namespace {

/// For people: motion and pressure at a time, s.
std::string launch_text(const Scene& scene, double time) {
  return fmt::format("{}, at {} with {:.3g} % of the peak pressure", rigid_motion_text(scene, time),
                     time_text(time), 100.0 * share_left(scene.load, time));
}

}  // namespace

std::string exit_text(const Scene& scene) {
  return scene.load.muzzle_exit ? launch_text(scene, *scene.load.muzzle_exit) : "";
}

std::string end_text(const Scene& scene) { return launch_text(scene, end_time(scene.load)); }

std::string launch_sentence(const Scene& scene) {
  return scene.load.muzzle_exit ? "The shot leaves the barrel with " + exit_text(scene) + "."
                                : "The load drives the shell to " + end_text(scene) + ".";
}

double peak_lost_to_smoothing(const Load& load) {
  if (load.curve_time.size() < 2 || !(load.smoothing > 0.0)) return 0.0;
  Load whole = without_exit(load);
  whole.duration.reset();
  const PressureHistory history(whole);
  const double before = history.stated_peak();
  return before > 0.0 ? std::max(0.0, 1.0 - history.peak() / before) : 0.0;
}

double peak_missed_between_points(const Load& load) {
  const auto &time = load.curve_time, &pressure = load.curve_pressure;
  if (time.size() < 4 || load.rescale_to_peak) return 0.0;
  const auto top = static_cast<std::size_t>(std::ranges::max_element(pressure) - pressure.begin());
  double missed = 0.0;
  for (std::size_t i = std::max<std::size_t>(top, 2) - 1; i <= std::min(top, time.size() - 3); ++i) {
    // Where the chords of the intervals before and after meet, s after the point i.
    const double rise = (pressure[i] - pressure[i - 1]) / (time[i] - time[i - 1]);
    const double fall = (pressure[i + 2] - pressure[i + 1]) / (time[i + 2] - time[i + 1]);
    const double length = time[i + 1] - time[i];
    const double meet = (pressure[i + 1] - pressure[i] - fall * length) / (rise - fall);
    if (meet > 0.0 && meet < length)
      missed = std::max(missed, (pressure[i] + rise * meet) / pressure[top] - 1.0);
  }
  return missed;
}

std::string smoothing_text(const Load& load) {
  if (!(load.smoothing > 0.0)) return {};
  const double before = PressureHistory(load).stated_peak(), lost = peak_lost_to_smoothing(load);
  return fmt::format("averaged over {}, which takes {:.3g} % from the peak: {} instead of {}",
                     time_text(load.smoothing), 100.0 * lost, pressure_text(before * (1.0 - lost)),
                     pressure_text(before));
}

}  // namespace launchsafe::scene
