// What is plausible of the keys of a scene, each with its argument, on one page. Those of materials stand
// beside their law.
#pragma once

#include "launchsafe/scene/toml_reader.hpp"

#include <string_view>

namespace launchsafe::scene {

/// What is plausible of a key by its dotted name, those of a body as "body.x"; nothing said for an unknown
/// one.
Plausible plausible_values_of(std::string_view key);

}  // namespace launchsafe::scene
