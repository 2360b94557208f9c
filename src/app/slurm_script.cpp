#include "slurm_script.hpp"

#include "built_in_texts.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/page_texts.hpp"
#include "shell_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <iterator>

namespace launchsafe::app {
namespace {

constexpr double time_factor = 3.0;
constexpr long least_minutes = 10;
constexpr double memory_factor = 1.3;
constexpr double share_for_cases = 0.9;  ///< of a memory that the user states
constexpr double mebibyte = 1024.0 * 1024.0;
constexpr long cases_merged_a_minute = 100;  ///< far fewer than any machine does

bool has_control_character(std::string_view text) {
  return std::any_of(text.begin(), text.end(),
                     [](unsigned char letter) { return std::iscntrl(letter) != 0; });
}

/// A word that is no trouble in a file's name.
std::string job_name(const SlurmStudy& study) {
  const auto is_trouble = [](unsigned char letter) {
    return letter >= 128 || (std::isalnum(letter) == 0 && letter != '-' && letter != '_');
  };
  std::string name = "launchsafe-" + study.asked.study.stem().string();
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
  for (const char letter : slurm_folder(study.asked.output).string()) {
    if (letter == '"') folder += '\\';
    if (letter == '%') folder += '%';
    folder += letter;
  }
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
  for (const std::string& option : study.asked.sbatch) {
    if (of_merge && (option.starts_with("--array") || option.starts_with("-a"))) continue;
    lines += fmt::format("#SBATCH {}\n", user_option(option));
  }
  return lines;
}

std::string memory_text(const SlurmStudy& study) {
  if (study.asked.memory) {
    return fmt::format("{} as given, nine tenths of it for the cases that run side by side.",
                       size_text(*study.asked.memory));
  }
  return fmt::format(
      "{:.0f} MiB are predicted for the program, its plan and the cases that run side by side; asked for are "
      "{} "
      "times that.",
      study.needs.memory / mebibyte, memory_factor);
}

/// The limits of a shard, as options of the program.
std::string limits_of(const SlurmStudy& study) {
  std::string options;
  if (study.asked.memory)
    options += " --memory " + size_text(std::floor(share_for_cases * *study.asked.memory));
  if (study.asked.time_limit)
    options += " --time-limit " + amount(*study.asked.time_limit, {{3600, "h"}, {60, "min"}, {1, "s"}});
  return options;
}

}  // namespace

SlurmRequest request_of(const SlurmStudy& study) {
  const auto rounded_up = [](double number) { return static_cast<long>(std::ceil(number)); };
  const long minutes = std::max(least_minutes, rounded_up(time_factor * study.needs.time / 60.0));
  const auto mebibytes = [&](double bytes) { return rounded_up(bytes / mebibyte); };
  const double shard = study.asked.memory.value_or(memory_factor * study.needs.memory);
  const double merge = memory_factor * study.needs.merge_memory;
  return {minutes, mebibytes(shard), mebibytes(std::max(study.asked.memory.value_or(0.0), merge))};
}

std::optional<std::string> fault_of(const SlurmStudy& study) {
  for (const std::filesystem::path& path : {study.program, study.asked.study, study.asked.output}) {
    if (!has_control_character(path.string())) continue;
    return "a path has a control character, such as a line's end; allowed for Slurm: paths without";
  }
  if (study.asked.output.string().find('\\') != std::string::npos) {
    return fmt::format(
        "--output: found {}; allowed for Slurm: a folder without a backslash in its path, as Slurm writes no "
        "log there",
        study.asked.output.string());
  }
  for (const std::string& option : study.asked.sbatch) {
    if (option.starts_with('-') && !has_control_character(option)) continue;
    return fmt::format("--sbatch: found \"{}\"; allowed: options of sbatch such as --partition=long", option);
  }
  return std::nullopt;
}

std::string predicted_time(const SlurmStudy& study) {
  return study.needs.time < 1.0 ? "less than a second" : report::duration(study.needs.time);
}

std::filesystem::path slurm_folder(const std::filesystem::path& output) { return output / "slurm"; }

NamedTexts slurm_scripts(const SlurmStudy& study) {
  const SlurmRequest request = request_of(study);
  const report::Row values{
      {"folder", shell_quoted(slurm_folder(study.asked.output).string())},
      {"job", job_name(study)},
      {"status", study.asked.shards > 1
                     ? fmt::format("status.$SLURM_ARRAY_TASK_ID-of-{}.json", study.asked.shards)
                     : std::string("status.json")},
      {"jobs", std::to_string(study.asked.jobs)},
      {"least_minutes", std::to_string(least_minutes)},
      {"limits", limits_of(study)},
      {"logs", log_folder(study)},
      {"mebibytes", std::to_string(request.mebibytes)},
      {"memory_text", memory_text(study)},
      {"merge_limit", slurm_time(least_minutes + static_cast<long>(study.cases) / cases_merged_a_minute)},
      {"merge_mebibytes", std::to_string(request.merge_mebibytes)},
      {"merge_options", user_options(study, true)},
      {"output", shell_quoted(study.asked.output.string())},
      {"program", shell_quoted(study.program.string())},
      {"rate", fmt::format("{:.3g}", study.update_rate / 1e6)},
      {"shard_limit", slurm_time(request.minutes)},
      {"shard_options", user_options(study, false)},
      {"shards", std::to_string(study.asked.shards)},
      {"shards_text", report::counted(study.asked.shards, "shard")},
      {"study", shell_quoted(study.asked.study.string())},
      {"time", predicted_time(study)},
      {"time_factor", fmt::format("{:.3g}", time_factor)}};
  return {{"shard.sbatch", report::filled(shard_template, {&values})},
          {"merge.sbatch", report::filled(merge_template, {&values})},
          {std::string(submit_name), report::filled(submit_template, {&values})}};
}

}  // namespace launchsafe::app
