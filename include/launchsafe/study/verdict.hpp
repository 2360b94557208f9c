// Safe, unsafe or indeterminate: what the input of a case says of all its verdicts, what a study knows of one
// gap, and of one case with its gaps, the rules, and the words. What an input says is found once a case and
// never stored: a verdict that is read rests on what it says now.
#pragma once

#include "launchsafe/study/run_cases.hpp"

namespace launchsafe::study {

/// Calibres of travel: no barrel is shorter.
inline constexpr double fewest_calibres = 10.0;
/// K, by which friction heats the bottom of a charge that was launched, at the least.
inline constexpr double least_friction_rise = 1.0;

struct CaseStatements {
  std::vector<std::string> uncovered_load;  ///< of run::uncovered_load
  /// Why no ignition shows nothing, whatever the case accepts, by the input alone. Empty: it may show
  /// something.
  std::string optimistic;

  // The rest is empty for a study without verdicts.
  RecordDistance distance;                      ///< to the calibration
  std::vector<scene::Implausible> implausible;  ///< of the case and of what its study states, accepted or not
  std::vector<std::string> extrapolated;  ///< what lies beyond the calibration's domain at any gap, by name:
                                          ///< first what is foreign to it
  /// m, up to which a gap lies within it.
  double calibrated_gap = math::infinity;

