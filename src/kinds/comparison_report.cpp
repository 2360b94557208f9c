// The answer, the tables and the page of a comparison.
#include "answer_tables.hpp"
#include "launchsafe/kinds/comparison.hpp"

#include <fmt/format.h>

namespace launchsafe::kinds {

using keys::fixed, keys::significant;
using report::Quantities, report::ReportTable, report::Row, report::Statement, report::Table;
using study::CaseAnswer, study::not_a_number, study::RunSummary, study::StationTemperature, study::Study;

namespace {

/// A case of a comparison.
struct CaseRow {
  const ComparisonResult* result;
  std::size_t index;

  const ComparedCase& compared() const { return result->answers[index]; }
  const std::vector<double>& coordinates() const { return result->study.cases.coordinates(index); }
  const std::string& variant() const { return result->variants()[compared().variant].name; }
};

/// Variant, and peak pressure where there are several.
Quantities<CaseRow> place_quantities(const Study& study) {
  return keys::joined<CaseRow>({{{quantity::variant, &CaseRow::variant}},
                                of_part<CaseRow>(report::axis_quantities(study), &CaseRow::coordinates)});
}

double hottest(const ComparedCase& each) {
  double highest = not_a_number;
  for (const study::GapVerdict& row : each.verdicts)
    if (!(row.heated <= highest)) highest = row.heated;
  return highest;
}

/// m by which the critical gap of a variant is above that of the scene as it is; NaN where one has none.
double shift_of(const ComparisonResult& result, std::size_t index) {
  return report::value_of(result.answers[index].critical) -
         report::value_of(result.answers[result.counterpart(index)].critical);
}

Quantities<CaseRow> compared_case_quantities(const Study& study) {
  const auto unless_own = [](double (*difference)(const CaseRow&)) {
    return [difference](const CaseRow& row) {
      return row.compared().variant == 0 ? not_a_number : difference(row);
    };
  };
  return keys::joined<CaseRow>(
      {place_quantities(study),
       of_part<CaseRow>(report::critical_gap_quantities(), &CaseRow::compared, &CaseAnswer::critical),
       {{"critical_gap_difference", "less that of the scene", significant(3, keys::centimetre),
         "Critical gap minus that of the scene as it is.",
         unless_own([](const CaseRow& row) { return shift_of(*row.result, row.index); })},
        {quantity::temperature_max_inert, [](const CaseRow& row) { return hottest(row.compared()); }},
        {"temperature_max_inert_difference", "less that of the scene", fixed(1, keys::kelvin),
         "The same minus that of the scene as it is.", unless_own([](const CaseRow& row) {
           return hottest(row.compared()) - hottest(row.result->answers[row.result->counterpart(row.index)]);
         })},
        {for_programs(quantity::processor_time),
         [](const CaseRow& row) { return row.compared().processor_time; }},
        {for_programs(quantity::particles), &CaseRow::compared, &CaseAnswer::run, &RunSummary::particles},
        {for_programs(quantity::steps), &CaseRow::compared, &CaseAnswer::run, &RunSummary::steps},
        {for_programs(quantity::energy_drift), &CaseRow::compared, &CaseAnswer::run,
         &RunSummary::energy_drift},
        {quantity::reason, [](const CaseRow& row) {
           const CaseAnswer& answer = row.compared();
           return answer.completed() ? answer.critical.reason : answer.failure;
         }}}});
}

/// A row for every case: critical gap, hottest temperature, both less those of the scene as it is, and cost.
Table comparison_table(const ComparisonResult& result) {
  std::vector<CaseRow> rows;
  for (std::size_t i = 0; i < result.answers.size(); ++i) rows.push_back({&result, i});
  return report::table_of("Variants side by side", compared_case_quantities(result.study.study), rows,
                          said("comparison.note.cases"));
}

/// A station under a gap of a case.
struct StationRow {
  CaseRow of;
  double gap;  ///< m
  const StationTemperature* station;
};

Quantities<StationRow> station_quantities(const Study& study) {
  return keys::joined<StationRow>(
      {of_part<StationRow>(place_quantities(study), &StationRow::of),
       {{quantity::gap, &StationRow::gap},
        {quantity::station, &StationRow::station, &StationTemperature::name},
        {always(quantity::temperature_max_inert), &StationRow::station, &StationTemperature::temperature}}});
}

/// A row for every station of every gap and case.
Table station_table(const ComparisonResult& result) {
  std::vector<StationRow> rows;
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const auto& stations = result.answers[i].stations;
    for (std::size_t gap = 0; gap < stations.size(); ++gap)
      for (const StationTemperature& each : stations[gap])
        rows.push_back({{&result, i}, result.study.study.gaps[gap], &each});
  }
  return report::table_of("T max of every station, without reaction", station_quantities(result.study.study),
                          rows);
}

/// Stations side by side at the largest gap: a column for each variant. Peak pressures are compared in the
/// files; here the first one of every variant.
Table stations_side_by_side(const ComparisonResult& result) {
  const std::vector<double>& gaps = result.study.study.gaps;
  const auto gap = static_cast<std::size_t>(std::ranges::max_element(gaps) - gaps.begin());
  std::vector<std::string> rows;
  Quantities<std::string> quantities{{quantity::station, std::identity{}}};
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const ComparedCase& each = result.answers[i];
    for (const StationTemperature& station :
         each.stations.empty() ? std::vector<StationTemperature>{} : each.stations[gap])
      if (std::ranges::find(rows, station.name) == rows.end()) rows.push_back(station.name);
    if (result.counterpart(i) != 0) continue;
    const std::string& variant = result.variants()[each.variant].name;
    quantities.emplace_back(variant, variant, fixed(1), "T max of the station under that variant.",
                            [&each, gap](const std::string& name) {
                              if (each.stations.empty()) return not_a_number;
                              const auto found =
                                  std::ranges::find(each.stations[gap], name, &StationTemperature::name);
                              return found == each.stations[gap].end() ? not_a_number : found->temperature;
                            });
  }
  Table table = report::table_of(
      "T max [K] by station at " + report::centimetres(gaps[gap]) + ", without reaction", quantities, rows);
  if (!result.study.study.axes.empty())
    table.notes.emplace_back("Under the first peak pressure; stations.csv has the others.");
  return table;
}

}  // namespace

