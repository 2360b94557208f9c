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
/// Of what cooling opens: the temperatures by which charge and shell fitted and are fired differ by as much
/// more, and they expand by a quarter more unequally, which holds what is plausible of the charge.
inline constexpr double assumed_expansion_spread = 0.25;
/// m, by which a gap that opened by cooling may be thicker; 0 of one that is stated.
double cooling_spread(const scene::Scene& scene);
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
/// numerics have another mesh error than the constants absorbed: both add to it. Where firings calibrated, it
/// is what a factor on the launch's own heat adds (`heat_factor`), no less than stated. 0 for a study without
/// verdicts.
double fit_share(const Study& study, const RecordDistance& distance, const Rises& rises, double heat_factor);

/// By which the heat of a launch may be larger for all that its firings leave open of the constants, under
/// either prior, without a gap or at one (m), whichever is more. 1 where no firings calibrated; infinite
/// where nothing tells.
double heat_factor(const Study& study, const scene::Scene& scene, const trace::BottomTrace& trace,
                   double gap);

/// What the study states of the model form, or assumes where its record does not speak of a case, K.
/// Nothing where the record does: it gives a shift of the gap (`recorded`).
std::optional<double> stated_model_form_share(const Study& study, const StudyCase& input,
                                              const ModelFormShift& recorded);
/// Shares of the bounds of a case that are assumed, as neither the study nor a record speaks of it.
struct AssumedShares {
  bool computation = false, model_form = false;
  bool any() const { return computation || model_form; }
  std::string text() const;  ///< "computation, model form"; empty for none
};
/// Those of a case with a critical gap (m).
AssumedShares assumed_shares(const Study& study, const StudyCase& input, double critical_gap);

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

/// The same of a launch in which a gap closes.
struct ClosingShare {
  double kelvin = assumed_numerical_uncertainty;
  bool recorded = false;  ///< rather than assumed
};
/// Of a case whose gap (m) closes as `closing` has it, by a record that was made of a gap closing on those
/// very terms (base, roughness, release), at no lower a pressure, temperature, localisation and defect, and
/// up to no thinner a gap: nothing is carried beyond. A record of the reservoir says nothing of it.
ClosingShare closing_share(const StudyCase& input, const scene::Scene& closing, double gap, double rise);

// --- what gaps that close say of a case, beside the reservoir: on two bounds of the heat that the base
// takes, and in the worst corner of what is not known. Every gap on every terms has a launch of its own ---

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

/// Performs runs, for which so many cases wait, and hands over what became of each, from any thread.
using RunBatch = std::function<void(std::vector<PlannedRun> runs, std::ptrdiff_t cases,
                                    const std::function<void(std::size_t run, const FinishedRun&)>& take)>;

/// The bounds of cases (places in StudyFile::cases) whose gaps close. The gaps of the study up to the largest
/// one of its search are computed, then the first that ignites is narrowed down to the study's tolerance. In
/// detail all of them and a scan between them, with the corner; of many cases from the thinnest up to the
/// first that ignites or is not known, without the corner. At last no case waits.
std::vector<std::vector<ClosingAnswer>> find_closing_gaps(const StudyFile& study,
                                                          const std::vector<std::size_t>& cases,
                                                          const RunBatch& run);
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

/// The gaps of the study and the critical gap under its longer launch, on the mechanics of that one.
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

/// m: how wide the bracket of a critical gap by the reservoir may be at most, whatever wider one a study asks
/// for. What causes of uncertainty change is a difference of such brackets: in wide ones it vanishes, and the
/// lower bound rises. A gap on a trace costs little; gaps that close, a launch each, take the study's own.
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
/// Takes in what gaps that close say of the case, and judges its gaps anew.
void take_closing(const StudyCase& input, std::vector<ClosingAnswer> closing, CaseAnswer& answer);
/// The answer of a case without a result.
CaseAnswer failed_answer(const Study& study, const StudyCase& input, RunOutcome outcome, std::string failure);

/// An answer that was read with its verdicts, which are not stored; nothing where it cannot be that of the
/// study's case: by its gaps, margins and times, or by less uncertainty or fewer validity warnings than its
/// input has.
std::optional<CaseAnswer> judged(CaseAnswer answer, const Study& study, const StudyCase& input);

/// An answer for every case; one that was not run, failed or belongs to another shard says so.
std::vector<CaseAnswer> answer_cases(const StudyFile& study, const StudyOptions& options, Timing& timing,
                                     ProgressTracker& tracker);

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
