// The tables of an accuracy study.
#include "launchsafe/kinds/accuracy.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/verdict_text.hpp"

#include <fmt/format.h>

#include <algorithm>

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
bool has_ignition_time(const VariantAccuracy& variant, std::size_t gap) {
  return variant.reference && !variant.reference->ignition_time[gap].values.empty();
}

/// A table of quantities without rows: a column for every reference mesh, then what they tend to.
Table quantity_table(const VariantAccuracy& variant) {
  Table table;
  table.columns = {text_column("quantity"), text_column("unit")};
  for (const double size : accuracy_settings(variant.study.study).reference_cell_sizes) {
    const std::string cells = fmt::format("{:.6g}", 1e3 * size);
    table.columns.push_back(significant_column(cells + " mm", "", 7, "cells_" + cells + "_mm"));
  }
  append(table.columns,
         {number_column("order", "", 2, "order"), significant_column("extrapolated", "", 7, "extrapolated"),
          significant_column("uncertainty", "", 2, "uncertainty"), named_text("by", "method")});
  return table;
}

}  // namespace

Table reference_table(const VariantAccuracy& variant) {
  Table table = quantity_table(variant);
  const study::Study& study = variant.study.study;
  if (!variant.reference) return table;
  const AccuracyReference& reference = *variant.reference;
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
  return table;
}

Table point_table(const VariantAccuracy& variant) {
  Table table = quantity_table(variant);
  if (!variant.reference) return table;
  const AccuracyMeasurement& finest = variant.rows.front().measured;
  for (std::size_t i = 0; i < finest.points.size(); ++i) {
    add_quantity(
        table,
        fmt::format("{}, gap {} cm", finest.points[i].name, gap_text(variant.study.study.gaps.front())), "K",
        1.0, variant.reference->points[i]);
  }
  return table;
}

Table setting_table(const VariantAccuracy& variant) {
  Table table;
  table.title = "Error against run time";
  const study::Study& study = variant.study.study;
  const std::vector<double>& times = accuracy_settings(study).times;
  table.columns = {named_text("setting", "setting"),
                   significant_column("cell", "mm", 3, "cell_mm"),
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
    if (has_ignition_time(variant, gap))
      table.columns.push_back(number_column("ignition at " + gap_text(study.gaps[gap]) + " cm", "ms", 3,
                                            "ignition_time_error_" + gap_text(study.gaps[gap]) + "_cm_ms"));
  }
  for (const double time : times) {
    const std::string at = fmt::format("{:.6g}", 1e3 * time);
    table.columns.push_back(
        for_programs(number_column("T error at " + at + " ms", "K", 2, "temperature_error_" + at + "_ms_K")));
  }
  table.columns.push_back(quantity::energy_drift());
  table.columns.push_back(named_text("remark", "remark"));
  for (const AccuracyRow& row : variant.rows) {
    const AccuracyMeasurement& m = row.measured;
    std::vector<Cell> cells{variant.label_of(row),        1e3 * m.cell,     optional_number(m.processor_time),
                            optional_number(m.wall_time), m.particle_steps, m.memory / 1e6};
    for (std::size_t gap = 0; gap < study.gaps.size(); ++gap)
      cells.push_back(row.computed() ? optional_number(row.temperature_error[gap]) : Cell());
    for (const double value :
         {row.temperature_bound, 100.0 * m.critical.value, 100.0 * row.critical_gap_error,
          100.0 * row.critical_gap_bound, 100.0 * row.pressure_error, 100.0 * row.peak_pressure_error})
      cells.push_back(row.computed() ? optional_number(value) : Cell());
    for (std::size_t gap = 0; gap < study.gaps.size(); ++gap) {
      if (has_ignition_time(variant, gap))
        cells.push_back(row.computed() ? optional_number(1e3 * row.ignition_time_error[gap]) : Cell());
    }
    for (std::size_t i = 0; i < times.size(); ++i)
      cells.push_back(row.computed() ? optional_number(row.error_at_times[i]) : Cell());
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

Table variant_table(const AccuracyResult& result) {
  Table table;
  table.title = "How wrong each variant is with its own setting";
  table.columns = {named_text("variant", "variant"),
                   number_column("T bound", "K", 2, "temperature_bound_K"),
                   number_column("T distance", "K", 2, "temperature_distance_K"),
                   quantity::critical_gap(),
                   significant_column("its bound", "cm", 2, "critical_gap_bound_cm"),
                   number_column("reference uncertain by", "K", 2, "reference_uncertainty_K"),
                   number_column("processor time", "s", 1, "processor_time_s"),
                   named_text("cheapest with half the bound", "half_bound_setting"),
                   number_column("its time", "s", 1, "half_bound_processor_time_s"),
                   named_text("most distant setting", "most_distant_setting"),
                   number_column("its distance", "K", 2, "most_distant_K")};
  for (const VariantAccuracy& variant : result.variants) {
    std::vector<Cell>& cells = table.rows.emplace_back();
    const AccuracyRow* own = variant.baseline();
    const std::string reason =
        variant.reference ? "its own setting did not run soundly" : variant.no_reference;
    cells.emplace_back(own != nullptr ? variant.name : variant.name + ": " + reason);
    if (own == nullptr) continue;
    for (const double value :
         {own->temperature_bound, own->largest_temperature_error, 100.0 * own->measured.critical.value,
          100.0 * own->critical_gap_bound, variant.reference_uncertainty(), own->measured.processor_time})
      cells.push_back(optional_number(value));
    const AccuracyRow* half = variant.cheapest(0.5 * own->temperature_bound);
    cells.emplace_back(half ? variant.label_of(*half) : "none here");
    cells.push_back(half ? Cell(half->measured.processor_time) : Cell());
    const AccuracyRow* worst = own;
    for (const AccuracyRow& row : variant.rows)
      if (!row.other_model && row.largest_temperature_error > worst->largest_temperature_error) worst = &row;
    cells.emplace_back(variant.label_of(*worst));
    cells.emplace_back(worst->largest_temperature_error);
  }
  table.notes.push_back(
      "A bound is the distance from the finest grid and the uncertainty of the reference, the largest over "
      "the gaps; a distance is that from the limit of the grids, or from the finest where no limit is "
      "justified, and of settings with a validity warning too.");
  return table;
}

Table over_variants(const AccuracyResult& result, Table (*table_of)(const VariantAccuracy& variant)) {
  if (result.variants.size() == 1) return table_of(result.variants.front());
  Table all;
  all.columns = {named_text("variant", "variant")};
  std::vector<std::string> keys{"variant"};
  for (const VariantAccuracy& variant : result.variants) {
    const Table own = table_of(variant);
    const std::vector<std::string> own_keys = keys_of(own);
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < own_keys.size(); ++i) {
      const auto same = std::find(keys.begin(), keys.end(), own_keys[i]);
      places.push_back(static_cast<std::size_t>(same - keys.begin()));
      if (same != keys.end()) continue;
      keys.push_back(own_keys[i]);
      all.columns.push_back(own.columns[i]);
    }
    for (const std::vector<Cell>& row : own.rows) {
      std::vector<Cell>& cells = all.rows.emplace_back(all.columns.size());
      cells.front() = variant.name;
      for (std::size_t i = 0; i < row.size(); ++i) cells[places[i]] = row[i];
    }
  }
  return all;
}

}  // namespace launchsafe::kinds
