// A study of kind critical-gap as a file: its keys, and the cases that follow.
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/study/cited_limits.hpp"
#include "launchsafe/study/study_cases.hpp"
#include "study_keys.hpp"
#include "study_outcome.hpp"
#include "sweep_surrogate.hpp"
#include "vary.hpp"

#include <fmt/format.h>

namespace launchsafe::kinds {

using study::Fault;

namespace {

std::vector<scene::Key<CriticalGapSettings>> critical_gap_keys() {
  return {
      scene::flag_key(
          "confirm", scene::Standing::assumed,
          fmt::format("Coupled runs on both sides of the bracket: the skin in the mechanics, and on through "
                      "combustion. Of a study with more than {} cases it is false unless stated.",
                      most_cases_in_detail),
          &CriticalGapSettings::confirm),
      scene::flag_key(
          "surrogate", scene::Standing::assumed,
          "A fit over the cases, held against those of inner values, from which launchsafe ask answers.",
          &CriticalGapSettings::surrogate),
  };
}

Fault read_critical_gap(const StudySource& source, study::StudyFile& study) {
  if (Fault fault = read_references(source, study)) return fault;
  return read_cited_limits(source.root, study);
}

Fault make_critical_gap_cases(const StudySource&, study::StudyFile& study) {
  if (settings_of<CriticalGapSettings>(study.study).surrogate)
    if (Fault fault = check_sweep_surrogate(study)) return fault;
  if (Fault fault = make_factorial(study)) return fault;
  const bool few = study.cases.size() <= most_cases_in_detail;
  bool& confirm = settings_of<CriticalGapSettings>(study.study).confirm;
  if (!study.places.contains("confirm")) confirm = few;
  study.study.in_detail = few || confirm;
  study.confirmations_per_case = confirm ? 2 : 0;
  return std::nullopt;
}

std::vector<Failure> critical_gap_failures(const CriticalGapResult& result) {
  std::vector<Failure> failures = failures_of(result);
  for (const study::CaseOutcome& each : result.details) {
    for (const study::Confirmation& confirmation : each.confirmations)
      add_failure(failures, label_with_skin(each, confirmation.gap), confirmation.outcome,
                  confirmation.failure);
  }
  return failures;
}

}  // namespace

Kind critical_gap_kind() {
  return {
      .traits = {.name = "critical-gap", .keeps_answers = true, .judges_closing_gaps = true},
      .keys = joined({reference_keys(), gaps_keys(), own_keys(critical_gap_keys()), judging_keys(),
                      calibration_record_keys(), uncertainty_keys()}),
      .tables = {reference_table(), cited_limit_table(), vary_table()},
      .varies = {.values = true},
      .read = read_critical_gap,
      .make_cases = make_critical_gap_cases,
      .run = outcome_of<run_critical_gap, critical_gap_failures>,
      // Reports of older programs had files of cases too, and critical_gaps.json.
      .files = {{"closing.svg"},
                {"verdicts.md"},
                {"temperature.svg"},
                {"critical_gaps.md"},
                {"critical_gap", ".svg"},
                {"critical_gaps.json"},
                {"surrogate.json"},
                {"ask.html"},
                {"case_", ".h5"},
                {"case_", ".xdmf"}},
      .results = critical_gap_results,
  };
}

}  // namespace launchsafe::kinds
