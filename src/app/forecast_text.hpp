// What a study will run and what that will cost, for people and programs.
#pragma once

#include "launchsafe/study/forecast.hpp"

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace launchsafe::app {

/// Totals, then a row for every mechanical run. `folder` holds the store that the rate was learned from, if
/// any.
std::string forecast_text(const study::StudyFile& file, const study::Forecast& forecast,
                          const std::filesystem::path& folder);
nlohmann::ordered_json forecast_json(const study::StudyFile& file, const study::Forecast& forecast);

/// A line for every mechanical run that says why it runs or is used again; where there are many, a line for
/// all that have the same reason.
std::vector<std::string> reason_lines(const study::Forecast& forecast);

}  // namespace launchsafe::app
