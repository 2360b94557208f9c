// launchsafe study: many cases, kept as they end, then tables and an answer.
#include "commands.hpp"
#include "forecast_text.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/study/forecast.hpp"
#include "progress.hpp"
#include "signals.hpp"
#include "study_folder.hpp"
#include "study_manifest.hpp"
#include "study_session.hpp"

#include <fmt/format.h>

namespace launchsafe::app {
namespace {

std::string progress_line(const study::Progress& progress) {
  const std::string left =
      progress.seconds_left < 0 ? "" : fmt::format(", {} left", report::duration(progress.seconds_left));
  return fmt::format("{} of {} cases done, {} running, {:.0f} %{}", progress.done, progress.total,
                     progress.running, 100.0 * progress.fraction, left);
}

study::StudyOptions options_of(const StudyArguments& arguments, store::CaseStore* store) {
  study::StudyOptions options;
  options.jobs = arguments.jobs > 0 ? arguments.jobs : study::available_cores();
  options.memory_limit = arguments.memory.value_or(options.memory_limit);
  options.time_limit = arguments.time_limit.value_or(options.time_limit);
  options.longest_run = arguments.longest_run.value_or(options.longest_run);
  options.shard = arguments.shard;
  options.stop = &stop_requested();
  options.store = store;
  return options;
}

StudyResult run_with_progress(const study::StudyFile& file, study::StudyOptions options,
                              const Console& console) {
  Progress progress(progress_style(console.quiet()));
  options.progress = [&progress](const study::Progress& state) { progress.show(progress_line(state)); };
  return run_study(file, options);
}

void explain_runs(const study::StudyFile& file, const study::StudyOptions& options, const Console& console) {
  constexpr double any_rate = 1.0;
  const study::Forecast forecast = study::forecast_study(file, options, any_rate);
  for (const std::string& line : reason_lines(forecast)) console.remark(line);
}

/// Where not one case may run, unless an earlier study left results here.
std::optional<scene::InputError> refusal_of(const study::StudyFile& file, const StudyArguments& arguments,
                                            const study::StudyOptions& options) {
  if (holds_store(arguments.output)) return std::nullopt;
  run::Reach reach{.longest_run = options.longest_run};
  if (!arguments.memory) reach.memory = study::available_memory();
  return study::all_out_of_reach(file, reach);
}

}  // namespace

ExitCode study_command(const StudyArguments& arguments, Console& console) {
  if (arguments.dry_run) return dry_run_command(arguments, console);
  const auto file = study::read_study(arguments.study, {arguments.tolerance});
  if (!file) {
    console.error(file.error());
    return ExitCode::bad_input;
  }
  if (!file->chosen_setting.empty()) console.remark("setting: " + file->chosen_setting);
  study::StudyOptions options = options_of(arguments, nullptr);
  if (const auto error = refusal_of(*file, arguments, options)) {
    console.error(*error);
    return ExitCode::bad_input;
  }
  StudySession session({arguments.study, arguments.output, file->study.kind, arguments.update,
                        arguments.shard.part(), arguments.command, study_manifest(*file, options.jobs)},
                       console);
  if (const ExitCode code = session.open(); code != ExitCode::done) return code;
  options.store = &session.store();
  if (arguments.explain) explain_runs(*file, options, console);
  return session.conclude(run_with_progress(*file, options, console), *file, options);
}

}  // namespace launchsafe::app
