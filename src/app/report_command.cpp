// launchsafe report: what leaves the engineer's desk, of studies that were run.
#include "common_options.hpp"
#include "launchsafe/report/safety_report.hpp"

#include <set>

namespace launchsafe::app {
namespace {

struct ReportArguments {
  std::vector<path> studies;  ///< folders
  path output;                ///< folder of the report
};

/// What manifest.json of the report says: the studies that it is of.
store::StudyRecord record_of(const report::SafetyEvidence& evidence) {
  std::string input;
  for (const report::StudyEvidence& study : evidence.studies)
    input += fmt::format("{} {}\n", study.record.manifest.input_sha256, study.title);
  std::set<std::string> programs;
  for (const report::StudyEvidence& study : evidence.studies)
    programs.insert(study.record.programs.begin(), study.record.programs.end());
  return {.manifest = store::make_manifest(input), .programs = {programs.begin(), programs.end()}};
}

ExitCode perform(const ReportArguments& arguments, Console& console) {
  // Its manifest.json would take the place of the study's.
  if (std::filesystem::exists(store::results_file(arguments.output)))
    throw Ended{fmt::format("report: --output names {}, which holds a study; allowed: another folder",
                            arguments.output.string())};
  const report::SafetyEvidence evidence = report::read_safety_evidence(arguments.studies).or_throw();
  const report::RenderedReport rendered = report::make_safety_report(evidence, {.stop = &stop_requested});
  if (stop_requested) throw Ended{"interrupted while drawing; nothing was written", ExitCode::interrupted};
  prepare_output_folder(arguments.output);
  store::write_report_files(arguments.output, record_of(evidence), rendered.files);
  console.remarks(rendered.remarks);
  const std::vector<std::string> places = study::of_each(
      rendered.files, [&](const auto& each) { return (arguments.output / each.name).string(); });
  return console.done(fmt::format("{}\n", fmt::join(places, "\n")),
                      {{"files", places}, {"remarks", rendered.remarks}});
}

}  // namespace

void add_report(CLI::App& app, CommandLine& line) {
  auto [command, report] =
      add_command<ReportArguments>(app, line, "report", "Make the safety report of studies that were run");
  add(command, "study", report.studies, "STUDY_DIR...", "Folders of studies, at most one of each kind")
      ->required();
  add(command, "-o,--output", report.output, "DIR", "Folder for report.html, report.json and the figures")
      ->required();
}

}  // namespace launchsafe::app
