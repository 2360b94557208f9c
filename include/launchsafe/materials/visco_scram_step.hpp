// The step of Visco-SCRAM as the charge takes it, in few operations.
//
// Deviators are vectors by orthonormal components. The state holds their total S and, of the elements, all
// but the first, S_1 = S - sum of the others: S is what the cracks ask for, and an elastic first element
// (1/tau_1 = 0), which needs nothing else, then costs nothing. With D_n, M_n the decay and mean of a step
// (see Relaxation), r = sum G_n M_n/G and the crack strain q S/(2 G), the step is
//     S' = [S - sum (1 - D_n) S_n + 2 G r e + r q S]/(1 + r q'),   applied a = e - (q' S' - q S)/(2 G),
//     S_n' = D_n S_n + 2 G_n M_n a,
// and what the dashpots take, the integral of S_n:S_n/(2 G_n tau_n) over the step, is a quadratic form in S_n
// and a whose three coefficients belong to the step.
#pragma once

#include "launchsafe/materials/visco_scram.hpp"

namespace launchsafe::materials {

class ViscoScramStep {
 public:
  static constexpr std::size_t kept_elements = maxwell_elements - 1;

  template <class Real>
  struct State {
    math::DeviatorVector<Real> total;                                ///< S, Pa
    std::array<math::DeviatorVector<Real>, kept_elements> elements;  ///< S_2, S_3, ..., Pa
    Real crack_radius;                                               ///< c, m
  };

  template <class Real>
  struct Result {
    State<Real> state;
    Real viscous, crack;  ///< J/m3
  };

  explicit ViscoScramStep(const ViscoScramParameters& parameters);
  /// Sets the factors of steps of dt > 0 (s).
  void set_step(double dt);

  /// From a state that is already turned (Jaumann), by a deviatoric strain increment under the pressure p
  /// (Pa), which is held over the step. One step where cracks hardly grow, by the midpoint rule for c, and
  /// sub-steps where they do; of second order in dt.
  template <class Real>
  [[gnu::always_inline]] inline Result<Real> update(const State<Real>& start,
                                                    math::DeviatorVector<Real> strain, Real pressure) const;

  /// A state by all its elements, and back.
  template <class Real>
  static ViscoScramState<Real> elements_of(const State<Real>& state);
  template <class Real>
  static State<Real> state_of(const ViscoScramState<Real>& elements);

 private:
  /// c at the end of the step, and where the step has to be divided.
  template <class Real, class Condition>
  struct Growth {
    Real crack_radius;
    Condition divided;
  };
  template <class Real>
  using ConditionOf = decltype(Real{} < Real{});

