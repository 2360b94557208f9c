// What a critical-gap study tells of gaps that close, beside the reservoir.
#include "answer_tables.hpp"
#include "critical_gap_tables.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/study/closing_gaps.hpp"

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using keys::fixed, keys::text;
using report::Table;
using study::CaseOutcome, study::ClosingAnswer, study::ClosingPoint, study::GapVerdict, study::not_a_number;
namespace quantity = report::quantity;

namespace {

/// A gap of a case, under the reservoir and where it closes.
struct ClosingRow {
  const CaseOutcome* outcome;
  double gap;

  const GapVerdict* verdict() const {
    const auto found = std::ranges::find(outcome->verdicts, gap, &GapVerdict::gap);
    return found == outcome->verdicts.end() ? nullptr : &*found;
  }
  const ClosingPoint* point(std::size_t bound) const { return outcome->closing[bound].at(gap); }
};

/// K, on a bound by its place in closing_bounds.
auto temperature_of(std::size_t bound) {
  return [bound](const ClosingRow& row) {
    const ClosingPoint* point = row.point(bound);
    return point != nullptr ? point->maximum_temperature : not_a_number;
  };
}

constexpr std::size_t nominal_bounds = 2, corner = 2;

std::string bound_name(const ClosingAnswer& answer) {
  return said("critical_gap.closing_bound", {{answer.name, true}}).front();
}

/// Why a temperature of a row is not known; empty where all are.
std::string why_unknown(const ClosingRow& row) {
  for (const ClosingAnswer& answer : row.outcome->closing)
    if (const ClosingPoint* point = answer.at(row.gap); point != nullptr && !point->unknown_for.empty())
      return bound_name(answer) + ": " + point->unknown_for;
  return {};
}

report::Quantities<ClosingRow> closing_quantities() {
  const auto heading = [](const char* name, const char* label, const char* meaning) {
    return report::Column{name, label, fixed(1, keys::kelvin), meaning};
  };
  return {
      {quantity::case_name(), &ClosingRow::outcome, &CaseOutcome::input, &study::StudyCase::label},
      {quantity::gap(), &ClosingRow::gap},
      {heading("temperature_max_reservoir", "T max, reservoir", "Highest temperature under the reservoir."),
       [](const ClosingRow& row) {
         return row.verdict() != nullptr ? row.verdict()->maximum.temperature : not_a_number;
       }},
      {heading("temperature_max_conducting", "closing, base conducts",
               "Highest temperature at any depth where the gap closes and its base takes heat."),
       temperature_of(0)},
      {heading("temperature_max_insulated", "base insulated",
               "Highest temperature at any depth where the gap closes and its base takes no heat."),
       temperature_of(1)},
      {heading("temperature_max_corner", "worst corner",
               "Highest temperature at any depth on the worst terms: insulated, smoothest, worst release."),
       temperature_of(corner)},
      {{"corner_place", "at", text(), "Station of that."},
       [](const ClosingRow& row) { return row.point(corner) ? row.point(corner)->place : std::string{}; }},
      {{"corner_release", "release", fixed(2, keys::millisecond), "Until when the charge is held there."},
       [](const ClosingRow& row) { return row.point(corner) ? row.point(corner)->release : not_a_number; }},
      {{"remark", "remark", text(), "Why a temperature is not known."}, why_unknown}};
}

/// What one bound says of the critical gap.
struct BoundRow {
  const std::string* label;
  const ClosingAnswer* answer;
};

/// What a bound of an answer says, for people; empty without such bounds.
auto text_of_bound(std::size_t bound) {
  return [bound](const study::CaseAnswer& answer) -> std::string {
    if (bound >= answer.closing.size()) return {};
    const ClosingAnswer& found = answer.closing[bound];
    if (!std::isnan(found.upper)) return report::reads_as(critical_gap_of(found));
    return std::isnan(found.lower) ? "not known"
                                   : "> " + report::centimetres(found.lower) + ", then not known";
  };
}

report::Quantities<BoundRow> closing_bound_quantities() {
  return {
      {quantity::case_name(), [](const BoundRow& row) { return *row.label; }},
      {{"bound", "where the gap closes", text(), "Terms on which it closes."},
       [](const BoundRow& row) { return bound_name(*row.answer); }},
      {{"no_ignition_up_to", "no ignition up to", keys::significant(4, keys::centimetre),
        "Largest gap below the first that ignites."},
       &BoundRow::answer,
       &ClosingAnswer::lower},
      {{"ignition_from", "ignites at", keys::significant(4, keys::centimetre), "Smallest gap that ignites."},
       &BoundRow::answer,
       &ClosingAnswer::upper},
      {{"launches", "gaps computed", keys::significant(6), "Gaps that were computed."},
       [](const BoundRow& row) { return static_cast<double>(row.answer->points.size()); }}};
}

}  // namespace

