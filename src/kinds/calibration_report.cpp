// Tables, page and files of a calibration.
#include "calibration_load_report.hpp"
#include "launchsafe/report/case_tables.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/study/calibration_record.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

using Json = nlohmann::ordered_json;

std::string remark_of(const CalibrationRow& row) {
  if (!row.failure.empty()) return row.failure;
  return row.calibratable ? std::string{}
                          : "not calibratable at gap 0; with the scene's exchange time and T1";
}

/// Whether the calibrated ignition temperature lies in the published bracket.
std::string bracket_check(const study::Study& study, const CalibrationRow& row) {
  const double value = row.calibrated.constants.ignition_temperature;
  const auto& own = settings_of<CalibrationSettings>(study);
  if (!std::isfinite(value) || !std::isfinite(own.ignition_lowest)) return {};
  return value >= own.ignition_lowest && value <= own.ignition_highest ? "inside" : "outside";
}

/// Constants and what they miss, of every mesh, closure and kinetics: what is printed on stdout.
Table calibration_table(const CalibrationResult& result) {
  Table table;
  table.title = "Calibrated constants, and how far they miss what nothing was fitted to";
  table.columns = {quantity::cell_size(),
                   quantity::closure(),
                   quantity::kinetics(),
                   quantity::localisation(),
                   quantity::exchange_time(),
                   quantity::ignition_temperature(),
                   number_column("T1 from", "K", 2, "ignition_lowest_K"),
                   number_column("to", "K", 2, "ignition_highest_K"),
                   text_column("published bracket"),
                   for_programs(number_column("without gap", "K", 2, "zero_gap_computed_minus_published_K")),
                   for_programs(number_column("wide gap", "K", 2, "wide_gap_computed_minus_published_K")),
                   number_column("RMS", "K", 2, "rms_K"),
                   number_column("RMS of spreads", "K", 2, "spread_rms_K"),
                   quantity::selection_rms(),
                   text_column("remark")};
  for (const CalibrationRow& row : result.rows) {
    const CalibratedConstants& fitted = row.calibrated;
    table.rows.push_back({1e3 * row.cell_size, study::to_string(row.closure), row.kinetics,
                          optional_number(fitted.constants.localisation),
                          optional_number(1e3 * fitted.constants.exchange_time),
                          optional_number(fitted.constants.ignition_temperature),
                          optional_number(fitted.ignition_lowest), optional_number(fitted.ignition_highest),
                          bracket_check(result.study.study, row), optional_number(fitted.zero_gap_misfit),
                          optional_number(fitted.wide_gap_misfit), optional_number(row.root_mean_square),
                          optional_number(row.spread_root_mean_square),
                          optional_number(row.selection_root_mean_square), remark_of(row)});
  }
  table.notes.push_back(
      "RMS: over the temperatures that nothing was fitted to, computed minus published. T1 is the middle "
      "between the "
      "untriggered T max of the largest published gap that is safe and of the smallest that ignites.");
  return table;
}

/// Every published number beside what one row computes: with what it was used for, and the model's rival.
Table compared_table(const CalibrationResult& result, const CalibrationRow& row) {
  Table table;
  table.title = fmt::format("Against the published results: {} mm, {}, {}",
                            significant(1e3 * row.cell_size, 6), study::to_string(row.closure), row.kinetics);
  table.columns = {text_column("quantity"),
                   quantity::gap(),
                   number_column("computed", "", 2, "computed"),
                   number_column("published", "", 2, "published"),
                   number_column("computed - published", "", 2, "computed_minus_published"),
                   text_column("unit"),
                   number_column("line - published", "", 2, "line_minus_published"),
                   quantity::used_for()};
  for (const ComparedNumber& each : row.compared) {
    const double scale = each.in_seconds ? 1e3 : 1.0;
    table.rows.push_back({each.quantity, 100.0 * each.gap, optional_number(scale * each.computed),
                          scale * each.published, optional_number(scale * each.misfit()),
                          std::string(each.in_seconds ? "ms" : "K"),
                          optional_number(each.line - each.published), study::to_string(each.use)});
  }
  for (const Placement& each : row.placements) {
    table.notes.push_back(fmt::format("Place of {} at {}: computed {}, published {}.", each.quantity,
                                      centimetres(each.gap), each.computed, each.published));
  }
  table.notes.push_back(
      "Fitted: its difference is what the fit leaves. Chosen by: seen when a form of the model was picked, "
      "so no "
      "prediction; held out: neither. Line: straight over the gap through what is published of the two "
      "fitted rows, the rival of the model; gaps near those rows prove little. A fast rise is where the "
      "highest "
      "temperature grows, over half a millisecond and without a trigger, at more than 15 % of its largest "
      "rate.");
  if (result.study.study.references.empty()) table.notes.push_back("The study has no published rows.");
  return table;
}

