// T max against gap, of a critical-gap study in detail.
#include "critical_gap_tables.hpp"
#include "launchsafe/study/gap_analysis.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>

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

/// What did not ignite, of one verdict or of all, with its uncertainty: the model form, whose sign is known,
/// counts upwards alone.
Series inert_series(const CaseOutcome& outcome, const std::string& label,
                    std::optional<study::Verdict> verdict = {}) {
  Series series{label, {}, {}, Style::vertical_bars};
  if (!outcome.completed()) return series;  // temperatures of a part of the launch
  for (const study::GapVerdict& row : outcome.verdicts) {
    const double temperature = row.maximum.temperature;
    if (row.ignition || !std::isfinite(temperature)) continue;
    if (verdict && row.judgement.verdict != *verdict) continue;
    const study::Uncertainty& uncertainty = row.uncertainty;
    // Of one that ignites at an end of the range nothing is known but that.
    const double below = uncertainty.total() - uncertainty.model_form;
    series.add(shown_gap(row.gap), temperature, std::isfinite(below) ? temperature - below : temperature,
               temperature + uncertainty.total());
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

void add_fit(const CaseOutcome& outcome, const std::string& label, int colour, Plot& plot) {
  if (!outcome.fit) return;
  Series& line = plot.series.emplace_back(Series{label, {}, {}, Style::line});
  line.colour = colour;
  const study::Line& fitted = outcome.fit->ordinary;
  for (const double gap : outcome.fit->gaps)
    line.add(shown_gap(gap), fitted.intercept + fitted.slope * shown_gap(gap));
}

/// The only case, in a colour for each verdict.
void add_only_case(const CaseOutcome& outcome, Plot& plot) {
  constexpr int grey = 7, green = 2, orange = 4, vermilion = 1;
  add_fit(outcome, "least squares", grey, plot);
  const auto add = [&plot](Series series, int colour, Mark mark) {
    series.colour = colour;
    series.mark = mark;
    if (!series.x.empty()) plot.series.push_back(std::move(series));
  };
  for (const auto& [verdict, colour] :
       {std::pair{study::Verdict::safe, green}, {study::Verdict::indeterminate, orange}})
    add(inert_series(outcome, study::to_string(verdict), verdict), colour, Mark::circle);
  add(ignited_series(outcome), vermilion, Mark::cross);
}

/// One of several, in a colour of its own.
void add_case(const CaseOutcome& outcome, std::size_t index, Plot& plot) {
  add_fit(outcome, "", static_cast<int>(index), plot);
  Series inert = inert_series(outcome, outcome.input.label), ignited = ignited_series(outcome);
  give_look(index, inert);
  ignited.colour = static_cast<int>(index);
  ignited.mark = Mark::cross;
  if (inert.x.empty()) ignited.label = outcome.input.label + ": ignites";
  for (Series* each : {&inert, &ignited})
    if (!each->x.empty()) plot.series.push_back(std::move(*each));
}

/// The axis ends above the ignition temperature: how hot a burning skin is says nothing of the gap. What is
/// hotter stands at that end.
void cut_above(double ignition, Plot& plot) {
  double lowest = ignition;
  for (const Series& series : plot.series)
    for (const double temperature : series.y) lowest = std::min(lowest, temperature);
  const double top = ignition + std::max(0.25 * (ignition - lowest), 20.0);
  for (Series& series : plot.series) {
    for (double& temperature : series.y) temperature = std::min(temperature, top);
    std::ranges::replace(series.upper, std::numeric_limits<double>::infinity(), top);
  }
  plot.y.maximum = top;
}

/// What the picture shows of the only case, with its numbers.
std::string finding_of(const CaseOutcome& outcome) {
  const double safe = study::largest_safe_gap(outcome.verdicts);
  return fmt::format("Critical gap {}; {}", report::reads_as(outcome.critical),
                     std::isfinite(safe) ? "of the computed gaps SAFE up to " + report::centimetres(safe)
                                         : "none of the computed gaps is SAFE");
}

/// Where no case has the launch that was published there is nothing to compare; under constants that miss the
/// calibrated rows none counts as calibrated.
void add_published(const CriticalGapResult& result, Plot& plot) {
  const auto own =
      std::ranges::find_if(result.details, [](const CaseOutcome& each) { return each.input.own_conditions; });
  if (own == result.details.end()) return;
  const bool foreign = misses_calibrated_rows(*own);
  std::map<std::string, Series> by_label{
      {"published", {.mark = Mark::open_square}},
      {"published, " + to_string(Use::chosen_by), {.mark = Mark::open_triangle}},
      {"published, " + to_string(Use::fitted), {.mark = Mark::open_square}},
      {"published, " + to_string(Use::held_out), {.mark = Mark::open_circle}}};
  for (const study::Reference& reference : result.study.study.references) {
    if (!std::isfinite(reference.maximum_temperature)) continue;
    by_label.at(foreign ? "published" : "published, " + report::used_for(reference))
        .add(shown_gap(reference.gap), reference.maximum_temperature);
  }
  for (auto& [label, series] : by_label) {
    series.label = label;
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
  const bool only = result.details.size() == 1;
  Plot plot;
  plot.title = only ? finding_of(result.details.front()) : "Highest temperature of the charge's bottom";
  plot.x.label = quantity::gap.label();
  plot.y.label = quantity::temperature_max.label();
  // The legend stands below and takes two cases a line.
  plot.height = 600 + 14 * static_cast<int>(result.details.size());
  for (std::size_t i = 0; i < result.details.size(); ++i)
    only ? add_only_case(result.details[i], plot) : add_case(result.details[i], i, plot);
  // One entry of the legend for the ignitions of all cases.
  const auto first = std::ranges::find_if(
      plot.series, [](const Series& series) { return series.mark == Mark::cross && series.label.empty(); });
  if (first != plot.series.end()) first->label = "ignites; the burning skin is hotter than shown";
  add_published(result, plot);
  if (only) add_critical_gap(result.details.front(), plot);
  const double ignition = result.study.scene.scene.charge().kinetics.ignition_temperature;
  cut_above(ignition, plot);
  plot.horizontal_lines.push_back(
      {ignition, "ignition temperature: " + report::in_words(ignition, keys::significant(4, keys::kelvin))});
  return plot;
}

}  // namespace launchsafe::kinds
