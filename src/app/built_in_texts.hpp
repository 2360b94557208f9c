// Files that launchsafe init writes, as they are in the source. Names in double braces stand for values.
#pragma once

namespace launchsafe::app {

extern const char* const scene_template;
extern const char* const study_template;
/// The record of reports/calibrate_table8.
extern const char* const shipped_calibration;

}  // namespace launchsafe::app
