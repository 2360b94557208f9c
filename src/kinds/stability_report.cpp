// The answer, the tables, the picture and the page of a stability study.
#include "launchsafe/kinds/stability.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/shown_key.hpp"
#include "launchsafe/report/study_text.hpp"
#include "sweep_text.hpp"

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
  return row.computed() ? row.finding.text : row.run.failure;
}

/// The reason without the numbers behind it.
std::string first_clause(const std::string& text) {
  return text.substr(0, std::min(text.find(", "), text.find("; ")));
}

std::string expected_text(const StressCase& asked) {
  std::vector<std::string> names;
  for (const Outcome each : asked.expected) names.push_back(to_string(each));
  return names.empty() ? "not WRONG" : fmt::format("{}", fmt::join(names, " or "));
}

std::string invariants_text(const StressCase& asked) {
  std::vector<std::string> names;
  for (const Invariant each : asked.invariants)
    names.push_back(named_invariants()[static_cast<std::size_t>(each)].name);
  return asked.invariants == all_invariants() ? "all" : fmt::format("{}", fmt::join(names, " "));
}

std::vector<Cell> case_cells(const StressCaseRow& row) {
  const StressCase& asked = row.asked;
  return {asked.group,
          asked.name,
          outcome_text(row),
          expected_text(asked),
          std::string(row.is_as_expected() ? "yes" : "no"),
          invariants_text(asked),
          finding_text(row)};
}

std::vector<Cell> gap_cells(const StressCaseRow& row, std::size_t i) {
  const CaseAnswer& answer = row.run.answer;
  const GapVerdict& gap = answer.verdicts[i];
  const double against = i < row.heated_against.size() ? row.heated_against[i] : not_a_number;
  return {run::to_string(answer.run.status),
          optional_number(1e3 * row.run.end_time),
          static_cast<std::int64_t>(answer.run.steps),
          static_cast<std::int64_t>(answer.run.particles),
          optional_number(answer.run.energy_drift),
          in_centimetres(gap.gap),
          optional_number(gap.maximum.temperature),
          optional_number(answer.heated_temperature[i]),
          optional_number(against),
          optional_number(row.deviation(i)),
          optional_number(gap.uncertainty.total()),
          study::to_string(gap.judgement.verdict),
          gap.judgement.reason,
          run::to_string(answer.run.limiters)};
}

}  // namespace

Table not_held_table(const StabilityResult& result) {
  Table table;
  table.title = "Not held";
  table.columns = {quantity::case_name(), named_text("outcome", "outcome"), named_text("why", "why")};
  for (const StressCaseRow& row : result.rows)
    if (!row.is(Outcome::held))
      table.rows.push_back({row.asked.label(), outcome_text(row), first_clause(finding_text(row))});
  return table;
}

Table stability_table(const StabilityResult& result) {
  Table table;
  table.title = "Stress cases";
  table.columns = {named_text("group", "group"),
                   quantity::case_name(),
                   named_text("outcome", "outcome"),
                   named_text("expected", "expected"),
                   named_text("as expected", "as_expected"),
                   named_text("invariants", "invariants"),
                   named_text("finding", "finding"),
                   quantity::status(),
                   number_column("until", "ms", 4, "end_time_ms"),
                   quantity::steps(),
                   quantity::particles(),
                   quantity::energy_drift(),
                   quantity::gap(),
                   quantity::temperature_max(),
                   quantity::temperature_max_inert(),
                   number_column("safe computation", "K", 1, "safe_computation_K"),
                   number_column("against", "K", 1, "deviation_K"),
                   quantity::uncertainty(),
                   quantity::verdict(),
                   quantity::reason(),
                   quantity::limiters()};
  for (const StressCaseRow& row : result.rows) {
    const std::size_t gaps = row.computed() ? row.run.answer.verdicts.size() : 0;
    for (std::size_t i = 0; i < std::max<std::size_t>(gaps, 1); ++i) {
      std::vector<Cell> cells = case_cells(row);
      if (i < gaps) std::ranges::copy(gap_cells(row, i), std::back_inserter(cells));
      cells.resize(table.columns.size());
      table.rows.push_back(std::move(cells));
    }
  }
  return table;
}

namespace {

template <class Belongs>
std::size_t count(const StabilityResult& result, Belongs belongs) {
  return static_cast<std::size_t>(std::count_if(result.rows.begin(), result.rows.end(), belongs));
}

std::size_t count_missing(const StabilityResult& result) {
  return count(result, [](const StressCaseRow& row) { return !row.computed(); });
}

/// Every case that is WRONG, not as expected or not computed, a line each.
std::string unexpected_text(const StabilityResult& result) {
  std::string text;
  for (const StressCaseRow& row : result.rows)
    if (!row.is_as_expected())
      text += fmt::format("\n- {}: {}: {}", row.asked.label(), outcome_text(row), finding_text(row));
  return text.empty() ? text : "Not as the study expects:" + text;
}

/// How many cases of every group came out how: a bar for every outcome, the first group on top.
Plot outcome_plot(const StabilityResult& result) {
  constexpr int green = 2, orange = 4, blue = 0, black = 6;
  Plot plot;
  plot.title = "Outcomes of the stress cases";
  plot.x.label = "cases";
  for (const auto& [outcome, colour] : {std::pair{Outcome::held, green},
                                        {Outcome::degraded, orange},
                                        {Outcome::caught, blue},
                                        {Outcome::wrong, black}})
    plot.series.push_back({to_string(outcome), {}, {}, Style::horizontal_bars, {}, {}, colour});
  std::map<std::string, std::size_t> places;
  for (const StressCaseRow& row : result.rows) {
    const double at = -static_cast<double>(places.size());
    if (places.try_emplace(row.asked.group, places.size()).second)
      plot.y.tics.push_back({at, row.asked.group});
  }
  for (const auto& [group, place] : places) {
    for (std::size_t i = 0; i < plot.series.size(); ++i) {
      Series& series = plot.series[i];
      const auto cases = static_cast<double>(count(result, [&](const StressCaseRow& row) {
        return row.asked.group == group && row.is(static_cast<Outcome>(i));
      }));
      if (cases == 0.0) continue;
      series.x.push_back(cases);
      series.y.push_back(-static_cast<double>(place) + 0.3 - 0.2 * static_cast<double>(i));
      series.lower.push_back(0.0);
      series.upper.push_back(cases);
    }
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
  for (const NamedInvariant& each : named_invariants())
    text += fmt::format("- `{}`: {}.\n", each.name, each.words);
  return text;
}

nlohmann::ordered_json counts_json(const StabilityResult& result) {
  return {{"cases", result.rows.size()},
          {"held", result.count(Outcome::held)},
          {"degraded", result.count(Outcome::degraded)},
          {"caught", result.count(Outcome::caught)},
          {"WRONG", result.count(Outcome::wrong)},
          {"not_as_expected", count(result,
                                    [](const StressCaseRow& row) {
                                      return row.computed() && !row.is(Outcome::wrong) &&
                                             !row.is_as_expected();
                                    })},
          {"not_computed", count_missing(result)}};
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
