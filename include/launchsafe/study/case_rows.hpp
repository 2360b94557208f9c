// From the finished launches of a case to its row: critical gap, causes, bounds, gaps and verdicts, all
// integrated on bottom traces; and the rows of all cases of a study with the fewest launches: cases that
// differ in thermal keys alone share one, and what is stored is not computed again.
#pragma once

#include "launchsafe/study/causes.hpp"
#include "launchsafe/study/study_cases.hpp"

namespace launchsafe::study {

/// A coupled run on one side of a critical gap.
struct Confirmation {
  double gap = 0;  ///< m
  bool expected_ignition = false;
  bool ran = false;
  bool completed = false;
  bool ignited = false;
  double maximum_temperature = math::not_a_number;        ///< K, of the hottest station
  RunOutcome outcome = RunOutcome::ran;                   ///< of its run
  std::string failure = {};                               ///< why it did not complete
  std::optional<run::CombustionHistory> combustion = {};  ///< of one that ignited, with two-way coupling
  bool agrees() const { return completed && ignited == expected_ignition; }
};

/// A case with all that its row was drawn from.
struct CaseInDetail : CaseRow {
  StudyCase input;
  run::CaseResult result;  ///< mechanics, and a skin history for every gap
  std::string hash;        ///< of the mechanical run: the name of its file in the store
  std::vector<Confirmation> confirmations;
  std::vector<Line> lines;  ///< over the gaps that do not ignite
};

/// A case from its finished launches, the first being its own. In studies that give verdicts with bounds and
/// verdicts; in others without.
CaseInDetail draw_case(const Study& study, const StudyCase& input, const std::vector<FinishedRun>& runs);

/// Its row alone.
CaseRow draw_row(const Study& study, const StudyCase& input, const std::vector<FinishedRun>& runs);
/// The row of a case from its own launch, in studies that give no verdicts.
CaseRow draw_row(const Study& study, const StudyCase& input, const run::MechanicsResult& mechanics);

/// Takes what coupled runs say: one that did not complete, or does not do what the critical gap says of its
/// gap, leaves the case without bounds. Judges the gaps anew.
void apply_confirmations(CaseInDetail& of_case);

/// A row for every case; one that was not run, failed or belongs to another shard says so.
std::vector<CaseRow> draw_rows(const StudyFile& study, const StudyOptions& options, Timing& timing,
                               ProgressTracker& tracker);

/// How far a run came that was cut off depends on the machine, and is no part of the result.
bool was_cut_off(const FinishedRun& run);

}  // namespace launchsafe::study
