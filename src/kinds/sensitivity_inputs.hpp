// [[input]] of a sensitivity study: keys that are not known exactly, and their distributions.
#pragma once

#include "launchsafe/kinds/kind.hpp"

namespace launchsafe::kinds {

/// Its keys, for documentation.
StudyTable input_table();

/// Reads [[input]] into Study::axes, each with its distribution. Needs the study's scene and overrides.
study::Fault read_inputs(const StudySource& source, study::StudyFile& study);

}  // namespace launchsafe::kinds
