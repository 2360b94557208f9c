// Text and files that the reports of all studies share.
#pragma once

#include "launchsafe/report/report.hpp"
#include "launchsafe/run/case_result.hpp"
#include "launchsafe/store/result.hpp"
#include "launchsafe/study/options.hpp"
#include "launchsafe/study/study_file.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace launchsafe::report {

/// The study file as in a command that works anywhere: never an absolute path.
std::string study_file_name(const study::StudyFile& study);
/// The command that remakes a report.
std::string remaking_command(const study::StudyFile& study);
/// What was simulated, as Markdown list items: scene, overrides, what is varied, load, mesh, surface
/// constants.
std::string setup_text(const study::StudyFile& study);
/// Whether a study varies the scene key of that name.
bool varies(const study::Study& study, const std::string& key);
/// "re-used 3 mechanical runs, ran 12 ...": runs, rate, wall time.
std::string timing_text(const study::Timing& timing);
/// That as a sentence of a report.
std::string timing_sentence(const study::Timing& timing);
nlohmann::ordered_json timing_json(const study::Timing& timing);
/// "crack bound 12, tension cut-off 3", or "none".
std::string limiters_text(const run::LimiterCounts& limiters);
/// A number, or null where it is not finite.
nlohmann::ordered_json number(double value);
/// An object as a file holds it. What is not UTF-8, such as an odd name of a file, is replaced.
std::string json_file_text(const nlohmann::ordered_json& object);
/// What a study varies: name, scene key, key of its column, unit, and its values or its distribution.
nlohmann::ordered_json axes_json(const study::Study& study);
/// study.json: kind, study, title and answer, `members` of the kind, and the rows of the report's tables.
/// Rows have a line each and are never objects in memory, as large sweeps would take too much of it.
std::string study_json(const study::StudyFile& study, const Report& report,
                       const nlohmann::ordered_json& members);
}  // namespace launchsafe::report
