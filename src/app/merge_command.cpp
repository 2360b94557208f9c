// launchsafe merge: the shards of a study as one.
#include "commands.hpp"
#include "launchsafe/kinds/read_study.hpp"
#include "launchsafe/study/forecast.hpp"
#include "signals.hpp"
#include "study_folder.hpp"
#include "study_session.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string>

namespace launchsafe::app {
namespace {

ExitCode import_exit_code(const store::Error& error) {
  const bool folder_is_wrong =
      error.kind == store::Error::Kind::conflict || error.kind == store::Error::Kind::missing;
  return folder_is_wrong ? ExitCode::bad_input : ExitCode::failed;
}

ExitCode import_folders(const std::vector<std::filesystem::path>& folders, StudySession& session,
                        Console& console) {
  for (const std::filesystem::path& folder : folders) {
    const auto imported = session.store().import_from(folder);
    session.print_remarks();
    if (!imported) {
      console.error(imported.error().message);
      return import_exit_code(imported.error());
    }
    console.remark(fmt::format("{}: copied {} cases and {} answers, {} cases were there already",
                               folder.string(), imported->cases, imported->answers, imported->already_there));
  }
  return ExitCode::done;
}

/// Names the mechanical runs that no shard has stored.
std::size_t list_missing(const study::Forecast& forecast, Console& console) {
  nlohmann::ordered_json missing = nlohmann::ordered_json::array();
  for (const study::ForecastRun& run : forecast.runs) {
    if (run.stored || run.given_up) continue;
    console.print_text(fmt::format("missing: {}: {}\n", run.label, run.why));
    missing.push_back({{"mechanical_run", run.label}, {"why", run.why}});
  }
  if (!missing.empty()) console.print_json({{"missing", missing}});
  return missing.size();
}

/// Names the runs that only turned out to be missing when they were asked for: coupled runs, whose gaps
/// follow from the mechanics, and files that were damaged after they had been looked at.
std::size_t list_not_stored(const kinds::StudyOutcome& result, Console& console) {
  nlohmann::ordered_json missing = nlohmann::ordered_json::array();
  for (const kinds::Failure& failure : result.failures) {
    if (failure.outcome != study::RunOutcome::not_stored) continue;
    console.print_text(fmt::format("missing: {}\n", failure.label));
    missing.push_back({{"run", failure.label}});
  }
  if (!missing.empty()) console.print_json({{"missing", missing}});
  return missing.size();
}

}  // namespace

ExitCode perform(const MergeArguments& arguments, Console& console) {
  const auto file = kinds::read_study(arguments.study, {arguments.tolerance});
  if (!file) return console.refuse(file.error());
  study::StudyOptions options;
  options.jobs = arguments.jobs > 0 ? arguments.jobs : study::available_cores();
  options.stop = &stop_requested();
  options.compute = false;
  StudySession session({arguments.study,
                        arguments.output,
                        kinds::kind_of(file->study),
                        arguments.update,
                        {},
                        arguments.command,
                        study_manifest(*file, options.jobs)},
                       console);
  if (const ExitCode code = session.open(); code != ExitCode::done) return code;
  if (const ExitCode code = import_folders(arguments.folders, session, console); code != ExitCode::done)
    return code;
  options.store = &session.store();
  constexpr double any_rate = 1.0;
  const study::Forecast forecast = study::forecast_study(*file, options, any_rate);
  if (const std::size_t missing = list_missing(forecast, console); missing > 0) {
    console.error(fmt::format("{} of {} mechanical runs are missing; there is no report", missing,
                              forecast.runs.size()));
    return ExitCode::cases_failed;
  }
  const kinds::StudyOutcome result = kinds::run_study(*file, options);
  if (const std::size_t missing = list_not_stored(result, console); missing > 0) {
    console.error(fmt::format("{} runs are missing; there is no report", missing));
    return ExitCode::cases_failed;
  }
  return session.conclude(result, *file, options);
}

}  // namespace launchsafe::app
