// What a critical-gap study tells of gaps that close, beside the reservoir.
#include "critical_gap_tables.hpp"

namespace launchsafe::kinds {

using study::ClosingAnswer, study::ClosingPoint;

namespace {

/// A gap of a case, under the reservoir and where it closes.
struct ClosingRow {
  const CaseOutcome* outcome;
  double gap;

  const GapVerdict* verdict() const {
    const auto found = std::ranges::find(outcome->verdicts, gap, &GapVerdict::gap);
    return found == outcome->verdicts.end() ? nullptr : &*found;
  }
  /// On a bound by its name; nullptr where it was not computed.
  const ClosingPoint* point(std::string_view bound) const {
    const ClosingAnswer* answer = keys::find_named(outcome->closing, bound);
    return answer == nullptr ? nullptr : answer->at(gap);
  }
};

auto on(const char* bound) {
  return [bound](const ClosingRow& row) { return row.point(bound); };
}

/// K, by which T max is higher on one bound than on another; NaN where either ignites.
auto hotter_on(const char* bound, const char* than) {
  return [=](const ClosingRow& row) {
    const ClosingPoint *hotter = row.point(bound), *cooler = row.point(than);
    const bool known = hotter != nullptr && cooler != nullptr && !hotter->ignited && !cooler->ignited;
    return known ? hotter->maximum_temperature - cooler->maximum_temperature : not_a_number;
  };
}

/// K, by which its computation may have that wrong; NaN where it ignites.
double uncertainty_of(const ClosingPoint& point) {
  return point.ignited ? not_a_number : point.at_most - point.maximum_temperature;
}

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

Column kelvins(const char* name, const char* label, const char* meaning) {
  return {name, label, fixed(1, kelvin), meaning};
}

const Quantities<ClosingRow> closing_quantities{
    {quantity::case_name, &ClosingRow::outcome, &CaseOutcome::input, &StudyCase::label},
    {quantity::gap, &ClosingRow::gap},
    {kelvins("temperature_max_reservoir", "T max, reservoir", "Highest temperature under the reservoir."),
     &ClosingRow::verdict, &GapVerdict::maximum, &study::Peak::temperature},
    {kelvins("temperature_max_conducting", "closing, base conducts",
             "Highest temperature at any depth where the gap closes and its base takes heat."),
     on("conducting"), &ClosingPoint::maximum_temperature},
    {kelvins("temperature_max_insulated", "base insulated",
             "Highest temperature at any depth where the gap closes and its base takes no heat."),
     on("insulated"), &ClosingPoint::maximum_temperature},
    {kelvins("temperature_max_corner", "worst corner",
             "Highest temperature at any depth on the worst terms: insulated, smoothest, worst flow and "
             "release."),
     on("corner"), &ClosingPoint::maximum_temperature},
    {"corner_place", "at", text(), "Station of that.", on("corner"), &ClosingPoint::place},
    {"corner_release", "release", fixed(2, millisecond), "Until when the charge is held there.", on("corner"),
     &ClosingPoint::release},
    {kelvins("corner_numerical", "of its computation",
             "By how much that may be off for mesh, steps and columns; assumed where no record says it."),
     on("corner"), uncertainty_of},
    {for_programs(Column{"corner_launches", "launches of the worst corner", count(),
                         "How many launches looked for it: up to the first that ignites."}),
     on("corner"), &ClosingPoint::launches},
    {for_programs(kelvins("conducting_numerical", "of computation, base conducts",
                          "The same where the base takes heat.")),
     on("conducting"), uncertainty_of},
    {for_programs(kelvins("insulated_numerical", "of computation, base insulated",
                          "The same where the base takes no heat.")),
     on("insulated"), uncertainty_of},
    {"remark", "remark", text(), "Why a temperature is not known.", why_unknown}};

/// What is not known of a gap that closes, with what each worst end adds where all before stand at theirs.
const Quantities<ClosingRow> closing_share_quantities{
    {quantity::case_name, &ClosingRow::outcome, &CaseOutcome::input, &StudyCase::label},
    {quantity::gap, &ClosingRow::gap},
    {kelvins("own_terms", "own terms, base conducts", "T max on the case's own terms."), on("conducting"),
     &ClosingPoint::maximum_temperature},
    {kelvins("of_base", "the base takes no heat", "What that adds."), hotter_on("insulated", "conducting")},
    {kelvins("of_roughness", "smoothest faces", "What faces of 1 um add to it."),
     hotter_on("smooth", "insulated")},
    {kelvins("of_air_flow", "worst flow", "What air that flows, or stays, adds to both."),
     hotter_on("flowing", "smooth")},
    {kelvins("of_release", "worst release", "What the worst instant of release adds to all of that."),
     hotter_on("corner", "flowing")},
    {kelvins("corner", "worst corner", "The sum: T max on the worst terms."), on("corner"),
     &ClosingPoint::maximum_temperature},
    {kelvins("of_melting", "were the charge to melt",
             "What melting would add with an insulated base; no verdict rests on it."),
     hotter_on("melting", "insulated")}};

struct BoundRow {
  std::string label;
  const ClosingAnswer* answer;
};

/// What a bound of an answer says, for people; empty without such bounds.
auto text_of_bound(std::size_t bound) {
  return [bound](const CaseAnswer& answer) -> std::string {
    if (bound >= answer.closing.size()) return {};
    const ClosingAnswer& found = answer.closing[bound];
    if (!std::isnan(found.upper)) return reads_as(critical_gap_of(found));
    return std::isnan(found.lower) ? "not known" : "> " + centimetres(found.lower) + ", then not known";
  };
}

const Quantities<BoundRow> closing_bound_quantities{
    {quantity::case_name, &BoundRow::label},
    {"bound", "where the gap closes", text(), "Terms on which it closes.", &BoundRow::answer, bound_name},
    {"no_ignition_up_to", "no ignition up to", significant(4, centimetre),
     "Largest gap below the first that ignites.", &BoundRow::answer, &ClosingAnswer::lower},
    {"ignition_from", "ignites at", significant(4, centimetre), "Smallest gap that ignites.",
     &BoundRow::answer, &ClosingAnswer::upper},
    {"launches", "gaps computed", significant(6), "Gaps that were computed.", &BoundRow::answer,
     [](const ClosingAnswer& answer) { return static_cast<double>(answer.points.size()); }}};

/// By which kinetics the cases of rows may ignite, and whether records say how far T max may be off.
Row closing_facts(const std::vector<ClosingRow>& rows) {
  Row facts{{"kinetics", Row::array()}, {"others", Row::array()}};
  const auto add = [&facts](const char* list, const std::string& name) {
    Row& names = facts[list];
    if (std::find(names.begin(), names.end(), Row(name)) == names.end()) names.push_back(name);
  };
  std::size_t known = 0, recorded = 0;
  for (const ClosingRow& row : rows) {
    const Scene& scene = row.outcome->input.scene.scene;
    const auto counting = study::kinetics_of(scene);
    for (const auto& each : counting) add("kinetics", each.name);
    for (const scene::Decomposition& each : scene::shipped_decompositions())
      if (std::ranges::find(counting, each.name, &materials::KineticsParameters::name) == counting.end())
        add("others", each.name);
    const ClosingPoint& corner = *row.point("corner");
    if (!std::isfinite(corner.at_most) || corner.ignited) continue;
    ++known;
    recorded += corner.recorded ? 1 : 0;
  }
  facts["recorded"] = recorded > 0 && recorded == known;
  return facts;
}

}  // namespace

Quantities<CaseAnswer> closing_gap_quantities() {
  return {{"closing_conducting", "closing, base conducts", text(),
           "Smallest gap that ignites where it closes and its base takes heat.", text_of_bound(0)},
          {"closing_insulated", "base insulated", text(),
           "Smallest gap that ignites where it closes and its base takes no heat.", text_of_bound(1)}};
}

std::vector<std::string> closing_answer(const CriticalGapResult& result) {
  Row facts{{"bounds", Row::array()}};
  for (std::size_t bound = 0; bound < 2; ++bound) {
    std::size_t ignite = 0, unknown = 0;
    double smallest = not_a_number;
    std::string name;
    for (const CaseAnswer& answer : result.answers) {
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
                                 {"smallest_cm", report::number(shown_gap(smallest))}});
  }
  facts["closes"] = !facts["bounds"].empty();
  return said("critical_gap.closing_answer", facts);
}

