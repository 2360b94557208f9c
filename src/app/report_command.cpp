// launchsafe report: what leaves the engineer's desk, of studies that were run.
#include "commands.hpp"
#include "launchsafe/report/safety_evidence.hpp"
#include "launchsafe/report/safety_render.hpp"
#include "output_folder.hpp"
#include "signals.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <utility>

namespace launchsafe::app {
namespace {

/// A report is not written into a folder from which it is made: its report.md would take the study's place.
std::optional<std::string> obstacle_in(const ReportArguments& arguments) {
  for (const auto& study : arguments.studies) {
    std::error_code failed;
    if (std::filesystem::equivalent(study, arguments.output, failed))
      return fmt::format("report: --output names {}, which is one of the studies; allowed: another folder",
                         arguments.output.string());
  }
  return std::nullopt;
}

store::Result<report::SafetyTemplates> templates_of(const ReportArguments& arguments) {
  if (!arguments.templates) return report::built_in_templates();
  return report::read_templates(*arguments.templates);
}

}  // namespace

ExitCode perform(const ReportArguments& arguments, Console& console) {
  std::optional<report::GapCriterion> criterion;
  if (arguments.criterion) {
    auto parsed = report::parse_criterion(*arguments.criterion, arguments.criterion_source.value_or(""));
    if (!parsed) return console.refuse(parsed.error());
    criterion = std::move(*parsed);
  }
  if (const auto obstacle = obstacle_in(arguments)) return console.refuse(*obstacle);
  const auto templates = templates_of(arguments);
  if (!templates) return console.refuse(templates.error().message);
  const auto evidence = report::read_safety_evidence(arguments.studies);
  if (!evidence) return console.refuse(evidence.error().message);
  const auto rendered = report::render(report::make_safety_document(*evidence, criterion), *templates,
                                       {.stop = &stop_requested()});
  if (!rendered) return console.refuse(rendered.error().message);
  if (stop_requested()) {
    console.error("interrupted while drawing; nothing was written");
    return ExitCode::interrupted;
  }
  std::vector<std::string> names;
  std::vector<std::pair<std::string, std::string>> texts;
  for (const report::TextFile& file : rendered->files) {
    names.push_back(file.name);
    texts.emplace_back(file.name, file.text);
  }
  if (const auto obstacle = obstacle_to_report(arguments.output, names)) return console.refuse(*obstacle);
  report::WrittenFiles written;
  if (const auto error = write_texts(arguments.output, texts, written)) return console.end_with(*error);
  for (const std::string& remark : rendered->remarks) console.remark(remark);
  std::string text;
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  for (const std::string& name : names) {
    text += (arguments.output / name).string() + "\n";
    files.push_back((arguments.output / name).string());
  }
  console.print_text(text);
  console.print_json({{"files", std::move(files)}, {"remarks", rendered->remarks}});
  return ExitCode::done;
}

}  // namespace launchsafe::app
