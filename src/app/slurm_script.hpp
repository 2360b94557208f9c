// The scripts that run a study on a Slurm cluster: an array of shards, the merge behind it, and what submits
// both.
#pragma once

#include "output_folder.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace launchsafe::app {

/// What the scripts are written from. Paths are absolute: a job starts in any folder.
struct SlurmStudy {
  std::filesystem::path program, study, output;
  std::size_t cases = 0;
  int shards = 1;
  int jobs = 1;                        ///< threads of a shard
  double time = 0;                     ///< s, predicted, of the slowest shard
  double memory = 0;                   ///< bytes, predicted, of the shard that takes most
  double update_rate = 0;              ///< particle updates per second on a core that `time` rests on
  std::optional<double> memory_limit;  ///< bytes; handed on to every shard
  std::optional<double> time_limit;    ///< s of one case; handed on to every shard
  std::vector<std::string> sbatch;     ///< further options, one to a line
};

/// What a shard asks Slurm for.
struct SlurmRequest {
  long minutes = 0;
  long mebibytes = 0;
};
SlurmRequest request_of(const SlurmStudy& study);
/// The slowest shard's, for people.
std::string predicted_time(const SlurmStudy& study);
/// "1 shard", "20 shards".
std::string count_text(int count, std::string_view what);

/// Why no script can be written; nothing when one can.
std::optional<std::string> fault_of(const SlurmStudy& study);

/// Where the folder of a study's results keeps the scripts and the jobs' logs.
std::filesystem::path slurm_folder(const std::filesystem::path& output);
inline constexpr std::string_view submit_name = "submit.sh";
/// shard.sbatch, merge.sbatch, submit.sh. The text depends on what is given alone.
NamedTexts slurm_scripts(const SlurmStudy& study);

}  // namespace launchsafe::app
