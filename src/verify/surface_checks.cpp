#include "checks.hpp"
#include "launchsafe/materials/air_conductivity.hpp"
#include "launchsafe/surface/film.hpp"
#include "launchsafe/surface/skin.hpp"
#include "skin_scenes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace launchsafe::verify {
namespace {

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

/// Time (s) to thermal explosion from a temperature (K), with `dt` (s) between calls. The expected numbers
/// are those to 2000 K; from there to the trigger at 1e9 K it takes 1e-13 s.
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

Checks induction_checks() {
  Checks checks;
  const auto add = [&](int temperature, double expected, const std::string& called, double dt) {
    checks.push_back({fmt::format("induction from {} K, calls every {}", temperature, called),
                      induction_time(temperature, dt), expected, 1e-6, "s",
                      "quadrature of dT/(Q Z/c exp(-27000 K/T)) to 2000 K", Tolerance::relative});
  };
  add(600, 7.425578e-2, "10 us", 1e-5);
  add(600, 7.425578e-2, "1 ms", 1e-3);
  for (const auto& [called, dt] :
       {std::pair{"0.1 us", 1e-7}, std::pair{"10 us", 1e-5}, std::pair{"1 ms", 1e-3}}) {
    add(650, 2.746044e-3, called, dt);
    add(700, 1.645534e-4, called, dt);
    add(750, 1.449736e-5, called, dt);
  }
  add(750, 1.449736e-5, "1 ns", 1e-9);
  return checks;
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

Checks exchange_checks() {
  using enum Tolerance;
  Checks checks;
  constexpr double gap = 4e-4, duration = 18e-3;
  surface::SkinModel model = inert_skin(3.6e-4);
  const double ratio = surface::heat_capacity_ratio(model, 0.01);
  checks.push_back({"heat capacity of the air over that of the skin, gap 1 cm", ratio, 0.03869052, 5.01e-9,
                    "", "1.1766 0.01 1005/(1717 1e-4 1780) by hand"});
  checks.push_back({"the same against the number with the air's density unrounded", ratio, 0.0386911, 4.3e-5,
                    "", "the density 1.1766 is known to 4.3e-5", relative});
  const double rate = surface::heat_capacity_ratio(model, gap) / 3.6e-4;
  const double constant = 1500.0 - 1200.0 * std::exp(-rate * duration);
  // T' = k (300 + s t - T) from 300: T = 300 + s (t - (1 - exp(-k t))/k).
  const double slope = 2000.0 / duration;
  const double linear = 300.0 + slope * (duration + std::expm1(-rate * duration) / rate);
  for (const int calls : {1, 1000, 100000}) {
    const std::string in_calls = ", " + std::to_string(calls) + " calls";
    checks.push_back({"air at 1500 K for 18 ms" + in_calls,
                      skin_after(model, gap, duration, calls, 1500.0, 1500.0), constant, 1e-10, "K",
                      "exact solution", relative});
    checks.push_back({"air rising to 2300 K over 18 ms" + in_calls,
                      skin_after(model, gap, duration, calls, 300.0, 2300.0), linear, 1e-10, "K",
                      "exact solution", relative});
  }
  const double stiff_rate = surface::heat_capacity_ratio(model, gap) / 1e-9;
  checks.push_back({"air rising to 2300 K, tau_ex = 1 ns",
                    skin_after(inert_skin(1e-9), gap, duration, 1000, 300.0, 2300.0),
                    2300.0 - slope / stiff_rate, 1e-10, "K",
                    "the skin follows the air by one relaxation time", relative});
  return checks;
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

Checks launch_checks() {
  const trace::BottomTrace trace = smooth_launch(900);
  surface::SkinModel model = plain_model();
  const double thinned = hottest(model, trace::thinned(trace), 3e-4), whole = hottest(model, trace, 3e-4);
  // Concave: each further tenth of a millimetre adds less than the one before.
  double increments[3];
  for (int k = 0; k < 3; ++k)
    increments[k] = hottest(model, trace, 1e-4 * (k + 1)) - hottest(model, trace, 1e-4 * k);
  const bool concave = increments[0] > increments[1] && increments[1] > increments[2] && increments[2] > 0.0;
  return {
      {"a trace with half the samples, gap 0.3 mm", thinned, whole, 1e-3, "K", "the trace with all samples"},
      {"gap increments fall from 0.1 to 0.3 mm", concave ? 1.0 : 0.0, 1.0, 0.0, "",
       "shape of the paper's Table 8: 26.1, 25.5, 25.2 K"}};
}

/// From rest on as exp(t/tau).
trace::BottomTrace exponential_rise(int intervals, double duration, double tau) {
  constexpr double rest = 101325.0;  // Pa
  return pressed_bottom({{"S1", 0.0, 0.0, 0.01, false}}, intervals, duration,
                        with_integral([=](double t) { return rest * std::exp(t / tau); },
                                      [=](double t) { return rest * tau * std::expm1(t / tau); }));
}

Check conductivity(int temperature, double expected) {
  return {"conductivity of air at " + std::to_string(temperature) + " K",
          materials::air_conductivity(temperature),
          expected,
          0.02,
          "W/(m K)",
          "Incropera & DeWitt, table A.4; Sutherland's law keeps to 2 %",
          Tolerance::relative};
}

Check adiabat() {
  surface::SkinModel model = inert_film();
  model.charge_conductivity = model.base_conductivity = 0.0;
  const trace::BottomTrace trace = exponential_rise(60, 6e-3, 1e-3);
  return {"walls that conduct nothing, 40.9 MPa",
          surface::integrate_skin(model, trace, 4e-4).air_temperature.back(),
          300.0 * std::exp(6.0 * 0.4 / 1.4),
          1e-11,
          "K",
          "the adiabat T0 (p/p0)^(2/7)",
          Tolerance::relative};
}

/// Air so thin that it keeps the temperature of the walls gives the work p0 h/tau a second as heat.
Checks isotherm() {
  constexpr double thin = 1e-7, duration = 6e-3, tau = 1e-3;
  const surface::SkinModel model = inert_film();
  const trace::BottomTrace trace = exponential_rise(120, duration, tau);
  const surface::FilmHistory film = surface::integrate_film(model, trace, thin);
  const double flux = model.surface.air.initial_pressure * thin / tau;  // W/m2
  const double charge = std::sqrt(model.charge_conductivity * model.charge_density * model.specific_heat);
  const double base = std::sqrt(model.base_conductivity * model.base_density * model.base_specific_heat);
  return {{"heat of air compressed 403-fold in 0.1 um", film.energy[0].charge + film.energy[0].base,
           flux * duration, 1e-3, "J/m2", "isotherm: p0 h ln(p/p0)", Tolerance::relative},
          {"rise of the charge's surface under that heat",
           film.skin.temperature.back() - model.initial_temperature,
           2.0 * flux * std::sqrt(duration / std::numbers::pi) / (charge + base), 5e-3, "K",
           "two half-spaces under a constant flux between them, Carslaw & Jaeger 2.9", Tolerance::relative}};
}

Check conservation(const std::string& name, double gap) {
  const trace::BottomTrace trace = exponential_rise(60, 6e-3, 1e-3);
  return {name, surface::integrate_skin(inert_film(), trace, gap).energy_residual,
          0.0,  1e-12,
          "",   "conservation to round-off"};
}

Checks film_checks() {
  Checks checks{conductivity(300, 0.0263), conductivity(600, 0.0469), conductivity(1000, 0.0667), adiabat()};
  for (Check& check : isotherm()) checks.push_back(std::move(check));
  checks.push_back(conservation("energy made or lost, gap 0.1 mm", 1e-4));
  checks.push_back(conservation("the same, gap 4 mm", 4e-3));
  return checks;
}

}  // namespace

std::vector<Computation> surface_computations() {
  return {{"induction", induction_checks},
          {"exchange", exchange_checks},
          {"launch", launch_checks},
          {"film of air", film_checks}};
}

}  // namespace launchsafe::verify
