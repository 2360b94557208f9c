#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/quantity.hpp"

#include <complex>

namespace launchsafe::scene {
namespace {

/// Swings below this share of the peak are no feature of a launch.
constexpr double least_swing_share = 0.01;
/// A swing of more than this share of the peak is the launch itself.
constexpr double largest_swing_share = 0.5;
/// Swings of noise are smaller than this many of its standard deviations: from four below to four above.
constexpr double deviations_of_a_swing = 8.0;

/// Integral of p |dp| along a way that is monotonic between the given pressures.
double work_along(const std::vector<double>& pressures) {
  double work = 0.0;
  for (std::size_t i = 1; i < pressures.size(); ++i)
    work += 0.5 * std::abs(pressures[i] * pressures[i] - pressures[i - 1] * pressures[i - 1]);
  return work;
}

/// The turning points of a way, its ends included, without those of swings up to `least_swing`.
std::vector<double> without_small_swings(const std::vector<double>& pressures, double least_swing) {
  enum class Direction { unknown, up, down };
  std::vector<double> turns{pressures.front()};
  Direction direction = Direction::unknown;
  double high = pressures.front(), low = pressures.front();  // since the last turn
  for (const double pressure : pressures) {
    high = std::max(high, pressure);
    low = std::min(low, pressure);
    if (direction != Direction::down && high - pressure > least_swing) {
      if (direction == Direction::up) turns.push_back(high);
      direction = Direction::down;
      low = pressure;
    } else if (direction != Direction::up && pressure - low > least_swing) {
      if (direction == Direction::down) turns.push_back(low);
      direction = Direction::up;
      high = pressure;
    }
  }
  if (direction == Direction::up) turns.push_back(high);
  if (direction == Direction::down) turns.push_back(low);
  turns.push_back(pressures.back());
  return turns;
}

/// Deviation of a point from the cubic through two neighbours on either side, over what white noise of unit
/// deviation would make of it.
double deviation_from_neighbours(const Load& load, std::size_t i) {
  const std::array<std::size_t, 4> neighbours{i - 2, i - 1, i + 1, i + 2};
  double expected = 0.0, variance = 1.0;
  for (const std::size_t j : neighbours) {
    double weight = 1.0;
    for (const std::size_t k : neighbours)
      if (k != j)
        weight *= (load.curve_time[i] - load.curve_time[k]) / (load.curve_time[j] - load.curve_time[k]);
    expected += weight * load.curve_pressure[j];
    variance += weight * weight;
  }
  return std::abs(load.curve_pressure[i] - expected) / std::sqrt(variance);
}

/// Fewer deviations than these are those of a coarse curve rather than of noise.
constexpr std::size_t fewest_deviations = 16;

/// Standard deviation of the noise of a measured curve's points, Pa; 0 where they are too few to tell. From
/// the deviation that one point in ten exceeds, so that a few steps do not count as noise, nor a quiet
/// stretch before the pulse hides it.
double noise_of(const Load& load) {
  constexpr double exceeded_by_a_tenth = 1.645;  // standard deviations of a normal distribution
  std::vector<double> deviations;
  const double end = end_time(load);
  for (std::size_t i = 2; i + 2 < load.curve_time.size(); ++i)
    if (load.curve_time[i] >= 0.0 && load.curve_time[i] <= end)
      deviations.push_back(deviation_from_neighbours(load, i));
  if (deviations.size() < fewest_deviations) return 0.0;
  const auto ninth = deviations.begin() + static_cast<std::ptrdiff_t>(deviations.size() * 9 / 10);
  std::nth_element(deviations.begin(), ninth, deviations.end());
  return *ninth / exceeded_by_a_tenth;
}

double mean_interval(const Load& load) {
  return (load.curve_time.back() - load.curve_time.front()) / static_cast<double>(load.curve_time.size() - 1);
}

/// The integral of p |dp| over the simulated time, Pa2, with the swings of noise and without.
struct Work {
  double whole = 0, noiseless = 0;
};

Work work_of(const Load& load) {
  const PressureHistory history(load);
  std::vector<double> pressures;
  for (const double time : history.marks()) pressures.push_back(history.at(time));
  const double stated = history.stated_peak();
  const double scale = stated / std::max(*std::ranges::max_element(load.curve_pressure), 1e-300);
  // Of the noise of single points the average over a window has a share.
  const double left = 1.0 / std::sqrt(std::max(1.0, load.smoothing / mean_interval(load)));
  const double noise = scale * noise_of(load) * left;
  const double least_swing =
      std::clamp(deviations_of_a_swing * noise, least_swing_share * stated, largest_swing_share * stated);
  // A load that only swings less than that has a noiseless one that cannot be told from a constant.
  const double noiseless =
      std::max(work_along(without_small_swings(pressures, least_swing)), 0.5 * least_swing * least_swing);
  return {work_along(pressures), noiseless};
}

/// A number (> 0) with so many digits.
double in_digits(double value, int digits) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - digits + 1.0);
  return unit * std::round(value / unit);
}

