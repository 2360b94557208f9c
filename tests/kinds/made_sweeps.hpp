// Sweeps over the synthetic launch, and what tests ask of them.
#pragma once

#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/study/case_rows.hpp"
#include "launchsafe/study/run_cases.hpp"
#include "store/temporary_folder.hpp"
#include "study/synthetic_launch.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>
#include <sstream>

namespace launchsafe::study {

using kinds::CriticalGapResult, kinds::run_critical_gap;

inline bool any_failed(const std::vector<CaseRow>& rows) {
  return !std::ranges::all_of(rows, &CaseRow::completed);
}

/// What varies: keys and their values.
using VariedKeys = std::vector<std::pair<std::string, std::string>>;

/// A sweep that is judged as one of many cases, however few it has.
inline StudyFile sweep_of(const std::string& gaps, const VariedKeys& varied,
                          const std::string& largest_gap = "0.2 cm", const std::string& more = {},
                          const std::string& first = {}) {
  return lean_study_of(first + "largest_gap = \"" + largest_gap + "\"\n" + critical_text +
                       (gaps.empty() ? gaps : "gaps = \"" + gaps + "\"\n") + vary(varied) +
                       synthetic_constants + more);
}

/// Two pressures, two crack radii, and two activation temperatures, which are no matter of the mechanics.
inline VariedKeys two_by_two_by_two(const std::string& activation = "21200, 22200 K") {
  return {{"peak_pressure", "400, 496 MPa"},
          {"crack_radius", "10, 50 um"},
          {"kinetics.activation_temperature", activation}};
}
inline StudyFile two_by_two_by_two_of(const std::string& activation = "21200, 22200 K") {
  return sweep_of("0, 0.02, 0.04 cm", two_by_two_by_two(activation));
}

/// The synthetic launch, counting its runs by peak pressure.
class Counting {
 public:
  Runners runners() {
    Runners runners = synthetic_runners();
    runners.mechanics = [this](const scene::Scene& scene, const run::RunOptions&) {
      {
        const std::lock_guard lock(mutex_);
        ++runs_[scene.load.peak];
      }
      return outcome(scene);
    };
    return runners;
  }
  StudyOptions options(int jobs = 2) {
    StudyOptions options;
    options.jobs = jobs;
    options.runners = runners();
    return options;
  }
  int runs() const {
    int sum = 0;
    for (const auto& [peak, count] : runs_) sum += count;
    return sum;
  }
  int runs_at(double peak) const { return runs_.contains(peak) ? runs_.at(peak) : 0; }

  std::function<run::MechanicsResult(const scene::Scene&)> outcome = [](const scene::Scene& scene) {
    return synthetic_mechanics(scene);
  };

 private:
  std::mutex mutex_;
  std::map<double, int> runs_;
};

/// All that a row has to say, in all digits.
inline std::string line_of(const CaseRow& row) {
  std::string line = fmt::format("{} {} {} {}", row.critical.value, row.bounds.at_least, row.bounds.at_most,
                                 row.failure + row.incomplete);
  for (const CauseShare& each : row.causes) line += fmt::format(" {} {}", each.shorter, each.longer);
  for (const GapRow& gap : row.gaps)
    line += fmt::format("; {} {} {}", gap.maximum.temperature, gap.uncertainty, reason_text(row, gap));
  return line;
}

inline std::vector<std::string> lines_of(const CriticalGapResult& result) {
  return of_each(result.rows, line_of);
}

/// Sweeps with a store in a folder of the test's own.
class StoredSweep : public launchsafe::testing::TemporaryFolder {
 protected:
  CriticalGapResult run(const StudyFile& study, Counting& counting, Shard shard = {},
                        double time_limit = std::numeric_limits<double>::infinity()) {
    const auto store = store::CaseStore::open(folder() / "results");
    StudyOptions options = counting.options();
    options.store = store.get();
    options.shard = shard;
    options.time_limit = time_limit;
    CriticalGapResult result = run_critical_gap(study, options);
    remarks_ = store->remarks();
    EXPECT_FALSE(store->flush());
    return result;
  }
  Estimate estimate_in_store(const StudyFile& study) {
    const auto store = store::CaseStore::open(folder() / "results");
    StudyOptions options;
    options.jobs = 2;
    options.store = store.get();
    return estimate_of(study, options);
  }
  std::vector<std::filesystem::path> case_files() const {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder() / "results" / "cases")) {
      if (entry.path().extension() == ".h5") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
  }
  std::vector<std::string> remarks_;
};

}  // namespace launchsafe::study
