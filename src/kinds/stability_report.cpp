// The answer, the tables, the picture and the page of a stability study.
#include "answer_tables.hpp"
#include "launchsafe/kinds/stability.hpp"

#include <fmt/format.h>

#include <iterator>

namespace launchsafe::kinds {

using keys::kelvin;
using report::Row;
using study::GapVerdict;

namespace {

/// "held", "degraded", "caught", "WRONG", or "not computed".
std::string outcome_text(const StressCaseRow& row) {
  return row.computed() ? to_string(row.finding.outcome) : "not computed";
}

/// The finding, or why there is none.
std::string finding_text(const StressCaseRow& row) {
  return row.computed() ? row.finding.text : row.answer.failure;
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

/// A case, and one of its gaps where there is one.
struct GapRow {
  const StressCaseRow* of;
  std::optional<std::size_t> gap;

  const GapVerdict* verdict() const { return gap ? &of->answer.verdicts[*gap] : nullptr; }
};

using keys::text;
const report::Quantities<StressCaseRow> stress_case_quantities{
    {"group", "group", text(), "Group of the case.", &StressCaseRow::asked, &StressCase::group},
    {quantity::case_name, &StressCaseRow::asked, &StressCase::name},
    {"outcome", "outcome", text(), "held, degraded, caught, WRONG, or not computed.", outcome_text},
    {"expected", "expected", text(), "What the study expects.", &StressCaseRow::asked, expected_text},
    {"as_expected", "as expected", text(), "Whether it came out so.", &StressCaseRow::is_as_expected},
    {"invariants", "invariants", text(), "What must hold.", &StressCaseRow::asked, invariants_text},
    {"finding", "finding", text(), "Why it came out so, and the numbers behind it.", finding_text}};

/// What there is to say of a case and of one of its gaps, which may have none of the numbers.
report::Quantities<GapRow> stability_quantities() {
  using keys::fixed;
  const auto of_run = [](auto get) {
    return [get](const GapRow& row) { return row.gap ? keys::cell_of(get(*row.of)) : keys::Cell(); };
  };
  const auto of_list = [](auto list) {
    return [list](const GapRow& row) {
      const std::vector<double>& values = list(*row.of);
      return row.gap && *row.gap < values.size() ? values[*row.gap] : study::not_a_number;
    };
  };
  return keys::joined<GapRow>(
      {of_part<GapRow>(stress_case_quantities, &GapRow::of),
       {{quantity::status, of_run([](const auto& row) { return run::to_string(row.answer.run.status); })},
        {"end_time", "until", fixed(4, keys::millisecond), "Instant that the run reached.",
         of_run([](const auto& row) { return row.end_time; })},
        {quantity::steps, of_run([](const auto& row) { return row.answer.run.steps; })},
        {quantity::particles, of_run([](const auto& row) { return row.answer.run.particles; })},
        {quantity::energy_drift, of_run([](const auto& row) { return row.answer.run.energy_drift; })},
        {quantity::gap, &GapRow::verdict, [](const GapVerdict& gap) { return gap.gap; }},
        {quantity::temperature_max, &GapRow::verdict,
         [](const GapVerdict& gap) { return report::known(gap.maximum.temperature); }},
        {quantity::temperature_max_inert,
         [](const GapRow& row) { return row.gap ? row.verdict()->heated : study::not_a_number; }},
        {"safe_computation", "safe computation", fixed(1, kelvin), "T max of the safe computation.",
         of_list([](const StressCaseRow& row) -> auto& { return row.heated_against; })},
        {"deviation", "against", fixed(1, kelvin), "How far the case is off it.",
         of_list([](const StressCaseRow& row) -> auto& { return row.deviations; })},
        {quantity::uncertainty, &GapRow::verdict,
         [](const GapVerdict& gap) { return gap.uncertainty.total(); }},
        {quantity::verdict, &GapRow::verdict, [](const GapVerdict& gap) { return gap.judgement.verdict; }},
        {quantity::reason, &GapRow::verdict, [](const GapVerdict& gap) { return reason_text(gap); }},
        {quantity::limiters,
         of_run([](const auto& row) { return run::to_string(row.answer.run.limiters); })}}});
}

/// A row for every gap of every case: what must hold, what became of it, why, and the numbers behind it.
report::Table stability_table(const StabilityResult& result) {
  std::vector<GapRow> rows;
  for (const StressCaseRow& row : result.rows) {
    const std::size_t gaps = row.computed() ? row.answer.verdicts.size() : 0;
    for (std::size_t i = 0; i < gaps; ++i) rows.push_back({&row, i});
    if (gaps == 0) rows.push_back({&row, std::nullopt});
  }
  return report::table_of("Stress cases", stability_quantities(), rows);
}

std::size_t count_missing(const StabilityResult& result) {
  return result.rows.size() -
         static_cast<std::size_t>(std::ranges::count_if(result.rows, &StressCaseRow::computed));
}

constexpr Outcome all_outcomes[] = {Outcome::held, Outcome::degraded, Outcome::caught, Outcome::wrong};

/// How many cases of every group came out how: a bar of parts, the first group on top.
report::Plot outcome_plot(const StabilityResult& result) {
  constexpr int green = 2, orange = 4, blue = 0, black = 6;
  constexpr int colours[] = {green, orange, blue, black};
  report::Plot plot;
  plot.x = {.label = "cases", .minimum = 0.0};
  std::map<std::string, double> places;
  std::map<std::pair<std::string, Outcome>, double> cases;
  for (const StressCaseRow& row : result.rows) {
    const double at = -static_cast<double>(places.size());
    if (places.try_emplace(row.asked.group, at).second) plot.y.tics.push_back({at, row.asked.group});
    if (row.computed()) ++cases[{row.asked.group, row.finding.outcome}];
  }
  std::map<std::string, double> ends;
  for (const Outcome outcome : all_outcomes) {
    const std::string label = fmt::format("{} {}", result.count(outcome), to_string(outcome));
    plot.title += (plot.title.empty() ? "" : ", ") + label;
    report::Series& series = plot.series.emplace_back(report::Series{.label = label});
    series.style = report::Style::filled_bars;
    series.colour = colours[static_cast<std::size_t>(outcome)];
    for (const auto& [group, place] : places) {
      const double count = cases[{group, outcome}], end = ends[group] + count;
      if (count > 0) series.add(end, place, std::exchange(ends[group], end), end);
    }
  }
  plot.title = fmt::format("Of {} stress cases {}", result.rows.size(), plot.title);
  return plot;
}

std::string legend(const study::Study& study) {
  Row invariants = Row::array();
  for (const Invariant& each : all_invariants())
    invariants.push_back({{"name", each.name}, {"words", each.words}});
  return fmt::format(
      "{}\nInvariants, with an uncertainty of T max of {} unless the case states its own:\n\n{}",
      said_below("stability.outcomes"),
      report::in_words(study.numerical_uncertainty, keys::significant(3, kelvin)),
      said_below("stability.invariants", {{"invariants", invariants}}));
}

nlohmann::ordered_json counts_json(const StabilityResult& result) {
  nlohmann::ordered_json counts;
  counts["cases"] = result.rows.size();
  for (const Outcome outcome : all_outcomes) counts[to_string(outcome)] = result.count(outcome);
  const std::size_t missing = count_missing(result);
  const auto as_expected = std::ranges::count_if(result.rows, &StressCaseRow::is_as_expected);
  counts["not_as_expected"] =
      result.rows.size() - static_cast<std::size_t>(as_expected) - result.count(Outcome::wrong) - missing;
  counts["not_computed"] = missing;
  return counts;
}

/// A row for every case that is not held, with the reason in a few words.
report::Table not_held_table(const StabilityResult& result) {
  std::vector<StressCaseRow> rows;
  std::ranges::copy_if(result.rows, std::back_inserter(rows),
                       [](const StressCaseRow& row) { return !row.is(Outcome::held); });
  return report::table_of<StressCaseRow>(
      "Not held",
      {{quantity::case_name, [](const StressCaseRow& row) { return row.asked.label(); }},
       {"outcome", "outcome", keys::text(), "What became of it.", outcome_text},
       {"why", "why", keys::text(), "Why.",
        [](const StressCaseRow& row) {  // without the numbers behind it
          const std::string text = finding_text(row);
          return text.substr(0, std::min(text.find(", "), text.find("; ")));
        }}},
      rows);
}

}  // namespace

std::string answer(const StabilityResult& result) {
  Row facts = counts_json(result);
  facts["sound"] = result.count(Outcome::wrong) + count_missing(result) == 0;
  facts["interrupted"] = result.interrupted;
  for (const StressCaseRow& row : result.rows)
    if (!row.is_as_expected())
      facts["unexpected"].push_back(
          {{"case", row.asked.label()}, {"outcome", outcome_text(row)}, {"finding", finding_text(row)}});
  return fmt::format("{}", fmt::join(said("stability.answer", facts), "\n"));
}

report::Report report_of(const StabilityResult& result) {
  report::Report report{result.study.study.title, answer(result), report::remaking_command(result.study)};
  report.items = {
      report::Picture{"outcomes.svg", outcome_plot(result), "How many cases of every group came out how"},
      report::ReportTable{not_held_table(result)},
      report::Statement{"All cases with their numbers: `stability.csv`.\n"},
      report::ReportTable{stability_table(result), "stability.csv", "cases", report::Shown::file},
      report::Statement{"## What the outcomes mean\n\n" + legend(result.study.study)},
  };
  report.json = study_json(result.study, report, {{"counts", counts_json(result)}});
  return report;
}

std::vector<report::ReportTable> stability_results() {
  return {{report::table_of({}, stability_quantities(), {}), "stability.csv", "cases"}};
}

}  // namespace launchsafe::kinds
