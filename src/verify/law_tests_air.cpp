// The air beside the skin: exchange of heat against exact exponentials, the film of air under gaps up to a
// centimetre and loads from slow to sudden, and the air on its adiabat.
#include "law_tests.hpp"
#include "skin_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace launchsafe::verify::law_tests {

namespace {

constexpr double gap = 4e-4, duration = 18e-3;  // m, s
constexpr long most_exchange_calls = 20000;
constexpr double round_off = 2.3e-16;

/// T(t) of T' = k (air + slope t - T) from `start`: air(t) - slope/k (1 - e^-kt) + (start - air) e^-kt.
double exact_exchange(double rate, double air, double slope, double start, double time) {
  const double x = rate * time;
  // slope (t - (1 - e^-x)/k), by its series where the two terms nearly cancel.
  const double followed = x < 1e-4 ? time * x * (0.5 - x / 6.0) : time + std::expm1(-x) / rate;
  return start - (air - start) * std::expm1(-x) + slope * followed;
}

/// A pressure that rises linearly within `rise` (s) from rest to `peak` (Pa) and then stays: its integral is
/// exact.
PressureOfInterval linear_rise(double rise, double peak) {
  const double low = 101325.0, slope = (peak - low) / rise;
  const auto integral = [=](double t) {
    const double rising = std::min(t, rise);
    return low * t + slope * (0.5 * rising * rising + rise * (t - rising));
  };
  return with_integral([=](double t) { return low + slope * std::min(t, rise); }, integral);
}

/// Whether the history has the temperatures of all samples and stations.
bool is_complete(Bounds& bounds, const surface::SkinHistory& history, const trace::BottomTrace& trace) {
  const bool complete = history.temperature.size() == trace.stations.size() * trace.samples() &&
                        history.air_temperature.size() == trace.samples();
  bounds.never("samples are missing", !complete);
  return complete;
}

}  // namespace

void assess_exchange(Bounds& bounds, const SkinLaw& law, double exchange_time, double step) {
  struct Air {
    double begin, slope;  // K, K/s
  };
  const surface::SkinModel model = inert_skin(exchange_time);
  const double rate = surface::heat_capacity_ratio(model, gap) / exchange_time;
  const long calls =
      static_cast<long>(std::min(std::ceil(duration / step), static_cast<double>(most_exchange_calls)));
  const double start = 300.0;
  for (const Air air : {Air{1500.0, 0.0}, Air{300.0, 2000.0 / duration}, Air{250.0, 0.0}}) {
    surface::SkinPoint point{start};
    for (long call = 0; call < calls; ++call) {
      const double from = static_cast<double>(call) * step, to = static_cast<double>(call + 1) * step;
      const double before = point.temperature, air_end = air.begin + air.slope * to;
      point = law(model, gap, point, step, air.begin + air.slope * from, air_end, 0.0);
      const double allowed = 1e-10 * air_end + round_off * start * static_cast<double>(call + 1);
      bounds.at_most("distance from the exact exponential, K",
                     std::abs(point.temperature - exact_exchange(rate, air.begin, air.slope, start, to)),
                     allowed);
      const bool heats = air.begin >= start;
      const double beyond = heats ? point.temperature - air_end : air_end - point.temperature;
      bounds.never("the skin overshoots the air", beyond > 4.0 * round_off * air_end);
      bounds.never("the skin turns back", heats ? point.temperature < before : point.temperature > before);
      bounds.never("an inert skin ignites", point.ignited);
    }
  }
}

void assess_printed_exchange(Bounds& bounds, const SkinLaw& law, double wide, double step) {
  surface::SkinModel model = inert_skin(1.0);
  model.surface.exchange = scene::Exchange::per_step;
  const double ratio = surface::heat_capacity_ratio(model, wide), start = 300.0, air = 1500.0;
  surface::SkinPoint point{start};
  for (int call = 1; call <= 1000; ++call) {
    point = law(model, wide, point, step, air, air, 0.0);
    if (ratio >= 1.0) {
      bounds.never("air that holds more heat than the skin gives it a temperature",
                   std::isfinite(point.temperature));
      bounds.caught("NaN: the printed form means nothing where one step gives all and more");
      return;
    }
    const double exact = air - (air - start) * std::pow(1.0 - ratio, call);
    bounds.at_most("distance from (1 - kappa h)^n, K", std::abs(point.temperature - exact), 1e-9);
    bounds.never("the skin overshoots the air", point.temperature > air * (1.0 + 4.0 * round_off));
  }
}

