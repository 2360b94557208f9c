// The pictures of a sensitivity study.
#include "launchsafe/kinds/sensitivity_report.hpp"
#include "launchsafe/report/shown_key.hpp"
#include "launchsafe/report/study_text.hpp"
#include "sensitivity_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
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
    plot.y.tics.push_back({y, keys[i].name});
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

/// Up to where sigma is as large as mu*, the effects of an input change their size or sign.
Series diagonal(double largest) {
  Series line{"sigma = mu*", {0, largest}, {0, largest}, Style::dashed_line};
  line.colour = 7;
  return line;
}

Plot effect_plot(const SensitivityResult& result, const OutputSensitivity& output) {
  const ShownOutput shown = shown_output(output.output);
  const auto keys = shown_axes(result.study.study);
  Plot plot;
  plot.x.label = fmt::format("mu*, mean size of the effect [{}]", shown.unit);
  plot.y.label = fmt::format("sigma, its standard deviation [{}]", shown.unit);
  plot.height = 680;
  double largest = 0;
  for (std::size_t i = 0; i < std::min(keys.size(), output.morris.size()); ++i) {
    const math::MorrisEffects& effects = output.morris[i];
    math::Estimate mu_star = effects.mu_star;
    for (double* part : {&mu_star.value, &mu_star.lower, &mu_star.upper}) *part *= shown.scale;
    Series series{keys[i].name, {}, {}, Style::horizontal_bars};
    series.colour = static_cast<int>(i);
    // The mark moves on with every round of colours, so that no two inputs look alike.
    series.mark = static_cast<Mark>((i + i / 8) % 8);
    add_interval(series, mu_star.value, shown.scale * effects.sigma, mu_star);
    if (std::isfinite(effects.sigma)) largest = std::max(largest, shown.scale * effects.sigma);
    plot.series.push_back(std::move(series));
  }
  if (largest > 0) plot.series.push_back(diagonal(largest));
  return plot;
}

}  // namespace

Plot sensitivity_plot(const SensitivityResult& result, const OutputSensitivity& output) {
  const study::Study& study = result.study.study;
  const bool sobol = settings_of<SensitivitySettings>(study).method == SensitivityMethod::sobol;
  Plot plot = sobol ? index_plot(result, output) : effect_plot(result, output);
  plot.title = fmt::format("Sensitivity of {}{}, N = {}", shown_output(output.output).phrase,
                           at_gap(study, output.output), size_of(study));
  return plot;
}

}  // namespace launchsafe::kinds