std::vector<ReportTable> closing_tables(const CriticalGapResult& result) {
  std::vector<ClosingRow> rows;
  for (const CaseOutcome& outcome : result.details) {
    if (outcome.closing.empty()) continue;
    for (const ClosingPoint& point : outcome.closing.front().points) {
      const ClosingRow row{&outcome, point.gap};
      if (row.point("corner") != nullptr) rows.push_back(row);
    }
  }
  if (rows.empty()) return {};
  Table temperatures =
      table_of("Where the gap closes", closing_quantities, rows, said("critical_gap.note.closing"));
  // A gap no wider than the faces are rough does not close: it is one launch on whatever terms.
  std::erase_if(rows, [](const ClosingRow& row) { return row.gap <= row.outcome->input.closing->roughness; });
  Table shares = table_of("What the worst end of each interval adds", closing_share_quantities, rows,
                          said("critical_gap.note.closing_shares", closing_facts(rows)));
  return {{std::move(temperatures), "closing.csv", "closing"},
          {std::move(shares), "closing_shares.csv", "closing_shares"}};
}

Table closing_bound_table(const CriticalGapResult& result) {
  std::vector<BoundRow> rows;
  for (std::size_t i = 0; i < result.answers.size(); ++i)
    for (const ClosingAnswer& answer : result.answers[i].closing)
      rows.push_back({result.study.cases.label(i), &answer});
  return table_of("Critical gap where the gap closes", closing_bound_quantities, rows);
}

