// The outcome of a study of any kind, in the words of the command line.
#pragma once

#include "console.hpp"
#include "launchsafe/report/report.hpp"
#include "launchsafe/study/accuracy.hpp"
#include "launchsafe/study/calibration.hpp"
#include "launchsafe/study/critical_gap.hpp"
#include "launchsafe/study/sensitivity.hpp"
#include "launchsafe/study/stability.hpp"
#include "launchsafe/study/sweep.hpp"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <variant>
#include <vector>

namespace launchsafe::app {

using StudyResult = std::variant<study::CriticalGapResult, study::CalibrationResult, study::SweepResult,
                                 study::SensitivityResult, study::AccuracyResult, study::StabilityResult>;

/// Runs a study as its kind asks.
StudyResult run_study(const study::StudyFile& file, const study::StudyOptions& options);

bool interrupted(const StudyResult& result);
const study::Timing& timing_of(const StudyResult& result);
bool any_indeterminate(const StudyResult& result);

/// In the order of the cases; without those that another shard runs.
std::vector<Failure> failures_of(const StudyResult& result);

report::Report report_of(const StudyResult& result);
nlohmann::ordered_json to_json(const StudyResult& result);

/// "ran 12 mechanical runs, re-used 3; ...": runs, rate, wall time.
std::string timing_text(const study::Timing& timing);

}  // namespace launchsafe::app
