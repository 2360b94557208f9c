// Visco-SCRAM: a generalised Maxwell solid in series with an isotropic ensemble of penny cracks
// (Bennett et al. 1998; paper Eq. 28-31, corrected: c/a and its rate, deviatoric strain rate, K1, 1/tau_1 =
// 0).
//
// With q = (c/a)^3 the paper's pair of equations is equivalent to
//     dS_n/dt = 2 G_n (e - de_c/dt) - S_n/tau_n,   2 G e_c = q S,   S = sum S_n,
// where e_c is the crack strain. In this form the relaxation is integrated exactly and the crack strain
// implicitly.
//
// Deviators are vectors by orthonormal components. The state holds their total S and, of the elements, all
// but the first, S_1 = S - sum of the others: S is what the cracks ask for, and an elastic first element
// (1/tau_1 = 0), which needs nothing else, then costs nothing. With D_n = exp(-dt/tau_n), its mean M_n over
// the step, r = sum G_n M_n/G and the crack strain q S/(2 G), the step is
//     S' = [S - sum (1 - D_n) S_n + 2 G r e + r q S]/(1 + r q'),   applied a = e - (q' S' - q S)/(2 G),
//     S_n' = D_n S_n + 2 G_n M_n a,
// and what the dashpots take, the integral of S_n:S_n/(2 G_n tau_n) over the step, is a quadratic form in S_n
// and a whose three coefficients belong to the step.
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

/// (K/K0)^2 of a toughness K0 sqrt[1 + (pi A/K0)(1 + A/K0)] raised by the friction ratio A/K0 of crack faces.
template <class Real>
Real toughening(Real ratio) {
  return Real(1.0) + Real(pi) * ratio * (Real(1.0) + ratio);
}

/// Calls with 0, 1, ... one after the other, written out.
template <std::size_t count, class Function>
[[gnu::always_inline]] inline void for_each_index(Function&& function) {
  [&]<std::size_t... n>(std::index_sequence<n...>) __attribute__((always_inline)) { (function(n), ...); }
  (std::make_index_sequence<count>{});
}

/// Share of its radius that a crack may grow in a step that is not divided.
inline constexpr double growth_of_whole_step = 1e-3;

/// While cracks and elements relax together a step x = dt/tau of the fastest element errs, after a sudden
/// strain, by about 0.005 x^2 q/(1 + q)^3 of the stress as long as x q/(1 + q) is small (measured). Bounds on
/// sqrt(x^2 q/(1 + q)^3) and on x q/(1 + q), for a step that is not divided.
inline constexpr double largest_coupling = 0.3;
inline constexpr double largest_crack_relaxation = 2.0;

/// True where a step of x = dt/tau is beyond those bounds.
template <class Real>
auto couples_too_strongly(double x, Real q) {
  const Real stiffening = Real(1.0) + q;
  return (Real(x * x) * q >
          Real(largest_coupling * largest_coupling) * stiffening * stiffening * stiffening) |
         (Real(x) * q > Real(largest_crack_relaxation) * stiffening);
}

}  // namespace detail

/// The step of Visco-SCRAM as the charge takes it, in few operations.
class ViscoScram {
 public:
  static constexpr std::size_t kept_elements = maxwell_elements - 1;

  template <class Real>
  struct State {
    math::DeviatorVector<Real> total;                                ///< S, Pa
    std::array<math::DeviatorVector<Real>, kept_elements> elements;  ///< S_2, S_3, ..., Pa
    Real crack_radius;                                               ///< c, m

    math::DeviatorVector<Real> first_element() const {
      auto first = total;
      for (const auto& element : elements) first = first - element;
      return first;
    }
  };

  template <class Real>
  struct Result {
    State<Real> state;
    Real viscous, crack;  ///< J/m3
  };

  explicit ViscoScram(const ViscoScramParameters& parameters);
  /// Sets the factors of steps of dt > 0 (s).
  void set_step(double dt);

  /// From a state that is already turned (Jaumann), by a deviatoric strain increment under the pressure p
  /// (Pa), which is held over the step. One step where cracks hardly grow, by the midpoint rule for c, and
  /// sub-steps where they do; of second order in dt.
  template <class Real>
  [[gnu::always_inline]] inline Result<Real> update(const State<Real>& start,
                                                    math::DeviatorVector<Real> strain, Real pressure) const;

  /// q = (c/a)^3, the ratio of crack to elastic strain; 0 without flaws (a = 0).
  template <class Real>
  Real strain_ratio(Real crack_radius) const {
    const Real ratio = crack_radius * Real(per_flaw_size_);
    return ratio * ratio * ratio;
  }

