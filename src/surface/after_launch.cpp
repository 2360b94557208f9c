#include "launchsafe/surface/after_launch.hpp"

#include "launchsafe/surface/skin_equation.hpp"

#include <Eigen/LU>

namespace launchsafe::surface {
namespace {
using Profile = Eigen::VectorXd;  // by node, from the surface down

/// 1/s, times temperatures of nodes their rates. The skin ends half-way between two. Lengths are in skins; no
/// heat comes ten deep before it is known how the skin ends.
Eigen::MatrixXd conduction_of(const SkinModel& model, int skin_nodes) {
  Eigen::MatrixXd conductance = Eigen::MatrixXd::Zero(1, 1);
  Profile volume = Profile::Zero(1);
  double spacing = 1.0 / (skin_nodes - 0.5);
  for (double depth = 0.0; depth < 10.0; depth += spacing) {
    const Eigen::Index nodes = volume.size() + 1;
    if (nodes > skin_nodes + 1) spacing *= 1.0 + 1.5 / skin_nodes;
    volume.conservativeResizeLike(Profile::Zero(nodes));
    volume.tail<2>().array() += 0.5 * spacing;
    conductance.conservativeResizeLike(Eigen::MatrixXd::Zero(nodes, nodes));
    conductance.bottomRightCorner<2, 2>() += Eigen::Matrix2d{{-1.0, 1.0}, {1.0, -1.0}} / spacing;
  }
  const double h = model.surface.skin_thickness, heat_capacity = model.charge_density * model.specific_heat;
  return model.conductivity / (heat_capacity * h * h) * volume.cwiseInverse().asDiagonal() * conductance;
}

/// Temperatures after dt (s), and their error (K). By RODAS3 (Sandu et al., Atmos. Environ. 31, 3459, 1997):
/// of third order, its error that of the second, and L-stable, so that the jump below the skin does not ring.
std::pair<Profile, double> step(const SkinModel& model, const Eigen::MatrixXd& conduction,
                                const Profile& start, double dt) {
  const materials::KineticsParameters& k = model.kinetics;
  const auto reaction = [&](double t) { return materials::arrhenius_heating(k, model.specific_heat, t); };
  const auto slope = [&](double t) { return reaction(t) * k.activation_temperature / (t * t); };
  const auto rates = [&](const Profile& t) -> Profile { return conduction * t + t.unaryExpr(reaction); };
  Eigen::MatrixXd matrix = -conduction;
  matrix.diagonal().array() += 2.0 / dt - start.unaryExpr(slope).array();
  const Eigen::PartialPivLU<Eigen::MatrixXd> inverse(matrix);
  const auto solve = [&](const Profile& right) -> Profile { return inverse.solve(right); };
  const Profile rate = rates(start), first = solve(rate), second = solve(rate + 4.0 / dt * first);
  const Profile middle = start + 2.0 * first, third = solve(rates(middle) + (first - second) / dt);
  const Profile late = middle + third;
  const Profile last = solve(rates(late) + (first - second - 8.0 / 3.0 * third) / dt);
  return {late + last, last.norm()};
}

/// Share of a step until the surface ignites; the rate is one that e-folds over a temperature.
double share_until(double ignition, const SkinModel& model, double from, double to) {
  const double fold = ignition * ignition / model.kinetics.activation_temperature;
  return to < ignition ? 1.0 : std::expm1((from - ignition) / fold) / std::expm1((from - to) / fold);
}
}  // namespace

AfterLaunch follow_after_launch(const SkinModel& model, double skin, double charge, double until,
                                SkinResolution resolution) {
  const double ignition = detail::trigger_of(model).temperature, cooled = 0.5 * (skin + charge);
  if (skin >= ignition) return {0.0, skin, 0.0};
  const Eigen::MatrixXd conduction = conduction_of(model, resolution.nodes);
  Profile at = Profile::Constant(conduction.rows(), charge);
  at.head(resolution.nodes).setConstant(skin);
  double time = 0.0, dt = 1e-6;
  while (time < until && !(at[0] < std::min(skin, cooled))) {
    dt = std::min(dt, until - time);
    const auto [next, error] = step(model, conduction, at, dt);
    if (error <= resolution.tolerance) {
      time += dt * share_until(ignition, model, at[0], next[0]);
      if (next[0] >= ignition) return {time, ignition, time};
      at = next;
    }
    // In this order an error that is not a number shortens the step, up to where none is short enough.
    dt *= std::max(0.1, std::min(0.9 * std::cbrt(resolution.tolerance / error), 5.0));
    if (!(time + dt > time)) return {math::not_a_number, math::not_a_number, math::not_a_number};
  }
  return {time, at[0], std::nullopt};
}

std::optional<double> ignition_after_launch(const SkinModel& model, const SkinHistory& history,
                                            const trace::BottomTrace& trace, double charge) {
  if (history.ignition || history.time.empty()) return std::nullopt;
  const double hottest = maximum_at_time(history, trace, history.time.back()).temperature;
  return follow_after_launch(model, hottest, charge).ignition_time;
}

double runaway_temperature(const SkinModel& model, double charge, SkinResolution resolution) {
  double hot = detail::trigger_of(model).temperature, cool = std::min(charge, hot);
  do {
    const double middle = 0.5 * (cool + hot);
    const auto time = follow_after_launch(model, middle, charge, 3600.0, resolution).ignition_time;
    if (time && std::isnan(*time)) return *time;
    (time ? hot : cool) = middle;
  } while (hot - cool > 0.01);
  return hot;
}
}  // namespace launchsafe::surface
