// The tables of every critical-gap study.
#include "critical_gap_tables.hpp"

namespace launchsafe::kinds {
namespace {

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

/// What a case is called, and where it lies: of few cases the name says it, of many the axes do.
Quantities<AnsweredCase> place_quantities(const Study& study, bool in_detail) {
  Quantities<AnsweredCase> place = answered_axes(study);
  if (!in_detail) {
    place.emplace_back(for_programs(quantity::case_name),
                       [keys = report::shown_axes(study)](const AnsweredCase& row) {
                         return place_text(keys, row.coordinates());
                       });
    return place;
  }
  for (auto& each : place) each = for_programs(each);
  place.emplace(place.begin(), quantity::case_name, &AnsweredCase::label);
  return place;
}

/// Critical gaps under the other constants of the study; none for a case that failed.
Quantities<AnsweredCase> model_quantities(const Study& study) {
  Quantities<AnsweredCase> gaps;
  for (std::size_t i = 0; i < study.models.size(); ++i) {
    const std::string name = study::name_of_model(*study.models[i]);
    gaps.emplace_back(Column{"critical_gap_" + name, "with " + name, significant(3, centimetre),
                             "Critical gap of the launch under these constants."},
                      [i](const AnsweredCase& row) {
                        const std::vector<study::ModelGap>& models = row.answer->models;
                        return i < models.size() ? models[i].critical_gap : not_a_number;
                      });
  }
  return gaps;
}

const Column largest_safe_gap{"largest_safe_gap", "largest SAFE gap", significant(6, centimetre),
                              "Largest computed gap that, with all smaller ones, is SAFE."};

/// How the run of a case went, which a study in detail has in a table of its own.
const Quantities<AnsweredCase> status_quantities{
    {for_programs(quantity::status), [](const AnsweredCase& row) { return status_of(*row.answer); }}};

Quantities<AnsweredCase> judged_case_quantities(const Study& study, bool in_detail) {
  Column assumed{"assumed_shares", "assumed", text(),
                 "What the bounds rest on and nothing says of the case."};
  return joined<AnsweredCase>(
      {place_quantities(study, in_detail),
       of_part<AnsweredCase>(report::bounded_gap_quantities(), &AnsweredCase::answer, &CaseAnswer::critical),
       model_quantities(study),
       {{in_detail ? for_programs(largest_safe_gap) : largest_safe_gap, &AnsweredCase::answer,
         &CaseAnswer::verdicts, study::largest_safe_gap},
        {in_detail ? for_programs(assumed) : assumed,
         [](const AnsweredCase& row) {
           const bool assumes = assumes_computation(row.input(), row.answer->critical.value);
           return std::string(assumes ? "computation" : "");
         }},
        {quantity::recorded_uncertainty,
         [](const AnsweredCase& row) { return row.input().recorded_uncertainty(); }}},
       in_detail ? Quantities<AnsweredCase>{} : status_quantities,
       {{quantity::remark, &AnsweredCase::answer, gap_remark}}});
}

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

/// Whether constants of the study's scene were fitted to a published number, in a word; nothing where there
/// is none.
auto use_of(const StudyFile& study, double Reference::*number) {
  return [constants = study.scene.constants, number](const Reference& published) -> std::string {
    if (!std::isfinite(published.*number)) return {};
    return to_string(report::use_of(constants, published.gap, published.*number));
  };
}

Quantities<ComparedRow> comparison_quantities(const StudyFile& study) {
  using namespace quantity;
  const double early_time = study.study.early_time;
  const Column early = temperature_early(early_time);
  return {{gap, &GapVerdict::gap},
          {used_for, &GapVerdict::reference, use_of(study, &Reference::maximum_temperature)},
          {temperature_max, [](ComparedRow row) { return row->until_exit.temperature; }},
          {published(temperature_max), &GapVerdict::reference, &Reference::maximum_temperature},
          {difference_of(temperature_max), &GapVerdict::misfit},
          {temperature_max_place, [](ComparedRow row) { return row->until_exit.point; }},
          {published_place(temperature_max), &GapVerdict::reference, &Reference::point},
          {"temperature_early_used_for", "used for at " + milliseconds(early_time), text(),
           "The same of the temperature at early_time.", &GapVerdict::reference,
           use_of(study, &Reference::early_temperature)},
          {early, [](ComparedRow row) { return row->early.temperature; }},
          {published(early), &GapVerdict::reference, &Reference::early_temperature},
          {difference_of(early), &GapVerdict::early_misfit},
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
  Table table =
      table_of(in_detail ? "Critical gap" : "Critical gaps",
               judged_case_quantities(result.study.study, in_detail), answered(result.study, result.answers));
  if (!in_detail) table.notes = said("critical_gap.note.cases");
  return table;
}

Table comparison_table(const CriticalGapResult& result) {
  std::vector<ComparedRow> rows;
  bool ignited = false;
  for (const CaseAnswer& answer : result.answers)
    for (const GapVerdict& row : answer.verdicts) {
      if (!row.reference) continue;
      ignited = ignited || row.reference->ignited() || row.ignition;
      rows.push_back(&row);
    }
  return table_of("Against the published results", comparison_quantities(result.study), rows,
                  said("critical_gap.note.comparison", {{"ignited", ignited}}));
}

std::vector<ReportTable> critical_gap_results() {
  StudyFile file;
  file.study.gaps = {0.0, 0.4e-3};
  const auto cases = joined<AnsweredCase>({judged_case_quantities(file.study, true), status_quantities});
  std::vector<ReportTable> tables{{table_of({}, judged_gap_quantities(file), {}), "verdicts.csv", "verdicts"},
                                  {table_of({}, comparison_quantities(file), {}), "", "comparison"},
                                  {table_of({}, cases, {}), "critical_gaps.csv", "cases"}};
  std::ranges::move(detail_results(), std::back_inserter(tables));
  return tables;
}

}  // namespace launchsafe::kinds
