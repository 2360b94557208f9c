// The answer, the page, the picture of T max and the files of a critical-gap study.
#include "critical_gap_tables.hpp"
#include "launchsafe/report/safety_report.hpp"

namespace launchsafe::kinds {

namespace {

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

/// "12 cases over peak pressure (400, 550 MPa), each judged at 3 gaps from 0 to 0.04 cm."
std::string extent_text(const CriticalGapResult& result) {
  const Study& study = result.study.study;
  const auto keys = report::shown_axes(study);
  std::vector<std::string> axes;
  for (std::size_t i = 0; i < keys.size(); ++i)
    axes.push_back(fmt::format("{} ({})", keys[i].heading, values_text(keys[i], study.axes[i].values)));
  std::string text = report::counted(std::ssize(result.rows), "case");
  if (!axes.empty()) text += fmt::format(" over {}", fmt::join(axes, " and "));
  if (study.gaps.empty()) return text + ".";
  const auto [least, most] = std::ranges::minmax(study.gaps);
  return fmt::format("{}, each judged at {} from {:.6g} to {}.", text,
                     report::counted(std::ssize(study.gaps), "gap"), shown_gap(least), centimetres(most));
}

/// How many critical gaps are of which kind.
std::string kinds_text(const CriticalGapResult& result) {
  using enum CriticalGapKind;
  std::vector<std::string> kinds;
  for (const auto& [kind, words] : {std::pair{value, "a value in"},
                                    {all_safe, "beyond the end of the search (a bound) in"},
                                    {all_ignite, "0 (ignition without a gap) in"},
                                    {several_crossings, "one of several crossings in"},
                                    {unknown, "not known in"}})
    if (const auto count =
            std::ranges::count(result.rows, kind, [](const CaseRow& row) { return row.critical.kind; });
        count > 0)
      kinds.push_back(fmt::format("{} {}", words, report::counted(count, "case")));
  return fmt::format("The critical gap is {}.", fmt::join(kinds, ", "));
}

/// The case with the smallest critical gap that is a value, and those that ignite at every gap.
std::string smallest_text(const CriticalGapResult& result) {
  const auto keys = report::shown_axes(result.study.study);
  const CaseRow *smallest = nullptr, *without_safe = nullptr;
  std::int64_t count = 0;
  const auto place = [&](const CaseRow* row) {
    return name_of(keys, result.study.cases[static_cast<std::size_t>(row - result.rows.data())]);
  };
  for (const CaseRow& row : result.rows) {
    if (row.critical.kind == CriticalGapKind::value &&
        (smallest == nullptr || row.critical.value < smallest->critical.value))
      smallest = &row;
    if (row.critical.kind == CriticalGapKind::all_ignite && count++ == 0) without_safe = &row;
  }
  std::string text;
  if (smallest != nullptr)
    text = fmt::format("The smallest value is {}, at {}.", report::measured_text(*smallest), place(smallest));
  if (without_safe != nullptr)
    text += fmt::format("{}No gap is safe at {}", text.empty() ? "" : " ", place(without_safe));
  if (count > 1) text += " and " + report::counted(count - 1, "other case");
  if (count > 0) text += ".";
  return text;
}

std::string answer_over_axes(const CriticalGapResult& result) {
  const Row counts = counts_json(result), &verdicts = counts["verdicts"];
  const std::size_t failed = count_failed(result.rows);
  return joined_lines({extent_text(result), kinds_text(result), smallest_text(result),
                       fmt::format("Verdicts: {} SAFE, {} UNSAFE, {} INDETERMINATE.", verdicts["SAFE"].dump(),
                                   verdicts["UNSAFE"].dump(), verdicts["INDETERMINATE"].dump()),
                       failed == 0 ? ""
                                   : fmt::format("Failed, and so indeterminate: {}: {}.",
                                                 report::counted(static_cast<std::int64_t>(failed), "case"),
                                                 failures_list(report::shown_axes(result.study.study),
                                                               result.study, result.rows)),
                       limited_text(result.rows, "case")});
}

/// "the critical gap is 0.0391 cm"
std::string gap_words(const CaseInDetail& of_case) {
  using enum CriticalGapKind;
  const CriticalGap& gap = of_case.critical;
  const std::string number = in_words(gap.value, significant(3, centimetre));
  switch (gap.kind) {
    case value:
      return "the critical gap is " + number;
    case all_safe:
      return fmt::format("nothing ignites up to {}, where the search ended", number);
    case all_ignite:
      return "the launch ignites without a gap";
    case several_crossings:
      return "ignition comes and goes with the gap, first at " + number;
    case unknown:
      return "the critical gap is not known" + (of_case.failure.empty() ? "" : ": " + of_case.failure);
  }
  return {};
}

/// " (0.0176 to 0.0537)"; empty where there is no bound.
std::string bounds_text(const study::GapBounds& bounds) {
  const auto digits = [](double gap, const Column& bound) { return digits_of(gap, bound.form); };
  if (!std::isfinite(bounds.at_least)) return {};
  const std::string least = digits(bounds.at_least, quantity::lower_bound);
  return std::isfinite(bounds.at_most)
             ? fmt::format(" ({} to {})", least, digits(bounds.at_most, quantity::upper_bound))
             : fmt::format(" (at least {} cm)", least);
}

/// The case that permits least decides for all.
std::string decision(const std::vector<CaseInDetail>& cases) {
  const auto permitted = [](const CaseInDetail& each) {
    const double gap = study::largest_safe_gap(each.gaps);
    return std::isnan(gap) ? -1.0 : gap;
  };
  const CaseInDetail& worst = *std::ranges::min_element(
      cases, {}, [&](const CaseInDetail& each) { return std::pair(permitted(each), each.bounds.at_least); });
  const auto cause = study::costliest(worst);
  return fmt::format("Over all cases {}, as {} permits {}{}.",
                     permitted(worst) < 0.0 ? "no computed gap is SAFE"
                                            : centimetres(permitted(worst)) + " is the largest SAFE gap",
                     worst.input.label, permitted(worst) < 0.0 ? "none" : "no more",
                     cause ? fmt::format("; {} costs it most", study::traits_of(*cause).title) : "");
}

std::string answer_in_detail(const CriticalGapResult& result) {
  std::vector<std::string> lines;
  for (const CaseInDetail& each : result.details) {
    std::string& line = lines.emplace_back(gap_words(each) + bounds_text(each.bounds));
    if (!each.incomplete.empty()) line += "; its bounds are not known: " + each.incomplete;
    const double largest = study::largest_safe_gap(each.gaps);
    line += std::isfinite(largest)
                ? fmt::format("; of the computed gaps {} is the largest that is SAFE", centimetres(largest))
                : "; none of the computed gaps is SAFE";
    for (const auto& [words, remarks] :
         {std::pair{"warnings", &each.warnings}, {"extrapolated", &each.extrapolated}})
      if (!remarks->empty()) line += fmt::format("; {}: {}", words, study::names_text(*remarks));
    if (result.details.size() > 1)
      line = each.input.label + ": " + line;
    else
      line.front() = static_cast<char>(std::toupper(line.front()));
    line += ".";
  }
  if (result.details.size() > 1) lines.push_back(decision(result.details));
  return fmt::format("{}", fmt::join(lines, "\n"));
}

Row json_of_study(const CriticalGapResult& result, const Table& gaps) {
  const Study& study = result.study.study;
  Row members{
      {"axes", report::axes_json(study)},
      // Of the only case; where there are several, each has its own.
      {"critical_gap", result.rows.size() == 1 ? json_rows(gaps).front() : nullptr},
      {"counts", counts_json(result)},
      {"notes", report::verdict_notes(result.study, result.rows)},
      {"spreads",
       {{"peak_pressure", study.spreads.peak_pressure},
        {"pulse_length", study.spreads.pulse_length},
        {"initial_temperature_K", study.spreads.initial_temperature}}},
      {"numerics", nullptr},
      {"models", of_each(study.models, [](const auto& model) { return study::name_of_model(*model); })}};
  if (study.numerics.is_stated())
    members["numerics"] = {{"K", study.numerics.error}, {"because", study.numerics.because}};
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
  return result.details.empty() ? answer_over_axes(result) : answer_in_detail(result);
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
  report.add({gaps, "critical_gaps.csv", "cases"});
  report.add({coupled_run_table(result), "", "coupled_runs"});
  if (auto picture = gap_picture(result)) report.draw(std::move(*picture));
  if (in_detail) add_details(result, report);
  report.say("## What it rests on\n\n" + report::friction_remark(result.study));
  if (!in_detail)
    report.say("No coupled run confirms these verdicts, which rest on the traces of the mechanical runs.\n");
  if (!in_detail) report.say(report::station_note(result.study) + "\n");
  report.say(limiter_remark(result));
  report.say("## Setup\n\n" + report::setup_text(result.study));
  if (in_detail) add_runs(result, report);
  report.json = study_json(result.study, report, json_of_study(result, gaps));
  return report;
}

}  // namespace launchsafe::kinds
