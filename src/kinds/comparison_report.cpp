// The answer, the tables and the page of a comparison.
#include "answer_tables.hpp"
#include "comparison_model_form.hpp"
#include "launchsafe/kinds/comparison.hpp"
#include "launchsafe/report/columns.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/shown_key.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using namespace study;
using namespace report;

namespace {

/// Variant, and peak pressure where there are several.
PlacedAnswers answers_of(const ComparisonResult& result) {
  const std::vector<ShownKey> keys = shown_axes(result.study.study);
  PlacedAnswers placed{{named_text("variant", "variant")}, {}};
  for (const ShownKey& key : keys) placed.columns.push_back(key.column());
  for (std::size_t i = 0; i < result.cases.size(); ++i) {
    std::vector<Cell> cells = axis_cells(keys, result.study.cases[i]);
    cells.insert(cells.begin(), result.variants()[result.cases[i].variant].name);
    placed.rows.push_back({std::move(cells), &result.cases[i].answer});
  }
  return placed;
}

double hottest(const ComparedCase& each) {
  double highest = not_a_number;
  for (const double temperature : each.answer.heated_temperature) {
    if (!(temperature <= highest)) highest = temperature;
  }
  return highest;
}

/// "of bonded: `interface.wall.condition` = bonded".
std::string changes_text(const std::vector<Variant>& variants) {
  std::string text;
  for (const Variant& each : variants) {
    text += fmt::format("- `{}`{}{}", each.name, each.description.empty() ? "" : ": ", each.description);
    for (const std::string& change : each.changes) text += fmt::format("; `{}`", change);
    if (each.calibration && !each.calibration->failure.empty())
      text += "; not calibrated, with the constants of the study: " + each.calibration->failure;
    text += "\n";
  }
  return text;
}

/// m by which the critical gap of a variant is above that of the scene as it is; NaN where one has none.
double shift_of(const ComparisonResult& result, std::size_t index) {
  return value_of(result.cases[index].answer.critical) -
         value_of(result.cases[result.counterpart(index)].answer.critical);
}

/// The variant with the smallest critical gap against that of the scene as it is.
std::string largest_shift_text(const ComparisonResult& result) {
  std::optional<std::size_t> most;
  std::size_t unknown = 0;
  for (std::size_t i = 0; i < result.cases.size(); ++i) {
    if (result.cases[i].variant == 0) continue;
    const double shift = shift_of(result, i);
    if (std::isnan(shift)) ++unknown;
    if (shift < 0.0 && (!most || shift < shift_of(result, *most))) most = i;
  }
  std::string text =
      most ? fmt::format("The largest step towards ignition is {} cm, of {}.",
                         significant(100.0 * shift_of(result, *most), 3), result.study.cases[*most].label)
           : std::string("No variant has a smaller critical gap that is a value.");
  if (unknown > 0)
    text += fmt::format(" In {} case{} one of both critical gaps is none or a bound.", unknown,
                        unknown == 1 ? "" : "s");
  return text;
}

/// A row for every case: critical gap, hottest temperature, both less those of the scene as it is, and cost.
Table comparison_table(const ComparisonResult& result) {
  const PlacedAnswers answers = answers_of(result);
  Table table = answers.table("Variants side by side");
  append(table.columns, critical_gap_columns());
  append(table.columns,
         {significant_column("less that of the scene", "cm", 3, "critical_gap_difference_cm"),
          quantity::temperature_max_inert(),
          number_column("less that of the scene", "K", 1, "temperature_max_inert_difference_K"),
          significant_column("processor time", "s", 3, "processor_time_s"), quantity::particles(),
          quantity::steps(), quantity::energy_drift(), quantity::reason()});
  for (std::size_t i = 0; i < result.cases.size(); ++i) {
    const ComparedCase& each = result.cases[i];
    const ComparedCase& own = result.cases[result.counterpart(i)];
    std::vector<Cell>& cells = table.rows.emplace_back(answers.rows[i].place);
    add_critical_gap_cells(each.answer.critical, cells);
    cells.push_back(each.variant == 0 ? Cell() : optional_number(100.0 * shift_of(result, i)));
    cells.push_back(optional_number(hottest(each)));
    cells.push_back(each.variant == 0 ? Cell() : optional_number(hottest(each) - hottest(own)));
    cells.push_back(optional_number(each.processor_time));
    cells.emplace_back(static_cast<std::int64_t>(each.answer.run.particles));
    cells.emplace_back(static_cast<std::int64_t>(each.answer.run.steps));
    cells.push_back(optional_number(each.answer.run.energy_drift));
    cells.emplace_back(each.answer.completed() ? each.answer.critical.reason : each.answer.failure);
  }
  table.notes.emplace_back(
      "T max without reaction: over stations and gaps. Only a critical gap that is a value has a "
      "difference.");
  return table;
}

/// A row for every station of every gap and case.
Table station_table(const ComparisonResult& result) {
  const PlacedAnswers answers = answers_of(result);
  Table table = answers.table("T max of every station, without reaction");
  append(table.columns,
         {quantity::gap(), named_text("station", "station"), quantity::temperature_max_inert()});
  const std::vector<double>& gaps = result.study.study.gaps;
  for (std::size_t i = 0; i < result.cases.size(); ++i) {
    const auto& stations = result.cases[i].stations;
    for (std::size_t gap = 0; gap < stations.size(); ++gap) {
      for (const StationTemperature& each : stations[gap]) {
        std::vector<Cell>& cells = table.rows.emplace_back(answers.rows[i].place);
        cells.insert(cells.end(), {in_centimetres(gaps[gap]), each.name, each.temperature});
      }
    }
  }
  return table;
}

/// Stations side by side at the largest gap: a column for each variant and peak pressure.
Table stations_side_by_side(const ComparisonResult& result) {
  const std::vector<double>& gaps = result.study.study.gaps;
  const auto gap = static_cast<std::size_t>(std::max_element(gaps.begin(), gaps.end()) - gaps.begin());
  Table table{"T max [K] by station at " + centimetres(gaps[gap]) + ", without reaction",
              {named_text("station", "station")}};
  const auto row_of = [&table](const std::string& station) -> std::vector<Cell>& {
    const auto found = std::find_if(table.rows.begin(), table.rows.end(),
                                    [&](const auto& row) { return row.front() == Cell(station); });
    return found == table.rows.end() ? table.rows.emplace_back(std::vector<Cell>{station}) : *found;
  };
  for (std::size_t i = 0; i < result.cases.size(); ++i) {
    const ComparedCase& each = result.cases[i];
    // Peak pressures are compared in the files; here the first one of every variant.
    const bool shown = result.counterpart(i) == 0;
    const std::string& variant = result.variants()[each.variant].name;
    if (shown) table.columns.push_back(number_column(variant, "", 1, variant));
    if (each.stations.empty()) continue;
    for (const StationTemperature& station : each.stations[gap]) {
      std::vector<Cell>& row = row_of(station.name);
      row.resize(table.columns.size());
      if (shown) row.back() = station.temperature;
    }
  }
  for (std::vector<Cell>& row : table.rows) row.resize(table.columns.size());
  if (!result.study.study.axes.empty())
    table.notes.emplace_back("Under the first peak pressure; stations.csv has the others.");
  return table;
}

}  // namespace

