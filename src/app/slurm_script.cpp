#include "slurm_script.hpp"

#include "launchsafe/report/number.hpp"
#include "shell_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <span>

namespace launchsafe::app {
namespace {

constexpr double time_factor = 3.0;
constexpr long least_minutes = 10;
constexpr double memory_factor = 1.25;
constexpr long spare_mebibytes = 512;
constexpr double share_for_cases = 0.9;  ///< of a memory that the user states
constexpr double mebibyte = 1024.0 * 1024.0;
constexpr long cases_merged_a_minute = 100;  ///< far fewer than any machine does

/// Runs the shard, tells it when the time is nearly up, and puts the task back into the queue where the
/// program says that it was interrupted and nobody has cancelled it.
constexpr std::string_view shard_body = R"sh(
task="${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID"
stored() { find "$output/cases" -name "*.h5" 2>/dev/null | wc -l; }
stored_before=$(stored)
echo "task $task on $(hostname), start $((${SLURM_RESTART_COUNT:-0} + 1))"

# Slurm sends USR1 to this script alone when the time is nearly up, TERM to the whole job when it is cancelled. Either
# way the program ends by itself.
signalled=
time_is_up=
trap 'signalled=yes; time_is_up=yes; kill -TERM "$running"' USR1
trap 'signalled=yes' TERM
run_shard &
running=$!
wait "$running"
code=$?
while [ -n "$signalled" ] && [ "$code" -gt 128 ]; do  # the signal ended the wait, not the program
  signalled=
  wait "$running"
  code=$?
done

case $code in
  3)
    echo "some cases failed; the merge names them"
    code=0
    ;;
  75)
    state=$(squeue --noheader --jobs="$task" --format=%T)
    if [ "$state" != RUNNING ]; then
      echo "interrupted, and not queued again: the task is ${state:-unknown to squeue}"
    elif [ -n "$time_is_up" ] && [ "$(stored)" -eq "$stored_before" ]; then
      echo "interrupted, and not queued again: no case was finished in the time, so raise --time in shard.sbatch"
    else
      echo "interrupted; queued again"
      scontrol requeue "$task"
    fi
    ;;
esac
exit "$code"
)sh";

constexpr std::string_view merge_remarks = R"sh(#!/bin/sh
# The Slurm job behind the array of shard.sbatch: checks that no case is missing and writes the report. It starts when
# every shard has ended, however it ended.
# Ends as `launchsafe merge` does: 0 done, 4 done but a verdict is indeterminate, 3 when cases failed or are missing.
# The log says which; submit.sh then runs what is missing and merges again.
#
)sh";

constexpr std::string_view submit_remarks = R"sh(#!/bin/sh
# Submits a launchsafe study to Slurm: its shards (shard.sbatch) and, behind them, the merge (merge.sbatch). Prints
# both job numbers. May be run again when both have ended: only what is missing is computed.

)sh";

constexpr std::string_view submit_body = R"sh(
set -eu
fail() {
  echo "submit.sh: $1" >&2
  exit 70
}
command -v sbatch >/dev/null || fail "sbatch is not there; run this on a machine from which Slurm jobs are submitted"

shards=$(sbatch --parsable "$folder/shard.sbatch") || fail "Slurm took no job"
shards=${shards%%;*}  # "ID;CLUSTER" where there are several clusters
merge=$(sbatch --parsable --dependency="afterany:$shards" "$folder/merge.sbatch") ||
  fail "Slurm took the shards (job $shards) but not the merge; when they have ended: sbatch '$folder/merge.sbatch'"
merge=${merge%%;*}
)sh";

/// Those of a job's options that a merge must not have: it is one task.
bool is_for_the_array(std::string_view option) {
  return option.starts_with("--array") || option.starts_with("-a");
}

bool has_control_character(std::string_view text) {
  return std::any_of(text.begin(), text.end(),
                     [](unsigned char letter) { return std::iscntrl(letter) != 0; });
}

/// A word that is no trouble in a file's name.
std::string job_name(const SlurmStudy& study) {
  const auto is_trouble = [](unsigned char letter) {
    return letter >= 128 || (std::isalnum(letter) == 0 && letter != '-' && letter != '_');
  };
  std::string name = "launchsafe-" + study.study.stem().string();
  std::replace_if(name.begin(), name.end(), is_trouble, '-');
  return name;
}