  /// What is implausible, and what is foreign to the calibration.
  std::vector<scene::Implausible> to_be_accepted() const;
  /// Whether something is not plausible, or foreign to the calibration, and nobody accepts it.
  bool has_unaccepted() const;
  /// Whether a gap (m) lies beyond those of the calibration.
  bool is_beyond(double gap) const;
};

CaseStatements statements_of(const Study& study, const StudyCase& input);

/// The same of what its run shows: a bottom that friction hardly heats (`friction_rise`, of T max without a
/// gap, K) was not launched.
std::string optimistic_by_run(double friction_rise);

enum class Verdict { safe, unsafe, indeterminate };
std::string to_string(Verdict verdict);

/// Uncertainty of T max at one gap, K, part by part: to be read beside the margin, while the verdict is
/// judged in gap. A part under which the gap ignites is infinite: all that is known of it is that it is at
/// least the margin.
struct Uncertainty {
  double sampling = 0;     ///< against a trace with half the samples
  double integration = 0;  ///< against a tolerance ten times wider
  double coupling = 0;     ///< largest difference between trace and coupled runs, where confirmed
  double numerical = 0;    ///< of mesh, step and scaling: from an accuracy study, stated, or assumed
  double fit = 0;          ///< of the calibrated constants, carried to this case
  double input = 0;        ///< of what is not known of the launch: its random causes together
  double load_curve = 0;   ///< of a measured curve: see load_curve_share
  double model_form = 0;   ///< by which launches under other constants move towards ignition
  /// Of a base on which the charge slides: all heat of friction, and the gap that opens there.
  double sliding = 0;
  /// Of the computation itself: the sum, since the parts are bounds and have common causes.
  double computed() const { return sampling + integration + coupling + numerical + sliding; }
  /// Of the launch: both may be wrong in the same direction.
  double inputs() const { return input + load_curve; }
  /// As the shares of a critical gap are combined (see bracket.hpp): `input` holds the random causes, and
  /// the causes of knowledge are added to it.
  double total() const { return input + load_curve + computed() + fit + model_form; }
};

/// What all verdicts of a case rest on besides numbers of their gaps.
struct CaseEvidence {
  /// Why the run did not end as it should; empty where it did.
  std::string failure = "the run failed";
  run::LimiterCounts limited = {};  ///< limiters that acted
  /// Why a completed run is no basis (see run::validity_warnings), a clause each; none for a sound one.
  std::vector<std::string> validity_warnings = {};
  /// K, of T max without a gap by friction; infinite where a study does not ask whether it was launched.
  double friction_rise = math::infinity;
  CaseStatements input = {};
  /// Launches under other constants that failed, a clause; empty where none did.
  std::string failed_models = {};
  bool completed() const { return failure.empty(); }
};

/// Why a case has no critical gap, whatever a search finds; none where it may have one.
GapReason why_no_critical_gap(const CaseEvidence& of_case);

/// Which rule gave a verdict.
enum class ReasonCode {
  not_judged,
  failed,
  no_temperature,
  validity_warning,
  ignition,
  unaccepted,
  no_margin,
  optimistic,
  critical_gap_indeterminate,
  several_crossings,
  smaller_gaps_ignite,
  margin_within_uncertainty,
  calibrated_margin_within_uncertainty,
  margin_over_uncertainty,
  no_lower_bound,
  may_ignite_without_gap,
  not_below_bound,
  below_bound
};
/// In files: "below-bound".
std::string to_string(ReasonCode code);

/// A verdict and why; its words are in statement_text.cpp.
struct Judgement {
  Verdict verdict = Verdict::indeterminate;
  ReasonCode code = ReasonCode::not_judged;
  double at_least = math::not_a_number;  ///< m, CriticalGap::bounds
  GapReason critical_gap = {};           ///< why there is none, where that is the reason
};

/// T = intercept + slope * gap, gap in cm as the paper prints it.
struct Line {
  std::string name;
  double intercept = not_a_number;         ///< K
  double slope = not_a_number;             ///< K/cm
  double root_mean_square = not_a_number;  ///< K, of data minus line
  /// Standard errors of least squares, K and K/cm; NaN where no row is to spare, and for another line.
  double intercept_error = not_a_number, slope_error = not_a_number;
};

/// The line of least squares, and the one of its slope through the zero-gap row, which is how the paper
/// prints it, where there is such a row. None for fewer than two gaps (m), or numbers that are not finite.
std::vector<Line> fit_gaps(const std::vector<double>& gaps, const std::vector<double>& temperatures);

/// A skin with one constant as calibrated.
struct AsCalibrated {
  std::string key;         ///< the constant; empty: all that heat or cool the skin, together
  double temperature = 0;  ///< K, T max over the stations
  bool ignites = false;
};

/// Of what has to be accepted, the constants that heat or cool the skin on a given trace: those of gap and
/// friction, and those of the charge. Accepting them makes no gap safe.
std::vector<std::string> skin_keys(const std::vector<scene::Implausible>& to_be_accepted);
/// What a skin can be evaluated anew with: all of these together (""), where there are any, then each, then
/// each constant of the kinetics.
std::vector<std::string> keys_as_calibrated(const std::vector<scene::Implausible>& to_be_accepted);

/// The scene with these keys as calibrated. Its trace keeps the heat of its own sliding friction, for which
/// the localisation makes up.
scene::Scene with_calibrated(const scene::Scene& scene, const scene::Scene& calibrated,
                             const std::vector<std::string>& keys);

/// The skin of a gap (m) with each of keys_as_calibrated as calibrated.
std::vector<AsCalibrated> as_calibrated(const scene::Scene& scene, const scene::Scene& calibrated,
                                        const std::vector<scene::Implausible>& to_be_accepted,
                                        const trace::BottomTrace& trace, double gap);

/// A maximum with its place by name.
struct Peak {
  double temperature = not_a_number;  ///< K
  double time = not_a_number;         ///< s
  std::string point;                  ///< station
};
Peak peak_of(const surface::Maximum& maximum, const trace::BottomTrace& trace);

struct NamedIgnition {
  surface::IgnitionCause cause = surface::IgnitionCause::trigger;
  double time = 0;  ///< s
  std::string point;
  double chemical_share = 0;  ///< of the heating rate at ignition
};
std::optional<NamedIgnition> named(const std::optional<surface::Ignition>& ignition,
                                   const trace::BottomTrace& trace);
std::string to_string(surface::IgnitionCause cause);

/// A row of the verdict table, and all that its verdict rests on.
struct GapVerdict {
  double gap = 0;                ///< m
  Peak maximum;                  ///< over the stations: what the verdict uses
  Peak until_exit;               ///< the same until scene::read_time: what a reference is compared with
  Peak early;                    ///< the same at Study::early_time
  double spread = not_a_number;  ///< K, over the stations at scene::read_time
  double margin = not_a_number;  ///< K, to the ignition temperature
  double heated = not_a_number;  ///< K, T max of a skin that air and friction heat and that never reacts
  std::vector<AsCalibrated> as_calibrated;  ///< with foreign constants of the surface as calibrated
  surface::AirEnergy air;  ///< what the skin took from the air; NaN where nothing was computed
  Uncertainty uncertainty;
  std::optional<NamedIgnition> ignition;        ///< at an observation point
  std::shared_ptr<const CaseEvidence> of_case;  ///< without it nothing is safe
  Judgement judgement;
  std::optional<Reference> reference;
  /// K, margin with the constants of the surface as calibrated; infinite where they are, minus infinite where
  /// it ignites so.
  double calibrated_margin() const;
  /// K, this until the exit minus the reference; NaN without one or where either ignited
  double misfit() const;
  double early_misfit() const;
};

/// The contract of a verdict, for a sound run: one that completed with finite temperatures and without
/// validity warnings of its own. Every other run is INDETERMINATE.
///
/// - UNSAFE: the gap ignites in the computation as it is stated, whatever of its input nobody accepts.
/// - SAFE: all of the input is plausible and of the calibration, or accepted; the gap does not ignite, and is
///   thinner than the lower bound of the critical gap (CriticalGap::bounds). Where nothing ignites up to the
///   end of the search, that is the bound, and the margin must exceed the uncertainty besides, also with the
///   constants of the surface as calibrated.
/// - INDETERMINATE: everything else.
///
/// More uncertainty, a wider range or less evidence never moves a verdict towards SAFE. A verdict on a run in
/// which limiters acted says so.
Judgement judge(const GapVerdict& row, const CriticalGap& critical);

/// Judges the rows of a case on their numbers and on what all of them rest on: the same whether they were
/// computed or read.
void judge_rows(const Study& study, const std::shared_ptr<const CaseEvidence>& of_case,
                const CriticalGap& critical, std::vector<GapVerdict>& rows);
/// m, the largest judged gap that with all smaller ones is SAFE; NaN where there is none.
double largest_safe_gap(const std::vector<GapVerdict>& rows);

// Clauses of a reason; each is empty where there is nothing to say.

/// Why a run is no basis, and what becomes of a gap when a launch that is cut short goes on until it is over.
std::string validity_warnings_text(const GapVerdict& row);
/// What of the input is not plausible, or foreign to the calibration, and not accepted.
std::string unaccepted_text(const CaseStatements& input);
/// What is not plausible, or foreign, and why it is meant.
std::string accepted_text(const CaseStatements& input);
std::string limiters_text(const GapVerdict& row);
/// Launches under other constants that failed, for want of which the critical gap has no bounds.
std::string failed_models_text(const GapVerdict& row);
/// What lies outside the calibration's domain.
std::string extrapolated_text(const GapVerdict& row);

/// What the rule says that gave the verdict.
std::string cause_text(const GapVerdict& row);
/// Why a verdict is what it is: the cause, and all that stands beside it.
std::string reason_text(const GapVerdict& row);

/// A coupled run on one side of the bracket.
struct Confirmation {
  double gap = 0;  ///< m
  bool expected_ignition = false;
  bool ran = false;
  bool completed = false;
  bool ignited = false;
  double maximum_temperature = not_a_number;  ///< K, of the hottest station
  double difference = not_a_number;           ///< K, coupled minus traced; NaN where either ignited
  RunOutcome outcome = RunOutcome::ran;       ///< of its run
  std::string failure = {};                   ///< why it did not complete
  std::optional<run::CombustionHistory> combustion = {};  ///< of one that ignited, with two-way coupling
  bool agrees() const { return completed && ignited == expected_ignition; }
};

/// How the mechanical run behind an answer went.
struct RunSummary {
  run::RunStatus status = run::RunStatus::completed;
  std::uint64_t steps = 0, particles = 0;
  double energy_drift = not_a_number;  ///< largest over the run, share of the largest energy
  run::LimiterCounts limiters;
};

/// Launch of a case under other constants.
struct ModelGap {
  std::string name;                              ///< of the constants
  GapOrBound critical_gap = math::not_a_number;  ///< m; the lower end of its bracket; NaN for a failed launch
  std::string failure = {};                      ///< why it is no basis; empty for a sound launch
};

/// Which of these failed and why, a clause; empty where none did.
std::string failed_models(const std::vector<ModelGap>& models);

/// One case with its gaps. A case that failed has indeterminate verdicts, no numbers, and the reason.
struct CaseAnswer {
  RunOutcome outcome = RunOutcome::ran;  ///< of the run it rests on, or that it lacks; not stored
  std::string failure;                   ///< why every verdict is indeterminate; empty for a completed run
  RunSummary run;                        ///< of a case that ran
  std::vector<std::string> runs;  ///< hashes of the runs that it was drawn from; while it is stored or read
  std::vector<std::string> validity_warnings;  ///< as CaseEvidence has them
  double friction_rise = not_a_number;         ///< K, likewise
  CriticalGap critical;                        ///< at the observation points
  std::vector<ModelGap> models;                ///< in the order of Study::models; none of a case that failed
  std::vector<GapVerdict> verdicts;  ///< in the order of the study's gaps; of one that failed not heated
  bool completed() const { return failure.empty(); }
};

/// One mechanical case with its gaps: the answer, once it is concluded (`answer_of`), and what it came from.
struct CaseOutcome : CaseAnswer {
  StudyCase input;
  run::CaseResult result;  ///< mechanics, and a skin history for every gap
  std::string hash;        ///< of the mechanical run: the name of its file in the store
  /// The mechanics under the raised load that shows what the inputs do, where the study states no uncertainty
  /// of them; empty for the others.
  std::optional<run::MechanicsResult> raised;
  std::shared_ptr<const CaseEvidence> evidence;  ///< once its gaps are evaluated
  /// K, T max without a gap of a skin that never reacts; NaN where nothing was computed.
  double heated_without_gap = not_a_number;
  std::vector<Confirmation> confirmations;
  std::vector<Line> lines;  ///< over the rows that do not ignite
};

}  // namespace launchsafe::study