/// A number with two digits, rounded up.
double rounded_up(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::ceil(value / unit - 1e-9) * unit;
}

/// Part of a measured curve at equal intervals: what is simulated of it.
struct Part {
  double begin = 0, interval = 0;  ///< s
  std::size_t samples = 0;
  double length() const { return interval * static_cast<double>(samples); }
  /// s; what of the curve is slower than its average over this is its pulse.
  double window() const { return std::min(1e-3, 0.1 * length()); }
};

/// Without samples where it has too few points.
Part simulated_part(const Load& load) {
  constexpr std::size_t fewest_points = 64, most_samples = 4096;
  const auto first = std::ranges::lower_bound(load.curve_time, 0.0);
  const auto behind = std::ranges::upper_bound(load.curve_time, end_time(load));
  if (behind - first < static_cast<std::ptrdiff_t>(fewest_points)) return {};
  const std::size_t samples = std::min(most_samples, static_cast<std::size_t>(behind - first) - 1);
  return {*first, (*std::prev(behind) - *first) / static_cast<double>(samples), samples};
}

/// What of a part is faster than its window; what is faster than its intervals is averaged out too.
std::vector<double> fast_in(const Part& part, const Load& measured) {
  Load load = without_exit(measured);
  load.duration.reset();
  if (part.interval > 1.01 * mean_interval(load)) load.smoothing = std::max(load.smoothing, part.interval);
  const PressureHistory all(load), average(averaged(load, part.window()));
  std::vector<double> fast;
  for (std::size_t i = 0; i < part.samples; ++i) {
    const double time = part.begin + static_cast<double>(i) * part.interval;
    fast.push_back(all.at(time) - average.at(time));
  }
  return fast;
}

/// What an average over a window (s) leaves of a sine of a frequency (1/s).
double left_by_average(double frequency, double window) {
  const double angle = std::numbers::pi * frequency * window;
  return std::sin(angle) / angle;
}

/// Mean square at the frequency of so many periods over all values.
double power_at(const std::vector<double>& values, std::size_t periods) {
  const std::complex<double> turn = std::polar(
      1.0, 2.0 * std::numbers::pi * static_cast<double>(periods) / static_cast<double>(values.size()));
  std::complex<double> sum = 0.0, phase = 1.0;
  for (const double value : values) {
    sum += value * phase;
    phase *= turn;
  }
  return 2.0 * std::norm(sum) / std::pow(static_cast<double>(values.size()), 2);
}

/// Mean power of white noise among powers by frequency, of which it makes a quarter or more: so many of what
/// is distributed exponentially are less than this share of its mean.
double noise_among(std::vector<double> powers) {
  const double share = -std::log(0.75);
  const auto quarter = powers.begin() + static_cast<std::ptrdiff_t>(powers.size() / 4);
  std::nth_element(powers.begin(), quarter, powers.end());
  return *quarter / share;
}

/// What a measured curve has within a twentieth of every frequency where that is neither white noise nor the
/// pulse itself, the largest first.
///
/// Five powers of white noise have six times their mean together once in ten million cases. A pulse that
/// fills the record and has a corner at its peak, as the published one has, swings by up to 1/n^2 of its peak
/// about n periods.
std::vector<Ring> swings_of(const Load& load) {
  constexpr double lowest = 0.8, near = 0.05, fewest_beside = 2.0, over_noise = 6.0, least_share = 5e-4;
  const Part part = simulated_part(load);
  if (part.samples == 0 || load.smoothing >= part.window()) return {};
  const std::vector<double> fast = fast_in(part, load);
  const auto first = static_cast<std::size_t>(lowest * part.length() / part.window());
  std::vector<double> powers;
  for (std::size_t i = first; i < part.samples / 2; ++i) {
    const double slow = left_by_average(static_cast<double>(i) / part.length(), part.window());
    powers.push_back(power_at(fast, i) / std::pow(1.0 - slow, 2));
  }
  const double noise = noise_among(powers), peak = PressureHistory(load).stated_peak();
  std::vector<Ring> swings;
  for (std::size_t i = 0; i < powers.size(); ++i) {
    const auto periods = static_cast<double>(first + i);
    const double beside = std::max(fewest_beside, near * periods);
    const auto reach = static_cast<std::size_t>(beside) + 1;
    double power = 0.0, centre = 0.0, of_noise = 0.0;
    for (std::size_t k = i - std::min(i, reach); k <= std::min(i + reach, powers.size() - 1); ++k) {
      const auto at = static_cast<double>(first + k);
      const double weight = std::min(1.0, beside + 1.0 - std::abs(at - periods));
      power += weight * powers[k];
      centre += weight * powers[k] * at;
      of_noise += weight * noise;
    }
    const Ring swing{centre / power / part.length(), std::sqrt(2.0 * std::max(0.0, power - of_noise))};
    if (power >= over_noise * of_noise && swing.amplitude >= (least_share + 1.0 / (periods * periods)) * peak)
      swings.push_back(swing);
  }
  std::ranges::sort(swings, std::ranges::greater{}, &Ring::amplitude);
  return swings;
}

