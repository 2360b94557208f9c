// launchsafe status: how far studies are.
#include "common_options.hpp"
#include "launchsafe/report/study_text.hpp"

namespace launchsafe::app {
namespace {

struct StatusArguments {
  std::vector<path> folders;  ///< of a study, or of its shards
};

ExitCode perform(const StatusArguments& asked, Console& console) {
  std::map<std::string, store::StudyStatus> studies;
  for (const path& folder : asked.folders) {
    const auto status = store::status_in(folder);
    if (!status)
      throw scene::error_at({folder.string()}, {}, "no study.db of a study",
                            "folders that launchsafe study was given as --output DIR", {});
    studies[folder] = *status;
  }
  const std::time_t now = std::time(nullptr);
  const Json facts = report::status_facts(studies, now);
  console.done(report::status_text(facts, now), facts);
  return static_cast<ExitCode>(facts["exit_code"].get<int>());
}

}  // namespace

void add_status(CLI::App& app, CommandLine& line) {
  auto [command, status] = add_command<StatusArguments>(
      app, line, "status", "Print how far a study is: state, cases done and failed, when it will end");
  add(command, "folder", status.folders, "DIR...", "Folder of a study, or folders of its shards")->required();
}

}  // namespace launchsafe::app
