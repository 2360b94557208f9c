// What --help says below the options, what commands print for people, and files that launchsafe init and
// launchsafe emit write, as they are in the source. Names in double braces stand for values; see
// report/page_texts.hpp.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <string>

namespace launchsafe::app {

/// By command, "run.txt"; "launchsafe.txt" is that of all.
const std::map<std::string, std::string>& help_texts();

/// A text for people, of such facts as programs have as JSON: "forecast.txt".
std::string told(const std::string& name, const nlohmann::ordered_json& facts);

extern const char* const scene_template;
extern const char* const study_template;
extern const char* const accuracy_template;
extern const char* const firings_template;
/// Scripts for Slurm: an array of shards, the merge behind it, and what submits both.
extern const char* const shard_template;
extern const char* const merge_template;
extern const char* const submit_template;
/// A script for bash.
extern const char* const completion_template;
/// The record of reports/calibrate_table8.
extern const char* const shipped_calibration;

}  // namespace launchsafe::app
