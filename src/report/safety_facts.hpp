// What a safety report tells: rows of studies, what was selected from them, and what was computed besides.
#pragma once

#include "launchsafe/report/cell_plot.hpp"
#include "launchsafe/report/gap_criterion.hpp"
#include "launchsafe/report/plot.hpp"
#include "launchsafe/report/safety_evidence.hpp"

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace launchsafe::report::safety {

/// A figure, or the SVG that a study drew.
using Drawing = std::variant<Plot, CellPlot, std::string>;

struct SafetyFacts {
  Row facts = Row::object();                     ///< by the names that texts know
  std::map<std::string, Drawing> drawings = {};  ///< by file; facts say which are shown, and where
};
SafetyFacts facts_of(const SafetyEvidence& evidence, const std::optional<GapCriterion>& criterion);

/// The scene and its inputs, and what of the physics was left out.
Row scene_facts(const StudyEvidence& study, SafetyFacts& all);
/// The load, histories, profiles and fields of a case that was stored.
Row picture_facts(const StudyEvidence& study, const CaseEvidence& judged, const run::MechanicsResult& stored,
                  SafetyFacts& all);
/// The line through T max of a case against the gap, and how well a row follows from the others, by curve;
/// "fit" alone, with the number of rows, where they are too few.
Row fit_facts(const StudyEvidence& study, const CaseEvidence& judged);

}  // namespace launchsafe::report::safety
