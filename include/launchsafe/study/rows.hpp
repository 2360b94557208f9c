// What a study knows of a case, as rows of plain numbers, and the verdict, a pure function of them: one row
// of the case with its critical gap, the causes that make it uncertain and the bounds that follow; one row of
// each judged gap.
#pragma once

#include "launchsafe/run/run_case.hpp"
#include "launchsafe/run/warning.hpp"
#include "launchsafe/study/gap_search.hpp"
#include "launchsafe/study/run_cases.hpp"

namespace launchsafe::study {

// --- causes and bounds ---

/// What makes a critical gap uncertain. Each is computed on the launch of the case itself.
enum class Cause {
  peak_pressure,
  pulse_length,
  initial_temperature,
  measured_curve,
  numerics,
  constants,
  after_launch,
  models
};
struct CauseTraits {
  Cause cause;
  std::string name;     ///< in files: "peak_pressure"
  std::string title;    ///< for people: "peak pressure"
  bool random = false;  ///< differs from launch to launch; the others are bounds of one fixed thing
  std::string remedy;   ///< what would make it smaller, for people
};
const std::vector<CauseTraits>& all_causes();
const CauseTraits& traits_of(Cause cause);

/// By how much a cause may move the critical gap, m, at least 0; NaN where that is not known.
struct CauseShare {
  Cause cause = Cause::numerics;
  double shorter = 0, longer = 0;
};

/// Bounds of a critical gap, m; NaN where a share is not known.
struct GapBounds {
  GapOrBound at_least = math::not_a_number, at_most = math::not_a_number;
};

/// at_least = H - sqrt(sum of squares of the random shares) - sum of the others, at least 0; at_most likewise
/// upwards. Without ignition up to the end of the search at_least is at most half of that, and at_most is not
/// bounded.
GapBounds bounds_of(const CriticalGap& gap, const std::vector<CauseShare>& causes);

// --- rows ---

/// A warning by its name, or an input that lies outside of an interval in which the constants hold.
struct Remark {
  std::string name;         ///< "shell-yields", "calibre"
  std::string text;         ///< what was found and what is expected, for people
  bool acceptable = false;  ///< whether a study may accept it with a reason
  std::string because;      ///< the reason; empty: nobody accepts it
  bool is_open() const { return because.empty(); }
};

/// A maximum with its place by name.
struct Peak {
  double temperature = math::not_a_number;  ///< K
  double time = math::not_a_number;         ///< s
  std::string point;                        ///< station
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

enum class Verdict { safe, unsafe, indeterminate };
std::string to_string(Verdict verdict);

/// Which rule gave a verdict; not_judged in studies that give none.
enum class ReasonCode {
  not_judged,
  failed,
  warning,
  ignites,
  no_critical_gap,
  within_bounds,
  extrapolated,
  below_bound
};
/// In files: "below-bound".
std::string to_string(ReasonCode code);

struct Judgement {
  Verdict verdict = Verdict::indeterminate;
  ReasonCode code = ReasonCode::not_judged;
};

/// One gap of a case.
struct GapRow {
  double gap = 0;                      ///< m
  Peak maximum;                        ///< over the stations and the whole launch
  Peak until_exit;                     ///< the same until scene::read_time: compared with references
  Peak early;                          ///< the same at Study::early_time
  double spread = math::not_a_number;  ///< K, over the stations at scene::read_time
  double margin = math::not_a_number;  ///< K, to the ignition temperature
  double heated =
      math::not_a_number;  ///< K, T max of a skin that air and friction heat and that never reacts
  /// K, of T max: what the bounds of the critical gap are at this gap by the slope of T max over the gap; for
  /// display. NaN where there are no bounds.
  double uncertainty = math::not_a_number;
  surface::AirEnergy air;                 ///< what the skin took from the air; NaN where nothing was computed
  std::optional<NamedIgnition> ignition;  ///< during the launch
  /// s after the end of the launch, of a skin that nothing but its own reaction heats.
  std::optional<double> ignition_after_launch;
  Judgement judgement;
  std::optional<Reference> reference;
  /// K, this until the exit minus the reference; NaN without one or where either ignited.
  double misfit() const;
  double early_misfit() const;
};

/// How a mechanical run went.
struct RunRow {
  run::RunStatus status = run::RunStatus::completed;
  std::uint64_t steps = 0, particles = 0;
  double energy_drift = math::not_a_number;  ///< largest over the run, share of the largest energy
  run::LimiterCounts limiters;
};

/// Launch of a case under other constants.
struct ModelGap {
  std::string name;                              ///< of the constants
  GapOrBound critical_gap = math::not_a_number;  ///< m; NaN for a launch that did not complete
};

/// One case with its gaps. A case whose launch failed has gaps without numbers, and the reason.
struct CaseRow {
  RunOutcome outcome = RunOutcome::ran;  ///< of the run it rests on, or that it lacks
  std::string failure;                   ///< why there are no numbers; empty where the launch completed
  RunRow run;
  std::vector<Remark> warnings;      ///< of the launch
  std::vector<Remark> extrapolated;  ///< intervals of the constants that the case lies outside of
  CriticalGap critical;
  std::vector<CauseShare> causes;
  std::string
      incomplete;  ///< launches beside its own that did not complete, for want of which it has no bounds
  GapBounds bounds;
  std::vector<ModelGap> models;  ///< in the order of Study::models
  std::vector<GapRow> gaps;      ///< in the order of the study's gaps
  bool completed() const { return failure.empty(); }
  /// "calibrated", or "extrapolated" outside of an interval, whether or not that is accepted.
  std::string basis() const { return extrapolated.empty() ? "calibrated" : "extrapolated"; }
};

// --- verdicts ---

/// The verdict of a gap, from its case and its own row alone; the first rule that fits gives it:
///
/// - failed, INDETERMINATE: the launch of the case, or one that its bounds rest on, did not complete;
/// - warning, INDETERMINATE: a warning that no study may accept;
/// - ignites, UNSAFE: the gap ignites during the launch;
/// - warning, INDETERMINATE: a warning that nobody accepts;
/// - no-critical-gap, INDETERMINATE: ignition comes and goes with the gap;
/// - within-bounds, INDETERMINATE: the gap is not thinner than the lower bound of the critical gap;
/// - extrapolated, INDETERMINATE: the case lies outside of an interval of its constants, which nobody
/// accepts;
/// - below-bound, SAFE.
Judgement judge(const CaseRow& of_case, const GapRow& gap);

/// m, the largest judged gap that with all smaller ones is SAFE; NaN where there is none.
double largest_safe_gap(const std::vector<GapRow>& gaps);

/// The cause that shortens the critical gap of a case most; none where none does.
std::optional<Cause> costliest(const CaseRow& of_case);

/// Why a verdict is what it is, for people: the rule with its numbers, and the reasons of whoever accepts.
std::string reason_text(const CaseRow& of_case, const GapRow& gap);
/// "shell-yields, because ...; calibre, because ..." of all that is accepted; empty where nothing is.
std::string accepted_text(const CaseRow& of_case);
/// Names of the warnings, or of the intervals, with commas between; empty without any.
std::string names_text(const std::vector<Remark>& remarks);

// --- the line of T max over the gap ---

/// T = intercept + slope * gap, gap in cm as the paper prints it.
struct Line {
  std::string name;
  double intercept = math::not_a_number;         ///< K
  double slope = math::not_a_number;             ///< K/cm
  double root_mean_square = math::not_a_number;  ///< K, of data minus line
  /// Standard errors of least squares, K and K/cm; NaN where no row is to spare, and for another line.
  double intercept_error = math::not_a_number, slope_error = math::not_a_number;
};

/// The line of least squares, and the one of its slope through the zero-gap row, which is how the paper
/// prints it, where there is such a row. None for fewer than two gaps (m), or numbers that are not finite.
std::vector<Line> fit_gaps(const std::vector<double>& gaps, const std::vector<double>& temperatures);

}  // namespace launchsafe::study
