// The skin equation: thermal explosion and exchange with the air.
#include "launchsafe/surface/skin.hpp"

#include "series.hpp"

#include <boost/math/special_functions/expint.hpp>
#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace launchsafe::error_of_parts {
namespace {

constexpr double initial = 700.0, exploded = 2000.0;  // K
constexpr double share_before = 0.9;                  // of the induction time

/// The printed kinetics, for which model section 10 gives induction times, with the end of the induction for
/// the trigger.
surface::SkinModel explosive(double relative_tolerance) {
  surface::SkinModel model;
  model.kinetics.activation_temperature = 2.7e4;
  model.kinetics.ignition_temperature = exploded;
  model.kinetics.burnt_temperature = exploded + 1.0;
  model.relative_tolerance = relative_tolerance;
  return model;
}

/// Time (s) that zero-order self-heating takes from one temperature (K) to another: the integral of
/// dT/((Q Z/c) exp(-theta/T)), whose primitive is (T exp(theta/T) - theta Ei(theta/T)) c/(Q Z).
double induction_between(const surface::SkinModel& model, double from, double to) {
  const materials::KineticsParameters& k = model.kinetics;
  const auto primitive = [&](double temperature) {
    const double x = k.activation_temperature / temperature;
    return temperature * (std::exp(x) - x * boost::math::expint(x));
  };
  return (primitive(to) - primitive(from)) * model.specific_heat / (k.heat_of_reaction * k.frequency);
}

/// Temperature (K) after a time (s) less than the induction time, by bisection.
double exact_temperature(const surface::SkinModel& model, double time) {
  double below = initial, above = exploded;
  for (int k = 0; k < 80; ++k) {
    const double middle = 0.5 * (below + above);
    (induction_between(model, initial, middle) < time ? below : above) = middle;
  }
  return 0.5 * (below + above);
}

double temperature_after(const surface::SkinModel& model, double time, int calls) {
  surface::SkinPoint point{initial};
  for (int call = 0; call < calls; ++call)
    point = surface::advance_skin(model, 0.0, point, time / calls, 300.0, 300.0, 0.0);
  return point.temperature;
}

std::vector<Setting> tolerances(const std::function<double(const surface::SkinModel&)>& error) {
  return settings_for({1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}, [&](double tolerance) {
    return Setting{fmt::format("tolerance {:.0e}", tolerance), tolerance,
                   [error, model = explosive(tolerance)] { return error(model); }};
  });
}

std::vector<Setting> induction_settings() {
  const double exact = induction_between(explosive(1.0), initial, exploded);
  return tolerances([exact](const surface::SkinModel& model) {
    const auto point = surface::advance_skin(model, 0.0, {initial}, 2.0 * exact, 300.0, 300.0, 0.0);
    return point.ignited ? point.ignition_time / exact - 1.0 : std::nan("");
  });
}

std::vector<Setting> temperature_settings() {
  const double time = share_before * induction_between(explosive(1.0), initial, exploded);
  const double exact = exact_temperature(explosive(1.0), time);
  return tolerances(
      [time, exact](const surface::SkinModel& model) { return temperature_after(model, time, 1) - exact; });
}

/// The tolerance is so large that each call is one step.
std::vector<Setting> step_settings() {
  const surface::SkinModel model = explosive(1e9);
  const double time = share_before * induction_between(model, initial, exploded);
  const double exact = exact_temperature(model, time);
  return settings_for({8, 16, 32, 64, 128, 256}, [&](int steps) {
    return with_steps(time, steps, [=] { return temperature_after(model, time, steps) - exact; });
  });
}

/// Skin under air whose temperature is given at the begin and the end of every call.
struct Exchange {
  double exponent;  ///< the air's rise goes with this power of the time

  static constexpr double gap = 4e-4, duration = 18e-3, rise = 2000.0;  // m, s, K

  /// Stiffer than calibrated: the skin follows the air in 2.3 ms.
  static surface::SkinModel model() {
    surface::SkinModel model;
    model.kinetics.frequency = 0.0;
    model.kinetics.ignition_temperature = model.kinetics.burnt_temperature = 1e9;
    model.surface.friction = scene::FrictionClosure::none;
    model.surface.exchange_time = 3.6e-6;
    return model;
  }
  double air(double share) const { return 300.0 + rise * std::pow(share, exponent); }

  double computed(int calls) const {
    const surface::SkinModel skin = model();
    surface::SkinPoint point{300.0};
    for (int call = 0; call < calls; ++call) {
      const double begin = static_cast<double>(call) / calls, end = static_cast<double>(call + 1) / calls;
      point = surface::advance_skin(skin, gap, point, duration / calls, air(begin), air(end), 0.0);
    }
    return point.temperature;
  }
  /// u' = k (rise s^n - u), u(0) = 0, s = t/duration, K = k duration: for n = 1 rise (1 - (1 - e^-K)/K), for
  /// n = 2 rise (1 - 2/K + 2 (1 - e^-K)/K^2).
  double exact() const {
    const surface::SkinModel skin = model();
    const double k = surface::heat_capacity_ratio(skin, gap) / skin.surface.exchange_time * duration;
    const double relaxed = -std::expm1(-k);
    return 300.0 + rise * (exponent < 1.5 ? 1.0 - relaxed / k : 1.0 - 2.0 / k + 2.0 * relaxed / (k * k));
  }
};

/// Under air whose rise goes with this power of the time.
std::vector<Setting> exchange_settings(double exponent) {
  return settings_for({4, 16, 64, 256, 1024}, [exchange = Exchange{exponent}](int calls) {
    return with_steps(Exchange::duration, calls,
                      [=, exact = exchange.exact()] { return exchange.computed(calls) - exact; });
  });
}

}  // namespace

std::vector<ErrorSeries> skin_series() {
  const std::string part = "skin equation", explosion = "closed form of the zero-order induction";
  const std::string from = fmt::format("one skin point, from {:.0f} K", initial);
  const std::string before = from + " to 0.9 of the induction time", launch = "one skin point over 18 ms";
  return {{part, "induction time", fmt::format("{} to {:.0f} K", from, exploded), explosion, "",
           "the step control holds the error per step, of the embedded third order, to the tolerance: the "
           "error of the fourth-order result goes with it",
           1.0, 2e-14, induction_settings()},
          {part, "T before explosion, by tolerance", before, explosion, "K", "as the induction time", 1.0,
           1e-11, temperature_settings()},
          {part, "T before explosion, by step", before, explosion, "K", "exprb43 is of fourth order", 4.0,
           1e-11, step_settings()},
          {"exchange with the air", "T, air rising linearly", launch, "exact solution", "K",
           "exact at any step: exponential integrator, air linear over each step", exact_order, 1e-9,
           exchange_settings(1.0)},
          {"exchange with the air", "T, air rising as time squared", launch, "exact solution", "K",
           "the air's temperature is taken as linear over each step, which is of second order", 2.0, 1e-9,
           exchange_settings(2.0)}};
}

}  // namespace launchsafe::error_of_parts
