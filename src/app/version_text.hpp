#pragma once

#include <string>

namespace launchsafe::app {

/// Version, commit, compiler, flags and libraries, as `launchsafe --version` prints them.
std::string version_text();

}  // namespace launchsafe::app
