// Parts of a computation, by which keys state how far another value of an input reaches.
#pragma once

namespace launchsafe::keys {

/// The part of a computation that another value of an input changes. A launch without bulk reaction,
/// conduction, or stored temperatures (scene::mechanical_part) has mechanics that depend on fewer inputs.
enum class ActsOn {
  mechanics,   ///< the mechanical run
  numerics,    ///< likewise, by its error alone
  trace,       ///< the skin, and what the mechanical run traces for it
  heat,        ///< the skin, and the mechanical run where temperatures of the charge matter to it
  conduction,  ///< likewise, where heat is conducted
  chemistry,   ///< likewise, where the bulk reacts
  surface,     ///< the skin
  combustion,  ///< what follows ignition
  nothing      ///< no number that is computed
};
/// Whether a mechanical run may depend on an input, in some launch.
constexpr bool reaches_mechanics(ActsOn acts_on) { return acts_on < ActsOn::surface; }

}  // namespace launchsafe::keys
