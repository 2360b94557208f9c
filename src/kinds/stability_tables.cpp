// The tables of a stability study.
#include "launchsafe/kinds/stability_report.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/shown_key.hpp"
#include "stability_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

/// Letters of a finding on a terminal.
constexpr std::size_t most_letters = 100;

/// Cut between letters, never inside of one that takes several bytes.
std::string shortened(const std::string& text) {
  if (text.size() <= most_letters) return text;
  std::size_t end = most_letters;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;
  return text.substr(0, end) + " ...";
}

std::string expected_text(const StressCaseRow& row) {
  if (row.expected.empty()) return "not WRONG";
  std::vector<std::string> names;
  for (const verify::Outcome each : row.expected) names.push_back(to_string(each));
  return fmt::format("{}", fmt::join(names, " or "));
}

Cell count_cell(const StressCaseRow& row, std::uint64_t count) {
  return row.ran ? Cell(static_cast<std::int64_t>(count)) : Cell();
}

}  // namespace

std::string outcome_text(const StressCaseRow& row) {
  return row.computed() ? to_string(row.finding.outcome) : "not computed";
}

std::string finding_text(const StressCaseRow& row) { return row.computed() ? row.finding.text : row.failure; }

Table stability_table(const StabilityResult& result) {
  Table table;
  table.title = "Stress cases";
  table.columns = {named_text("group", "group"),
                   quantity::case_name(),
                   named_text("must hold", "must_hold"),
                   named_text("outcome", "outcome"),
                   named_text("expected", "expected"),
                   named_text("finding", "finding"),
                   for_programs(named_text("as expected", "as_expected")),
                   for_programs(named_text("violations", "violations")),
                   for_programs(named_text("validity warnings", "validity_warnings"))};
  for (const StressCaseRow& row : result.rows)
    table.rows.push_back({row.group, row.name, row.must_hold, outcome_text(row), expected_text(row),
                          finding_text(row), std::string(row.is_as_expected() ? "yes" : "no"),
                          fmt::format("{}", fmt::join(row.violations, "; ")),
                          fmt::format("{}", fmt::join(row.validity_warnings, "; "))});
  return table;
}

Table stability_summary(const StabilityResult& result) {
  Table table;
  table.title = "Stress cases";
  table.columns = {named_text("group", "group"), quantity::case_name(), named_text("outcome", "outcome"),
                   named_text("finding", "finding")};
  for (const StressCaseRow& row : result.rows)
    table.rows.push_back({row.group, row.name, outcome_text(row), shortened(finding_text(row))});
  return table;
}

Table launch_table(const StabilityResult& result) {
  Table table;
  table.title = "Launches";
  table.columns = {named_text("group", "group"),
                   quantity::case_name(),
                   named_text("outcome", "outcome"),
                   quantity::status(),
                   number_column("until", "ms", 4, "end_time_ms"),
                   quantity::steps(),
                   quantity::particles(),
                   quantity::energy_drift(),
                   quantity::gap(),
                   quantity::temperature_max(),
                   for_programs(quantity::temperature_max_inert()),
                   for_programs(number_column("safe computation", "K", 1, "safe_computation_K")),
                   number_column("against", "K", 1, "deviation_K"),
                   quantity::uncertainty(),
                   quantity::verdict(),
                   for_programs(quantity::reason()),
                   quantity::limiters()};
  for (const StressCaseRow& row : result.rows) {
    for (const StressCaseGap& gap : row.gaps)
      table.rows.push_back(
          {row.group, row.name, outcome_text(row), run::to_string(row.run.status),
           optional_number(1e3 * row.end_time), count_cell(row, row.run.steps),
           count_cell(row, row.run.particles), optional_number(row.run.energy_drift), in_centimetres(gap.gap),
           optional_number(gap.temperature), optional_number(gap.heated), optional_number(gap.heated_against),
           optional_number(gap.deviation()), optional_number(gap.uncertainty),
           study::to_string(gap.judgement.verdict), gap.judgement.reason, run::to_string(row.run.limiters)});
  }
  table.notes.emplace_back(
      "Against: T max without reaction and trigger minus the same of the safe computation of the launch, "
      "both up "
      "to ignition.");
  return table;
}

}  // namespace launchsafe::kinds
