#include "slurm_script.hpp"

#include "launchsafe/report/number.hpp"
#include "shell_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <map>
#include <utility>

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
constexpr std::string_view shard_template = R"sh(#!/bin/sh
# A Slurm job array; each task is one of {shards_text} of a launchsafe study. submit.sh submits it. What is finished stays in
# the folder of the results, so that the array may be submitted again and goes on from there.
#
# Time: the slowest shard is predicted to take {time} at {rate} million particle updates per second on a core;
# asked for are {time_factor} times that, {least_minutes} min at least. A minute before the end the program is told to stop, and the task is
# queued again for the rest, unless not one case was finished.
# Memory: {memory_text}
# Ends with 0 when every case has a result or is known to have failed (the merge counts those), 75 when interrupted
# and not queued again, 70 when the machine failed, 2 when the study cannot be run here.
#
#SBATCH --job-name={job}
#SBATCH --array=1-{shards}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task={jobs}
#SBATCH --mem={mebibytes}M
#SBATCH --time={shard_limit}
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --signal=B:USR1@60
#SBATCH --output="{logs}/%x-%a.log"
{shard_options}
program={program}
study={study}
output={output}
run_shard() {
  exec "$program" study "$study" -o "$output" --shard "$SLURM_ARRAY_TASK_ID/{shards}" --jobs {jobs}{limits}
}

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

constexpr std::string_view merge_template = R"sh(#!/bin/sh
# The Slurm job behind the array of shard.sbatch: checks that no case is missing and writes the report. It starts when
# every shard has ended, however it ended.
# Ends as `launchsafe merge` does: 0 done, 4 done but a verdict is indeterminate, 3 when cases failed or are missing.
# The log says which; submit.sh then runs what is missing and merges again.
#
#SBATCH --job-name={job}-merge
#SBATCH --ntasks=1
#SBATCH --cpus-per-task={jobs}
#SBATCH --mem={mebibytes}M
#SBATCH --time={merge_limit}
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output="{logs}/%x.log"
{merge_options}
program={program}
study={study}
output={output}
exec "$program" merge "$study" -o "$output" --jobs {jobs}
)sh";

constexpr std::string_view submit_template = R"sh(#!/bin/sh
# Submits a launchsafe study to Slurm: its shards (shard.sbatch) and, behind them, the merge (merge.sbatch). Prints
# both job numbers. May be run again when both have ended: only what is missing is computed.

folder={folder}

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
echo "submitted: {shards_text} as job $shards, the merge as job $merge"
echo "to watch: squeue --jobs=$shards,$merge; logs in $folder"
)sh";

/// The template with the value of every {name}; other braces are the shell's.
std::string filled_in(std::string_view text, const std::map<std::string, std::string, std::less<>>& values) {
  std::string script;
  for (std::size_t open = text.find('{'); open != std::string_view::npos; open = text.find('{')) {
    const std::size_t close = text.find('}', open);
    const auto value = values.find(text.substr(open + 1, close - open - 1));
    script += text.substr(0, open);
    script += value == values.end() ? "{" : value->second;
    text.remove_prefix(value == values.end() ? open + 1 : close + 1);
  }
  return script.append(text);
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

/// The folder of the logs inside quotes as sbatch reads them; in its name no letter is a pattern.
std::string log_folder(const SlurmStudy& study) {
  std::string folder;
  for (const char letter : slurm_folder(study.output).string()) {
    if (letter == '"') folder += '\\';
    if (letter == '%') folder += '%';
    folder += letter;
  }
  return folder;
}

/// The number in the largest unit of which it is a whole multiple, as the program reads it: "8GB", "90s".
std::string amount(double value, std::initializer_list<std::pair<double, const char*>> units) {
  for (const auto& [size, name] : units) {
    const double number = std::round(value / size);
    if (number * size == value) return report::exact(number) + name;
  }
  return report::exact(value);
}

std::string size_text(double bytes) {
  return amount(bytes, {{1e9, "GB"}, {1e6, "MB"}, {1e3, "kB"}, {1, "B"}});
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

/// The user's options, one to a line. A merge is one task, and has none of those of an array.
std::string user_options(const SlurmStudy& study, bool of_merge) {
  std::string lines;
  for (const std::string& option : study.sbatch) {
    if (of_merge && (option.starts_with("--array") || option.starts_with("-a"))) continue;
    lines += fmt::format("#SBATCH {}\n", user_option(option));
  }
  return lines;
}

std::string memory_text(const SlurmStudy& study) {
  if (study.memory_limit) {
    return fmt::format("{} as given, nine tenths of it for the cases that run side by side.",
                       size_text(*study.memory_limit));
  }
  return fmt::format(
      "{:.1f} MiB are predicted for the cases that run side by side; asked for are a quarter more and {} "
      "MiB.",
      study.memory / mebibyte, spare_mebibytes);
}

/// The limits of a shard, as options of the program.
std::string limits_of(const SlurmStudy& study) {
  std::string options;
  if (study.memory_limit)
    options += " --memory " + size_text(std::floor(share_for_cases * *study.memory_limit));
  if (study.time_limit)
    options += " --time-limit " + amount(*study.time_limit, {{3600, "h"}, {60, "min"}, {1, "s"}});
  return options;
}

}  // namespace

std::string count_text(int count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

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
  const SlurmRequest request = request_of(study);
  const std::map<std::string, std::string, std::less<>> values{
      {"folder", shell_quoted(slurm_folder(study.output).string())},
      {"job", job_name(study)},
      {"jobs", std::to_string(study.jobs)},
      {"least_minutes", std::to_string(least_minutes)},
      {"limits", limits_of(study)},
      {"logs", log_folder(study)},
      {"mebibytes", std::to_string(request.mebibytes)},
      {"memory_text", memory_text(study)},
      {"merge_limit", slurm_time(least_minutes + static_cast<long>(study.cases) / cases_merged_a_minute)},
      {"merge_options", user_options(study, true)},
      {"output", shell_quoted(study.output.string())},
      {"program", shell_quoted(study.program.string())},
      {"rate", fmt::format("{:.3g}", study.update_rate / 1e6)},
      {"shard_limit", slurm_time(request.minutes)},
      {"shard_options", user_options(study, false)},
      {"shards", std::to_string(study.shards)},
      {"shards_text", count_text(study.shards, "shard")},
      {"study", shell_quoted(study.study.string())},
      {"time", predicted_time(study)},
      {"time_factor", fmt::format("{:.3g}", time_factor)}};
  return {{"shard.sbatch", filled_in(shard_template, values)},
          {"merge.sbatch", filled_in(merge_template, values)},
          {std::string(submit_name), filled_in(submit_template, values)}};
}

}  // namespace launchsafe::app
