// Steel: Mie-Grueneisen pressure, Johnson-Cook strength, heated by its plastic work.
#pragma once

#include "launchsafe/materials/law.hpp"
#include "launchsafe/materials/mie_gruneisen.hpp"
#include "launchsafe/math/deviator.hpp"

#include <limits>

namespace launchsafe::materials {

// --- Johnson-Cook flow stress with radial return (paper Eq. 16-17) ---

struct JohnsonCookParameters {
  double a = 792e6;                     ///< A, Pa [P]
  double b = 510e6;                     ///< B, Pa [P]
  double n = 0.26;                      ///< hardening exponent [P]
  double c = 0.014;                     ///< rate sensitivity [P]
  double m = 1.03;                      ///< thermal softening exponent [P]
  double reference_rate = 1.0;          ///< 1/s [A]
  double room_temperature = 298.0;      ///< K [A]
  double melting_temperature = 1793.0;  ///< K [P]
  double shear_modulus = 80e9;          ///< G, Pa [L]
  double specific_heat = 460.0;         ///< J/(kg K) [P]
  double taylor_quinney = 0.9;          ///< share of the plastic work that becomes heat [A]
  double conductivity = 38.0;           ///< W/(m K) [L]
};

/// Flow stress (Pa) at plastic strain >= 0, plastic strain rate (1/s) and temperature (K). Below the
/// reference rate the rate factor is 1; at and above melting the flow stress is 0.
template <class Real>
Real johnson_cook_flow_stress(const JohnsonCookParameters& k, Real plastic_strain, Real plastic_rate,
                              Real temperature) {
  using math::log;
  using math::max;
  using math::min;
  using math::pow;
  using math::select;
  const Real homologous =
      min(max((temperature - Real(k.room_temperature)) / Real(k.melting_temperature - k.room_temperature),
              Real(0.0)),
          Real(1.0));
  const Real softening = Real(1.0) - pow(homologous, Real(k.m));
  const Real rate_factor = Real(1.0) + Real(k.c) * log(max(plastic_rate / Real(k.reference_rate), Real(1.0)));
  return (Real(k.a) + Real(k.b) * pow(plastic_strain, Real(k.n))) * rate_factor * softening;
}

template <class Real>
struct JohnsonCookReturn {
  math::Deviator<Real> stress;    ///< Pa
  Real plastic_strain_increment;  ///< 1
  Real plastic_work;              ///< J/m3 of current volume
};

/// Radial return of a trial deviator: finds the plastic strain increment d >= 0 with
/// q_trial - 3 G d = flow_stress(strain + d, d/dt, T). The left side falls and the right side rises with d,
/// so the root is unique and lies in [0, q_trial/(3G)]; it is found by bisection-guarded secant steps, to
/// 1e-9 of q_trial. Explicit in the temperature, which changes by far less than the yield stress in one step.
/// NaN where stress, strain or temperature is: steel of unknown strength is not elastic.
template <class Real>
[[gnu::noinline]]  // rare beside the elastic step, which stays small without it
JohnsonCookReturn<Real>
johnson_cook_return(const JohnsonCookParameters& k, math::Deviator<Real> trial, Real plastic_strain,
                    Real temperature, Real dt) {
  using math::any;
  using math::max;
  using math::min;
  using math::select;
  const Real three_g = Real(3.0 * k.shear_modulus);
  const Real q = math::von_mises(trial);
  const auto excess = [&](Real d) {
    return q - three_g * d - johnson_cook_flow_stress(k, plastic_strain + d, d / dt, temperature);
  };
  Real low(0.0), high = q / three_g;
  Real f_low = excess(low);
  const auto yields = f_low > Real(0.0);
  const auto known = (f_low > Real(0.0)) | (f_low <= Real(0.0));  // false where anything is not a number
  if (!any(yields | !known)) return {trial, Real(0.0), Real(0.0)};
  Real f_high = excess(high);
  Real d(0.0);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const Real close_enough = Real(1e-9) * q;
    const auto open =
        yields & ((high - low) > Real(1e-10) * high) & (f_low > close_enough) & (-f_high > close_enough);
    if (!any(open)) break;
    // Secant inside the bracket, every third time a bisection so that the bracket always shrinks.
    const Real secant = low + (high - low) * f_low / (f_low - f_high);
    d = iteration % 3 == 2 ? Real(0.5) * (low + high) : secant;
    const Real f = excess(d);
    const auto still_yields = f > Real(0.0);
    low = select(open & still_yields, d, low);
    f_low = select(open & still_yields, f, f_low);
    high = select(open & !still_yields, d, high);
    f_high = select(open & !still_yields, f, f_high);
  }
  const Real increment =
      select(yields, low + (high - low) * f_low / max(f_low - f_high, Real(1e-300)), Real(0.0));
  // Of molten steel nothing remains, and round-off must not leave less than nothing.
  const Real remaining = max(q - three_g * increment, Real(0.0));
  const Real scale = select(yields, remaining / max(q, Real(1e-300)), Real(1.0));
  const Real unknown(std::numeric_limits<double>::quiet_NaN());
  return {select(known, scale, unknown) * trial, select(known, increment, unknown),
          select(known, increment * remaining, unknown)};
}

