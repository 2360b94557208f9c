// T max against gap, of a critical-gap study in detail.
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"
#include "launchsafe/study/gap_analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace launchsafe::kinds {

using report::Mark, report::Plot, report::Series, report::shown_gap, report::Style;
using study::CaseOutcome, study::Use;

namespace {

/// Colour and mark of a case. Open marks are larger: neighbours that lie on each other both show. The marks
/// move on with every round of colours, so that no two cases look alike.
void give_look(std::size_t index, Series& series) {
  constexpr std::array<Mark, 8> looks{Mark::circle,      Mark::open_square,  Mark::up_triangle,
                                      Mark::open_circle, Mark::diamond,      Mark::open_triangle,
                                      Mark::square,      Mark::down_triangle};
  series.colour = static_cast<int>(index);
  series.mark = looks[(index + index / looks.size()) % looks.size()];
}

/// What did not ignite, with its uncertainty: the model form, whose sign is known, counts upwards alone.
Series inert_series(const CaseOutcome& outcome, const std::string& label) {
  Series series{label, {}, {}, Style::vertical_bars};
  if (!outcome.completed()) return series;  // temperatures of a part of the launch
  for (const study::GapVerdict& row : outcome.verdicts) {
    const double temperature = row.maximum.temperature;
    if (row.ignition || !std::isfinite(temperature)) continue;
    const study::Uncertainty& uncertainty = row.uncertainty;
    series.x.push_back(shown_gap(row.gap));
    series.y.push_back(temperature);
    // Of one that ignites at an end of the range no more is known.
    const auto at_most = [&](double share) { return std::isfinite(share) ? share : row.margin; };
    series.lower.push_back(temperature - at_most(uncertainty.total() - uncertainty.model_form));
    series.upper.push_back(temperature + at_most(uncertainty.total()));
  }
  return series;
}

/// What ignited: the temperature is that of the burning skin, of which the uncertainty says nothing.
Series ignited_series(const CaseOutcome& outcome) {
  Series series{"", {}, {}, Style::points};
  for (const study::GapVerdict& row : outcome.verdicts) {
    if (!row.ignition || !std::isfinite(row.maximum.temperature)) continue;
    series.add(shown_gap(row.gap), row.maximum.temperature);
  }
  return series;
}

Series fitted_line(const study::GapFit& fit, const std::string& label) {
  Series line{label, {}, {}, Style::line};
  for (const double gap : fit.gaps) {
    line.add(shown_gap(gap), fit.ordinary.intercept + fit.ordinary.slope * shown_gap(gap));
  }
  return line;
}

void add_case(const CriticalGapResult& result, std::size_t index, Plot& plot) {
  const CaseOutcome& outcome = result.details[index];
  const bool only = result.details.size() == 1;
  if (outcome.fit) {
    Series line = fitted_line(*outcome.fit, only ? "least squares" : "");
    line.colour = only ? 7 : static_cast<int>(index);
    plot.series.push_back(std::move(line));
  }
  Series inert = inert_series(outcome, only ? "computed, with its uncertainty" : outcome.input.label);
  give_look(index, inert);
  Series ignited = ignited_series(outcome);
  if (inert.x.empty() && !only) ignited.label = outcome.input.label + ": ignites";
  if (!inert.x.empty()) plot.series.push_back(std::move(inert));
  give_look(index, ignited);
  ignited.mark = Mark::cross;
  if (!ignited.x.empty()) plot.series.push_back(std::move(ignited));
}

/// One entry of the legend for the ignitions of all cases.
void name_ignitions(Plot& plot) {
  const auto first = std::ranges::find_if(
      plot.series, [](const Series& series) { return series.mark == Mark::cross && series.label.empty(); });
  if (first != plot.series.end()) first->label = "ignites: of the burning skin";
}

/// Where no case has the launch that was published there is nothing to compare; under constants that miss the
/// calibrated rows none counts as calibrated.
void add_published(const CriticalGapResult& result, Plot& plot) {
  const auto own =
      std::ranges::find_if(result.details, [](const CaseOutcome& each) { return each.input.own_conditions; });
  if (own == result.details.end()) return;
  const bool foreign = misses_calibrated_rows(*own);
  Series published{.label = "published"};
  std::map<std::string, Series> by_use;
  for (const Use use : {Use::fitted, Use::chosen_by, Use::held_out})
    by_use[to_string(use)] = {.label = "published, " + to_string(use)};
  by_use.at(to_string(Use::held_out)).mark = Mark::open_circle;
  by_use.at(to_string(Use::chosen_by)).mark = Mark::open_triangle;
  by_use.at(to_string(Use::fitted)).mark = published.mark = Mark::open_square;
  for (const study::Reference& reference : result.study.study.references) {
    if (!std::isfinite(reference.maximum_temperature)) continue;
    Series& series = foreign ? published : by_use.at(report::used_for(reference));
    series.add(shown_gap(reference.gap), reference.maximum_temperature);
  }
  std::vector<Series> all{published};
  for (auto& [use, series] : by_use) all.push_back(std::move(series));
  for (Series& series : all) {
    series.style = Style::points;
    series.colour = 6;
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  }
}

/// The critical gap of the only case: a band where it has an uncertainty, words where it is no value.
void add_critical_gap(const CaseOutcome& outcome, Plot& plot) {
  const study::CriticalGap& gap = outcome.critical;
  if (gap.kind != study::CriticalGapKind::value) {
    plot.subtitle = "critical gap: " + report::reads_as(gap);
    return;
  }
  const double value = shown_gap(gap.value);
  const auto known = report::measured_gap(gap);
  const std::string label = "critical gap: " + report::measured_text(gap);
  plot.vertical_lines = {{value, known ? "" : label}};
  if (known) plot.vertical_bands = {{std::max(0.0, known->lower()), known->upper(), label}};
}

}  // namespace

Plot temperature_plot(const CriticalGapResult& result) {
  Plot plot;
  plot.title = "Highest temperature of the charge bottom";
  plot.x.label = report::quantity::gap().label();
  plot.y.label = report::quantity::temperature_max().label();
  // The legend stands below and takes two cases a line.
  plot.height = 600 + 14 * static_cast<int>(result.details.size());
  for (std::size_t i = 0; i < result.details.size(); ++i) add_case(result, i, plot);
  name_ignitions(plot);
  add_published(result, plot);
  if (result.details.size() == 1) add_critical_gap(result.details.front(), plot);
  const double ignition = result.study.scene.scene.charge().kinetics.ignition_temperature;
  plot.horizontal_lines.push_back(
      {ignition, "ignition temperature: " + report::in_words(ignition, keys::significant(4, keys::kelvin))});
  return plot;
}

}  // namespace launchsafe::kinds
