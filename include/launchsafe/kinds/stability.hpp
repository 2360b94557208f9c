// The study of kind stability: a matrix of stress cases, and what became of each.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/report/report.hpp"
#include "launchsafe/study/case_answer.hpp"
#include "launchsafe/study/options.hpp"
#include "launchsafe/study/study_file.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace launchsafe::kinds {

/// What became of a stress case.
enum class Outcome {
  held,      ///< what must hold held
  degraded,  ///< it did not, or not fully, and the result says so itself
  caught,    ///< the computation was stopped or flagged
  wrong      ///< a broken computation gave a finite, plausible result without a flag
};
std::string to_string(Outcome outcome);  ///< "held", "degraded", "caught", "WRONG"

struct Finding {
  Outcome outcome = Outcome::wrong;
  std::string text;  ///< the numbers behind it, or the reason
};

/// One [[case]] of a stability study: a launch that is extreme, or whose computation is, and what must hold.
struct StressCase {
  std::string group, name;
  std::string must_hold;          ///< a sentence
  std::vector<Outcome> expected;  ///< acceptable ones; empty: anything but WRONG
  /// Steps within which a broken computation must be caught; 0: any number.
  std::uint64_t caught_within = 0;
  std::vector<double> gaps;            ///< m, to judge; all on one run
  bool burns = false;                  ///< its coupling is two-way: every gap has a run through ignition too
  std::optional<std::size_t> run;      ///< of StudyFile::cases; none for a case of the reader
  std::optional<std::size_t> against;  ///< of StudyFile::cases: a safe computation of the same launch
  std::string must_refuse;             ///< a case of the reader: what its message must say; else empty
  std::string refusal;                 ///< what the reader said; empty where it took the scene
};

/// What a study file of this kind says besides.
struct StabilitySettings {
  std::vector<StressCase> cases;  ///< in the order written; their runs are among the cases
};

/// What every computation that completed must fulfil, each as a sentence about how it does not; none for a
/// sound one. Finite numbers, masses to round-off, the balance of momentum (in the co-moving frame none; in
/// the lab's the impulse of the load), energy drift within the scene's limit, dissipation and friction heat
/// that never fall, and no skin colder than charge and air were at first, whose pressure never falls below
/// the initial one.
std::vector<std::string> violations_of(const scene::Scene& scene, const run::MechanicsResult& mechanics,
                                       const std::vector<double>& gaps);

/// What a run through ignition of one gap (m) came to.
struct Burn {
  double gap = 0;
  Finding finding;
};

/// Caught: it broke off, and says why. WRONG: it completed with numbers that are not finite, an energy
/// residual above 1 % of the heat of reaction of what burnt, an energy drift past the scene's limit, more
/// burnt than the charge has, heat released beyond that of reaction, or gas outside of the temperatures of
/// its law. Degraded: nothing ignited, or a validity warning holds.
Finding judge_burn(const scene::Scene& scene, double gap, const run::CaseResult& result);

/// Of a launch and what its runs through ignition came to: WRONG before caught before degraded before held.
Finding joined_finding(Finding launch, const std::vector<Burn>& burns);

/// One gap of a stress case beside the safe computation of the same launch.
struct StressCaseGap {
  double gap = 0;                            ///< m
  double temperature = study::not_a_number;  ///< K, T max over the stations
  double heated = study::not_a_number;       ///< K, the same of a skin that neither reacts nor is triggered
  double heated_against = study::not_a_number;  ///< K, of the safe computation; NaN without one
  double ignition = study::not_a_number;        ///< K, ignition temperature
  double uncertainty = study::not_a_number;     ///< K
  study::Judgement judgement;
  /// K, of `heated` from the safe computation, both up to ignition: beyond it they say the same. NaN without
  /// a safe computation.
  double deviation() const {
    return (heated > ignition ? ignition : heated) - (heated_against > ignition ? ignition : heated_against);
  }
  bool deviates() const { return deviation() > uncertainty || deviation() < -uncertainty; }
};

/// A row of the matrix.
struct StressCaseRow {
  std::string group, name, must_hold;
  Finding finding;
  std::vector<Outcome> expected;                       ///< empty: anything but WRONG
  study::RunOutcome outcome = study::RunOutcome::ran;  ///< of its run, or of that of the safe computation
  std::string failure;                                 ///< why it was not computed at all; empty where it was
  bool ran = false;                                    ///< a launch: the members below tell of its run
  study::RunSummary run;
  double end_time = study::not_a_number;  ///< s, reached
  std::vector<std::string> violations;    ///< of invariants
  std::vector<std::string> validity_warnings;
  std::vector<StressCaseGap> gaps;

  bool computed() const { return failure.empty(); }
  bool is_wrong() const { return computed() && finding.outcome == Outcome::wrong; }
  /// Neither WRONG nor other than what the study expects.
  bool is_as_expected() const;
};

struct StabilityResult {
  study::StudyFile study;
  std::vector<StressCaseRow> rows;  ///< the cases as written
  study::Timing timing;
  bool interrupted = false;
  std::size_t count(Outcome outcome) const;  ///< rows that were computed and came out so
  std::size_t wrong() const { return count(Outcome::wrong); }
  std::size_t unexpected() const;  ///< computed, not WRONG, and yet not what the study expects
  std::size_t failed() const;      ///< not computed
};

/// Runs a study of kind stability. A case that breaks is its row. Apart from the timing the result depends on
/// the study alone.
StabilityResult run_stability(const study::StudyFile& study, const study::StudyOptions& options = {});

/// The row of the table of kinds.
Kind stability_kind();

/// How many cases came out how; and every one that is WRONG, not as expected or not computed, by name.
std::string answer(const StabilityResult& result);

/// A row for every case: what must hold, what became of it, and why.
report::Table stability_table(const StabilityResult& result);
/// The same for a terminal: without what must hold, and long findings cut.
report::Table stability_summary(const StabilityResult& result);
/// A row for every gap of every launch that ran, with the numbers behind its outcome.
report::Table launch_table(const StabilityResult& result);

/// The whole report. Nothing in it differs between two runs of a study: no times, rates, dates or hosts.
report::Report report_of(const StabilityResult& result);

}  // namespace launchsafe::kinds
