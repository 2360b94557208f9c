// Steps of Visco-SCRAM from states by all elements, as exact solutions have them.
#pragma once

#include "launchsafe/materials/visco_scram.hpp"

namespace launchsafe::test_support {

using materials::maxwell_elements, materials::ViscoScram, materials::ViscoScramParameters;

template <class Real>
struct ElementsState {
  std::array<math::Deviator<Real>, maxwell_elements> elements;  ///< S_n, Pa
  Real crack_radius;                                            ///< c, m
};

template <class Real>
math::Deviator<Real> total_deviator(const ElementsState<Real>& state) {
  auto total = state.elements[0];
  for (std::size_t n = 1; n < maxwell_elements; ++n) total = total + state.elements[n];
  return total;
}

template <class Real>
ElementsState<Real> elements_of(const ViscoScram::State<Real>& state) {
  ElementsState<Real> result{{deviator_of(state.first_element())}, state.crack_radius};
  for (std::size_t n = 1; n < maxwell_elements; ++n) result.elements[n] = deviator_of(state.elements[n - 1]);
  return result;
}

template <class Real>
ViscoScram::State<Real> state_of(const ElementsState<Real>& elements) {
  ViscoScram::State<Real> result{vector_of(total_deviator(elements)), {}, elements.crack_radius};
  for (std::size_t n = 1; n < maxwell_elements; ++n) result.elements[n - 1] = vector_of(elements.elements[n]);
  return result;
}

/// Energies that a step dissipated, J/m3.
struct Dissipation {
  double viscous, crack;
};

/// A step by a deviatoric strain increment under a pressure (Pa).
inline Dissipation charge_update(const ViscoScram& law, ElementsState<double>& state,
                                 math::Deviator<double> de, double pressure) {
  const auto end = law.update<double>(state_of(state), vector_of(de), pressure);
  state = elements_of(end.state);
  return {end.viscous, end.crack};
}

inline ViscoScram step_of(const ViscoScramParameters& m, double dt) {
  ViscoScram law(m);
  law.set_step(dt);
  return law;
}

/// Growth speed (m/s) of cracks of 30 um under a stress intensity (Pa m^0.5) and a pressure (Pa).
inline double growth_speed(const ViscoScramParameters& m, double intensity, double pressure = 0.0) {
  constexpr double radius = 30e-6, pi = 3.14159265358979323846;
  return ViscoScram(m).growth_speed(radius, {0.0, 0.0, intensity / std::sqrt(1.5 * pi * radius)}, pressure);
}

}  // namespace launchsafe::test_support
