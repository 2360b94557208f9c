// The answer, the tables, the page and the files of a sensitivity study.
#include "launchsafe/kinds/sensitivity.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {

using math::Estimate;

namespace {

/// How an output is shown.
struct ShownOutput {
  Column column;
  std::string phrase;  ///< "T max", "the margin": within a sentence

  double value(double value_si) const { return shown_value(value_si, column.form); }
};

const ShownOutput& shown_output(SensitivityOutput output) {
  static const std::array<ShownOutput, 3> all{
      {{{"temperature_max", "T max", significant(6, kelvin), quantity::temperature_max.meaning}, "T max"},
       {quantity::critical_gap, "the critical gap"},
       {{"margin", "margin", significant(6, kelvin), "Ignition temperature less T max."}, "the margin"}}};
  return all.at(static_cast<std::size_t>(output));
}

/// An input as people read it.
struct ShownInput {
  std::string name;          ///< "peak pressure"
  std::string distribution;  ///< "uniform from 400 to 600 MPa"
};

std::vector<ShownInput> shown_inputs(const Study& study) {
  const auto keys = report::shown_axes(study);
  std::vector<ShownInput> inputs;
  for (const SensitivityInput& input : inputs_of(study)) {
    const auto text = [&](std::size_t axis) {
      return distribution_text(keys[axis], *study.axes[axis].distribution);
    };
    ShownInput& shown = inputs.emplace_back(ShownInput{keys[input.first].heading, text(input.first)});
    if (input.count == 1) continue;
    shown = {"constants of the calibration", "together"};
    for (std::size_t axis = input.first; axis < input.first + input.count; ++axis) {
      const bool first = axis == input.first;
      shown.distribution += fmt::format("{}{} {}", first ? ": " : "; ", keys[axis].heading, text(axis));
    }
  }
  return inputs;
}

/// "0.52 [0.4, 0.63]".
std::string estimate_text(const math::Estimate& estimate) {
  return fmt::format("{} [{}, {}]", report::significant(estimate.value, 3),
                     report::significant(estimate.lower, 3), report::significant(estimate.upper, 3));
}

Row method_facts(const SensitivityResult& result) {
  const auto& own = settings_of<SensitivitySettings>(result.study);
  const math::SobolOptions bootstrap;
  return {{"name", "polynomial-chaos"},        {"text", ""},       {"N", own.samples},
          {"evaluations", result.rows.size()}, {"seed", own.seed}, {"resamples", bootstrap.resamples},
          {"confidence", bootstrap.level}};
}

std::string method_text(const SensitivityResult& result) {
  const auto& own = settings_of<SensitivitySettings>(result.study);
  std::string text = fmt::format(
      "Sobol indices of a polynomial chaos (Blatman & Sudret 2011) that was fitted to {} launches, on a "
      "scrambled Sobol sequence; 95% intervals from a bootstrap of {} resamples, seed {}, widened by the "
      "share of the variance that the fit misses of launches left out of it.",
      own.samples, math::SobolOptions().resamples, own.seed);
  if (own.calibrated)
    text +=
        " The constants of the calibration vary together, by the covariance of their logarithms, and are one "
        "input.";
  return text;
}

/// Below this share of the variance with all interactions an input does not matter.
constexpr double negligible_share = 0.05;

using Groups = std::vector<std::vector<std::size_t>>;

/// Inputs by falling total order in groups, whose intervals lie above all of the following groups; within one
/// they overlap, and its order means nothing.
Groups ranked(const std::vector<math::InputIndices>& inputs) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  // What has no value goes last; where an interval is missing nothing can be told apart.
  const auto known = [](double number, double otherwise) {
    return std::isfinite(number) ? number : otherwise;
  };
  const auto lower = [&](std::size_t i) { return known(inputs[i].total.lower, -infinite); };
  const auto upper = [&](std::size_t i) { return known(inputs[i].total.upper, infinite); };
  const auto order = study::places_by(
      inputs.size(), [&](std::size_t i) { return -known(inputs[i].total.value, -infinite); });
  Groups groups;
  double lowest_before = infinite;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const double highest_behind = std::ranges::max(of_each(std::span(order).subspan(k), upper));
    if (k == 0 || lowest_before > highest_behind) groups.emplace_back();
    groups.back().push_back(order[k]);
    lowest_before = std::min(lowest_before, lower(order[k]));
  }
  return groups;
}