void assess_film(Bounds& bounds, const HistoryLaw& law, double wide, double rise, double peak) {
  const surface::SkinModel model = inert_film();
  const double start = model.initial_temperature;
  double last[2] = {start, start};
  for (const int finer : {0, 1}) {
    const trace::BottomTrace trace = pressed_bottom({{"S1", 0.0, 0.0, 0.01, false}}, finer == 0 ? 150 : 300,
                                                    1.5 * rise, linear_rise(rise, peak));
    const surface::SkinHistory history = law(model, trace, wide);
    if (!is_complete(bounds, history, trace)) return;
    for (std::size_t sample = 0; sample < trace.samples(); ++sample) {
      const double skin = history.temperature[sample], air = history.air_temperature[sample];
      const double adiabat =
          materials::adiabatic_temperature(model.surface.air, trace.bottom_pressure[sample]);
      bounds.never("a temperature that is not finite", !std::isfinite(skin) || !std::isfinite(air));
      bounds.at_most("air above its adiabat, K", std::max(0.0, air - adiabat), 1e-6);
      bounds.at_most("surface above the adiabat, K", std::max(0.0, skin - adiabat), 1e-6);
      bounds.at_most("surface below its start, K", std::max(0.0, start - skin), 1e-6);
    }
    last[finer] = history.temperature.back();
    bounds.never("an inert charge ignites", history.ignition.has_value());
    bounds.at_most("energy residual that the history itself states", history.energy_residual, 1e-11);
  }
  bounds.at_most("surface at the end on 150 samples against 300, K", std::abs(last[1] - last[0]),
                 1e-3 * (last[1] - start) + 1e-6);
}

void assess_air(Bounds& bounds, const AirLaw& law, double ratio) {
  const materials::AirParameters air;
  const double found = law(air, ratio * air.initial_pressure);
  if (std::isnan(ratio)) {
    bounds.never("no pressure gives a temperature", !std::isnan(found));
    bounds.caught("NaN gives NaN");
    return;
  }
  if (ratio <= 1.0) {
    bounds.at_most("distance from the initial temperature, K", std::abs(found - air.initial_temperature),
                   0.0);
    return;
  }
  const long double exponent = (static_cast<long double>(air.heat_ratio) - 1.0L) / air.heat_ratio;
  const long double exact =
      air.initial_temperature * std::exp(exponent * std::log(static_cast<long double>(ratio)));
  bounds.at_most("relative distance from T0 ratio^(2/7)", static_cast<double>(std::abs(found / exact - 1.0L)),
                 1e-14);
}

LawTests exchange_tests() {
  LawTests tests;
  const std::string group = "stiff: exchange";
  for (int decade = -9; decade <= 0; ++decade) {
    const double exchange_time = std::pow(10.0, decade);
    const std::string name = "tau_ex " + duration_text(exchange_time);
    tests.push_back({group, name + ", reservoir, steps 1 ns to 1 ms",
                     "The skin follows the exact exponential under constant, rising and colder air at every "
                     "outer step and never passes the air.",
                     [exchange_time](Bounds& bounds) {
                       for (const double step : {1e-9, 1e-7, 1e-5, 1e-4, 1e-3})
                         assess_exchange(bounds, surface::advance_skin, exchange_time, step);
                     }});
  }
  for (const double wide : {1e-9, gap, 5e-3, 0.2, 1.0}) {
    tests.push_back({group, fmt::format("printed form, gap {:g} m, steps 1 ns to 1 ms", wide),
                     "n calls leave (1 - kappa h)^n of the distance to the air, whatever the step; where one "
                     "step would give more than all, the law refuses.",
                     [wide](Bounds& bounds) {
                       for (const double step : {1e-9, 1e-6, 1e-3})
                         assess_printed_exchange(bounds, surface::advance_skin, wide, step);
                     }});
  }
  const std::string air = "stiff: air";
  tests.push_back(
      {air, "compression ratios 1 to 1e5", "The temperature is that of the adiabat.", [](Bounds& bounds) {
         for (int k = 1; k <= 500; ++k)
           assess_air(bounds, materials::adiabatic_temperature, std::pow(10.0, 0.01 * k));
       }});
  tests.push_back({air, "ratios below 1, at 0 and below 0",
                   "The air stays at its initial temperature, as the law says of a gap that does not open: "
                   "above the adiabat, so on the safe side.",
                   [](Bounds& bounds) {
                     for (const double ratio : {1.0, 1.0 - 1e-15, 0.5, 1e-5, 1e-310, 0.0, -1.0, -1e5})
                       assess_air(bounds, materials::adiabatic_temperature, ratio);
                   }});
  tests.push_back({air, "a pressure that is not a number", "No temperature comes out.", [](Bounds& bounds) {
                     assess_air(bounds, materials::adiabatic_temperature,
                                std::numeric_limits<double>::quiet_NaN());
                   }});
  return tests;
}

LawTests film_tests() {
  LawTests tests;
  for (const double wide : {1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2}) {
    for (const double rise : {1e-4, 1e-2}) {
      tests.push_back({"stiff: film of air",
                       fmt::format("gap {:g} m, 1 MPa to 1 GPa in {}", wide, duration_text(rise)),
                       "Air and surface stay between their start and the adiabat, no energy is made or lost, "
                       "and twice as many samples change nothing.",
                       [wide, rise](Bounds& bounds) {
                         for (const double peak : {1e6, 1e8, 1e9})
                           assess_film(bounds, surface::integrate_skin, wide, rise, peak);
                       }});
    }
  }
  return tests;
}

}  // namespace launchsafe::verify::law_tests