  template <class Real>
  Real strain_ratio(Real crack_radius) const {
    const Real ratio = crack_radius * Real(per_flaw_size_);
    return ratio * ratio * ratio;
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
  template <class Real>
  [[gnu::noinline, gnu::cold]] Result<Real> divided_update(const State<Real>& start,
                                                           math::DeviatorVector<Real> strain,
                                                           Real pressure) const;

  /// Of one element: what it loses and gains in a step, and its share of the dashpots' loss per S_n:S_n,
  /// S_n:a and a:a.
  struct Factors {
    double lost, decay, response, loss_of_stress, loss_of_both, loss_of_strain;
  };

  ViscoScramParameters parameters_;
  Relaxation<double> relaxation_{};
  std::array<Factors, maxwell_elements> factors_{};
  bool first_relaxes_ = false, grows_ = false, half_exponent_is_whole_ = false, couples_ = false;
  double half_exponent_;                                                  ///< m/2
  int whole_half_exponent_;                                               ///< its whole part
  double compliance_;                                                     ///< 1/(2 G), 1/Pa
  double per_flaw_size_;                                                  ///< 1/m; 0 without flaws
  double intensity_factor_;                                               ///< 1/(m Pa2)
  double friction_;                                                       ///< mu'/K0
  double largest_radius_;                                                 ///< m
  double fastest_rate_ = 0;                                               ///< 1/s
  double strain_response_ = 0, share_response_ = 0, loss_of_strain_ = 0;  ///< 2 G r, r, sum of loss_of_strain
  double idle_share_ = 0;  ///< (K/K')^2 below which c stays as it is
};

/// True where cracks would grow by less than half of the last digit of c(0), so that c stays as it is. By the
/// toughness without the friction ratio's linear term, which needs no root and bounds the growth from above.
template <class Real>
auto ViscoScramStep::idle(Real crack_radius, Real intensity, Real pressure) const {
  using math::max;
  const Real friction = Real(friction_) * max(pressure, Real(0.0));
  return intensity <= Real(idle_share_) + Real(idle_share_ * detail::pi) * friction * friction * crack_radius;
}

template <class Real>
auto ViscoScramStep::grow(Real crack_radius, Real intensity, Real pressure) const
    -> Growth<Real, ConditionOf<Real>> {
  using math::any;
  using math::max;
  using math::min;
  using math::select;
  using math::sqrt;
  const Real friction = Real(friction_) * max(pressure, Real(0.0)) * sqrt(crack_radius);  // A/K0
  const Real toughening = detail::toughening(friction), radius = max(crack_radius, Real(1e-300));
  const Real per_both = Real(1.0) / (toughening * radius), per_toughening = per_both * radius;
  const Real share = intensity * per_toughening;  // (K/K')^2
  const double slow_speed = 1.0 / (1.0 + half_exponent_), transition = 1.0 + 1.0 / half_exponent_;
  const Real below = min(share, Real(1.0));
  Real speed = Real(slow_speed) *  // of the largest
               (half_exponent_is_whole_ ? detail::whole_power(below, whole_half_exponent_)
                                        : math::pow(below, Real(half_exponent_)));
  Real exponent(2.0 * half_exponent_);
  const auto fast = share > Real(1.0);
  if (any(fast)) {
    speed = select(fast, Real(1.0) - Real(1.0) / (Real(transition) * max(share, Real(1.0))), speed);
    exponent = select(fast, Real(2.0) * (Real(1.0) - speed) / speed, exponent);
  }
  const Real growth = select(crack_radius < Real(parameters_.largest_crack_radius),
                             Real(relaxation_.dt * parameters_.largest_growth_speed) * speed, Real(0.0));
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
auto ViscoScramStep::relaxes_unevenly(const State<Real>& start, math::DeviatorVector<Real> strain,
                                      math::DeviatorVector<Real> after, Real ratio) const
    -> ConditionOf<Real> {
  constexpr double largest = 3e-4;
  auto first = start.total;
  for (const auto& element : start.elements) first = first - element;
  const auto applied = strain - (Real(compliance_) * ratio) * (after - start.total);
  Real uneven(0.0);
  for (std::size_t n = 0; n < maxwell_elements; ++n) {
    const double x = relaxation_.dt * parameters_.relaxation_rates[n];
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
ViscoScramState<Real> ViscoScramStep::elements_of(const State<Real>& state) {
  ViscoScramState<Real> result;
  auto first = state.total;
  for (std::size_t n = 0; n < kept_elements; ++n) {
    first = first - state.elements[n];
    result.elements[n + 1] = deviator_of(state.elements[n]);
  }
  result.elements[0] = deviator_of(first);
  result.crack_radius = state.crack_radius;
  return result;
}

template <class Real>
auto ViscoScramStep::state_of(const ViscoScramState<Real>& elements) -> State<Real> {
  State<Real> result;
  result.total = vector_of(total_deviator(elements));
  for (std::size_t n = 0; n < kept_elements; ++n) result.elements[n] = vector_of(elements.elements[n + 1]);
  result.crack_radius = elements.crack_radius;
  return result;
}

template <class Real>
auto ViscoScramStep::divided_update(const State<Real>& start, math::DeviatorVector<Real> strain,
                                    Real pressure) const -> Result<Real> {
  ViscoScramState<Real> elements = elements_of(start);
  ViscoScramDissipation<Real> lost;
  detail::substep(parameters_, elements, deviator_of(strain), pressure, relaxation_.dt, fastest_rate_, lost);
  return {state_of(elements), lost.viscous, lost.crack};
}

namespace detail {

/// Calls with 0, 1, ... one after the other, written out.
template <std::size_t count, class Function>
[[gnu::always_inline]] inline void for_each_index(Function&& function) {
  [&]<std::size_t... n>(std::index_sequence<n...>) __attribute__((always_inline)) { (function(n), ...); }
  (std::make_index_sequence<count>{});
}

/// Sets `to` where `lanes` are true.
template <class Condition, class Real>
void take(Condition lanes, const math::DeviatorVector<Real>& from, math::DeviatorVector<Real>& to) {
  using math::select;
  to = {select(lanes, from.hoop, to.hoop), select(lanes, from.difference, to.difference),
        select(lanes, from.shear, to.shear)};
}

}  // namespace detail

template <class Real>
auto ViscoScramStep::update(const State<Real>& start, math::DeviatorVector<Real> strain, Real pressure) const
    -> Result<Real> {
  using math::any;
  using math::select;
  using Vector = math::DeviatorVector<Real>;
  // What relaxes, the dashpots' loss as far as the stress alone makes it, and the stress that the strain
  // meets.
  Vector relaxing{}, resisting{};
  Real viscous(0.0);
  const auto weigh = [&](const Factors& f, const Vector& stress) {
    relaxing = relaxing + Real(f.lost) * stress;
    resisting = resisting + Real(f.loss_of_both) * stress;
    viscous += Real(f.loss_of_stress) * contract(stress, stress);
  };
  for (std::size_t n = 0; n < kept_elements; ++n) weigh(factors_[n + 1], start.elements[n]);
  if (first_relaxes_) [[unlikely]] {
    Vector first = start.total;
    for (const Vector& element : start.elements) first = first - element;
    weigh(factors_[0], first);
  }

  const Real radius = start.crack_radius, ratio = strain_ratio(radius);
  const Real share(share_response_);
  const Vector driven =
      (start.total - relaxing) + Real(strain_response_) * strain + (share * ratio) * start.total;
  Vector after = (Real(1.0) / (Real(1.0) + share * ratio)) * driven;

  Result<Real> result;
  Real end_radius = radius, end_ratio = ratio;
  result.crack = Real(0.0);
  ConditionOf<Real> divided{};
  bool divides = false;
  if (couples_) [[unlikely]] {
    divided = detail::couples_too_strongly(relaxation_.dt * fastest_rate_, ratio);
    if (any(divided)) divided = divided & relaxes_unevenly(start, strain, after, ratio);
    divides = any(divided);
  }
  if (grows_) {
    const Real drive = intensity(radius, start.total + after);
    if (any(!idle(radius, drive, pressure))) {
      const auto growth = grow(radius, drive, pressure);
      end_radius = growth.crack_radius;
      end_ratio = strain_ratio(end_radius);
      after = (Real(1.0) / (Real(1.0) + share * end_ratio)) * driven;
      result.crack = Real(0.5 * compliance_) * (end_ratio - ratio) * contract(start.total, after);
      divided = divided | growth.divided;
      divides = any(divided);
    }
  }
  const Real compliance(compliance_);
  const Vector applied = strain - (compliance * end_ratio) * after + (compliance * ratio) * start.total;
  for (std::size_t n = 0; n < kept_elements; ++n)
    result.state.elements[n] =
        Real(factors_[n + 1].decay) * start.elements[n] + Real(factors_[n + 1].response) * applied;
  result.state.total = after;
  result.state.crack_radius = end_radius;
  result.viscous = viscous + contract(resisting + Real(loss_of_strain_) * applied, applied);
  if (divides) [[unlikely]] {
    // Copied part by part and without a loop, which stays one in a rare branch: states that are indexed or
    // passed on as a whole would be kept in memory in every step.
    State<Real> begin;
    begin.total = start.total;
    begin.crack_radius = radius;
    detail::for_each_index<kept_elements>([&](std::size_t n) { begin.elements[n] = start.elements[n]; });
    const Result<Real> parts = divided_update(begin, strain, pressure);
    detail::take(divided, parts.state.total, result.state.total);
    detail::for_each_index<kept_elements>(
        [&](std::size_t n) { detail::take(divided, parts.state.elements[n], result.state.elements[n]); });
    result.state.crack_radius = select(divided, parts.state.crack_radius, end_radius);
    result.viscous = select(divided, parts.viscous, result.viscous);
    result.crack = select(divided, parts.crack, result.crack);
  }
  return result;
}

}  // namespace launchsafe::materials
