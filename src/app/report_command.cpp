// launchsafe report: what leaves the engineer's desk, of studies that were run.
#include "common_options.hpp"
#include "launchsafe/report/safety_report.hpp"

#include <unistd.h>

namespace launchsafe::app {
namespace {

struct ReportArguments {
  std::vector<path> studies;  ///< folders
  path output;                ///< folder of the report
  bool pdf = false;           ///< also as PDF, by a browser
};

/// What manifest.json of the report says: the studies that it is of.
store::StudyRecord record_of(const report::SafetyEvidence& evidence) {
  std::string input;
  for (const report::StudyEvidence& study : evidence.studies)
    input += fmt::format("{} {}\n", study.record.manifest.input_sha256, study.title);
  std::set<std::string> programs;
  for (const report::StudyEvidence& study : evidence.studies)
    programs.insert(study.record.programs.begin(), study.record.programs.end());
  return {.manifest = store::make_manifest(input, 1), .programs = {programs.begin(), programs.end()}};
}

/// Prints the page; why not, where no browser does.
std::string print_page(const path& folder) {
  const path place = std::filesystem::absolute(folder);
  std::vector<std::string> words{"--headless", "--disable-gpu", "--no-pdf-header-footer",
                                 "--print-to-pdf=" + (place / "report.pdf").string()};
  // Which browsers want of root; the page is our own, without scripts, and fetches nothing.
  if (::geteuid() == 0) words.emplace_back("--no-sandbox");
  words.push_back((place / "report.html").string());
  std::string why;
  for (const char* browser : {"chromium", "google-chrome"}) {
    const auto run = store::run_program(browser, words, "", {.stop = &stop_requested()});
    if (run && run->succeeded && std::filesystem::exists(place / "report.pdf")) return {};
    if (why.empty()) why = run ? fmt::format("{} failed", browser) : run.error().message;
  }
  return "no report.pdf: " + why;
}

ExitCode perform(const ReportArguments& arguments, Console& console) {
  // Its report.md would take the place of the study's.
  if (const auto there = store::read_study_record(arguments.output);
      there && (!there->study.empty() || std::filesystem::exists(arguments.output / "study.json")))
    console.refuse(fmt::format("report: --output names {}, which holds a study; allowed: another folder",
                               arguments.output.string()));
  const report::SafetyEvidence evidence = console.value_of(report::read_safety_evidence(arguments.studies));
  const report::RenderedReport rendered = report::make_safety_report(evidence, {.stop = &stop_requested()});
  if (stop_requested()) console.fail("interrupted while drawing; nothing was written", ExitCode::interrupted);
  console.refuse_any(prepare_output_folder(arguments.output));
  if (const auto error = store::write_report_files(arguments.output, record_of(evidence), rendered.files))
    console.end_with(*error);
  console.remarks(rendered.remarks);
  if (const std::string fault = arguments.pdf ? print_page(arguments.output) : ""; !fault.empty())
    console.remark(fault);
  const std::vector<std::string> places = places_of(arguments.output, rendered.files);
  return console.done(fmt::format("{}\n", fmt::join(places, "\n")),
                      {{"files", places}, {"remarks", rendered.remarks}});
}

}  // namespace

void add_report(CLI::App& app, CommandLine& line) {
  auto [command, report] = add_command<ReportArguments>(app, line, "report");
  add_required(command, "study", report.studies);
  add_required(command, "-o,--output", report.output);
  add(command, "--pdf", report.pdf);
}

}  // namespace launchsafe::app