std::string percent(double share) { return fmt::format("{:.3g} %", 100.0 * share); }

std::string roughness_text(const Load& load) {
  const double roughness = load_roughness(load);
  std::string text = fmt::format("roughness {:.4f}", roughness);
  if (roughness < least_roughness) return text;
  text += fmt::format(": {} of the elastic friction heat is that of noise",
                      percent(roughness / (1.0 + roughness)));
  const auto window = suggested_smoothing(load);
  if (!window || ring_of(load)) return text;  // of a ring its own period is the window
  const Load smoothed = averaged(load, *window);
  return text + fmt::format("; load.smoothing = \"{}\" leaves {:.4f} and takes {} from the peak",
                            time_text(*window), load_roughness(smoothed),
                            percent(peak_lost_to_smoothing(smoothed)));
}

/// "3.2 kHz with 1.5 % of its peak".
std::string size_text(const Ring& ring, const Load& load) {
  return fmt::format("{:.2g} kHz with {:.2g} % of its peak", 1e-3 * ring.frequency,
                     100.0 * ring.amplitude / PressureHistory(load).stated_peak());
}

/// Pa, the peak of a pulse without a ring of a period (s), of which averages over one, two and four periods
/// have nothing. What they take from a pulse that falls as |t|^n about its peak grows 2^n-fold from each to
/// the next, from which follows what an average over nothing would have (Aitken's extrapolation). Nothing
/// where that is not below the record's peak: too few points a period tell the pulse from its ring.
std::optional<double> peak_without_ring(Load load, double period) {
  const double stated = PressureHistory(load).stated_peak();
  load.rescale_to_peak = false;
  const PressureHistory one(averaged(load, period));
  const auto at_peak = [&](double window) {
    return PressureHistory(averaged(load, window)).at(one.peak_time());
  };
  const double two = at_peak(2.0 * period), four = at_peak(4.0 * period), record = one.stated_peak();
  const double growth = (two - four) / (one.peak() - two);
  const double peak = one.peak() + (one.peak() - two) / (growth - 1.0);
  return growth > 1.0 && peak < record ? std::optional(stated / record * peak) : std::nullopt;
}

/// How to take a ring away: averages over its period have none of it.
std::string removal_text(const Load& load) {
  if (const auto gone = smoothed_ring(load)) return "; it took away a ring at " + size_text(*gone, load);
  const auto ring = ring_of(load);
  if (!ring) return {};
  const double period = in_digits(1.0 / ring->frequency, 3);  // which its frequency bears
  const std::string text = fmt::format(
      "; if the ring is the gauge's own, load.smoothing = \"{}\", its period, takes it away, and {} from the "
      "peak",
      time_text(period), percent(peak_lost_to_smoothing(averaged(load, period))));
  const auto peak = peak_without_ring(without_exit(load), period);
  if (!peak) return text;
  return text +
         fmt::format("; load.rescale_to_peak = true and load.peak = \"{}\" give the pulse its own back",
                     pressure_text(in_digits(*peak, 4)));
}

std::string smoothing_text(const Load& load) {
  if (!(load.smoothing > 0.0)) return {};
  const double before = PressureHistory(load).stated_peak(), lost = peak_lost_to_smoothing(load);
  return fmt::format("averaged over {}, which takes {} from the peak: {} instead of {}",
                     time_text(load.smoothing), percent(lost), pressure_text(before * (1.0 - lost)),
                     pressure_text(before));
}

}  // namespace

