// The tables of every critical-gap study.
#include "critical_gap_tables.hpp"

namespace launchsafe::kinds {
namespace {

struct PlacedGap {
  PlacedCase of;
  report::JudgedGap judged;
};

/// Peak pressure, crack radius and flaw size, which every launch has, and what else varies.
Quantities<std::vector<double>> launch_quantities(const StudyFile& study) {
  Quantities<std::vector<double>> axes = report::axis_quantities(study.study), launch;
  const StudyCase first = study.cases.empty() ? StudyCase{} : study.cases.front();
  const std::pair<Column, double> fixed_values[] = {
      {quantity::peak_pressure, first.peak_pressure},
      {quantity::crack_radius, first.strength().initial_crack_radius},
      {quantity::flaw_size, first.strength().flaw_size}};
  for (const auto& [column, value] : fixed_values) {
    if (const auto* axis = keys::find_named(axes, column.name))
      launch.push_back(*axis);
    else
      launch.emplace_back(for_programs(column),
                          [value = value](const std::vector<double>&) { return value; });
  }
  for (const auto& axis : axes)
    if (keys::find_named(launch, axis.name) == nullptr) launch.push_back(axis);
  return launch;
}

Quantities<PlacedGap> placed_gap_quantities(const StudyFile& study) {
  return joined<PlacedGap>(
      {{{quantity::gap, &PlacedGap::judged, &report::JudgedGap::gap, &GapRow::gap}},
       of_part<PlacedGap>(launch_quantities(study), &PlacedGap::of, &PlacedCase::coordinates),
       of_part<PlacedGap>(report::verdict_quantities(study.study), &PlacedGap::judged)});
}

/// What a case is called, and where it lies: of few cases the name says it, of many the axes do.
Quantities<PlacedCase> place_quantities(const Study& study, bool in_detail) {
  Quantities<PlacedCase> place = placed_axes(study);
  if (!in_detail) {
    place.emplace_back(for_programs(quantity::case_name),
                       [keys = report::shown_axes(study)](const PlacedCase& row) {
                         return place_text(keys, row.coordinates());
                       });
    return place;
  }
  for (auto& each : place) each = for_programs(each);
  place.emplace(place.begin(), quantity::case_name, &PlacedCase::label);
  return place;
}

/// Critical gaps under the other constants of the study; no numbers of a case that failed.
Quantities<PlacedCase> model_quantities(const Study& study) {
  Quantities<PlacedCase> gaps;
  for (std::size_t i = 0; i < study.models.size(); ++i) {
    const std::string name = study::name_of_model(*study.models[i]);
    gaps.emplace_back(Column{"critical_gap_" + name, "with " + name, significant(3, centimetre),
                             "Critical gap of the launch under these constants."},
                      [i](const PlacedCase& row) {
                        const std::vector<study::ModelGap>& models = row.row->models;
                        return i < models.size() ? models[i].critical_gap : not_a_number;
                      });
  }
  return gaps;
}

const Column largest_safe_gap{"largest_safe_gap", "largest SAFE gap", significant(6, centimetre),
                              "Largest computed gap that, with all smaller ones, is SAFE."};

/// How the run of a case went, which a study in detail has in a table of its own.
const Quantities<PlacedCase> status_quantities{
    {for_programs(quantity::status), [](const PlacedCase& row) { return status_of(*row.row); }}};

/// Of many cases the reasons of whoever accepts are the same in most rows: the file has them.
Quantities<PlacedCase> own_quantities(bool in_detail) {
  auto quantities = of_part<PlacedCase>(report::case_quantities(), &PlacedCase::row);
  for (auto& each : quantities)
    if (each.name == "accepted" && !in_detail) each = for_programs(each);
  return quantities;
}

Quantities<PlacedCase> placed_case_quantities(const Study& study, bool in_detail) {
  return joined<PlacedCase>({place_quantities(study, in_detail),
                             own_quantities(in_detail),
                             model_quantities(study),
                             {{largest_safe_gap, &PlacedCase::row, &CaseRow::gaps, study::largest_safe_gap}},
                             in_detail ? Quantities<PlacedCase>{} : status_quantities,
                             {{quantity::remark, &PlacedCase::row, remark_of}}});
}

/// A row that stands beside a published one.
using ComparedRow = const GapRow*;

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
    const auto is_it = [&](const scene::FittedNumber& row) {
      return row.is_fitted && std::abs(row.gap - published.gap) <= 1e-9 &&
             study::same_number(row.published, published.*number);
    };
    const bool is_fitted = constants != nullptr && std::ranges::any_of(constants->rows, is_it);
    return to_string(is_fitted ? study::Use::fitted : study::Use::check);
  };
}