/// Names, the last behind "and".
std::string and_text(const std::vector<std::string>& names) {
  if (names.size() < 2) return fmt::format("{}", fmt::join(names, ""));
  return fmt::format("{} and {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

/// Inputs by their influence, what the intervals do not tell apart, and whose whole interval is small.
std::string output_text(const SensitivityResult& result, const OutputSensitivity& output) {
  std::string what = shown_output(output.output).phrase;
  if (what.starts_with('t')) what.front() = 'T';
  if (!output.reason.empty()) return fmt::format("{}: no indices, {}.", what, output.reason);
  const std::vector<ShownInput> inputs = shown_inputs(result.study.study);
  const auto name = [&](std::size_t input) { return inputs[input].name; };
  const auto named = [&](std::size_t input) {
    return fmt::format("{} ({})", name(input), estimate_text(output.sobol.inputs[input].total));
  };
  std::vector<std::string> ranking, open, negligible;
  for (const auto& group : ranked(output.sobol.inputs)) {
    ranking.push_back(and_text(of_each(group, named)));
    if (group.size() > 1) open.push_back(and_text(of_each(group, name)));
  }
  std::string text = fmt::format("{}: by total order, {}.", what, fmt::join(ranking, ", then "));
  if (!open.empty()) text += fmt::format(" The intervals do not tell {} apart.", fmt::join(open, ", nor "));
  for (std::size_t i = 0; i < output.sobol.inputs.size(); ++i)
    if (output.sobol.inputs[i].total.upper < negligible_share) negligible.push_back(name(i));
  if (!negligible.empty())
    text += fmt::format(" Below {} of the variance, and so without influence here: {}.",
                        in_words(negligible_share, significant(6, percent)), and_text(negligible));
  return text;
}

// --- tables ---

/// " at a gap of 0.02 cm", for outputs that belong to the study's gap.
std::string at_gap(const Study& study, SensitivityOutput output) {
  if (output == SensitivityOutput::critical_gap) return {};
  return study.gaps.empty() ? " at the gap of each sample"
                            : " at a gap of " + centimetres(study.gaps.front());
}

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
  return {{{name, heading, fixed(3), meaning}, &IndexRow::indices, index, &Estimate::value},
          {name + "_lower", "from", fixed(3), "Lower end of its interval.", &IndexRow::indices, index,
           &Estimate::lower},
          {name + "_upper", "to", fixed(3), "Upper end of its interval.", &IndexRow::indices, index,
           &Estimate::upper}};
}

Quantities<IndexRow> index_quantities() {
  return joined<IndexRow>({{{"input", "input", text(), "What varies.", &IndexRow::input, &ShownInput::name},
                            {quantity::distribution, &IndexRow::input, &ShownInput::distribution}},
                           interval_quantities("first_order", "first", &math::InputIndices::first,
                                               "Share of the variance by the input alone."),
                           interval_quantities("total_order", "total", &math::InputIndices::total,
                                               "Share of the variance with its interactions.")});
}

/// The same below each other for all outputs.
const Quantities<IndexRow> all_index_quantities = joined<IndexRow>(
    {{{quantity::output, [](const IndexRow& row) { return shown_output(row.output->output).column.name; }},
      {quantity::reason, &IndexRow::output, &OutputSensitivity::reason}},
     index_quantities()});

Quantities<OutputSensitivity> output_quantities() {
  const auto shown = [](double OutputSensitivity::*member) {
    return [member](const OutputSensitivity& row) { return shown_output(row.output).value(row.*member); };
  };
  return {
      {quantity::output, &OutputSensitivity::output, shown_output, &ShownOutput::column, &Column::name},
      {quantity::unit, &OutputSensitivity::output, shown_output, &ShownOutput::column, &Column::form,
       &Form::unit},
      {"mean", "mean", significant(4), "Mean over the evaluations that sample the inputs.",
       shown(&OutputSensitivity::mean)},
      {"standard_deviation", "standard deviation", significant(3), "Standard deviation over them.",
       shown(&OutputSensitivity::deviation)},
      {"missing", "without a number", count(), "Evaluations without a number.", &OutputSensitivity::missing},
      {"bounds", "bounds", count(), "Of these, critical gaps that are bounds.", &OutputSensitivity::bounds},
      {"fitted", "fitted", count(), "Evaluations that were fitted.", &OutputSensitivity::fit,
       &math::PolynomialChaos::points},
      {"terms", "terms", count(), "Terms of the polynomial.", &OutputSensitivity::fit,
       [](const math::PolynomialChaos& fit) { return fit.terms.size(); }},
      {"leave_one_out", "leave-one-out error", significant(2),
       "Root mean square of what the fit misses of evaluations left out of it.",
       [](const OutputSensitivity& row) {
         return row.fit ? shown_output(row.output).value(row.fit->leave_one_out) : not_a_number;
       }},
      {quantity::reason, &OutputSensitivity::reason}};
}

Quantities<PlacedCase> evaluation_quantities(const Study& study,
                                             const std::vector<OutputSensitivity>& outputs) {
  Quantities<PlacedCase> of_outputs;
  for (const OutputSensitivity& output : outputs)
    of_outputs.emplace_back(shown_output(output.output).column,
                            [&output](const PlacedCase& row) { return output.values[row.index]; });
  return joined<PlacedCase>(
      {{{"number", "number", count(), "Number of the evaluation.",
         [](const PlacedCase& row) { return row.index + 1; }},
        {"evaluation", "evaluation", text(), "Its place in the design.", &PlacedCase::label}},
       placed_axes(study),
       of_outputs,
       {{for_programs(quantity::critical_gap_kind), &PlacedCase::row, &CaseRow::critical, &CriticalGap::kind},
        {quantity::critical_gap_reads_as, [](const PlacedCase& row) { return reads_as(row.row->critical); }},
        {quantity::status, [](const PlacedCase& row) { return status_of(*row.row); }},
        {headed("failure", quantity::reason), &PlacedCase::row, &CaseRow::failure}}});
}

}  // namespace