std::string slurm_time(long minutes) {
  constexpr long hour = 60, day = 24 * hour;
  return fmt::format("{}-{:02}:{:02}:00", minutes / day, minutes % day / hour, minutes % hour);
}

/// The log's name in quotes as sbatch reads them. In the folder's name no letter is a pattern.
std::string log_option(const SlurmStudy& study, std::string_view pattern) {
  std::string folder;
  for (const char letter : slurm_folder(study.output).string()) {
    if (letter == '"') folder += '\\';
    if (letter == '%') folder += '%';
    folder += letter;
  }
  return fmt::format("--output=\"{}/{}\"", folder, pattern);
}

struct Unit {
  double size;
  std::string_view name;
};
constexpr std::array<Unit, 4> slurm_sizes{{{1e9, "GB"}, {1e6, "MB"}, {1e3, "kB"}, {1, "B"}}};
constexpr std::array<Unit, 3> slurm_durations{{{3600, "h"}, {60, "min"}, {1, "s"}}};

/// The number in the largest unit of which it is a whole multiple, as the program reads it: "8GB", "90s".
std::string amount(double value, std::span<const Unit> units) {
  for (const Unit& unit : units) {
    const double number = std::round(value / unit.size);
    if (number * unit.size == value) return fmt::format("{}{}", report::exact(number), unit.name);
  }
  return report::exact(value);
}

std::string count_of_shards(const SlurmStudy& study) {
  return fmt::format("{} shard{}", study.shards, study.shards == 1 ? "" : "s");
}

std::string directives(const std::vector<std::string>& options) {
  std::string text;
  for (const std::string& option : options) text += fmt::format("#SBATCH {}\n", option);
  return text;
}

/// A user's option as sbatch reads it: the blanks of "--comment=my study" belong to the value. Where there
/// are quotes, or no "=", it is a line as sbatch has it.
std::string user_option(const std::string& option) {
  const std::size_t value = option.find('=') + 1;
  const bool splits = option.find_first_of(" \t#") != std::string::npos;
  const bool is_quoted = option.find_first_of("\"'\\") != std::string::npos;
  if (!option.starts_with("--") || value == 0 || !splits || is_quoted) return option;
  return fmt::format("{}\"{}\"", option.substr(0, value), option.substr(value));
}

std::string variable(std::string_view name, std::string_view value) {
  return fmt::format("{}={}\n", name, shell_quoted(value));
}

std::string paths(const SlurmStudy& study) {
  return variable("program", study.program.string()) + variable("study", study.study.string()) +
         variable("output", study.output.string());
}

std::string memory_remark(const SlurmStudy& study) {
  if (study.memory_limit) {
    return fmt::format("{} as given, nine tenths of it for the cases that run side by side.",
                       amount(*study.memory_limit, slurm_sizes));
  }
  return fmt::format(
      "{:.1f} MiB are predicted for the cases that run side by side; asked for are a quarter more and {} "
      "MiB.",
      study.memory / mebibyte, spare_mebibytes);
}

std::string shard_remarks(const SlurmStudy& study) {
  return fmt::format(R"sh(#!/bin/sh
# A Slurm job array; each task is one of {} of a launchsafe study. submit.sh submits it. What is finished stays in
# the folder of the results, so that the array may be submitted again and goes on from there.
#
# Time: the slowest shard is predicted to take {} at {:.3g} million particle updates per second on a core;
# asked for are {:.3g} times that, {} min at least. A minute before the end the program is told to stop, and the task is
# queued again for the rest, unless not one case was finished.
# Memory: {}
# Ends with 0 when every case has a result or is known to have failed (the merge counts those), 75 when interrupted
# and not queued again, 70 when the machine failed, 2 when the study cannot be run here.
#
)sh",
                     count_of_shards(study), predicted_time(study), study.update_rate / 1e6, time_factor,
                     least_minutes, memory_remark(study));
}

