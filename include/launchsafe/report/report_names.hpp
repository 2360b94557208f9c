// The names that reports give their files.
#pragma once

#include "launchsafe/study/read_study.hpp"

#include <string_view>

namespace launchsafe::report {

/// Whether the report of a kind of study may write a file of this name.
bool may_write(study::StudyKind kind, std::string_view name);

/// Whether the report of any kind of study may.
bool may_write(std::string_view name);

}  // namespace launchsafe::report
