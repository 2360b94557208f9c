// Thermal explosion of the skin against the quadrature of its own equation.
#include "launchsafe/surface/skin.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace {

using namespace launchsafe;
using surface::SkinModel;

/// Where ignition is flagged: T1, or T2 where T1 is not below it or the reaction too weak to run through.
double ignition_of(const SkinModel& model) {
  const auto& k = model.kinetics;
  const double span = k.burnt_temperature - k.ignition_temperature;
  const bool at_once = span > 0.0 && k.heat_of_reaction >= model.specific_heat * span;
  return at_once ? k.ignition_temperature : k.burnt_temperature;
}

/// dT/dt (K/s) as model sections 4 and 6 write it. Between T1 and T2 the released heat Q dlambda/dt counts
/// too, which multiplies all heating by 1/(1 - Q/(c (T2 - T1))).
double rate_of(const SkinModel& model, double temperature, double heating) {
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
double exact_time(const SkinModel& model, double from, double to, double heating) {
  using Quadrature = boost::math::quadrature::gauss_kronrod<double, 31>;
  const auto slowness = [&](double temperature) { return 1.0 / rate_of(model, temperature, heating); };
  // Split where the rate jumps, and so that each part spans few e-folds.
  double total = 0.0, begin = from;
  const double jump = model.kinetics.ignition_temperature;
  while (begin < to) {
    double end = std::min(to, begin + 5.0 * begin * begin / model.kinetics.activation_temperature);
    if (begin < jump && jump < end) end = jump;
    // Five e-folds of a smooth rate are one rule's work; near T2 the rate has a zero close by.
    total += Quadrature::integrate(slowness, begin, end, begin < jump ? 0 : 12, 1e-10);
    begin = end;
  }
  return total;
}

/// Kinetics in a test's name, and friction heating (K/s).
struct Explosive {
  std::string name;
  double activation, frequency;
  bool trigger = true;  ///< at 521.52 and 784 K; else both at 4000 K
  bool weak = false;    ///< a reaction that gives half the heat from T1 to T2
  double heating = 0.0;

  SkinModel model() const {
    SkinModel model;
    auto& k = model.kinetics;
    k.activation_temperature = activation;
    k.frequency = frequency;
    k.ignition_temperature = trigger ? 521.52 : 4000.0;
    k.burnt_temperature = trigger ? 784.0 : 4000.0;
    if (weak) k.heat_of_reaction = 0.5 * model.specific_heat * (784.0 - 521.52);
    return model;
  }
};

class ThermalExplosion : public testing::TestWithParam<Explosive> {
 protected:
  static constexpr double share = 1e-6;  ///< of the elapsed time by which an arrival may be early or late
  static constexpr long most_calls = 10000;
  static constexpr double launch = 18e-3;  // s

  /// Calls the skin every `step` seconds from a temperature on, up to its ignition or the end of a launch.
  static void expect_arrivals_in_time(const SkinModel& model, double temperature, double heating,
                                      double step) {
    const double ignition = ignition_of(model);
    const double due = temperature < ignition ? exact_time(model, temperature, ignition, heating) : 0.0;
    const double wanted = std::ceil(std::min(1.1 * due, launch) / step) + 1.0;
    const long calls = static_cast<long>(std::min(wanted, static_cast<double>(most_calls)));
    const long every = std::max(1L, calls / 32);
    surface::SkinPoint point{temperature};
    double sampled = temperature, sampled_time = 0.0;  // the quadrature goes on from here
    for (long call = 1; call <= calls; ++call) {
      const double before = point.temperature, time = static_cast<double>(call) * step;
      point = surface::advance_skin(model, 0.0, point, step, 300.0, 300.0, heating);
      ASSERT_TRUE(std::isfinite(point.temperature));
      ASSERT_GE(point.temperature, before);
      if (point.ignited) {
        EXPECT_NEAR(time - step + point.ignition_time, due, due > 0.0 ? share * due : 1e-15);
        EXPECT_GE(point.temperature, ignition);
        return;
      }
      ASSERT_LE(time, due * (1.0 + share)) << "past its ignition";
      if (call % every != 0) continue;
      sampled_time += exact_time(model, sampled, point.temperature, heating);
      sampled = point.temperature;
      // Every call rounds the temperature, by half a digit at most: in a launch of 1 ns calls 0.6 uK.
      const double rounded = static_cast<double>(call) * 1.2e-16 * sampled / rate_of(model, sampled, heating);
      EXPECT_NEAR(sampled_time, time, share * time + rounded);
    }
    EXPECT_GE(due, static_cast<double>(calls) * step) << "it did not ignite in the time it takes";
  }
};

TEST_P(ThermalExplosion, ArrivesWhenTheQuadratureSaysAtAnyCallLength) {
  for (const double temperature : {300.0, 400.0, 500.0, 600.0, 700.0, 800.0, 1000.0, 1500.0, 2000.0})
    for (const double step : {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3}) {
      SCOPED_TRACE(testing::Message() << "from " << temperature << " K, calls every " << step << " s");
      expect_arrivals_in_time(GetParam().model(), temperature, GetParam().heating, step);
    }
}

INSTANTIATE_TEST_SUITE_P(Kinetics, ThermalExplosion,
                         testing::Values(Explosive{"CompB", 2.17e4, 2.01e18},
                                         Explosive{"Printed", 2.7e4, 2.01e18},
                                         Explosive{"Fast", 2.17e4, 2.01e21},
                                         Explosive{"CompBUntriggered", 2.17e4, 2.01e18, false},
                                         Explosive{"PrintedUntriggered", 2.7e4, 2.01e18, false},
                                         Explosive{"FastUntriggered", 2.17e4, 2.01e21, false},
                                         Explosive{"WeakUnderFriction", 2.17e4, 2.01e18, true, true, 1e5}),
                         [](const auto& test) { return test.param.name; });

}  // namespace
