// The critical gap under every model, each calibrated on the same rows: table, picture and record.
#pragma once

#include "launchsafe/report/drawing_limits.hpp"
#include "launchsafe/report/plot.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/report/written_files.hpp"
#include "launchsafe/store/result.hpp"
#include "launchsafe/study/model_form.hpp"

#include <filesystem>
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
std::string to_markdown(const ModelForm& form, const std::string& picture);

/// The names of the files that `write_report` writes.
std::vector<std::string> model_form_files();
/// Writes model_form.json (the record that studies name), model_form.csv, report.md and model_form.svg into a
/// folder. Errors: conflict, write_failed, unreadable.
store::Result<WrittenFiles> write_report(const ModelForm& form, const std::filesystem::path& folder,
                                         const DrawingLimits& limits = {});

}  // namespace launchsafe::report