  /// Growth speed dc/dt (m/s) of cracks of radius c (m) under the stress S and the pressure p (Pa): v_max
  /// (K/K1)^m below K' = K0 sqrt(1 + 2/m), v_max (1 - (K0/K)^2) above, with K1 = K' (1 + m/2)^(1/m); value
  /// and slope are continuous at K' (paper Eq. 30-31). 0 at the bound and where nothing grows.
  double growth_speed(double crack_radius, math::DeviatorVector<double> stress, double pressure) const;

 private:
  template <class Real>
  using ConditionOf = decltype(Real{} < Real{});

  /// Of one element: what it loses and gains in a step, and its share of the dashpots' loss per S_n:S_n,
  /// S_n:a and a:a.
  struct ElementFactors {
    double lost, decay, response, loss_of_stress, loss_of_both, loss_of_strain;
  };
  /// What the length dt (s) of a step fixes for all particles.
  struct Factors {
    double dt = 0;
    std::array<ElementFactors, maxwell_elements> elements{};
    double strain_response = 0, share_response = 0, loss_of_strain = 0;  ///< 2 G r, r, of all elements
  };
  Factors factors_of(double dt) const;

  /// A step as far as it does not depend on what cracks do in it.
  template <class Real>
  struct Drive {
    math::DeviatorVector<Real> driven, resisting;  ///< S' (1 + r q'); stress that the strain meets
    Real viscous;                                  ///< the dashpots' loss as far as the stress alone makes it
  };
  template <class Real>
  [[gnu::always_inline]] inline Drive<Real> drive(const State<Real>& start, math::DeviatorVector<Real> strain,
                                                  Real ratio, const Factors& factors) const;
  /// S' where the ratio of crack strain is `ratio` at the end.
  template <class Real>
  static math::DeviatorVector<Real> stress_at(Real ratio, const Drive<Real>& drive, const Factors& factors) {
    return (Real(1.0) / (Real(1.0) + Real(factors.share_response) * ratio)) * drive.driven;
  }
  /// Elements and viscous loss of a step to `state.total`, `from` and `to` its ratios of crack strain.
  template <class Real>
  [[gnu::always_inline]] inline void finish(const State<Real>& start, math::DeviatorVector<Real> strain,
                                            Real from, Real to, const Drive<Real>& drive,
                                            const Factors& factors, Result<Real>& result) const;

  /// c at the end of the step, and where the step has to be divided.
  template <class Real, class Condition>
  struct Growth {
    Real crack_radius;
    Condition divided;
  };
  /// Growth speed over the largest one, and d ln(dc/dt)/d ln K.
  template <class Real>
  struct Speed {
    Real speed, exponent;
  };
  /// At a `share` = (K/K')^2.
  template <class Real>
  [[gnu::always_inline]] inline Speed<Real> speed_at(Real share) const;
  /// A/K0 of the crack-face friction, A = mu' p sqrt(c), mu' = mu_s sqrt(45/(2 (3 - 2 mu_s^2))); 0 under
  /// tension.
  template <class Real>
  Real friction_ratio(Real pressure, Real crack_radius) const {
    return Real(friction_) * math::max(pressure, Real(0.0)) * math::sqrt(crack_radius);
  }
  /// (K/K')^2 without the friction's toughening; `twice` is S at the begin plus S at the end.
  template <class Real>
  Real intensity(Real crack_radius, math::DeviatorVector<Real> twice) const {
    return Real(intensity_factor_) * crack_radius * contract(twice, twice);
  }
  template <class Real>
  auto idle(Real crack_radius, Real intensity, Real pressure) const;
  template <class Real>
  [[gnu::always_inline]] inline Growth<Real, ConditionOf<Real>> grow(Real crack_radius, Real intensity,
                                                                     Real pressure) const;
  template <class Real>
  [[gnu::noinline, gnu::cold]] ConditionOf<Real> relaxes_unevenly(const State<Real>& start,
                                                                  math::DeviatorVector<Real> strain,
                                                                  math::DeviatorVector<Real> after,
                                                                  Real ratio) const;
  double longest_part(const State<double>& state, double growth_speed, double elapsed) const;
  /// The step of the lanes that are true in parts, each by Heun's method for c.
  [[gnu::noinline, gnu::cold]] Result<math::Pack> divided_update(const State<math::Pack>& start,
                                                                 math::DeviatorVector<math::Pack> strain,
                                                                 math::Pack pressure, math::Mask lanes) const;
  /// Likewise of one particle, `divided` or not.
  Result<double> divided_update(const State<double>& start, math::DeviatorVector<double> strain,
                                double pressure, bool divided) const;

