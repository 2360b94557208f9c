// Whether a simulation covers the launch that its load states.
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/load.hpp"

#include <fmt/format.h>

namespace launchsafe::run {
namespace {

/// Shares of the stated peak. Heat goes nearly with the square of the pressure: half a per cent is 1 % of it.
constexpr double least_reached = 0.995;
/// A smoothed curve loses what was noise at its peak; what it loses beyond this was none.
constexpr double least_reached_smoothed = 0.95;
/// Part of a measured curve over which its end is judged, so that a point that a gauge dropped is no end.
constexpr double last_part = 0.02;
/// Pressure before the simulated time that is no part of a launch: offset and noise of a gauge.
constexpr double negligible = 0.01;
/// A start that the charge would feel as a blow; of an analytic load over its base, which has no offset and
/// no noise.
constexpr double highest_start = 0.05, highest_analytic_start = 0.01;

// Of a measured curve, shares of the time that it is above half of its peak, which the length of the record
// does not change, or of its own rise.
/// A gauge that saturates or is cut shows one pressure for so long; a smooth pulse is within 0.2 % of its
/// peak for a twentieth of that time.
constexpr double longest_plateau = 0.15, plateau = 0.998;
/// Points further apart beside the largest one may have missed the peak between them.
constexpr double widest_gap_at_peak = 0.5;
/// Time from the peak down to half of it over that from half of it up: propellant burns out no faster than
/// this, and a cable that breaks does.
constexpr double fastest_fall = 0.5;

using scene::Load, scene::PressureHistory;

std::string megapascals(double pressure) { return fmt::format("{:.4g} MPa", 1e-6 * pressure); }
std::string milliseconds(double time) { return fmt::format("{:.6g} ms", 1e3 * time); }

/// Mean pressure (Pa) of a part of the launch, between two shares of its duration.
double mean_of(const PressureHistory& history, double duration, double begin, double end) {
  constexpr int points = 50;
  double sum = 0;
  for (int i = 0; i < points; ++i) sum += history.at(duration * (begin + (end - begin) * (i + 0.5) / points));
  return sum / points;
}

std::string reaches_its_peak(const Load& load, const PressureHistory& history) {
  const double stated = history.stated_peak(), reached = history.peak();
  const double least = load.smoothing > 0.0 ? least_reached_smoothed : least_reached;
  if (reached >= least * stated) return {};
  return fmt::format(
      "the load reaches {} within {}, {:.3g} % of its stated peak, {}: the launch is not covered",
      megapascals(reached), milliseconds(scene::end_time(load)), 100.0 * reached / stated,
      megapascals(stated));
}

/// Whether the pressure is gone at the end, or a muzzle exit says that the shot is.
std::string is_over(const Load& load) {
  if (scene::is_cut_short(load))
    return fmt::format(
        "load.duration ends the simulation at {} with the load at {:.3g} % of its peak, and the launch is "
        "over at {}: it is cut short",
        milliseconds(*load.duration), 100.0 * scene::share_left(load, *load.duration),
        milliseconds(scene::launch_end(load)));
  if (load.curve_time.empty() || load.muzzle_exit) return {};
  const double last = load.curve_time.back(), share = scene::share_left(load, last);
  const double before = mean_of(PressureHistory(load), last, 1.0 - last_part, 1.0) /
                        std::max(PressureHistory(load).stated_peak(), 1e-300);
  if (share <= scene::share_when_over && before <= 2.0 * scene::share_when_over) return {};
  return fmt::format(
      "the launch is not over: the load stands at {:.3g} % of its peak at its last point, {}; a record that "
      "goes on to {:g} % is needed, or load.muzzle_exit, when the shot leaves the barrel",
      100.0 * std::max(share, before), milliseconds(last), 100.0 * scene::share_when_over);
}

std::string begins_at_rest(const Load& load, const PressureHistory& history) {
  const double stated = history.stated_peak(), start = history.at(0.0);
  const bool steps = load.curve_time.empty() && start - load.base > highest_analytic_start * stated;
  if (start <= highest_start * stated && !steps) return {};
  return fmt::format("the load begins with {}, {:.3g} % of its peak: how it came there is not covered",
                     megapascals(start), 100.0 * start / stated);
}

/// What a measured curve has before the start of the simulation.
std::string is_whole(const Load& load, const PressureHistory& history) {
  const double limit = negligible * history.stated_peak();
  for (const double time : load.curve_time) {
    if (time >= 0.0 || !(history.at(time) > limit)) continue;
    return fmt::format(
        "the measured curve has {} at {}, before the start of the simulation: the launch is not covered",
        megapascals(history.at(time)), milliseconds(time));
  }
  return {};
}

/// s, from the last point of a measured curve before it passes a tenth of its largest one to the first after.
std::pair<double, double> pulse_of(const Load& load, double end) {
  const auto& pressure = load.curve_pressure;
  const auto is_of_pulse = [least = 0.1 * std::ranges::max(pressure)](double p) { return p >= least; };
  auto first = std::ranges::find_if(pressure, is_of_pulse);
  auto behind = std::find_if(pressure.rbegin(), pressure.rend(), is_of_pulse).base();
  if (first != pressure.begin()) --first;
  if (behind == pressure.end()) --behind;
  const auto time_of = [&](auto point) {
    return std::clamp(load.curve_time[static_cast<std::size_t>(point - pressure.begin())], 0.0, end);
  };
  return {time_of(first), time_of(behind)};
}

/// Whether the largest point of a measured curve can be the peak of the launch. Judged is what the gauge
/// showed: after a muzzle exit the pressure falls as fast as it may.
std::string shows_its_peak(const Load& whole) {
  const Load load = scene::without_exit(whole);
  const PressureHistory history(load);
  const double end = scene::end_time(load);
  const auto& pressure = load.curve_pressure;
  if (pressure.size() < 2) return {};
  const auto at = static_cast<std::size_t>(std::ranges::max_element(pressure) - pressure.begin());
  const double before = at > 0 ? load.curve_time[at] - load.curve_time[at - 1] : 0.0;
  const double after = at + 1 < pressure.size() ? load.curve_time[at + 1] - load.curve_time[at] : 0.0;
  constexpr int parts = 2000;
  const auto [from, to] = pulse_of(load, end);
  const double part_length = (to - from) / parts, stated = history.peak();
  double first_half = to, last_half = from, flat = 0.0;
  bool has_risen = false, has_fallen = false;
  for (int part = 0; part < parts; ++part) {
    const double time = from + part_length * (part + 0.5), here = history.at(time);
    if (here >= plateau * stated) flat += part_length;
    has_fallen = has_fallen || (here < 0.1 * stated && has_risen);
    if (here < 0.5 * stated) continue;
    if (has_fallen)
      return fmt::format(
          "the measured curve falls below a tenth of its peak and rises again by {}, as misread numbers do",
          milliseconds(time));
    has_risen = true;
    first_half = std::min(first_half, time);
    last_half = std::max(last_half, time);
  }
  const double above_half = last_half - first_half;
  if (std::max(before, after) > widest_gap_at_peak * above_half)
    return fmt::format("the measured curve has no point for {} beside its largest: the peak may lie between",
                       milliseconds(std::max(before, after)));
  if (flat > longest_plateau * above_half)
    return fmt::format(
        "the measured curve stays at its largest pressure for {}, as a gauge does that saturates",
        milliseconds(flat));
  const double peak_time = std::clamp(load.curve_time[at], 0.0, end);
  if (last_half - peak_time < fastest_fall * (peak_time - first_half))
    return fmt::format(
        "the measured curve breaks off: it falls to half of its peak within {}, and took {} to rise",
        milliseconds(last_half - peak_time), milliseconds(peak_time - first_half));
  return {};
}

}  // namespace

std::vector<std::string> uncovered_load(const Load& load) {
  const PressureHistory history(load);
  std::vector<std::string> uncovered;
  if (history.stated_peak() == 0.0) return uncovered;  // nothing can be missing of no load
  for (const std::string& each :
       {reaches_its_peak(load, history), is_over(load), begins_at_rest(load, history),
        is_whole(load, history), shows_its_peak(load)})
    if (!each.empty()) uncovered.push_back(each);
  return uncovered;
}

}  // namespace launchsafe::run
