// The tables and the pictures of a sensitivity study.
#include "answer_tables.hpp"
#include "launchsafe/kinds/sensitivity.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/shown_key.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "sensitivity_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using namespace study;
using namespace report;

namespace {

std::vector<Column> index_columns() {
  return {number_column("S1", "", 3, "first_order"),
          number_column("from", "", 3, "first_order_lower"),
          number_column("to", "", 3, "first_order_upper"),
          number_column("ST", "", 3, "total_order"),
          number_column("from", "", 3, "total_order_lower"),
          number_column("to", "", 3, "total_order_upper"),
          count_column("rows used", "used"),
          count_column("of", "of")};
}

/// Input and distribution, and the numbers where there are any.
std::vector<Cell> cells_of(const SensitivityResult& result, const OutputSensitivity& output,
                           std::size_t input) {
  const ShownInput shown = shown_inputs(result.study.study)[input];
  std::vector<Cell> cells{shown.name, shown.distribution};
  if (!output.reason.empty()) return cells;
  const auto& [first, total] = output.sobol.inputs[input];
  for (const math::Estimate& of : {first, total})
    for (const double value : {of.value, of.lower, of.upper}) cells.push_back(optional_number(value));
  cells.emplace_back(static_cast<std::int64_t>(output.sobol.rows_used));
  cells.emplace_back(static_cast<std::int64_t>(output.sobol.rows_used + output.sobol.rows_left_out));
  return cells;
}

std::string inert_note() {
  return "Some evaluations ignite. T max and margin are therefore those of a skin that air and friction heat "
         "and that does not react: the burning skin's T max would jump. What matters to the reaction shows "
         "in the critical gap.";
}

std::string missing_note(const OutputSensitivity& output) {
  return fmt::format("{} of {} evaluations have no number here{}.", output.missing, output.values.size(),
                     output.bounds > 0 ? fmt::format(", {} of them bounds", output.bounds) : std::string{});
}

std::string spread_note(const OutputSensitivity& output) {
  const ShownOutput& shown = shown_output(output.output);
  return fmt::format("Mean {0} {2}, standard deviation {1} {2} over the evaluations that sample the inputs.",
                     significant(shown.scale * output.mean, 4),
                     significant(shown.scale * output.deviation, 3), shown.unit);
}

/// Whether the estimates of an input contradict each other: no true total order is below the first.
bool total_below_first(const math::InputIndices& indices) {
  return indices.total.value < indices.first.value;
}

/// Which inputs show sampling error by such estimates, with their intervals; empty where none does.
std::string sampling_note(const SensitivityResult& result, const OutputSensitivity& output) {
  const auto shown = shown_inputs(result.study.study);
  std::string inputs;
  bool apart = false;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto& [first, total] = output.sobol.inputs[i];
    if (!total_below_first(output.sobol.inputs[i])) continue;
    inputs += fmt::format("{}{} (ST {}, S1 {})", inputs.empty() ? "" : ", ", shown[i].name,
                          estimate_text(total), estimate_text(first));
    apart = apart || total.upper < first.lower;
  }
  if (inputs.empty()) return {};
  return fmt::format(
      "ST below S1 is sampling error, as no true total order is below the first order: {}. {}", inputs,
      apart ? "Where their intervals do not overlap, these are too narrow." : "Their intervals overlap.");
}

std::vector<std::string> notes_of(const SensitivityResult& result, const OutputSensitivity& output) {
  std::vector<std::string> notes;
  if (!output.reason.empty()) notes.push_back("No indices: " + output.reason + ".");
  if (std::isfinite(output.mean)) notes.push_back(spread_note(output));
  if (output.missing > 0) notes.push_back(missing_note(output));
  notes.push_back(method_text(result));
  if (output.reason.empty()) notes.push_back(sampling_note(result, output));
  if (output.inert) notes.push_back(inert_note());
  std::erase(notes, "");
  return notes;
}

}  // namespace

Table sensitivity_table(const SensitivityResult& result, const OutputSensitivity& output) {
  const ShownOutput& shown = shown_output(output.output);
  Table table{"Sensitivity of " + shown.phrase + at_gap(result.study.study, output.output),
              {named_text("input", "input"), named_text("distribution", "distribution")}};
  append(table.columns, index_columns());
  for (std::size_t i = 0; i < inputs_of(result.study.study).size(); ++i)
    table.rows.push_back(cells_of(result, output, i));
  table.notes = notes_of(result, output);
  return table;
}

