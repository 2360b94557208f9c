// The answer, the page and the files of a critical-gap study.
#include "critical_gap_tables.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "launchsafe/scene/launch_end.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

/// Rows of a table on the page; the files have all.
constexpr std::size_t most_rows = 200;

/// "6 gaps from 0 to 0.04 cm".
std::string gaps_text(const std::vector<double>& gaps) {
  if (gaps.empty()) return "no gap";
  const auto [least, most] = std::minmax_element(gaps.begin(), gaps.end());
  if (gaps.size() == 1) return "the gap " + centimetres(*least);
  return fmt::format("{} gaps from {} to {}", gaps.size(), digits_of(*least, quantity::gap().form),
                     centimetres(*most));
}

/// What was swept.
std::string extent_text(const CriticalGapResult& result, const std::vector<ShownKey>& keys) {
  const study::Study& study = result.study.study;
  std::string axes;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    axes += fmt::format("{}{} ({})",
                        axes.empty()          ? " over "
                        : i + 1 < keys.size() ? ", "
                                              : " and ",
                        keys[i].heading, values_text(keys[i], study.axes[i].values));
  }
  return fmt::format("{}{}, each judged at {}.", counted(result.answers.size(), "case"), axes,
                     gaps_text(study.gaps));
}

/// The largest gap that the searches which met no ignition came to, m.
double end_of_search(const CriticalGapResult& result) {
  double end = study::not_a_number;
  for (const study::CaseAnswer& answer : result.answers) {
    if (answer.critical.kind == study::CriticalGapKind::all_safe && !(answer.critical.lower >= end))
      end = answer.critical.lower;
  }
  return end;
}

std::string kinds_text(const CriticalGapResult& result, const SweepCounts& counts) {
  const auto add = [&](CriticalGapKind kind, const std::string& words) {
    const std::size_t count = counts.critical_gaps.at(kind);
    return count > 0 ? fmt::format(", {} in {}", words, counted(count, "case")) : std::string{};
  };
  std::string text = fmt::format("The critical gap is a value in {}",
                                 counted(counts.critical_gaps.at(CriticalGapKind::value), "case"));
  text += add(CriticalGapKind::all_safe, fmt::format("more than {} (the end of the search: a bound)",
                                                     centimetres(end_of_search(result))));
  text += add(CriticalGapKind::all_ignite, "below every gap (ignition even at the smallest: a bound)");
  text += add(CriticalGapKind::several_crossings, "one of several crossings");
  text += add(CriticalGapKind::indeterminate, "indeterminate");
  return text + ".";
}

/// The case with the smallest critical gap that is a value.
std::optional<std::size_t> smallest(const CriticalGapResult& result) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const double value = value_of(result.answers[i].critical);
    if (!std::isfinite(value)) continue;
    if (!best || value < result.answers[*best].critical.value) best = i;
  }
  return best;
}

/// The cases that ignite at every gap: their critical gap is below every value.
std::vector<std::size_t> without_safe_gap(const CriticalGapResult& result) {
  std::vector<std::size_t> cases;
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    if (result.answers[i].critical.kind == study::CriticalGapKind::all_ignite) cases.push_back(i);
  }
  return cases;
}

std::string smallest_text(const CriticalGapResult& result, const std::vector<ShownKey>& keys) {
  std::string text;
  if (const auto best = smallest(result)) {
    text = fmt::format("The smallest value is {}, at {}.", measured_text(result.answers[*best].critical),
                       name_of(keys, result.study.cases[*best]));
  }
  const std::vector<std::size_t> none = without_safe_gap(result);
  if (none.empty()) return text;
  const std::string others =
      none.size() > 1 ? " and " + counted(none.size() - 1, "other case") : std::string{};
  return text + fmt::format("{}No gap is safe at {}{}.", text.empty() ? "" : " ",
                            name_of(keys, result.study.cases[none.front()]), others);
}

std::string failures_text(const CriticalGapResult& result, const std::vector<ShownKey>& keys,
                          std::size_t failed) {
  if (failed == 0) return {};
  return fmt::format("{} failed and {} indeterminate: {}.", counted(failed, "case"),
                     failed == 1 ? "is" : "are", failures_list(keys, result.study, result.answers));
}

std::string uncertainty_text(const CriticalGapResult& result) {
  std::string text = uncertainty_remark(result.study);
  if (result.details.empty())
    text +=
        " Verdicts and critical gaps rest on the traces of the mechanical runs; no coupled runs confirm them "
        "(those of a study with confirm = true do).";
  return text + "\n";
}

/// The verdicts as a matrix, or where they are.
std::variant<Statement, ReportTable, Picture> matrix_item(const CriticalGapResult& result) {
  const std::size_t gaps = result.study.study.gaps.size();
  if (gaps <= most_gaps)
    return ReportTable{.table = verdict_matrix(result), .most_rows = most_rows, .rest = "verdicts.csv"};
  return Statement{fmt::format(
      "The verdicts at {} gaps are too many for a table on this page: see `verdicts.csv`.\n", gaps)};
}

