// A plain linear-elastic solid: for checks against closed forms, and the shortest example of a law.
#pragma once

#include "launchsafe/materials/law.hpp"

namespace launchsafe::materials {

struct LinearElastic {
  double density = 7830.0;       ///< kg/m3
  double bulk = 166.4e9;         ///< K, Pa
  double shear = 80e9;           ///< G, Pa
  double specific_heat = 460.0;  ///< J/(kg K)
  double conductivity = 38.0;    ///< W/(m K)

  static constexpr std::string_view name = "elastic";
  static constexpr bool heats_itself = false;
  static constexpr bool is_explosive = false;
  static constexpr bool always_written = false;
  enum Field : std::size_t { stress_rr, stress_xx, stress_rx };
  static constexpr std::array<StateField, 3> state{
      {{"deviator_rr", "Pa"}, {"deviator_xx", "Pa"}, {"deviator_rx", "Pa"}}};

  double initial_density() const { return density; }
  double shear_modulus() const { return shear; }
  double hourglass_modulus() const { return shear; }
  double bulk_modulus() const { return bulk; }
  double heat_capacity() const { return specific_heat; }
  double heat_conductivity() const { return conductivity; }
  State<LinearElastic, double> initial_state(double) const { return {}; }
  template <class Real>
  void set_temperature(State<LinearElastic, Real>&, Real) const {}
  template <class Real>
  static math::Deviator<Real> deviator(const State<LinearElastic, Real>& s) {
    return {s[stress_rr], s[stress_xx], s[stress_rx]};
  }

  static std::vector<keys::Key<LinearElastic>> parameters();  ///< keys of scene files

  class Integrator;
};

/// S += 2 G e (Jaumann), p = K (rho/rho0 - 1).
class LinearElastic::Integrator {
 public:
  explicit Integrator(const LinearElastic& law) : law_(law) {}
  void set_step(double) {}

  template <class Real>
  Response<Real> update(const Increment<Real>& increment, State<LinearElastic, Real>& s, Real, Real&) const {
    Response<Real> response;
    response.deviator_before = math::rotate(deviator(s), increment.rotation);
    response.deviator = response.deviator_before + Real(2.0 * law_.shear) * increment.deviator;
    response.pressure = Real(law_.bulk) * ((Real(1.0) - increment.volume_after) / increment.volume_after);
    s = {response.deviator.rr, response.deviator.xx, response.deviator.rx};
    return response;
  }

  template <class Real>
  Real bulk_modulus(const State<LinearElastic, Real>&, Real volume, Real) const {
    return Real(law_.bulk) / volume;
  }

 private:
  LinearElastic law_;
};

inline std::vector<keys::Key<LinearElastic>> LinearElastic::parameters() {
  using keys::above_to, keys::between, keys::Dimension;
  const auto number = [](const char* key, Dimension dimension, keys::Limits limits, const char* sentence,
                         auto member, keys::ActsOn acts_on = keys::ActsOn::mechanics) {
    return keys::number_key(key, dimension, limits, keys::Standing::assumed, sentence, member) |
           keys::acting_on(acts_on);
  };
  return keys::keys_of_part<LinearElastic>(
      "elastic.", std::identity{},
      {
          number("density", Dimension::density, between(500, 25e3), "Density before launch.",
                 &LinearElastic::density),
          number("bulk_modulus", Dimension::pressure, above_to(0, 1e12), "Bulk modulus K.",
                 &LinearElastic::bulk),
          number("shear_modulus", Dimension::pressure, above_to(0, 1e12), "Shear modulus G.",
                 &LinearElastic::shear),
          number("specific_heat", Dimension::specific_heat, between(50, 1e4), "Specific heat.",
                 &LinearElastic::specific_heat, keys::ActsOn::heat),
          number("conductivity", Dimension::conductivity, between(0, 1e4), "Thermal conductivity.",
                 &LinearElastic::conductivity, keys::ActsOn::conduction),
      });
}

}  // namespace launchsafe::materials
