// Temperatures in the bulk of the charge, and grid conduction: what the mechanics does not need at every
// step.
#pragma once

#include "launchsafe/mpm/conduction.hpp"
#include "launchsafe/mpm/simulation.hpp"

#include <optional>
#include <vector>

namespace launchsafe::run {

/// Advances the particle temperatures from one trace sample to the next, with the terms that the scene's plan
/// keeps. The bulk takes friction heat with factor 1; localised heat belongs to the sliding layers (model
/// section 5).
class BulkHeat {
 public:
  explicit BulkHeat(mpm::Simulation& simulation);
  /// Takes over what another one of the same mechanics has seen so far.
  void continue_from(const BulkHeat& other) {
    friction_ = other.friction_;
    time_ = other.time_;
  }
  /// Takes in the friction of the step that has just been done.
  void accumulate(const mpm::Simulation& simulation);
  void advance_to(mpm::Simulation& simulation, double time);

 private:
  using Charge = mpm::Body<materials::Charge>;
  void add_friction(Charge& charge, math::AlignedArray& energy) const;
  void react(Charge& charge, double dt) const;

  scene::Charge charge_;
  std::size_t closure_;
  bool reaction_;
  std::optional<mpm::Conduction> conduction_;  ///< only where the plan keeps it
  /// J/m3 since the last advance, by charge body; empty where the charge's temperatures are not needed.
  std::vector<math::AlignedArray> friction_;
  double time_ = 0;
};

}  // namespace launchsafe::run