std::string answer(const ComparisonResult& result) {
  Row facts{{"variants", result.variants().size() - 1},
            {"cases", result.answers.size()},
            {"gaps", result.study.study.gaps.size()}};
  // The variant with the smallest critical gap against that of the scene as it is.
  double least = 0.0;
  std::size_t unknown = 0;
  for (std::size_t i = 0; i < result.answers.size(); ++i) {
    const std::string& label = result.study.cases[i].label;
    if (result.answers[i].variant == 0) {
      facts["own"].push_back(
          {{"case", label}, {"critical_gap", report::reads_as(result.answers[i].critical)}});
      continue;
    }
    const double shift = shift_of(result, i);
    unknown += std::isnan(shift);
    if (!(shift < least)) continue;
    least = shift;
    facts["least"] = report::in_words(shift, significant(3, keys::centimetre)) + ", of " + label;
  }
  facts["unknown"] = unknown;
  return answer_of(said("comparison.answer", facts), result.study);
}

report::Report report_of(const ComparisonResult& result) {
  report::Report report{result.study.study.title, answer(result), report::remaking_command(result.study)};
  report.items = {ReportTable{comparison_table(result), "comparison.csv", "cases"},
                  ReportTable{station_table(result), "stations.csv", "stations", report::Shown::file}};
  report.add({.table = stations_side_by_side(result), .shown = report::Shown::page});
  add_model_form(result, report);
  Row variants = Row::array();  // what each does otherwise
  for (const Variant& each : result.variants())
    variants.push_back({{"name", each.name},
                        {"description", each.description},
                        {"changes", each.changes},
                        {"failure", each.calibration ? each.calibration->failure : ""}});
  report.say("## Variants\n\n" + said_below("comparison.variants", {{"variants", variants}}));
  report.say("## What it rests on\n\n" + report::friction_remark(result.study));
  report.say(report::station_note(result.study) + "\n");
  report.say("## Setup\n\n" + report::setup_text(result.study));
  report.say(report::timing_sentence(result.timing));
  report.json = study_json(
      result.study, report,
      {{"axes", report::axes_json(result.study.study)},
       {"early_time_ms", report::shown_value(result.study.study.early_time, quantity::time(2).form)},
       {"timing", report::timing_json(result.timing)}});
  return report;
}

std::vector<ReportTable> comparison_results() {
  const Study study;
  std::vector<ReportTable> tables{
      {report::table_of({}, compared_case_quantities(study), {}), "comparison.csv", "cases"},
      {report::table_of({}, station_quantities(study), {}), "stations.csv", "stations"}};
  for (ReportTable& each : model_form_results()) tables.push_back(std::move(each));
  return tables;
}

}  // namespace launchsafe::kinds
