// What a study will run and what that will cost, for people and programs.
#pragma once

#include "launchsafe/study/forecast.hpp"

#include <nlohmann/json_fwd.hpp>

#include <ctime>
#include <filesystem>
#include <optional>
#include <string>

namespace launchsafe::app {

/// Totals, then a row for each of the first mechanical runs. `folder` holds the store that the rate was
/// learned from, if any. `begin`: when the study begins, whose end is told then.
std::string forecast_text(const study::StudyFile& file, const study::Forecast& forecast,
                          const std::filesystem::path& folder, std::optional<std::time_t> begin = {});
nlohmann::ordered_json forecast_json(const study::StudyFile& file, const study::Forecast& forecast);

}  // namespace launchsafe::app