// --- the law ---

struct Steel {
  MieGruneisenParameters eos;
  JohnsonCookParameters strength;

  static constexpr std::string_view name = "steel";
  static constexpr bool heats_itself = true;
  static constexpr bool is_explosive = false;
  static constexpr bool always_written = true;
  enum Field : std::size_t { stress_rr, stress_xx, stress_rx, energy, plastic_strain, flow_stress };
  static constexpr std::array<StateField, 6> state{{{"deviator_rr", "Pa"},
                                                    {"deviator_xx", "Pa"},
                                                    {"deviator_rx", "Pa"},
                                                    {"energy", "J/kg"},
                                                    {"plastic_strain", "1", "equivalent plastic strain"},
                                                    {"flow_stress", "Pa"}}};

  double initial_density() const { return eos.density; }
  double shear_modulus() const { return strength.shear_modulus; }
  double hourglass_modulus() const { return strength.shear_modulus; }
  double bulk_modulus() const { return eos.density * eos.sound_speed * eos.sound_speed; }
  double heat_capacity() const { return strength.specific_heat; }
  double heat_conductivity() const { return strength.conductivity; }

  /// Free of stress at a temperature (K).
  State<Steel, double> initial_state(double temperature) const {
    State<Steel, double> start{};
    start[flow_stress] = quasi_static_flow_stress(0.0, temperature);
    return start;
  }

  /// Flow stress (Pa) at or below the reference rate: below it nothing yields.
  template <class Real>
  Real quasi_static_flow_stress(Real strain, Real temperature) const {
    return johnson_cook_flow_stress(strength, strain, Real(0.0), temperature);
  }

  /// What a particle keeps of its temperature, after something else than the law has changed that.
  template <class Real>
  void set_temperature(State<Steel, Real>& s, Real temperature) const {
    s[flow_stress] = quasi_static_flow_stress(s[plastic_strain], temperature);
  }

  template <class Real>
  static math::Deviator<Real> deviator(const State<Steel, Real>& s) {
    return {s[stress_rr], s[stress_xx], s[stress_rx]};
  }

  static std::vector<keys::Key<Steel>> parameters();  ///< keys of scene files

  class Integrator;
};

class Steel::Integrator {
 public:
  explicit Integrator(const Steel& steel) : steel_(steel) {}
  void set_step(double dt) { dt_ = dt; }

  /// Advances state, pressure (Pa) and temperature (K) of a particle by one step.
  template <class Real>
  Response<Real> update(const Increment<Real>& increment, State<Steel, Real>& s, Real pressure,
                        Real& temperature) const {
    using math::any;
    using math::select;
    Response<Real> response;
    const math::Deviator<Real> old = math::rotate(deviator(s), increment.rotation);
    math::Deviator<Real> stress = old + Real(2.0 * steel_.strength.shear_modulus) * increment.deviator;
    Real heat(0.0);  // J/kg
    // 3/2 S:S <= Y^2, without the root; false where anything is not a number.
    const auto elastic = Real(1.5) * contract(stress, stress) <= s[flow_stress] * s[flow_stress];
    if (any(!elastic)) {
      const auto flow =
          johnson_cook_return(steel_.strength, stress, s[plastic_strain], temperature, Real(dt_));
      stress = flow.stress;
      heat = Real(steel_.strength.taylor_quinney) * Real(1.0 / steel_.eos.density) * flow.plastic_work *
             increment.volume_after;
      s[plastic_strain] = s[plastic_strain] + flow.plastic_strain_increment;
      temperature = temperature + heat * Real(1.0 / steel_.strength.specific_heat);
      // Of elastic lanes it stays to the bit, whatever their neighbours do.
      s[flow_stress] =
          select(elastic, s[flow_stress], steel_.quasi_static_flow_stress(s[plastic_strain], temperature));
      response.plastic = flow.plastic_work;
    }
    const Real mu0 = compression(increment.volume_before), mu1 = compression(increment.volume_after);
    const auto compressed = mie_gruneisen_compress(steel_.eos, mu0, pressure, s[energy], mu1, heat);
    response.pressure_guard = select(mie_gruneisen_is_valid(steel_.eos, mu1), Real(0.0), Real(1.0));
    s[energy] = compressed.energy;
    s[stress_rr] = stress.rr;
    s[stress_xx] = stress.xx;
    s[stress_rx] = stress.rx;
    response.deviator_before = old;
    response.deviator = stress;
    response.pressure = compressed.pressure;
    return response;
  }

  /// Isentropic bulk modulus (Pa).
  template <class Real>
  Real bulk_modulus(const State<Steel, Real>&, Real volume, Real pressure) const {
    return mie_gruneisen_bulk_modulus(steel_.eos, compression(volume), pressure);
  }

 private:
  /// mu = rho/rho0 - 1 = 1/V - 1, from the difference so that rest is exact.
  template <class Real>
  static Real compression(Real volume) {
    return (Real(1.0) - volume) / volume;
  }

  Steel steel_;
  double dt_ = 0;
};

}  // namespace launchsafe::materials
