// What gaps that close say of a case, beside the reservoir: on two bounds of the heat that the base takes,
// and in the worst corner of what is not known. Every gap on every terms has a launch of its own.
#pragma once

#include "launchsafe/study/case_uncertainty.hpp"
#include "launchsafe/study/run_cases.hpp"

namespace launchsafe::study {

/// Terms on which a gap closes, and the charge ignites.
struct ClosingTerms {
  scene::Surface surface;
  materials::KineticsParameters kinetics;
};

/// Sets of terms that are looked at together: the hottest of them counts.
struct ClosingBound {
  std::string name;  ///< in files
  std::vector<ClosingTerms> terms;
  std::string unknown_for = {};  ///< why nothing can be said on them; empty where it can
};

/// "conducting" and "insulated": a case's own terms with either base. Where the corner is asked for, also
/// - "melting": insulated, and the charge melts; nothing rests on it.
/// - "smooth": insulated, with the smoothest faces of the plausible ones or the case's own, let go over the
///   time that sound takes through the charge or over the case's own where that is shorter.
/// - "flowing": the same with air that stays and with air that flows.
/// - "corner": the same with a charge that is free from the start, or as the case has it, or held until the
///   load has 25, 50, 75, 85, 95 and 100 % of its peak, and 95 % after it; how much hotter an instant between
///   two of these may be counts as an uncertainty. Of a charge that anything holds by a bond the corner is
///   not known: when bonds let go is not looked at.
/// Each but melting holds all of the one before, so that the difference of two that follow each other is what
/// the worst end of one interval does: of the heat to the base, of the faces, of the air's flow, of the
/// release. On all of them every kinetics of kinetics_of counts, the first to ignite.
std::vector<ClosingBound> closing_bounds(const StudyCase& input, bool with_corner = true);

/// The kinetics by which a charge may ignite between its initial temperature and T1: its own, and those of
/// which all three numbers belong together, with its T1 and T2. Left out is what another one outdoes over all
/// of that range: as ln of the heating is linear in 1/T, it does so if at both of its ends.
std::vector<materials::KineticsParameters> kinetics_of(const scene::Scene& scene);

/// Performs runs and hands over what became of each, from any thread.
using RunBatch = std::function<void(std::vector<PlannedRun> runs,
                                    const std::function<void(std::size_t run, const FinishedRun&)>& take)>;

/// The bounds of cases (places in StudyFile::cases) whose gaps close. The gaps of the study up to the largest
/// one of its search are computed, then the first that ignites is narrowed down to the study's tolerance. In
/// detail all of them and a scan between them, with the corner; of many cases from the thinnest up to the
/// first that ignites or is not known, without the corner. `on_done` is called of each case of which nothing
/// is sought any more.
std::vector<std::vector<ClosingAnswer>> find_closing_gaps(
    const StudyFile& study, const std::vector<std::size_t>& cases, const RunBatch& run,
    const std::function<void(std::size_t index)>& on_done = [](std::size_t) {});
/// Launches of a case that may be asked for, at most.
std::size_t most_closing_launches(const Study& study, const StudyCase& input);

/// What they say of one gap, for its verdict: nothing where a thinner gap is not known.
ClosingEvidence closing_evidence(const std::vector<ClosingAnswer>& answers, double gap,
                                 double ignition_temperature);
/// The same of a row of the verdict table, held against the reservoir's heat in it.
void take_closing_evidence(const std::vector<ClosingAnswer>& answers, const scene::Scene& scene,
                           GapVerdict& row);
/// A bound as a critical gap, for people.
CriticalGap critical_gap_of(const ClosingAnswer& answer);

}  // namespace launchsafe::study
