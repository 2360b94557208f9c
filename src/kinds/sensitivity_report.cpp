// The answer, the page and the files of a sensitivity study.
#include "answer_tables.hpp"
#include "launchsafe/kinds/sensitivity.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/shown_key.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "sensitivity_samples.hpp"
#include "sensitivity_text.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace launchsafe::kinds {

using namespace study;
using namespace report;

namespace {

std::string text_of(math::Design design) {
  constexpr std::array names{"independent random points", "a Latin hypercube", "a scrambled Sobol sequence"};
  return names.at(static_cast<std::size_t>(design));
}

std::string correlated_text(const SensitivitySettings& own) {
  if (!own.correlated) return {};
  return " The constants of the calibration vary together, by the covariance of their logarithms in its "
         "record, and are one input.";
}

std::string interval_text(const SensitivitySettings& own) {
  return fmt::format("{}% intervals from a bootstrap of {} resamples, seed {}",
                     digits_of(own.confidence, keys::significant(6, percent)), own.resamples, own.seed);
}

}  // namespace

const ShownOutput& shown_output(SensitivityOutput output) {
  static const std::array<ShownOutput, 3> all{
      {{{"temperature_max", "T max", keys::significant(6, kelvin), quantity::temperature_max().meaning},
        "T max"},
       {quantity::critical_gap(), "the critical gap"},
       {{"margin", "margin", keys::significant(6, kelvin), "Ignition temperature less T max."},
        "the margin"}}};
  return all.at(static_cast<std::size_t>(output));
}

std::vector<ShownInput> shown_inputs(const study::Study& study) {
  const auto keys = shown_axes(study);
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
  return " at a gap of " + centimetres(study.gaps.front());
}

std::string estimate_text(const math::Estimate& estimate) {
  return fmt::format("{} [{}, {}]", significant(estimate.value, 3), significant(estimate.lower, 3),
                     significant(estimate.upper, 3));
}

std::string method_text(const SensitivityResult& result) {
  const SensitivitySettings& own = sensitivity_settings(result.study.study);
  if (own.method == SensitivityMethod::polynomial_chaos)
    return fmt::format(
        "Sobol indices of a polynomial chaos (Blatman & Sudret 2011) fitted to {} launches on {} and held "
        "against "
        "{} others; {}, widened by what it does not explain.{}",
        own.samples, text_of(own.design), own.held_out, interval_text(own), correlated_text(own));
  std::string text = fmt::format(
      "Sobol indices (first order: Saltelli 2010, total order: Jansen 1999) from N = {} rows, {} "
      "evaluations, on {}; {}.",
      own.samples, result.answers.size(), text_of(own.design), interval_text(own));
  if (own.design == math::Design::scrambled_sobol && own.samples < 256)
    text += " Of a Sobol sequence with fewer than 256 rows the intervals often miss weak inputs.";
  return text + correlated_text(own);
}

namespace {

/// Below this share of the variance with all interactions an input does not matter.
constexpr double negligible_share = 0.05;
/// Evaluations on the page; the file has all.
constexpr std::size_t most_evaluation_rows = 200;

std::string joined(const std::vector<std::string>& names) {
  if (names.size() < 2) return names.empty() ? std::string{} : names.front();
  const std::vector<std::string> first(names.begin(), names.end() - 1);
  return fmt::format("{} and {}", fmt::join(first, ", "), names.back());
}

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
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return value(a) > value(b); });
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

/// What is said of one output.
class OutputAnswer {
 public:
  OutputAnswer(const SensitivityResult& result, const OutputSensitivity& output)
      : result_(result), output_(output), inputs_(shown_inputs(result.study.study)) {}

  std::string text() const {
    std::string what = shown_output(output_.output).phrase;
    if (what.starts_with('t')) what.front() = 'T';
    if (!output_.reason.empty()) return fmt::format("{}: no indices, {}.", what, output_.reason);
    const Groups groups = ranked(output_.sobol.inputs);
    return fmt::format("{}: by total order, {}.{}{}", what, ranking(groups), untold(groups), negligible());
  }

 private:
  /// "A (0.6 [0.5, 0.7]), then B (...) and C (...)".
  std::string ranking(const Groups& groups) const {
    std::string text;
    for (const auto& group : groups) {
      std::vector<std::string> names;
      for (const std::size_t input : group) names.push_back(named(input));
      text += (text.empty() ? "" : ", then ") + joined(names);
    }
    return text;
  }

  std::string named(std::size_t input) const {
    return fmt::format("{} ({})", inputs_[input].name, estimate_text(output_.sobol.inputs[input].total));
  }

  std::string size() const {
    return fmt::format("N = {} rows", sensitivity_settings(result_.study.study).samples);
  }