Quantities<ComparedRow> comparison_quantities(const StudyFile& study) {
  using namespace quantity;
  const double early_time = study.study.early_time;
  const Column early = temperature_early(early_time);
  return {{gap, &GapRow::gap},
          {used_for, &GapRow::reference, use_of(study, &Reference::maximum_temperature)},
          {temperature_max, [](ComparedRow row) { return row->until_exit.temperature; }},
          {published(temperature_max), &GapRow::reference, &Reference::maximum_temperature},
          {difference_of(temperature_max), &GapRow::misfit},
          {temperature_max_place, [](ComparedRow row) { return row->until_exit.point; }},
          {published_place(temperature_max), &GapRow::reference, &Reference::point},
          {"temperature_early_used_for", "used for at " + milliseconds(early_time), text(),
           "The same of the temperature at early_time.", &GapRow::reference,
           use_of(study, &Reference::early_temperature)},
          {early, [](ComparedRow row) { return row->early.temperature; }},
          {published(early), &GapRow::reference, &Reference::early_temperature},
          {difference_of(early), &GapRow::early_misfit},
          {published_place(early), &GapRow::reference, &Reference::early_point},
          {ignition_time, [](ComparedRow row) { return row->ignition ? row->ignition->time : not_a_number; }},
          {published(ignition_time), &GapRow::reference, &Reference::ignition_time}};
}

}  // namespace

Table verdict_table(const CriticalGapResult& result) {
  std::vector<PlacedGap> rows;
  for (const PlacedCase& each : placed(result.study, result.rows))
    for (const GapRow& gap : each.row->gaps) rows.push_back({each, {each.row, &gap}});
  Table table = table_of("Verdicts", placed_gap_quantities(result.study), rows,
                         report::verdict_notes(result.study, result.rows));
  table.notes.push_back(report::station_note(result.study));
  return table;
}

Table critical_gap_table(const CriticalGapResult& result) {
  const bool in_detail = !result.details.empty();
  Table table =
      table_of(in_detail ? "Critical gap" : "Critical gaps",
               placed_case_quantities(result.study.study, in_detail), placed(result.study, result.rows));
  if (in_detail) return table;
  table.notes = {
      "After ignition T max is that of the burning skin. `verdicts.csv` has every gap with its reason."};
  std::ranges::move(report::verdict_notes(result.study, result.rows), std::back_inserter(table.notes));
  return table;
}

Table comparison_table(const CriticalGapResult& result) {
  std::vector<ComparedRow> rows;
  for (const CaseRow& row : result.rows)
    for (const GapRow& gap : row.gaps) {
      if (!gap.reference) continue;
      rows.push_back(&gap);
    }
  std::vector<std::string> notes{
      "Fitted: the constants were fitted to it, and its difference is what the fit leaves. Check: they were "
      "not. After ignition T max is that of the burning skin; it is not compared."};
  return table_of("Against the published results", comparison_quantities(result.study), rows,
                  std::move(notes));
}

std::vector<ReportTable> critical_gap_results() {
  StudyFile file;
  file.study.gaps = {0.0, 0.4e-3};
  const auto cases = joined<PlacedCase>({placed_case_quantities(file.study, true), status_quantities});
  std::vector<ReportTable> tables{{table_of({}, placed_gap_quantities(file), {}), "verdicts.csv", "verdicts"},
                                  {table_of({}, comparison_quantities(file), {}), "", "comparison"},
                                  {table_of({}, cases, {}), "critical_gaps.csv", "cases"}};
  std::ranges::move(detail_results(), std::back_inserter(tables));
  return tables;
}

}  // namespace launchsafe::kinds