  ViscoScramParameters parameters_;
  Factors factors_{};
  bool first_relaxes_ = false, grows_ = false, half_exponent_is_whole_ = false, couples_ = false;
  double half_exponent_;     ///< m/2
  int whole_half_exponent_;  ///< its whole part
  double compliance_;        ///< 1/(2 G), 1/Pa
  double per_flaw_size_;     ///< 1/m; 0 without flaws
  double intensity_factor_;  ///< 1/(m Pa2)
  double friction_;          ///< mu'/K0
  double largest_radius_;    ///< m
  double fastest_rate_ = 0;  ///< 1/s
  double idle_share_ = 0;    ///< (K/K')^2 below which c stays as it is
};

/// True where cracks would grow by less than half of the last digit of c(0), so that c stays as it is. By the
/// toughness without the friction ratio's linear term, which needs no root and bounds the growth from above.
template <class Real>
auto ViscoScram::idle(Real crack_radius, Real intensity, Real pressure) const {
  using math::max;
  const Real friction = Real(friction_) * max(pressure, Real(0.0));
  return intensity <= Real(idle_share_) + Real(idle_share_ * detail::pi) * friction * friction * crack_radius;
}

template <class Real>
auto ViscoScram::speed_at(Real share) const -> Speed<Real> {
  using math::any;
  using math::max;
  using math::min;
  using math::select;
  const double slow_speed = 1.0 / (1.0 + half_exponent_), transition = 1.0 + 1.0 / half_exponent_;
  const Real below = min(share, Real(1.0));
  Real speed = Real(slow_speed) * (half_exponent_is_whole_ ? detail::whole_power(below, whole_half_exponent_)
                                                           : math::pow(below, Real(half_exponent_)));
  Real exponent(2.0 * half_exponent_);
  const auto fast = share > Real(1.0);
  if (any(fast)) {
    speed = select(fast, Real(1.0) - Real(1.0) / (Real(transition) * max(share, Real(1.0))), speed);
    exponent = select(fast, Real(2.0) * (Real(1.0) - speed) / speed, exponent);
  }
  return {speed, exponent};
}

template <class Real>
auto ViscoScram::grow(Real crack_radius, Real intensity, Real pressure) const
    -> Growth<Real, ConditionOf<Real>> {
  using math::max;
  using math::min;
  using math::select;
  const Real friction = friction_ratio(pressure, crack_radius);
  const Real toughening = detail::toughening(friction), radius = max(crack_radius, Real(1e-300));
  const Real per_both = Real(1.0) / (toughening * radius), per_toughening = per_both * radius;
  const auto [speed, exponent] = speed_at(intensity * per_toughening);
  const Real growth = select(crack_radius < Real(parameters_.largest_crack_radius),
                             Real(factors_.dt * parameters_.largest_growth_speed) * speed, Real(0.0));
  const auto divided = growth > Real(detail::growth_of_whole_step) * crack_radius;
  // d ln(dc/dt)/d ln c at constant stress: below K' the speed goes with K^m, above it d ln v/d ln K is 2 (1 -
  // w)/w, w = v/v_max, which meets m at K'; K goes with c^(1/2), less what the toughness gains with c.
  const Real gain = Real(0.25 * detail::pi) * friction * (Real(1.0) + Real(2.0) * friction) * per_toughening;
  const Real relative = growth * per_both * toughening;
  const Real curved = Real(1.0) + Real(0.5) * exponent * (Real(0.5) - gain) * relative;
  return {max(crack_radius, min(crack_radius + growth * curved, Real(largest_radius_))), divided};
}

/// True where it matters that cracks and elements relax together. The stress of an element that follows an
/// even strain is 2 G_n a/x_n, x_n = dt/tau_n, with the strain a that elements take in the step; what it
/// lacks of that relaxes within the step by x_n times as much, a share of q/(1 + q) of it into the cracks.
/// Bound on the root of the sum of squares of that, over S at both ends. In a launch, whose strain hardly
/// changes within a step, what relaxes fast has followed long ago.
template <class Real>
auto ViscoScram::relaxes_unevenly(const State<Real>& start, math::DeviatorVector<Real> strain,
                                  math::DeviatorVector<Real> after, Real ratio) const -> ConditionOf<Real> {
  constexpr double largest = 3e-4;
  const auto first = start.first_element();
  const auto applied = strain - (Real(compliance_) * ratio) * (after - start.total);
  Real uneven(0.0);
  for (std::size_t n = 0; n < maxwell_elements; ++n) {
    const double x = factors_.dt * parameters_.relaxation_rates[n];
    if (!(x > 0.0)) continue;
    const auto relaxing = Real(x) * (n == 0 ? first : start.elements[n - 1]) -
                          Real(2.0 * parameters_.shear_moduli[n]) * applied;
    uneven += contract(relaxing, relaxing);
  }
  const Real share = ratio / (Real(1.0) + ratio);
  return share * share * uneven >
         Real(largest * largest) * (contract(start.total, start.total) + contract(after, after));
}

