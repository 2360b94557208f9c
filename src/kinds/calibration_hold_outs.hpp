// What calibrated constants predict for the rows that nothing was fitted to.
#pragma once

#include "launchsafe/kinds/calibration.hpp"

namespace launchsafe::kinds {

/// Fills the hold-outs, the placements and the root mean squares of a row.
void predict(const study::Study& study, const surface::SkinModel& model, const trace::BottomTrace& trace,
             CalibrationRow& row);

}  // namespace launchsafe::kinds