Load averaged(Load load, double window) {
  load.smoothing = window;
  return load;
}

Load load_of_curve(const PressureCurve& curve) {
  Load load;
  load.curve_time = curve.time;
  load.curve_pressure = curve.pressure;
  return load;
}

double load_roughness(const Load& load) {
  if (load.curve_time.size() < 2) return 0.0;
  const Work work = work_of(load);
  return work.noiseless > 0.0 ? std::max(0.0, work.whole / work.noiseless - 1.0) : 0.0;
}

double work_lost_to_smoothing(const Load& load) {
  if (load.curve_time.size() < 2 || !(load.smoothing > 0.0)) return 0.0;
  const double before = work_of(averaged(load, 0.0)).noiseless, after = work_of(load).whole;
  return after > 0.0 ? std::max(0.0, before / after - 1.0) : 0.0;
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
  const auto& time = load.curve_time;
  const auto& pressure = load.curve_pressure;
  if (time.size() < 4 || load.rescale_to_peak) return 0.0;
  const auto top = static_cast<std::size_t>(std::ranges::max_element(pressure) - pressure.begin());
  const auto slope_from = [&](std::size_t i) {
    return (pressure[i + 1] - pressure[i]) / (time[i + 1] - time[i]);
  };
  double missed = 0.0;
  // Between the points i and i + 1 meet the chords of the intervals before and after.
  for (std::size_t i = std::max<std::size_t>(top, 2) - 1; i <= std::min(top, time.size() - 3); ++i) {
    const double rise = slope_from(i - 1), fall = slope_from(i + 1), length = time[i + 1] - time[i];
    const double after = (pressure[i + 1] - pressure[i] - fall * length) / (rise - fall);  // s
    if (after > 0.0 && after < length)
      missed = std::max(missed, (pressure[i] + rise * after) / pressure[top] - 1.0);
  }
  return missed;
}

std::optional<double> suggested_smoothing(const Load& load) {
  constexpr std::size_t most_points = 100'000;  // more take longer than a suggestion is worth
  if (load.curve_time.size() > most_points) return std::nullopt;
  if (load_roughness(load) < least_roughness) return std::nullopt;
  const double length = load.curve_time.back() - load.curve_time.front();
  Load smoothed = load;
  for (double points = 2.0; points <= 256.0; points *= 2.0) {
    smoothed.smoothing = rounded_up(points * mean_interval(load));
    if (smoothed.smoothing > 0.1 * length) return std::nullopt;
    const bool allowed = smoothed.smoothing >= least_smoothing_share * length;
    if (allowed && smoothed.smoothing > load.smoothing && load_roughness(smoothed) < least_roughness)
      return smoothed.smoothing;
  }
  return std::nullopt;
}

std::vector<Ring> rings_of(const Load& load) {
  constexpr double near = 0.1;
  const std::vector<Ring> swings = swings_of(load);
  const double lowest = 0.9 / simulated_part(load).window();
  std::vector<Ring> rings;
  for (auto swing = swings.begin(); swing != swings.end(); ++swing) {
    const auto is_near = [&](const Ring& larger) {
      return std::abs(swing->frequency / larger.frequency - 1.0) <= near;
    };
    if (swing->frequency >= lowest && std::none_of(swings.begin(), swing, is_near)) rings.push_back(*swing);
  }
  return rings;
}

std::optional<Ring> ring_of(const Load& load) {
  const std::vector<Ring> rings = rings_of(load);
  return rings.empty() ? std::nullopt : std::optional(rings.front());
}

std::optional<Ring> smoothed_ring(const Load& load) {
  constexpr double least_left = 0.9;
  if (!(load.smoothing > 0.0)) return std::nullopt;
  for (const Ring& swing : swings_of(averaged(load, 0.0)))
    if (std::abs(left_by_average(swing.frequency, load.smoothing)) <= least_left) return swing;
  return std::nullopt;
}

std::string ring_text(const Load& load) {
  const auto ring = ring_of(load);
  if (!ring) return {};
  return fmt::format("the record {} rings at {}, which heats as pressure does",
                     load.curve_file.empty() ? "of the load" : load.curve_file, size_text(*ring, load));
}

std::string measured_load_text(const Load& load) {
  if (load.curve_time.empty()) return {};
  std::vector<std::string> parts{smoothing_text(load), roughness_text(load), ring_text(load)};
  std::erase(parts, "");
  return fmt::format("{}{}", fmt::join(parts, "; "), removal_text(load));
}

}  // namespace launchsafe::scene
