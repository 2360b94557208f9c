// A comparison of models, each calibrated on the same rows, as the record of other models that studies name.
#pragma once

#include "launchsafe/kinds/comparison.hpp"

namespace launchsafe::kinds {

/// What is said, tabled, drawn and written of other models; nothing where a comparison is of no calibrated
/// models.
void add_model_form(const ComparisonResult& result, report::Report& report);

/// What its tables hold, but for the pressures of a study.
std::vector<ResultTable> model_form_results();

}  // namespace launchsafe::kinds
