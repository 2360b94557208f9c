// The explosive charge: JWL pressure on its isentrope, Visco-SCRAM deviator with growing cracks, and the heat
// of their sliding.
#pragma once

#include "launchsafe/materials/jwl_isentrope.hpp"
#include "launchsafe/materials/kinetics.hpp"
#include "launchsafe/materials/law.hpp"
#include "launchsafe/materials/visco_scram.hpp"

namespace launchsafe::materials {

struct Charge {
  ViscoScramParameters cracks;
  JwlParameters eos = unreacted_composition_b();
  double tension_cutoff = 5e6;     ///< Pa, > 0: the pressure never falls below -cutoff
  double specific_heat = 1780.0;   ///< J/(kg K)
  double conductivity = 0.246;     ///< W/(m K)
  double sliding_friction = 0.24;  ///< mu_d
  KineticsParameters kinetics;

  static constexpr std::string_view name = "charge";
  static constexpr bool heats_itself = false;
  static constexpr bool is_explosive = true;
  static constexpr bool always_written = true;
  /// Maxwell elements S_n first, three components each; then friction heat since the start by closure, J per
  /// m3 of initial volume with localisation 1 (paper Eq. 39).
  enum Field : std::size_t {
    first_element = 0,
    crack_radius = 3 * maxwell_elements,
    friction_literal,
    friction_inelastic,
    fields
  };
  static constexpr std::array<StateField, fields> state{{{"element_1_rr", "Pa"},
                                                         {"element_1_xx", "Pa"},
                                                         {"element_1_rx", "Pa"},
                                                         {"element_2_rr", "Pa"},
                                                         {"element_2_xx", "Pa"},
                                                         {"element_2_rx", "Pa"},
                                                         {"element_3_rr", "Pa"},
                                                         {"element_3_xx", "Pa"},
                                                         {"element_3_rx", "Pa"},
                                                         {"element_4_rr", "Pa"},
                                                         {"element_4_xx", "Pa"},
                                                         {"element_4_rx", "Pa"},
                                                         {"element_5_rr", "Pa"},
                                                         {"element_5_xx", "Pa"},
                                                         {"element_5_rx", "Pa"},
                                                         {"crack_radius", "m"},
                                                         {"friction_literal", "J/m3"},
                                                         {"friction_inelastic", "J/m3"}}};

  double initial_density() const { return eos.initial_density; }
  double shear_modulus() const { return cracks.shear_modulus(); }
  double bulk_modulus() const { return jwl_bulk_modulus(eos, 1.0, eos.initial_energy); }
  double heat_capacity() const { return specific_heat; }
  double heat_conductivity() const { return conductivity; }

  State<Charge, double> initial_state(double) const {
    State<Charge, double> start{};
    start[crack_radius] = cracks.initial_crack_radius;
    return start;
  }

  /// The law does not depend on the temperature.
  template <class Real>
  void set_temperature(State<Charge, Real>&, Real) const {}

  template <class Real>
  static math::Deviator<Real> deviator(const State<Charge, Real>& s) {
    math::Deviator<Real> total{};
    for (std::size_t n = 0; n < maxwell_elements; ++n)
      total = total + math::Deviator<Real>{s[3 * n], s[3 * n + 1], s[3 * n + 2]};
    return total;
  }

  static std::vector<keys::Key<Charge>> parameters();  ///< keys of scene files

  class Integrator;
};

class Charge::Integrator {
 public:
  explicit Integrator(const Charge& charge) : charge_(charge), isentrope_(charge.eos) {}
  void set_step(double dt) {
    if (dt < relaxation_.dt || dt > relaxation_.dt) relaxation_ = relaxation(charge_.cracks, dt);
  }

  /// Advances state and pressure (Pa) of a particle by one step. The temperature is the bulk's own matter.
  template <class Real>
  Response<Real> update(const Increment<Real>& increment, State<Charge, Real>& s, Real, Real&) const {
    using math::max;
    using math::select;
    const double reference = charge_.eos.initial_density;
    Response<Real> response;
    const Real per_density = Real(1.0) / increment.density_after;
    // V - 1, from the difference of the densities so that rest is exact.
    const Real isentropic = isentrope_.pressure((Real(reference) - increment.density_after) * per_density);
    const Real cutoff(-charge_.tension_cutoff);
    response.tension_cutoff = select(isentropic < cutoff, Real(1.0), Real(0.0));
    response.pressure = max(isentropic, cutoff);

    ViscoScramState<Real> cracked;
    for (std::size_t n = 0; n < maxwell_elements; ++n)
      cracked.elements[n] =
          math::rotate(math::Deviator<Real>{s[3 * n], s[3 * n + 1], s[3 * n + 2]}, increment.rotation);
    cracked.crack_radius = s[crack_radius];
    response.deviator_before = total_deviator(cracked);
    const auto loss =
        visco_scram_update(charge_.cracks, relaxation_, cracked, increment.deviator, response.pressure);
    for (std::size_t n = 0; n < maxwell_elements; ++n) {
      s[3 * n] = cracked.elements[n].rr;
      s[3 * n + 1] = cracked.elements[n].xx;
      s[3 * n + 2] = cracked.elements[n].rx;
    }
    s[crack_radius] = cracked.crack_radius;
    response.deviator = total_deviator(cracked);
    response.viscous = loss.viscous;
    response.crack = loss.crack;
    response.crack_at_bound =
        select(cracked.crack_radius >= Real(charge_.cracks.largest_crack_radius), Real(1.0), Real(0.0));
    const Real sliding =
        Real(charge_.sliding_friction * reference) * max(response.pressure, Real(0.0)) * per_density;
    s[friction_literal] = s[friction_literal] + sliding * math::equivalent_strain(increment.deviator);
    s[friction_inelastic] = s[friction_inelastic] + sliding * loss.inelastic_strain;
    return response;
  }

  /// Isentropic bulk modulus (Pa).
  template <class Real>
  Real bulk_modulus(const State<Charge, Real>&, Real density, Real) const {
    return jwl_isentropic_bulk_modulus(charge_.eos, Real(charge_.eos.initial_density) / density);
  }

 private:
  Charge charge_;
  JwlIsentrope isentrope_;
  Relaxation<double> relaxation_{};
};

}  // namespace launchsafe::materials
