// A safety report as files: a page for a browser, the same in Markdown and JSON, and its figures. Facts are
// rows of the studies and what was selected from them; what is said of them, where and in which digits,
// stands in templates.
#pragma once

#include "launchsafe/report/gap_criterion.hpp"
#include "launchsafe/report/report.hpp"
#include "launchsafe/report/safety_evidence.hpp"
#include "launchsafe/store/result.hpp"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace launchsafe::report {

/// Mustache templates of the pages, and the texts by their names, each a template too.
struct SafetyTemplates {
  std::string html, markdown;
  std::map<std::string, std::string> texts;
};

/// Those that are built in.
SafetyTemplates built_in_templates();

/// Those in a folder; what is not there, files or single texts, stays as it is built in. Errors: missing
/// (none of the files is there), corrupt (no template: tags that do not fit together, a text without a name).
store::Result<SafetyTemplates> read_templates(const std::filesystem::path& folder);

struct RenderedReport {
  std::vector<TextFile> files;       ///< report.html, report.md, report.json, and the figures
  std::vector<std::string> remarks;  ///< why a figure is missing
};

/// Draws the figures and fills the templates. Whatever studies say is escaped, so that markup in it is shown.
/// A figure that gnuplot does not draw is a remark, in the page too. Equal evidence and criterion make equal
/// files. Errors: corrupt (a template that cannot be rendered).
store::Result<RenderedReport> make_safety_report(const SafetyEvidence& evidence,
                                                 const std::optional<GapCriterion>& criterion,
                                                 const SafetyTemplates& templates,
                                                 const DrawingLimits& limits = {});

/// The files of the figures that a report.json names; none where it is no report.
std::vector<std::string> figures_of(const std::string& report_json);

}  // namespace launchsafe::report
