// A sensitivity study as tables, a page, JSON and pictures. Nothing in them differs between two runs of the
// same study: no times, rates, dates or hosts.
#pragma once

#include "launchsafe/report/drawing_limits.hpp"
#include "launchsafe/report/plot.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/report/written_files.hpp"
#include "launchsafe/study/sensitivity.hpp"

#include <filesystem>
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

/// The page; `pictures` are the names of the files of each output's picture, empty where it has none.
std::string to_markdown(const study::SensitivityResult& result, const std::vector<std::string>& pictures);

/// Writes sensitivity.csv, evaluations.csv, sensitivity_OUTPUT.svg for every output with indices, report.md
/// and study.json into a folder, which is made. Errors: conflict, write_failed.
store::Result<WrittenFiles> write_report(const study::SensitivityResult& result,
                                         const std::filesystem::path& folder,
                                         const DrawingLimits& limits = {});

}  // namespace launchsafe::report
