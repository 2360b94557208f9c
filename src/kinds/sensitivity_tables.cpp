// The tables and the pictures of a sensitivity study.
#include "answer_tables.hpp"
#include "launchsafe/kinds/shown_surrogate.hpp"
#include "sensitivity_parts.hpp"

#include <fmt/format.h>

#include <cctype>
#include <numeric>

namespace launchsafe::kinds {

using keys::count, keys::fixed, keys::significant, keys::text;
using report::Quantities, report::Series, report::Table, report::table_of;

namespace {

/// One input of one output.
struct IndexRow {
  const OutputSensitivity* output;
  ShownInput input;
  std::size_t place;  ///< among the inputs

  const math::InputIndices* indices() const {
    return output->reason.empty() ? &output->sobol.inputs[place] : nullptr;
  }
};

std::vector<IndexRow> index_rows(const SensitivityResult& result, const OutputSensitivity& output) {
  std::vector<IndexRow> rows;
  for (ShownInput& input : shown_inputs(result.study.study))
    rows.push_back({&output, std::move(input), rows.size()});
  return rows;
}

/// An index with the ends of its interval.
Quantities<IndexRow> interval_quantities(const std::string& name, const std::string& heading,
                                         math::Estimate math::InputIndices::*index, const char* meaning) {
  const auto of = [index](double math::Estimate::*member) {
    return [=](const IndexRow& row) {
      return row.indices() != nullptr ? std::optional(row.indices()->*index.*member) : std::nullopt;
    };
  };
  return {{{name, heading, fixed(3), meaning}, of(&math::Estimate::value)},
          {name + "_lower", "from", fixed(3), "Lower end of its interval.", of(&math::Estimate::lower)},
          {name + "_upper", "to", fixed(3), "Upper end of its interval.", of(&math::Estimate::upper)}};
}

Quantities<IndexRow> index_quantities() {
  const auto of_rows = [](auto count) {
    return [count](const IndexRow& row) {
      return row.indices() != nullptr ? std::optional(count(row.output->sobol)) : std::nullopt;
    };
  };
  return keys::joined<IndexRow>(
      {{{"input", "input", text(), "What varies.", &IndexRow::input, &ShownInput::name},
        {quantity::distribution, &IndexRow::input, &ShownInput::distribution}},
       interval_quantities("first_order", "first", &math::InputIndices::first,
                           "Share of the variance by the input alone."),
       interval_quantities("total_order", "total", &math::InputIndices::total,
                           "Share of the variance with its interactions."),
       {{"used", "rows used", count(), "Rows of the design that the indices rest on.",
         of_rows([](const math::SobolIndices& sobol) { return sobol.rows_used; })},
        {"of", "of", count(), "Rows of the design.",
         of_rows([](const math::SobolIndices& sobol) { return sobol.rows_used + sobol.rows_left_out; })}}});
}

/// The same below each other for all outputs.
const Quantities<IndexRow> all_index_quantities = keys::joined<IndexRow>(
    {{{quantity::output, [](const IndexRow& row) { return shown_output(row.output->output).column.name; }},
      {quantity::unit, [](const IndexRow&) { return ""; }},
      {quantity::reason, &IndexRow::output, &OutputSensitivity::reason}},
     index_quantities()});

using OutputRow = const OutputSensitivity*;

Quantities<OutputRow> output_quantities() {
  const auto shown = [](double OutputSensitivity::*member) {
    return [member](OutputRow row) { return shown_output(row->output).value(row->*member); };
  };
  return keys::joined<OutputRow>(
      {{{quantity::output, [](OutputRow row) { return shown_output(row->output).column.name; }},
        {quantity::unit, [](OutputRow row) { return shown_output(row->output).column.form.unit; }},
        {"mean", "mean", significant(4), "Mean over the evaluations that sample the inputs.",
         shown(&OutputSensitivity::mean)},
        {"standard_deviation", "standard deviation", significant(3), "Standard deviation over them.",
         shown(&OutputSensitivity::deviation)},
        {"missing", "without a number", count(), "Evaluations without a number.",
         &OutputSensitivity::missing},
        {"bounds", "bounds", count(), "Of these, critical gaps that are bounds.",
         &OutputSensitivity::bounds}},
       keys::of_part<OutputRow>(
           fit_quantities(),
           [](OutputRow row) {
             return FitRow{shown_output(row->output).column, row->fit ? &*row->fit : nullptr};
           }),
       {{quantity::reason, &OutputSensitivity::reason}}});
}

Quantities<AnsweredCase> evaluation_quantities(const study::Study& study,
                                               const std::vector<OutputSensitivity>& outputs) {
  Quantities<AnsweredCase> of_outputs;
  for (const OutputSensitivity& output : outputs)
    of_outputs.emplace_back(shown_output(output.output).column,
                            [&output](const AnsweredCase& row) { return output.values[row.index]; });
  return keys::joined<AnsweredCase>(
      {{{"number", "number", count(), "Number of the evaluation.",
         [](const AnsweredCase& row) { return row.index + 1; }},
        {"evaluation", "evaluation", text(), "Its place in the design.", &AnsweredCase::label}},
       answered_axes(study),
       of_outputs,
       {{for_programs(quantity::critical_gap_kind), &AnsweredCase::answer, &study::CaseAnswer::critical,
         &study::CriticalGap::kind},
        {quantity::critical_gap_reads_as,
         [](const AnsweredCase& row) { return report::reads_as(row.answer->critical); }},
        {quantity::status, [](const AnsweredCase& row) { return status_of(*row.answer); }},
        {headed("failure", quantity::reason), &AnsweredCase::answer, &study::CaseAnswer::failure}}});
}

/// Whether the estimates of an input contradict each other: no true total order is below the first.
bool total_below_first(const math::InputIndices& indices) {
  return indices.total.value < indices.first.value;
}

std::vector<std::string> notes_of(const SensitivityResult& result, const OutputSensitivity& output) {
  const ShownOutput& shown = shown_output(output.output);
  const std::string& unit = shown.column.form.unit;
  report::Row facts{
      {"reason", output.reason},
      {"mean", report::number(shown.value(output.mean))},
      {"deviation", shown.value(output.deviation)},
      {"unit", unit.empty() ? "" : " " + unit},
      {"missing", output.missing},
      {"evaluations", output.values.size()},
      {"bounds", output.bounds},
      {"method", method_text(result)},
      {"inert", output.inert},
      {"by_process", is_by_fit(result.study.study) && output.fit && output.fit->fit.by_process()},
      {"apart", false}};
  // Inputs that show sampling error by their estimates, with their intervals.
  const auto inputs = shown_inputs(result.study.study);
  for (std::size_t i = 0; i < output.sobol.inputs.size(); ++i) {
    const auto& [first, total] = output.sobol.inputs[i];
    if (!total_below_first(output.sobol.inputs[i])) continue;
    facts["contradictory"].push_back(
        fmt::format("{} (total {}, first {})", inputs[i].name, estimate_text(total), estimate_text(first)));
    if (total.upper < first.lower) facts["apart"] = true;
  }
  return said("sensitivity.note", facts);
}

}  // namespace

Table sensitivity_table(const SensitivityResult& result, const OutputSensitivity& output) {
  return table_of(
      "Sensitivity of " + shown_output(output.output).phrase + at_gap(result.study.study, output.output),
      index_quantities(), index_rows(result, output), notes_of(result, output));
}

Table sensitivity_table(const SensitivityResult& result) {
  std::vector<IndexRow> rows;
  for (const OutputSensitivity& output : result.outputs)
    for (IndexRow& row : index_rows(result, output)) rows.push_back(std::move(row));
  return table_of("Sensitivity", all_index_quantities, rows, {method_text(result)});
}

Table output_table(const SensitivityResult& result) {
  std::vector<OutputRow> rows;
  for (const OutputSensitivity& output : result.outputs) rows.push_back(&output);
  return table_of("Outputs", output_quantities(), rows);
}

Table evaluation_table(const SensitivityResult& result) {
  return table_of("Evaluations", evaluation_quantities(result.study.study, result.outputs),
                  answered(result.study, result.answers));
}

std::vector<report::ReportTable> sensitivity_results() {
  std::vector<OutputSensitivity> outputs(3);
  outputs[0].output = SensitivityOutput::maximum_temperature;
  outputs[1].output = SensitivityOutput::critical_gap;
  outputs[2].output = SensitivityOutput::margin;
  return {{table_of({}, all_index_quantities, {}), "sensitivity.csv", "indices"},
          {table_of({}, output_quantities(), {}), "", "outputs"},
          {quantile_table({}), "quantiles.csv", "quantiles"},
          {histogram_table({}), "histogram.csv", "histogram"},
          {table_of({}, evaluation_quantities({}, outputs), {}), "evaluations.csv", "evaluations"}};
}

// Inputs below each other, the one with the largest total order at the top.
report::Plot sensitivity_plot(const SensitivityResult& result, const OutputSensitivity& output) {
  constexpr int blue = 0, orange = 1, black = 6;
  const auto shown = shown_inputs(result.study.study);
  const study::Study& study = result.study.study;
  std::vector<std::size_t> order(shown.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater(),
                           [&](std::size_t i) { return output.sobol.inputs[i].total.value; });
  report::Plot plot;
  plot.title =
      fmt::format("{} makes {} % of the variance of {}", report::plain_words(shown[order.front()].name),
                  report::fixed(100.0 * output.sobol.inputs[order.front()].total.value, 0),
                  shown_output(output.output).phrase + at_gap(study, output.output));
  plot.title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(plot.title[0])));
  plot.subtitle = fmt::format("N = {}", settings_of<SensitivitySettings>(study).samples);
  plot.x = {.label = "share of the variance [1]", .minimum = 0.0};
  Series bars{.label = "total: with interactions", .style = report::Style::filled_bars, .colour = blue};
  Series total{.label = "its interval",
               .style = report::Style::horizontal_bars,
               .colour = black,
               .mark = report::Mark::square};
  Series first{.label = "first: by the input alone",
               .style = report::Style::horizontal_bars,
               .colour = orange,
               .mark = report::Mark::diamond};
  for (std::size_t place = 0; place < order.size(); ++place) {
    const double y = static_cast<double>(order.size() - place);
    const math::InputIndices& indices = output.sobol.inputs[order[place]];
    const bool contradictory = total_below_first(indices);
    if (contradictory)
      plot.subtitle +=
          "; * total below first is sampling error: no true total order is below the first order";
    plot.y.tics.push_back({y, report::plain_words(shown[order[place]].name) + (contradictory ? " *" : "")});
    bars.add(indices.total.value, y, 0.0, indices.total.value);
    total.add(indices.total.value, y - 0.1, indices.total.lower, indices.total.upper);
    first.add(indices.first.value, y + 0.1, indices.first.lower, indices.first.upper);
  }
  plot.y.minimum = 0.4;
  plot.y.maximum = static_cast<double>(order.size()) + 0.6;
  plot.series = {std::move(bars), std::move(total), std::move(first)};
  plot.height = std::min(180 + 56 * static_cast<int>(order.size()), 1600);
  return plot;
}

}  // namespace launchsafe::kinds