template <class Real>
auto ViscoScram::drive(const State<Real>& start, math::DeviatorVector<Real> strain, Real ratio,
                       const Factors& factors) const -> Drive<Real> {
  using Vector = math::DeviatorVector<Real>;
  Vector relaxing{}, resisting{};
  Real viscous(0.0);
  const auto weigh = [&](const ElementFactors& f, const Vector& stress) {
    relaxing = relaxing + Real(f.lost) * stress;
    resisting = resisting + Real(f.loss_of_both) * stress;
    viscous += Real(f.loss_of_stress) * contract(stress, stress);
  };
  for (std::size_t n = 0; n < kept_elements; ++n) weigh(factors.elements[n + 1], start.elements[n]);
  if (first_relaxes_) [[unlikely]]
    weigh(factors.elements[0], start.first_element());
  return {(start.total - relaxing) + Real(factors.strain_response) * strain +
              (Real(factors.share_response) * ratio) * start.total,
          resisting, viscous};
}

template <class Real>
void ViscoScram::finish(const State<Real>& start, math::DeviatorVector<Real> strain, Real from, Real to,
                        const Drive<Real>& drive, const Factors& factors, Result<Real>& result) const {
  const Real compliance(compliance_);
  const math::DeviatorVector<Real> applied =
      strain - (compliance * to) * result.state.total + (compliance * from) * start.total;
  for (std::size_t n = 0; n < kept_elements; ++n)
    result.state.elements[n] = Real(factors.elements[n + 1].decay) * start.elements[n] +
                               Real(factors.elements[n + 1].response) * applied;
  result.viscous =
      drive.viscous + contract(drive.resisting + Real(factors.loss_of_strain) * applied, applied);
}

template <class Real>
auto ViscoScram::update(const State<Real>& start, math::DeviatorVector<Real> strain, Real pressure) const
    -> Result<Real> {
  using math::any;
  using math::select;
  using Vector = math::DeviatorVector<Real>;
  const Real radius = start.crack_radius, ratio = strain_ratio(radius);
  const Drive<Real> begun = drive(start, strain, ratio, factors_);
  Vector after = stress_at(ratio, begun, factors_);

  Result<Real> result;
  Real end_radius = radius, end_ratio = ratio;
  result.crack = Real(0.0);
  ConditionOf<Real> divided{};
  bool divides = false;
  if (couples_) [[unlikely]] {
    divided = detail::couples_too_strongly(factors_.dt * fastest_rate_, ratio);
    if (any(divided)) divided = divided & relaxes_unevenly(start, strain, after, ratio);
    divides = any(divided);
  }
  if (grows_) {
    const Real drive = intensity(radius, start.total + after);
    if (any(!idle(radius, drive, pressure))) {
      const auto growth = grow(radius, drive, pressure);
      end_radius = growth.crack_radius;
      end_ratio = strain_ratio(end_radius);
      after = stress_at(end_ratio, begun, factors_);
      result.crack = Real(0.5 * compliance_) * (end_ratio - ratio) * contract(start.total, after);
      divided = divided | growth.divided;
      divides = any(divided);
    }
  }
  result.state.total = after;
  result.state.crack_radius = end_radius;
  finish(start, strain, ratio, end_ratio, begun, factors_, result);
  if (divides) [[unlikely]] {
    // Copied part by part and without a loop, which stays one in a rare branch: states that are indexed or
    // passed on as a whole would be kept in memory in every step.
    State<Real> begin;
    begin.total = start.total;
    begin.crack_radius = radius;
    detail::for_each_index<kept_elements>([&](std::size_t n) { begin.elements[n] = start.elements[n]; });
    const Result<Real> parts = divided_update(begin, strain, pressure, divided);
    const auto take = [divided](const Vector& from, Vector& to) {
      to = {select(divided, from.hoop, to.hoop), select(divided, from.difference, to.difference),
            select(divided, from.shear, to.shear)};
    };
    take(parts.state.total, result.state.total);
    detail::for_each_index<kept_elements>(
        [&](std::size_t n) { take(parts.state.elements[n], result.state.elements[n]); });
    result.state.crack_radius = select(divided, parts.state.crack_radius, end_radius);
    result.viscous = select(divided, parts.viscous, result.viscous);
    result.crack = select(divided, parts.crack, result.crack);
  }
  return result;
}

}  // namespace launchsafe::materials
