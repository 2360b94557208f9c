// One row of particles of a charge some of which burn.
#pragma once

#include "launchsafe/mpm/body.hpp"
#include "launchsafe/mpm/nodes.hpp"
#include "launchsafe/mpm/step.hpp"

namespace launchsafe::mpm {

struct RowStep;

/// `advance_row` of a body with `ParticleFields::burning`.
void advance_burning_row(Body<materials::Charge>& body, Nodes& nodes, const RowStep& step,
                         ParticleTotals& totals);

}  // namespace launchsafe::mpm