std::optional<Plot> closing_plot(const CriticalGapResult& result) {
  if (result.details.size() != 1 || result.details.front().closing.empty()) return std::nullopt;
  const CaseOutcome& outcome = result.details.front();
  const double ignition = outcome.input.scene.scene.charge().kinetics.ignition_temperature;
  Plot plot{.title = {},
            .x = {.label = quantity::gap.label()},
            .y = {.label = quantity::temperature_max.label()},
            .width = 1000,
            .named_in_place = true};
  // What burns is as hot as its products, which says nothing of the gap: a line has a break there, and a mark
  // stands beyond the ignition temperature at the first gap that ignites.
  const auto add_ignition = [&](const std::string& label, double gap) {
    const int colour = static_cast<int>(plot.series.size()) - 1;
    if (std::isfinite(gap))
      plot.series.push_back(
          {label, {shown_gap(gap)}, {math::infinity}, Style::points, {}, {}, colour, Mark::cross});
  };
  double by_reservoir = 0.0, closing = 0.0;  // K, the hottest below ignition
  Series& reservoir = plot.series.emplace_back(Series{"reservoir, as published"});
  for (const GapVerdict& row : outcome.verdicts) {
    reservoir.add(shown_gap(row.gap), row.ignition ? not_a_number : row.maximum.temperature);
    by_reservoir = std::max(by_reservoir, reservoir.y.back());
  }
  add_ignition("reservoir: critical gap " + report::measured_text(outcome.critical),
               gap_or_bound(outcome.critical));
  std::string ignitions;
  for (const ClosingAnswer& answer : outcome.closing) {
    if (!answer.is_nominal() && !answer.is_worst_corner()) continue;
    Series& series = plot.series.emplace_back(Series{bound_name(answer)});
    for (const ClosingPoint& point : answer.points) {
      series.add(shown_gap(point.gap), point.ignited ? not_a_number : point.maximum_temperature);
      closing = std::max(closing, series.y.back());
    }
    if (!std::isfinite(answer.upper)) continue;
    const std::string ignites = bound_name(answer) + " ignites from " + centimetres(answer.upper) + " on";
    ignitions += "; " + ignites;
    add_ignition(ignites, answer.upper);
  }
  plot.title = fmt::format("Below ignition T max is at most {} where the gap closes, {} by the reservoir{}",
                           in_words(closing, significant(3, kelvin)),
                           in_words(by_reservoir, significant(3, kelvin)), ignitions);
  report::cut_axis(ignition, plot);
  plot.horizontal_lines = {{ignition, "ignition at " + in_words(ignition, significant(4, kelvin))}};
  return plot;
}

std::vector<ReportTable> closing_results() {
  return {{table_of({}, closing_quantities, {}), "closing.csv", "closing"},
          {table_of({}, closing_share_quantities, {}), "closing_shares.csv", "closing_shares"},
          {table_of({}, closing_bound_quantities, {}), "closing_bounds.csv", "closing_bounds"}};
}

}  // namespace launchsafe::kinds
