// The pressure of the explosive before it reacts. A new equation of state is its own file with what
// UnreactedJwl has, and its name in the list here: the charge, its keys and its burning take it from there.
#pragma once

#include "launchsafe/materials/jwl.hpp"

#include <boost/mp11/algorithm.hpp>

namespace launchsafe::materials {

using UnreactedEos = std::variant<UnreactedJwl>;

template <class Eos>
using IsentropeOf = typename Eos::Isentrope;
/// Its pressure (Pa) at V = 1 + x, as a step computes it.
using UnreactedIsentrope = boost::mp11::mp_transform<IsentropeOf, UnreactedEos>;

inline UnreactedIsentrope isentrope_of(const UnreactedEos& eos) {
  return std::visit([](const auto& each) -> UnreactedIsentrope { return each.isentrope(); }, eos);
}

}  // namespace launchsafe::materials
