// Thermal explosion of the skin against the quadrature of its own equation.
#include "law_tests.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::verify::law_tests {

namespace {

/// Share of the elapsed time by which an arrival may be early or late.
constexpr double time_tolerance = 1e-6;
/// Calls at most: with more the outer step is so fine that fewer calls of a launch show the same.
constexpr long most_explosion_calls = 10000;
constexpr double launch = 18e-3;  // s

/// Where ignition is flagged: T1, or T2 where T1 is not below it or the reaction too weak to run through.
double ignition_of(const surface::SkinModel& model) {
  const auto& k = model.kinetics;
  const double span = k.burnt_temperature - k.ignition_temperature;
  const bool at_once = span > 0.0 && k.heat_of_reaction >= model.specific_heat * span;
  return at_once ? k.ignition_temperature : k.burnt_temperature;
}

/// dT/dt (K/s) as model sections 4 and 6 write it. Between T1 and T2 the released heat Q dlambda/dt counts
/// too, which multiplies all heating by 1/(1 - Q/(c (T2 - T1))).
double rate_of(const surface::SkinModel& model, double temperature, double heating) {
  const auto& k = model.kinetics;
  const double arrhenius = k.heat_of_reaction * k.frequency / model.specific_heat *
                           std::exp(-k.activation_temperature / temperature);
  const double span = k.burnt_temperature - k.ignition_temperature;
  if (!(span > 0.0) || temperature < k.ignition_temperature) return arrhenius + heating;
  const double gain = k.heat_of_reaction / (model.specific_heat * span);
  const double left = std::max(0.0, (k.burnt_temperature - temperature) / span);
  return (left * arrhenius + heating) / (1.0 - gain);
}

/// Time (s) from one temperature to a higher one.
double exact_time(const surface::SkinModel& model, double from, double to, double heating) {
  using Quadrature = boost::math::quadrature::gauss_kronrod<double, 31>;
  const auto slowness = [&](double temperature) { return 1.0 / rate_of(model, temperature, heating); };
  // Split where the rate jumps, and so that each part spans few e-folds.
  double total = 0.0, begin = from;
  const double jump = model.kinetics.ignition_temperature;
  while (begin < to) {
    const double fold = 5.0 * begin * begin / model.kinetics.activation_temperature;
    double end = std::min(to, begin + fold);
    if (begin < jump && jump < end) end = jump;
    // Five e-folds of a smooth rate are one rule's work; near T2 the rate has a zero close by.
    total += Quadrature::integrate(slowness, begin, end, begin < jump ? 0 : 12, 1e-10);
    begin = end;
  }
  return total;
}

surface::SkinModel with_kinetics(double activation, double frequency) {
  surface::SkinModel model;
  model.kinetics.activation_temperature = activation;
  model.kinetics.frequency = frequency;
  model.kinetics.ignition_temperature = 521.52;
  model.kinetics.burnt_temperature = 784.0;
  return model;
}

/// Named kinetics with what else the case needs.
struct Setting {
  std::string name;
  surface::SkinModel model;
  double heating;  // K/s
};

std::vector<Setting> settings() {
  constexpr double frequency = 2.01e18;
  const std::vector<Setting> with_trigger{
      {"comp-b", with_kinetics(2.17e4, frequency), 0.0},
      {"printed", with_kinetics(2.7e4, frequency), 0.0},
      {"custom (comp-b, 1000 times as fast)", with_kinetics(2.17e4, 1e3 * frequency), 0.0}};
  std::vector<Setting> all = with_trigger;
  for (Setting setting : with_trigger) {
    setting.name += ", no trigger below 4000 K";
    setting.model.kinetics.ignition_temperature = setting.model.kinetics.burnt_temperature = 4000.0;
    all.push_back(setting);
  }
  Setting weak{"custom (comp-b, gain 1/2 between T1 and T2, friction 1e5 K/s)",
               with_kinetics(2.17e4, frequency), 1e5};
  weak.model.kinetics.heat_of_reaction = 0.5 * weak.model.specific_heat * (784.0 - 521.52);
  all.push_back(weak);
  return all;
}

}  // namespace

void assess_explosion(Bounds& bounds, const SkinLaw& law, const surface::SkinModel& model, double temperature,
                      double heating, double step) {
  const double ignition = ignition_of(model);
  const double due = temperature < ignition ? exact_time(model, temperature, ignition, heating) : 0.0;
  const double wanted = std::ceil(std::min(1.1 * due, launch) / step) + 1.0;
  const long calls = static_cast<long>(std::min(wanted, static_cast<double>(most_explosion_calls)));
  const long every = std::max(1L, calls / 32);
  surface::SkinPoint point{temperature};
  double sampled = temperature, sampled_time = 0.0;  // the quadrature goes on from here
  for (long call = 0; call < calls; ++call) {
    const double before = point.temperature;
    point = law(model, 0.0, point, step, 300.0, 300.0, heating);
    bounds.never("a temperature is not finite", !std::isfinite(point.temperature));
    bounds.never("the temperature fell", point.temperature < before);
    const double time = static_cast<double>(call + 1) * step;
    if (point.ignited) {
      const double seen = static_cast<double>(call) * step + point.ignition_time;
      bounds.at_most("ignition early or late, share of the time to it",
                     due > 0.0 ? std::abs(seen / due - 1.0) : seen, due > 0.0 ? time_tolerance : 1e-15);
      bounds.never("the ignited skin is colder than it ignites at", point.temperature < ignition);
      return;
    }
    bounds.never("it has not ignited and is past its ignition", time > due * (1.0 + time_tolerance));
    if (!std::isfinite(point.temperature)) return;
    if ((call + 1) % every != 0) continue;
    sampled_time += exact_time(model, sampled, point.temperature, heating);
    sampled = point.temperature;
    // Every call rounds the temperature, by half a digit at most: in a launch of 1 ns calls 0.6 uK.
    const double rounded =
        static_cast<double>(call + 1) * 1.2e-16 * sampled / rate_of(model, sampled, heating);
    bounds.at_most("temperature early or late, over 1e-6 of the time and round-off",
                   std::abs(sampled_time - time) / (time_tolerance * time + rounded), 1.0);
  }
  bounds.never("it did not ignite in the time it takes", due < static_cast<double>(calls) * step);
}

LawTests explosion_tests() {
  LawTests tests;
  for (const Setting& setting : settings()) {
    for (const double temperature : {300.0, 400.0, 500.0, 600.0, 700.0, 800.0, 1000.0, 1500.0, 2000.0}) {
      tests.push_back({"stiff: thermal explosion",
                       fmt::format("{}, from {:.0f} K, steps 1 ns to 1 ms", setting.name, temperature),
                       "Temperatures are reached, and ignition is flagged, when the quadrature of the "
                       "equation says so, to 1e-6 of the time and one rounding a call, at every outer step; "
                       "the temperature never falls and stays finite.",
                       [setting, temperature](Bounds& bounds) {
                         for (const double step : {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3}) {
                           assess_explosion(bounds, surface::advance_skin, setting.model, temperature,
                                            setting.heating, step);
                         }
                       }});
    }
  }
  return tests;
}

}  // namespace launchsafe::verify::law_tests
