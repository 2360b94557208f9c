#include "launchsafe/verify/surface_checks.hpp"

#include "launchsafe/surface/skin.hpp"
#include "skin_scenes.hpp"

#include <cmath>
#include <utility>

namespace launchsafe::verify {

namespace {

using Checks = std::vector<Check>;

/// A skin that never ignites, with the printed kinetics.
/// Round constants, so that the checks do not move when the calibrated defaults do.
surface::SkinModel plain_model() {
  surface::SkinModel model;
  model.surface.localisation = 300.0;
  model.surface.exchange_time = 3.6e-4;
  model.kinetics.ignition_temperature = 525.0;
  return model;
}

surface::SkinModel inert_trigger() {
  surface::SkinModel model = plain_model();
  model.kinetics.activation_temperature = 2.7e4;
  model.kinetics.ignition_temperature = 1e9;
  model.kinetics.burnt_temperature = 2e9;
  return model;
}

/// Time (s) to thermal explosion from a temperature, with `dt` between calls. The way from 2000 K, where the
/// expected numbers stop, to the trigger at 1e9 K takes 1e-13 s.
double induction_time(double temperature, double dt) {
  const surface::SkinModel model = inert_trigger();
  surface::SkinPoint point{temperature};
  double time = 0.0;
  for (long step = 0; step < 100000000 && !point.ignited && std::isfinite(point.temperature); ++step) {
    point = surface::advance_skin(model, 0.0, point, dt, 300.0, 300.0, 0.0);
    time = static_cast<double>(step) * dt + (point.ignited ? point.ignition_time : dt);
  }
  return point.ignited ? time : std::nan("");
}

void add_induction(Checks& checks) {
  const auto add = [&](double temperature, double expected, double dt) {
    const std::string name = "induction from " + std::to_string(static_cast<int>(temperature)) +
                             " K, calls every " +
                             (dt < 1e-8   ? "1 ns"
                              : dt < 1e-6 ? "0.1 us"
                              : dt < 1e-4 ? "10 us"
                                          : "1 ms");
    checks.push_back({"induction", name, induction_time(temperature, dt), expected, 1e-6, "s",
                      "quadrature of dT/(Q Z/c exp(-27000 K/T)) to 2000 K", false});
  };
  for (const double dt : {1e-5, 1e-3}) add(600.0, 7.425578e-2, dt);
  for (const double dt : {1e-7, 1e-5, 1e-3}) {
    add(650.0, 2.746044e-3, dt);
    add(700.0, 1.645534e-4, dt);
    add(750.0, 1.449736e-5, dt);
  }
  add(750.0, 1.449736e-5, 1e-9);
}

/// Skin temperature under air from `air_begin` to `air_end` over `duration`, in `calls` calls.
double skin_after(const surface::SkinModel& model, double gap, double duration, int calls, double air_begin,
                  double air_end) {
  surface::SkinPoint point{300.0};
  for (int call = 0; call < calls; ++call) {
    const auto air = [&](int k) { return air_begin + (air_end - air_begin) * k / calls; };
    point = surface::advance_skin(model, gap, point, duration / calls, air(call), air(call + 1), 0.0);
  }
  return point.temperature;
}

void add_exchange(Checks& checks) {
  const std::string group = "exchange";
  constexpr double gap = 4e-4, duration = 18e-3;
  surface::SkinModel model = inert_skin(3.6e-4);
  const double ratio = surface::heat_capacity_ratio(model, 0.01);
  checks.push_back({group, "heat capacity of the air over that of the skin, gap 1 cm", ratio, 0.03869052,
                    5.01e-9, "", "1.1766 0.01 1005/(1717 1e-4 1780) by hand", true});
  checks.push_back({group, "the same against the number with the air's density unrounded", ratio, 0.0386911,
                    4.3e-5, "", "the density 1.1766 is known to 4.3e-5", false});
  const double rate = surface::heat_capacity_ratio(model, gap) / 3.6e-4;
  const double constant = 1500.0 - 1200.0 * std::exp(-rate * duration);
  // T' = k (300 + s t - T) from 300: T = 300 + s (t - (1 - exp(-k t))/k).
  const double slope = 2000.0 / duration;
  const double linear = 300.0 + slope * (duration + std::expm1(-rate * duration) / rate);
  for (const int calls : {1, 1000, 100000}) {
    const std::string in_calls = ", " + std::to_string(calls) + " calls";
    checks.push_back({group, "air at 1500 K for 18 ms" + in_calls,
                      skin_after(model, gap, duration, calls, 1500.0, 1500.0), constant, 1e-10, "K",
                      "exact solution", false});
    checks.push_back({group, "air rising to 2300 K over 18 ms" + in_calls,
                      skin_after(model, gap, duration, calls, 300.0, 2300.0), linear, 1e-10, "K",
                      "exact solution", false});
  }
  const double stiff_rate = surface::heat_capacity_ratio(model, gap) / 1e-9;
  checks.push_back({group, "air rising to 2300 K, tau_ex = 1 ns",
                    skin_after(inert_skin(1e-9), gap, duration, 1000, 300.0, 2300.0),
                    2300.0 - slope / stiff_rate, 1e-10, "K",
                    "the skin follows the air by one relaxation time", false});
}

/// A smooth launch on `samples` intervals: the default load on the charge bottom and friction that follows
/// it.
trace::BottomTrace smooth_launch(int intervals) {
  const auto pressure = [](double t) {
    const double shape = t / 11e-3 * std::exp(1.0 - t / 11e-3);
    return 101325.0 + 140e6 * std::pow(shape, 12.0);
  };
  const auto sample = [&](double begin, double end) {
    constexpr int parts = 8;  // Simpson's rule for the means
    double mean = 0.0;
    for (int k = 0; k <= parts; ++k) {
      const double weight = k == 0 || k == parts ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
      mean += weight / (3.0 * parts) * pressure(begin + (end - begin) * k / parts);
    }
    return PressureSample{pressure(end), end > begin ? mean : pressure(end)};
  };
  trace::BottomTrace trace = pressed_bottom({{"S1", 0.678, 0.0625, 0.0, false},
                                             {"S2", 0.678, 0.0025, 0.0, false},
                                             {"S3", 0.678, 0.0325, 0.0133, false}},
                                            intervals, 18e-3, sample);
  for (double& steps : trace.steps) steps *= 100.0;
  const double shares[] = {1.0, 0.8, 0.9};
  for (auto& closure : trace.friction)
    for (std::size_t k = 0; k < closure.size(); ++k)
      closure[k] = shares[k % 3] * (1.0e6 * std::pow(trace.time[k / 3] / 18e-3, 3.0));
  return trace;
}

double hottest(const surface::SkinModel& model, const trace::BottomTrace& trace, double gap) {
  return surface::maximum_at_stations(surface::integrate_skin(model, trace, gap), trace).temperature;
}

void add_launch(Checks& checks) {
  const std::string group = "launch";
  const trace::BottomTrace trace = smooth_launch(900);
  surface::SkinModel model = plain_model();
  const double thinned = hottest(model, trace::thinned(trace), 3e-4);
  checks.push_back({group, "a trace with half the samples, gap 0.3 mm", thinned, hottest(model, trace, 3e-4),
                    1e-3, "K", "the trace with all samples", true});
  // Concave: each further tenth of a millimetre adds less than the one before.
  double increments[3];
  for (int k = 0; k < 3; ++k) {
    increments[k] = hottest(model, trace, 1e-4 * (k + 1)) - hottest(model, trace, 1e-4 * k);
  }
  const bool concave = increments[0] > increments[1] && increments[1] > increments[2] && increments[2] > 0.0;
  checks.push_back({group, "gap increments fall from 0.1 to 0.3 mm", concave ? 1.0 : 0.0, 1.0, 0.0, "",
                    "shape of the paper's Table 8: 26.1, 25.5, 25.2 K", true});
  model.surface.air_model = scene::AirModel::balance;
  const surface::SkinHistory balanced = surface::integrate_skin(model, trace, 3e-4);
  checks.push_back({group, "energy lost between air and skin, relative", balanced.energy_residual, 0.0, 1e-9,
                    "", "conservation to round-off", true});
}

/// Air at the pressure of the peak gives all it has: both end at the temperature of the mixture.
void add_mixture(Checks& checks) {
  surface::SkinModel model = inert_skin(1e-6);
  model.surface.air_model = scene::AirModel::balance;
  model.surface.friction = scene::FrictionClosure::none;
  trace::BottomTrace trace = smooth_launch(4);
  for (auto* pressure : {&trace.bottom_pressure, &trace.mean_bottom_pressure}) pressure->assign(5, 140e6);
  const surface::SkinHistory history = surface::integrate_skin(model, trace, 4e-4);
  const double ratio = surface::heat_capacity_ratio(model, 4e-4);
  const double air = materials::adiabatic_temperature(model.surface.air, 140e6);
  checks.push_back({"launch", "skin in balance with air of 140 MPa", history.temperature.back(),
                    (300.0 + ratio * air) / (1.0 + ratio), 1e-10, "K", "mixing temperature of two bodies",
                    false});
}

}  // namespace

std::vector<Check> surface_checks() {
  Checks checks;
  add_induction(checks);
  add_exchange(checks);
  add_launch(checks);
  add_mixture(checks);
  for (Check& check : film_checks()) checks.push_back(std::move(check));
  return checks;
}

}  // namespace launchsafe::verify
