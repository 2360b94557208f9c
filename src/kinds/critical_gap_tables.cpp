// The tables of every critical-gap study.
#include "critical_gap_tables.hpp"

#include "launchsafe/report/case_tables.hpp"

namespace launchsafe::kinds {
namespace {

/// A case with its answer, and what a study in detail knows besides; null in others.
struct JudgedCase : AnsweredCase {
  const CaseOutcome* detail;
};

struct JudgedGap {
  AnsweredCase of;
  const GapVerdict* gap;
};

Quantities<JudgedGap> judged_gap_quantities(const StudyFile& study) {
  return joined<JudgedGap>(
      {{{quantity::gap, &JudgedGap::gap, &GapVerdict::gap}},
       of_part<JudgedGap>(report::launch_quantities(study), &JudgedGap::of, &AnsweredCase::coordinates),
       of_part<JudgedGap>(report::verdict_quantities(study.study), &JudgedGap::gap)});
}

/// T max at the smallest and the largest gap among those judged; at one of them where they are the same.
Quantities<AnsweredCase> outer_gap_quantities(const Study& study) {
  const std::vector<double>& gaps = study.gaps;
  if (gaps.empty()) return {};
  const auto at = [&](auto gap, const char* name) {
    const auto place = static_cast<std::size_t>(gap - gaps.begin());
    return report::Quantity<AnsweredCase>(
        name, "T max at " + centimetres(*gap), fixed(1, kelvin),
        "Highest temperature at that gap; of one that ignites the burning skin's.",
        [place](const AnsweredCase& row) {
          const auto& verdicts = row.answer->verdicts;
          return place < verdicts.size() ? verdicts[place].maximum.temperature : not_a_number;
        });
  };
  const auto [least, most] = std::ranges::minmax_element(gaps);
  Quantities<AnsweredCase> quantities{at(least, "temperature_max_smallest_gap")};
  if (*most > *least) quantities.push_back(for_programs(at(most, "temperature_max_largest_gap")));
  return quantities;
}

/// What a case is called, and where it lies: of few cases the name says it, of many the axes do.
Quantities<JudgedCase> place_quantities(const Study& study, bool in_detail) {
  Quantities<JudgedCase> place = of_part<JudgedCase>(answered_axes(study));
  if (!in_detail) {
    place.emplace_back(for_programs(quantity::case_name),
                       [keys = report::shown_axes(study)](const JudgedCase& row) {
                         return place_text(keys, row.coordinates());
                       });
    return place;
  }
  for (auto& each : place) each = for_programs(each);
  place.emplace(place.begin(), quantity::case_name, &AnsweredCase::label);
  return place;
}

/// How the run of a case went, which a study in detail has in a table of its own.
Quantities<AnsweredCase> run_quantities(const Study& study) {
  return joined<AnsweredCase>(
      {outer_gap_quantities(study),
       {{for_programs(quantity::status), [](const AnsweredCase& row) { return status_of(*row.answer); }},
        {for_programs(quantity::energy_drift), &AnsweredCase::answer, &CaseAnswer::run,
         &RunSummary::energy_drift},
        {for_programs(quantity::steps), &AnsweredCase::answer, &CaseAnswer::run, &RunSummary::steps},
        {for_programs(quantity::particles), &AnsweredCase::answer, &CaseAnswer::run, &RunSummary::particles},
        {for_programs(quantity::limiters),
         [](const AnsweredCase& row) { return report::limiters_text(row.answer->run.limiters); }}}});
}

/// "SAFE to 0.05, INDET. to 0.08, UNSAFE from 0.1": the largest gap (cm) of every row of equal verdicts, of
/// UNSAFE ones the smallest.
std::string verdict_ranges(const std::vector<GapVerdict>& verdicts) {
  std::map<double, Verdict> by_gap;
  for (const GapVerdict& each : verdicts) by_gap[each.gap] = each.judgement.verdict;
  std::vector<std::string> ranges;
  double begin = not_a_number;
  for (auto each = by_gap.begin(); each != by_gap.end(); ++each) {
    const auto [gap, verdict] = *each;
    if (std::isnan(begin)) begin = gap;
    if (const auto next = std::next(each); next != by_gap.end() && next->second == verdict) continue;
    const bool ignites = verdict == Verdict::unsafe;
    ranges.push_back(
        fmt::format("{} {} {}", verdict == Verdict::indeterminate ? "INDET." : to_string(verdict),
                    ignites ? "from" : "to", digits_of(ignites ? begin : gap, quantity::gap.form)));
    begin = not_a_number;
  }
  return fmt::format("{}", fmt::join(ranges, ", "));
}

const Column largest_safe_gap =
    for_programs(Column{"largest_safe_gap", "largest SAFE gap", significant(6, centimetre),
                        "Largest computed gap that, with all smaller ones, is SAFE."});

Quantities<JudgedCase> judged_case_quantities(const Study& study, bool in_detail) {
  Column assumed{"assumed_shares", "assumed", text(),
                 "What the bounds rest on and nothing says of the case."};
  Quantities<JudgedCase> confirmed{
      {for_programs(Column{"coupled_runs", "coupled runs", text(),
                           "What the coupled runs on both sides of the bracket did."}),
       [](const JudgedCase& row) { return confirmation_text(*row.detail); }}};
  return joined<JudgedCase>(
      {place_quantities(study, in_detail),
       of_part<JudgedCase>(report::bounded_gap_quantities(), &AnsweredCase::answer, &CaseAnswer::critical),
       {{largest_safe_gap, &AnsweredCase::answer, &CaseAnswer::verdicts, study::largest_safe_gap}},
       in_detail ? confirmed
                 : Quantities<JudgedCase>{{for_people(Column{"verdicts", "verdicts [cm]", text(),
                                                             "Up to which gap a verdict holds."}),
                                           &AnsweredCase::answer, &CaseAnswer::verdicts, verdict_ranges}},
       {{in_detail ? for_programs(assumed) : assumed,
         [study](const JudgedCase& row) {
           return assumed_shares(study, row.input(), row.answer->critical.value).text();
         }},
        {quantity::recorded_uncertainty,
         [](const JudgedCase& row) { return row.input().recorded_uncertainty(); }}},
       in_detail ? Quantities<JudgedCase>{} : of_part<JudgedCase>(run_quantities(study)),
       {{quantity::remark, &AnsweredCase::answer, gap_remark}}});
}

/// What the audit of the air says of the gap where most was taken; there may be millions of others.
std::string air_energy_note(const CriticalGapResult& result, const std::vector<ShownKey>& keys) {
  std::vector<report::AuditedGap> worst;
  for (std::size_t i = 0; i < result.answers.size(); ++i)
    for (const GapVerdict& row : result.answers[i].verdicts) {
      if (!std::isfinite(row.air.ratio())) continue;
      if (worst.empty() || row.air.ratio() > worst.front().air.ratio())
        worst = {{name_of(keys, result.study.cases[i]), row.gap, row.air}};
    }
  return report::air_energy_statement(worst);
}

/// What the published temperature at the early time was used for.
std::string early_used_for(const Reference& published) {
  using enum study::Use;
  if (!std::isfinite(published.early_temperature)) return {};
  return to_string(published.calibrated ? fitted : published.selection ? chosen_by : held_out);
}

/// Computed minus published (K) of a calibrated row; above it the scene's constants are of other settings.
constexpr double calibration_slack = 0.5;

/// A row that stands beside a published one.
using ComparedRow = const GapVerdict*;

Column published(Column computed) {
  return {computed.name + "_published", "published", computed.form, "What was published of it.",
          computed.audience};
}

Column published_place(Column computed) {
  return {computed.name + "_published_place", "published at", text(), "Where that was published to be."};
}

Column difference_of(Column computed) {
  return {computed.name + "_computed_minus_published", "computed - published", computed.form,
          "Computed minus published; none where either ignited."};
}

Quantities<ComparedRow> comparison_quantities(double early_time) {
  using namespace quantity;
  const Column early = temperature_early(early_time);
  return {{gap, &GapVerdict::gap},
          {used_for, &GapVerdict::reference, report::used_for},
          {temperature_max, [](ComparedRow row) { return row->until_exit.temperature; }},
          {published(temperature_max), &GapVerdict::reference, &Reference::maximum_temperature},
          {difference_of(temperature_max), &GapVerdict::misfit},
          {temperature_max_place, [](ComparedRow row) { return row->until_exit.point; }},
          {published_place(temperature_max), &GapVerdict::reference, &Reference::point},
          {"temperature_early_used_for", "used for at " + milliseconds(early_time), text(),
           "The same of the temperature at early_time.", &GapVerdict::reference, early_used_for},
          {early, [](ComparedRow row) { return row->early.temperature; }},
          {published(early), &GapVerdict::reference, &Reference::early_temperature},
          {difference_of(early), &GapVerdict::early_misfit},
          {temperature_early_place, [](ComparedRow row) { return row->early.point; }},
          {published_place(early), &GapVerdict::reference, &Reference::early_point},
          {ignition_time, [](ComparedRow row) { return row->ignition ? row->ignition->time : not_a_number; }},
          {published(ignition_time), &GapVerdict::reference, &Reference::ignition_time}};
}

}  // namespace

Table verdict_table(const CriticalGapResult& result) {
  std::vector<JudgedGap> rows;
  for (const AnsweredCase& each : answered(result.study, result.answers))
    for (const GapVerdict& row : each.answer->verdicts) rows.push_back({each, &row});
  Table table =
      table_of("Verdicts", judged_gap_quantities(result.study), rows, report::mesh_notes(result.study));
  table.notes.push_back(report::station_note(result.study));
  return table;
}

Table critical_gap_table(const CriticalGapResult& result) {
  const bool in_detail = !result.details.empty();
  const auto rows = of_each(answered(result.study, result.answers), [&](const AnsweredCase& each) {
    return JudgedCase{each, in_detail ? &result.details[each.index] : nullptr};
  });
  Table table = table_of(in_detail ? "Critical gap" : "Critical gaps",
                         judged_case_quantities(result.study.study, in_detail), rows);
  if (!in_detail)
    table.notes = said("critical_gap.note.cases",
                       {{"air", air_energy_note(result, report::shown_axes(result.study.study))}});
  return table;
}

Table cited_limit_table(const CriticalGapResult& result) {
  return report::cited_limit_table(
      result.study, of_each(result.answers, [](const CaseAnswer& answer) { return &answer.critical; }));
}

Table comparison_table(const CriticalGapResult& result) {
  std::vector<ComparedRow> rows;
  bool ignited = false;
  double worst = 0;  // |computed - published| of a calibrated row, K
  for (const CaseAnswer& answer : result.answers)
    for (const GapVerdict& row : answer.verdicts) {
      if (!row.reference) continue;
      ignited = ignited || row.reference->ignited() || row.ignition;
      if (row.reference->calibrated)
        worst = std::max(worst, std::isfinite(row.misfit()) ? std::abs(row.misfit()) : HUGE_VAL);
      rows.push_back(&row);
    }
  Row facts{{"ignited", ignited}};
  if (!(worst <= calibration_slack))
    facts["not_met"] = std::isfinite(worst) ? "computed - published: " + in_words(worst, fixed(1, kelvin))
                                            : std::string("one of them ignites");
  return table_of("Against the published results", comparison_quantities(result.study.study.early_time), rows,
                  said("critical_gap.note.comparison", facts));
}

std::vector<ReportTable> critical_gap_results() {
  StudyFile file;
  file.study.gaps = {0.0, 0.4e-3};
  const auto cases = joined<JudgedCase>(
      {judged_case_quantities(file.study, true), of_part<JudgedCase>(run_quantities(file.study))});
  std::vector<ReportTable> tables{
      {table_of({}, judged_gap_quantities(file), {}), "verdicts.csv", "verdicts"},
      {table_of({}, comparison_quantities(file.study.early_time), {}), "", "comparison"},
      {table_of({}, cases, {}), "critical_gaps.csv", "cases"},
      {Table{.columns = report::cited_limit_columns()}, "", "cited_limits"},
      {axis_effect_table({}), "", "axis_effects"}};
  std::ranges::move(detail_results(), std::back_inserter(tables));
  return tables;
}

}  // namespace launchsafe::kinds
