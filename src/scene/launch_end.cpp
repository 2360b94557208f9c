#include "launchsafe/scene/launch_end.hpp"

#include "launchsafe/scene/quantity.hpp"

#include <fmt/format.h>

namespace launchsafe::scene {
namespace {

/// Round-off of times that were written in decimals.
constexpr double same_time = 1e-9;

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

/// When a rigid projectile of that mass over its base has travelled so far (m); none where it does not until
/// the load is over.
std::optional<double> time_of_travel(const Load& load, double travel) {
  if (!(load.mass_over_area > 0.0)) return std::nullopt;
  constexpr int parts = 4000;
  const Load barrel = without_exit(load);
  const PressureHistory history(barrel);
  const double dt = end_in_the_barrel(barrel) / parts;
  double velocity = 0.0, travelled = 0.0;
  for (int part = 0; part < parts; ++part) {
    const double gained = dt * history.at((part + 0.5) * dt) / load.mass_over_area;
    const double moved = dt * (velocity + 0.5 * gained);
    if (travelled + moved >= travel) return dt * (part + (travel - travelled) / moved);
    travelled += moved;
    velocity += gained;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> exit_time(const Load& load) {
  if (load.muzzle_exit || !load.muzzle_travel) return load.muzzle_exit;
  return time_of_travel(load, *load.muzzle_travel);
}

double launch_end(const Load& load) {
  const std::optional<double> exit = exit_time(load);
  if (!exit) return end_in_the_barrel(load);
  return *exit + load.exit_decay * std::log(std::max(1.0, share_left(load, *exit) / share_when_over));
}

double end_time(const Load& load) { return load.duration ? *load.duration : launch_end(load); }

double read_time(const Load& load) {
  const double end = end_time(load);
  return std::min(exit_time(load).value_or(end), end);
}

double share_left(const Load& load, double time) {
  const PressureHistory history(load);
  // What an analytic load falls to when it is over, and a measured curve when the gauge's pressure is gone.
  const double base = load.curve_time.empty() ? load.base : 0.0, height = history.stated_peak() - base;
  return height > 0.0 ? (history.at(time) - base) / height : 0.0;
}

double calibres_of(const Scene& scene, const RigidMotion& motion) {
  return motion.travel / (2.0 * extent_of(scene).r_end);
}

bool is_cut_short(const Load& load) {
  if (!load.duration || *load.duration >= launch_end(load) * (1.0 - same_time)) return false;
  if (load.curve_time.empty() || exit_time(load)) return true;
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

std::optional<Load> longer_launch(Load load) {
  constexpr double most_times_as_long = 10.0;
  const double end = end_time(load);
  if (is_cut_short(load)) {
    load.duration.reset();
  } else if (exit_time(load) && !load.duration) {
    load = without_exit(std::move(load));
  } else {
    return std::nullopt;
  }
  return end_time(load) <= most_times_as_long * end ? std::optional(std::move(load)) : std::nullopt;
}

std::string exit_text(const Scene& scene) {
  const std::optional<double> exit = exit_time(scene.load);
  if (!exit) return {};
  return fmt::format("{}, at {} with {:.3g} % of the peak pressure", rigid_motion_text(scene, *exit),
                     time_text(*exit), 100.0 * share_left(scene.load, *exit));
}

std::string end_text(const Scene& scene) {
  const Load& load = scene.load;
  const double end = end_time(load);
  const char* why = is_cut_short(load)         ? "cut short by load.duration"
                    : load.duration            ? "as load.duration says"
                    : exit_time(load)          ? "when the decay after the exit is over"
                    : !load.curve_time.empty() ? "at the last point of the measured curve"
                                               : "when the load is over";
  return fmt::format("{}, at {} with {:.3g} % of the peak pressure, {}", rigid_motion_text(scene, end),
                     time_text(end), 100.0 * share_left(load, end), why);
}

std::string launch_sentence(const Scene& scene) {
  const std::string exit = exit_text(scene);
  return exit.empty() ? "The load drives the shell to " + end_text(scene) + "."
                      : "The shot leaves the barrel with " + exit + ".";
}

}  // namespace launchsafe::scene
