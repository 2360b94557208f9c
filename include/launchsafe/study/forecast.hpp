// What a study would do, before it does it: which mechanical runs it needs, which of them are stored, what
// the rest will cost.
#pragma once

#include "launchsafe/study/options.hpp"
#include "launchsafe/study/study_file.hpp"

namespace launchsafe::study {

/// One mechanical run, with the cases of the study that share it, or its run with a raised load.
struct ForecastRun {
  std::string label;      ///< of the first of its cases
  std::string hash;       ///< names its file in the store
  std::size_t cases = 0;  ///< 0 for the run with a raised load that belongs to the run before it
  std::int64_t particles = 0, steps = 0;
  double memory = 0;  ///< bytes
  double kept = 0;  ///< bytes of its trace and checkpoints, of which a study in detail has some till its end
  double time = 0;  ///< s on a core, predicted; 0 for one that does not run
  double disk = 0;  ///< bytes of its file, before compression
  int shard = 1;
  bool stored = false;    ///< its result is there
  bool given_up = false;  ///< it was timed out, or failed and may not be computed: that is its row
  bool refused = false;   ///< given up because it is out of reach (run::out_of_reach)
  std::string why;        ///< why it is used again or has to run
};

struct Forecast {
  std::size_t cases = 0;          ///< of the shard asked for
  std::size_t run_count = 0;      ///< mechanical runs of these
  std::vector<ForecastRun> runs;  ///< of them; of many some, evenly spread, from which all else is estimated
  /// Of all runs, what is the case for so many of `runs`.
  std::size_t of_all(std::size_t runs_like_that) const;
  /// Coupled runs, and launches of gaps that close, that may follow, at most.
  std::size_t confirmations = 0;
  double update_rate = 0;        ///< particle updates per second on a core that the prediction rests on
  std::size_t learned_from = 0;  ///< recorded runs that the rate was learned from; 0: measured now
  double time = 0;               ///< s of wall time, of all that is to run
  double confirmation_time = 0;  ///< s of it, at most, of what follows launches that are to run
  double plan_memory = 0;        ///< bytes of the program with its plan of the whole study
  double kept_memory = 0;        ///< bytes that are kept till the end of the cases asked for
  double report_memory = 0;      ///< bytes of the report of all cases, besides
  double memory = 0;  ///< bytes at most: as the cases run side by side, or as the report is written
  double disk = 0;    ///< bytes, rather too many, of the files of all that is to run, coupled runs too
  int jobs = 1;
};

/// Why a study is not begun at all: every one of its cases is out of reach. The error of the first.
std::optional<scene::InputError> all_out_of_reach(const StudyFile& study, const run::Reach& reach);

/// `update_rate` (particle updates per second on a core) is used where no recorded run knows better.
/// `most_cases`: of so many the runs are planned.
Forecast forecast_study(const StudyFile& study, const StudyOptions& options, double update_rate,
                        std::size_t most_cases = 1000);

}  // namespace launchsafe::study
