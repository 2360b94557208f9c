#include "launchsafe/surface/skin_equation.hpp"

#include "launchsafe/math/phi.hpp"

namespace launchsafe::surface::detail {
namespace {

using math::infinity, math::not_a_number;

enum class Phase { solid, reacting, burnt };

/// The reaction term and its slope.
template <class Real>
struct Reaction {
  Real rate = 0.0;   ///< K/s
  Real slope = 0.0;  ///< 1/s
};

template <class Real>
struct Step {
  Real temperature;  ///< K, fourth order
  Real error;        ///< K, its difference from the embedded third order
};

/// One step of the exponential Rosenbrock method exprb43 (Hochbruck, Ostermann & Schweitzer, SIAM J. Numer.
/// Anal. 47, 2009) from T at time t over h. The linear part, here the exchange with an air temperature that
/// goes linearly, is exact at any stiffness; the stages see only what is left of the reaction after its
/// tangent is taken off. All heating but that of the reaction counts `scale` times.
template <class Real, class ReactionAt>
Step<Real> exprb43(const SkinEquation& equation, Real heating, double scale, const ReactionAt& reaction_at,
                   double t, Real temperature, double h) {
  const Reaction<Real> here = reaction_at(temperature);
  const double rate = scale * equation.exchange_rate;
  const Real jacobian = here.slope - rate;
  const double drift = rate * equation.air_slope;
  const Real slope =
      rate * (equation.air + equation.air_slope * t - temperature) + scale * heating + here.rate;
  // What the reaction at another temperature has beyond its tangent here.
  const auto remainder = [&](Real other) {
    return reaction_at(other).rate - here.rate - here.slope * (other - temperature);
  };
  const auto half = math::phi_functions(0.5 * h * jacobian);
  const auto full = math::phi_functions(h * jacobian);
  const Real linear = temperature + h * (full[1] * slope + h * full[2] * drift);
  const Real middle = temperature + 0.5 * h * (half[1] * slope + 0.5 * h * half[2] * drift);
  const Real rest2 = remainder(middle);
  const Real rest3 = remainder(linear + h * full[1] * rest2);
  const Real third = 16.0 * full[3] * rest2 - 2.0 * full[3] * rest3;
  const Real correction = full[4] * (12.0 * rest3 - 48.0 * rest2);
  return {linear + h * (third + correction), h * math::abs(correction)};
}

/// K/s, of what burns at the rate 1.
double prefactor_of(const SkinModel& model) {
  return model.kinetics.heat_of_reaction * model.kinetics.frequency / model.specific_heat;
}

/// One equation in one phase, with the method that follows it.
class PhaseEquation {
 public:
  PhaseEquation(const SkinModel& model, const SkinEquation& equation, const Trigger& trigger, Phase phase)
      : kinetics_(model.kinetics),
        prefactor_(phase == Phase::burnt ? 0.0 : prefactor_of(model)),
        equation_(equation),
        scale_(phase == Phase::reacting ? trigger.amplification : 1.0),
        phase_(phase) {}

  Step<double> step(double t, double temperature, double h) const {
    return exprb43(
        equation_, equation_.heating, scale_, [this](double at) { return reaction(at); }, t, temperature, h);
  }

 private:
  Reaction<double> reaction(double temperature) const {
    if (!(prefactor_ > 0.0) || !(temperature > 0.0))
      return {temperature - temperature, 0.0};  // 0, or NaN for NaN
    const double inverse = 1.0 / temperature;
    const double rate = scale_ * prefactor_ * std::exp(-kinetics_.activation_temperature * inverse);
    if (!(rate > 0.0)) return {rate, 0.0};  // near 0 K, where 1/T^2 is infinite and the rate is not
    const double slope = rate * kinetics_.activation_temperature * inverse * inverse;
    if (phase_ == Phase::solid) return {rate, slope};
    const double span = kinetics_.burnt_temperature - kinetics_.ignition_temperature;
    const double left = std::clamp((kinetics_.burnt_temperature - temperature) / span, 0.0, 1.0);
    return {left * rate, left * slope - rate / span};
  }

