// A stability study as tables, a page and JSON. Nothing in them differs between two runs of the same study.
#pragma once

#include "launchsafe/report/report.hpp"
#include "launchsafe/study/stability.hpp"

#include <string>

namespace launchsafe::report {

/// How many cases came out how; and every one that is WRONG, not as expected or not computed, by name.
std::string answer(const study::StabilityResult& result);

/// A row for every case: what must hold, what became of it, and why.
Table stability_table(const study::StabilityResult& result);
/// The same for a terminal: without what must hold, and long findings cut.
Table stability_summary(const study::StabilityResult& result);
/// A row for every gap of every launch that ran, with the numbers behind its outcome.
Table launch_table(const study::StabilityResult& result);

/// One object: counts, and the cases with their numbers.
nlohmann::ordered_json to_json(const study::StabilityResult& result);

/// The whole report, with what is printed on a terminal and every file.
Report report_of(const study::StabilityResult& result);

}  // namespace launchsafe::report
