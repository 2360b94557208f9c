// What a study will run and what that will cost, for people and programs; and how fast this machine is.
#pragma once

#include "console.hpp"
#include "launchsafe/scene/scene.hpp"
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

/// Particle updates per second that this program does on this machine with this scene, from the first third
/// of a second of its run, on a coarser mesh where its own has very many particles; nothing when the user
/// stops it, which is said.
std::optional<double> measured_update_rate(const scene::Scene& scene, Console& console);

}  // namespace launchsafe::app
