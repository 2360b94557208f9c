// launchsafe study: many cases, a fit, a verdict for every gap.
#include "commands.hpp"
#include "launchsafe/report/calibration_report.hpp"
#include "launchsafe/report/critical_gap_report.hpp"
#include "launchsafe/report/number.hpp"
#include "output_folder.hpp"
#include "progress.hpp"
#include "signals.hpp"
#include "study_manifest.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace launchsafe::app {
namespace {

std::string progress_line(const study::Progress& progress) {
  const std::string left =
      progress.seconds_left < 0 ? "" : fmt::format(", {} left", report::duration(progress.seconds_left));
  return fmt::format("{} of {} cases done, {} running, {:.0f} %{}", progress.done, progress.total,
                     progress.running, 100.0 * progress.fraction, left);
}

std::string text_of(const report::Table& table) {
  return table.rows.empty() ? std::string{} : report::to_text(table) + "\n";
}

std::string text_of(const study::CriticalGapResult& result) {
  std::string text = text_of(report::verdict_table(result)) + text_of(report::comparison_table(result)) +
                     text_of(report::critical_gap_table(result));
  for (const study::CaseOutcome& outcome : result.cases) {
    if (outcome.fit) text += text_of(report::fit_table(outcome));
  }
  return text + text_of(report::run_table(result));
}

std::string text_of(const study::CalibrationResult& result) {
  std::string text = text_of(report::calibration_table(result)) + text_of(report::convergence_table(result)) +
                     text_of(report::constants_table(result));
  if (result.recommendation.row) {
    text += text_of(report::hold_out_table(result, result.rows[*result.recommendation.row]));
  }
  return text;
}

bool any_indeterminate(const study::CriticalGapResult& result) { return result.any_indeterminate(); }
bool any_indeterminate(const study::CalibrationResult&) { return false; }

template <class StudyResult>
ExitCode exit_code_of(const StudyResult& result) {
  if (result.any_failed()) return ExitCode::cases_failed;
  return any_indeterminate(result) ? ExitCode::indeterminate : ExitCode::done;
}

ExitCode report_interruption(const StudyArguments& arguments, const Console& console) {
  const std::string jobs = arguments.jobs > 0 ? fmt::format(" --jobs {}", arguments.jobs) : "";
  console.error(fmt::format(
      "interrupted; nothing of this study was kept; to start it again: launchsafe study {} -o {}{}",
      arguments.study.string(), arguments.output.string(), jobs));
  return ExitCode::interrupted;
}

ExitCode refuse(const std::string& message, const Console& console) {
  console.error(message);
  return ExitCode::bad_input;
}

template <class StudyResult>
store::Result<report::WrittenFiles> write_results(const StudyResult& result,
                                                  const std::filesystem::path& folder,
                                                  store::Manifest manifest) {
  manifest.wall_time = result.timing.wall_time;
  if (const auto error = write_study_manifest(folder, manifest)) return *error;
  return report::write_report(result, folder);
}

/// Writes and prints what came of a study. The answer is printed too where it could not be written.
template <class StudyResult>
ExitCode deliver(const StudyResult& result, const StudyArguments& arguments, const store::Manifest& manifest,
                 Console& console) {
  if (result.interrupted) return report_interruption(arguments, console);
  const auto written = write_results(result, arguments.output, manifest);
  console.print_text(text_of(result) + report::answer(result) + "\n");
  console.print_json(report::to_json(result));
  if (!written) {
    console.error(written.error().message);
    return written.error().kind == store::Error::Kind::conflict ? ExitCode::bad_input : ExitCode::failed;
  }
  for (const std::string& remark : written->remarks) console.remark(remark);
  console.remark(fmt::format("wrote {} files to {}", written->files.size() + 1, arguments.output.string()));
  return exit_code_of(result);
}

}  // namespace

ExitCode study_command(const StudyArguments& arguments, Console& console) {
  const auto file = study::read_study(arguments.study);
  if (!file) return refuse(file.error().message(), console);
  const int jobs = arguments.jobs > 0 ? arguments.jobs : study::available_cores();
  const store::Manifest manifest = study_manifest(*file, jobs);
  if (const auto conflict = study_conflict(arguments.output, manifest)) return refuse(*conflict, console);
  if (const auto obstacle = prepare_output_folder(arguments.output)) return refuse(*obstacle, console);

  Progress progress(progress_style(console.quiet()));
  study::StudyOptions options;
  options.jobs = jobs;
  options.stop = &stop_requested();
  options.progress = [&progress](const study::Progress& state) { progress.show(progress_line(state)); };
  if (file->study.kind == study::StudyKind::calibration) {
    const study::CalibrationResult result = study::run_calibration(*file, options);
    progress.clear();
    return deliver(result, arguments, manifest, console);
  }
  const study::CriticalGapResult result = study::run_critical_gap(*file, options);
  progress.clear();
  return deliver(result, arguments, manifest, console);
}

}  // namespace launchsafe::app