  const materials::KineticsParameters& kinetics_;
  double prefactor_;
  const SkinEquation& equation_;
  double scale_;
  Phase phase_;
};

/// Where an integration stopped.
struct Arrival {
  double time = 0;         ///< s
  double temperature = 0;  ///< K
  bool at_target = false;
};

/// The part of a step at which the temperature reaches the target: bisection on its length, down to
/// round-off.
double crossing(const PhaseEquation& equation, double t, double temperature, double h, double target) {
  double below = 0.0, above = h;
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double middle = 0.5 * (below + above);
    (equation.step(t, temperature, middle).temperature < target ? below : above) = middle;
  }
  return above;
}

/// Follows one phase from `start` until the temperature reaches the target, falls below the floor, or time is
/// up.
Arrival follow(const PhaseEquation& equation, Arrival start, double end, double floor, double target,
               double tolerance) {
  constexpr int most_attempts = 100000;
  Arrival at = start;
  double h = end - at.time;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    const bool last = h >= end - at.time;
    if (last) h = end - at.time;
    const auto step = equation.step(at.time, at.temperature, h);
    // Without an error any tolerance is kept, also that of a temperature next to 0 K.
    const double share = step.error <= 0.0 ? 0.0 : step.error / (tolerance * at.temperature);
    // An infinite or undefined result counts as a rejection.
    const bool accepted = share <= 1.0 && std::isfinite(step.temperature);
    const double factor = std::isfinite(share) ? 0.9 * std::pow(std::max(share, 1e-8), -0.25) : 0.1;
    if (accepted && step.temperature >= target) {
      return {at.time + crossing(equation, at.time, at.temperature, h, target), target, true};
    }
    if (accepted) {
      at = {last ? end : at.time + h, step.temperature, false};
      if (last || at.temperature < floor) return at;
    }
    h *= std::clamp(factor, 0.1, accepted ? 5.0 : 0.9);
  }
  return {end, not_a_number, false};
}

bool is_finite(const SkinEquation& equation, const SkinPoint& point, double dt) {
  return std::isfinite(equation.exchange_rate) && std::isfinite(equation.air) &&
         std::isfinite(equation.air_slope) && std::isfinite(equation.heating) &&
         std::isfinite(point.temperature) && std::isfinite(dt);
}

/// Solids of as many points as a register holds, after one step over dt.
Step<math::Pack> step_of_solids(const SkinModel& model, const SkinEquation& equation, math::Pack heating,
                                math::Pack temperature, double dt) {
  using math::Pack;
  const double prefactor = prefactor_of(model), activation = model.kinetics.activation_temperature;
  if (!(prefactor > 0.0)) {
    const auto inert = [](Pack) { return Reaction<Pack>{}; };
    return exprb43(equation, heating, 1.0, inert, 0.0, temperature, dt);
  }
  const auto arrhenius = [&](Pack at) {
    const Pack inverse = 1.0 / at;
    const Pack rate = prefactor * math::exp(-activation * inverse);
    return Reaction<Pack>{rate, rate * activation * inverse * inverse};
  };
  return exprb43(equation, heating, 1.0, arrhenius, 0.0, temperature, dt);
}

const std::vector<double>* friction_of(const SkinModel& model, const trace::BottomTrace& trace) {
  return model.surface.friction == scene::FrictionClosure::none ? nullptr : &trace.friction;
}

/// Share of Arrhenius heat in all that heats a solid at temperature T, 0 to 1. `outside` in K/s.
double chemical_share(const SkinModel& model, double temperature, double outside) {
  const double chemical = materials::arrhenius_heating(model.kinetics, model.specific_heat, temperature);
  const double total = chemical + std::max(outside, 0.0);
  return total > 0.0 ? chemical / total : 0.0;
}

}  // namespace

Trigger trigger_of(const SkinModel& model) {
  const materials::KineticsParameters& k = model.kinetics;
  if (!(k.ignition_temperature < k.burnt_temperature)) return {k.burnt_temperature, 1.0, true};
  const double gain =
      k.heat_of_reaction / (model.specific_heat * (k.burnt_temperature - k.ignition_temperature));
  if (gain >= 1.0) return {k.ignition_temperature, 1.0, true};
  return {k.ignition_temperature, 1.0 / (1.0 - gain), false};
}