nlohmann::ordered_json counts_json(const SweepCounts& counts) {
  nlohmann::ordered_json gaps, verdicts;
  for (const auto& [kind, count] : counts.critical_gaps) gaps[study::to_string(kind)] = count;
  for (const auto& [verdict, count] : counts.verdicts) verdicts[study::to_string(verdict)] = count;
  return {{"cases", counts.cases},
          {"failed", counts.failed},
          {"limiters_acted", counts.limited},
          {"critical_gaps", std::move(gaps)},
          {"verdicts", std::move(verdicts)}};
}

std::string sentence_of(const CaseOutcome& outcome) {
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

/// Of few cases, one after the other.
std::string answer_in_detail(const CriticalGapResult& result) {
  if (result.details.size() == 1) {
    std::string text = sentence_of(result.details.front());
    text.front() = 'T';
    if (!text.starts_with("The")) text.front() = 'N';
    return text;
  }
  std::string text;
  for (const CaseOutcome& outcome : result.details)
    text += (text.empty() ? "" : "\n") + outcome.input.label + ": " + sentence_of(outcome);
  return text;
}

/// The row of the only case; null where there are several, each with its own critical gap.
nlohmann::ordered_json only_critical_gap(const CriticalGapResult& result, const Table& gaps) {
  if (result.answers.size() != 1) return nullptr;
  return json_of_row(gaps, 0);
}

nlohmann::ordered_json json_of_study(const CriticalGapResult& result, const Table& gaps) {
  nlohmann::ordered_json members{
      {"axes", axes_json(result.study.study)},
      {"critical_gap", only_critical_gap(result, gaps)},
      {"early_time_ms", shown_value(result.study.study.early_time, quantity::time(2).form)},
      {"counts", counts_json(counts_of(result.answers))},
      {"notes", mesh_notes(result.study)}};
  if (!result.details.empty()) members["timing"] = timing_json(result.timing);
  return members;
}

/// The same table as a text of its own.
TextFile table_file(const char* name, Table table, const StudyFile& study) {
  if (!study.in_detail)
    for (std::string& note : mesh_notes(study)) table.notes.push_back(std::move(note));
  return {name, to_markdown(table)};
}

}  // namespace

std::string answer(const CriticalGapResult& result) {
  if (!result.details.empty()) return answer_in_detail(result);
  const auto keys = shown_axes(result.study.study);
  const SweepCounts counts = counts_of(result.answers);
  return answer_of(
      {extent_text(result, keys), kinds_text(result, counts), smallest_text(result, keys),
       fmt::format("Verdicts: {} SAFE, {} UNSAFE, {} INDETERMINATE.", counts.verdicts.at(Verdict::safe),
                   counts.verdicts.at(Verdict::unsafe), counts.verdicts.at(Verdict::indeterminate)),
       failures_text(result, keys, counts.failed), limited_text(counts, "case")},
      result.study);
}

Report report_of(const CriticalGapResult& result) {
  const bool in_detail = !result.details.empty();
  Report report{result.study.study.title, answer(result), remaking_command(result.study)};
  report.launch = scene::launch_sentence(result.study.scene.scene);
  const Table gaps = critical_gap_table(result);
  Table verdicts = verdict_table(result);
  report.files.push_back(in_detail ? table_file("verdicts.md", verdicts, result.study)
                                   : table_file("critical_gaps.md", gaps, result.study));
  report.items.push_back(ReportTable{std::move(verdicts), "verdicts.csv", "verdicts",
                                     in_detail ? Shown::page_and_terminal : Shown::file});
  if (in_detail)
    report.items.push_back(Picture{"temperature.svg", temperature_plot(result), "T max against gap"});
  report.items.push_back(ReportTable{comparison_table(result), "", "comparison"});
  report.items.push_back(
      ReportTable{gaps, "critical_gaps.csv", "cases", Shown::page_and_terminal, most_rows});
  report.items.push_back(ReportTable{coupled_run_table(result), "", "coupled_runs"});
  report.items.push_back(ReportTable{cited_limit_table(result), "", "cited_limits"});
  GapPictures drawn = gap_pictures(result);
  for (Picture& each : drawn.pictures) report.items.push_back(std::move(each));
  report.remarks = std::move(drawn.remarks);
  report.items.push_back(ReportTable{axis_effect_table(result), "", "axis_effects", Shown::page});
  if (in_detail)
    add_details(result, report);
  else
    report.items.push_back(matrix_item(result));
  report.items.push_back(Statement{"## What it rests on\n\n" + friction_remark(result.study)});
  report.items.push_back(Statement{uncertainty_text(result)});
  if (!in_detail) report.items.push_back(Statement{station_note(result.study) + "\n"});
  report.items.push_back(Statement{limiter_remark(result)});
  report.items.push_back(Statement{"## Setup\n\n" + setup_text(result.study)});
  if (in_detail) add_runs(result, report);
  report.json = study_json(result.study, report, json_of_study(result, gaps));
  return report;
}

}  // namespace launchsafe::kinds
