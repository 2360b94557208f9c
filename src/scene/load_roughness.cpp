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

/// What of a curve is faster than its average over `window` (s), at equal intervals from its first point to
/// its last; what is faster than these is averaged out too.
std::vector<double> fast_part(const Load& measured, double window, std::size_t samples) {
  Load load = without_exit(measured);
  load.duration.reset();
  const double begin = load.curve_time.front(),
               interval = (load.curve_time.back() - begin) / static_cast<double>(samples);
  if (interval > mean_interval(load)) load.smoothing = std::max(load.smoothing, interval);
  const PressureHistory all(load), average(averaged(load, window));
  std::vector<double> fast;
  for (std::size_t i = 0; i < samples; ++i) {
    const double time = begin + (static_cast<double>(i) + 0.5) * interval;
    fast.push_back(all.at(time) - average.at(time));
  }
  return fast;
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

/// Whether a bin is in a line among powers by frequency, from `first` on: its five bins, as a ring that comes
/// and goes with the pressure spreads over, have on average thirty times the median of what lies within a
/// third of its frequency. None is in noise, nor in the pulse itself.
bool stands_out(const std::vector<double>& powers, std::size_t first, std::size_t bin, double line) {
  constexpr std::size_t fewest_around = 8;
  constexpr double bins = 5.0, least_prominence = 30.0, span = 4.0 / 3.0;
  const auto begin = std::max(first, static_cast<std::size_t>(static_cast<double>(bin) / span));
  const auto end = std::min(powers.size(), static_cast<std::size_t>(static_cast<double>(bin) * span) + 1);
  if (end - begin < fewest_around) return false;
  std::vector<double> around(powers.begin() + static_cast<std::ptrdiff_t>(begin),
                             powers.begin() + static_cast<std::ptrdiff_t>(end));
  const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
  std::nth_element(around.begin(), middle, around.end());
  return line >= bins * least_prominence * *middle;
}

/// The lines among powers by frequency, the strongest first, none within a tenth of a stronger one.
std::vector<std::size_t> lines_of(const std::vector<double>& powers, std::size_t first) {
  constexpr std::size_t half_width = 2;
  constexpr double near = 0.1;
  std::vector<std::pair<double, std::size_t>> bins;  // of what five bins have together
  for (std::size_t i = first + half_width; i + half_width < powers.size(); ++i) {
    double line = 0.0;
    for (std::size_t k = i - half_width; k <= i + half_width; ++k) line += powers[k];
    if (stands_out(powers, first, i, line)) bins.emplace_back(-line, i);
  }
  std::ranges::sort(bins);
  std::vector<std::size_t> lines;
  for (const auto& [power, bin] : bins) {
    const auto is_near = [bin = static_cast<double>(bin)](std::size_t line) {
      return std::abs(bin / static_cast<double>(line) - 1.0) <= near;
    };
    if (std::ranges::none_of(lines, is_near)) lines.push_back(bin);
  }
  return lines;
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
  constexpr std::size_t most_samples = 4096, fewest_points = 64;
  constexpr double longest_window = 1e-3, near = 0.1, line_bins = 5.0, least_share = 5e-4;
  if (load.curve_time.size() < fewest_points) return {};
  const double length = load.curve_time.back() - load.curve_time.front();
  const double window = std::min(longest_window, 0.1 * length);
  if (load.smoothing >= window) return {};
  const std::size_t samples = std::min(most_samples, load.curve_time.size() - 1);
  const std::vector<double> fast = fast_part(load, window, samples);
  const auto first = static_cast<std::size_t>(std::ceil(length / window));
  std::vector<double> powers(samples / 2, 0.0);
  for (std::size_t i = first; i < powers.size(); ++i) powers[i] = power_at(fast, i);
  const double least = least_share * PressureHistory(load).stated_peak();
  std::vector<Ring> rings;
  for (const std::size_t top : lines_of(powers, first)) {
    double around = 0.0, line = 0.0, centre = 0.0;
    for (std::size_t i = first; i < powers.size(); ++i) {
      const double apart = std::abs(static_cast<double>(i) - static_cast<double>(top));
      if (apart <= near * static_cast<double>(top)) around += powers[i];
      if (apart > line_bins) continue;
      line += powers[i];
      centre += powers[i] * static_cast<double>(i);
    }
    const Ring ring{centre / line / length, std::sqrt(2.0 * around)};
    if (ring.amplitude >= least) rings.push_back(ring);
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
  for (const Ring& ring : rings_of(averaged(load, 0.0))) {
    // What an average over a window leaves of a sine.
    const double angle = std::numbers::pi * ring.frequency * load.smoothing;
    if (!(std::abs(std::sin(angle)) > least_left * angle)) return ring;
  }
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
