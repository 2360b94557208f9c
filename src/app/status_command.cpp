// launchsafe status: how far studies are, from what their writers tell in status files.
#include "common_options.hpp"
#include "launchsafe/report/study_text.hpp"

namespace launchsafe::app {
namespace {

struct StatusArguments {
  std::vector<path> folders;  ///< of one study: its own, or those of its shards
};

namespace fs = std::filesystem;

/// The folder of a study near one that is none: around it, in it, or beside a name that is not there.
std::string study_folder_near(const path& folder) {
  std::vector<path> candidates{folder.parent_path(), folder.lexically_normal().parent_path().parent_path()};
  std::error_code failed;
  const path around = fs::is_directory(folder, failed) ? folder : folder.parent_path();
  for (const std::string& name : scene::list_folder(around)) candidates.push_back(around / name);
  const auto found = std::ranges::find_if(
      candidates, [](const path& each) { return !each.empty() && !store::statuses_in(each).empty(); });
  return found == candidates.end() ? "" : found->lexically_normal().string();
}

scene::InputError no_study_in(const path& folder) {
  std::error_code failed;
  const char* found = fs::is_directory(folder, failed) ? "no status.json of a study" : "no such folder";
  return scene::error_at({folder.string()}, {}, found,
                         "folders that launchsafe study was given as --output DIR",
                         study_folder_near(folder));
}

/// The snapshots of all folders, as those of one study; those of its shards in the order of their numbers.
std::vector<store::StoreStatus> snapshots_of(const StatusArguments& asked, Console& console) {
  std::vector<store::StoreStatus> all;
  for (const path& folder : asked.folders) {
    std::vector<store::StoreStatus> found = store::statuses_in(folder);
    if (found.empty()) console.refuse(no_study_in(folder));
    std::ranges::move(found, std::back_inserter(all));
  }
  std::ranges::stable_sort(all, {},
                           [](const store::StoreStatus& each) { return std::atoi(each.part.c_str()); });
  return all;
}

ExitCode perform(const StatusArguments& asked, Console& console) {
  const std::vector<std::string> names(asked.folders.begin(), asked.folders.end());
  const report::Row facts = report::status_facts(fmt::format("{}", fmt::join(names, ", ")),
                                                 snapshots_of(asked, console), std::time(nullptr));
  console.print_text(report::status_text(facts));
  console.print_json(facts);
  return static_cast<ExitCode>(facts["exit_code"].get<int>());
}

}  // namespace

void add_status(CLI::App& app, CommandLine& line) {
  auto [command, status] = add_command<StatusArguments>(app, line, "status");
  add_required(command, "folder", status.folders);
}

}  // namespace launchsafe::app
