// launchsafe status: how far studies are, from what their writers tell in status files.
#include "common_options.hpp"
#include "launchsafe/report/study_status.hpp"
#include "launchsafe/scene/toml_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <thread>

namespace launchsafe::app {
namespace {

struct StatusArguments {
  std::vector<std::filesystem::path> folders;  ///< of one study: its own, or those of its shards
  bool watch = false;                          ///< look again until it has ended
};

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// The folder of a study near one that is none: around it, in it, or beside a name that is not there.
std::string study_folder_near(const fs::path& folder) {
  std::vector<fs::path> candidates{folder.parent_path(),
                                   folder.lexically_normal().parent_path().parent_path()};
  std::error_code failed;
  const fs::path around = fs::is_directory(folder, failed) ? folder : folder.parent_path();
  for (const auto& entry : fs::directory_iterator(around.empty() ? "." : around, failed))
    if (entry.is_directory(failed)) candidates.push_back(entry.path());
  std::sort(candidates.begin() + 2, candidates.end());
  const auto found = std::ranges::find_if(
      candidates, [](const fs::path& each) { return !each.empty() && !store::statuses_in(each).empty(); });
  return found == candidates.end() ? "" : found->lexically_normal().string();
}

scene::InputError no_study_in(const fs::path& folder) {
  std::error_code failed;
  const bool is_folder = fs::is_directory(folder, failed);
  const char* found = !is_folder                             ? "no such folder"
                      : fs::exists(folder / "slurm", failed) ? "a study of which no shard has begun"
                                                             : "no status.json of a study";
  return scene::error_at({folder.string()}, {}, found,
                         "folders that launchsafe study was given as --output DIR",
                         study_folder_near(folder));
}

/// The snapshots of all folders, as those of one study; those of its shards in the order of their numbers.
scene::Expected<std::vector<store::StoreStatus>, scene::InputError> snapshots_of(
    const StatusArguments& asked) {
  std::vector<store::StoreStatus> all;
  for (const fs::path& folder : asked.folders) {
    std::vector<store::StoreStatus> found = store::statuses_in(folder);
    if (found.empty()) return no_study_in(folder);
    std::ranges::move(found, std::back_inserter(all));
  }
  std::ranges::stable_sort(all, {},
                           [](const store::StoreStatus& each) { return std::atoi(each.part.c_str()); });
  return all;
}

/// What a person sees: in place of what was shown before on a terminal, else below it.
void show(const report::Row& facts, bool watch, Console& console) {
  const bool in_place = watch && ::isatty(STDOUT_FILENO) == 1;
  console.print_text((in_place ? "\x1b[H\x1b[J" : "") + report::status_text(facts));
}

/// False when it was interrupted meanwhile.
bool wait_for(std::chrono::milliseconds time) {
  constexpr auto step = 100ms;
  for (; time > 0ms && !stop_requested(); time -= step) std::this_thread::sleep_for(step);
  return !stop_requested();
}

/// A merge follows the shards of an array job, which may all be waiting.
bool pays_to_wait(const report::Row& facts, const StatusArguments& asked) {
  std::error_code failed;
  const bool waits = facts["state"] == "waiting" && fs::exists(asked.folders.front() / "slurm", failed);
  return report::is_running(facts) || waits;
}

ExitCode perform(const StatusArguments& asked, Console& console) {
  while (true) {
    const std::vector<store::StoreStatus> snapshots = console.value_of(snapshots_of(asked));
    std::vector<std::string> names(asked.folders.begin(), asked.folders.end());
    report::Row facts =
        report::status_facts(fmt::format("{}", fmt::join(names, ", ")), snapshots, std::time(nullptr));
    show(facts, asked.watch, console);
    const bool goes_on = asked.watch && pays_to_wait(facts, asked);
    if (goes_on && wait_for(::isatty(STDOUT_FILENO) == 1 ? 2s : 10s)) continue;
    console.print_json(facts);
    return goes_on ? ExitCode::interrupted : static_cast<ExitCode>(facts["exit_code"].get<int>());
  }
}

}  // namespace

void add_status(CLI::App& app, CommandLine& line) {
  auto [command, status] = add_command<StatusArguments>(
      app, line, "status", "Say how far a study is: done, failed, left, when it will end");
  add_required(command, "folder", status.folders, "DIR...",
               "Folder of a study or of its shards, or those of shards that have one each");
  command.add_flag("--watch", status.watch, "Look again every few seconds until it has ended");
}

}  // namespace launchsafe::app
