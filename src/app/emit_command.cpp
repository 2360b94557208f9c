// launchsafe emit: the scripts that run a study on a Slurm cluster: an array of shards, the merge behind it,
// and what submits both.
#include "common_options.hpp"

#include <boost/algorithm/string.hpp>

#include <map>

namespace launchsafe::app {
namespace {

struct EmitArguments {
  std::string engine;  ///< what the script is for: "slurm"
  path study, output;
  int shards = 0;
  int jobs = 0;                      ///< threads of a shard; 0: not given
  std::optional<double> memory;      ///< bytes, of a shard
  std::optional<double> time_limit;  ///< s of wall time, of one case
  std::vector<std::string> sbatch;   ///< further options for every #SBATCH line, such as "--partition=long"
};

constexpr double time_factor = 3.0;
constexpr long least_minutes = 10;
constexpr double memory_factor = 1.3;
constexpr double share_for_cases = 0.9;  ///< of a memory that the user states
constexpr double mebibyte = 1024.0 * 1024.0;
constexpr long cases_merged_a_minute = 100;  ///< far fewer than any machine does

/// What the most demanding of a study's shards is predicted to take, as a dry run of it is.
struct ShardNeeds {
  double time = 0;          ///< s of wall time
  double memory = 0;        ///< bytes
  double merge_memory = 0;  ///< bytes, of the merge of all shards
  std::size_t idle = 0;     ///< shards that have nothing to do