SkinPoint advance(const SkinModel& model, const SkinEquation& equation, SkinPoint point, double dt) {
  if (!is_finite(equation, point, dt)) {
    point.temperature = not_a_number;
    return point;
  }
  const Trigger trigger = trigger_of(model);
  Arrival at{0.0, point.temperature, false};
  // At the trigger heating and cooling have the same sign in both phases, so that a few changes are many.
  constexpr int most_changes = 1000;
  for (int change = 0; !point.ignited && at.time < dt; ++change) {
    if (change == most_changes) {
      point.temperature = not_a_number;
      return point;
    }
    const Phase phase =
        at.temperature >= trigger.temperature && !trigger.immediate ? Phase::reacting : Phase::solid;
    const double target = phase == Phase::solid ? trigger.temperature : model.kinetics.burnt_temperature;
    const double floor = phase == Phase::solid ? -infinity : trigger.temperature;
    at.at_target = at.temperature >= target;
    if (!at.at_target) {
      const PhaseEquation solid(model, equation, trigger, phase);
      at = follow(solid, at, dt, floor, target, model.relative_tolerance);
    }
    if (at.at_target && (phase == Phase::reacting || trigger.immediate)) {
      const double outside =
          equation.exchange_rate * (equation.air + equation.air_slope * at.time - at.temperature) +
          equation.heating;
      point.ignited = true;
      point.ignition_time = at.time;
      point.chemical_share = chemical_share(model, at.temperature, outside);
      at.temperature = std::max(at.temperature, model.kinetics.burnt_temperature);
    }
  }
  if (point.ignited && at.time < dt) {
    SkinEquation exchange = equation;
    exchange.heating = 0.0;
    const PhaseEquation burnt(model, exchange, trigger, Phase::burnt);
    at.temperature = burnt.step(at.time, at.temperature, dt - at.time).temperature;
  }
  point.temperature = at.temperature;
  return point;
}

void advance(const SkinModel& model, const SkinEquation& equation, std::span<const double> heating,
             std::vector<SkinPoint>& points, double dt) {
  constexpr double coldest = 10.0;  // K, below which 1/T^2 may be too large
  const double trigger = trigger_of(model).temperature;
  for (std::size_t first = 0; first < points.size(); first += math::pack_width) {
    const std::size_t count = std::min(math::pack_width, points.size() - first);
    // Lanes without a point repeat the first one, which costs nothing; a temperature of 0 would be NaN, and
    // slow.
    math::Pack temperature = points[first].temperature, heat = heating[first];
    for (std::size_t lane = 0; lane < count; ++lane) {
      temperature.set(lane, points[first + lane].temperature);
      heat.set(lane, heating[first + lane]);
    }
    const Step<math::Pack> step = step_of_solids(model, equation, heat, temperature, dt);
    for (std::size_t lane = 0; lane < count; ++lane) {
      SkinPoint& point = points[first + lane];
      const double before = point.temperature, after = step.temperature[lane];
      const bool one_step_is_enough = !point.ignited && before > coldest && before < trigger &&
                                      after > coldest && after < trigger &&
                                      step.error[lane] <= model.relative_tolerance * before;
      if (one_step_is_enough) {
        point.temperature = after;
        continue;
      }
      SkinEquation own = equation;
      own.heating = heating[first + lane];
      point = advance(model, own, point, dt);
    }
  }
}

LinearAir linear_air(const materials::AirParameters& air, const IntervalPressure& pressure) {
  const double begin = materials::adiabatic_temperature(air, pressure.begin);
  const double end = materials::adiabatic_temperature(air, pressure.end);
  const double at_mean = materials::adiabatic_temperature(air, pressure.mean);
  // Mean of T(p) over a nearly linear p: T(mean) + T''(mean) (p1 - p0)^2/24, with T'' = a (a - 1) T/p^2.
  const double a = (air.heat_ratio - 1.0) / air.heat_ratio;
  // Below the initial pressure the temperature is constant, and a mean of 0 has no relative spread.
  const double spread =
      pressure.mean > air.initial_pressure ? (pressure.end - pressure.begin) / pressure.mean : 0.0;
  const double curved = at_mean * (1.0 + a * (a - 1.0) * spread * spread / 24.0);
  const double mean = curved < air.initial_temperature ? air.initial_temperature : curved;
  // Not steeper than keeps both ends at or above the initial temperature.
  const double steepest = mean - air.initial_temperature;
  const double half = std::clamp(0.5 * (end - begin), -steepest, steepest);
  return {mean - half, mean + half};
}

Intervals::Intervals(SkinModel model, const trace::BottomTrace& trace, double gap)
    : model_(std::move(model)),
      trace_(trace),
      pressure_(trace.bottom_pressure),
      mean_(trace.mean_bottom_pressure),
      friction_(friction_of(model_, trace)),
      exchange_rate_(heat_capacity_ratio(model_, gap) / model_.surface.exchange_time) {}

IntervalPressure Intervals::pressure(std::size_t interval) const {
  return {pressure_[interval], pressure_[interval + 1], mean_[interval + 1]};
}

double Intervals::friction_heating(std::size_t interval, std::size_t station) const {
  if (friction_ == nullptr) return 0.0;
  const std::size_t stations = trace_.stations.size();
  if (friction_->size() != stations * trace_.samples()) return not_a_number;
  const double energy =
      (*friction_)[(interval + 1) * stations + station] - (*friction_)[interval * stations + station];
  return energy * model_.surface.localisation /
         (model_.charge_density * model_.specific_heat * length(interval));
}

}  // namespace launchsafe::surface::detail
