// The critical gap under every model, each calibrated on the same rows: table, picture and record.
#pragma once

#include "launchsafe/report/report.hpp"
#include "launchsafe/study/model_form.hpp"

#include <string>
#include <vector>

namespace launchsafe::report {

/// What a page on model form is made of: the entries, the default first, and the record made of them.
struct ModelForm {
  std::vector<study::ModelFormEntry> entries;
  study::ModelFormRecord record;
  std::string command;  ///< that makes it
};

/// Critical gap by model and peak pressure, and what each counts for.
Table model_form_table(const ModelForm& form);
/// The constants of every model, and how it meets the published rows.
Table model_constants_table(const ModelForm& form);
Plot model_form_plot(const ModelForm& form);

/// The names of its files.
std::vector<std::string> model_form_files();
/// The whole report; model_form.json is the record that studies name.
Report report_of(const ModelForm& form);

}  // namespace launchsafe::report
