// The answer, the page, the picture of T max and the files of a critical-gap study.
#include "critical_gap_tables.hpp"
#include "launchsafe/report/safety_report.hpp"

namespace launchsafe::kinds {

namespace {

/// Of a table on the page; the files have all.
constexpr std::size_t most_rows = 200;

Row counts_json(const CriticalGapResult& result) {
  std::map<CriticalGapKind, std::size_t> kinds;
  std::map<Verdict, std::size_t> verdicts;
  std::size_t limited = 0;
  for (const CaseRow& row : result.rows) {
    limited += row.run.limiters.acted() ? 1 : 0;
    ++kinds[row.critical.kind];
    for (const GapRow& gap : row.gaps) ++verdicts[gap.judgement.verdict];
  }
  Row counts{
      {"cases", result.rows.size()}, {"failed", count_failed(result.rows)}, {"limiters_acted", limited}};
  for (const auto kind : {CriticalGapKind::value, CriticalGapKind::all_safe, CriticalGapKind::all_ignite,
                          CriticalGapKind::unknown, CriticalGapKind::several_crossings})
    counts["critical_gaps"][study::to_string(kind)] = kinds[kind];
  for (const auto verdict : {Verdict::safe, Verdict::unsafe, Verdict::indeterminate})
    counts["verdicts"][study::to_string(verdict)] = verdicts[verdict];
  return counts;
}

Row facts_of(const CriticalGapResult& result) {
  const Study& study = result.study.study;
  const auto keys = report::shown_axes(study);
  Row facts = counts_json(result);
  for (std::size_t i = 0; i < keys.size(); ++i)
    facts["axes"].push_back(
        fmt::format("{} ({})", keys[i].heading, values_text(keys[i], study.axes[i].values)));
  facts["gaps"] = study.gaps.size();
  if (!study.gaps.empty()) {
    const auto [least, most] = std::ranges::minmax(study.gaps);
    facts.update({{"least_cm", shown_gap(least)}, {"most_cm", shown_gap(most)}});
  }
  // The case with the smallest critical gap that is a value, and those that ignite at every gap: their
  // critical gap is below every value. `end`: the largest gap that the searches which met no ignition came
  // to.
  double best = not_a_number, end = not_a_number;
  std::size_t without_safe = 0;
  for (std::size_t i = 0; i < result.rows.size(); ++i) {
    const CriticalGap& gap = result.rows[i].critical;
    if (gap.kind == CriticalGapKind::value && !(gap.value >= best)) {
      best = gap.value;
      facts["smallest"] =
          report::measured_text(result.rows[i]) + ", at " + name_of(keys, result.study.cases[i]);
    }
    if (gap.kind == CriticalGapKind::all_safe && !(gap.value >= end)) end = gap.value;
    if (gap.kind == CriticalGapKind::all_ignite && without_safe++ == 0)
      facts["without_safe"] = name_of(keys, result.study.cases[i]);
  }
  facts["end_of_search_cm"] = report::number(shown_gap(end));
  facts["other_without_safe"] = without_safe > 0 ? without_safe - 1 : 0;
  facts["failures"] = failures_list(keys, result.study, result.rows);
  return facts;
}

std::string answer_in_detail(const CriticalGapResult& result) {
  std::vector<std::string> lines;
  for (const CaseInDetail& each : result.details) {
    Row row = json_of(report::case_quantities(), static_cast<const CaseRow&>(each));
    row.update({{"failure", each.failure},
                {"end_cm", report::number(shown_gap(each.critical.value))},
                {"largest_safe_cm", report::number(shown_gap(study::largest_safe_gap(each.gaps)))}});
    lines.push_back(fmt::format("{}.", fmt::join(said("critical_gap.sentence", {{"row", row}}), "; ")));
    if (result.details.size() > 1)
      lines.back() = each.input.label + ": " + lines.back();
    else
      lines.back().front() = static_cast<char>(std::toupper(lines.back().front()));
  }
  return fmt::format("{}", fmt::join(lines, "\n"));
}

Row json_of_study(const CriticalGapResult& result, const Table& gaps) {
  Row members{{"axes", report::axes_json(result.study.study)},
              // Of the only case; where there are several, each has its own.
              {"critical_gap", result.rows.size() == 1 ? json_rows(gaps).front() : nullptr},
              {"counts", counts_json(result)},
              {"notes", report::verdict_notes(result.study, result.rows)}};
  if (!result.details.empty()) members["timing"] = report::timing_json(result.timing);
  return members;
}

}  // namespace

Plot temperature_plot(const CriticalGapResult& result) {
  const Row verdicts = json_rows(verdict_table(result)), cases = json_rows(critical_gap_table(result));
  Plot plot;
  std::size_t ignite = 0;
  auto row = verdicts.begin();
  for (std::size_t i = 0; i < result.details.size(); ++i) {
    const std::vector<GapRow>& gaps = result.rows[i].gaps;
    const auto end = row + static_cast<std::ptrdiff_t>(gaps.size());
    // Temperatures of a part of the launch say nothing of it.
    Row tables{{"verdicts", result.details[i].completed() ? Row(Row::array_t(row, end)) : Row::array()},
               {"cases", Row::array({cases[i]})}};
    row = end;
    ignite += std::ranges::any_of(gaps, [](const GapRow& gap) { return gap.ignition.has_value(); });
    const StudyCase& input = result.details[i].input;
    if (input.own_conditions) tables["comparison"] = json_rows(comparison_table(result));
    Plot panel = report::verdict_plot(tables, input.scene.scene);
    panel.height = 500;  // there is more room than on page one of a safety report
    if (result.details.size() == 1) return panel;
    panel.title = input.label + ": " + panel.title;
    if (!panel.series.empty()) plot.panels.push_back(std::move(panel));
  }
  plot.title = fmt::format("{} of {} cases ignite at a computed gap", ignite, result.details.size());
  return plot;
}

std::string answer(const CriticalGapResult& result) {
  if (!result.details.empty()) return answer_in_detail(result);
  std::vector<std::string> lines = said("critical_gap.answer", facts_of(result));
  lines.push_back(limited_text(result.rows, "case"));
  return joined_lines(std::move(lines));
}

Report report_of(const CriticalGapResult& result) {
  const bool in_detail = !result.details.empty();
  Report report{result.study.study.title, answer(result), report::remaking_command(result.study)};
  report.launch = scene::launch_sentence(result.study.scene.scene);
  const Table gaps = critical_gap_table(result);
  report.add({verdict_table(result), "verdicts.csv", "verdicts",
              in_detail ? Shown::page_and_terminal : Shown::file});
  if (in_detail) report.draw({"temperature.svg", temperature_plot(result), "T max against gap"});
  report.add({comparison_table(result), "", "comparison"});
  report.add({gaps, "critical_gaps.csv", "cases", Shown::page_and_terminal, most_rows});
  report.add({coupled_run_table(result), "", "coupled_runs"});
  if (auto picture = gap_picture(result)) report.draw(std::move(*picture));
  if (in_detail) add_details(result, report);
  report.say("## What it rests on\n\n" + report::friction_remark(result.study));
  if (!in_detail) report.say(said_below("critical_gap.traces"));
  if (!in_detail) report.say(report::station_note(result.study) + "\n");
  report.say(limiter_remark(result));
  report.say("## Setup\n\n" + report::setup_text(result.study));
  if (in_detail) add_runs(result, report);
  report.json = study_json(result.study, report, json_of_study(result, gaps));
  return report;
}

}  // namespace launchsafe::kinds
