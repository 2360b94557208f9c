// What a person is told of values that are not plausible, before any verdict rests on them.
#pragma once

#include "launchsafe/scene/plausibility.hpp"
#include "launchsafe/study/read_study.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace launchsafe::app {

/// One sentence for every value that is not plausible, and for every acceptance that accepts nothing.
std::vector<std::string> plausibility_lines(const scene::Scene& scene);
/// The same for the cases of a study and what it states itself, each with the number of cases. Empty for kind
/// stability, which judges without.
std::vector<std::string> plausibility_lines(const study::StudyFile& study);

/// Key, value, plausible range and acceptance (or null) of every value that is not plausible.
nlohmann::ordered_json plausibility_json(const scene::Scene& scene);

}  // namespace launchsafe::app
