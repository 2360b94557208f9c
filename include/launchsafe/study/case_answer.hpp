// From finished runs to the answer to a case: critical gap, verdict rows, fit, and what a cause of
// uncertainty at an end of its range changes, all integrated on the trace of one mechanical run; then all
// that tables need of it, and no histories. Answers to all cases take the fewest mechanical runs: cases that
// differ in thermal keys alone share one, and what is stored is not computed again. A results file has a row
// a case; verdicts follow from what is stored.
#pragma once

#include "launchsafe/study/study_cases.hpp"
#include "launchsafe/study/verdict.hpp"

namespace launchsafe::study {

// --- what a verdict's uncertainty is made of: the computation itself, as stated, from an accuracy record, or
// assumed; the calibrated constants; and what is not known of the launch ---

/// Two standard deviations (coverage_factor) that are assumed of a launch of which a study states no input
/// uncertainty: the chamber pressure from round to round, as in the shipped sensitivity study, the
/// temperature of the charge, and the length of the pulse at the same peak.
inline constexpr double assumed_load_spread = 0.04;
inline constexpr double assumed_temperature_spread = 12.0;  ///< K
/// Of the length of the pulse: a launch that lasts longer leaves the hot air more time.
inline constexpr double assumed_pulse_spread = 0.05;

/// Heat grows with the square of the pressure where the steel stays elastic; near 496 MPa, where the wall of
/// the 155 mm shell yields, with its power of 3.6 (17 K of 116 K for 4 %). Rounded up.
inline constexpr double heat_exponent = 4.0;

/// How far a skin without reaction is heated (K) above the initial temperature: by friction, and by the air
/// of a gap in addition.
struct Rises {
  double friction = 0;
  double air = 0;
};

/// K, uncertainty of T max by the calibrated constants: the stated one, or that of the
/// calibration. It is that of the rows that the constants were fitted to; their relative errors are carried
/// to the case's own rises. Another load shape was held out in no row but those at another time, and other
/// numerics have another mesh error than the constants absorbed: both add to it. 0 for a
/// study without verdicts.
double fit_share(const Study& study, const RecordDistance& distance, const Rises& rises);

/// Whether the share of the computation in the bounds of a critical gap (m) is assumed, as neither the study
/// nor a record speaks of the case.
bool assumes_computation(const StudyCase& input, double critical_gap);

/// K, as a study states it for its own scene; it grows with the pressure as the heat does.
double stated_input_share(const Study& study, const StudyCase& input);

/// Share of the rises by which a measured curve may heat more: its smoothing took from the peak, and its
/// points may have missed it. 0 for an analytic load.
double load_curve_share(const scene::Load& load);

/// What all cases of a study rest on, each once.
struct AcceptancesOfStudy {
  std::vector<scene::Implausible> accepted;  ///< by key and by what the user writes as its value
  std::vector<scene::Implausible> missing;   ///< by key and value
  std::vector<std::string> unneeded;         ///< "KEY = VALUE" that is accepted in vain
  std::vector<std::string> extrapolated;     ///< as in the reasons of verdicts
};
AcceptancesOfStudy acceptances_of(const StudyFile& study);

/// Those that a study names. Refused are: none there, no record, or a stated uncertainty beside it.
AccuracyRecords read_records(StudyFile& study, const std::filesystem::path& folder);

/// Puts the cheapest recorded setting within the tolerance (K) into the study's scene. Needs the overrides.
void choose_setting(StudyFile& study, const AccuracyRecords& records, double tolerance);

/// Numerical uncertainty of each case of the study, known once the case is made. Without a statement, or
/// elsewhere than it holds, nothing is known, and a large one is assumed, so that no verdict is SAFE on the
/// strength of silence.
void settle_uncertainty(StudyFile& study, const AccuracyRecords& records);

/// Of all cases of a study, each of which is made for it.
struct NumericalUncertainty {
  double largest = 0;    ///< K, of T max
  bool assumed = false;  ///< for some case
  std::string source;    ///< where it comes from, a clause
};
NumericalUncertainty numerical_uncertainty_of(const StudyFile& study);

/// "it was made at ... (20 of 45 cases); ... (4 of 45 cases)": reasons of some cases, the commonest first.
std::string commonest_first(const std::map<std::string, std::size_t>& reasons, std::size_t cases);

/// K, of T max of a gap (m) by mesh, step and scaling, where T max is `rise` (K) above the initial
/// temperature.
double numerical_share(const StudyCase& input, double gap, double rise);

/// A skin that air and friction heat, and nothing else.
surface::SkinModel without_reaction(surface::SkinModel model);

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

/// The critical gaps of a case under the other constants of its study, from its finished runs. A launch that
/// did not complete, or has validity warnings, has none.
std::vector<ModelGap> gaps_of_models(const Study& study, const StudyCase& input,
                                     const std::vector<FinishedRun>& runs);

/// A case on its mechanics: the critical gap, by the hottest station and indeterminate for a failed run; then
/// the gaps of the study on the trace, skin histories and the rows without verdict.
void evaluate(const Study& study, CaseOutcome& outcome);
/// That of a case without a result: rows without numbers, and the reason.
CaseOutcome without_result(const Study& study, const StudyCase& input, RunOutcome of_run,
                           std::string failure);

/// What the confirmations say about the critical gap: a disagreement makes it indeterminate.
void apply_confirmations(const Study& study, CaseOutcome& outcome);

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

/// m: how wide the bracket of a critical gap by the reservoir may be at most, whatever wider one a study asks
/// for. What causes of uncertainty change is a difference of such brackets: in wide ones it vanishes, and the
/// lower bound rises. A gap on a trace costs little.
inline double bracket_width(const Study& study) { return std::min(study.tolerance, 1e-6); }

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
/// A case on its finished runs, not concluded.
CaseOutcome outcome_from(const Study& study, const StudyCase& input, const std::vector<FinishedRun>& runs);
/// The answer of a case without a result.
CaseAnswer failed_answer(const Study& study, const StudyCase& input, RunOutcome outcome, std::string failure);

/// An answer that was read with its verdicts, which are not stored.
CaseAnswer judged(CaseAnswer answer, const Study& study, const StudyCase& input);

/// An answer for every case; one that was not run, failed or belongs to another shard says so.
std::vector<CaseAnswer> answer_cases(const StudyFile& study, const StudyOptions& options, Timing& timing,
                                     ProgressTracker& tracker);

/// How far a run came that was cut off depends on the machine, and is no part of the result.
bool was_cut_off(const FinishedRun& run);
/// The answer to a case from its finished runs; a failed one where they have no result or were cut off.
CaseAnswer answer_from(const Study& study, const StudyCase& input, const std::vector<FinishedRun>& runs);

/// Stores an answer in the place of one with the same key, which are hexadecimal digits.
void save_answer(store::Database& database, const std::string& key, const CaseAnswer& answer);

/// Exactly what was saved, its rows not judged. Nothing where there is none.
std::optional<CaseAnswer> read_answer(store::Database& database, const std::string& key);

/// All that is stored of an answer.
std::string bytes_of(CaseAnswer answer);

}  // namespace launchsafe::study
