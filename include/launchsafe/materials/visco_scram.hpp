// Visco-SCRAM: a generalised Maxwell solid in series with an isotropic ensemble of penny cracks
// (Bennett et al. 1998; paper Eq. 28-31, corrected: c/a and its rate, deviatoric strain rate, K1, 1/tau_1 =
// 0).
//
// With q = (c/a)^3 the paper's pair of equations is equivalent to
//     dS_n/dt = 2 G_n (e - de_c/dt) - S_n/tau_n,   2 G e_c = q S,   S = sum S_n,
// where e_c is the crack strain. In this form the relaxation is integrated exactly and the crack strain
// implicitly.
#pragma once

#include "launchsafe/math/deviator.hpp"

#include <array>

namespace launchsafe::materials {

inline constexpr std::size_t maxwell_elements = 5;

struct ViscoScramParameters {
  std::array<double, maxwell_elements> shear_moduli{0.944e9, 0.1738e9, 0.5212e9, 0.9085e9,
                                                    0.6875e9};  ///< G_n, Pa
  std::array<double, maxwell_elements> relaxation_rates{0.0, 7320.0, 73200.0, 732000.0,
                                                        2e6};  ///< 1/tau_n, 1/s
  double initial_crack_radius = 30e-6;                         ///< c(0), m [P]
  double flaw_size = 1e-3;                                     ///< a, m [P]; 0 leaves the cracks out
  double largest_crack_radius = 10e-3;  ///< m; growth stops there and the particle is counted [A]
  double largest_growth_speed = 300.0;  ///< v_max, m/s [P]
  double growth_exponent = 10.0;        ///< m [P]
  double toughness = 5e5;               ///< K0, Pa m^0.5 [P]
  double face_friction = 0.35;          ///< mu_s of closed crack faces [L]; 0 leaves crack friction out
  bool growth = true;                   ///< false freezes the crack radius

