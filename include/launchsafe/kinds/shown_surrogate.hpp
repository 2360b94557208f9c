// What tables and pages say of a fit, and its panel.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/study/surrogate.hpp"

namespace launchsafe::kinds {

/// "T max at a gap of 0.2 mm, without reaction" in K, or "critical gap" in cm.
report::Column shown(const study::SurrogateOutput& output);

/// How good the fit of an output is; nothing where it has none.
report::Quantities<study::SurrogateOutput> fit_quantities();

/// Why nothing is fitted to critical gaps of which so many are bounds.
std::string bounds_reason(std::size_t bounds, std::size_t all);

/// surrogate.json, and ask.html, which answers from the same fit. `study` has its inputs as axes.
std::vector<report::TextFile> surrogate_files(const study::SurrogateRecord& record,
                                              const study::StudyFile& study);

}  // namespace launchsafe::kinds
