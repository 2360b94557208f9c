// A safety report: facts are rows of the studies and what was selected from them; what is said of them, where
// and in which digits, stands in templates.
#pragma once

#include "launchsafe/report/gap_criterion.hpp"
#include "launchsafe/report/page_sections.hpp"
#include "launchsafe/report/safety_evidence.hpp"

#include <optional>

namespace launchsafe::report {

/// The templates of safety reports that are built in.
PageTemplates built_in_templates();

/// Equal evidence and criterion make equal files. Errors: corrupt (a template that cannot be rendered).
store::Result<RenderedReport> make_safety_report(const SafetyEvidence& evidence,
                                                 const std::optional<GapCriterion>& criterion,
                                                 const PageTemplates& templates,
                                                 const DrawingLimits& limits = {});

}  // namespace launchsafe::report
