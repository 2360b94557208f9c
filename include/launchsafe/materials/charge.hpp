// The explosive charge: pressure on the isentrope of its equation of state, Visco-SCRAM deviator with growing
// cracks, and the heat of their sliding.
#pragma once

#include "launchsafe/materials/jwl.hpp"
#include "launchsafe/materials/kinetics.hpp"
#include "launchsafe/materials/law.hpp"
#include "launchsafe/materials/visco_scram.hpp"

namespace launchsafe::materials {

struct Charge {
  ViscoScramParameters strength;
  double density = 1717.0;  ///< kg/m3, before launch [P]
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
  /// The deviator S, then those of the Maxwell elements but the first, which is what they leave of S; all by
  /// orthonormal components (math::DeviatorVector).
  enum Field : std::size_t { stress = 0, second_element = 3, crack_radius = 3 * maxwell_elements, fields };
  static constexpr std::array<StateField, fields> state{
      {{"deviator_hoop", "Pa"},
       {"deviator_difference", "Pa"},
       {"deviator_shear", "Pa"},
       {"element_2_hoop", "Pa"},
       {"element_2_difference", "Pa"},
       {"element_2_shear", "Pa"},
       {"element_3_hoop", "Pa"},
       {"element_3_difference", "Pa"},
       {"element_3_shear", "Pa"},
       {"element_4_hoop", "Pa"},
       {"element_4_difference", "Pa"},
       {"element_4_shear", "Pa"},
       {"element_5_hoop", "Pa"},
       {"element_5_difference", "Pa"},
       {"element_5_shear", "Pa"},
       {"crack_radius", "m", "crack radius", keys::micrometre, true}}};

  double initial_density() const { return density; }
  double shear_modulus() const { return strength.shear_modulus(); }
  /// A soft body takes on what hourglassing a stiff neighbour has left, without stress; where it resists
  /// that, the pattern turns into pressure. A tenth of the shear modulus, in both, lets the pressure at the
  /// bottom of the 155 mm shell alternate by 0.17 %, a tenth in steel and a fiftieth here by 0.09 %, none
  /// here by 0.05 %, on cells of 2.5 mm under 50 MPa; G1 changes by 0.4 K, other points by 0.04 K.
  double hourglass_modulus() const { return 0.2 * shear_modulus(); }
  double bulk_modulus() const { return jwl_bulk_modulus_at_rest(eos); }
  double heat_capacity() const { return specific_heat; }
  double heat_conductivity() const { return conductivity; }

  State<Charge, double> initial_state(double) const {
    State<Charge, double> start{};
    start[crack_radius] = strength.initial_crack_radius;
    return start;
  }

  /// The law does not depend on the temperature.
  template <class Real>
  void set_temperature(State<Charge, Real>&, Real) const {}

  template <class Real>
  static math::Deviator<Real> deviator(const State<Charge, Real>& s) {
    return deviator_of(math::DeviatorVector<Real>{s[stress], s[stress + 1], s[stress + 2]});
  }

  static std::vector<keys::Key<Charge>> parameters();  ///< keys of scene files

  class Integrator;
};

class Charge::Integrator {
 public:
  explicit Integrator(const Charge& charge)
      : charge_(charge), isentrope_(charge.eos), solid_(charge.strength) {}
  void set_step(double dt) {
    if (dt < dt_ || dt > dt_) solid_.set_step(dt);
    dt_ = dt;
  }

  /// Advances state and pressure (Pa) of a particle by one step. The temperature is the bulk's own matter.
  template <class Real>
  Response<Real> update(const Increment<Real>& increment, State<Charge, Real>& s, Real, Real&) const {
    using math::max;
    using math::select;
    Response<Real> response;
    const Real isentropic = isentrope_.pressure(increment.volume_after - Real(1.0));
    const Real cutoff(-charge_.tension_cutoff);
    response.tension_cutoff = select(isentropic < cutoff, Real(1.0), Real(0.0));
    response.pressure = max(isentropic, cutoff);

    const ViscoScram::State<Real> turned = solid_state(s, twice(increment.rotation));
    const auto end = solid_.update(turned, vector_of(increment.deviator), response.pressure);
    keep(s, end.state);
    response.deviator_before = deviator_of(turned.total);
    response.deviator = deviator_of(end.state.total);
    response.viscous = end.viscous;
    response.crack = end.crack;
    response.crack_at_bound =
        select(end.state.crack_radius >= Real(charge_.strength.largest_crack_radius), Real(1.0), Real(0.0));
    return response;
  }

  /// Isentropic bulk modulus (Pa); 0 where the isentrope softens, far beyond the tension cut-off.
  template <class Real>
  Real bulk_modulus(const State<Charge, Real>&, Real volume, Real) const {
    using math::max;
    return max(jwl_isentropic_bulk_modulus(charge_.eos, volume), Real(0.0));
  }

 private:
  /// What Visco-SCRAM needs of a particle's state, turned; `q` is twice the step's rotation.
  template <class Real>
  static ViscoScram::State<Real> solid_state(const State<Charge, Real>& s, math::Rotation<Real> q) {
    const auto turned = [&](std::size_t field) {
      return rotate_by_twice(math::DeviatorVector<Real>{s[field], s[field + 1], s[field + 2]}, q);
    };
    ViscoScram::State<Real> result;
    result.total = turned(stress);
    for (std::size_t n = 0; n < result.elements.size(); ++n)
      result.elements[n] = turned(second_element + 3 * n);
    result.crack_radius = s[crack_radius];
    return result;
  }
  template <class Real>
  static void keep(State<Charge, Real>& s, const ViscoScram::State<Real>& solid) {
    const auto put = [&](std::size_t field, const math::DeviatorVector<Real>& value) {
      s[field] = value.hoop;
      s[field + 1] = value.difference;
      s[field + 2] = value.shear;
    };
    put(stress, solid.total);
    for (std::size_t n = 0; n < solid.elements.size(); ++n) put(second_element + 3 * n, solid.elements[n]);
    s[crack_radius] = solid.crack_radius;
  }

  Charge charge_;
  JwlIsentrope isentrope_;
  ViscoScram solid_;
  double dt_ = 0;
};

}  // namespace launchsafe::materials
