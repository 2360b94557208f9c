#include "validate_end.hpp"

#include "launchsafe/scene/launch_end.hpp"
#include "scene_fault.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace launchsafe::scene {
namespace {

/// Largest difference of a stated travel from that which the load gives at the stated exit.
constexpr double largest_difference_of_travel = 0.05;
/// Likewise of a velocity that is expected.
constexpr double largest_difference_of_velocity = 0.05;
/// s; no launch is longer.
constexpr double longest_launch = 1.0;

/// What only an exit gives a meaning to.
std::optional<InputError> fault_without_exit(const SceneFile& file) {
  for (const char* key : {"load.exit_decay", "load.muzzle_exit_spread"})
    if (file.given.contains(key))
      return fault_at(file, key, "a number of the muzzle exit, which is not stated",
                      "only together with load.muzzle_exit or load.muzzle_travel");
  return std::nullopt;
}

std::optional<InputError> fault_of_travel(const SceneFile& file) {
  const Load& load = file.scene.load;
  if (!load.muzzle_travel) return std::nullopt;
  const double stated = *load.muzzle_travel;
  Scene barrel = file.scene;
  barrel.load = without_exit(load);
  barrel.load.duration.reset();
  if (!load.muzzle_exit) {
    if (exit_time(load)) return std::nullopt;
    const double end = launch_end(barrel.load);
    return fault_at(file, "load.muzzle_travel", length_text(stated) + ", which the projectile does not reach",
                    fmt::format("at most {}, where the load drives it until it ends at {}",
                                length_text(rigid_motion(barrel, end).travel), time_text(end)));
  }
  const double travel = rigid_motion(barrel, *load.muzzle_exit).travel;
  if (std::abs(stated - travel) <= largest_difference_of_travel * travel) return std::nullopt;
  return fault_at(
      file, "load.muzzle_travel",
      fmt::format("{}, while the load drives the projectile {:.3g} m until load.muzzle_exit, {}",
                  length_text(stated), travel, time_text(*load.muzzle_exit)),
      fmt::format("within {:g} % of that, or one of the two alone", 100.0 * largest_difference_of_travel));
}

/// An exit that is no end of this load.
std::optional<InputError> fault_of_exit(const SceneFile& file) {
  const Load& load = file.scene.load;
  const double exit = *exit_time(load);
  const std::string key = load.muzzle_exit ? "load.muzzle_exit" : "load.muzzle_travel";
  const std::string found = load.muzzle_exit ? time_text(exit)
                                             : fmt::format("{}, which is reached at {}",
                                                           length_text(*load.muzzle_travel), time_text(exit));
  Load barrel = without_exit(load);
  barrel.duration.reset();
  const double peak = PressureHistory(barrel).peak_time(), end = launch_end(barrel);
  const std::string allowed = fmt::format("a time after the peak, {}, and before the load is over, {}",
                                          time_text(peak), time_text(end));
  if (!(exit > peak)) return fault_at(file, key, found + ", not after the peak of the load", allowed);
  if (exit > end * (1.0 + 1e-9)) return fault_at(file, key, found + ", after the end of the load", allowed);
  return std::nullopt;
}

/// Which unit was taken for which other one where a velocity, which grows with the pressure, is so many times
/// the expected one; empty for none.
std::string unit_taken_for(double ratio) {
  constexpr std::array<std::pair<const char*, double>, 5> units{
      {{"psi", 6894.757}, {"bar", 1e5}, {"MPa", 1e6}, {"ksi", 6.894757e6}, {"kgf/mm2", 9.80665e6}}};
  constexpr double near = 0.06;  // of the logarithm: the expected velocity is known to 5 %
  std::string text;
  for (const auto& [typed, size] : units)
    for (const auto& [meant, true_size] : units)
      if (typed != meant && std::abs(std::log(size / true_size / ratio)) < near)
        text += fmt::format("{}{} typed as {}", text.empty() ? "" : ", or ", meant, typed);
  return text.empty() ? text : fmt::format("; the ratio, {:.3g}, is that of {}", ratio, text);
}

}  // namespace

std::optional<InputError> check_expected_velocity(const SceneFile& file) {
  const std::optional<double> expected = file.scene.load.expected_velocity;
  if (!expected) return std::nullopt;
  Scene whole = file.scene;
  whole.load.duration.reset();
  const double time = read_time(whole.load), velocity = rigid_motion(whole, time).velocity;
  if (std::abs(*expected - velocity) <= largest_difference_of_velocity * velocity) return std::nullopt;
  return error_at(place_of_key(file, "load.expected_velocity"), "load.expected_velocity",
                  fmt::format("{:.4g} m/s, while the load drives the projectile to {}, at {}", *expected,
                              rigid_motion_text(whole, time), time_text(time)),
                  fmt::format("within {:g} % of that: this, the pressure, a time or the mass is mistyped{}",
                              100.0 * largest_difference_of_velocity, unit_taken_for(velocity / *expected)));
}

std::optional<InputError> fault_of_end(const SceneFile& file) {
  const Load& load = file.scene.load;
  if (load.muzzle_exit || load.muzzle_travel) {
    if (auto fault = fault_of_travel(file)) return fault;
    return fault_of_exit(file);
  }
  if (auto fault = fault_without_exit(file)) return fault;
  const double end = end_time(load);
  if (end > 0.0 && end <= longest_launch) return std::nullopt;
  const bool measured = !load.curve_time.empty();
  const std::string key =
      measured ? load.curve_file.empty() ? "load.curve_time" : "load.curve" : "load.peak_time";
  return fault_at(file, key, fmt::format("a load that ends at {}", time_text(end)),
                  fmt::format("a load that is over within {}, or load.duration", time_text(longest_launch)));
}

}  // namespace launchsafe::scene
