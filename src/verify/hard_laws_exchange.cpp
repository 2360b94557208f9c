// Exchange of heat between air and skin against exact exponentials, and the air on its adiabat.
#include "hard_laws.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace launchsafe::verify::hard {

namespace {

constexpr double gap = 4e-4, duration = 18e-3;  // m, s
constexpr long most_exchange_calls = 20000;
constexpr double round_off = 2.3e-16;

surface::SkinModel inert_model(double exchange_time) {
  surface::SkinModel model;
  model.kinetics.frequency = 0.0;
  model.kinetics.ignition_temperature = model.kinetics.burnt_temperature = 1e9;
  model.surface.friction = scene::FrictionClosure::none;
  model.surface.exchange_time = exchange_time;
  return model;
}

/// T(t) of T' = k (air + slope t - T) from `start`: air(t) - slope/k (1 - e^-kt) + (start - air) e^-kt.
double exact_exchange(double rate, double air, double slope, double start, double time) {
  const double x = rate * time;
  // slope (t - (1 - e^-x)/k), by its series where the two terms nearly cancel.
  const double followed = x < 1e-4 ? time * x * (0.5 - x / 6.0) : time + std::expm1(-x) / rate;
  return start - (air - start) * std::expm1(-x) + slope * followed;
}

/// Pressure (Pa) at the end of an interval, and its mean over it.
struct Interval {
  double end, mean;
};

/// A trace in so many intervals whose pressure(begin, end) says what each of them has.
template <class Pressure>
trace::BottomTrace trace_of(int intervals, Pressure&& pressure) {
  trace::BottomTrace trace;
  trace.stations = {{"S1", 0.0, 0.0, 0.0, false}, {"S2", 0.0, 0.0, 0.01, false}};
  for (int sample = 0; sample <= intervals; ++sample) {
    const double end = duration * sample / intervals;
    const Interval interval = pressure(duration * std::max(0, sample - 1) / intervals, end);
    trace.time.push_back(end);
    trace.steps.push_back(sample);
    for (auto* values : {&trace.bottom_pressure, &trace.chamber_pressure}) values->push_back(interval.end);
    for (auto* values : {&trace.mean_bottom_pressure, &trace.mean_chamber_pressure})
      values->push_back(interval.mean);
    for (auto& closure : trace.friction) closure.insert(closure.end(), trace.stations.size(), 0.0);
  }
  return trace;
}

}  // namespace

void judge_exchange(Judge& judge, const SkinLaw& law, double exchange_time, double step) {
  struct Air {
    double begin, slope;  // K, K/s
  };
  const surface::SkinModel model = inert_model(exchange_time);
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
      judge.at_most("distance from the exact exponential, K",
                    std::abs(point.temperature - exact_exchange(rate, air.begin, air.slope, start, to)),
                    allowed);
      const bool heats = air.begin >= start;
      const double beyond = heats ? point.temperature - air_end : air_end - point.temperature;
      judge.never("the skin overshoots the air", beyond > 4.0 * round_off * air_end);
      judge.never("the skin turns back", heats ? point.temperature < before : point.temperature > before);
      judge.never("an inert skin ignites", point.ignited);
    }
  }
}

void judge_printed_exchange(Judge& judge, const SkinLaw& law, double wide, double step) {
  surface::SkinModel model = inert_model(1.0);
  model.surface.exchange = scene::Exchange::per_step;
  const double ratio = surface::heat_capacity_ratio(model, wide), start = 300.0, air = 1500.0;
  surface::SkinPoint point{start};
  for (int call = 1; call <= 1000; ++call) {
    point = law(model, wide, point, step, air, air, 0.0);
    if (ratio >= 1.0) {
      judge.never("air that holds more heat than the skin gives it a temperature",
                  std::isfinite(point.temperature));
      judge.caught("NaN: the printed form means nothing where one step gives all and more");
      return;
    }
    const double exact = air - (air - start) * std::pow(1.0 - ratio, call);
    judge.at_most("distance from (1 - kappa h)^n, K", std::abs(point.temperature - exact), 1e-9);
    judge.never("the skin overshoots the air", point.temperature > air * (1.0 + 4.0 * round_off));
  }
}

