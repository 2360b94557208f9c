// The study of kind sweep: verdicts and critical gaps over a full factorial of scene keys.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/report/report.hpp"
#include "launchsafe/study/case_answer.hpp"
#include "launchsafe/study/options.hpp"
#include "launchsafe/study/study_file.hpp"

#include <string>
#include <vector>

namespace launchsafe::kinds {

struct SweepResult {
  study::StudyFile study;
  std::vector<study::CaseAnswer> answers;  ///< one for each of StudyFile::cases
  study::Timing timing;
  bool interrupted = false;
  bool any_indeterminate() const;  ///< a verdict or a critical gap is indeterminate
};

/// Runs a study of kind sweep. A case's failure is that case's row. Apart from the timing the result depends
/// on the study alone, whatever was stored before.
SweepResult run_sweep(const study::StudyFile& study, const study::StudyOptions& options = {});

/// The row of the table of kinds.
Kind sweep_kind();

/// The answer in a few lines: values and bounds, the smallest critical gap and where it is, verdicts,
/// failures.
std::string answer(const SweepResult& result);

/// A row for every case: its coordinates, critical gap and run. A bound is text, never a number among values.
report::Table critical_gap_table(const SweepResult& result);
/// The study's cited limits beside the critical gaps of its cases; without rows where it cites none.
report::Table cited_limit_table(const SweepResult& result);
/// By how much each axis with several values changes T max and critical gap at most, and of the crack radius
/// also below the flaw size; without rows where there is no such axis.
report::Table axis_effect_table(const SweepResult& result);
/// A row for every gap of every case, for other programs.
report::Table verdict_table(const SweepResult& result);
/// A row for every case and a column for every gap: SAFE, UNSAFE or INDET.
report::Table verdict_matrix(const SweepResult& result);

/// What these tables hold, but for the axes of a study.
std::vector<ResultTable> sweep_results();

/// Critical gap over the axes that have several values: a curve over one, or maps over the first two, one for
/// each combination of the others, and then the same less its uncertainty.
struct SweepPictures {
  std::vector<report::Picture> pictures;
  std::vector<std::string> remarks;  ///< combinations that have no picture
};
SweepPictures pictures(const SweepResult& result);

/// The whole report. Nothing in it differs between two runs of a study: no times, rates, dates or hosts.
report::Report report_of(const SweepResult& result);

}  // namespace launchsafe::kinds
