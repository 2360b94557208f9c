// What a study knows of one gap, and of one case with its gaps.
#pragma once

#include "launchsafe/math/statistics.hpp"
#include "launchsafe/study/options.hpp"
#include "launchsafe/study/study_file.hpp"
#include "launchsafe/study/verdict.hpp"
#include "launchsafe/trace/bottom_trace.hpp"

namespace launchsafe::study {

/// T = intercept + slope * gap, gap in cm as the paper prints it.
struct Line {
  double intercept = not_a_number;         ///< K
  double slope = not_a_number;             ///< K/cm
  std::vector<double> residuals;           ///< K, data minus line
  double root_mean_square = not_a_number;  ///< K, of the residuals
};

/// A curve by least squares, and how well each row follows from the others. NaN where there are too few rows.
struct FittedCurve {
  std::string name;
  int coefficients = 0;
  double root_mean_square = not_a_number;  ///< K, of the residuals
  /// K, of what each row is off the curve through the other rows.
  double left_out = not_a_number;
  /// Akaike's criterion with the correction of Hurvich and Tsai (Biometrika 76, 1989) for few rows.
  double corrected_akaike = not_a_number;
};

struct GapFit {
  std::vector<double> gaps;          ///< m
  std::vector<double> temperatures;  ///< K
  math::LeastSquares least_squares;  ///< coefficients: intercept (K), slope (K/cm)
  Line ordinary;                     ///< the same as a line
  std::optional<Line> mixed;  ///< slope of least squares through the zero-gap row; only where there is one
  std::optional<Line> published;  ///< the study's reference line
  std::vector<double> left_out;   ///< K, of each row less what the line through the others has there
  /// m, where the line reaches the ignition temperature, and half the width of the band of 95 % there; NaN
  /// where it does not rise, or has no band.
  double reaches_ignition = not_a_number, reaches_ignition_half_width = not_a_number;
  /// The straight line, a parabola, and the line with the heat of reaction of a skin at the line's
  /// temperature. None where no line has a row to spare.
  std::vector<FittedCurve> curves;
};

/// Nothing for fewer than two gaps (m), or numbers that are not finite.
std::optional<GapFit> fit_gaps(const std::vector<double>& gaps, const std::vector<double>& temperatures,
                               const materials::KineticsParameters& kinetics,
                               const ReferenceLine& published = {});

/// A skin with one constant as calibrated.
struct AsCalibrated {
  std::string key;         ///< the constant; empty: all that heat or cool the skin, together
  double temperature = 0;  ///< K, T max over the stations
  bool ignites = false;
};

/// Of what has to be accepted, the constants that heat or cool the skin on a given trace: those of gap and
/// friction, and single ones of the charge. Accepting them makes no gap safe.
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

/// A gap on the terms of a bound.
struct ClosingPoint {
  double gap = 0;                             ///< m
  double maximum_temperature = not_a_number;  ///< K, at any depth and station; NaN where a run has none
  bool ignited = false;
  std::string place;             ///< station of the maximum
  double release = 0;            ///< s, of the terms on which that is
  std::string unknown_for = {};  ///< why there is no temperature; empty where there is one
  /// K, up to which T max may be by mesh, steps and columns of its launches, of which the hottest need not be
  /// the worst known.
  double at_most = not_a_number;
  bool recorded = false;     ///< that rests on accuracy records alone
  std::size_t launches = 1;  ///< that it was taken from
};

/// What a bound says: the points that were computed, by gap, and the smallest gap of them that ignites.
struct ClosingAnswer {
  std::string name;
  std::vector<ClosingPoint> points;
  /// m, between the largest below which nothing ignites (NaN: there is none) and the smallest that does
  /// (infinite: none up to the end of the search; NaN: a temperature beyond `lower` is not known).
  double lower = not_a_number, upper = not_a_number;
  const ClosingPoint* at(double gap) const;
  bool is_nominal() const { return name == "conducting" || name == "insulated"; }
  bool is_worst_corner() const { return name == "corner"; }
};

/// A maximum with its place by name.
struct Peak {
  double temperature = not_a_number;  ///< K
  double time = not_a_number;         ///< s
  std::string point;                  ///< station
};

struct NamedIgnition {
  surface::IgnitionCause cause = surface::IgnitionCause::trigger;
  double time = 0;  ///< s
  std::string point;
  double chemical_share = 0;  ///< of the heating rate at ignition
};
std::string to_string(surface::IgnitionCause cause);

/// A row of the verdict table.
struct GapVerdict {
  double gap = 0;                      ///< m
  Peak maximum;                        ///< over the stations: what the verdict uses
  Peak until_exit;                     ///< the same until scene::read_time: what a reference is compared with
  Peak early;                          ///< the same at Study::early_time
  double spread = not_a_number;        ///< K, over the stations at scene::read_time
  double early_spread = not_a_number;  ///< K, at Study::early_time
  double margin = not_a_number;        ///< K, to the ignition temperature
  double heated = not_a_number;  ///< K, T max of a skin that air and friction heat and that never reacts
  std::vector<AsCalibrated> as_calibrated;  ///< with foreign constants of the surface as calibrated
  surface::AirEnergy air;  ///< what the skin took from the air; NaN where nothing was computed
  Uncertainty uncertainty;
  std::optional<NamedIgnition> ignition;  ///< at an observation point
  Evidence evidence;                      ///< what the judgement rests on
  Judgement judgement;
  std::optional<Reference> reference;
  /// K, this until the exit minus the reference; NaN without one or where either ignited
  double misfit() const;
  double early_misfit() const;
};

/// Judges the rows of a case on their numbers and on what all of them rest on: the same whether they were
/// computed or read.
void judge_rows(const Study& study, const std::shared_ptr<const CaseEvidence>& of_case,
                const CriticalGap& critical, std::vector<GapVerdict>& rows);
std::string reason_text(const GapVerdict& row);
/// m, the largest judged gap that with all smaller ones is SAFE; NaN where there is none.
double largest_safe_gap(const std::vector<GapVerdict>& rows);

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

/// The same case on other terms, which stands beside the answer and gives no verdict.
struct OtherAnswer {
  std::vector<double> maximum_temperature;  ///< K, of the charge's surface, for every gap of the study
  CriticalGap critical;                     ///< without an uncertainty
};

/// How the mechanical run behind an answer went.
struct RunSummary {
  run::RunStatus status = run::RunStatus::completed;
  std::uint64_t steps = 0, particles = 0;
  double energy_drift = not_a_number;  ///< largest over the run, share of the largest energy
  run::LimiterCounts limiters;
};

/// One case with its gaps. A case that failed has indeterminate verdicts, no numbers, and the reason.
struct CaseAnswer {
  RunOutcome outcome = RunOutcome::ran;  ///< of the run it rests on, or that it lacks; not stored
  std::string failure;                   ///< why every verdict is indeterminate; empty for a completed run
  RunSummary run;                        ///< of a case that ran
  std::vector<std::string> runs;  ///< hashes of the runs that it was drawn from; while it is stored or read
  std::vector<std::string> validity_warnings;  ///< as CaseEvidence has them
  double friction_rise = not_a_number;         ///< K, likewise
  CriticalGap critical;                        ///< at the observation points
  std::vector<GapVerdict> verdicts;    ///< in the order of the study's gaps; of one that failed not heated
  std::vector<ClosingAnswer> closing;  ///< with a gap that closes, where the case has one; not stored
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
  double heat_factor = 1.0;  ///< by what firings leave open of the constants; 1 where none calibrated
  std::vector<Confirmation> confirmations;
  std::optional<GapFit> fit;  ///< over the rows that do not ignite
  /// With air as a film that conserves energy, an optimistic bound: of a completed run with the reservoir.
  std::optional<OtherAnswer> film;
  /// Of the longer launch (scene::longer_launch), where there is one; indeterminate where that run did not
  /// complete.
  std::optional<OtherAnswer> longer_launch;
};

}  // namespace launchsafe::study
