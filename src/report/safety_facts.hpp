// What a safety report tells: rows of studies, what was selected from them, and what was computed besides.
#pragma once

#include "launchsafe/report/safety_report.hpp"

namespace launchsafe::report::safety {

// The templates that are built in, of src/report/templates.
extern const char* const built_in_html;
extern const char* const built_in_markdown;
extern const char* const built_in_texts;

PageFacts facts_of(const SafetyEvidence& evidence, const std::optional<GapCriterion>& criterion);

/// The scene and its inputs, and what of the physics was left out.
Row scene_facts(const StudyEvidence& study, PageFacts& all);
/// The load, histories, profiles and fields of a case that was stored.
Row picture_facts(const StudyEvidence& study, const CaseEvidence& judged, const run::MechanicsResult& stored,
                  PageFacts& all);
/// The line through T max of a case against the gap, and how well a row follows from the others, by curve;
/// "fit" alone, with the number of rows, where they are too few.
Row fit_facts(const StudyEvidence& study, const CaseEvidence& judged);

}  // namespace launchsafe::report::safety