  /// What the intervals do not tell apart.
  std::string untold(const Groups& groups) const {
    if (groups.size() == 1 && inputs_.size() > 1) {
      return fmt::format(" {} are too few to tell which matters more: the intervals overlap.", size());
    }
    std::vector<std::string> open;
    for (const auto& group : groups) {
      if (group.size() < 2) continue;
      std::vector<std::string> names;
      for (const std::size_t input : group) names.push_back(inputs_[input].name);
      open.push_back(joined(names));
    }
    if (open.empty()) return {};
    return fmt::format(" {} do not tell {} apart.", size(), fmt::join(open, ", nor "));
  }

  /// Inputs whose whole interval is small.
  std::string negligible() const {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < inputs_.size(); ++i) {
      if (output_.sobol.inputs[i].total.upper < negligible_share) names.push_back(inputs_[i].name);
    }
    if (names.empty()) return {};
    return fmt::format(" Below {}% of the variance, and so without influence here: {}.",
                       digits_of(negligible_share, keys::significant(6, percent)), joined(names));
  }

  const SensitivityResult& result_;
  const OutputSensitivity& output_;
  std::vector<ShownInput> inputs_;
};

std::string share_failed(const SensitivityResult& result) {
  const std::size_t all = result.answers.size(), failed = counts_of(result.answers).failed;
  if (failed == 0) return fmt::format("All {} evaluations completed.", all);
  return fmt::format(
      "Failed: {} of {} evaluations ({}%): {}.", failed, all,
      digits_of(static_cast<double>(failed) / static_cast<double>(all), keys::fixed(1, percent)),
      failures_list({}, result.study, result.answers));
}

bool has_fit(const SensitivityResult& result) {
  return sensitivity_settings(result.study.study).method == SensitivityMethod::polynomial_chaos;
}

std::string picture_name(const OutputSensitivity& output) {
  return "sensitivity_" + shown_output(output.output).column.name + ".svg";
}

nlohmann::ordered_json method_json(const SensitivityResult& result) {
  const auto& settings = sensitivity_settings(result.study.study);
  return {{"name", settings.method == SensitivityMethod::sobol ? "sobol" : "polynomial-chaos"},
          {"text", method_text(result)},
          {"N", settings.samples},
          {"evaluations", result.answers.size()},
          {"seed", settings.seed},
          {"resamples", settings.resamples},
          {"confidence", settings.confidence}};
}

}  // namespace

std::string answer(const SensitivityResult& result) {
  std::vector<std::string> lines;
  for (const OutputSensitivity& output : result.outputs) lines.push_back(OutputAnswer(result, output).text());
  if (result.outputs.empty()) lines.emplace_back("There are no indices: the study did not come to its end.");
  lines.push_back(samples_text(result));
  lines.push_back(share_failed(result));
  lines.push_back(limited_text(counts_of(result.answers), "evaluation"));
  return answer_of(std::move(lines), result.study);
}

Report report_of(const SensitivityResult& result) {
  Report report{result.study.study.title, answer(result), remaking_command(result.study)};
  report.items.push_back(
      ReportTable{sensitivity_table(result), "sensitivity.csv", "indices", Shown::terminal});
  report.items.push_back(ReportTable{output_table(result), "", "outputs",
                                     has_fit(result) ? Shown::page_and_terminal : Shown::file});
  for (const OutputSensitivity& output : result.outputs) {
    report.items.push_back(ReportTable{.table = sensitivity_table(result, output), .shown = Shown::page});
    if (output.reason.empty())
      report.items.push_back(Picture{picture_name(output), sensitivity_plot(result, output),
                                     "sensitivity of " + shown_output(output.output).column.heading});
  }
  report.items.push_back(ReportTable{quantile_table(result), "quantiles.csv", "quantiles"});
  if (Plot plot = histogram_plot(result); !plot.panels.empty())
    report.items.push_back(
        Picture{"histogram.svg", std::move(plot), "histograms of critical gap and T max over the draws"});
  report.items.push_back(ReportTable{histogram_table(result), "histogram.csv", "histogram", Shown::file});
  report.items.push_back(Statement{"## What it rests on\n\n" + friction_remark(result.study)});
  report.items.push_back(Statement{
      "The indices are those of these distributions: another range of an input gives it another share. Bound "
      "critical gaps have no number, and where there are any no indices are given.\n"});
  report.items.push_back(Statement{"## Setup\n\n" + setup_text(result.study)});
  report.items.push_back(ReportTable{evaluation_table(result), "evaluations.csv", "evaluations", Shown::page,
                                     most_evaluation_rows});
  report.json = study_json(result.study, report,
                           {{"method", method_json(result)},
                            {"gap_cm", number(shown_gap(result.study.study.gaps.front()))},
                            {"inputs", axes_json(result.study.study)},
                            {"ignition", ignition_json(result)},
                            {"failed", counts_of(result.answers).failed},
                            {"notes", mesh_notes(result.study)}});
  return report;
}

}  // namespace launchsafe::kinds
