// The answer, the page and the files of a sweep.
#include "answer_tables.hpp"
#include "launchsafe/kinds/sweep.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "launchsafe/scene/launch_end.hpp"

#include <fmt/format.h>

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
std::string extent_text(const SweepResult& result, const std::vector<ShownKey>& keys) {
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
double end_of_search(const SweepResult& result) {
  double end = study::not_a_number;
  for (const study::CaseAnswer& answer : result.answers) {
    if (answer.critical.kind == study::CriticalGapKind::all_safe && !(answer.critical.lower >= end))
      end = answer.critical.lower;
  }
  return end;
}

std::string kinds_text(const SweepResult& result, const SweepCounts& counts) {
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
std::optional<std::size_t> smallest(const SweepResult& result) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const double value = value_of(result.answers[i].critical);
    if (!std::isfinite(value)) continue;
    if (!best || value < result.answers[*best].critical.value) best = i;
  }
  return best;
}

/// The cases that ignite at every gap: their critical gap is below every value.
std::vector<std::size_t> without_safe_gap(const SweepResult& result) {
  std::vector<std::size_t> cases;
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    if (result.answers[i].critical.kind == study::CriticalGapKind::all_ignite) cases.push_back(i);
  }
  return cases;
}

std::string smallest_text(const SweepResult& result, const std::vector<ShownKey>& keys) {
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

std::string failures_text(const SweepResult& result, const std::vector<ShownKey>& keys, std::size_t failed) {
  if (failed == 0) return {};
  return fmt::format("{} failed and {} indeterminate: {}.", counted(failed, "case"),
                     failed == 1 ? "is" : "are", failures_list(keys, result.study, result.answers));
}

std::string uncertainty_text(const study::StudyFile& study) {
  return uncertainty_remark(study) +
         " Verdicts and critical gaps rest on the traces of the mechanical runs; no coupled runs confirm "
         "them (those of a study of kind critical-gap do).\n";
}

/// The verdicts as a matrix, or where they are.
std::variant<Statement, ReportTable, Picture> matrix_item(const SweepResult& result) {
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

}  // namespace

std::string answer(const SweepResult& result) {
  const auto keys = shown_axes(result.study.study);
  const SweepCounts counts = counts_of(result.answers);
  return answer_of(
      {extent_text(result, keys), kinds_text(result, counts), smallest_text(result, keys),
       fmt::format("Verdicts: {} SAFE, {} UNSAFE, {} INDETERMINATE.", counts.verdicts.at(Verdict::safe),
                   counts.verdicts.at(Verdict::unsafe), counts.verdicts.at(Verdict::indeterminate)),
       failures_text(result, keys, counts.failed), limited_text(counts, "case")},
      result.study, result.interrupted ? interrupted_note : "");
}

Report report_of(const SweepResult& result) {
  Report report{result.study.study.title, answer(result), remaking_command(result.study)};
  report.launch = scene::launch_sentence(result.study.scene.scene);
  const Table gaps = critical_gap_table(result);
  Table noted = gaps;
  for (std::string& note : mesh_notes(result.study)) noted.notes.push_back(std::move(note));
  report.files.push_back({"critical_gaps.md", to_markdown(noted)});
  report.items = {ReportTable{gaps, "critical_gaps.csv", "cases", Shown::page_and_terminal, most_rows},
                  ReportTable{verdict_table(result), "verdicts.csv", "verdicts", Shown::file},
                  ReportTable{cited_limit_table(result), "", "cited_limits"}};
  SweepPictures drawn = pictures(result);
  for (Picture& each : drawn.pictures) report.items.push_back(std::move(each));
  report.remarks = std::move(drawn.remarks);
  report.items.push_back(ReportTable{axis_effect_table(result), "", "axis_effects", Shown::page});
  report.items.push_back(matrix_item(result));
  report.items.push_back(Statement{"## What it rests on\n\n" + friction_remark(result.study)});
  report.items.push_back(Statement{uncertainty_text(result.study)});
  report.items.push_back(Statement{station_note(result.study) + "\n"});
  report.items.push_back(Statement{"## Setup\n\n" + setup_text(result.study)});
  report.json =
      study_json(result.study, report,
                 {{"axes", axes_json(result.study.study)},
                  {"early_time_ms", shown_value(result.study.study.early_time, quantity::time(2).form)},
                  {"counts", counts_json(counts_of(result.answers))},
                  {"notes", mesh_notes(result.study)}});
  return report;
}

}  // namespace launchsafe::kinds
