// launchsafe report: what leaves the engineer's desk, of studies that were run.
#include "common_options.hpp"
#include "launchsafe/report/safety_report.hpp"

#include <unistd.h>

namespace launchsafe::app {
namespace {

struct ReportArguments {
  std::vector<path> studies;      ///< folders
  path output;                    ///< folder of the report; empty with `index`
  std::optional<path> templates;  ///< folder; none: those built in
  std::optional<std::string> criterion, criterion_source;
  report::DocumentHead document;
  bool pdf = false;    ///< also as PDF, by a browser
  bool index = false;  ///< instead: the page that leads to all reports of one folder
};

/// What manifest.json of the report says: the studies that it is of, and what was asked of them.
store::StudyRecord record_of(const report::SafetyEvidence& evidence, const ReportArguments& arguments) {
  const report::DocumentHead& document = arguments.document;
  std::string input =
      fmt::format("criterion {}\ndocument {}, {}, {}, {}\n", arguments.criterion.value_or("none"),
                  document.number, document.author, document.date, fmt::join(document.approvals, ", "));
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

/// Puts the page in the place of an earlier one; any other index.html is somebody's.
ExitCode write_index(const path& folder, Console& console) {
  const std::string page = report::index_page(folder);
  if (page.empty())
    console.refuse(
        fmt::format("report: {} holds no folder of a report; allowed: one that does, such "
                    "as reports",
                    folder.string()));
  const path file = folder / "index.html";
  const auto present = store::read_file(file);
  const bool absent = !present && present.error().kind == store::Error::Kind::missing;
  if (!absent && !(present && present->starts_with(report::index_begin)))
    console.refuse(
        fmt::format("report: {} is no page of launchsafe report --index, and nothing is "
                    "overwritten; move it away",
                    file.string()));
  if (const auto error = store::write_file_atomically(file, page, store::IfExists::replace))
    console.end_with(*error);
  return console.done(file.string() + "\n", {{"files", {file.string()}}});
}

/// What of these options makes no sense together; empty for nothing.
std::string contradiction(const ReportArguments& report) {
  if (report.index && report.studies.size() != 1) return "report: --index is of one folder";
  if (!report.index && report.output.empty()) return "--output is required";
  if (report.criterion.has_value() == report.criterion_source.has_value()) return {};
  return report.criterion ? "report: --criterion requires --criterion-source, which says who asks for it"
                          : "report: --criterion-source requires --criterion";
}

ExitCode perform(const ReportArguments& arguments, Console& console) {
  if (const std::string fault = contradiction(arguments); !fault.empty())
    console.refuse(fault + usage_hint("report "));
  if (arguments.index) return write_index(arguments.studies.front(), console);
  // Its report.md would take the place of the study's.
  if (const auto there = store::read_study_record(arguments.output);
      there && (!there->study.empty() || std::filesystem::exists(arguments.output / "study.json")))
    console.refuse(fmt::format("report: --output names {}, which holds a study; allowed: another folder",
                               arguments.output.string()));
  report::PageTemplates templates = report::built_in_templates();
  if (arguments.templates)
    templates = console.value_of(report::read_templates(*arguments.templates, std::move(templates)));
  const report::SafetyEvidence evidence = console.value_of(report::read_safety_evidence(arguments.studies));
  std::optional<report::GapCriterion> criterion;
  if (arguments.criterion)
    criterion = console.value_of(
        report::parse_criterion(*arguments.criterion, *arguments.criterion_source,
                                own_value(evidence.main(), "kinetics.ignition_temperature")));
  const report::RenderedReport rendered = console.value_of(report::make_safety_report(
      evidence, criterion, templates, arguments.document, {.stop = &stop_requested()}));
  if (stop_requested()) console.fail("interrupted while drawing; nothing was written", ExitCode::interrupted);
  console.refuse_any(prepare_output_folder(arguments.output));
  console.remarks(console.stored(
      store::write_report_files(arguments.output, record_of(evidence, arguments), rendered.files)));
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
  add(command, "-o,--output", report.output);
  add(command, "--criterion", report.criterion);
  add(command, "--criterion-source", report.criterion_source);
  add(command, "--document", report.document.number);
  add(command, "--author", report.document.author);
  add(command, "--date", report.document.date);
  add(command, "--approvals", report.document.approvals);
  add(command, "--pdf", report.pdf);
  add(command, "--templates", report.templates);
  CLI::Option* index = add(command, "--index", report.index);
  for (const char* other : {"--output", "--criterion", "--pdf", "--templates"})
    index->excludes(command.get_option(other));
}

}  // namespace launchsafe::app
