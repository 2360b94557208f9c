// From finished runs to the answer to a case: critical gap, verdict rows, fit, and what a cause of
// uncertainty at an end of its range changes, all integrated on the trace of one mechanical run; then all
// that tables need of it, and no histories. Answers to all cases take the fewest mechanical runs: cases that
// differ in thermal keys alone share one, and what is stored is not computed again. A results file has a row
// a case; verdicts follow from what is stored.
#pragma once

#include "launchsafe/study/case_uncertainty.hpp"
#include "launchsafe/study/run_cases.hpp"

namespace launchsafe::study {

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

// --- Answers. ---

/// The answer to a case that was concluded: all of it but its histories.
CaseAnswer answer_of(const CaseOutcome& outcome);

/// Draws the answer from a mechanical run. `raised`: the mechanics under a raised load, where the study
/// states no uncertainty of the inputs.
CaseAnswer answer_of(const Study& study, const StudyCase& input, const run::MechanicsResult& mechanics,
                     const std::optional<run::MechanicsResult>& raised = std::nullopt);
/// Takes in what gaps that close say of the case, and judges its gaps anew.
void take_closing(const StudyCase& input, std::vector<ClosingAnswer> closing, CaseAnswer& answer);
/// The answer of a case without a result.
CaseAnswer failed_answer(const Study& study, const StudyCase& input, RunOutcome outcome, std::string failure);

/// An answer that was read with its verdicts, which are not stored; nothing where it cannot be that of the
/// study's case: by its gaps, margins and times, or by less uncertainty or fewer validity warnings than its
/// input has.
std::optional<CaseAnswer> judged(CaseAnswer answer, const Study& study, const StudyCase& input);

/// An answer for every case; one that was not run, failed or belongs to another shard says so.
std::vector<CaseAnswer> answer_cases(const StudyFile& study, const StudyOptions& options, Timing& timing);

/// How far a run came that was cut off depends on the machine, and is no part of the result.
bool was_cut_off(const FinishedRun& run);
/// The answer to a case from its finished runs; a failed one where they have no result or were cut off.
CaseAnswer answer_from(const Study& study, const StudyCase& input, const std::vector<FinishedRun>& runs);

/// Stores an answer in the place of one with the same key, which are hexadecimal digits.
void save_answer(store::Database& database, const std::string& key, const CaseAnswer& answer);

/// Exactly what was saved, its rows not judged; not finite numbers but infinity become NaN. Nothing where
/// there is none, and for what was not written by this program as it is: another checksum, an unknown
/// enumerator, a negative amount, numbers that contradict each other.
std::optional<CaseAnswer> read_answer(store::Database& database, const std::string& key);

/// All that is stored of an answer.
std::string bytes_of(CaseAnswer answer);

}  // namespace launchsafe::study