std::string answer(const SensitivityResult& result) {
  std::vector<std::string> lines;
  for (const OutputSensitivity& output : result.outputs) lines.push_back(output_text(result, output));
  if (result.outputs.empty()) lines.emplace_back("There are no indices: the study did not come to its end.");
  const std::size_t all = result.rows.size(), failed = count_failed(result.rows);
  lines.push_back(failed == 0 ? fmt::format("All {} evaluations completed.", all)
                              : fmt::format("Failed: {} of {} evaluations: {}.", failed, all,
                                            failures_list({}, result.study, result.rows)));
  lines.push_back(limited_text(result.rows, "evaluation"));
  std::ranges::move(report::verdict_notes(result.study, {}), std::back_inserter(lines));
  return joined_lines(std::move(lines));
}

Report report_of(const SensitivityResult& result) {
  Report report{result.study.study.title, answer(result), report::remaking_command(result.study)};
  report.add({sensitivity_table(result), "sensitivity.csv", "indices", Shown::page_and_terminal});
  report.add({output_table(result), "", "outputs", Shown::page_and_terminal});
  for (const OutputSensitivity& output : result.outputs) {
    // That of T max is the margin's, where the ignition temperature is one more input.
    if (output.reason.empty() && output.output != SensitivityOutput::maximum_temperature)
      report.draw({"sensitivity_" + shown_output(output.output).column.name + ".svg",
                   sensitivity_plot(result, output),
                   "sensitivity of " + shown_output(output.output).column.heading});
  }
  report.say("## What it rests on\n\n" + report::friction_remark(result.study));
  report.say(
      "The indices hold for these distributions: another range of an input gives it another share. Where a "
      "critical gap is only a bound, no indices are given.\n");
  report.say("## Setup\n\n" + report::setup_text(result.study));
  report.add({evaluation_table(result), "evaluations.csv", "evaluations", Shown::file});
  Row method = method_facts(result);
  method["text"] = method_text(result);
  Row facts{
      {"method", method},
      {"gap_cm",
       result.study.study.gaps.empty() ? Row() : report::number(shown_gap(result.study.study.gaps.front()))},
      {"inputs", report::axes_json(result.study.study)},
      {"failed", count_failed(result.rows)}};
  report.json = study_json(result.study, report, facts);
  return report;
}

