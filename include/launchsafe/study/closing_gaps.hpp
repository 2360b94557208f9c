// What gaps that close say of a case, beside the reservoir: on two bounds of the heat that the base takes,
// and in the worst corner of what is not known. Every gap on every terms has a launch of its own.
#pragma once

#include "launchsafe/study/gap_verdict.hpp"
#include "launchsafe/study/run_cases.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace launchsafe::study {

/// Terms on which a gap closes.
struct ClosingTerms {
  scene::GapBase base = scene::GapBase::conducting;
  double roughness = 0;                         ///< m
  double release = 0;                           ///< s
  std::optional<double> release_duration = {};  ///< s; none: that of scene::Surface
};

/// Sets of terms that are looked at together: the hottest of them counts.
struct ClosingBound {
  std::string name;  ///< in files
  std::vector<ClosingTerms> terms;
  std::string unknown_for = {};  ///< why nothing can be said on them; empty where it can
};

/// "conducting" and "insulated": a case's own terms with either base. "corner": an insulated base, the
/// smoothest faces of the plausible ones or the case's own, and a charge that is free from the start, or as
/// the case has it, or held until the load has a quarter, a half, three quarters, and all of its peak, and
/// let go over the time that sound takes through it or over the case's own where that is shorter. Of a charge
/// that anything holds by a bond the corner is not known: when bonds let go is not looked at.
std::vector<ClosingBound> closing_bounds(const StudyCase& input);

/// All bounds of a case: the gaps of the study and a scan up to the largest one are computed, then the first
/// that ignites is narrowed down to the study's tolerance. `run` performs a batch of runs.
using RunBatch = std::function<std::vector<FinishedRun>(std::vector<CaseRun> runs)>;
std::vector<ClosingAnswer> find_closing_gaps(const Study& study, const StudyCase& input, const RunBatch& run);

/// What they say of one gap, for its verdict: nothing where a thinner gap is not known.
ClosingEvidence closing_evidence(const std::vector<ClosingAnswer>& answers, double gap,
                                 double ignition_temperature);

}  // namespace launchsafe::study
