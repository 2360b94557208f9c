// launchsafe emit: scripts that run a study elsewhere.
#include "commands.hpp"
#include "launchsafe/kinds/read_study.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/study/forecast.hpp"
#include "shell_words.hpp"
#include "slurm_script.hpp"
#include "study_folder.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <functional>
#include <numeric>
#include <system_error>

namespace launchsafe::app {
namespace {

using std::filesystem::path;

/// Wall time of runs that start on the next free core, the longest first.
double time_on(const std::vector<double>& times, int cores) {
  const std::vector<int> core_of_run = study::shards_of(times, cores);
  std::vector<double> ends(static_cast<std::size_t>(cores), 0.0);
  for (std::size_t i = 0; i < times.size(); ++i)
    ends[static_cast<std::size_t>(core_of_run[i] - 1)] += times[i];
  return *std::max_element(ends.begin(), ends.end());
}

double sum_of_largest(std::vector<double> values, int count) {
  std::sort(values.begin(), values.end(), std::greater<>());
  values.resize(std::min(values.size(), static_cast<std::size_t>(count)));
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// Of the whole study, with nothing stored. A run takes as long again for every coupled run that may
/// confirm it.
ShardNeeds needs_of(const study::Forecast& whole, int shards, int jobs) {
  const double runs = static_cast<double>(std::max<std::size_t>(1, whole.run_count));
  const double repeats = 1.0 + static_cast<double>(whole.confirmations) / runs;
  // Where the forecast has some of the runs alone, each stands for so many.
  const double each_for = runs / static_cast<double>(std::max<std::size_t>(1, whole.runs.size()));
  // All runs of a case are of one shard, as study::case_runs divides them.
  std::vector<double> costs;
  for (const study::ForecastRun& run : whole.runs)
    if (run.cases > 0) costs.push_back(run.time);
  const std::vector<int> shard_of_case = study::shards_of(costs, shards);
  ShardNeeds needs;
  for (int shard = 1; shard <= shards; ++shard) {
    std::vector<double> own_times, own_memories;
    std::size_t next_case = 0, own_cases = 0;
    for (const study::ForecastRun& run : whole.runs) {
      next_case += run.cases > 0 ? 1 : 0;
      if (shard_of_case[next_case - 1] != shard) continue;
      own_cases += run.cases > 0 ? 1 : 0;
      own_times.push_back(repeats * run.time);
      own_memories.push_back(run.given_up ? 0.0 : run.memory);
    }
    const double share = static_cast<double>(own_cases) / static_cast<double>(costs.size());
    needs.time = std::max(needs.time, each_for * time_on(own_times, jobs));
    needs.memory = std::max(
        needs.memory, whole.plan_memory + share * whole.kept_memory + sum_of_largest(own_memories, jobs));
    if (own_times.empty() && whole.runs.size() == whole.run_count) ++needs.idle;
  }
  // And gnuplot beside it.
  constexpr double of_plots = 24e6;
  needs.merge_memory = whole.plan_memory + whole.kept_memory + whole.report_memory + of_plots;
  return needs;
}

/// Without "." and "..", unless taking those out leads elsewhere (behind a symbolic link).
path absolute_path(const path& given) {
  std::error_code failed;
  const path absolute = std::filesystem::absolute(given, failed);
  path tidy = absolute.lexically_normal();
  if (!tidy.has_filename()) tidy = tidy.parent_path();
  const bool elsewhere =
      std::filesystem::exists(absolute, failed) && !std::filesystem::equivalent(absolute, tidy, failed);
  return elsewhere ? absolute : tidy;
}

/// What the scripts need to know; the predictions come on top.
SlurmStudy slurm_study(EmitArguments asked, const study::StudyFile& file) {
  std::error_code failed;
  asked.study = absolute_path(asked.study);
  asked.output = absolute_path(asked.output);
  asked.jobs = std::max(1, asked.jobs);
  // No measurement, as the machine that submits is not the one that computes, and scripts stay what they
  // were.
  return {std::move(asked), std::filesystem::read_symlink("/proc/self/exe", failed), file.cases.size(),
          run::cautious_update_rate};
}

/// Lets everybody start the script that submits the others.
void make_executable(const path& script) {
  using std::filesystem::perms;
  std::error_code failed;  // it can be given to a shell all the same
  std::filesystem::permissions(script, perms::owner_exec | perms::group_exec | perms::others_exec,
                               std::filesystem::perm_options::add, failed);
}

/// With the folder as the user named it.
void print_scripts(const SlurmStudy& study, const path& folder, const NamedTexts& scripts, Console& console) {
  const SlurmRequest request = request_of(study);
  const std::string command = shell_command({"sh", (folder / submit_name).string()});
  const std::vector<std::string> files = places_of(folder, scripts);
  console.print_text(fmt::format(
      "{}\n\n{}; each asks for {}, {} MiB and {} min; the slowest is predicted to take {}\nto submit: {}\n",
      fmt::join(files, "\n"), report::counted(study.asked.shards, "shard"),
      report::counted(study.asked.jobs, "core"), request.mebibytes, request.minutes, predicted_time(study),
      command));
  console.print_json({{"files", files},
                      {"submit", command},
                      {"shards", study.asked.shards},
                      {"jobs", study.asked.jobs},
                      {"memory_MiB", request.mebibytes},
                      {"merge_memory_MiB", request.merge_mebibytes},
                      {"time_s", 60 * request.minutes},
                      {"predicted_time_s", study.needs.time},
                      {"predicted_memory_bytes", study.needs.memory}});
}

}  // namespace

ExitCode perform(const EmitArguments& arguments, Console& console) {
  const auto file = kinds::read_study(arguments.study);
  if (!file) return console.refuse(file.error());
  if (const auto error = study::all_out_of_reach(*file, {})) return console.refuse(*error);
  SlurmStudy study = slurm_study(arguments, *file);
  if (const auto fault = fault_of(study)) return console.refuse(*fault);
  const store::Manifest manifest = study_manifest(*file, study.asked.jobs);
  if (const auto obstacle =
          obstacle_in_folder(study.asked.output, kinds::kind_of(file->study), manifest, false))
    return console.refuse(*obstacle);
  study::StudyOptions options;
  options.jobs = study.asked.jobs;
  study.needs = needs_of(study::forecast_study(*file, options, study.update_rate), study.asked.shards,
                         study.asked.jobs);

  const path folder = slurm_folder(arguments.output);
  if (std::filesystem::is_symlink(folder))
    return console.refuse(
        fmt::format("{} is a link, and nothing is written through one; move it away", folder.string()));
  const NamedTexts scripts = slurm_scripts(study);
  if (const ExitCode code = write_where_absent(folder, scripts, console); code != ExitCode::done) return code;
  make_executable(folder / submit_name);
  print_scripts(study, folder, scripts, console);
  if (study.needs.idle > 0)
    console.remark(
        fmt::format("{} of the {} shards will have nothing to do", study.needs.idle, study.asked.shards));
  return ExitCode::done;
}

}  // namespace launchsafe::app