Table sensitivity_table(const SensitivityResult& result) {
  std::vector<IndexRow> rows;
  for (const OutputSensitivity& output : result.outputs)
    for (IndexRow& row : index_rows(result, output)) rows.push_back(std::move(row));
  std::vector<std::string> notes{method_text(result)};
  if (std::ranges::any_of(result.outputs, &OutputSensitivity::inert))
    notes.emplace_back(
        "Some evaluations ignite. T max and margin are therefore those of a skin that does not react, as the "
        "T max of a burning skin would jump; what matters to the reaction shows in the critical gap.");
  return table_of("Sensitivity", all_index_quantities, rows, notes);
}

// Inputs below each other, the one with the largest total order at the top.
Plot sensitivity_plot(const SensitivityResult& result, const OutputSensitivity& output) {
  constexpr int blue = 0, black = 6;
  const auto shown = shown_inputs(result.study.study);
  const auto order =
      study::places_by(shown.size(), [&](std::size_t i) { return -output.sobol.inputs[i].total.value; });
  Plot plot;
  const double largest = output.sobol.inputs[order.front()].total.value;
  plot.title =
      fmt::format("{} makes {} of the variance of {}", report::plain_words(shown[order.front()].name),
                  largest > 1.0 ? "all, within sampling error," : report::fixed(100.0 * largest, 0) + " %",
                  shown_output(output.output).phrase + at_gap(result.study.study, output.output));
  plot.title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(plot.title[0])));
  plot.x = {.label = "share of the variance [1]", .minimum = 0.0};
  Series bars{.style = Style::filled_bars, .colour = blue};
  Series intervals{
      .label = "95 % interval", .style = Style::horizontal_bars, .colour = black, .mark = Mark::none};
  for (std::size_t place = 0; place < order.size(); ++place) {
    const double y = static_cast<double>(order.size() - place);
    const Estimate& total = output.sobol.inputs[order[place]].total;
    plot.y.tics.push_back({y, report::plain_words(shown[order[place]].name)});
    bars.add(total.value, y, 0.0, total.value);
    intervals.add(total.value, y, total.lower, total.upper);
  }
  plot.y.minimum = 0.4;
  plot.y.maximum = static_cast<double>(order.size()) + 0.6;
  plot.series = {std::move(bars), std::move(intervals)};
  plot.height = std::min(180 + 56 * static_cast<int>(order.size()), 1600);
  return plot;
}

Table output_table(const SensitivityResult& result) {
  return table_of("Outputs", output_quantities(), result.outputs);
}

Table evaluation_table(const SensitivityResult& result) {
  return table_of("Evaluations", evaluation_quantities(result.study.study, result.outputs),
                  placed(result.study, result.rows));
}

std::vector<ReportTable> sensitivity_results() {
  std::vector<OutputSensitivity> outputs(3);
  outputs[0].output = SensitivityOutput::maximum_temperature;
  outputs[1].output = SensitivityOutput::critical_gap;
  outputs[2].output = SensitivityOutput::margin;
  return {{table_of({}, all_index_quantities, {}), "sensitivity.csv", "indices"},
          {table_of({}, output_quantities(), {}), "", "outputs"},
          {table_of({}, evaluation_quantities({}, outputs), {}), "evaluations.csv", "evaluations"}};
}

}  // namespace launchsafe::kinds
