// The answer, the page and the files of a sensitivity study.
#include "answer_tables.hpp"
#include "launchsafe/kinds/shown_surrogate.hpp"
#include "sensitivity_parts.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <numeric>

namespace launchsafe::kinds {

using keys::percent;
using report::ReportTable, report::Row, report::Shown, report::shown_value, report::significant,
    report::Statement;

namespace {

std::string text_of(math::Design design) {
  constexpr std::array names{"independent random points", "a Latin hypercube", "a scrambled Sobol sequence"};
  return names.at(static_cast<std::size_t>(design));
}

/// Launches besides those of the design of a fit.
std::size_t added_launches(const SensitivityResult& result) {
  const auto& own = settings_of<SensitivitySettings>(result.study.study);
  const std::size_t launches = own.method == SensitivityMethod::sobol ? 0 : result.answers.size();
  return launches - std::min(launches, static_cast<std::size_t>(own.samples + own.held_out));
}

/// How indices are found.
Row method_facts(const SensitivityResult& result) {
  const auto& own = settings_of<SensitivitySettings>(result.study.study);
  return {{"name", own.method == SensitivityMethod::sobol ? "sobol" : "polynomial-chaos"},
          {"text", ""},
          {"N", own.samples},
          {"evaluations", result.answers.size()},
          {"seed", own.seed},
          {"resamples", own.resamples},
          {"confidence", own.confidence}};
}

/// Below this share of the variance with all interactions an input does not matter.
constexpr double negligible_share = 0.05;

using Groups = std::vector<std::vector<std::size_t>>;

/// Inputs by falling total order in groups: all intervals of a group lie above all of the following groups;
/// within a group the intervals overlap, and its order means nothing.
Groups ranked(const std::vector<math::InputIndices>& inputs) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<std::size_t> order(inputs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // What has no value goes last; where an interval is missing nothing can be told apart.
  const auto value = [&](std::size_t i) {
    return std::isfinite(inputs[i].total.value) ? inputs[i].total.value : -infinite;
  };
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return value(a) > value(b); });
  const auto lower = [&](std::size_t i) {
    return std::isfinite(inputs[i].total.lower) ? inputs[i].total.lower : -infinite;
  };
  std::vector<double> highest_behind(order.size() + 1, -infinite);
  for (std::size_t k = order.size(); k-- > 0;) {
    const double upper = inputs[order[k]].total.upper;
    highest_behind[k] = std::max(highest_behind[k + 1], std::isfinite(upper) ? upper : infinite);
  }
  Groups groups;
  double lowest_before = infinite;
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k == 0 || lowest_before > highest_behind[k]) groups.emplace_back();
    groups.back().push_back(order[k]);
    lowest_before = std::min(lowest_before, lower(order[k]));
  }
  return groups;
}

/// What is said of one output: inputs by their influence, what the intervals do not tell apart, and inputs
/// whose whole interval is small.
std::string output_text(const SensitivityResult& result, const OutputSensitivity& output) {
  const std::vector<ShownInput> inputs = shown_inputs(result.study.study);
  Row facts{{"reason", output.reason},
            {"rows", settings_of<SensitivitySettings>(result.study.study).samples},
            {"negligible_percent", shown_value(negligible_share, keys::significant(6, percent))}};
  const Groups groups = output.reason.empty() ? ranked(output.sobol.inputs) : Groups{};
  for (const auto& group : groups) {
    Row names, named;
    for (const std::size_t input : group) {
      names.push_back(inputs[input].name);
      named.push_back(
          fmt::format("{} ({})", inputs[input].name, estimate_text(output.sobol.inputs[input].total)));
    }
    facts["groups"].push_back({{"named", named}, {"first", facts["groups"].empty()}});
    if (group.size() > 1) facts["open"].push_back({{"names", names}, {"first", facts["open"].empty()}});
  }
  facts["alone"] = groups.size() == 1 && inputs.size() > 1;
  for (std::size_t i = 0; i < output.sobol.inputs.size(); ++i)
    if (output.sobol.inputs[i].total.upper < negligible_share) facts["negligible"].push_back(inputs[i].name);
  std::string what = shown_output(output.output).phrase;
  if (what.starts_with('t')) what.front() = 'T';
  return what + ": " + said("sensitivity.answer", facts).front();
}

/// What became of the errors that are asked of the fit.
std::vector<std::string> asked_text(const SensitivityResult& result) {
  const auto& own = settings_of<SensitivitySettings>(result.study.study);
  std::vector<std::string> lines;
  for (const AskedError& error : asked_errors(result)) {
    const ShownOutput& shown = shown_output(error.output);
    const keys::Form form = keys::significant(3, {shown.column.form.dimension, shown.column.form.unit});
    const std::size_t fitted = static_cast<std::size_t>(own.samples) + added_launches(result);
    Row facts{
        {"output", shown.phrase},     {"asked", report::in_words(error.asked, form)},
        {"reached", error.reached()}, {"fitted", fitted},
        {"most", own.most_samples},   {"used_up", fitted >= static_cast<std::size_t>(own.most_samples)}};
    if (std::isfinite(error.found)) facts["found"] = report::in_words(error.found, form);
    lines.push_back(said("sensitivity.asked", facts).front());
  }
  return lines;
}

bool has_fit(const SensitivityResult& result) {
  return is_by_fit(result.study.study) || settings_of<SensitivitySettings>(result.study.study).surrogate;
}

}  // namespace

