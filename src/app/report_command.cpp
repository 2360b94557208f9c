// launchsafe report: what leaves the engineer's desk, of studies that were run.
#include "commands.hpp"
#include "launchsafe/report/safety_evidence.hpp"
#include "launchsafe/report/safety_report.hpp"
#include "launchsafe/store/atomic_file.hpp"
#include "launchsafe/store/own_files.hpp"
#include "launchsafe/store/study_record.hpp"
#include "output_folder.hpp"
#include "signals.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace launchsafe::app {
namespace {

/// Why the files may not be written into the folder, which is made where there is none.
std::optional<std::string> obstacle_to(const NamedTexts& files, const std::filesystem::path& folder) {
  for (const report::TextFile& file : files)
    if (const auto error = store::obstacle_to_own_file(folder / file.name)) return error->message;
  return prepare_output_folder(folder);
}

store::Result<report::PageTemplates> templates_of(const ReportArguments& arguments) {
  if (!arguments.templates) return report::built_in_templates();
  return report::read_templates(*arguments.templates, report::built_in_templates());
}

/// Takes away figures of an earlier report in the folder that the new one does not have, if they are as they
/// were written. Only what that report names: other files of ours there are not the report's. Returns remarks
/// on those that stay.
store::Result<std::vector<std::string>> remove_stale_figures(const std::filesystem::path& folder,
                                                             const NamedTexts& files) {
  const auto own = store::OwnFiles::read(folder);
  if (!own) return own.error();
  std::vector<std::string> remarks;
  if (own->state_of("report.json") != store::FileState::ours) return remarks;
  const auto text = store::read_file(folder / "report.json");
  if (!text) return text.error();
  for (const std::string& figure : report::figures_of(*text)) {
    const bool is_new = std::any_of(files.begin(), files.end(),
                                    [&](const report::TextFile& file) { return file.name == figure; });
    if (is_new) continue;
    std::error_code failed;
    switch (own->state_of(figure)) {
      case store::FileState::ours:
        if (!std::filesystem::remove(folder / figure, failed) && failed)
          return store::Error{store::Error::Kind::write_failed,
                              fmt::format("cannot remove {}, a figure that the report no longer has: {}",
                                          (folder / figure).string(), failed.message())};
        break;
      case store::FileState::edited:
        remarks.push_back(
            fmt::format("{} was edited and stays; this report does not have it", (folder / figure).string()));
        break;
      default:
        break;
    }
  }
  return remarks;
}

}  // namespace

ExitCode perform(const ReportArguments& arguments, Console& console) {
  std::optional<report::GapCriterion> criterion;
  if (arguments.criterion) {
    auto parsed = report::parse_criterion(*arguments.criterion, arguments.criterion_source.value_or(""));
    if (!parsed) return console.refuse(parsed.error());
    criterion = std::move(*parsed);
  }
  // Its report.md would take the place of the study's.
  if (store::read_study_record(arguments.output))
    return console.refuse(
        fmt::format("report: --output names {}, which holds a study; allowed: another folder",
                    arguments.output.string()));
  const auto templates = templates_of(arguments);
  if (!templates) return console.refuse(templates.error().message);
  const auto evidence = report::read_safety_evidence(arguments.studies);
  if (!evidence) return console.refuse(evidence.error().message);
  const auto rendered =
      report::make_safety_report(*evidence, criterion, *templates, {.stop = &stop_requested()});
  if (!rendered) return console.refuse(rendered.error().message);
  if (stop_requested()) {
    console.error("interrupted while drawing; nothing was written");
    return ExitCode::interrupted;
  }
  const NamedTexts& files = rendered->files;
  if (const auto obstacle = obstacle_to(files, arguments.output)) return console.refuse(*obstacle);
  const auto stale = remove_stale_figures(arguments.output, files);
  if (!stale) return console.end_with(stale.error());
  for (const auto& [name, text] : files)
    if (const auto error = store::write_own_file(arguments.output / name, text))
      return console.end_with(*error);
  for (const auto* remarks : {&*stale, &rendered->remarks})
    for (const std::string& remark : *remarks) console.remark(remark);
  const std::vector<std::string> places = places_of(arguments.output, files);
  console.print_text(fmt::format("{}\n", fmt::join(places, "\n")));
  console.print_json({{"files", places}, {"remarks", rendered->remarks}});
  return ExitCode::done;
}

}  // namespace launchsafe::app
