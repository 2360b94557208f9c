// The study of kind stability: a table of stress cases, and what became of each.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/study/rows.hpp"

namespace launchsafe::kinds {

/// What became of a stress case, the worst last.
enum class Outcome {
  held,      ///< what must hold held
  degraded,  ///< it did not, or not fully, and the result says so itself
  caught,    ///< the computation was stopped or flagged
  wrong      ///< a broken computation gave a finite, plausible result without a flag
};
std::string to_string(Outcome outcome);  ///< "held", "degraded", "caught", "WRONG"

using Sentences = std::vector<std::string>;

struct Finding {
  Outcome outcome = Outcome::wrong;
  std::string text;  ///< the reason, then the numbers behind it
};

/// A run that completed; of one that went through an ignition, what burnt is judged alone.
struct CompletedRun {
  const scene::Scene& scene;
  const run::MechanicsResult& mechanics;
  const std::vector<double>& gaps;  ///< m
  const run::CombustionHistory* combustion = nullptr;
};

/// What a computation that completed must fulfil.
struct Invariant {
  std::string name, words;  ///< for people: "friction-heat", and what it says
  /// Adds how a launch, or what burnt, violates it, a sentence each; not checked where there is no function.
  void (*of_launch)(const CompletedRun& run, Sentences& violations) = nullptr;
  void (*of_burn)(const CompletedRun& run, Sentences& violations) = nullptr;
};
const std::vector<Invariant>& all_invariants();

/// One case of a stability study: a launch that is extreme, or whose computation is, and what must hold.
struct StressCase {
  std::string group, name;
  std::string scene;              ///< path of its own, from the study file's folder; empty: the study's
  std::string refused;            ///< a case of the reader: what it must say of the scene; else empty
  std::string refusal;            ///< what the reader said; empty where it took the scene
  std::vector<Outcome> expected;  ///< acceptable ones; empty: anything but WRONG
  double tolerance = study::not_a_number;  ///< K, by which T max may be off that of the safe computation
  /// Steps within which a broken computation must be caught; 0: any number.
  std::uint64_t caught_within = 0;
  std::vector<double> gaps;            ///< m, to judge; all on one run
  std::optional<std::size_t> run;      ///< of StudyFile::cases; none for a case of the reader
  std::optional<std::size_t> against;  ///< of StudyFile::cases: a safe computation of the same launch

  std::string label() const { return group + ": " + name; }
  bool expects(Outcome outcome) const;
};

/// What a study file of this kind says besides.
struct StabilitySettings {
  double temperature_tolerance = 4.0;  ///< K, StressCase::tolerance of cases that state none
  std::vector<StressCase> cases;       ///< in the order written; their runs are among the cases
};

/// How a run violates the invariants, a sentence each; none for a sound one. All but the same temperature,
/// which takes two runs.
Sentences violations_of(const CompletedRun& run);

/// A stress case and what became of it.
struct StressCaseRow {
  StressCase asked;
  study::CaseRow result;                  ///< of a case that runs, or why it was not computed
  double end_time = study::not_a_number;  ///< s, reached
  /// By gap, K; none without a safe computation: GapRow::heated of that, and how far the case
  /// is off it, both up to ignition: beyond it they say the same.
  std::vector<double> heated_against, deviations;
  Finding finding;

  bool computed() const;
  bool is(Outcome outcome) const { return computed() && finding.outcome == outcome; }
  /// Computed, not WRONG, and what the study expects.
  bool is_as_expected() const;
};

struct StabilityResult : StudyResult {
  std::vector<StressCaseRow> rows;           ///< the cases as written
  std::size_t count(Outcome outcome) const;  ///< rows that were computed and came out so
};

/// Runs a study of kind stability. A case that breaks is its row. Apart from the timing the result depends on
/// the study alone. Of a launch and its runs through ignition the worst counts.
///
/// Caught: the reader refused the scene, or the run was stopped. WRONG: an invariant is violated, and nothing
/// in the result says so: no validity warning, no limiter, no temperature that is no number; or the run went
/// through an ignition. Degraded: an invariant is violated, and the result says so; validity warnings,
/// limiters, nothing that ignited, a stop that came later than it must, or nothing left to compare with.
/// Held: everything else.
StabilityResult run_stability(const study::StudyFile& study, const study::StudyOptions& options = {});

/// How many cases came out how; and every one that is WRONG, not as expected or not computed, by name.
std::string answer(const StabilityResult& result);

/// Its file stability.csv has a row for every gap of every case. Nothing in it differs between two runs of a
/// study: no times, rates, dates or hosts.
report::Report report_of(const StabilityResult& result);

}  // namespace launchsafe::kinds
