// status.json and index.html of a study's folder: how far the study is, for whoever watches, since nobody
// else may read a results file that is being written. Every writer has a status of its own, the folder one
// page.
#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <optional>

namespace launchsafe::store {

/// The beginning of index.html, by which it is known as this program's own.
inline constexpr std::string_view page_begin = "<!DOCTYPE html>\n<!-- launchsafe status 1 -->\n";

/// A writer's snapshot: the members of its status file.
struct StoreStatus {
  std::string part;  ///< "1-of-4" of a shard; empty for a whole study
  nlohmann::ordered_json members;
};

/// The file's text.
std::string to_text(const nlohmann::ordered_json& members);
/// What the content of a status file says; nothing for any other file.
std::optional<nlohmann::ordered_json> status_in(std::string_view content);

/// The snapshots in a folder that count: those of parts in the order of their names, or that of the whole
/// study, whichever was written last.
std::vector<StoreStatus> statuses_in(const std::filesystem::path& folder);

}  // namespace launchsafe::store
