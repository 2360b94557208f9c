// The tables and the pictures of a sensitivity study.
#include "launchsafe/kinds/sensitivity.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/shown_key.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "sensitivity_text.hpp"
#include "sweep_text.hpp"

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

void add_estimate(const math::Estimate& estimate, std::vector<Cell>& cells) {
  for (const double value : {estimate.value, estimate.lower, estimate.upper})
    cells.push_back(optional_number(value));
}

void add_index_cells(const OutputSensitivity& output, std::size_t input, std::vector<Cell>& cells) {
  const math::SobolIndices& indices = output.sobol;
  add_estimate(indices.inputs[input].first, cells);
  add_estimate(indices.inputs[input].total, cells);
  cells.emplace_back(static_cast<std::int64_t>(indices.rows_used));
  cells.emplace_back(static_cast<std::int64_t>(indices.rows_used + indices.rows_left_out));
}

/// Input and distribution, and the numbers where there are any.
std::vector<Cell> cells_of(const SensitivityResult& result, const OutputSensitivity& output,
                           std::size_t input) {
  const study::Axis& each = result.study.study.axes[input];
  const ShownKey key = shown(each);
  std::vector<Cell> cells{key.name, distribution_text(key, *each.distribution)};
  if (has_indices(output) && input < output.sobol.inputs.size()) add_index_cells(output, input, cells);
  return cells;
}

std::string inert_note() {
  return "Some evaluations ignite. T max and margin are therefore those of a skin that air and friction heat "
         "and "
         "that does not react: the burning skin's T max would jump. What matters to the reaction shows in "
         "the "
         "critical gap.";
}

std::string missing_note(const OutputSensitivity& output) {
  return fmt::format("{} of {} evaluations have no number here{}.", output.missing, output.values.size(),
                     output.bounds > 0 ? fmt::format(", {} of them bounds", output.bounds) : std::string{});
}

std::string spread_note(const OutputSensitivity& output) {
  const ShownOutput shown = shown_output(output.output);
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
  const auto keys = shown_axes(result.study.study);
  std::string inputs;
  bool apart = false;
  for (std::size_t i = 0; i < std::min(keys.size(), output.sobol.inputs.size()); ++i) {
    const auto& [first, total] = output.sobol.inputs[i];
    if (!total_below_first(output.sobol.inputs[i])) continue;
    inputs +=
        fmt::format("{}{} (ST {} [{}, {}], S1 {} [{}, {}])", inputs.empty() ? "" : ", ", keys[i].name,
                    significant(total.value, 3), significant(total.lower, 3), significant(total.upper, 3),
                    significant(first.value, 3), significant(first.lower, 3), significant(first.upper, 3));
    apart = apart || total.upper < first.lower;
  }
  if (inputs.empty()) return {};
  return fmt::format(
      "ST below S1 is sampling error, as no true total order is below the first order: {}. {}", inputs,
      apart ? "Where their intervals do not overlap, these are too narrow." : "Their intervals overlap.");
}

std::vector<std::string> notes_of(const SensitivityResult& result, const OutputSensitivity& output) {
  std::vector<std::string> notes;
  if (const std::string reason = reason_of(output); !reason.empty())
    notes.push_back("No indices: " + reason + ".");
  if (std::isfinite(output.mean)) notes.push_back(spread_note(output));
  if (output.missing > 0) notes.push_back(missing_note(output));
  notes.push_back(method_text(result));
  if (has_indices(output)) notes.push_back(sampling_note(result, output));
  if (output.inert) notes.push_back(inert_note());
  std::erase(notes, "");
  return notes;
}

}  // namespace

Table sensitivity_table(const SensitivityResult& result, const OutputSensitivity& output) {
  const ShownOutput shown = shown_output(output.output);
  Table table;
  table.title = "Sensitivity of " + shown.phrase + at_gap(result.study.study, output.output);
  table.columns = {named_text("input", "input"), named_text("distribution", "distribution")};
  append(table.columns, index_columns());
  for (std::size_t i = 0; i < result.study.study.axes.size(); ++i)
    table.rows.push_back(cells_of(result, output, i));
  table.notes = notes_of(result, output);
  return table;
}