std::string shard_directives(const SlurmStudy& study) {
  const SlurmRequest request = request_of(study);
  std::vector<std::string> options{
      "--job-name=" + job_name(study),
      fmt::format("--array=1-{}", study.shards),
      "--ntasks=1",
      fmt::format("--cpus-per-task={}", study.jobs),
      fmt::format("--mem={}M", request.mebibytes),
      "--time=" + slurm_time(request.minutes),
      "--requeue",
      "--open-mode=append",
      "--signal=B:USR1@60",
      log_option(study, "%x-%a.log"),
  };
  for (const std::string& option : study.sbatch) options.push_back(user_option(option));
  return directives(options);
}

std::string shard_command(const SlurmStudy& study) {
  std::string command = fmt::format(
      R"sh(exec "$program" study "$study" -o "$output" --shard "$SLURM_ARRAY_TASK_ID/{}" --jobs {})sh",
      study.shards, study.jobs);
  if (study.memory_limit) {
    command += " --memory " + amount(std::floor(share_for_cases * *study.memory_limit), slurm_sizes);
  }
  if (study.time_limit) command += " --time-limit " + amount(*study.time_limit, slurm_durations);
  return fmt::format("run_shard() {{\n  {}\n}}\n", command);
}

std::string shard_script(const SlurmStudy& study) {
  return shard_remarks(study) + shard_directives(study) + "\n" + paths(study) + shard_command(study) +
         std::string(shard_body);
}

std::string merge_directives(const SlurmStudy& study) {
  const long minutes = least_minutes + static_cast<long>(study.cases) / cases_merged_a_minute;
  std::vector<std::string> options{
      "--job-name=" + job_name(study) + "-merge",
      "--ntasks=1",
      fmt::format("--cpus-per-task={}", study.jobs),
      fmt::format("--mem={}M", request_of(study).mebibytes),
      "--time=" + slurm_time(minutes),
      "--requeue",
      "--open-mode=append",
      log_option(study, "%x.log"),
  };
  for (const std::string& option : study.sbatch) {
    if (!is_for_the_array(option)) options.push_back(user_option(option));
  }
  return directives(options);
}

std::string merge_script(const SlurmStudy& study) {
  return std::string(merge_remarks) + merge_directives(study) + "\n" + paths(study) +
         fmt::format(R"sh(exec "$program" merge "$study" -o "$output" --jobs {})sh", study.jobs) + "\n";
}

std::string submit_script(const SlurmStudy& study) {
  return std::string(submit_remarks) + variable("folder", slurm_folder(study.output).string()) +
         std::string(submit_body) +
         fmt::format("echo \"submitted: {} as job $shards, the merge as job $merge\"\n",
                     count_of_shards(study)) +
         "echo \"to watch: squeue --jobs=$shards,$merge; logs in $folder\"\n";
}

}  // namespace

SlurmRequest request_of(const SlurmStudy& study) {
  const auto rounded_up = [](double number) { return static_cast<long>(std::ceil(number)); };
  const long minutes = std::max(least_minutes, rounded_up(time_factor * study.time / 60.0));
  if (study.memory_limit) return {minutes, rounded_up(*study.memory_limit / mebibyte)};
  return {minutes, rounded_up(memory_factor * study.memory / mebibyte) + spare_mebibytes};
}

std::optional<std::string> fault_of(const SlurmStudy& study) {
  for (const std::filesystem::path& path : {study.program, study.study, study.output}) {
    if (!has_control_character(path.string())) continue;
    return "a path has a control character, such as a line's end; allowed for Slurm: paths without";
  }
  if (study.output.string().find('\\') != std::string::npos) {
    return fmt::format(
        "--output: found {}; allowed for Slurm: a folder without a backslash in its path, as Slurm writes no "
        "log there",
        study.output.string());
  }
  for (const std::string& option : study.sbatch) {
    if (option.starts_with('-') && !has_control_character(option)) continue;
    return fmt::format("--sbatch: found \"{}\"; allowed: options of sbatch such as --partition=long", option);
  }
  return std::nullopt;
}

std::string predicted_time(const SlurmStudy& study) {
  return study.time < 1.0 ? "less than a second" : report::duration(study.time);
}

std::filesystem::path slurm_folder(const std::filesystem::path& output) { return output / "slurm"; }

std::vector<SlurmScript> slurm_scripts(const SlurmStudy& study) {
  return {{"shard.sbatch", shard_script(study)},
          {"merge.sbatch", merge_script(study)},
          {std::string(submit_name), submit_script(study)}};
}

}  // namespace launchsafe::app
