// The answer, the tables, the page and the files of a stability study.
#include "launchsafe/kinds/stability.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/shown_key.hpp"
#include "launchsafe/report/study_text.hpp"
#include "sweep_text.hpp"

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
  for (const Outcome each : row.expected) names.push_back(to_string(each));
  return fmt::format("{}", fmt::join(names, " or "));
}

Cell count_cell(const StressCaseRow& row, std::uint64_t count) {
  return row.ran ? Cell(static_cast<std::int64_t>(count)) : Cell();
}

/// "held", "degraded", "caught", "WRONG", or "not computed".
std::string outcome_text(const StressCaseRow& row) {
  return row.computed() ? to_string(row.finding.outcome) : "not computed";
}

/// The finding, or why there is none.
std::string finding_text(const StressCaseRow& row) { return row.computed() ? row.finding.text : row.failure; }

}  // namespace

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

namespace {

std::string counts_text(const StabilityResult& result) {
  return fmt::format("{}: {} held, {} degraded with a reason, {} caught, {} WRONG.",
                     counted(result.rows.size(), "stress case"), result.count(Outcome::held),
                     result.count(Outcome::degraded), result.count(Outcome::caught), result.wrong());
}

/// Rows of one sort by name and finding, a line each.
template <class Belongs>
std::string list_of(const StabilityResult& result, const std::string& heading, Belongs belongs) {
  std::string text;
  for (const StressCaseRow& row : result.rows) {
    if (!belongs(row)) continue;
    if (text.empty()) text = heading;
    text += fmt::format("\n- {}: {}: {}", row.group, row.name, finding_text(row));
  }
  return text;
}

std::string wrong_text(const StabilityResult& result) {
  if (result.wrong() == 0) return result.failed() == 0 ? "No broken computation passes for a sound one." : "";
  return list_of(result,
                 fmt::format("WRONG: {} in which a broken computation gave a plausible verdict.",
                             counted(result.wrong(), "case")),
                 [](const StressCaseRow& row) { return row.is_wrong(); });
}

std::string unexpected_text(const StabilityResult& result) {
  return list_of(result, "Not as the study expects:", [](const StressCaseRow& row) {
    return row.computed() && !row.is_wrong() && !row.is_as_expected();
  });
}

std::string failed_text(const StabilityResult& result) {
  return list_of(result, "Not computed:", [](const StressCaseRow& row) { return !row.computed(); });
}

std::string legend() {
  return "- **held**: what must hold held.\n"
         "- **degraded**: it did not, or a limiter acted or a validity warning holds, and the result says so "
         "itself: "
         "the verdict is indeterminate, or names the limiter.\n"
         "- **caught**: the run was stopped and flagged, or the reader refused the scene.\n"
         "- **WRONG**: an invariant is violated, or T max is further from a safe computation of the same "
         "launch "
         "than its stated uncertainty, and yet a verdict says SAFE or UNSAFE.\n\n"
         "Invariants of every completed launch: all numbers finite; masses of the particles to 1e-12; "
         "momentum "
         "relative to the co-moving frame below 1e-6 of the load's impulse, or equal to it in the lab's "
         "frame; "
         "energy drift within the scene's limit; plastic, viscous and crack dissipation and friction heat "
         "that "
         "never fall; no skin colder than at first. Of a run through ignition that completed: finite "
         "numbers; "
         "energy made or lost in burning particles below 1 % of the heat of reaction of what burnt; energy "
         "drift within the limit; no more burnt than the charge has, and no more heat than that of reaction; "
         "gas within the temperatures of its law.\n";
}

std::string uncertainty_text(const study::Study& study) {
  return fmt::format(
      "Verdicts of the launches are judged with a numerical uncertainty of {} K unless their "
      "case states its own; with a large one assumed, nothing could be WRONG.\n",
      significant(study.numerical_uncertainty, 3));
}

nlohmann::ordered_json counts_json(const StabilityResult& result) {
  return {{"cases", result.rows.size()},
          {"held", result.count(Outcome::held)},
          {"degraded", result.count(Outcome::degraded)},
          {"caught", result.count(Outcome::caught)},
          {"WRONG", result.wrong()},
          {"not_as_expected", result.unexpected()},
          {"not_computed", result.failed()}};
}

}  // namespace

std::string answer(const StabilityResult& result) {
  std::vector<std::string> lines{counts_text(result), wrong_text(result), unexpected_text(result),
                                 failed_text(result)};
  if (result.interrupted) lines.emplace_back("The study was interrupted: some cases were not computed.");
  std::erase(lines, "");
  return fmt::format("{}", fmt::join(lines, "\n"));
}

Report report_of(const StabilityResult& result) {
  Report report{result.study.study.title, answer(result), remaking_command(result.study)};
  report.items = {
      ReportTable{.table = stability_summary(result), .shown = Shown::terminal},
      ReportTable{stability_table(result), "stability.csv", "cases", Shown::page},
      Statement{"## What the outcomes mean\n\n" + legend()},
      Statement{uncertainty_text(result.study.study)},
      ReportTable{launch_table(result), "launches.csv", "launches", Shown::page},
      Statement{"## Setup\n\n" + setup_text(result.study)},
  };
  report.json = study_json(result.study, report, {{"counts", counts_json(result)}});
  return report;
}

}  // namespace launchsafe::kinds
