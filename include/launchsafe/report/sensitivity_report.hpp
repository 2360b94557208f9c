// A sensitivity study as tables, a page, JSON and pictures. Nothing in them differs between two runs of the
// same study: no times, rates, dates or hosts.
#pragma once

#include "launchsafe/report/report.hpp"
#include "launchsafe/study/sensitivity.hpp"

#include <string>
#include <vector>

namespace launchsafe::report {

/// Which inputs matter, as far as the intervals tell them apart; what cannot be told; what failed.
std::string answer(const study::SensitivityResult& result);

/// A row for every input: its distribution, and indices (or elementary effects) with their intervals. Method,
/// N, design, seed and confidence are in the notes; so is the reason where an output has no indices.
Table sensitivity_table(const study::SensitivityResult& result, const study::OutputSensitivity& output);
/// All outputs below each other, for other programs.
Table sensitivity_table(const study::SensitivityResult& result);
/// A row for every evaluation: its inputs, outputs and failure.
Table evaluation_table(const study::SensitivityResult& result);

nlohmann::ordered_json to_json(const study::SensitivityResult& result);

/// First and total order of every input with their intervals, or mu* against sigma.
Plot sensitivity_plot(const study::SensitivityResult& result, const study::OutputSensitivity& output);

/// The whole report, with what is printed on a terminal and every file.
Report report_of(const study::SensitivityResult& result);

}  // namespace launchsafe::report
