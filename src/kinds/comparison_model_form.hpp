// A comparison of models, each calibrated on the same rows, as the record of other models that studies name.
#pragma once

#include "launchsafe/kinds/comparison.hpp"
#include "launchsafe/study/model_form.hpp"

#include <list>
#include <optional>
#include <string>
#include <vector>

namespace launchsafe::kinds {

/// The models with their critical gaps, and the record made of them.
struct ModelForm {
  std::list<study::CriticalGapCurve> curves;   ///< the entries point to them
  std::vector<study::ModelFormEntry> entries;  ///< the default first
  study::ModelFormRecord record;
};

/// Why a comparison makes no record of other models, a clause; or what it makes.
struct ModelFormOrReason {
  std::optional<ModelForm> form;
  std::string reason;
};
/// Of a comparison over peak pressures whose variants all name the record of a calibration. The comparison
/// has to live as long as what is made of it.
ModelFormOrReason model_form_of(const ComparisonResult& result);

/// What is said, tabled, drawn and written of other models; nothing where a comparison is of no calibrated
/// models.
void add_model_form(const ComparisonResult& result, report::Report& report);

}  // namespace launchsafe::kinds
