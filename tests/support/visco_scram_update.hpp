// Steps of Visco-SCRAM from states by all elements: that of the charge, and the plain form of the same
// equations to hold it against.
#pragma once

#include "launchsafe/materials/visco_scram_step.hpp"

#include <algorithm>

namespace launchsafe::test_support {

/// A step of the charge's law, by a deviatoric strain increment under a pressure (Pa).
inline materials::ViscoScramDissipation<double> charge_update(const materials::ViscoScramStep& law,
                                                              materials::ViscoScramState<double>& state,
                                                              math::Deviator<double> de, double pressure) {
  const auto end = law.update<double>(law.state_of(state), vector_of(de), pressure);
  state = law.elements_of(end.state);
  return {end.viscous, end.crack};
}

inline materials::ViscoScramStep step_of(const materials::ViscoScramParameters& m, double dt) {
  materials::ViscoScramStep law(m);
  law.set_step(dt);
  return law;
}

// --- the plain form ---

/// What all elements together come to over a step before the cracks are known.
struct PlainResponse {
  math::Deviator<double> before;  ///< S at the begin, Pa
  math::Deviator<double> after;   ///< S at the end if cracks do not grow, Pa
};

inline PlainResponse plain_response(const materials::ViscoScramParameters& m,
                                    const materials::ViscoScramState<double>& state,
                                    math::Deviator<double> de, const materials::Relaxation<double>& step) {
  const double q = crack_strain_ratio(m, state.crack_radius);
  math::Deviator<double> relaxed{};
  double effective = 0.0;  // sum G_n mean_n
  for (std::size_t n = 0; n < materials::maxwell_elements; ++n) {
    relaxed = relaxed + step.decay[n] * state.elements[n];
    effective += m.shear_moduli[n] * step.mean[n];
  }
  const double share = effective / m.shear_modulus();
  const auto before = total_deviator(state);
  return {before, 1.0 / (1.0 + share * q) * (relaxed + (2.0 * effective) * de + (share * q) * before)};
}

/// d ln(dc/dt)/d ln c at constant stress: of crack_growth_speed, and of the toughness that grows with c.
inline double growth_sensitivity(const materials::ViscoScramParameters& m, double pressure,
                                 double crack_radius, double speed) {
  const double ratio = materials::detail::friction_ratio(m, pressure, crack_radius);
  const double gain =
      0.25 * materials::detail::pi * ratio * (1.0 + 2.0 * ratio) / materials::detail::toughening(ratio);
  const double share = std::max(speed / m.largest_growth_speed, 1e-300);
  return std::min(m.growth_exponent, 2.0 * (1.0 - share) / share) * (0.5 - gain);
}

/// Whether elements and cracks relax so much together that it matters: x_n S_n - 2 G_n a, a the strain that
/// elements take, times q/(1 + q), over S.
inline bool relaxes_unevenly(const materials::ViscoScramParameters& m,
                             const materials::ViscoScramState<double>& state, math::Deviator<double> de,
                             const PlainResponse& response, double dt) {
  const double q = crack_strain_ratio(m, state.crack_radius), share = q / (1.0 + q);
  const auto applied = de - (0.5 / m.shear_modulus() * q) * (response.after - response.before);
  double uneven = 0.0;
  for (std::size_t n = 0; n < materials::maxwell_elements; ++n) {
    const double x = dt * m.relaxation_rates[n];
    if (!(x > 0.0)) continue;
    const auto relaxing = x * state.elements[n] - (2.0 * m.shear_moduli[n]) * applied;
    uneven += contract(relaxing, relaxing);
  }
  return share * share * uneven >
         3e-4 * 3e-4 *
             (contract(response.before, response.before) + contract(response.after, response.after));
}

/// Advances the state over step.dt: one step where cracks hardly grow, by the midpoint rule for c, sub-steps
/// where they do.
inline materials::ViscoScramDissipation<double> plain_update(const materials::ViscoScramParameters& m,
                                                             const materials::Relaxation<double>& step,
                                                             materials::ViscoScramState<double>& state,
                                                             math::Deviator<double> de, double pressure) {
  using namespace materials;
  const double c0 = state.crack_radius, fastest_rate = *std::ranges::max_element(m.relaxation_rates);
  const PlainResponse response = plain_response(m, state, de, step);
  const double speed = crack_growth_speed_under(m, 0.5 * (response.before + response.after), pressure, c0);
  const double growth = step.dt * speed;
  const bool couples = detail::couples_too_strongly(step.dt * fastest_rate, crack_strain_ratio(m, c0)) &&
                       relaxes_unevenly(m, state, de, response, step.dt);
  ViscoScramDissipation<double> lost;
  if (couples || growth > detail::growth_of_whole_step * c0) {
    detail::substep(m, state, de, pressure, step.dt, fastest_rate, lost);
    return lost;
  }
  const double curved =
      1.0 + 0.5 * growth_sensitivity(m, pressure, c0, speed) * growth / std::max(c0, 1e-300);
  state.crack_radius = std::max(c0, std::min(c0 + growth * curved, std::max(m.largest_crack_radius, 0.0)));
  relax(m, state, de, crack_strain_ratio(m, c0), crack_strain_ratio(m, state.crack_radius), step, lost);
  return lost;
}

}  // namespace launchsafe::test_support
