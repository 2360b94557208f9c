#include "study_folder.hpp"

#include "launchsafe/store/atomic_file.hpp"
#include "study_manifest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>
#include <vector>

namespace launchsafe::app {
namespace {

using std::filesystem::path;

/// Whether a report of any kind of study gives a file this name.
bool is_report_name(std::string_view name) {
  constexpr std::array<std::string_view, 11> names{"report.md",       "study.json",        "verdicts.csv",
                                                   "verdicts.md",     "temperature.svg",   "calibration.csv",
                                                   "hold_outs.csv",   "critical_gaps.csv", "critical_gaps.md",
                                                   "sensitivity.csv", "evaluations.csv"};
  if (std::find(names.begin(), names.end(), name) != names.end()) return true;
  const path extension = path(name).extension();
  if (extension == ".svg") return name.starts_with("critical_gap") || name.starts_with("sensitivity_");
  return name.starts_with("case_") && (extension == ".h5" || extension == ".xdmf");
}

/// "HASH.h5", as a store names its cases.
bool is_case_name(std::string_view name) {
  constexpr std::size_t digits = 32;
  return name.size() == digits + 3 && name.ends_with(".h5") &&
         name.find_first_not_of("0123456789abcdef") == digits;
}

std::vector<std::string> report_names_in(const path& folder) {
  std::vector<std::string> names;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
    if (entry.is_directory(failed) || !is_report_name(entry.path().filename().string())) continue;
    names.push_back(entry.path().filename());
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> names_of(const StudyRecord& record) {
  std::vector<std::string> names;
  for (const ReportFile& file : record.files) names.push_back(file.name);
  return names;
}

path earlier_folder(const path& folder, int number) { return folder / fmt::format("earlier-{}", number); }

/// The first that is free, or that a kill left half filled: the manifest goes there last.
path folder_for_earlier(const path& folder) {
  int number = 1;
  while (std::filesystem::exists(earlier_folder(folder, number) / "manifest.json")) ++number;
  return earlier_folder(folder, number);
}

store::MaybeError failed_to(const char* what, const path& target, const std::error_code& error) {
  return store::Error{store::Error::Kind::write_failed,
                      fmt::format("cannot {} {}: {}", what, target.string(), error.message())};
}

store::MaybeError move_files(const path& folder, const std::vector<std::string>& names, const path& target) {
  std::error_code failed;
  std::filesystem::create_directories(target, failed);
  if (failed) return failed_to("make the folder", target, failed);
  for (const std::string& name : names) {
    // Another shard may be moving the same files.
    std::filesystem::rename(folder / name, target / name, failed);
    if (failed && failed != std::errc::no_such_file_or_directory)
      return failed_to("move the earlier report to", target / name, failed);
  }
  return std::nullopt;
}

/// Moves the report that an earlier study left. Before the names were recorded they are known by their looks.
store::Result<path> set_earlier_aside(const path& folder, const StudyRecord& earlier) {
  std::vector<std::string> names = names_of(earlier);
  if (names.empty()) names = report_names_in(folder);
  if (names.empty()) return path{};
  names.emplace_back("manifest.json");
  const path target = folder_for_earlier(folder);
  if (auto error = move_files(folder, names, target)) return *error;
  return target;
}

}  // namespace

bool holds_store(const path& folder) {
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
    const std::string name = entry.path().filename();
    if (name.starts_with("journal") && name.ends_with(".jsonl")) return true;
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder / "cases", failed)) {
    if (is_case_name(entry.path().filename().string())) return true;
  }
  return false;
}

std::optional<std::string> obstacle_in_folder(const path& folder, const store::Manifest& manifest,
                                              bool update) {
  const auto record = read_study_record(folder);
  if (record) {
    if (update || same_study(record->manifest, manifest)) return std::nullopt;
    return fmt::format(
        "{} holds the results of a different study or model, and nothing is overwritten; with --update the "
        "report there moves to {} and stored cases are used where they fit; or name another folder",
        folder.string(), folder_for_earlier(folder).string());
  }
  if (record.error().kind != store::Error::Kind::missing) return record.error().message;
  const std::vector<std::string> foreign = report_names_in(folder);
  if (foreign.empty()) return std::nullopt;
  if (holds_store(folder)) {
    if (update) return std::nullopt;
    return fmt::format(
        "{} holds a report without its manifest.json, and nothing is overwritten; with --update the report "
        "moves "
        "to {} and stored cases are used where they fit",
        folder.string(), folder_for_earlier(folder).string());
  }
  return fmt::format(
      "{} holds files that no study of ours left there ({}{}), and nothing is overwritten; name another "
      "folder",
      folder.string(), foreign.front(),
      foreign.size() > 1 ? fmt::format(" and {} more", foreign.size() - 1) : "");
}

void remove_leftovers(const path& folder) {
  std::vector<path> leftovers;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(folder, failed)) {
    const std::string name = entry.path().filename();
    if (name.starts_with(".") && name.ends_with(store::partial_suffix) && entry.is_regular_file(failed))
      leftovers.push_back(entry.path());
  }
  for (const path& each : leftovers) std::filesystem::remove(each, failed);
}

store::Result<path> take_folder(const path& folder, const store::Manifest& manifest) {
  path moved_to;
  if (const auto record = read_study_record(folder)) {
    if (same_study(record->manifest, manifest)) return path{};
    auto moved = set_earlier_aside(folder, *record);
    if (!moved) return moved.error();
    moved_to = std::move(*moved);
  } else if (const auto names = report_names_in(folder); !names.empty()) {
    moved_to = folder_for_earlier(folder);
    if (auto error = move_files(folder, names, moved_to)) return *error;
  }
  if (auto error = write_study_record(folder, {manifest, {}, {}})) return *error;
  return moved_to;
}

}  // namespace launchsafe::app
