// A critical-gap study as tables, pages, JSON and a picture.
#pragma once

#include "launchsafe/report/report.hpp"
#include "launchsafe/study/critical_gap.hpp"

#include <string>

namespace launchsafe::report {

/// The answer in a sentence or two: "Critical gap 0.0395 cm ...", a bound, or why there is none.
std::string answer(const study::CriticalGapResult& result);

/// A row for every gap of every case: what is printed on stdout.
Table verdict_table(const study::CriticalGapResult& result);
/// Maximum and early temperatures against the published ones; without rows where there are none.
Table comparison_table(const study::CriticalGapResult& result);
/// Critical gap of every case, with bracket and confirmation.
Table critical_gap_table(const study::CriticalGapResult& result);
/// The study's cited limits beside the critical gaps of its cases; without rows where it cites none.
Table cited_limit_table(const study::CriticalGapResult& result);
/// What the skin took from the air of every gap of every case, and what follows from it.
/// Highest temperatures and critical gaps under the reservoir and under the film of air, by name; no rows
/// where the study's own air is no reservoir.
Table air_model_table(const study::CriticalGapResult& result);
Table air_energy_table(const study::CriticalGapResult& result);
/// Lines of one case and their residuals.
Table fit_table(const study::CaseOutcome& outcome);
/// Status, energy drift, limiters and speed of every run.
Table run_table(const study::CriticalGapResult& result);

/// One object: critical_gap, verdicts, fit, timing, and cases where there are several.
nlohmann::ordered_json to_json(const study::CriticalGapResult& result);
/// Maximum temperature against gap.
Plot temperature_plot(const study::CriticalGapResult& result);

/// The whole report, with what is printed on a terminal and every file.
Report report_of(const study::CriticalGapResult& result);

}  // namespace launchsafe::report
