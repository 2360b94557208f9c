// The tables of an accuracy study.
#include "launchsafe/kinds/accuracy.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

std::string gap_text(double gap) { return fmt::format("{:.6g}", 100.0 * gap); }

/// Adds one quantity, scaled to the unit that people read.
void add_quantity(Table& table, const std::string& name, const std::string& unit, double scale,
                  const ReferenceValue& value) {
  if (value.values.empty()) return;
  std::vector<Cell> cells{name, unit};
  for (const double each : value.values) cells.emplace_back(scale * each);
  const math::Extrapolation& limit = value.limit;
  cells.push_back(optional_number(limit.justified ? limit.order : study::not_a_number));
  cells.push_back(limit.justified ? Cell(scale * limit.value) : Cell());
  cells.push_back(optional_number(scale * limit.uncertainty));
  cells.emplace_back(limit.justified ? limit.method : "no extrapolation: " + limit.reason);
  table.rows.push_back(std::move(cells));
}

std::string remark_of(const AccuracyRow& row) {
  if (!row.computed()) return row.measured.failure;
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (!row.measured.validity_warnings.empty()) add("validity warning: " + row.measured.validity_warnings);
  if (row.baseline) add("the scene as it is");
  if (row.reference) add("reference mesh");
  if (row.on_front) add("Pareto front");
  if (row.other_model) add("another model: a difference, no numerical error");
  return text;
}

/// Whether a gap ignites on all reference meshes, so that times can be compared.
bool has_ignition_time(const AccuracyResult& result, std::size_t gap) {
  return result.reference && !result.reference->ignition_time[gap].values.empty();
}

/// A table of quantities without rows: a column for every reference mesh, then what they tend to.
Table quantity_table(const AccuracyResult& result, std::string title) {
  Table table;
  table.title = std::move(title);
  table.columns = {text_column("quantity"), text_column("unit")};
  for (const double size : accuracy_settings(result.study.study).reference_cell_sizes) {
    const std::string name = fmt::format("{:.6g} mm", 1e3 * size);
    table.columns.push_back(
        significant_column(name, "", 7, "cells_" + fmt::format("{:.6g}", 1e3 * size) + "_mm"));
  }
  table.columns.push_back(number_column("order", "", 2, "order"));
  table.columns.push_back(significant_column("extrapolated", "", 7, "extrapolated"));
  table.columns.push_back(significant_column("uncertainty", "", 2, "uncertainty"));
  table.columns.push_back(named_text("by", "method"));
  return table;
}

}  // namespace

Table reference_table(const AccuracyResult& result) {
  Table table = quantity_table(result, "What the reference meshes tend to");
  const study::Study& study = result.study.study;
  if (!result.reference) return table;
  const AccuracyReference& reference = *result.reference;
  for (std::size_t gap = 0; gap < study.gaps.size(); ++gap) {
    const std::string at = " at " + gap_text(study.gaps[gap]) + " cm";
    add_quantity(table, (reference.inert[gap] ? "T max without reaction" : "T max") + at, "K", 1.0,
                 reference.temperature[gap]);
    add_quantity(table, "ignition time" + at, "ms", 1e3, reference.ignition_time[gap]);
  }
  add_quantity(table, "critical gap", "cm", 100.0, reference.critical_gap);
  add_quantity(table, "peak pressure of the charge bottom", "MPa", 1e-6, reference.peak_pressure);
  for (std::size_t i = 0; i < reference.at_times.size(); ++i) {
    add_quantity(table,
                 fmt::format("T without reaction at {:.6g} ms, gap {} cm",
                             1e3 * accuracy_settings(study).times[i], gap_text(study.gaps.front())),
                 "K", 1.0, reference.at_times[i]);
  }
  table.notes.push_back(
      "The uncertainty is the half width about the value of the finest mesh, a grid convergence index: of "
      "made "
      "series it holds the limit of smooth ones always, of those with 2 % noise in their errors in nine of "
      "ten "
      "or more, of noisier ones in eight of ten or more.");
  return table;
}

Table point_table(const AccuracyResult& result) {
  Table table = quantity_table(result, "T max of the stations, without reaction");
  if (!result.reference) return table;
  const AccuracyMeasurement& finest = result.rows.front().measured;
  for (std::size_t i = 0; i < finest.points.size(); ++i) {
    add_quantity(
        table, fmt::format("{}, gap {} cm", finest.points[i].name, gap_text(result.study.study.gaps.front())),
        "K", 1.0, result.reference->points[i]);
  }
  table.notes.push_back(
      "T max of a study is that of the hottest station. In the corner of charge, wall and base stresses of "
      "the "
      "model are singular; the station there averages over them, and converges slowest.");
  return table;
}