  double shear_modulus() const {
    double total = 0.0;
    for (const double g : shear_moduli) total += g;
    return total;
  }
};

namespace detail {

inline constexpr double pi = 3.14159265358979323846;

/// x^n for a whole n >= 0.
template <class Real>
Real whole_power(Real x, int n) {
  Real result(1.0);
  for (; n > 0; n /= 2) {
    if (n % 2 == 1) result = result * x;
    x = x * x;
  }
  return result;
}

/// x^exponent for x >= 0; by multiplication where the exponent is a small whole number, as it is for known
/// explosives.
template <class Real>
Real power(Real x, double exponent) {
  const int whole = exponent >= 1.0 && exponent <= 64.0 ? static_cast<int>(exponent) : 0;
  if (static_cast<double>(whole) < exponent || static_cast<double>(whole) > exponent)
    return math::pow(x, Real(exponent));
  return whole_power(x, whole);
}

/// A/K0 of the crack-face friction, A = mu' p sqrt(c), mu' = mu_s sqrt(45/(2 (3 - 2 mu_s^2))); 0 under
/// tension.
template <class Real>
Real friction_ratio(const ViscoScramParameters& m, Real pressure, Real crack_radius) {
  using math::max;
  using math::sqrt;
  const double friction =
      m.face_friction * std::sqrt(45.0 / (2.0 * (3.0 - 2.0 * m.face_friction * m.face_friction)));
  return Real(friction / m.toughness) * max(pressure, Real(0.0)) * sqrt(crack_radius);
}

/// (K/K0)^2 of a toughness K raised by the friction ratio A/K0.
template <class Real>
Real toughening(Real ratio) {
  return Real(1.0) + Real(pi) * ratio * (Real(1.0) + ratio);
}

}  // namespace detail

/// Toughness (Pa m^0.5) raised by friction between closed crack faces under pressure p (Pa, compression
/// positive): K0 sqrt[1 + (pi A/K0)(1 + A/K0)], A = mu' p sqrt(c), mu' = mu_s sqrt(45/(2 (3 - 2 mu_s^2))).
template <class Real>
Real frictional_toughness(const ViscoScramParameters& m, Real pressure, Real crack_radius) {
  using math::sqrt;
  return Real(m.toughness) * sqrt(detail::toughening(detail::friction_ratio(m, pressure, crack_radius)));
}

/// Crack growth speed dc/dt (m/s): v_max (K/K1)^m below K' = K0 sqrt(1 + 2/m), v_max (1 - (K0/K)^2) above,
/// with K1 = K' (1 + m/2)^(1/m); value and slope are continuous at K' (paper Eq. 30-31). K and K0 in Pa
/// m^0.5.
template <class Real>
Real crack_growth_speed(const ViscoScramParameters& m, Real intensity, Real toughness) {
  using math::max;
  using math::min;
  using math::select;
  const double exponent = m.growth_exponent;
  const double transition = std::sqrt(1.0 + 2.0 / exponent);  // K'/K0
  const Real x = intensity / toughness;
  const Real slow = Real(1.0 / (1.0 + 0.5 * exponent)) *
                    detail::power(min(x, Real(transition)) * Real(1.0 / transition), exponent);
  const Real fast = Real(1.0) - Real(1.0) / max(x * x, Real(transition * transition));
  return Real(m.largest_growth_speed) * select(x < Real(transition), slow, fast);
}

/// What a step length fixes for all elements, as scalars (one step length for all particles) or lanes.
template <class Factor>
struct Relaxation {
  Factor dt;
  std::array<Factor, maxwell_elements> decay;          ///< exp(-dt/tau_n)
  std::array<Factor, maxwell_elements> mean;           ///< (tau_n/dt) (1 - decay); 1 for tau = infinity
  std::array<Factor, maxwell_elements> mean_response;  ///< (tau_n/dt) (1 - mean); 1/2 for tau = infinity
};

/// The factors for a step dt > 0 (s). For dt/tau below 1e-2 the differences are taken from their series, so
/// that neither 1/tau = 0 nor a tiny step loses digits.
template <class Factor>
Relaxation<Factor> relaxation(const ViscoScramParameters& m, Factor dt) {
  using math::exp;
  using math::max;
  using math::select;
  Relaxation<Factor> step{dt, {}, {}, {}};
  for (std::size_t n = 0; n < maxwell_elements; ++n) {
    const Factor x = dt * Factor(m.relaxation_rates[n]);
    const Factor safe = max(x, Factor(1e-2));
    step.decay[n] = exp(-x);
    const Factor mean_series =
        Factor(1.0) - x * (Factor(0.5) - x * (Factor(1.0 / 6.0) -
                                              x * (Factor(1.0 / 24.0) -
                                                   x * (Factor(1.0 / 120.0) - x * Factor(1.0 / 720.0)))));
    const Factor response_series =
        Factor(0.5) -
        x * (Factor(1.0 / 6.0) -
             x * (Factor(1.0 / 24.0) -
                  x * (Factor(1.0 / 120.0) - x * (Factor(1.0 / 720.0) - x * Factor(1.0 / 5040.0)))));
    const auto small = x < Factor(1e-2);
    step.mean[n] = select(small, mean_series, (Factor(1.0) - exp(-safe)) / safe);
    step.mean_response[n] = select(small, response_series, (Factor(1.0) - step.mean[n]) / safe);
  }
  return step;
}

template <class Real>
struct ViscoScramState {
  std::array<math::Deviator<Real>, maxwell_elements> elements;  ///< S_n, Pa
  Real crack_radius;                                            ///< c, m
};

/// What a step dissipated.
template <class Real>
struct ViscoScramDissipation {
  Real viscous{0.0};  ///< J/m3
  Real crack{0.0};    ///< J/m3
};

template <class Real>
math::Deviator<Real> total_deviator(const ViscoScramState<Real>& state) {
  auto total = state.elements[0];
  for (std::size_t n = 1; n < maxwell_elements; ++n) total = total + state.elements[n];
  return total;
}

/// q = (c/a)^3, the ratio of crack to elastic strain; 0 without flaws (a = 0).
template <class Real>
Real crack_strain_ratio(const ViscoScramParameters& m, Real crack_radius) {
  const Real ratio = m.flaw_size > 0.0 ? crack_radius * Real(1.0 / m.flaw_size) : Real(0.0);
  return ratio * ratio * ratio;
}

/// Growth speed (m/s) of cracks of radius c under the stress deviator S and the pressure p; 0 at the bound.
template <class Real>
Real crack_growth_speed_under(const ViscoScramParameters& m, math::Deviator<Real> stress, Real pressure,
                              Real crack_radius) {
  using math::select;
  using math::sqrt;
  if (!m.growth || !(m.flaw_size > 0.0)) return Real(0.0);
  const Real intensity = sqrt(Real(detail::pi) * crack_radius) * math::von_mises(stress);
  const Real toughness = frictional_toughness(m, pressure, crack_radius);
  return select(crack_radius < Real(m.largest_crack_radius), crack_growth_speed(m, intensity, toughness),
                Real(0.0));
}

/// One implicit step of the element stresses for a strain increment `de` while q goes from q0 to q1: exact in
/// the relaxation, second order in the crack strain, unconditionally stable. Adds what it dissipates.
template <class Real, class Factor>
void relax(const ViscoScramParameters& m, ViscoScramState<Real>& state, math::Deviator<Real> de, Real q0,
           Real q1, const Relaxation<Factor>& step, ViscoScramDissipation<Real>& dissipation) {
  math::Deviator<Real> relaxed{};
  Real effective(0.0);  // sum G_n mean_n
  for (std::size_t n = 0; n < maxwell_elements; ++n) {
    relaxed = relaxed + Real(step.decay[n]) * state.elements[n];
    effective = effective + Real(m.shear_moduli[n]) * Real(step.mean[n]);
  }
  const Real share = effective * Real(1.0 / m.shear_modulus());
  const math::Deviator<Real> before = total_deviator(state),
                             uncracked = relaxed + (Real(2.0) * effective) * de;
  const math::Deviator<Real> after =
      (Real(1.0) / (Real(1.0) + share * q1)) * (uncracked + (share * q0) * before);
  const Real compliance = Real(0.5 / m.shear_modulus());
  const math::Deviator<Real> applied = de - compliance * (q1 * after - q0 * before);
  // Viscous loss = work put into the elements - change of what they store, S_n:S_n/(4 G_n).
  math::Deviator<Real> mean_stress{};
  Real stored(0.0);
  for (std::size_t n = 0; n < maxwell_elements; ++n) {
    const math::Deviator<Real> old = state.elements[n];
    const math::Deviator<Real> next =
        Real(step.decay[n]) * old + (Real(2.0 * m.shear_moduli[n]) * Real(step.mean[n])) * applied;
    mean_stress = mean_stress + Real(step.mean[n]) * old +
                  (Real(2.0 * m.shear_moduli[n]) * Real(step.mean_response[n])) * applied;
    // An element without stiffness stores nothing.
    const double compliance_of = m.shear_moduli[n] > 0.0 ? 0.25 / m.shear_moduli[n] : 0.0;
    stored += Real(compliance_of) * contract(next - old, next + old);
    state.elements[n] = next;
  }
  dissipation.viscous += contract(mean_stress, applied) - stored;
  dissipation.crack += Real(0.5) * compliance * (q1 - q0) * contract(before, after);
}

namespace detail {

/// Share of its radius that a crack may grow in a step that is not divided.
inline constexpr double growth_of_whole_step = 1e-3;
/// Share of its radius that a crack may grow in one sub-step.
inline constexpr double growth_per_substep = 0.01;

/// While cracks and elements relax together a step x = dt/tau of the fastest element errs, after a sudden
/// strain, by about 0.005 x^2 q/(1 + q)^3 of the stress as long as x q/(1 + q) is small (measured). Bounds on
/// sqrt(x^2 q/(1 + q)^3) and on x q/(1 + q), for a step that is not divided; a sub-step keeps to the given
/// share.
inline constexpr double largest_coupling = 0.3;
inline constexpr double largest_crack_relaxation = 2.0;
inline constexpr double coupling_share_of_substep = 0.7;

/// So many of the shortest relaxation times after the begin of a step, what relaxes fastest follows the rest,
/// and a sub-step may be a share of the time since the begin: the number of sub-steps then goes with the
/// logarithm of dt/tau, not with dt/tau itself, which has no bound (tau = 1 ps, dt = 0.1 ms: 1e8). Relaxation
/// that is still going on at the time t has a time scale of about t, of which the share resolves it.
inline constexpr double settled_relaxations = 64.0;
inline constexpr double share_of_settled = 0.02;
/// No sub-step is shorter than this share of the step, so that the time left falls in round-off too.
inline constexpr double shortest_share = 1e-9;

/// True where a step of x = dt/tau is beyond those bounds.
template <class Real>
auto couples_too_strongly(double x, Real q) {
  const Real stiffening = Real(1.0) + q;
  return (Real(x * x) * q >
          Real(largest_coupling * largest_coupling) * stiffening * stiffening * stiffening) |
         (Real(x) * q > Real(largest_crack_relaxation) * stiffening);
}

/// Longest step, in units of the fastest relaxation time, within those bounds.
template <class Real>
Real longest_coupled_step(Real q) {
  using math::max;
  using math::min;
  using math::sqrt;
  const Real stiffening = Real(1.0) + q;
  const Real share = stiffening / max(q, Real(1e-100));
  return min(Real(largest_coupling) * stiffening * sqrt(share), Real(largest_crack_relaxation) * share);
}

/// Copies state and losses in the lanes that are true.
template <class Condition, class Real>
void take(Condition lanes, const ViscoScramState<Real>& from, const ViscoScramDissipation<Real>& lost,
          ViscoScramState<Real>& to, ViscoScramDissipation<Real>& dissipation) {
  using math::select;
  for (std::size_t n = 0; n < maxwell_elements; ++n) {
    to.elements[n].rr = select(lanes, from.elements[n].rr, to.elements[n].rr);
    to.elements[n].xx = select(lanes, from.elements[n].xx, to.elements[n].xx);
    to.elements[n].rx = select(lanes, from.elements[n].rx, to.elements[n].rx);
  }
  to.crack_radius = select(lanes, from.crack_radius, to.crack_radius);
  dissipation.viscous = select(lanes, lost.viscous, dissipation.viscous);
  dissipation.crack = select(lanes, lost.crack, dissipation.crack);
}

/// Heun sub-steps with their own length in every lane, until the whole step is done. Growth is geometric and
/// bounded, and a sub-step never shorter than a share of the shortest relaxation time or, later, of the time
/// since the begin, so their number is bounded too.
template <class Real>
[[gnu::noinline, gnu::cold]]  // keeps the step that is not divided small enough to stay in registers
void substep(const ViscoScramParameters& m, ViscoScramState<Real>& state, math::Deviator<Real> de,
             Real pressure, double dt, double fastest_rate, ViscoScramDissipation<Real>& dissipation) {
  using math::any;
  using math::max;
  using math::min;
  using math::select;
  Real remaining(dt);
  while (any(remaining > Real(0.0))) {
    const Real c0 = state.crack_radius;
    const Real q0 = crack_strain_ratio(m, c0);
    const Real speed0 = crack_growth_speed_under(m, total_deviator(state), pressure, c0);
    const Real growth_limit =
        select(speed0 > Real(0.0), Real(growth_per_substep) * c0 / max(speed0, Real(1e-300)), remaining);
    const Real relaxation_limit =
        Real(coupling_share_of_substep / max(fastest_rate, 1e-100)) * longest_coupled_step(q0);
    const Real elapsed = Real(dt) - remaining;
    const auto settled = elapsed * Real(fastest_rate) > Real(settled_relaxations);
    const Real graded =
        select(settled, max(relaxation_limit, Real(share_of_settled) * elapsed), relaxation_limit);
    const Real limit = max(min(growth_limit, graded), Real(shortest_share * dt));
    const auto last = remaining <= limit * Real(1.0 + 1e-9);
    const Real h = select(last, remaining, limit);
    // A lane that is done steps over a negligible length with no strain, which leaves it as it is.
    const Real length = max(h, Real(shortest_share * dt));
    const auto active = remaining > Real(0.0);
    const auto step = relaxation(m, length);
    const math::Deviator<Real> part = (h * Real(1.0 / dt)) * de;
    const Real bound(max(m.largest_crack_radius, 0.0));
    ViscoScramState<Real> trial = state;
    ViscoScramDissipation<Real> trial_loss = dissipation;
    const Real predicted = max(c0, min(c0 + h * speed0, bound));
    relax(m, trial, part, q0, crack_strain_ratio(m, predicted), step, trial_loss);
    const Real speed1 = crack_growth_speed_under(m, total_deviator(trial), pressure, predicted);
    const Real corrected = max(c0, min(c0 + Real(0.5) * h * (speed0 + speed1), bound));
    trial = state;
    trial_loss = dissipation;
    relax(m, trial, part, q0, crack_strain_ratio(m, corrected), step, trial_loss);
    trial.crack_radius = corrected;
    take(active, trial, trial_loss, state, dissipation);
    remaining = select(last, Real(0.0), remaining - h);
  }
}

}  // namespace detail

}  // namespace launchsafe::materials