const ShownOutput& shown_output(SensitivityOutput output) {
  static const std::array<ShownOutput, 3> all{
      {{{"temperature_max", "T max", keys::significant(6, keys::kelvin), quantity::temperature_max.meaning},
        "T max"},
       {quantity::critical_gap, "the critical gap"},
       {{"margin", "margin", keys::significant(6, keys::kelvin), "Ignition temperature less T max."},
        "the margin"}}};
  return all.at(static_cast<std::size_t>(output));
}

std::vector<ShownInput> shown_inputs(const study::Study& study) {
  const auto keys = report::shown_axes(study);
  std::vector<ShownInput> inputs;
  for (const SensitivityInput& input : inputs_of(study)) {
    const auto text = [&](std::size_t axis) {
      return distribution_text(keys[axis], *study.axes[axis].distribution);
    };
    ShownInput& shown = inputs.emplace_back(ShownInput{keys[input.first].heading, text(input.first)});
    if (input.count == 1) continue;
    shown = {"constants of the calibration", "together"};
    for (std::size_t axis = input.first; axis < input.first + input.count; ++axis)
      shown.distribution +=
          fmt::format("{}{} {}", axis == input.first ? ": " : "; ", keys[axis].heading, text(axis));
  }
  return inputs;
}

std::string at_gap(const study::Study& study, SensitivityOutput output) {
  if (output == SensitivityOutput::critical_gap) return {};
  return " at a gap of " + report::centimetres(study.gaps.front());
}

std::string estimate_text(const math::Estimate& estimate) {
  return fmt::format("{} [{}, {}]", significant(estimate.value, 3), significant(estimate.lower, 3),
                     significant(estimate.upper, 3));
}

std::string method_text(const SensitivityResult& result) {
  const auto& own = settings_of<SensitivitySettings>(result.study.study);
  Row facts = method_facts(result);
  facts.update({{"is_fit", is_by_fit(result.study.study)},
                {"held_out", own.held_out},
                {"added", added_launches(result)},
                {"design", text_of(own.design)},
                {"confidence_percent", shown_value(own.confidence, keys::significant(6, percent))},
                {"few", own.design == math::Design::scrambled_sobol && own.samples < 256},
                {"correlated", own.correlated.has_value()}});
  return said("sensitivity.method", facts).front();
}

std::string answer(const SensitivityResult& result) {
  std::vector<std::string> lines;
  for (const OutputSensitivity& output : result.outputs) lines.push_back(output_text(result, output));
  if (result.outputs.empty()) lines.emplace_back("There are no indices: the study did not come to its end.");
  for (std::string& line : asked_text(result)) lines.push_back(std::move(line));
  lines.push_back(samples_text(result));
  const std::size_t all = result.answers.size(), failed = counts_of(result.answers).failed;
  const double share = static_cast<double>(failed) / static_cast<double>(all);
  for (std::string& line :
       said("sensitivity.failed", {{"all", all},
                                   {"failed", failed},
                                   {"percent", shown_value(share, keys::fixed(1, percent))},
                                   {"failures", failures_list({}, result.study, result.answers)}}))
    lines.push_back(std::move(line));
  lines.push_back(limited_text(counts_of(result.answers), "evaluation"));
  return answer_of(std::move(lines), result.study);
}

report::Report report_of(const SensitivityResult& result) {
  report::Report report{result.study.study.title, answer(result), report::remaking_command(result.study)};
  report.add({sensitivity_table(result), "sensitivity.csv", "indices", Shown::terminal});
  report.add({output_table(result), "", "outputs", has_fit(result) ? Shown::page_and_terminal : Shown::file});
  for (const OutputSensitivity& output : result.outputs) {
    report.add({.table = sensitivity_table(result, output), .shown = Shown::page});
    // That of T max is the margin's, where the ignition temperature is one more input.
    if (output.reason.empty() && output.output != SensitivityOutput::maximum_temperature)
      report.draw({"sensitivity_" + shown_output(output.output).column.name + ".svg",
                   sensitivity_plot(result, output),
                   "sensitivity of " + shown_output(output.output).column.heading});
  }
  report.add({quantile_table(result), "quantiles.csv", "quantiles"});
  if (report::Plot plot = histogram_plot(result); !plot.panels.empty())
    report.draw(
        {"histogram.svg", std::move(plot), "the draws, and how their interval settles with their number"});
  report.add({histogram_table(result), "histogram.csv", "histogram", Shown::file});
  report.say("## What it rests on\n\n" + report::friction_remark(result.study));
  report.say(said_below("sensitivity.rests"));
  report.say("## Setup\n\n" + report::setup_text(result.study));
  report.add({evaluation_table(result), "evaluations.csv", "evaluations", Shown::file});
  if (has_fit(result) && !result.outputs.empty())
    report.files = surrogate_files(surrogate_record(result), result.study);
  Row method = method_facts(result);
  method["text"] = method_text(result);
  report.json = study_json(result.study, report,
                           {{"method", method},
                            {"gap_cm", report::number(report::shown_gap(result.study.study.gaps.front()))},
                            {"inputs", report::axes_json(result.study.study)},
                            {"ignition", ignition_json(result)},
                            {"failed", counts_of(result.answers).failed},
                            {"notes", report::mesh_notes(result.study)}});
  return report;
}

}  // namespace launchsafe::kinds
