// The scripts that run a study on a Slurm cluster: an array of shards, the merge behind it, and what submits
// both.
#pragma once

#include "commands.hpp"
#include "output_folder.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace launchsafe::app {

/// What the most demanding of a study's shards is predicted to take.
struct ShardNeeds {
  double time = 0;          ///< s of wall time
  double memory = 0;        ///< bytes
  double merge_memory = 0;  ///< bytes, of the merge of all shards
  std::size_t idle = 0;     ///< shards that have nothing to do
};

/// What the scripts are written from. Paths are absolute: a job starts in any folder.
struct SlurmStudy {
  EmitArguments asked;  ///< with at least one job; the limits are handed on to every shard
  std::filesystem::path program;
  std::size_t cases = 0;
  double update_rate = 0;  ///< particle updates per second on a core that the needed time rests on
  ShardNeeds needs = {};
};

/// What a shard asks Slurm for, and the merge.
struct SlurmRequest {
  long minutes = 0;
  long mebibytes = 0, merge_mebibytes = 0;
};
SlurmRequest request_of(const SlurmStudy& study);
/// Of the slowest shard, for people.
std::string predicted_time(const SlurmStudy& study);

/// Why no script can be written; nothing when one can.
std::optional<std::string> fault_of(const SlurmStudy& study);

/// Where the folder of a study's results keeps the scripts and the jobs' logs.
std::filesystem::path slurm_folder(const std::filesystem::path& output);
inline constexpr std::string_view submit_name = "submit.sh";
/// shard.sbatch, merge.sbatch, submit.sh. The text depends on what is given alone.
NamedTexts slurm_scripts(const SlurmStudy& study);

}  // namespace launchsafe::app
