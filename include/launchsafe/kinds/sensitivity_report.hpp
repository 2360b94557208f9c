// A sensitivity study as tables, a page, JSON and pictures. Nothing in them differs between two runs of the
// same study: no times, rates, dates or hosts.
#pragma once

#include "launchsafe/kinds/sensitivity.hpp"
#include "launchsafe/report/report.hpp"

#include <string>
#include <vector>

namespace launchsafe::kinds {

/// Which inputs matter, as far as the intervals tell them apart; what cannot be told; what failed.
std::string answer(const SensitivityResult& result);

/// A row for every input: its distribution, and indices (or elementary effects) with their intervals. Method,
/// N, design, seed and confidence are in the notes; so is the reason where an output has no indices.
report::Table sensitivity_table(const SensitivityResult& result, const OutputSensitivity& output);
/// All outputs below each other, for other programs.
report::Table sensitivity_table(const SensitivityResult& result);
/// A row for every output: its mean and standard deviation, and why it has no indices where it has none.
report::Table output_table(const SensitivityResult& result);
/// A row for every evaluation: its inputs, outputs and failure.
report::Table evaluation_table(const SensitivityResult& result);

/// First and total order of every input with their intervals, or mu* against sigma.
report::Plot sensitivity_plot(const SensitivityResult& result, const OutputSensitivity& output);

/// The whole report, with what is printed on a terminal and every file.
report::Report report_of(const SensitivityResult& result);

}  // namespace launchsafe::kinds
