// A critical-gap study as tables, pages, JSON and a picture.
#pragma once

#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/report/report.hpp"

#include <string>

namespace launchsafe::kinds {

/// The answer in a sentence or two: "Critical gap 0.0395 cm ...", a bound, or why there is none.
std::string answer(const CriticalGapResult& result);

/// A row for every gap of every case: what is printed on stdout.
report::Table verdict_table(const CriticalGapResult& result);
/// Maximum and early temperatures against the published ones; without rows where there are none.
report::Table comparison_table(const CriticalGapResult& result);
/// Critical gap of every case, with bracket and confirmation.
report::Table critical_gap_table(const CriticalGapResult& result);
/// The study's cited limits beside the critical gaps of its cases; without rows where it cites none.
report::Table cited_limit_table(const CriticalGapResult& result);
/// What the complete coupled runs came to that confirm critical gaps.
report::Table coupled_run_table(const CriticalGapResult& result);
/// Highest temperatures and critical gaps under the reservoir and under the film of air, by name; no rows
/// where the study's own air is no reservoir.
report::Table air_model_table(const CriticalGapResult& result);
/// What the skin took from the air of every gap of every case, and what follows from it.
report::Table air_energy_table(const CriticalGapResult& result);
/// Lines of one case and their residuals.
report::Table fit_table(const study::CaseOutcome& outcome);
/// Status, energy drift, limiters and speed of every run.
report::Table run_table(const CriticalGapResult& result);

/// Maximum temperature against gap.
report::Plot temperature_plot(const CriticalGapResult& result);

/// The whole report, with what is printed on a terminal and every file.
report::Report report_of(const CriticalGapResult& result);

}  // namespace launchsafe::kinds