Table sensitivity_table(const SensitivityResult& result) {
  Table table;
  table.title = "Sensitivity";
  table.columns = {named_text("output", "output"), named_text("unit", "unit"), quantity::reason(),
                   named_text("input", "input"), named_text("distribution", "distribution")};
  append(table.columns, index_columns());
  for (const OutputSensitivity& output : result.outputs) {
    const ShownOutput shown = shown_output(output.output);
    for (std::size_t i = 0; i < result.study.study.axes.size(); ++i) {
      std::vector<Cell> cells{shown.key, std::string{}, reason_of(output)};
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
    const ShownOutput shown = shown_output(output.output);
    table.rows.push_back({shown.key, shown.unit, optional_number(shown.scale * output.mean),
                          optional_number(shown.scale * output.deviation),
                          static_cast<std::int64_t>(output.missing), static_cast<std::int64_t>(output.bounds),
                          reason_of(output)});
  }
  return table;
}

Table evaluation_table(const SensitivityResult& result) {
  const auto keys = shown_axes(result.study.study);
  Table table;
  table.title = "Evaluations";
  table.columns = {count_column("number", "number"), named_text("evaluation", "evaluation")};
  for (const ShownKey& key : keys) table.columns.push_back(key.column());
  for (const OutputSensitivity& output : result.outputs) {
    const ShownOutput shown = shown_output(output.output);
    table.columns.push_back(significant_column(shown.name, shown.unit, 6, shown.key + "_" + shown.unit));
  }
  append(table.columns,
         {for_programs(quantity::critical_gap_kind()), named_text("critical gap", "critical_gap_reads_as"),
          quantity::status(), named_text("failure", "reason")});
  for (std::size_t i = 0; i < std::min(result.study.cases.size(), result.answers.size()); ++i) {
    const study::StudyCase& input = result.study.cases[i];
    const study::CaseAnswer& answer = result.answers[i];
    std::vector<Cell> cells{static_cast<std::int64_t>(i + 1), input.label};
    for (std::size_t k = 0; k < keys.size(); ++k)
      cells.push_back(k < input.coordinates.size() ? Cell(keys[k].value(input.coordinates[k])) : Cell());
    for (const OutputSensitivity& output : result.outputs)
      cells.push_back(i < output.values.size()
                          ? optional_number(shown_output(output.output).scale * output.values[i])
                          : Cell());
    cells.emplace_back(study::to_string(answer.critical.kind));
    cells.emplace_back(reads_as(answer.critical));
    cells.emplace_back(status_of(answer));
    cells.emplace_back(answer.failure);
    table.rows.push_back(std::move(cells));
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

/// Inputs below each other, the first at the top: first order above total order.
Plot index_plot(const SensitivityResult& result, const OutputSensitivity& output) {
  constexpr double apart = 0.13;
  const auto keys = shown_axes(result.study.study);
  const std::size_t inputs = std::min(keys.size(), output.sobol.inputs.size());
  Plot plot;
  plot.x.label = "share of the variance";
  Series first{"S1: by the input alone", {}, {}, Style::horizontal_bars};
  Series total{"ST: with its interactions", {}, {}, Style::horizontal_bars};
  for (std::size_t i = 0; i < inputs; ++i) {
    const double y = static_cast<double>(inputs - i);
    const math::InputIndices& indices = output.sobol.inputs[i];
    const bool contradictory = total_below_first(indices);
    if (contradictory)
      plot.subtitle = "* ST below S1 is sampling error: no true total order is below the first order";
    plot.y.tics.push_back({y, keys[i].name + (contradictory ? " *" : "")});
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

}  // namespace

Plot sensitivity_plot(const SensitivityResult& result, const OutputSensitivity& output) {
  const study::Study& study = result.study.study;
  Plot plot = index_plot(result, output);
  plot.title = fmt::format("Sensitivity of {}{}, N = {}", shown_output(output.output).phrase,
                           at_gap(study, output.output), sensitivity_settings(study).samples);
  return plot;
}

}  // namespace launchsafe::kinds
