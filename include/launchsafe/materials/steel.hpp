// Steel: Mie-Grueneisen pressure, Johnson-Cook strength, heated by its plastic work.
#pragma once

#include "launchsafe/materials/johnson_cook.hpp"
#include "launchsafe/materials/law.hpp"
#include "launchsafe/materials/mie_gruneisen.hpp"

namespace launchsafe::materials {

struct Steel {
  MieGruneisenParameters eos;
  JohnsonCookParameters strength;
  double thermal_expansion = 11.7e-6;  ///< 1/K, of a length [A]

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