report::Quantities<study::CaseAnswer> closing_gap_quantities() {
  return {{{"closing_conducting", "closing, base conducts", text(),
            "Smallest gap that ignites where it closes and its base takes heat."},
           text_of_bound(0)},
          {{"closing_insulated", "base insulated", text(),
            "Smallest gap that ignites where it closes and its base takes no heat."},
           text_of_bound(1)}};
}

std::vector<std::string> closing_answer(const CriticalGapResult& result) {
  report::Row facts{{"bounds", report::Row::array()}};
  for (std::size_t bound = 0; bound < nominal_bounds; ++bound) {
    std::size_t ignite = 0, unknown = 0;
    double smallest = not_a_number;
    std::string name;
    for (const study::CaseAnswer& answer : result.answers) {
      if (answer.closing.empty()) continue;
      const ClosingAnswer& of_bound = answer.closing[bound];
      name = bound_name(of_bound);
      if (std::isnan(of_bound.upper)) ++unknown;
      if (!std::isfinite(of_bound.upper)) continue;
      ++ignite;
      if (!(smallest <= of_bound.upper)) smallest = of_bound.upper;
    }
    if (!name.empty())
      facts["bounds"].push_back({{"name", name},
                                 {"ignite", ignite},
                                 {"unknown", unknown},
                                 {"smallest_cm", report::number(report::shown_gap(smallest))}});
  }
  facts["closes"] = !facts["bounds"].empty();
  return said("critical_gap.closing_answer", facts);
}

Table closing_table(const CriticalGapResult& result) {
  std::vector<ClosingRow> rows;
  for (const CaseOutcome& outcome : result.details) {
    if (outcome.closing.empty()) continue;
    for (const ClosingPoint& point : outcome.closing.front().points)
      if (outcome.closing[corner].at(point.gap) != nullptr) rows.push_back({&outcome, point.gap});
  }
  Table table = report::table_of("Where the gap closes", closing_quantities(), rows);
  if (!rows.empty()) table.notes = said("critical_gap.note.closing");
  return table;
}

Table closing_bound_table(const CriticalGapResult& result) {
  std::vector<BoundRow> rows;
  for (std::size_t i = 0; i < result.answers.size(); ++i)
    for (const ClosingAnswer& answer : result.answers[i].closing)
      rows.push_back({&result.study.cases.label(i), &answer});
  return report::table_of("Critical gap where the gap closes", closing_bound_quantities(), rows);
}

std::optional<report::Plot> closing_plot(const CriticalGapResult& result) {
  if (result.details.size() != 1 || result.details.front().closing.empty()) return std::nullopt;
  const CaseOutcome& outcome = result.details.front();
  report::Plot plot;
  plot.title = "Critical gap by the reservoir: " + report::reads_as(outcome.critical);
  for (const ClosingAnswer& answer : outcome.closing)
    if (std::isfinite(answer.upper))
      plot.subtitle += (plot.subtitle.empty() ? "" : "; ") + bound_name(answer) + ": ignites at " +
                       report::centimetres(answer.upper);
  plot.named_in_place = true;
  plot.x.label = quantity::gap().label();
  plot.y.label = quantity::temperature_max().label();
  const double ignition = outcome.input.scene.scene.charge().kinetics.ignition_temperature;
  // What burns is as hot as its products: it is drawn on a line of its own, above the ignition temperature.
  const double burning = ignition + 20.0;
  report::Series reservoir{"reservoir, as published"};
  for (const GapVerdict& row : outcome.verdicts)
    reservoir.add(report::shown_gap(row.gap), row.ignition ? burning : row.maximum.temperature);
  plot.series.push_back(std::move(reservoir));
  for (const ClosingAnswer& answer : outcome.closing) {
    report::Series series{bound_name(answer)};
    for (const ClosingPoint& point : answer.points)
      if (point.ignited || std::isfinite(point.maximum_temperature))
        series.add(report::shown_gap(point.gap), point.ignited ? burning : point.maximum_temperature);
    plot.series.push_back(std::move(series));
  }
  const std::string at = report::in_words(ignition, keys::significant(4, keys::kelvin));
  plot.horizontal_lines.push_back({ignition, "ignition: " + at + "; what ignites is drawn above"});
  return plot;
}

std::vector<ResultTable> closing_results() {
  return {{"closing", "closing.csv", keys::described(closing_quantities())},
          {"closing_bounds", "closing_bounds.csv", keys::described(closing_bound_quantities())}};
}

}  // namespace launchsafe::kinds
