// What the outcomes, tables and pages of several kinds of study share.
#pragma once

#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/report/page_texts.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "launchsafe/study/case_answer.hpp"

namespace launchsafe::kinds {

namespace quantity = report::quantity;

// What all sources of kinds speak of.
using keys::Cell, keys::centimetre, keys::count, keys::fixed, keys::Form, keys::joined, keys::kelvin,
    keys::millisecond, keys::percent, keys::second, keys::significant, keys::text;
using report::centimetres, report::Column, report::digits_of, report::in_words, report::json_of, report::Mark,
    report::milliseconds, report::Picture, report::Plot, report::Quantities, report::reads_as, report::Report,
    report::ReportTable, report::Row, report::Series, report::Shown, report::shown_gap, report::shown_value,
    report::ShownKey, report::Style, report::Table, report::table_of;
using run::MechanicsResult;
using scene::format_quantity, scene::GapModel, scene::Load, scene::Scene;
using study::Axis, study::CalibrationRecord, study::RunOutcome, study::Verdict;
using study::CaseAnswer, study::CaseOutcome, study::CriticalGap, study::CriticalGapKind, study::FinishedRun,
    study::GapVerdict, study::not_a_number, study::of_each, study::Reference, study::RunSummary, study::Study,
    study::StudyCase, study::StudyFile, study::StudyOptions;
using surface::SkinModel;
using trace::BottomTrace;

// Every kind, and what its tables hold.
Kind critical_gap_kind(), calibration_kind(), sensitivity_kind(), accuracy_kind(), stability_kind(),
    comparison_kind();
std::vector<ReportTable> critical_gap_results(), calibration_results(), sensitivity_results(),
    accuracy_results(), stability_results(), comparison_results();

/// Adds what came to nothing, unless another shard runs it.
template <class Ended>
void add_failure(std::vector<Failure>& failures, const std::string& label, const Ended& ended) {
  if (!ended.failure.empty() && ended.outcome != RunOutcome::other_shard)
    failures.push_back({label, ended.failure, ended.outcome});
}

/// Of a kind that has an answer for every case.
template <class Result>
std::vector<Failure> failures_of(const Result& result) {
  std::vector<Failure> failures;
  for (std::size_t i = 0; i < result.answers.size(); ++i)
    add_failure(failures, result.study.cases.label(i), result.answers[i]);
  return failures;
}

/// Kind::run from the function that runs a study of the kind, and the one that says what failed of its
/// result. The report is that of the whole study: a shard and an interrupted study have none.
template <auto run, auto failures>
StudyOutcome outcome_of(const StudyFile& study, const StudyOptions& options) {
  const auto result = run(study, options);
  StudyOutcome outcome{result.interrupted, false, failures(result), result.timing, {}};
  if constexpr (requires { result.any_indeterminate(); }) outcome.indeterminate = result.any_indeterminate();
  if (!result.interrupted && options.shard.whole()) outcome.report = report_of(result);
  return outcome;
}

/// What the texts under a name say, "accuracy.answer" those of "accuracy.answer.bound" too: in their order,
/// each once for everything that it is said of; empty ones are left out.
std::vector<std::string> said(const std::string& name, const Row& facts = Row::object());

/// The same below each other, as part of a page: with a line break behind each.
std::string said_below(const std::string& name, const Row& facts = Row::object());

/// The panel of a fit, to be filled: src/kinds/templates/ask.html.
const std::string& ask_template();

/// Whether a gap of the study ignites in any case, so that T max jumps to that of a burning skin.
inline bool any_ignites(const std::vector<CaseAnswer>& answers, std::size_t gap) {
  return std::ranges::any_of(answers, [gap](const CaseAnswer& answer) {
    return answer.verdicts.size() > gap && answer.verdicts[gap].ignition.has_value();
  });
}

/// K, T max at a gap of the study; `inert`: of a skin that does not react. NaN of a case that failed.
inline double temperature_of(const CaseAnswer& answer, std::size_t gap, bool inert) {
  if (!answer.completed()) return not_a_number;
  return inert ? answer.verdicts[gap].heated : answer.verdicts[gap].maximum.temperature;
}

/// m, of a case that completed; NaN where it is no number.
inline double critical_gap_number(const CaseAnswer& answer) {
  return answer.completed() ? answer.critical.value : not_a_number;
}

inline bool is_bound(const CaseAnswer& answer) {
  return answer.critical.kind == CriticalGapKind::all_safe ||
         answer.critical.kind == CriticalGapKind::all_ignite;
}

/// Cases that came to nothing.
std::size_t count_failed(const std::vector<CaseAnswer>& answers);

/// "completed", how the run ended instead, or "failed" where it never was.
std::string status_of(const CaseAnswer& answer);

/// Why there is no critical gap, or why it is a bound; else empty.
inline std::string gap_remark(const CaseAnswer& answer) {
  return answer.completed() ? text_of(answer.critical.reason) : answer.failure;
}

/// Where a case lies, or its label if it has no coordinates.
std::string name_of(const std::vector<ShownKey>& keys, const StudyCase& input);

/// What failed and why, at most three by name: "496 MPa, 30 µm (energy drift); ...; and 4 more". By label
/// where no keys are given.
std::string failures_list(const std::vector<ShownKey>& keys, const StudyFile& study,
                          const std::vector<CaseAnswer>& answers);

/// What must be said where limiters acted; else empty.
std::string limited_text(const std::vector<CaseAnswer>& answers, const std::string& noun);

/// The lines of an answer below each other, and what every answer about verdicts must say; empty ones are
/// left out.
std::string answer_of(std::vector<std::string> lines, const StudyFile& study);

/// A part of something that is told with it, as a row of a table.
template <class Whole, class Part>
struct PartOf {
  const Whole* whole;
  Part part;
};

/// What there is to say of both.
template <class Whole, class Part>
Quantities<PartOf<Whole, const Part*>> with_whole(const Quantities<Whole>& of_whole,
                                                  const Quantities<Part>& of_part) {
  using Both = PartOf<Whole, const Part*>;
  return joined<Both>(
      {keys::of_part<Both>(of_whole, &Both::whole), keys::of_part<Both>(of_part, &Both::part)});
}

/// A row for every part of all, which `list` has.
template <class Part, class Whole, class List>
std::vector<PartOf<Whole, const Part*>> parts_of(const std::vector<Whole>& all, List list) {
  std::vector<PartOf<Whole, const Part*>> rows;
  for (const Whole& whole : all)
    for (const Part& each : std::invoke(list, whole)) rows.push_back({&whole, &each});
  return rows;
}

/// A case with its answer, and where it lies.
struct AnsweredCase {
  const StudyFile* study;
  std::size_t index;
  const CaseAnswer* answer;
  const std::vector<double>& coordinates() const { return study->cases.coordinates(index); }
  const std::string& label() const { return study->cases.label(index); }
  StudyCase input() const { return study->cases[index]; }
};
std::vector<AnsweredCase> answered(const StudyFile& study, const std::vector<CaseAnswer>& answers);
Quantities<AnsweredCase> answered_axes(const Study& study);

}  // namespace launchsafe::kinds
