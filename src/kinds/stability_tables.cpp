// The tables and the JSON of a stability study.
#include "launchsafe/kinds/stability_report.hpp"
#include "launchsafe/report/columns.hpp"
#include "launchsafe/report/shown_key.hpp"
#include "launchsafe/report/study_text.hpp"
#include "stability_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

using Json = nlohmann::ordered_json;

/// Letters of a finding on a terminal.
constexpr std::size_t most_letters = 100;

/// Cut between letters, never inside of one that takes several bytes.
std::string shortened(const std::string& text) {
  if (text.size() <= most_letters) return text;
  std::size_t end = most_letters;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + " ...";
}

std::string expected_text(const HardRow& row) {
  if (row.expected.empty()) return "not WRONG";
  std::vector<std::string> names;
  for (const verify::Outcome each : row.expected) names.push_back(to_string(each));
  return fmt::format("{}", fmt::join(names, " or "));
}

Cell count_cell(const HardRow& row, std::uint64_t count) {
  return row.ran ? Cell(static_cast<std::int64_t>(count)) : Cell();
}

Json gap_json(const HardGap& gap) {
  return {{"gap_cm", number(in_centimetres(gap.gap))},
          {"T_max_K", number(gap.temperature)},
          {"heated_K", number(gap.heated)},
          {"heated_safe_computation_K", number(gap.heated_against)},
          {"deviation_K", number(gap.deviation())},
          {"uncertainty_K", number(gap.uncertainty)},
          {"verdict", study::to_string(gap.judgement.verdict)},
          {"reason", gap.judgement.reason}};
}

Json row_json(const HardRow& row) {
  Json json{{"group", row.group},
            {"case", row.name},
            {"must_hold", row.must_hold},
            {"outcome", outcome_text(row)},
            {"expected", expected_text(row)},
            {"as_expected", row.is_as_expected()},
            {"finding", finding_text(row)}};
  if (!row.ran) return json;
  json["status"] = run::to_string(row.run.status);
  json["end_time_ms"] = number(1e3 * row.end_time);
  json["steps"] = row.run.steps;
  json["particles"] = row.run.particles;
  json["energy_drift"] = number(row.run.energy_drift);
  json["limiters"] = run::to_string(row.run.limiters);
  json["violations"] = row.violations;
  json["doubts"] = row.doubts;
  json["gaps"] = Json::array();
  for (const HardGap& gap : row.gaps) json["gaps"].push_back(gap_json(gap));
  return json;
}

}  // namespace

std::string outcome_text(const HardRow& row) {
  return row.computed() ? to_string(row.finding.outcome) : "not computed";
}

std::string finding_text(const HardRow& row) { return row.computed() ? row.finding.text : row.failure; }

Table stability_table(const StabilityResult& result) {
  Table table;
  table.title = "Hard cases";
  table.columns = {named_text("group", "group"),         named_text("case", "case"),
                   named_text("must hold", "must_hold"), named_text("outcome", "outcome"),
                   named_text("expected", "expected"),   named_text("finding", "finding")};
  for (const HardRow& row : result.rows)
    table.rows.push_back(
        {row.group, row.name, row.must_hold, outcome_text(row), expected_text(row), finding_text(row)});
  return table;
}

Table stability_summary(const StabilityResult& result) {
  Table table;
  table.title = "Hard cases";
  table.columns = {named_text("group", "group"), named_text("case", "case"), named_text("outcome", "outcome"),
                   named_text("finding", "finding")};
  for (const HardRow& row : result.rows)
    table.rows.push_back({row.group, row.name, outcome_text(row), shortened(finding_text(row))});
  return table;
}

Table launch_table(const StabilityResult& result) {
  Table table;
  table.title = "Launches";
  table.columns = {named_text("group", "group"),
                   named_text("case", "case"),
                   named_text("outcome", "outcome"),
                   named_text("run", "status"),
                   number_column("until", "ms", 4, "end_time_ms"),
                   count_column("steps", "steps"),
                   count_column("particles", "particles"),
                   scientific_column("energy drift", "", 1, "energy_drift"),
                   significant_column("gap", "cm", 6, "gap_cm"),
                   number_column("T max", "K", 1, "T_max_K"),
                   number_column("against", "K", 1, "deviation_K"),
                   significant_column("uncertainty", "K", 2, "uncertainty_K"),
                   named_text("verdict", "verdict"),
                   named_text("limiters", "limiters")};
  for (const HardRow& row : result.rows) {
    for (const HardGap& gap : row.gaps)
      table.rows.push_back({row.group, row.name, outcome_text(row), run::to_string(row.run.status),
                            optional_number(1e3 * row.end_time), count_cell(row, row.run.steps),
                            count_cell(row, row.run.particles), optional_number(row.run.energy_drift),
                            in_centimetres(gap.gap), optional_number(gap.temperature),
                            optional_number(gap.deviation()), optional_number(gap.uncertainty),
                            study::to_string(gap.judgement.verdict), run::to_string(row.run.limiters)});
  }
  table.notes.emplace_back(
      "Against: T max without reaction and trigger minus the same of the safe computation of the launch, "
      "both up "
      "to ignition.");
  return table;
}

Json to_json(const StabilityResult& result) {
  using verify::Outcome;
  Json json{{"kind", "stability"},
            {"study", study_file_name(result.study)},
            {"title", result.study.study.title},
            {"answer", answer(result)},
            {"counts",
             {{"cases", result.rows.size()},
              {"held", result.count(Outcome::held)},
              {"degraded", result.count(Outcome::degraded)},
              {"caught", result.count(Outcome::caught)},
              {"WRONG", result.wrong()},
              {"not_as_expected", result.unexpected()},
              {"not_computed", result.failed()}}},
            {"cases", Json::array()}};
  for (const HardRow& row : result.rows) json["cases"].push_back(row_json(row));
  return json;
}

}  // namespace launchsafe::kinds
