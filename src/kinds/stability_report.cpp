// The answer, the tables, the picture and the page of a stability study.
#include "answer_tables.hpp"
#include "launchsafe/kinds/stability.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/shown_key.hpp"
#include "launchsafe/report/study_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

namespace launchsafe::kinds {

using namespace study;
using namespace report;

namespace {

/// "held", "degraded", "caught", "WRONG", or "not computed".
std::string outcome_text(const StressCaseRow& row) {
  return row.computed() ? to_string(row.finding.outcome) : "not computed";
}

/// The finding, or why there is none.
std::string finding_text(const StressCaseRow& row) {
  return row.computed() ? row.finding.text : row.answer.failure;
}

/// The reason without the numbers behind it.
std::string first_clause(const std::string& text) {
  return text.substr(0, std::min(text.find(", "), text.find("; ")));
}

std::string expected_text(const StressCase& asked) {
  Sentences names;
  for (const Outcome each : asked.expected) names.push_back(to_string(each));
  return names.empty() ? "not WRONG" : fmt::format("{}", fmt::join(names, " or "));
}

std::string invariants_text(const StressCase& asked) {
  Sentences names;
  for (const std::size_t place : asked.invariants) names.push_back(all_invariants()[place].name);
  return names.size() == all_invariants().size() ? "all" : fmt::format("{}", fmt::join(names, " "));
}

/// What there is to say of a case and of one of its gaps, which may have none of the numbers.
std::vector<Field> stress_fields(const StressCaseRow& row, std::size_t i) {
  const CaseAnswer& answer = row.answer;
  const GapVerdict gap = i < answer.verdicts.size() ? answer.verdicts[i] : GapVerdict{};
  return {{named_text("group", "group"), row.asked.group},
          {quantity::case_name(), row.asked.name},
          {named_text("outcome", "outcome"), outcome_text(row)},
          {named_text("expected", "expected"), expected_text(row.asked)},
          {named_text("as expected", "as_expected"), row.is_as_expected() ? "yes" : "no"},
          {named_text("invariants", "invariants"), invariants_text(row.asked)},
          {named_text("finding", "finding"), finding_text(row)},
          {quantity::status(), run::to_string(answer.run.status)},
          {number_column("until", "ms", 4, "end_time_ms"), 1e3 * row.end_time},
          {quantity::steps(), Cell(static_cast<std::int64_t>(answer.run.steps))},
          {quantity::particles(), Cell(static_cast<std::int64_t>(answer.run.particles))},
          {quantity::energy_drift(), answer.run.energy_drift},
          {quantity::gap(), in_centimetres(gap.gap)},
          {quantity::temperature_max(), gap.maximum.temperature},
          {quantity::temperature_max_inert(), number_at(answer.heated_temperature, i)},
          {number_column("safe computation", "K", 1, "safe_computation_K"), number_at(row.heated_against, i)},
          {number_column("against", "K", 1, "deviation_K"), number_at(row.deviations, i)},
          {quantity::uncertainty(), gap.uncertainty.total()},
          {quantity::verdict(), study::to_string(gap.judgement.verdict)},
          {quantity::reason(), gap.judgement.reason},
          {quantity::limiters(), run::to_string(answer.run.limiters)}};
}
/// So many of them are of the case; a row without a gap has no others.
constexpr std::size_t fields_of_case = 7;

/// A row for every gap of every case: what must hold, what became of it, why, and the numbers behind it.
Table stability_table(const StabilityResult& result) {
  Table table;
  table.title = "Stress cases";
  for (const StressCaseRow& row : result.rows) {
    const std::size_t gaps = row.computed() ? row.answer.verdicts.size() : 0;
    for (std::size_t i = 0; i < std::max<std::size_t>(gaps, 1); ++i) {
      std::vector<Field> fields = stress_fields(row, i);
      for (std::size_t k = fields_of_case; gaps == 0 && k < fields.size(); ++k) fields[k].cell = {};
      add_row(table, std::move(fields));
    }
  }
  return table;
}

/// How many rows that is true of.
template <class Belongs>
std::size_t count(const StabilityResult& result, Belongs belongs) {
  return static_cast<std::size_t>(std::ranges::count_if(result.rows, belongs));
}

std::size_t count_missing(const StabilityResult& result) {
  return result.rows.size() - count(result, &StressCaseRow::computed);
}

/// Every case that is WRONG, not as expected or not computed, a line each.
std::string unexpected_text(const StabilityResult& result) {
  std::string text;
  for (const StressCaseRow& row : result.rows)
    if (!row.is_as_expected())
      text += fmt::format("\n- {}: {}: {}", row.asked.label(), outcome_text(row), finding_text(row));
  return text.empty() ? text : "Not as the study expects:" + text;
}

constexpr Outcome all_outcomes[] = {Outcome::held, Outcome::degraded, Outcome::caught, Outcome::wrong};

/// How many cases of every group came out how: a bar for every outcome, the first group on top.
Plot outcome_plot(const StabilityResult& result) {
  constexpr int green = 2, orange = 4, blue = 0, black = 6;
  constexpr int colours[] = {green, orange, blue, black};
  Plot plot;
  plot.title = "Outcomes of the stress cases";
  plot.x.label = "cases";
  std::map<std::string, double> places;
  std::map<std::pair<Outcome, std::string>, double> cases;
  for (const StressCaseRow& row : result.rows) {
    const double at = -static_cast<double>(places.size());
    if (places.try_emplace(row.asked.group, at).second) plot.y.tics.push_back({at, row.asked.group});
    if (row.computed()) ++cases[{row.finding.outcome, row.asked.group}];
  }
  for (const Outcome outcome : all_outcomes) {
    const auto i = static_cast<std::size_t>(outcome);
    plot.series.push_back({to_string(outcome), {}, {}, Style::horizontal_bars, {}, {}, colours[i]});
  }
  for (const auto& [which, count] : cases) {
    const auto i = static_cast<std::size_t>(which.first);
    Series& series = plot.series[i];
    series.x.push_back(count);
    series.y.push_back(places[which.second] + 0.3 - 0.2 * static_cast<double>(i));
    series.lower.push_back(0.0);
    series.upper.push_back(count);
  }
  return plot;
}

std::string legend(const Study& study) {
  std::string text = fmt::format(
      "- **held**: what must hold held.\n"
      "- **degraded**: it did not, a limiter acted or a validity warning holds, and the result says so.\n"
      "- **caught**: the run was stopped, or the scene refused.\n"
      "- **WRONG**: an invariant is violated, and yet a verdict says SAFE or UNSAFE.\n\n"
      "Invariants, with an uncertainty of T max of {} K unless the case states its own:\n\n",
      significant(study.numerical_uncertainty, 3));
  for (const Invariant& each : all_invariants()) text += fmt::format("- `{}`: {}.\n", each.name, each.words);
  return text;
}

nlohmann::ordered_json counts_json(const StabilityResult& result) {
  nlohmann::ordered_json counts;
  counts["cases"] = result.rows.size();
  for (const Outcome outcome : all_outcomes) counts[to_string(outcome)] = result.count(outcome);
  const std::size_t missing = count_missing(result);
  counts["not_as_expected"] = result.rows.size() - count(result, &StressCaseRow::is_as_expected) -
                              result.count(Outcome::wrong) - missing;
  counts["not_computed"] = missing;
  return counts;
}

/// A row for every case that is not held, with the reason in a few words.
Table not_held_table(const StabilityResult& result) {
  Table table;
  table.title = "Not held";
  table.columns = {quantity::case_name(), named_text("outcome", "outcome"), named_text("why", "why")};
  for (const StressCaseRow& row : result.rows)
    if (!row.is(Outcome::held))
      table.rows.push_back({row.asked.label(), outcome_text(row), first_clause(finding_text(row))});
  return table;
}

}  // namespace

std::string answer(const StabilityResult& result) {
  const std::size_t wrong = result.count(Outcome::wrong);
  std::vector<std::string> lines{
      fmt::format("{}: {} held, {} degraded with a reason, {} caught, {} WRONG.",
                  counted(result.rows.size(), "stress case"), result.count(Outcome::held),
                  result.count(Outcome::degraded), result.count(Outcome::caught), wrong),
      wrong + count_missing(result) == 0 ? "No broken computation passes for a sound one." : "",
      unexpected_text(result),
      result.interrupted ? "The study was interrupted: some cases were not computed." : ""};
  std::erase(lines, "");
  return fmt::format("{}", fmt::join(lines, "\n"));
}

Report report_of(const StabilityResult& result) {
  Report report{result.study.study.title, answer(result), remaking_command(result.study)};
  report.items = {
      Picture{"outcomes.svg", outcome_plot(result), "How many cases of every group came out how"},
      ReportTable{not_held_table(result)},
      Statement{"All cases with their numbers: `stability.csv`.\n"},
      ReportTable{stability_table(result), "stability.csv", "cases", Shown::file},
      Statement{"## What the outcomes mean\n\n" + legend(result.study.study)},
  };
  report.json = study_json(result.study, report, {{"counts", counts_json(result)}});
  return report;
}

}  // namespace launchsafe::kinds
