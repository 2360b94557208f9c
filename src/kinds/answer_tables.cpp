#include "answer_tables.hpp"

#include "launchsafe/report/columns.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace launchsafe::kinds {

using namespace study;
using namespace report;

SweepCounts counts_of(const std::vector<study::CaseAnswer>& answers) {
  SweepCounts counts;
  counts.cases = answers.size();
  for (const study::CaseAnswer& answer : answers) {
    if (!answer.completed()) ++counts.failed;
    if (acted(answer.run.limiters)) ++counts.limited;
    counts.limiters.crack_at_bound += answer.run.limiters.crack_at_bound;
    counts.limiters.tension_cutoff += answer.run.limiters.tension_cutoff;
    counts.limiters.hugoniot_guard += answer.run.limiters.hugoniot_guard;
    ++counts.critical_gaps.at(answer.critical.kind);
    for (const study::GapVerdict& row : answer.verdicts) ++counts.verdicts.at(row.judgement.verdict);
  }
  return counts;
}

std::string status_of(const study::CaseAnswer& answer) {
  if (answer.completed()) return "completed";
  return answer.run.status == run::RunStatus::completed ? "failed" : run::to_string(answer.run.status);
}

std::string name_of(const std::vector<ShownKey>& keys, const study::StudyCase& input) {
  std::string place = place_text(keys, input.coordinates);
  return place.empty() ? input.label : place;
}

std::string failures_list(const std::vector<ShownKey>& keys, const study::StudyFile& study,
                          const std::vector<study::CaseAnswer>& answers) {
  constexpr std::size_t named = 3;
  std::size_t failed = 0;
  std::string list;
  for (std::size_t i = 0; i < std::min(answers.size(), study.cases.size()); ++i) {
    if (answers[i].completed()) continue;
    if (++failed > named) continue;
    list +=
        fmt::format("{}{} ({})", list.empty() ? "" : "; ", name_of(keys, study.cases[i]), answers[i].failure);
  }
  if (failed > named) list += fmt::format("; and {} more", failed - named);
  return list;
}

std::string limited_text(const SweepCounts& counts, const std::string& noun) {
  if (counts.limited == 0) return {};
  return fmt::format("Limiters acted in {} ({} particle steps in all), whose results rest on them too.",
                     counted(counts.limited, noun), limiters_text(counts.limiters));
}

std::string answer_of(std::vector<std::string> lines, const StudyFile& study,
                      const std::string& interrupted) {
  for (std::string& note : mesh_notes(study)) lines.push_back(std::move(note));
  lines.push_back(interrupted);
  std::erase(lines, "");
  return fmt::format("{}", fmt::join(lines, "\n"));
}

std::vector<Cell> axis_cells(const std::vector<ShownKey>& keys, const StudyCase& input) {
  std::vector<Cell> cells(keys.size());
  for (std::size_t i = 0; i < std::min(keys.size(), input.coordinates.size()); ++i)
    cells[i] = keys[i].value(input.coordinates[i]);
  return cells;
}

Table PlacedAnswers::table(std::string title) const { return {std::move(title), columns}; }

Table verdict_table(const Study& study, const PlacedAnswers& answers) {
  Table table = answers.table("Verdicts");
  append(table.columns, {quantity::gap()});
  append(table.columns, verdict_columns(study));
  for (const auto& [place, answer] : answers.rows) {
    for (std::size_t i = 0; i < answer->verdicts.size(); ++i) {
      std::vector<Cell>& cells = table.rows.emplace_back();
      cells.reserve(table.columns.size());
      cells.insert(cells.end(), place.begin(), place.end());
      cells.emplace_back(in_centimetres(answer->verdicts[i].gap));
      const bool known = i < answer->heated_temperature.size();
      add_verdict_cells(answer->verdicts[i], known ? answer->heated_temperature[i] : not_a_number, cells);
    }
  }
  return table;
}

Table verdict_matrix(const Study& study, const PlacedAnswers& answers) {
  Table table = answers.table("Verdicts by gap");
  for (const double gap : study.gaps)
    table.columns.push_back(named_text(centimetres(gap), fmt::format("gap_{:.6g}_cm", in_centimetres(gap))));
  for (const auto& [place, answer] : answers.rows) {
    std::vector<Cell>& cells = table.rows.emplace_back(place);
    for (const GapVerdict& row : answer->verdicts) {
      const Verdict verdict = row.judgement.verdict;
      cells.emplace_back(verdict == Verdict::indeterminate ? "INDET." : study::to_string(verdict));
    }
  }
  return table;
}

}  // namespace launchsafe::kinds
