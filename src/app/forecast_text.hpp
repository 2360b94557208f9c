// What a study will run and what that will cost, for people and programs.
#pragma once

#include "launchsafe/study/forecast.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>

namespace launchsafe::app {

/// Totals, then a row for every mechanical run. `folder` holds the store that the rate was learned from, if
/// any.
std::string forecast_text(const study::StudyFile& file, const study::Forecast& forecast,
                          const std::filesystem::path& folder);
nlohmann::ordered_json forecast_json(const study::StudyFile& file, const study::Forecast& forecast);

}  // namespace launchsafe::app
