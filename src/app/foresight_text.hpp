// What a study will run and what that will cost, for people and programs.
#pragma once

#include "launchsafe/study/foresight.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace launchsafe::app {

/// Totals, then a row for every mechanical run. `folder` holds the store that the rate was learned from, if
/// any.
std::string foresight_text(const study::StudyFile& file, const study::Foresight& foresight,
                           const std::filesystem::path& folder);
nlohmann::ordered_json foresight_json(const study::StudyFile& file, const study::Foresight& foresight);

/// A line for every mechanical run that says why it runs or is used again; where there are many, a line for
/// all that have the same reason.
std::vector<std::string> reason_lines(const study::Foresight& foresight);

}  // namespace launchsafe::app
