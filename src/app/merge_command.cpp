// launchsafe merge: the shards of a study as one.
#include "common_options.hpp"
#include "launchsafe/kinds/read_study.hpp"
#include "launchsafe/study/forecast.hpp"
#include "output_folder.hpp"
#include "study_session.hpp"

namespace launchsafe::app {
namespace {

struct MergeArguments : StudyArguments {
  std::vector<path> folders;  ///< of shards, to be copied from
};

void import_folders(const std::vector<path>& folders, StudySession& session, Console& console) {
  for (const path& folder : folders) {
    const auto imported = session.store().import_from(folder);
    session.print_remarks();
    if (!imported) {
      const bool is_missing = imported.error().kind == store::Error::Kind::missing;
      throw Ended{is_missing ? console.refuse(imported.error().message) : console.end_with(imported.error())};
    }
    console.remark(fmt::format("{}: copied {} cases, {} were there already", folder.string(), imported->cases,
                               imported->already_there));
  }
}

/// The mechanical runs that no shard has stored.
Json missing_runs(const study::Forecast& forecast) {
  Json missing;
  for (const study::ForecastRun& run : forecast.runs)
    if (!run.stored && !run.given_up) missing.push_back({{"mechanical_run", run.label}, {"why", run.why}});
  return missing;
}

/// The runs that only turned out to be missing when they were asked for: coupled runs, whose gaps follow from
/// the mechanics, and files that were damaged after they had been looked at.
Json missing_runs(const kinds::StudyOutcome& result) {
  Json missing;
  for (const kinds::Failure& failure : result.failures)
    if (failure.outcome == study::RunOutcome::not_stored) missing.push_back({{"run", failure.label}});
  return missing;
}

/// Names what is missing; `what`: how many of which runs.
ExitCode refuse_without(const Json& missing, const std::string& what, Console& console) {
  for (const auto& run : missing) {
    std::string line = "missing";
    for (const auto& part : run) line += ": " + part.get<std::string>();
    console.print_text(line + "\n");
  }
  console.print_json({{"missing", missing}});
  console.error(what + " are missing; there is no report");
  return ExitCode::cases_failed;
}

ExitCode perform(const MergeArguments& arguments, Console& console) {
  const study::StudyFile file = console.value_of(kinds::read_study(arguments.study, {arguments.tolerance}));
  study::StudyOptions options;
  options.jobs = arguments.jobs > 0 ? arguments.jobs : study::available_cores();
  options.stop = &stop_requested();
  options.compute = false;
  StudySession session(arguments, file, options.jobs, console);
  import_folders(arguments.folders, session, console);
  options.store = &session.store();
  constexpr double any_rate = 1.0;
  const study::Forecast forecast = study::forecast_study(file, options, any_rate, study::largest_case_count);
  if (const auto missing = missing_runs(forecast); !missing.empty())
    return refuse_without(
        missing, fmt::format("{} of {} mechanical runs", missing.size(), forecast.runs.size()), console);
  const kinds::StudyOutcome result = session.run(options);
  if (const auto missing = missing_runs(result); !missing.empty())
    return session.end(refuse_without(missing, fmt::format("{} runs", missing.size()), console));
  return session.conclude(result);
}

}  // namespace

void add_merge(CLI::App& app, CommandLine& line) {
  auto [command, merge] = add_command<MergeArguments>(app, line, "merge");
  add_required(command, "study", merge.study);
  add_required(command, "-o,--output", merge.output);
  add(command, "folder", merge.folders);
  add(command, "--update", merge.update);
  add_amount(command, "--tolerance", merge.tolerance, parse_temperature_difference);
  add_jobs(command, merge.jobs);
}

}  // namespace launchsafe::app
