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

/// A number (> 0) with so many digits, rounded to the nearest or as said.
double in_digits(double value, int digits, double (*rounded)(double) = std::round) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - digits + 1.0);
  return unit * rounded(value / unit);
}

/// A measured curve as far as it is simulated, as if the gauge had seen no muzzle exit.
Load simulated_part(const Load& load) {
  const auto first = std::ranges::lower_bound(load.curve_time, 0.0) - load.curve_time.begin();
  const auto behind = std::ranges::upper_bound(load.curve_time, end_time(load)) - load.curve_time.begin();
  Load part = without_exit(load);
  part.duration.reset();
  part.curve_time = {load.curve_time.begin() + first, load.curve_time.begin() + behind};
  part.curve_pressure = {load.curve_pressure.begin() + first, load.curve_pressure.begin() + behind};
  return part;
}

/// What of a curve is faster than its average over `window` (s), at equal intervals from its first point on;
/// what is faster than those of a thinned curve is averaged out too.
std::vector<double> fast_part(Load load, double window, std::size_t samples) {
  const double begin = load.curve_time.front(),
               interval = (load.curve_time.back() - begin) / static_cast<double>(samples);
  if (samples + 1 < load.curve_time.size()) load.smoothing = std::max(load.smoothing, interval);
  const PressureHistory all(load), average(averaged(load, window));
  std::vector<double> fast;
  for (std::size_t i = 0; i < samples; ++i) {
    const double time = begin + static_cast<double>(i) * interval;
    fast.push_back(all.at(time) - average.at(time));
  }
  return fast;
}

/// What an average over so many periods leaves of a sine.
double left_of_sine(double periods) {
  return std::sin(std::numbers::pi * periods) / (std::numbers::pi * periods);
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
  const auto quarter = powers.begin() + static_cast<std::ptrdiff_t>(powers.size() / 4);
  std::nth_element(powers.begin(), quarter, powers.end());
  return *quarter / -std::log(0.75);
}

/// What a measured curve has within a twentieth of every frequency where that is neither white noise nor the
/// pulse itself, the largest first.
/// Five powers of white noise have six times their mean together once in a hundred million cases, or once in
/// ten thousand that of a thinned curve, whose noise is less at high frequencies. A pulse that fills the
/// record and has a corner at its peak, as the published one has, swings by 1/n^2 of its peak about n
/// periods.
std::vector<Ring> swings_of(const Load& load) {
  constexpr std::size_t most_samples = 4096, fewest_points = 64, fewest_beside = 2;
  constexpr double longest_window = 1.25e-3, lowest = 0.8, near = 0.05, over_noise = 6.0, least_share = 5e-4;
  const Load part = simulated_part(load);
  if (part.curve_time.size() < fewest_points) return {};
  const double length = part.curve_time.back() - part.curve_time.front();
  const double window = std::min(longest_window, 0.1 * length);
  if (load.smoothing >= window) return {};
  const std::size_t samples = std::min(most_samples, part.curve_time.size() - 1);
  const std::vector<double> fast = fast_part(part, window, samples);
  const auto first = static_cast<std::size_t>(lowest * length / window);
  std::vector<double> powers;
  for (std::size_t i = first; i < samples / 2; ++i) {
    const double taken = 1.0 - left_of_sine(static_cast<double>(i) * window / length);
    powers.push_back(power_at(fast, i) / (taken * taken));
  }
  const double noise = noise_among(powers), peak = PressureHistory(load).stated_peak();
  std::vector<Ring> swings;
  for (std::size_t i = 0; i < powers.size(); ++i) {
    const auto periods = static_cast<double>(first + i);
    const std::size_t beside = std::max(fewest_beside, static_cast<std::size_t>(near * periods));
    double power = 0.0, centre = 0.0;
    for (std::size_t k = i - std::min(i, beside); k <= std::min(i + beside, powers.size() - 1); ++k) {
      power += powers[k];
      centre += powers[k] * static_cast<double>(first + k);
    }
    const Ring swing{centre / power / length, std::sqrt(2.0 * power)};
    const double of_noise = noise * static_cast<double>(2 * beside + 1);
    const double least = (least_share + 1.0 / (periods * periods)) * peak;
    if (power >= over_noise * of_noise && swing.amplitude > least) swings.push_back(swing);
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

/// How to take a ring away: averages over its period have none of it.
std::string removal_text(const Load& load) {
  if (const auto gone = smoothed_ring(load)) return "; it took away a ring at " + size_text(*gone, load);
  const auto ring = ring_of(load);
  if (!ring) return {};
  const double period = in_digits(1.0 / ring->frequency, 3);  // which its frequency bears
  return fmt::format(
      "; if the ring is the gauge's own, load.smoothing = \"{}\", its period, takes it away, and {} from the "
      "peak",
      time_text(period), percent(peak_lost_to_smoothing(averaged(load, period))));
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

std::optional<double> suggested_smoothing(const Load& load) {
  constexpr std::size_t most_points = 100'000;  // more take longer than a suggestion is worth
  if (load.curve_time.size() > most_points) return std::nullopt;
  if (load_roughness(load) < least_roughness) return std::nullopt;
  const double length = load.curve_time.back() - load.curve_time.front();
  const auto up = [](double number) { return std::ceil(number - 1e-9); };
  Load smoothed = load;
  for (double points = 2.0; points <= 256.0; points *= 2.0) {
    smoothed.smoothing = in_digits(points * mean_interval(load), 2, up);
    if (smoothed.smoothing > 0.1 * length) return std::nullopt;
    const bool allowed = smoothed.smoothing >= least_smoothing_share * length;
    if (allowed && smoothed.smoothing > load.smoothing && load_roughness(smoothed) < least_roughness)
      return smoothed.smoothing;
  }
  return std::nullopt;
}

std::vector<Ring> rings_of(const Load& load) {
  constexpr double near = 0.2, lowest = 0.9e3;
  const std::vector<Ring> swings = swings_of(load);
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
    if (!(std::abs(left_of_sine(swing.frequency * load.smoothing)) > least_left)) return swing;
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
