// The page, the picture and the files of a critical-gap study.
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/report/case_tables.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

std::string answer_of(const CaseOutcome& outcome) {
  const study::CriticalGap& gap = outcome.critical;
  const std::string remark = gap.reason.empty() ? "" : " (" + gap.reason + ")";
  switch (gap.kind) {
    case CriticalGapKind::value: {
      const bool confirmed = !outcome.confirmations.empty();
      return fmt::format("the critical gap is {}{}: {} does not ignite, {} does{}{}.", centimetres(gap.value),
                         std::isfinite(gap.uncertainty)
                             ? fmt::format(", uncertain by {} cm", significant(100.0 * gap.uncertainty, 2))
                             : std::string{},
                         centimetres(gap.lower), centimetres(gap.upper),
                         confirmed ? "; coupled runs on both sides agree" : "; not confirmed by coupled runs",
                         remark);
    }
    case CriticalGapKind::all_safe:
      return fmt::format("the critical gap is more than {}: {}.", centimetres(gap.lower), gap.reason);
    case CriticalGapKind::all_ignite:
      return fmt::format("no gap is safe: {}.", gap.reason);
    case CriticalGapKind::indeterminate:
      break;
  }
  return fmt::format("the critical gap is indeterminate: {}.", gap.reason);
}

/// What would make one share of a row's uncertainty smaller.
struct Remedy {
  const char* share;
  double size;  ///< K
  const char* how;
};

/// K that a share may be for the margin to exceed the uncertainty, the others as they are; NaN where none
/// may.
double allowed_share(const study::GapVerdict& row, double share) {
  const study::Uncertainty& u = row.uncertainty;
  const double left = row.margin - u.model_form;
  const double others = std::pow(u.total() - u.model_form, 2) - share * share;
  return left > 0.0 ? std::sqrt(left * left - others) : study::not_a_number;
}

bool is_within_uncertainty(const CaseOutcome& outcome, const study::GapVerdict& row) {
  return row.judgement.verdict == study::Verdict::indeterminate && !row.ignition && outcome.completed() &&
         row.evidence.validity_warnings.empty() && row.margin > 0.0;
}

std::string undecided_row(const study::GapVerdict& row) {
  const study::Uncertainty& u = row.uncertainty;
  const Remedy largest = std::max(
      {Remedy{"the computation", u.computed(), "a finer setting, or a record of its accuracy"},
       Remedy{"the fit", u.fit, "more measured temperatures to calibrate on"},
       Remedy{"the inputs", u.inputs(), "a measured spread of peak pressure and initial temperature"},
       Remedy{"the model form", u.model_form, "measurements of how the shell holds the charge"}},
      [](const Remedy& a, const Remedy& b) { return a.size < b.size; });
  const double allowed = allowed_share(row, largest.size);
  return fmt::format(
      "{}: a margin of {} K against shares of {} K (computation), {} K (fit), {} K (inputs) and {} K (model "
      "form). The largest is that of {}; {} would reduce it, {}.\n",
      centimetres(row.gap), significant(row.margin, 3), significant(u.computed(), 2), significant(u.fit, 2),
      significant(u.inputs(), 2), significant(u.model_form, 2), largest.share, largest.how,
      std::isfinite(allowed) ? fmt::format("and below {} K the row is decided", significant(allowed, 3))
                             : std::string("and the others have to shrink too"));
}

/// Which share keeps each row that did not ignite from a verdict, and what would reduce it; empty where none
/// does.
std::string undecided_text(const CriticalGapResult& result) {
  std::string text;
  for (const CaseOutcome& outcome : result.cases) {
    for (const study::GapVerdict& row : outcome.verdicts) {
      if (!is_within_uncertainty(outcome, row)) continue;
      text +=
          "- " + (result.cases.size() > 1 ? outcome.input.label + ", " : std::string{}) + undecided_row(row);
    }
  }
  return text.empty() ? text : "## What keeps rows undecided\n\n" + text;
}

/// What every page must say when bounds within the models were reached.
std::string limiter_remark(const CriticalGapResult& result) {
  std::string text;
  for (const CaseOutcome& outcome : result.cases) {
    const run::LimiterCounts& limiters = outcome.result.mechanics.limiters;
    if (!acted(limiters)) continue;
    text += fmt::format("Limiters acted in {} ({} particle steps); its verdicts rest on them too.\n",
                        outcome.input.label, limiters_text(limiters));
  }
  return text;
}

/// The row of the only case; null where there are several, each with its own critical gap.
nlohmann::ordered_json only_critical_gap(const CriticalGapResult& result) {
  if (result.cases.size() != 1) return nullptr;
  return to_json(critical_gap_table(result))["rows"].front();
}

}  // namespace

std::string answer(const CriticalGapResult& result) {
  if (result.cases.size() == 1) {
    std::string text = answer_of(result.cases.front());
    text.front() = 'T';
    if (!text.starts_with("The")) text.front() = 'N';
    return text;
  }
  std::string text;
  for (const CaseOutcome& outcome : result.cases)
    text += (text.empty() ? "" : "\n") + outcome.input.label + ": " + answer_of(outcome);
  return text;
}

Report report_of(const CriticalGapResult& result) {
  Report report{result.study.study.title, answer(result), remaking_command(result.study)};
  const Table verdicts = verdict_table(result);
  report.files.push_back({"verdicts.md", to_markdown(verdicts)});
  report.items = {ReportTable{verdicts, "verdicts.csv", "verdicts"},
                  Picture{"temperature.svg", temperature_plot(result), "T max against gap"}};
  if (result.cases.size() > 1)
    report.items.push_back(
        Picture{"critical_gaps.svg", critical_gaps_plot(result), "critical gap of every case"});
  report.items.push_back(ReportTable{comparison_table(result), "", "comparison"});
  for (ReportTable table : {ReportTable{critical_gap_table(result), "", "cases"},
                            ReportTable{coupled_run_table(result), "", "coupled_runs"},
                            ReportTable{cited_limit_table(result), "", "cited_limits"},
                            ReportTable{without_exit_table(result), "", "without_exit"},
                            ReportTable{air_model_table(result), "", "air_models"},
                            ReportTable{air_energy_table(result), "", "air_energy"}})
    report.items.push_back(std::move(table));
  for (const CaseOutcome& outcome : result.cases)
    report.items.push_back(ReportTable{fit_table(outcome), "", "fit"});
  report.items.push_back(Statement{undecided_text(result)});
  report.items.push_back(Statement{"## What it rests on\n\n" + friction_remark(result.study)});
  report.items.push_back(Statement{uncertainty_remark(result.study) + "\n"});
  report.items.push_back(Statement{limiter_remark(result)});
  report.items.push_back(Statement{"## Setup\n\n" + setup_text(result.study)});
  for (const CaseOutcome& outcome : result.cases) {
    Table faces = interface_table(outcome.result.mechanics);
    if (result.cases.size() > 1) faces.title += ", " + outcome.input.label;
    report.items.push_back(ReportTable{.table = std::move(faces), .shown = Shown::page});
  }
  report.items.push_back(ReportTable{run_table(result), "", "runs"});
  report.items.push_back(Statement{timing_sentence(result.timing)});
  report.json = study_json(result.study, report,
                           {{"critical_gap", only_critical_gap(result)},
                            {"early_time_ms", 1e3 * result.study.study.early_time},
                            {"timing", timing_json(result.timing)}});
  return report;
}

}  // namespace launchsafe::kinds