Table sensitivity_table(const SensitivityResult& result) {
  Table table{"Sensitivity",
              {named_text("output", "output"), named_text("unit", "unit"), quantity::reason(),
               named_text("input", "input"), named_text("distribution", "distribution")}};
  append(table.columns, index_columns());
  for (const OutputSensitivity& output : result.outputs) {
    const ShownOutput& shown = shown_output(output.output);
    for (std::size_t i = 0; i < inputs_of(result.study.study).size(); ++i) {
      std::vector<Cell> cells{shown.key, std::string{}, output.reason};
      for (Cell& cell : cells_of(result, output, i)) cells.push_back(std::move(cell));
      table.rows.push_back(std::move(cells));
    }
  }
  table.notes = {method_text(result)};
  return table;
}

Table output_table(const SensitivityResult& result) {
  Table table;
  table.title = "Outputs";
  table.columns = {named_text("output", "output"),
                   named_text("unit", "unit"),
                   significant_column("mean", "", 4, "mean"),
                   significant_column("standard deviation", "", 3, "standard_deviation"),
                   count_column("without a number", "missing"),
                   count_column("bounds", "bounds"),
                   quantity::reason()};
  for (const OutputSensitivity& output : result.outputs) {
    const ShownOutput& shown = shown_output(output.output);
    table.rows.push_back({shown.key, shown.unit, optional_number(shown.scale * output.mean),
                          optional_number(shown.scale * output.deviation),
                          static_cast<std::int64_t>(output.missing), static_cast<std::int64_t>(output.bounds),
                          output.reason});
  }
  return table;
}

Table evaluation_table(const SensitivityResult& result) {
  const auto keys = shown_axes(result.study.study);
  Table table{"Evaluations", {count_column("number", "number"), named_text("evaluation", "evaluation")}};
  for (const ShownKey& key : keys) table.columns.push_back(key.column());
  for (const OutputSensitivity& output : result.outputs) {
    const ShownOutput& shown = shown_output(output.output);
    table.columns.push_back(significant_column(shown.name, shown.unit, 6, shown.key + "_" + shown.unit));
  }
  append(table.columns,
         {for_programs(quantity::critical_gap_kind()), named_text("critical gap", "critical_gap_reads_as"),
          quantity::status(), named_text("failure", "reason")});
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const study::StudyCase& input = result.study.cases[i];
    const study::CaseAnswer& answer = result.answers[i];
    std::vector<Cell>& cells = table.rows.emplace_back(axis_cells(keys, input));
    cells.insert(cells.begin(), {static_cast<std::int64_t>(i + 1), input.label});
    for (const OutputSensitivity& output : result.outputs)
      cells.push_back(optional_number(shown_output(output.output).scale * output.values[i]));
    cells.insert(cells.end(), {study::to_string(answer.critical.kind), reads_as(answer.critical),
                               status_of(answer), answer.failure});
  }
  return table;
}

namespace {

void add_interval(Series& series, double x, double y, const math::Estimate& along_x) {
  series.x.push_back(x);
  series.y.push_back(y);
  series.lower.push_back(along_x.lower);
  series.upper.push_back(along_x.upper);
}

}  // namespace

// Inputs below each other, the first at the top: first order above total order.
Plot sensitivity_plot(const SensitivityResult& result, const OutputSensitivity& output) {
  constexpr double apart = 0.13;
  const auto shown = shown_inputs(result.study.study);
  const std::size_t inputs = shown.size();
  const study::Study& study = result.study.study;
  Plot plot;
  plot.title = fmt::format("Sensitivity of {}{}, N = {}", shown_output(output.output).phrase,
                           at_gap(study, output.output), sensitivity_settings(study).samples);
  plot.x.label = "share of the variance";
  Series first{"S1: by the input alone", {}, {}, Style::horizontal_bars};
  Series total{"ST: with its interactions", {}, {}, Style::horizontal_bars};
  for (std::size_t i = 0; i < inputs; ++i) {
    const double y = static_cast<double>(inputs - i);
    const math::InputIndices& indices = output.sobol.inputs[i];
    const bool contradictory = total_below_first(indices);
    if (contradictory)
      plot.subtitle = "* ST below S1 is sampling error: no true total order is below the first order";
    plot.y.tics.push_back({y, shown[i].name + (contradictory ? " *" : "")});
    add_interval(first, indices.first.value, y + apart, indices.first);
    add_interval(total, indices.total.value, y - apart, indices.total);
  }
  plot.y.minimum = 0.4;
  plot.y.maximum = static_cast<double>(inputs) + 0.6;
  plot.vertical_lines = {{0.0, ""}, {1.0, ""}};
  plot.series = {std::move(first), std::move(total)};
  plot.height = std::min(180 + 56 * static_cast<int>(inputs), 1600);
  return plot;
}

}  // namespace launchsafe::kinds