void judge_balance(Judge& judge, const HistoryLaw& law, double exchange_time) {
  surface::SkinModel model = inert_model(exchange_time);
  model.surface.air_model = scene::AirModel::balance;
  const double pressure = 140e6, start = model.initial_temperature;
  const double ratio = surface::heat_capacity_ratio(model, gap);
  const double air = materials::adiabatic_temperature(model.surface.air, pressure);
  const double mixture = (start + ratio * air) / (1.0 + ratio);
  // kappa h/tau_ex for the skin and 1/tau_ex for the air.
  const double rate = (1.0 + ratio) / exchange_time;
  for (const int intervals : {1, 18, 900}) {
    const trace::BottomTrace trace = trace_of(intervals, [&](double, double) {
      return Interval{pressure, pressure};
    });
    const surface::SkinHistory history = law(model, trace, gap);
    const std::size_t stations = trace.stations.size();
    const bool complete = history.temperature.size() == stations * trace.samples() &&
                          history.air_temperature.size() == trace.samples();
    judge.never("samples are missing", !complete);
    if (!complete) return;
    for (std::size_t sample = 0; sample < trace.samples(); ++sample) {
      const double exact = start - (mixture - start) * std::expm1(-rate * trace.time[sample]);
      for (std::size_t station = 0; station < stations; ++station) {
        const double skin = history.temperature[sample * stations + station];
        judge.at_most("distance from the exact exponential, K", std::abs(skin - exact), 1e-6);
        judge.never("the skin overshoots the air", skin > history.air_temperature[sample] + 1e-9);
      }
      const double skin = history.temperature[sample * stations + 1];
      // Heat the air gave against heat the skin took, over all that it could give.
      const double imbalance = ratio * (air - history.air_temperature[sample]) - (skin - start);
      judge.at_most("energy created or lost, share of the heat of the air",
                    std::abs(imbalance) / (ratio * air), 1e-12);
    }
    judge.at_most("energy residual that the history itself states", history.energy_residual, 1e-9);
  }
}

void judge_balance_under_load(Judge& judge, const HistoryLaw& law, double exchange_time) {
  constexpr double rise = 1.8e-3, low = 101325.0, high = 140e6;
  // A straight rise in a tenth of the launch, then constant: its integral is exact.
  const auto integral = [&](double t) {
    const double rising = std::min(t, rise);
    return low * t + (high - low) * (0.5 * rising * rising / rise + (t - rising));
  };
  const auto pressure = [&](double begin, double end) {
    const double at_end = low + (high - low) * std::min(end, rise) / rise;
    return Interval{at_end, end > begin ? (integral(end) - integral(begin)) / (end - begin) : at_end};
  };
  surface::SkinModel model = inert_model(exchange_time);
  model.surface.air_model = scene::AirModel::balance;
  std::array<double, 2> last{};
  for (const std::size_t finer : {0U, 1U}) {
    const trace::BottomTrace trace = trace_of(finer == 0 ? 900 : 9000, pressure);
    const surface::SkinHistory history = law(model, trace, gap);
    const bool complete = history.temperature.size() == trace.stations.size() * trace.samples() &&
                          history.air_temperature.size() == trace.samples();
    judge.never("samples are missing", !complete);
    if (!complete) return;
    for (std::size_t sample = 0; sample < trace.samples(); ++sample) {
      const double skin = history.temperature[sample * trace.stations.size()];
      judge.at_most("skin hotter than the air that heats it, K",
                    std::max(0.0, skin - history.air_temperature[sample]), 1e-6);
    }
    judge.at_most("energy residual that the history itself states", history.energy_residual, 1e-9);
    last[finer] = history.temperature.back();
  }
  judge.at_most("skin on the samples of a run against ten times as many, K", std::abs(last[0] - last[1]),
                1e-2);
}

