// The page, the picture and the files of a critical-gap study.
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/report/case_tables.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "launchsafe/scene/launch_end.hpp"

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
  switch (gap.kind) {
    case CriticalGapKind::value: {
      const bool confirmed = !outcome.confirmations.empty();
      return fmt::format(
          "the critical gap is {}{}: {} does not ignite, {} does{}.", centimetres(gap.value),
          std::isfinite(gap.bounds.at_least)
              ? fmt::format(", and at least {}", centimetres(gap.bounds.at_least))
              : std::string{},
          centimetres(gap.lower), centimetres(gap.upper),
          confirmed ? "; coupled runs on both sides agree" : "; not confirmed by coupled runs");
    }
    case CriticalGapKind::all_safe:
      return fmt::format("the critical gap is more than {}: {}.", centimetres(gap.lower),
                         study::to_string(gap.reason));
    case CriticalGapKind::all_ignite:
      return fmt::format("no gap is safe: {}.", study::to_string(gap.reason));
    case CriticalGapKind::several_crossings:
      return fmt::format("there is no one critical gap: ignition begins at {}, but is {}.",
                         centimetres(gap.lower), study::to_string(gap.reason));
    case CriticalGapKind::indeterminate:
      break;
  }
  return fmt::format("the critical gap is {}: {}.", reads_as(gap), study::to_string(gap.reason));
}

bool is_within_bounds(const CaseOutcome& outcome, const study::GapVerdict& row) {
  return row.judgement.verdict == study::Verdict::indeterminate && !row.ignition && outcome.completed() &&
         row.evidence.of_case->validity_warnings.empty() && !row.evidence.of_case->input.has_unaccepted();
}

/// The cause that lowers the bound most; nothing without any.
std::string largest_cause(const study::CriticalGap& gap) {
  const auto moves = [&](const GapShare& share) { return move_towards_ignition(gap.lower, share); };
  const auto largest =
      std::max_element(gap.shares.begin(), gap.shares.end(),
                       [&](const GapShare& a, const GapShare& b) { return moves(a) < moves(b); });
  if (largest == gap.shares.end()) return {};
  return fmt::format(" The largest part, {}, is that of {}; {} would make it smaller.",
                     centimetres(moves(*largest)), traits_of(largest->kind).title,
                     traits_of(largest->kind).remedy);
}

/// Which gaps of every case lie between the lower bound of the critical gap and ignition; empty where none
/// does.
std::string undecided_text(const CriticalGapResult& result) {
  std::string text;
  for (const CaseOutcome& outcome : result.cases) {
    std::string gaps;
    for (const study::GapVerdict& row : outcome.verdicts)
      if (is_within_bounds(outcome, row)) gaps += (gaps.empty() ? "" : ", ") + centimetres(row.gap);
    if (gaps.empty()) continue;
    text += fmt::format("- {}{}: the critical gap may be as small as {}.{}\n",
                        result.cases.size() > 1 ? outcome.input.label + ", " : std::string{}, gaps,
                        centimetres(outcome.critical.bounds.at_least), largest_cause(outcome.critical));
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
  return json_of_row(critical_gap_table(result), 0);
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
  report.launch = scene::launch_sentence(result.study.scene.scene);
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
                            ReportTable{as_calibrated_table(result), "", "as_calibrated", Shown::page},
                            ReportTable{without_exit_table(result), "", "without_exit"},
                            ReportTable{air_model_table(result), "", "air_models"},
                            ReportTable{air_energy_table(result), "", "air_energy"},
                            ReportTable{gap_share_table(result), "", "gap_shares", Shown::page}})
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
  report.json =
      study_json(result.study, report,
                 {{"critical_gap", only_critical_gap(result)},
                  {"early_time_ms", shown_value(result.study.study.early_time, quantity::time(2).form)},
                  {"timing", timing_json(result.timing)}});
  return report;
}

}  // namespace launchsafe::kinds
