// A study of kind critical-gap as a file: its keys, and the cases that follow.
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/study/cited_limits.hpp"
#include "launchsafe/study/study_axes.hpp"
#include "launchsafe/study/study_cases.hpp"
#include "study_keys.hpp"
#include "study_outcome.hpp"

namespace launchsafe::kinds {

using namespace study;

namespace {

using scene::Dimension;

std::vector<scene::Key<CriticalGapSettings>> critical_gap_keys() {
  return {
      assumed_list("peak_pressures", Dimension::pressure, scene::above_to(0, 10e9),
                   "Peak chamber pressures, each a mechanical run; the scene's if absent.",
                   &CriticalGapSettings::peak_pressures),
      assumed_list("crack_radii", Dimension::length, scene::between(0, 0.01),
                   "Initial crack radii c(0), each a mechanical run; the scene's if absent.",
                   &CriticalGapSettings::crack_radii),
      assumed_list("flaw_sizes", Dimension::length, scene::between(0, 0.01),
                   "Flaw sizes a, each a mechanical run; the scene's if absent.",
                   &CriticalGapSettings::flaw_sizes),
      scene::flag_key<CriticalGapSettings>(
          "confirm", scene::Standing::assumed,
          "Coupled runs on both sides of the bracket: the skin in the mechanics, and on through combustion.",
          &CriticalGapSettings::confirm),
  };
}

/// The lists that are given become axes, in this order.
Fault read_critical_gap(const StudySource& source, StudyFile& study) {
  if (Fault fault = read_references(source, study)) return fault;
  if (Fault fault = read_cited_limits(source.root, study)) return fault;
  const CriticalGapSettings& own = settings_of<CriticalGapSettings>(study.study);
  if (Fault fault = add_axis(study, "peak_pressure", "peak_pressures", own.peak_pressures)) return fault;
  if (Fault fault = add_axis(study, "crack_radius", "crack_radii", own.crack_radii)) return fault;
  if (Fault fault = add_axis(study, "flaw_size", "flaw_sizes", own.flaw_sizes)) return fault;
  study.confirmations_per_case = own.confirm ? 2 : 0;
  return std::nullopt;
}

Fault make_critical_gap_cases(const StudySource&, StudyFile& study) {
  return make_factorial(study, launch_label);
}

std::vector<Failure> critical_gap_failures(const CriticalGapResult& result) {
  std::vector<Failure> failures;
  for (const CaseOutcome& each : result.cases) {
    add_failure(failures, each.input.label, each.outcome, each.failure);
    for (const Confirmation& confirmation : each.confirmations)
      add_failure(failures, label_with_skin(each, confirmation.gap), confirmation.outcome,
                  confirmation.failure);
  }
  return failures;
}

}  // namespace

Kind critical_gap_kind() {
  return {
      .traits = {.name = "critical-gap", .gaps_key = "gaps", .runs_longer_launches = true},
      .keys = joined({reference_keys(), gaps_keys(), own_keys(critical_gap_keys()), judging_keys(),
                      calibration_record_keys(), uncertainty_keys()}),
      .tables = {reference_table(), cited_limit_table()},
      .instead_of = {{"gap", "gaps"}},
      .read = read_critical_gap,
      .make_cases = make_critical_gap_cases,
      .run = outcome_of<run_critical_gap, critical_gap_failures>,
      // Reports of older programs had files of cases too.
      .files = {{"verdicts.csv"},
                {"verdicts.md"},
                {"temperature.svg"},
                {"critical_gaps.svg"},
                {"case_", ".h5"},
                {"case_", ".xdmf"}},
      .results = critical_gap_results,
  };
}

}  // namespace launchsafe::kinds
