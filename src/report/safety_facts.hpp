// What a safety report tells: rows of studies, what was selected from them, and what was computed besides.
#pragma once

#include "launchsafe/report/safety_report.hpp"

namespace launchsafe::report::safety {

// The templates that are built in, of src/report/templates.
extern const char* const built_in_html;
extern const char* const built_in_markdown;
extern const char* const built_in_texts;

PageFacts facts_of(const SafetyEvidence& evidence, const std::optional<GapCriterion>& criterion);

/// Whether nothing says how wrong a row is: its uncertainty is then no number to hold a margin against.
bool is_uncertain(const Row* verdict);
/// How many of these verdicts are what.
Row counts_of(const std::vector<const Row*>& verdicts);
/// The row of a case with its critical gap as printed: what moves towards ignition alone lowers it alone.
Row told_case(const StudyEvidence& study, const CaseEvidence& judged);
/// A verdict row as its table shows it, rounded to the safe side. What a run was like until it was cut off is
/// no margin, nor is anything after ignition, when T max is that of the burning skin.
Row told_verdict(const CaseEvidence& judged, std::size_t place);
/// What is smallest, and in how many cases there is none.
Row summary_of(const StudyEvidence& study, const std::vector<CaseEvidence>& cases);
/// Whether a case has the scene's own values of all that the study varies.
bool is_own(const StudyEvidence& study, const CaseEvidence& judged);
/// The case of the scene's own launch, or else the one with the smallest critical gap, or the first; nullptr
/// without any.
const CaseEvidence* own_case(const StudyEvidence& study, const std::vector<CaseEvidence>& cases);
/// What the study answers over all cases, and what a criterion recommends.
Row answer_of(const StudyEvidence& study, const std::vector<CaseEvidence>& cases,
              const std::optional<GapCriterion>& criterion);

/// The scene and its inputs, and what of the physics was left out.
Row scene_facts(const StudyEvidence& study, PageFacts& all);
/// The load, histories, profiles and fields of a case that was stored.
Row picture_facts(const StudyEvidence& study, const CaseEvidence& judged, const run::MechanicsResult& stored,
                  PageFacts& all);
/// The line through T max of a case against the gap, and how well a row follows from the others, by curve;
/// "fit" alone, with the number of rows, where they are too few.
Row fit_facts(const StudyEvidence& study, const CaseEvidence& judged);

}  // namespace launchsafe::report::safety
