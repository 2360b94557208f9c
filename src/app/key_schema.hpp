// JSON schemas (draft 4) of scene and study files, from the keys that read them. Language servers of TOML
// complete and check files by these.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace launchsafe::app {

/// Of a scene file. What a schema cannot say, such as the range of a quantity with its unit, is in the
/// descriptions, and in "unit", "range" and "example" beside every key.
nlohmann::ordered_json scene_schema();
/// Of a study file of any kind.
nlohmann::ordered_json study_schema();
/// Of a file of what is published, which studies name by `references`.
nlohmann::ordered_json references_schema();

}  // namespace launchsafe::app