  /// Of the slowest shard, for people.
  std::string time_text() const { return time < 1.0 ? "less than a second" : report::duration(time); }
};

/// What the scripts are written from. Paths are absolute: a job starts in any folder.
struct SlurmStudy {
  EmitArguments asked;  ///< with at least one job; the limits are handed on to every shard
  path program;
  std::size_t cases = 0;
  ShardNeeds needs = {};
};
constexpr std::string_view submit_name = "submit.sh";

bool has_control_character(std::string_view text) {
  return std::ranges::any_of(text, [](unsigned char letter) { return std::iscntrl(letter) != 0; });
}

/// Where the folder of a study's results keeps the scripts and the jobs' logs.
path slurm_folder(const path& output) { return output / "slurm"; }

/// A word that is no trouble in a file's name.
std::string job_name(const SlurmStudy& study) {
  const auto is_trouble = [](unsigned char letter) {
    return letter >= 128 || (std::isalnum(letter) == 0 && letter != '-' && letter != '_');
  };
  std::string name = "launchsafe-" + study.asked.study.stem().string();
  std::ranges::replace_if(name, is_trouble, '-');
  return name;
}

std::string slurm_time(long minutes) {
  constexpr long hour = 60, day = 24 * hour;
  return fmt::format("{}-{:02}:{:02}:00", minutes / day, minutes % day / hour, minutes % hour);
}

/// The folder of the logs inside quotes as sbatch reads them; in its name no letter is a pattern.
std::string log_folder(const SlurmStudy& study) {
  std::string folder = slurm_folder(study.asked.output).string();
  boost::algorithm::replace_all(folder, "\"", "\\\"");
  boost::algorithm::replace_all(folder, "%", "%%");
  return folder;
}

/// The number in the largest unit of which it is a whole multiple, or in the last one, of size 1, as the
/// program reads it: "8GB", "90s".
std::string amount(double value, std::initializer_list<std::pair<double, const char*>> units) {
  for (const auto& [size, name] : units) {
    const double number = std::round(value / size);
    if (number * size == value) return report::exact(number) + name;
  }
  return report::exact(value) + std::prev(units.end())->second;
}

std::string size_text(double bytes) {
  return amount(bytes, {{1e9, "GB"}, {1e6, "MB"}, {1e3, "kB"}, {1, "B"}});
}

/// The user's options as sbatch reads them, one to a line. A merge is one task, and has none of those of an
/// array.
std::string user_options(const SlurmStudy& study, bool of_merge) {
  std::string lines;
  for (std::string option : study.asked.sbatch) {
    if (of_merge && (option.starts_with("--array") || option.starts_with("-a"))) continue;
    // The blanks of "--comment=my study" belong to the value. Where there are quotes, or no "=", it is a line
    // as sbatch has it.
    const std::size_t value = option.find('=') + 1;
    const bool splits = option.find_first_of(" \t#") != std::string::npos;
    const bool is_quoted = option.find_first_of("\"'\\") != std::string::npos;
    if (option.starts_with("--") && value > 0 && splits && !is_quoted) option.insert(value, 1, '"') += '"';
    lines += fmt::format("#SBATCH {}\n", option);
  }
  return lines;
}

/// What a shard asks Slurm for so that it suffices, and the merge, with the needs that this rests on.
Json request_of(const SlurmStudy& study) {
  const EmitArguments& asked = study.asked;
  const ShardNeeds& needs = study.needs;
  const auto rounded_up = [](double number) { return static_cast<long>(std::ceil(number)); };
  const double shard = asked.memory.value_or(memory_factor * needs.memory),
               merge = std::max(asked.memory.value_or(0.0), memory_factor * needs.merge_memory);
  return {{"shards", asked.shards},
          {"jobs", asked.jobs},
          {"memory_MiB", rounded_up(shard / mebibyte)},
          {"merge_memory_MiB", rounded_up(merge / mebibyte)},
          {"time_s", 60 * std::max(least_minutes, rounded_up(time_factor * needs.time / 60.0))},
          {"predicted_time_s", needs.time},
          {"predicted_memory_bytes", needs.memory}};
}

/// Why no script can be written; nothing when one can.
std::optional<std::string> fault_of(const SlurmStudy& study) {
  for (const path& each : {study.program, study.asked.study, study.asked.output})
    if (has_control_character(each.string()))
      return "a path has a control character, such as a line's end; allowed for Slurm: paths without";
  if (study.asked.output.string().find('\\') != std::string::npos)
    return fmt::format(
        "--output: found {}; allowed for Slurm: a folder without a backslash in its path, as Slurm writes no "
        "log there",
        study.asked.output.string());
  for (const std::string& option : study.asked.sbatch)
    if (!option.starts_with('-') || has_control_character(option))
      return fmt::format("--sbatch: found \"{}\"; allowed: options of sbatch such as --partition=long",
                         option);
  return std::nullopt;
}

/// The text depends on what is given alone.
NamedTexts slurm_scripts(const SlurmStudy& study, Json values) {
  const EmitArguments& asked = study.asked;
  values.update(
      {{"folder", shell_quoted(slurm_folder(asked.output).string())},
       {"job", job_name(study)},
       {"status", asked.shards > 1 ? fmt::format("status.$SLURM_ARRAY_TASK_ID-of-{}.json", asked.shards)
                                   : std::string("status.json")},
       {"least_minutes", least_minutes},
       {"logs", log_folder(study)},
       {"predicted_mebibytes", fmt::format("{:.0f}", study.needs.memory / mebibyte)},
       {"memory_factor", fmt::format("{}", memory_factor)},
       {"merge_limit", slurm_time(least_minutes + static_cast<long>(study.cases) / cases_merged_a_minute)},
       {"merge_options", user_options(study, true)},
       {"output", shell_quoted(asked.output.string())},
       {"program", shell_quoted(study.program.string())},
       {"rate", fmt::format("{:.3g}", run::cautious_update_rate / 1e6)},
       {"shard_limit", slurm_time(values["time_s"].get<long>() / 60)},
       {"shard_options", user_options(study, false)},
       {"study", shell_quoted(asked.study.string())},
       {"time", study.needs.time_text()},
       {"time_factor", fmt::format("{:.3g}", time_factor)}});
  if (asked.memory) {
    values["memory"] = size_text(*asked.memory);
    values["memory_for_cases"] = size_text(std::floor(share_for_cases * *asked.memory));
  }
  if (asked.time_limit)
    values["time_limit"] = amount(*asked.time_limit, {{3600, "h"}, {60, "min"}, {1, "s"}});
  return {{"shard.sbatch", told("shard.sbatch", values)},
          {"merge.sbatch", told("merge.sbatch", values)},
          {std::string(submit_name), told("submit.sh", values)}};
}

/// With nothing stored.
ShardNeeds needs_of(const study::StudyFile& file, int shards, int jobs) {
  std::map<int, double> costs;  // of the shards that have something to do
  for (const study::CaseRuns& each : study::case_runs(file, shards))
    for (const study::PlannedRun& run : each.runs) costs[each.shard] += run.cost;
  const int slowest =
      std::ranges::max_element(costs, {}, [](const auto& each) { return each.second; })->first;
  ShardNeeds needs;
  needs.idle = static_cast<std::size_t>(shards) - costs.size();
  // The first shard has the dearest run, which as a rule takes the most memory.
  for (const int shard : {1, slowest}) {
    study::StudyOptions options;
    options.jobs = jobs;
    options.shard = {shard, shards};
    // No measurement, as the machine that submits is not the one that computes, and scripts stay what they
    // were.
    const study::Forecast forecast = study::forecast_study(file, options, run::cautious_update_rate);
    needs.time = std::max(needs.time, forecast.time);
    needs.memory = std::max(needs.memory, forecast.memory);
    // Of all cases, and gnuplot beside it.
    constexpr double of_plots = 24e6;
    const double share = static_cast<double>(forecast.cases) / static_cast<double>(file.cases.size());
    needs.merge_memory =
        forecast.plan_memory + forecast.kept_memory / share + forecast.report_memory + of_plots;
  }
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

ExitCode perform(const EmitArguments& arguments, Console& console) {
  const study::StudyFile file = console.value_of(kinds::read_study(arguments.study));
  console.refuse_any(study::all_out_of_reach(file, {}));
  std::error_code failed;
  SlurmStudy study{arguments, std::filesystem::read_symlink("/proc/self/exe", failed), file.cases.size()};
  for (path* each : {&study.asked.study, &study.asked.output}) *each = absolute_path(*each);
  study.asked.jobs = std::max(1, study.asked.jobs);
  console.refuse_any(fault_of(study));
  console.refuse_any(
      obstacle_in_folder(study.asked.output, file, study_manifest(file, study.asked.jobs), false));
  study.needs = needs_of(file, study.asked.shards, study.asked.jobs);
  const Json request = request_of(study);
  const path folder = slurm_folder(arguments.output);  // as the user named it
  if (std::filesystem::is_symlink(folder))
    console.refuse(
        fmt::format("{} is a link, and nothing is written through one; move it away", folder.string()));
  const NamedTexts scripts = slurm_scripts(study, request);
  write_where_absent(folder, scripts, console);
  // Lets everybody start the script that submits the others; it can be given to a shell all the same.
  using std::filesystem::perms;
  std::filesystem::permissions(folder / submit_name,
                               perms::owner_exec | perms::group_exec | perms::others_exec,
                               std::filesystem::perm_options::add, failed);
  Json facts{{"files", places_of(folder, scripts)},
             {"submit", shell_command({"sh", (folder / submit_name).string()})}};
  facts.update(request);
  console.print_json(facts);
  facts.update({{"minutes", facts["time_s"].get<long>() / 60}, {"time", study.needs.time_text()}});
  console.print_text(told("emit.txt", facts));
  if (study.needs.idle > 0)
    console.remark(
        fmt::format("{} of the {} shards will have nothing to do", study.needs.idle, study.asked.shards));
  return ExitCode::done;
}

}  // namespace

void add_emit(CLI::App& app, CommandLine& line) {
  auto [command, emit] = add_command<EmitArguments>(app, line, "emit");
  add_required(command, "engine", emit.engine)->check(CLI::IsMember({"slurm"}));
  add_required(command, "study", emit.study);
  add_required(command, "-o,--output", emit.output);
  constexpr int most_shards = 10000;
  add_count(command, "--shards", emit.shards, most_shards)->required();
  add_jobs(command, emit.jobs);
  add_amount(command, "--memory", emit.memory, parse_positive<Dimension::memory>);
  add_amount(command, "--time-limit", emit.time_limit, parse_positive<Dimension::duration>);
  add(command, "--sbatch", emit.sbatch)->allow_extra_args(false);
}

}  // namespace launchsafe::app
