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

/// A ring without area at the axis beside one that is the whole bottom.
trace::BottomTrace two_rings(int intervals, const PressureOfInterval& pressure) {
  return pressed_bottom({{"S1", 0.0, 0.0, 0.0, false}, {"S2", 0.0, 0.0, 0.01, false}}, intervals, duration,
                        pressure);
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

void assess_balance(Bounds& bounds, const HistoryLaw& law, double exchange_time) {
  surface::SkinModel model = inert_skin(exchange_time);
  model.surface.air_model = scene::AirModel::balance;
  const double pressure = 140e6, start = model.initial_temperature;
  const double ratio = surface::heat_capacity_ratio(model, gap);
  const double air = materials::adiabatic_temperature(model.surface.air, pressure);
  const double mixture = (start + ratio * air) / (1.0 + ratio);
  // kappa h/tau_ex for the skin and 1/tau_ex for the air.
  const double rate = (1.0 + ratio) / exchange_time;
  for (const int intervals : {1, 18, 900}) {
    const trace::BottomTrace trace = two_rings(intervals, [&](double, double) {
      return PressureSample{pressure, pressure};
    });
    const surface::SkinHistory history = law(model, trace, gap);
    if (!is_complete(bounds, history, trace)) return;
    const std::size_t stations = trace.stations.size();
    for (std::size_t sample = 0; sample < trace.samples(); ++sample) {
      const double exact = start - (mixture - start) * std::expm1(-rate * trace.time[sample]);
      for (std::size_t station = 0; station < stations; ++station) {
        const double skin = history.temperature[sample * stations + station];
        bounds.at_most("distance from the exact exponential, K", std::abs(skin - exact), 1e-6);
        bounds.never("the skin overshoots the air", skin > history.air_temperature[sample] + 1e-9);
      }
      const double skin = history.temperature[sample * stations + 1];
      // Heat the air gave against heat the skin took, over all that it could give.
      const double imbalance = ratio * (air - history.air_temperature[sample]) - (skin - start);
      bounds.at_most("energy created or lost, share of the heat of the air",
                     std::abs(imbalance) / (ratio * air), 1e-12);
    }
    bounds.at_most("energy residual that the history itself states", history.energy_residual, 1e-9);
  }
}

void assess_balance_under_load(Bounds& bounds, const HistoryLaw& law, double exchange_time) {
  constexpr double rise = 1.8e-3, low = 101325.0, high = 140e6;
  // Linear in a tenth of the launch, then constant: its integral is exact.
  const auto integral = [&](double t) {
    const double rising = std::min(t, rise);
    return low * t + (high - low) * (0.5 * rising * rising / rise + (t - rising));
  };
  const auto pressure = [&](double t) { return low + (high - low) * std::min(t, rise) / rise; };
  surface::SkinModel model = inert_skin(exchange_time);
  model.surface.air_model = scene::AirModel::balance;
  std::array<double, 2> last{};
  for (const std::size_t finer : {0U, 1U}) {
    const trace::BottomTrace trace = two_rings(finer == 0 ? 900 : 9000, with_integral(pressure, integral));
    const surface::SkinHistory history = law(model, trace, gap);
    if (!is_complete(bounds, history, trace)) return;
    for (std::size_t sample = 0; sample < trace.samples(); ++sample) {
      const double skin = history.temperature[sample * trace.stations.size()];
      bounds.at_most("skin hotter than the air that heats it, K",
                     std::max(0.0, skin - history.air_temperature[sample]), 1e-6);
    }
    bounds.at_most("energy residual that the history itself states", history.energy_residual, 1e-9);
    last[finer] = history.temperature.back();
  }
  bounds.at_most("skin on the samples of a run against ten times as many, K", std::abs(last[0] - last[1]),
                 1e-2);
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
    tests.push_back({group, name + ", balance, 1 to 900 intervals",
                     "Air and skin go to the temperature of their mixture as the exact exponential says; no "
                     "energy is made or lost.",
                     [exchange_time](Bounds& bounds) {
                       assess_balance(bounds, surface::integrate_skin, exchange_time);
                     }});
  }
  for (const double exchange_time : {1e-9, 1e-7, 1e-5, 3e-4, 1.0}) {
    tests.push_back({group, "tau_ex " + duration_text(exchange_time) + ", balance, load that rises in 1.8 ms",
                     "The skin never passes the air; no energy is made or lost; a trace of 20 us is as good "
                     "as one of 2 us, to 0.01 K.",
                     [exchange_time](Bounds& bounds) {
                       assess_balance_under_load(bounds, surface::integrate_skin, exchange_time);
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
