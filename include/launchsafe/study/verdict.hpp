// Safe, unsafe or indeterminate: what the input of a case says of all its verdicts, the rules, and the words.
// What an input says is found once a case and never stored: a verdict that is read rests on what it says now.
#pragma once

#include "launchsafe/run/case_result.hpp"
#include "launchsafe/study/model_form.hpp"

namespace launchsafe::study {

struct Study;
struct StudyCase;

/// Calibres of travel: no barrel is shorter.
inline constexpr double fewest_calibres = 10.0;
/// K, by which friction heats the bottom of a charge that was launched, at the least.
inline constexpr double least_friction_rise = 1.0;

struct CaseStatements {
  std::vector<std::string> uncovered_load;  ///< of run::uncovered_load
  /// Why no ignition shows nothing, whatever the case accepts, by the input alone; a study without verdicts
  /// knows films only. Empty: it may show something.
  std::string optimistic;
  std::string ring;  ///< that a measured curve rings, for people; empty for none; in detail with
                     ///< a mode of the shell (run::ring_text)

  bool closes = false;  ///< gaps are to be looked at as they close, too

  // The rest is empty for a study without verdicts.
  RecordDistance distance;                      ///< to the calibration
  std::vector<scene::Implausible> implausible;  ///< of the case and of what its study states, accepted or not
  std::vector<std::string> extrapolated;  ///< what lies beyond the calibration's domain at any gap, by name:
                                          ///< first what is foreign to it
  /// m, up to which a gap lies within it.
  double calibrated_gap = math::infinity;
  bool calibrated_by_firings = false;  ///< so that nothing is known of a gap beyond
  bool demonstration = false;          ///< of something that was invented

  /// Of the study's record of other models; not known where there is none.
  ModelFormShift model_form{math::not_a_number, math::not_a_number, {}};

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
  double load_curve = 0;   ///< of a measured curve: what its noise heats, and what smoothing took from it
  double model_form = 0;   ///< by which other models of the launch move towards ignition
  /// Of a base on which the charge slides: all heat of friction, and the gap that opens there or by cooling.
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
  bool completed = false;           ///< the run ended as it should
  std::string failure = {};         ///< why not, otherwise
  run::LimiterCounts limited = {};  ///< limiters that acted
  /// Why a completed run is no basis (see run::validity_warnings), a clause each; none for a sound one.
  std::vector<std::string> validity_warnings = {};
  /// K, of T max without a gap by friction; infinite where a study does not ask whether it was launched.
  double friction_rise = math::infinity;
  CaseStatements input = {};
};

/// Why a case has no critical gap, whatever a search finds, for people; empty where it may have one.
std::string why_no_critical_gap(const CaseEvidence& of_case);

/// What gaps that close say of one gap (closing_gaps.hpp).
struct ClosingEvidence {
  bool known = false;    ///< every bound that was computed has a temperature
  bool ignited = false;  ///< with a base that conducts, or with an insulated one
  /// K, in the worst corner or on another bound that comes nearer to ignition; minus infinity where it
  /// ignites there, or a thinner gap does; NaN where the corner was not computed.
  double corner_margin = math::not_a_number;
  /// K, by which its T max may be off for mesh, steps and columns: by an accuracy record that was made on its
  /// terms, or assumed.
  double numerical = math::not_a_number;
};

/// All that a verdict rests on.
struct Evidence {
  std::shared_ptr<const CaseEvidence> of_case = {};  ///< without it nothing is safe
  bool ignited = false;                              ///< at a station
  double gap = 0;                                    ///< m
  double maximum_temperature = 0;                    ///< K, over the stations
  double margin = 0;                                 ///< K, ignition temperature minus maximum temperature
  double uncertainty = 0;                            ///< K
  /// K, of that what mesh, step and scaling have, which are not those of a gap that closes.
  double numerical = 0;
  /// K, margin with the constants of the surface as calibrated; infinite where they are.
  double calibrated_margin = math::infinity;
  double noise = 0;  ///< K, what noise and smoothing of a measured curve count
  /// K, T max when a launch that is cut short goes on until it is over; NaN for others.
  double when_over = math::not_a_number;
  ClosingEvidence closing = {};  ///< of a case that asks for it
  /// K, of T max in the worst corner: the numerics are its own.
  double closing_uncertainty() const { return uncertainty - numerical + closing.numerical; }
  std::vector<std::string> models = {};  ///< titles of other models that could change the verdict
};

/// Which rule gave a verdict.
enum class ReasonCode {
  not_judged,
  failed,
  no_temperature,
  validity_warning,
  ignition,
  closing_ignition,
  unaccepted,
  no_margin,
  optimistic,
  beyond_firings,
  critical_gap_indeterminate,
  several_crossings,
  smaller_gaps_ignite,
  margin_within_uncertainty,
  calibrated_margin_within_uncertainty,
  margin_over_uncertainty,
  no_lower_bound,
  may_ignite_without_gap,
  not_below_bound,
  closing_unknown,
  closing_without_corner,
  closing_corner,
  below_bound
};
/// In files: "below-bound".
std::string to_string(ReasonCode code);

/// A verdict and why; its words are in statement_text.cpp.
struct Judgement {
  Verdict verdict = Verdict::indeterminate;
  ReasonCode code = ReasonCode::not_judged;
  double at_least = math::not_a_number;  ///< m, CriticalGap::bounds
  std::string critical_gap = {};         ///< why there is none, where that is the reason
};

/// The contract of a verdict, for a sound run: one that completed with finite temperatures and without
/// validity warnings of its own. Every other run is INDETERMINATE.
///
/// - UNSAFE: the gap ignites in the computation as it is stated, whatever of its input nobody accepts.
/// - SAFE: all of the input is plausible and of the calibration, or accepted; the gap does not ignite, and is
///   thinner than the lower bound of the critical gap (CriticalGap::bounds). Where nothing ignites up to the
///   end of the search, that is the bound, and the margin must exceed the uncertainty besides, also with the
///   constants of the surface as calibrated. Where firings calibrated, a round as severe was fired without
///   ignition.
///   Where the gap is to close, the worst corner of how it may do so does not ignite either, by a margin
///   above the uncertainty, in which the numerics are those of that corner; nor, for UNSAFE, need the
///   reservoir ignite where one of the closing bounds does.
/// - INDETERMINATE: everything else.
///
/// More uncertainty, a wider range or less evidence never moves a verdict towards SAFE. A verdict on a run in
/// which limiters acted says so.
Judgement judge(const Evidence& evidence, const CriticalGap& critical);

// Clauses of a reason; each is empty where there is nothing to say.

/// Why a run is no basis, and what becomes of a gap when a launch that is cut short goes on until it is over.
std::string validity_warnings_text(const Evidence& evidence);
/// What of the input is not plausible, or foreign to the calibration, and not accepted.
std::string unaccepted_text(const CaseStatements& input);
/// What is not plausible, or foreign, and why it is meant.
std::string accepted_text(const CaseStatements& input);
std::string limiters_text(const Evidence& evidence);
/// What the noise of a measured curve counts.
std::string noise_text(const Evidence& evidence);
/// Models that could change the verdict.
std::string models_text(const Evidence& evidence);
/// What lies outside the calibration's domain.
std::string extrapolated_text(const Evidence& evidence);

/// What the rule says that gave the verdict.
std::string cause_text(const Evidence& evidence, const Judgement& judgement);
/// Why a verdict is what it is: the cause, and all that stands beside it.
std::string reason_text(const Evidence& evidence, const Judgement& judgement);

}  // namespace launchsafe::study