Table setting_table(const AccuracyResult& result) {
  Table table;
  table.title = "Error against run time";
  const study::Study& study = result.study.study;
  table.columns = {named_text("setting", "setting"),
                   number_column("processor time", "s", 1, "processor_time_s"),
                   number_column("wall time", "s", 1, "wall_time_s"),
                   significant_column("particle steps", "", 3, "particle_steps"),
                   number_column("memory", "MB", 1, "memory_MB")};
  for (const double gap : study.gaps) {
    table.columns.push_back(number_column("T error at " + gap_text(gap) + " cm", "K", 2,
                                          "temperature_error_" + gap_text(gap) + "_cm_K"));
  }
  append(table.columns, {number_column("T bound", "K", 2, "temperature_bound_K"), quantity::critical_gap(),
                         significant_column("its error", "cm", 2, "critical_gap_error_cm"),
                         significant_column("its bound", "cm", 2, "critical_gap_bound_cm"),
                         number_column("p(t)", "%", 2, "bottom_pressure_error_percent"),
                         number_column("p peak", "%", 2, "bottom_pressure_peak_error_percent")});
  for (std::size_t gap = 0; gap < study.gaps.size(); ++gap) {
    if (has_ignition_time(result, gap))
      table.columns.push_back(number_column("ignition at " + gap_text(study.gaps[gap]) + " cm", "ms", 3,
                                            "ignition_time_error_" + gap_text(study.gaps[gap]) + "_cm_ms"));
  }
  table.columns.push_back(quantity::energy_drift());
  table.columns.push_back(named_text("remark", "remark"));
  for (const AccuracyRow& row : result.rows) {
    const AccuracyMeasurement& m = row.measured;
    std::vector<Cell> cells{result.study.cases[row.index].label, optional_number(m.processor_time),
                            optional_number(m.wall_time), m.particle_steps, m.memory / 1e6};
    for (std::size_t gap = 0; gap < study.gaps.size(); ++gap)
      cells.push_back(row.computed() ? optional_number(row.temperature_error[gap]) : Cell());
    for (const double value :
         {row.temperature_bound, 100.0 * m.critical.value, 100.0 * row.critical_gap_error,
          100.0 * row.critical_gap_bound, 100.0 * row.pressure_error, 100.0 * row.peak_pressure_error})
      cells.push_back(row.computed() ? optional_number(value) : Cell());
    for (std::size_t gap = 0; gap < study.gaps.size(); ++gap) {
      if (has_ignition_time(result, gap))
        cells.push_back(row.computed() ? optional_number(1e3 * row.ignition_time_error[gap]) : Cell());
    }
    cells.push_back(optional_number(m.energy_drift));
    cells.emplace_back(remark_of(row));
    table.rows.push_back(std::move(cells));
  }
  table.notes.push_back(
      "Errors are this minus the extrapolated value (where none is justified, the finest mesh); p(t) is the "
      "relative L2 difference of the bottom pressure from the finest mesh. Bounds: the "
      "distance from the finest mesh and its uncertainty, the largest over the gaps. Front: no setting is "
      "both cheaper and of a smaller bound.");
  return table;
}

Table time_table(const AccuracyResult& result) {
  Table table;
  const study::Study& study = result.study.study;
  table.title = fmt::format("Error of the highest temperature against time, without reaction, gap {} cm",
                            study.gaps.empty() ? "" : gap_text(study.gaps.front()));
  table.columns = {named_text("setting", "setting")};
  for (const double time : accuracy_settings(study).times) {
    table.columns.push_back(number_column(fmt::format("{:.6g} ms", 1e3 * time), "K", 2,
                                          fmt::format("temperature_error_{:.6g}_ms_K", 1e3 * time)));
  }
  table.columns.push_back(named_text("remark", "remark"));
  if (accuracy_settings(study).times.empty()) return table;
  for (const AccuracyRow& row : result.rows) {
    std::vector<Cell> cells{result.study.cases[row.index].label};
    for (std::size_t i = 0; i < accuracy_settings(study).times.size(); ++i)
      cells.push_back(row.computed() ? optional_number(row.error_at_times[i]) : Cell());
    cells.emplace_back(remark_of(row));
    table.rows.push_back(std::move(cells));
  }
  return table;
}

}  // namespace launchsafe::kinds
