// One finished mechanical run: critical gap, verdict rows, fit, and what a cause of uncertainty at an end of
// its range changes. Everything here is integrated on its trace.
#pragma once

#include "launchsafe/study/case_uncertainty.hpp"
#include "launchsafe/surface/skin.hpp"

namespace launchsafe::study {

struct FinishedRun;  // run_cases.hpp

/// A skin that air and friction heat, and nothing else.
surface::SkinModel without_reaction(surface::SkinModel model);

/// The highest temperature of one station over the launch.
struct StationTemperature {
  std::string name;
  double temperature = not_a_number;  ///< K
};
/// Of the stations that tile the bottom; observation points lie in them.
std::vector<StationTemperature> station_temperatures(const surface::SkinHistory& skin,
                                                     const trace::BottomTrace& trace);

/// K by which all heat of friction between charge and base could heat the charge's surface: in the skin, or,
/// where that is thinner, as deep as heat diffuses until the exit at a constant rate (Carslaw & Jaeger
/// 1959, 2.9).
double friction_share(const CaseOutcome& outcome);
/// m by which charge and base part, at the most.
double opening_at_base(const CaseOutcome& outcome);

/// m, where the search for the critical gap ends: beyond all gaps of the study.
double largest_gap(const Study& study);

/// Puts the study's published rows beside those of a case under the study's own conditions.
void attach_references(const Study& study, const StudyCase& input, std::vector<GapVerdict>& rows);

/// A case on its mechanics: the critical gap, by the hottest station and indeterminate for a failed run; then
/// the gaps of the study on the trace, skin histories and the rows without verdict.
void evaluate(const Study& study, CaseOutcome& outcome);
/// Puts what the launches of gaps that close came to, one a gap of the study, in the place of what was read
/// off a trace; there is no critical gap.
void take_launches(const StudyCase& input, const std::vector<FinishedRun>& runs, CaseAnswer& answer);
/// That of a case without a result: rows without numbers, and the reason.
CaseOutcome without_result(const Study& study, const StudyCase& input, RunOutcome of_run,
                           std::string failure);

/// The gaps of the study and the critical gap with air as a film, on the same trace.
void evaluate_film(const Study& study, CaseOutcome& outcome);
/// The same of its longer launch, on the mechanics of that one.
void evaluate_longer_launch(const Study& study, const run::MechanicsResult& mechanics, CaseOutcome& outcome);
/// T max (K) of a gap, by its place in the study, when a launch that is cut short goes on until it is over.
/// NaN for other launches, and where that is not known.
double when_launch_is_over(const CaseOutcome& outcome, std::size_t gap);

/// What the confirmations say about the critical gap: a disagreement makes it indeterminate.
void apply_confirmations(const Study& study, CaseOutcome& outcome);

/// Whether a row that the constants were calibrated on is missed: the constants belong to other settings, and
/// a stated uncertainty does not cover that.
bool misses_calibrated_rows(const CaseOutcome& outcome);

/// Uncertainties, verdicts and the fit, once all runs are done.
void conclude(const Study& study, CaseOutcome& outcome);

/// Which end of the range of a cause.
enum class End { towards_ignition, away };

struct RaisedLaunch {
  ShareKind kind = ShareKind::computation;
  surface::SkinModel skin;
  std::shared_ptr<const trace::BottomTrace> trace;  ///< nothing where the end is not known
  double thicker = 0;                               ///< m, by which the gap is thicker
};

/// The random causes of a case, one by one at their ends: the muzzle exit where its scene states a spread;
/// peak pressure, length of the pulse and initial temperature where the study states no uncertainty of the
/// inputs. The lower pressure was not run: its trace is the mirror of the raised one (trace::mirrored).
/// With a `row`, the case at a gap next to its critical one, all causes: of the row those are taken that are
/// known as temperatures: heat of air and friction is scaled so that a skin that does not react is hotter by
/// as much.
std::vector<RaisedLaunch> raised_launches(const Study& study, const CaseOutcome& outcome, End end,
                                          const GapVerdict* row = nullptr);

}  // namespace launchsafe::study