/// The differences of the recommended row from published results by which a model is chosen among others; no
/// rows without any.
Table selection_table(const CalibrationResult& result) {
  Table table;
  const CalibrationRow* row = result.recommended();
  if (!row) return table;
  table.title = "Differences that choose among models";
  table.columns = {text_column("quantity"),
                   number_column("computed - published", "K", 2, "computed_minus_published_K")};
  for (const SelectionMisfit& each : row->selection)
    table.rows.push_back({each.quantity, optional_number(each.misfit)});
  table.notes.push_back(
      fmt::format("Their root mean square is {} K. A spread is the root mean square over the gaps; a hottest "
                  "place is the temperature of the published place minus the highest.",
                  significant(row->selection_root_mean_square, 4)));
  return table;
}

/// What the constants do from mesh to mesh.
Table convergence_table(const CalibrationResult& result) {
  Table table{"From the coarsest to the finest mesh",
              {quantity::closure(), quantity::kinetics(),
               number_column("localisation", "%", 1, "localisation_change_percent"),
               number_column("exchange time", "%", 1, "exchange_time_change_percent")}};
  for (const Convergence& each : result.convergence) {
    table.rows.push_back({study::to_string(each.closure), each.kinetics,
                          optional_number(100.0 * each.localisation_change),
                          optional_number(100.0 * each.exchange_time_change)});
  }
  return table;
}

/// How far the stations move from mesh to mesh. Empty where that was not seen.
std::string stations_text(const CalibrationResult& result) {
  if (!std::isfinite(result.stations.finer)) return {};
  return fmt::format(
      "With these constants no station without a gap changes by more than {:.2f} K on the next finer mesh, "
      "and by more than {:.2f} K from the next coarser one: the stations {} by the rule of "
      "`studies/model_form/README.md`.\n",
      result.stations.finer, result.stations.coarser,
      result.stations.converges() ? "converge" : "do not converge");
}

Json recommendation_json(const CalibrationResult& result) {
  Json json{{"reason", result.recommendation.reason}, {"row", nullptr}};
  if (result.recommendation.row) json["row"] = *result.recommendation.row;
  return json;
}

Json in_scene_json(const CalibrationResult& result) {
  return {{"closure", study::to_string(result.study.scene.scene.surface.friction)},
          {"localisation", number(result.in_scene.localisation)},
          {"exchange_time_ms", number(1e3 * result.in_scene.exchange_time)},
          {"ignition_temperature_K", number(result.in_scene.ignition_temperature)}};
}

Json stations_json(const study::StationConvergence& stations) {
  return {{"change_to_finer_K", number(stations.finer)},
          {"change_from_coarser_K", number(stations.coarser)},
          {"converge", stations.converges()}};
}

Table run_table(const CalibrationResult& result) {
  std::vector<NamedRun> runs;
  for (const CalibrationRun& run : result.runs)
    runs.push_back({run.input.label, run.failure, &run.mechanics, {}});
  return report::run_table(runs);
}

/// The columns and cells that tell one calibration from another.
std::vector<Column> row_columns() {
  return {quantity::cell_size(), quantity::closure(), quantity::kinetics()};
}
std::vector<Cell> row_cells(const CalibrationRow& row) {
  return {1e3 * row.cell_size, study::to_string(row.closure), row.kinetics};
}

/// Where maxima were computed and published, of all rows.
Table placement_table(const CalibrationResult& result) {
  Table table;
  table.columns = row_columns();
  append(table.columns,
         {text_column("quantity"), quantity::gap(), text_column("computed"), text_column("published")});
  for (const CalibrationRow& row : result.rows) {
    for (const Placement& each : row.placements) {
      std::vector<Cell>& cells = table.rows.emplace_back(row_cells(row));
      cells.insert(cells.end(), {each.quantity, 100.0 * each.gap, each.computed, each.published});
    }
  }
  return table;
}

/// All compared numbers of all rows in one table, for other programs.
Table all_compared(const CalibrationResult& result) {
  Table table;
  for (const CalibrationRow& row : result.rows) {
    const Table one = compared_table(result, row);
    if (table.columns.empty()) {
      table.columns = row_columns();
      append(table.columns, one.columns);
    }
    for (const std::vector<Cell>& cells : one.rows) {
      std::vector<Cell>& extended = table.rows.emplace_back(row_cells(row));
      extended.insert(extended.end(), cells.begin(), cells.end());
    }
  }
  return table;
}

}  // namespace

