// The keys of a load, and what it must satisfy beyond the range of each: a measured curve, what stands beside
// it, and its end.
#include "launchsafe/scene/load.hpp"
#include "scene_file.hpp"

#include <boost/math/tools/roots.hpp>

namespace launchsafe::scene {
namespace {

bool is_bell(const Load& load) { return load.shape == LoadShape::bell; }

/// The key of a number that a measured curve takes the place of, unless it is scaled to it.
auto analytic(bool scales = false) {
  return [scales](Key<Load>& key) {
    key.is_replaced = [scales](const Load& load) {
      return !load.curve_time.empty() && !(scales && load.rescale_to_peak);
    };
  };
}

/// The key of the points of a measured curve, for messages.
const char* curve_key(const Load& load) { return load.curve_file.empty() ? "load.curve_time" : "load.curve"; }

/// What would silently do nothing: numbers of the other analytic shape, a peak beside a curve with a peak of
/// its own. A study that gives a scene a curve replaces its peak, and a scene written back has every key.
void check_what_does_nothing(const SceneFile& file) {
  const Load& load = file.scene.load;
  const auto others = is_bell(load) ? std::vector<std::string>{"load.exponent"}
                                    : std::vector<std::string>{"load.width", "load.steepness"};
  for (const std::string& key : others)
    if (file.given.contains(key))
      throw fault_at(file, key,
                     fmt::format("a number that the shape \"{}\" does not have", word_of(load.shape)),
                     "the numbers of this load.shape, or another one");
  const Given *peak = find_in(file.given, "load.peak"), *curve = find_in(file.given, "load.curve");
  const bool replaced = peak && curve && curve->place.file != file.file && peak->place.file == file.file;
  if (peak && !replaced && !load.curve_file.empty() && !load.rescale_to_peak)
    throw fault_at(file, "load.peak",
                   pressure_text(load.peak) + " beside a measured curve, which has a peak of its own",
                   "load.curve alone, or both with load.rescale_to_peak = true");
}

/// A curve of next to nothing has no shape that could be scaled.
void check_rescaling(const SceneFile& file) {
  constexpr double least_peak = 1.0;  // Pa
  const Load& load = file.scene.load;
  const double measured = load.curve_pressure.empty() ? 0.0 : std::ranges::max(load.curve_pressure);
  if (load.rescale_to_peak && measured < least_peak)
    throw fault_at(file, "load.rescale_to_peak",
                   load.curve_pressure.empty() ? "true without a measured curve"
                                               : "true with a curve that has no pressure",
                   "true together with a measured curve that reaches " + pressure_text(least_peak));
}

void check_smoothing(const SceneFile& file) {
  // Averages over shorter windows would be round-off, and no curve has points so near to each other.
  constexpr double least_share = 1e-6;
  const Load& load = file.scene.load;
  if (!(load.smoothing > 0.0)) return;
  const double length = load.curve_time.empty() ? 0.0 : load.curve_time.back() - load.curve_time.front();
  if (load.smoothing >= least_share * length && load.smoothing <= length) return;
  throw fault_at(file, "load.smoothing", time_text(load.smoothing),
                 fmt::format("0 ms for none, or a window up to the length of a measured curve, here {}",
                             time_text(length)));
}

/// A muzzle exit that is no end of this load, or a load without end.
void check_end(const SceneFile& file) {
  constexpr double longest_launch = 1.0;  // s
  const Load& load = file.scene.load;
  if (load.muzzle_travel && file.given.contains("load.muzzle_exit"))
    throw fault_at(file, "load.muzzle_travel", length_text(*load.muzzle_travel) + " beside load.muzzle_exit",
                   "one of the two");
  if (load.muzzle_travel && !load.muzzle_exit)
    throw fault_at(file, "load.muzzle_travel",
                   length_text(*load.muzzle_travel) + ", which the projectile does not reach",
                   "a travel within the load, or load.muzzle_exit");
  if (load.muzzle_exit) {
    Load barrel = without_exit(load);
    barrel.duration.reset();
    const double peak = PressureHistory(barrel).peak_time(), end = launch_end(barrel);
    if (*load.muzzle_exit > peak && *load.muzzle_exit <= end * (1.0 + 1e-9)) return;
    throw fault_at(file, load.muzzle_travel ? "load.muzzle_travel" : "load.muzzle_exit",
                   time_text(*load.muzzle_exit),
                   fmt::format("a time after the peak, {}, and before the load is over, {}", time_text(peak),
                               time_text(end)));
  }
  const double end = end_time(load);
  if (end > 0.0 && end <= longest_launch) return;
  throw fault_at(file, load.curve_time.empty() ? "load.peak_time" : curve_key(load),
                 fmt::format("a load that ends at {}", time_text(end)),
                 fmt::format("a load that is over within {}, or load.duration", time_text(longest_launch)));
}

}  // namespace

std::vector<Key<Load>> load_keys() {
  return {
      number_key("duration", Dimension::time, above_to(0, 1), Standing::input,
                 "Simulated time, from the ignition of the propellant on, to look at the "
                 "beginning alone; without it the launch is simulated until it is over.",
                 &Load::duration),
      number_key("peak", Dimension::pressure, above_to(0, 10e9), Standing::paper, "Largest chamber pressure.",
                 &Load::peak) |
          analytic(true),
      number_key("base", Dimension::pressure, between(0, 100e6), Standing::assumed,
                 "Chamber pressure at the start.", &Load::base) |
          analytic(),
      number_key("peak_time", Dimension::time, above_to(0, 0.1), Standing::assumed,
                 "Time of the largest chamber pressure.", &Load::peak_time) |
          analytic(),
      word_key("shape", Standing::assumed,
               "base + (peak - base) exp(-|(t - peak_time)/width|^steepness), or "
               "base + (peak - base) ((t/peak_time) exp(1 - t/peak_time))^exponent.",
               {{word_of(LoadShape::bell), LoadShape::bell},
                {word_of(LoadShape::power_exponential), LoadShape::power_exponential}},
               &Load::shape) |
          overriding({"width", "steepness", "exponent"}) |
          written_where([](const Load& load) { return !is_bell(load); }) | analytic(),
      number_key("width", Dimension::time, between(0.1e-3, 0.05), Standing::assumed,
                 "Time from the peak of a bell to where e times less is left of it.", &Load::width) |
          written_where(is_bell) | analytic(),
      number_key("steepness", Dimension::number, between(1, 10), Standing::assumed,
                 "How abruptly a bell rises and falls: 2 is that of Gauss.", &Load::steepness) |
          written_where(is_bell) | analytic(),
      number_key("exponent", Dimension::number, between(0.5, 50), Standing::assumed,
                 "How steeply a power-exponential rises and falls.", &Load::exponent) |
          written_where([](const Load& load) { return !is_bell(load); }) | analytic(),
      // The points of a measured curve are written back; the file they came from need not exist any more.
      text_key("curve", Standing::assumed,
               "Measured curve that replaces the analytic shape: a CSV file beside the "
               "scene, with a header such as time_ms,pressure_MPa; empty for none.",
               "pressure.csv", &Load::curve_file) |
          overriding({"curve_time", "curve_pressure"}) | written_where([](const Load&) { return false; }),
      list_key("curve_time", Dimension::time, between(-largest_curve_time, largest_curve_time),
               Standing::assumed, "Times of a measured curve written in the scene itself, increasing.",
               &Load::curve_time) |
          may_be_empty(),
      list_key("curve_pressure", Dimension::pressure, between(0, largest_load), Standing::assumed,
               "Pressures of a measured curve written in the scene itself.", &Load::curve_pressure) |
          may_be_empty(),
      flag_key("rescale_to_peak", Standing::assumed,
               "Scale the measured curve, after smoothing, so that its largest pressure is load.peak.",
               &Load::rescale_to_peak),
      number_key("smoothing", Dimension::time, between(0, 2e-3), Standing::assumed,
                 "Window over which a measured curve is averaged against noise, which "
                 "heats falsely; it takes from narrow peaks; \"0 ms\" for none.",
                 &Load::smoothing) |
          written_where([](const Load& load) { return load.smoothing != 0.0; }),
      number_key("muzzle_exit", Dimension::time, above_to(0, 1), Standing::input,
                 "Time at which the shot leaves the barrel.", &Load::muzzle_exit) |
          overriding({"muzzle_travel"}),
      // Never written back, as the exit that it leads to is.
      number_key("muzzle_travel", Dimension::length, above_to(0, 100), Standing::input,
                 "Travel of the projectile, as one rigid body, at which it leaves the barrel, in place of "
                 "muzzle_exit: loads of the same barrel differ in the exit.",
                 &Load::muzzle_travel) |
          overriding({"muzzle_exit"}) | written_where([](const Load&) { return false; }),
      number_key(
          "exit_decay", Dimension::time, between(0.02e-3, 5e-3), Standing::assumed,
          "Time constant with which the pressure falls after the muzzle exit: by default about that in "
          "which rarefactions from the rim of a 155 mm bore reach its axis.",
          &Load::exit_decay) |
          written_where([](const Load& load) { return load.muzzle_exit.has_value(); }),
      // Never written back: it makes no other launch, and a case with another load is none that was typed.
      number_key("expected_velocity", Dimension::speed, above_to(0, 5e3), Standing::input,
                 "Velocity at the muzzle, typed from a range table: a load that drives the "
                 "projectile to another one, by more than 5 %, is refused.",
                 &Load::expected_velocity) |
          written_where([](const Load&) { return false; }) | acting_on(ActsOn::nothing),
      number_key("obturation", Dimension::length, between(0, 10), Standing::input,
                 "Place along x of the driving band, up to which the chamber pressure acts on "
                 "all that faces the chamber; without it the foremost annulus of full radius.",
                 &Load::obturation),
  };
}

void check_curve(const SceneFile& file) {
  const Load& load = file.scene.load;
  const auto& times = load.curve_time;
  if (times.size() != load.curve_pressure.size())
    throw fault_at(file, "load.curve_pressure",
                   fmt::format("{} values for {} times", load.curve_pressure.size(), times.size()),
                   "one pressure for every time");
  if (times.size() == 1) throw fault_at(file, "load.curve_time", "1 point", "a curve of at least two points");
  const auto late =
      std::ranges::adjacent_find(times, [](double a, double b) { return !(b - a > least_curve_interval); });
  if (late != times.end())
    throw fault_at(file, "load.curve_time",
                   fmt::format("{} followed by {}", time_text(*late), time_text(*std::next(late))),
                   "times in increasing order, more than " + time_text(least_curve_interval) + " apart");
  check_smoothing(file);
}

void find_exit(Scene& scene) {
  if (!scene.load.muzzle_travel) return;
  const double goal = *scene.load.muzzle_travel;
  Scene barrel = scene;
  barrel.load = without_exit(scene.load);
  barrel.load.duration.reset();
  const double end = launch_end(barrel.load);
  if (!(rigid_motion(barrel, end).travel >= goal)) return;
  constexpr int digits = 50;  // binary
  const auto beyond_goal = [&](double time) {
    const RigidMotion motion = rigid_motion(barrel, time);
    return std::pair(motion.travel - goal, motion.velocity);
  };
  scene.load.muzzle_exit = boost::math::tools::newton_raphson_iterate(beyond_goal, end, 0.0, end, digits);
}

void check_load(const SceneFile& file) {
  const Load& load = file.scene.load;
  check_what_does_nothing(file);
  check_rescaling(file);
  if (!load.curve_time.empty() && load.duration && load.curve_time.back() < read_time(load) * (1.0 - 1e-9))
    throw fault_at(file, curve_key(load), "a curve that ends at " + time_text(load.curve_time.back()),
                   "a curve that lasts until load.duration, " + time_text(*load.duration));
  if (load.curve_time.empty() && load.base > load.peak)
    throw fault_at(
        file, file.given.contains("load.base") ? "load.base" : "load.peak",
        fmt::format("a base of {} and a peak of {}", pressure_text(load.base), pressure_text(load.peak)),
        "a base pressure of at most the peak");
  check_end(file);
}

void check_expected_velocity(const SceneFile& file) {
  constexpr double largest_difference = 0.05;
  const std::optional<double> expected = file.scene.load.expected_velocity;
  if (!expected) return;
  Scene whole = file.scene;
  whole.load.duration.reset();
  const double time = read_time(whole.load), velocity = rigid_motion(whole, time).velocity;
  if (std::abs(*expected - velocity) <= largest_difference * velocity) return;
  throw fault_at(file, "load.expected_velocity",
                 fmt::format("{:.4g} m/s, while the load drives the projectile to {}, at {}", *expected,
                             rigid_motion_text(whole, time), time_text(time)),
                 fmt::format("within {:g} % of that: this, the pressure, a time or the mass is mistyped",
                             100.0 * largest_difference));
}

}  // namespace launchsafe::scene
