#pragma once

#include "launchsafe/surface/skin.hpp"

namespace launchsafe::surface {

/// A model with round constants of its own, so that tests do not move when the calibrated defaults do.
inline SkinModel plain_model() {
  SkinModel model;
  model.surface.localisation = 300.0;
  model.surface.exchange_time = 3.6e-4;
  model.kinetics.ignition_temperature = 525.0;
  return model;
}

}  // namespace launchsafe::surface
