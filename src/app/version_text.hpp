#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace launchsafe::app {

/// Version, commit, compiler, flags and libraries, as `launchsafe --version` prints them.
std::string version_text();
/// The same for --json.
nlohmann::ordered_json version_json();

}  // namespace launchsafe::app
