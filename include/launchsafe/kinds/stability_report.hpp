// A stability study as tables, a page and JSON. Nothing in them differs between two runs of the same study.
#pragma once

#include "launchsafe/kinds/stability.hpp"
#include "launchsafe/report/report.hpp"

#include <string>

namespace launchsafe::kinds {

/// How many cases came out how; and every one that is WRONG, not as expected or not computed, by name.
std::string answer(const StabilityResult& result);

/// A row for every case: what must hold, what became of it, and why.
report::Table stability_table(const StabilityResult& result);
/// The same for a terminal: without what must hold, and long findings cut.
report::Table stability_summary(const StabilityResult& result);
/// A row for every gap of every launch that ran, with the numbers behind its outcome.
report::Table launch_table(const StabilityResult& result);

/// The whole report, with what is printed on a terminal and every file.
report::Report report_of(const StabilityResult& result);

}  // namespace launchsafe::kinds
