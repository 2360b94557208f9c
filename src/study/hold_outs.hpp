// What calibrated constants predict for the rows that nothing was fitted to.
#pragma once

#include "launchsafe/study/calibration.hpp"

namespace launchsafe::study::detail {

/// Fills the hold-outs, the placements and the root mean squares of a row.
void predict(const Study& study, const surface::SkinModel& model, const trace::BottomTrace& trace,
             CalibrationRow& row);

}  // namespace launchsafe::study::detail