void judge_air(Judge& judge, const AirLaw& law, double ratio) {
  const materials::AirParameters air;
  const double found = law(air, ratio * air.initial_pressure);
  if (std::isnan(ratio)) {
    judge.never("no pressure gives a temperature", !std::isnan(found));
    judge.caught("NaN gives NaN");
    return;
  }
  if (ratio <= 1.0) {
    judge.at_most("distance from the initial temperature, K", std::abs(found - air.initial_temperature), 0.0);
    return;
  }
  const long double exponent = (static_cast<long double>(air.heat_ratio) - 1.0L) / air.heat_ratio;
  const long double exact =
      air.initial_temperature * std::exp(exponent * std::log(static_cast<long double>(ratio)));
  judge.at_most("relative distance from T0 ratio^(2/7)", static_cast<double>(std::abs(found / exact - 1.0L)),
                1e-14);
}

Cases exchange_cases() {
  Cases cases;
  const std::string group = "stiff: exchange";
  for (int decade = -9; decade <= 0; ++decade) {
    const double exchange_time = std::pow(10.0, decade);
    const std::string name = "tau_ex " + duration_text(exchange_time);
    cases.push_back({group, name + ", reservoir, steps 1 ns to 1 ms",
                     "The skin follows the exact exponential under constant, rising and colder air at every "
                     "outer step and never passes the air.",
                     [exchange_time] {
                       Judge judge;
                       for (const double step : {1e-9, 1e-7, 1e-5, 1e-4, 1e-3})
                         judge_exchange(judge, surface::advance_skin, exchange_time, step);
                       return judge.finding();
                     }});
    cases.push_back({group, name + ", balance, 1 to 900 intervals",
                     "Air and skin go to the temperature of their mixture as the exact exponential says; no "
                     "energy is made or lost.",
                     [exchange_time] {
                       Judge judge;
                       judge_balance(judge, surface::integrate_skin, exchange_time);
                       return judge.finding();
                     }});
  }
  for (const double exchange_time : {1e-9, 1e-7, 1e-5, 3e-4, 1.0}) {
    cases.push_back({group, "tau_ex " + duration_text(exchange_time) + ", balance, load that rises in 1.8 ms",
                     "The skin never passes the air; no energy is made or lost; a trace of 20 us is as good "
                     "as one of 2 us, to "
                     "0.01 K.",
                     [exchange_time] {
                       Judge judge;
                       judge_balance_under_load(judge, surface::integrate_skin, exchange_time);
                       return judge.finding();
                     }});
  }
  for (const double wide : {1e-9, gap, 5e-3, 0.2, 1.0}) {
    cases.push_back({group, fmt::format("printed form, gap {:g} m, steps 1 ns to 1 ms", wide),
                     "n calls leave (1 - kappa h)^n of the distance to the air, whatever the step; where one "
                     "step would give more than all, the law refuses.",
                     [wide] {
                       Judge judge;
                       for (const double step : {1e-9, 1e-6, 1e-3})
                         judge_printed_exchange(judge, surface::advance_skin, wide, step);
                       return judge.finding();
                     }});
  }
  const std::string air = "stiff: air";
  cases.push_back({air, "compression ratios 1 to 1e5", "The temperature is that of the adiabat.", [] {
                     Judge judge;
                     for (int k = 1; k <= 500; ++k)
                       judge_air(judge, materials::adiabatic_temperature, std::pow(10.0, 0.01 * k));
                     return judge.finding();
                   }});
  cases.push_back(
      {air, "ratios below 1, at 0 and below 0",
       "The air stays at its initial temperature, as the law says of a gap that does not open: above "
       "the adiabat, so on the safe side.",
       [] {
         Judge judge;
         for (const double ratio : {1.0, 1.0 - 1e-15, 0.5, 1e-5, 1e-310, 0.0, -1.0, -1e5})
           judge_air(judge, materials::adiabatic_temperature, ratio);
         return judge.finding();
       }});
  cases.push_back({air, "a pressure that is not a number", "No temperature comes out.", [] {
                     Judge judge;
                     judge_air(judge, materials::adiabatic_temperature,
                               std::numeric_limits<double>::quiet_NaN());
                     return judge.finding();
                   }});
  return cases;
}

}  // namespace launchsafe::verify::hard
