// What tables and pages say of a fit, and its panel.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/study/case_answer.hpp"
#include "launchsafe/study/surrogate.hpp"

namespace launchsafe::kinds {

/// "T max at a gap of 0.2 mm, without reaction" in K, or "critical gap" in cm.
report::Column shown(const study::SurrogateOutput& output);

/// How good the fit of an output is; nothing where it has none.
report::Quantities<study::SurrogateOutput> fit_quantities();

/// Why nothing is predicted of critical gaps: some are bounds, or else what is given. With why the first of
/// them that is no number is none; empty where there is no such reason.
std::string gap_reason(const std::vector<study::CaseAnswer>& answers, std::string otherwise = {});

/// Predicts nothing where launches behind a fit have validity warnings: what they do is not known.
void predict_from_sound_launches(study::SurrogateRecord& record,
                                 const std::vector<study::CaseAnswer>& answers);

/// surrogate.json, and ask.html, which answers from the same fit. `study` has its inputs as axes.
std::vector<report::TextFile> surrogate_files(const study::SurrogateRecord& record,
                                              const study::StudyFile& study);

}  // namespace launchsafe::kinds
