// The laws that there are. A new one is its own file, and its name in the list here: scenes, plan, mechanics,
// store and reports take them from it. The order is that of keys in scenes.
#pragma once

#include "launchsafe/materials/charge.hpp"
#include "launchsafe/materials/linear_elastic.hpp"
#include "launchsafe/materials/steel.hpp"

#include <boost/mp11/algorithm.hpp>

namespace launchsafe::materials {

using Law = std::variant<Steel, Charge, LinearElastic>;

/// Properties at rest of whatever law it is (SI).
inline double initial_density(const Law& law) {
  return std::visit([](const auto& each) { return each.initial_density(); }, law);
}
inline double bulk_modulus(const Law& law) {
  return std::visit([](const auto& each) { return each.bulk_modulus(); }, law);
}
inline double shear_modulus(const Law& law) {
  return std::visit([](const auto& each) { return each.shear_modulus(); }, law);
}
inline double heat_capacity(const Law& law) {
  return std::visit([](const auto& each) { return each.heat_capacity(); }, law);
}
inline double heat_conductivity(const Law& law) {
  return std::visit([](const auto& each) { return each.heat_conductivity(); }, law);
}
inline bool is_explosive(const Law& law) {
  return std::visit([](const auto& each) { return each.is_explosive; }, law);
}
/// Numbers that a particle of it carries.
inline std::size_t state_size(const Law& law) {
  return std::visit([](const auto& each) { return each.state.size(); }, law);
}

/// Calls f with a default of every law there is, in their order.
template <class F>
void for_each_law(F&& f) {
  boost::mp11::mp_for_each<Law>(f);
}

/// Whether a particle of the law carries a number of that name.
inline bool has_field(const Law& law, std::string_view name) {
  return std::visit([&]<class Each>(const Each&) { return has_field<Each>(name); }, law);
}

}  // namespace launchsafe::materials
