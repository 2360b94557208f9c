#include "launchsafe/scene/pressure_curve.hpp"
#include "scene_file.hpp"

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

}  // namespace

std::vector<Key<Load>> load_keys() {
  return {
      optional_number_key<Load>("duration", Dimension::time, above_to(0, 1),
                                "Simulated time, from the ignition of the propellant on, to look at the "
                                "beginning alone; without it the launch is simulated until it is over.",
                                &Load::duration) |
          plausibly(between(1e-3, 0.1), "a shell leaves its tube after some milliseconds"),
      number_key("peak", Dimension::pressure, above_to(0, 10e9), Standing::paper, "Largest chamber pressure.",
                 &Load::peak) |
          plausibly(between(10e6, 1e9), "a mortar has 10 MPa, and no gun tube bears 1 GPa", over_range) |
          analytic(true),
      number_key("base", Dimension::pressure, between(0, 10e9), Standing::assumed,
                 "Chamber pressure at the start.", &Load::base) |
          plausibly(between(0, 20e6), "before the shell moves there is an igniter's pressure at most") |
          analytic(),
      number_key("peak_time", Dimension::time, above_to(0, 1), Standing::assumed,
                 "Time of the largest chamber pressure.", &Load::peak_time) |
          plausibly(between(0.2e-3, 0.05), "propellant burns for some milliseconds") | analytic(),
      word_key("shape", Standing::assumed,
               "base + (peak - base) exp(-|(t - peak_time)/width|^steepness), or "
               "base + (peak - base) ((t/peak_time) exp(1 - t/peak_time))^exponent.",
               {{word_of(LoadShape::bell), LoadShape::bell},
                {word_of(LoadShape::power_exponential), LoadShape::power_exponential}},
               &Load::shape) |
          overriding({"width", "steepness", "exponent"}) |
          written_where([](const Load& load) { return !is_bell(load); }) |
          always_plausible("whether a launch is covered is judged by its pressures") | analytic(),
      number_key("width", Dimension::time, above_to(0, 1), Standing::assumed,
                 "Time from the peak of a bell to where e times less is left of it.", &Load::width) |
          written_where(is_bell) |
          plausibly(between(0.2e-3, 0.02), "propellant burns for some milliseconds") | analytic(),
      number_key("steepness", Dimension::number, above_to(0, 100), Standing::assumed,
                 "How abruptly a bell rises and falls: 2 is that of Gauss.", &Load::steepness) |
          written_where(is_bell) |
          plausibly(between(1.1, 6), "gentler pulses have a cusp at their peak, steeper ones are boxes") |
          analytic(),
      number_key("exponent", Dimension::number, above_to(0, 1000), Standing::assumed,
                 "How steeply a power-exponential rises and falls.", &Load::exponent) |
          written_where([](const Load& load) { return !is_bell(load); }) |
          plausibly(between(1, 50), "gentler or steeper pulses than these no propellant makes") | analytic(),
      // The points of a measured curve are written back; the file they came from need not exist any more.
      text_key("curve", Standing::assumed,
               "Measured curve that replaces the analytic shape: a CSV file beside the "
               "scene, with a header such as time_ms,pressure_MPa; empty for none.",
               "pressure.csv", &Load::curve_file) |
          overriding({"curve_time", "curve_pressure"}) | written_where([](const Load&) { return false; }) |
          always_plausible("its pressures are judged by load.measured_peak and load.simulated_peak",
                           judged_elsewhere),
      list_key("curve_time", Dimension::time, between(-largest_curve_time, largest_curve_time),
               Standing::assumed, "Times of a measured curve written in the scene itself, increasing.",
               &Load::curve_time) |
          may_be_empty() |
          always_plausible("the launch that it makes is judged by load.launch_speed and load.travel"),
      list_key("curve_pressure", Dimension::pressure, between(0, largest_load), Standing::assumed,
               "Pressures of a measured curve written in the scene itself.", &Load::curve_pressure) |
          may_be_empty() |
          always_plausible("its largest is judged by load.measured_peak and load.simulated_peak"),
      flag_key("rescale_to_peak", Standing::assumed,
               "Scale the measured curve, after smoothing, so that its largest pressure is load.peak.",
               &Load::rescale_to_peak) |
          always_plausible("the factor is judged by load.rescaling"),
      number_key("smoothing", Dimension::time, between(0, 1), Standing::assumed,
                 "Window over which a measured curve is averaged against noise, which "
                 "heats falsely; it takes from narrow peaks; \"0 ms\" for none.",
                 &Load::smoothing) |
          written_where([](const Load& load) { return load.smoothing != 0.0; }) |
          zero_or_plausibly(between(1e-6, 1e-3),
                            "gauges ring and sample within a millisecond, and a longer average takes from "
                            "the pulse itself"),
      optional_number_key<Load>("muzzle_exit", Dimension::time, above_to(0, 1),
                                "Time at which the shot leaves the barrel.", &Load::muzzle_exit) |
          overriding({"muzzle_travel"}) |
          plausibly(between(1e-3, 0.1), "a shell leaves its tube after some milliseconds"),
      optional_number_key<Load>("muzzle_travel", Dimension::length, above_to(0, 100),
                                "Travel of the projectile after which it leaves the barrel; the time follows "
                                "from the load, or is checked where it is stated.",
                                &Load::muzzle_travel) |
          overriding({"muzzle_exit"}) |
          plausibly(between(0.5, 15), "mortars have a tube of a metre, guns one of 2 to 11 m"),
      number_key("muzzle_exit_spread", Dimension::time, between(0, 0.1), Standing::assumed,
                 "Half width (95 %) of the time of the muzzle exit.", &Load::muzzle_exit_spread) |
          written_where([](const Load& load) { return load.muzzle_exit_spread > 0.0; }) |
          plausibly(between(0, 2e-3), "ignition varies by some tenths of a millisecond", remark),
      number_key("exit_decay", Dimension::time, above_to(0, 1), Standing::assumed,
                 "Time constant with which the pressure falls after the muzzle exit: by default that "
                 "in which a shell of 155 mm at 800 m/s flies 2.6 calibres.",
                 &Load::exit_decay) |
          written_where(has_exit) |
          plausibly(between(0.1e-3, 3e-3), "the gas outruns the shot within some calibres"),
      // Never written back: it makes no other launch, and a case with another load is none that was typed.
      optional_number_key<Load>("expected_velocity", Dimension::speed, above_to(0, 5e3),
                                "Velocity at the muzzle, typed from a range table: a load that drives the "
                                "projectile to another one, by more than 5 %, is refused.",
                                &Load::expected_velocity) |
          written_where([](const Load&) { return false; }) |
          always_plausible("the speed that the load gives is judged by load.launch_speed", remark),
      optional_number_key<Load>("obturation", Dimension::length, between(0, 10),
                                "Place along x of the driving band, up to which the chamber pressure acts on "
                                "all that faces the chamber; without it the foremost ring of full radius.",
                                &Load::obturation) |
          always_plausible("it has to lie where the shell has its full radius", Role{}),
  };
}

}  // namespace launchsafe::scene
