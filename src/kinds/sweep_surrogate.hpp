// A fit over the cases of a sweep, for `launchsafe ask`.
#pragma once

#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/study/study_cases.hpp"
#include "launchsafe/study/surrogate.hpp"

namespace launchsafe::kinds {

/// Why the cases of a study, all combinations of its axes, are none that can be fitted and held against
/// others.
study::Fault check_sweep_surrogate(const study::StudyFile& study);

/// T max of every gap and the critical gap, fitted. Held out are all cases with an inner value that is, in
/// their order, the third, sixth, ... of its axis: they lie between values that are fitted.
study::SurrogateRecord sweep_surrogate(const CriticalGapResult& result);

/// A row for every output of the fit.
report::Table surrogate_table(const study::SurrogateRecord& record);
std::vector<report::Column> surrogate_columns();

}  // namespace launchsafe::kinds