Table constants_table(const CalibrationResult& result) {
  Table table;
  if (!result.recommended()) return table;
  const CalibrationRow& row = *result.recommended();
  const Constants &fitted = row.calibrated.constants, &now = result.in_scene;
  const std::string closure_now = study::to_string(result.study.scene.scene.surface.friction);
  table.title = "Constants the scene should hold";
  table.columns = {text_column("key"), text_column("calibrated"), text_column("in the scene now"),
                   number_column("difference", "%", 2, "difference_percent")};
  const auto add = [&table](std::string key, double value, double held, double scale, const char* unit) {
    table.rows.push_back({std::move(key), significant(scale * value, 6) + unit,
                          significant(scale * held, 6) + unit, 100.0 * (held - value) / value});
  };
  table.rows.push_back({"friction.closure", study::to_string(row.closure), closure_now, Cell()});
  add("friction.localisation", fitted.localisation, now.localisation, 1.0, "");
  add("gap.exchange_time", fitted.exchange_time, now.exchange_time, 1e3, " ms");
  if (result.load && result.load->failure.empty()) {
    const scene::Load& held = result.study.scene.scene.load;
    add("load.peak_time", result.load->peak_time, held.peak_time, 1e3, " ms");
    add("load.width", result.load->width, held.width, 1e3, " ms");
    add("load.steepness", result.load->steepness, held.steepness, 1.0, "");
  }
  add("kinetics.ignition_temperature", fitted.ignition_temperature, now.ignition_temperature, 1.0, " K");
  table.notes.push_back(fmt::format("They belong to cells of {} mm and the scene's other settings.",
                                    significant(1e3 * row.cell_size, 6)));
  return table;
}

std::string answer(const CalibrationResult& result) {
  std::string text = result.recommendation.reason;
  if (const CalibrationRow* row = result.recommended()) {
    const Constants& fitted = row->calibrated.constants;
    if (result.load) text += load_sentence(*result.load);
    text += fmt::format(
        " The scene should hold \"{}\": at {} mm, localisation {}, exchange time {} ms, ignition "
        "temperature {} K.",
        study::to_string(row->closure), significant(1e3 * row->cell_size, 6),
        significant(fitted.localisation, 6), significant(1e3 * fitted.exchange_time, 6),
        significant(fitted.ignition_temperature, 6));
  }
  return text.empty() ? "No calibration: no run was made." : text;
}

Report report_of(const CalibrationResult& result) {
  Report report{result.study.study.title, answer(result), remaking_command(result.study)};
  if (const auto record = record_of(result))
    report.files.push_back({"calibration.json", study::to_json_text(*record)});
  report.items.push_back(Statement{stations_text(result)});
  report.items.push_back(ReportTable{constants_table(result), "", "constants"});
  report.items.push_back(ReportTable{fitted_table(result), "", "fitted"});
  report.items.push_back(Statement{fit_text(result)});
  report.items.push_back(Statement{misfits_text(result)});
  report.items.push_back(ReportTable{calibration_table(result), "calibration.csv", "calibrations"});
  Table selection = selection_table(result);
  if (selection.rows.size() < 2) selection.rows.clear();
  report.items.push_back(ReportTable{std::move(selection), "", "selection", Shown::page});
  report.items.push_back(ReportTable{convergence_table(result), "", "convergence"});
  for (std::size_t row = 0; row < result.rows.size(); ++row) {
    const Shown shown = result.recommendation.row == row ? Shown::page_and_terminal : Shown::page;
    report.items.push_back(ReportTable{.table = compared_table(result, result.rows[row]), .shown = shown});
  }
  report.items.push_back(ReportTable{all_compared(result), "compared.csv", "compared", Shown::file});
  report.items.push_back(ReportTable{placement_table(result), "", "placements", Shown::file});
  report.items.push_back(Statement{"## Setup\n\n" + setup_text(result.study)});
  report.items.push_back(ReportTable{run_table(result), "", "runs", Shown::page});
  report.items.push_back(Statement{timing_sentence(result.timing)});
  report.json = study_json(result.study, report,
                           {{"recommendation", recommendation_json(result)},
                            {"in_scene", in_scene_json(result)},
                            {"load", load_json(result)},
                            {"stations", stations_json(result.stations)},
                            {"timing", timing_json(result.timing)}});
  return report;
}

}  // namespace launchsafe::kinds