std::string answer(const ComparisonResult& result) {
  std::vector<std::string> lines{fmt::format("{} variants of a scene, {} cases, each at {} gaps.",
                                             result.variants().size() - 1, result.cases.size(),
                                             result.study.study.gaps.size())};
  for (std::size_t i = 0; i < result.cases.size() && result.cases[i].variant == 0; ++i)
    lines.push_back(fmt::format("{}: critical gap {}.", result.study.cases[i].label,
                                reads_as(result.cases[i].answer.critical)));
  lines.push_back(largest_shift_text(result));
  return answer_of(std::move(lines), result.study, result.interrupted ? interrupted_note : "");
}

Report report_of(const ComparisonResult& result) {
  Report report{result.study.study.title, answer(result), remaking_command(result.study)};
  report.items = {ReportTable{comparison_table(result), "comparison.csv", "cases"},
                  ReportTable{station_table(result), "stations.csv", "stations", Shown::file}};
  report.items.push_back(
      ReportTable{.table = stations_side_by_side(result), .shown = Shown::page, .rest = "stations.csv"});
  add_model_form(result, report);
  report.items.push_back(Statement{"## Variants\n\n" + changes_text(result.variants())});
  report.items.push_back(Statement{"## What it rests on\n\n" + friction_remark(result.study)});
  report.items.push_back(Statement{station_note(result.study) + "\n"});
  report.items.push_back(Statement{"## Setup\n\n" + setup_text(result.study)});
  report.items.push_back(Statement{timing_sentence(result.timing)});
  report.json = study_json(result.study, report,
                           {{"axes", axes_json(result.study.study)},
                            {"early_time_ms", 1e3 * result.study.study.early_time},
                            {"timing", timing_json(result.timing)}});
  return report;
}

}  // namespace launchsafe::kinds
