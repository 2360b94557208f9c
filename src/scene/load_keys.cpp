// The keys of a load, and what it must satisfy beyond the range of each: a measured curve, what stands beside
// it, and its end.
#include "launchsafe/scene/load.hpp"
#include "scene_file.hpp"

#include <iterator>

namespace launchsafe::scene {
namespace {

bool has_exit(const Load& load) { return load.muzzle_exit || load.muzzle_travel; }

bool is_bell(const Load& load) { return load.shape == LoadShape::bell; }

/// The key of a number that a measured curve takes the place of, unless it is scaled to it.
auto analytic(bool scales = false) {
  return [scales](Key<Load>& key) {
    key.is_replaced = [scales](const Load& load) {
      return !load.curve_time.empty() && !(scales && load.rescale_to_peak);
    };
  };
}

/// A measured curve beside a peak that would silently do nothing, and one that ends too early. A study that
/// gives a scene a curve replaces its peak. A scene written back has its curve's points rather than their
/// file, and every key: its peak is no sign of a mistake.
void check_curve_use(const SceneFile& file) {
  const Load& load = file.scene.load;
  if (load.curve_time.empty()) return;
  const Given *peak = find_in(file.given, "load.peak"), *curve = find_in(file.given, "load.curve");
  const bool replaced = peak && curve && curve->place.file != file.file && peak->place.file == file.file;
  if (peak && !replaced && !load.curve_file.empty() && !load.rescale_to_peak)
    throw fault_at(file, "load.peak",
                   pressure_text(load.peak) + " beside a measured curve, which has a peak of its own",
                   "load.curve alone, or both with load.rescale_to_peak = true");
  if (load.duration && load.curve_time.back() < read_time(load) * (1.0 - 1e-9))
    throw fault_at(file, load.curve_file.empty() ? "load.curve_time" : "load.curve",
                   "a curve that ends at " + time_text(load.curve_time.back()),
                   "a curve that lasts until the end of the launch, " + time_text(*load.duration) +
                       ", or no load.duration, with which it ends at its last point");
}

/// Numbers of the other analytic shape would silently do nothing.
void check_shape(const SceneFile& file) {
  const bool bell = file.scene.load.shape == LoadShape::bell;
  const std::vector<std::string> of_bell{"load.width", "load.steepness"}, of_power{"load.exponent"};
  for (const std::string& key : bell ? of_power : of_bell) {
    if (file.given.contains(key))
      throw fault_at(
          file, key,
          fmt::format("a number that the shape \"{}\" does not have", word_of(file.scene.load.shape)),
          fmt::format("{}, or another load.shape", fmt::join(bell ? of_bell : of_power, " and ")));
  }
}

/// A curve of next to nothing has no shape that could be scaled.
void check_rescaling(const SceneFile& file) {
  constexpr double least_peak = 1.0;  // Pa
  const Load& load = file.scene.load;
  if (load.curve_pressure.empty() || !load.rescale_to_peak) return;
  const double measured = *std::ranges::max_element(load.curve_pressure);
  if (measured >= least_peak) return;
  throw fault_at(file, "load.rescale_to_peak",
                 fmt::format("true with a curve whose largest pressure is {}", pressure_text(measured)),
                 "a curve that reaches " + pressure_text(least_peak));
}

void check_smoothing(const SceneFile& file) {
  const Load& load = file.scene.load;
  if (!(load.smoothing > 0.0)) return;
  const std::string window = time_text(load.smoothing);
  if (load.curve_time.empty())
    throw fault_at(file, "load.smoothing", window + " without a measured curve",
                   "a window only together with load.curve");
  const double length = load.curve_time.back() - load.curve_time.front();
  if (load.smoothing >= least_smoothing_share * length && load.smoothing <= length) return;
  throw fault_at(file, "load.smoothing", window,
                 fmt::format("a window from {} to that of the measured curve, {}, or 0 ms for none",
                             time_text(least_smoothing_share * length), time_text(length)));
}

/// Largest difference of a stated travel from that which the load gives at the stated exit.
constexpr double largest_difference_of_travel = 0.05;
/// Likewise of a velocity that is expected.
constexpr double largest_difference_of_velocity = 0.05;
/// s; no launch is longer.
constexpr double longest_launch = 1.0;

/// What only an exit gives a meaning to.
void check_without_exit(const SceneFile& file) {
  if (file.given.contains("load.exit_decay"))
    throw fault_at(file, "load.exit_decay", "a number of the muzzle exit, which is not stated",
                   "only together with load.muzzle_exit or load.muzzle_travel");
}

void check_travel(const SceneFile& file) {
  const Load& load = file.scene.load;
  if (!load.muzzle_travel) return;
  const double stated = *load.muzzle_travel;
  Scene barrel = file.scene;
  barrel.load = without_exit(load);
  barrel.load.duration.reset();
  if (!load.muzzle_exit) {
    if (exit_time(load)) return;
    const double end = launch_end(barrel.load);
    throw fault_at(file, "load.muzzle_travel", length_text(stated) + ", which the projectile does not reach",
                   fmt::format("at most {}, where the load drives it until it ends at {}",
                               length_text(rigid_motion(barrel, end).travel), time_text(end)));
  }
  const double travel = rigid_motion(barrel, *load.muzzle_exit).travel;
  if (std::abs(stated - travel) <= largest_difference_of_travel * travel) return;
  throw fault_at(
      file, "load.muzzle_travel",
      fmt::format("{}, while the load drives the projectile {:.3g} m until load.muzzle_exit, {}",
                  length_text(stated), travel, time_text(*load.muzzle_exit)),
      fmt::format("within {:g} % of that, or one of the two alone", 100.0 * largest_difference_of_travel));
}

/// An exit that is no end of this load.
void check_exit(const SceneFile& file) {
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
  if (!(exit > peak)) throw fault_at(file, key, found + ", not after the peak of the load", allowed);
  if (exit > end * (1.0 + 1e-9)) throw fault_at(file, key, found + ", after the end of the load", allowed);
}

/// The first fault of `load.muzzle_exit`, `.muzzle_travel` and what depends on them, or of a load without
/// end.
void check_end(const SceneFile& file) {
  const Load& load = file.scene.load;
  if (load.muzzle_exit || load.muzzle_travel) {
    check_travel(file);
    return check_exit(file);
  }
  check_without_exit(file);
  const double end = end_time(load);
  if (end > 0.0 && end <= longest_launch) return;
  const bool measured = !load.curve_time.empty();
  const std::string key =
      measured ? load.curve_file.empty() ? "load.curve_time" : "load.curve" : "load.peak_time";
  throw fault_at(file, key, fmt::format("a load that ends at {}", time_text(end)),
                 fmt::format("a load that is over within {}, or load.duration", time_text(longest_launch)));
}

}  // namespace

std::vector<Key<Load>> load_keys() {
  return {
      optional_number_key<Load>("duration", Dimension::time, above_to(0, 1),
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
      optional_number_key<Load>("muzzle_exit", Dimension::time, above_to(0, 1),
                                "Time at which the shot leaves the barrel.", &Load::muzzle_exit) |
          overriding({"muzzle_travel"}),
      optional_number_key<Load>("muzzle_travel", Dimension::length, above_to(0, 100),
                                "Travel of the projectile after which it leaves the barrel; the time follows "
                                "from the load, or is checked where it is stated.",
                                &Load::muzzle_travel) |
          overriding({"muzzle_exit"}),
      number_key("exit_decay", Dimension::time, between(0.02e-3, 5e-3), Standing::assumed,
                 "Time constant with which the pressure falls after the muzzle exit: by default about "
                 "that in which rarefactions from the rim of a 155 mm bore reach its axis.",
                 &Load::exit_decay) |
          written_where(has_exit),
      // Never written back: it makes no other launch, and a case with another load is none that was typed.
      optional_number_key<Load>("expected_velocity", Dimension::speed, above_to(0, 5e3),
                                "Velocity at the muzzle, typed from a range table: a load that drives the "
                                "projectile to another one, by more than 5 %, is refused.",
                                &Load::expected_velocity) |
          written_where([](const Load&) { return false; }) | acting_on(ActsOn::nothing),
      optional_number_key<Load>("obturation", Dimension::length, between(0, 10),
                                "Place along x of the driving band, up to which the chamber pressure acts on "
                                "all that faces the chamber; without it the foremost annulus of full radius.",
                                &Load::obturation),
  };
}

void check_curve(const SceneFile& file) {
  const Load& load = file.scene.load;
  if (load.curve_time.size() != load.curve_pressure.size())
    throw fault_at(file, "load.curve_pressure",
                   fmt::format("{} values for {} times", load.curve_pressure.size(), load.curve_time.size()),
                   "one pressure for every time");
  if (load.curve_time.size() == 1)
    throw fault_at(file, "load.curve_time", "1 point", "a curve of at least two points");
  const auto& times = load.curve_time;
  const auto late =
      std::ranges::adjacent_find(times, [](double a, double b) { return !(b - a > least_curve_interval); });
  if (late != times.end())
    throw fault_at(file, "load.curve_time",
                   fmt::format("{} followed by {}", time_text(*late), time_text(*std::next(late))),
                   "times in increasing order, more than " + time_text(least_curve_interval) + " apart");
  check_smoothing(file);
}

void check_load(const SceneFile& file) {
  const Load& load = file.scene.load;
  check_shape(file);
  check_curve_use(file);
  check_rescaling(file);
  if (load.curve_time.empty() && load.rescale_to_peak)
    throw fault_at(file, "load.rescale_to_peak", "true without a measured curve",
                   "true together with load.curve");
  if (load.curve_time.empty() && load.base > load.peak)
    throw fault_at(
        file, file.given.contains("load.base") ? "load.base" : "load.peak",
        fmt::format("a base of {} and a peak of {}", pressure_text(load.base), pressure_text(load.peak)),
        "a base pressure of at most the peak");
  return check_end(file);
}

void check_expected_velocity(const SceneFile& file) {
  const std::optional<double> expected = file.scene.load.expected_velocity;
  if (!expected) return;
  Scene whole = file.scene;
  whole.load.duration.reset();
  const double time = read_time(whole.load), velocity = rigid_motion(whole, time).velocity;
  if (std::abs(*expected - velocity) <= largest_difference_of_velocity * velocity) return;
  throw fault_at(file, "load.expected_velocity",
                 fmt::format("{:.4g} m/s, while the load drives the projectile to {}, at {}", *expected,
                             rigid_motion_text(whole, time), time_text(time)),
                 fmt::format("within {:g} % of that: this, the pressure, a time or the mass is mistyped",
                             100.0 * largest_difference_of_velocity));
}

}  // namespace launchsafe::scene
