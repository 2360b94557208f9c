// Interface of a constitutive law to the mechanics: it advances declared state.
//
// A law is a plain struct of parameters with
//   static constexpr std::string_view name           the word that bodies refer to it by
//   static constexpr std::array<StateField, N> state what a particle of it carries, in this order
//   initial_density(), shear_modulus(), bulk_modulus(), heat_capacity(), heat_conductivity()   at rest, SI
//   hourglass_modulus()                              Pa; numerics.hourglass_stiffness is a share of it
//   initial_state(temperature)                       std::array<double, N>
//   static constexpr bool heats_itself               whether update changes the temperature
//   static constexpr bool is_explosive               whether a body of it is a charge, which may ignite
//   static constexpr bool always_written             whether a stored scene without it has its keys
//                                                    (false for a new law: what is stored already has not)
//   static std::vector<keys::Key<Law>> parameters()  its keys in scene files
//   Integrator                                       made of the law; set_step(dt), dt > 0 in s, then
//                                                    update(increment, state, pressure, temperature)
// where update advances the state of a particle, and its temperature (K) if the law heats itself, from the
// pressure (Pa) before the step, and gives the Response;
// and the functions on a particle's state that outputs ask for: deviator(state) and, for the time step,
// Integrator::bulk_modulus(state, volume, pressure), volume over that at rest. Everything else of a law is
// its own.
#pragma once

#include "launchsafe/keys/quantity.hpp"
#include "launchsafe/math/deviator.hpp"

#include <array>

namespace launchsafe::materials {

/// One number that a particle of a law carries, by name and SI unit ("1" for none). One with a meaning is
/// shown: snapshots hold it, and with them case files, XDMF and the tables of `plot --csv`.
struct StateField {
  std::string_view name;
  std::string_view unit;
  std::string_view meaning = {};  ///< as people read it; of what is drawn a few words
  keys::Unit shown = {};          ///< to people; pure numbers have none
  bool drawn = false;             ///< in a picture of its own
};

template <class Law, class Real>
using State = std::array<Real, Law::state.size()>;

/// Index of a state field by name; the number of fields where the law has none of that name.
template <class Law>
constexpr std::size_t field_index(std::string_view name) {
  std::size_t index = 0;
  while (index < Law::state.size() && Law::state[index].name != name) ++index;
  return index;
}

template <class Law>
constexpr bool has_field(std::string_view name) {
  return field_index<Law>(name) < Law::state.size();
}

/// The state that `load(field index)` gives, or what `store(field index, value)` takes. Written out field by
/// field: compilers do not unroll a loop over more than sixteen and then keep the state in memory.
template <class Law, class Load>
auto load_state(Load&& load) {
  return [&]<std::size_t... field>(std::index_sequence<field...>) {
    return State<Law, decltype(load(std::size_t{}))>{load(field)...};
  }
  (std::make_index_sequence<Law::state.size()>{});
}
template <class Law, class Real, class Store>
void store_state(const State<Law, Real>& state, Store&& store) {
  [&]<std::size_t... field>(std::index_sequence<field...>) { (store(field, state[field]), ...); }
  (std::make_index_sequence<Law::state.size()>{});
}

/// Deformation increment of one step.
template <class Real>
struct Increment {
  math::Deviator<Real> deviator;  ///< of the strain increment, at the middle of the step
  math::Rotation<Real> rotation;  ///< of the step (Jaumann)
  Real volume_before;             ///< V, the volume over that at rest
  Real volume_after;              ///< V
};

/// Stress at the end of a step, and what the step did. Energies in J per m3 of volume at the step's begin.
template <class Real>
struct Response {
  math::Deviator<Real> deviator_before;  ///< at the begin, turned with the step's rotation, Pa
  math::Deviator<Real> deviator;         ///< Pa
  Real pressure;                         ///< Pa, compression positive
  Real plastic{0.0}, viscous{0.0}, crack{0.0};
  /// 1 where a limiter acted, 0 elsewhere.
  Real tension_cutoff{0.0}, pressure_guard{0.0}, crack_at_bound{0.0};
};

}  // namespace launchsafe::materials
