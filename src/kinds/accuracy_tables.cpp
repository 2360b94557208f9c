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

/// How a row begins where there are several variants.
std::vector<Field> start_of_row(const AccuracyResult& result, const VariantAccuracy& variant) {
  if (result.variants.size() == 1) return {};
  return {{named_text("variant", "variant"), variant.name}};
}

/// A table whose first columns are there even where no variant has a row.
Table table_with(const AccuracyResult& result, const std::vector<Column>& first) {
  Table table;
  if (result.variants.size() != 1) table.columns.push_back(named_text("variant", "variant"));
  append(table.columns, first);
  return table;
}

/// What one variant says of quantities, a row each, scaled to the unit that people read.
struct QuantityTable {
  const AccuracyResult& result;
  const VariantAccuracy& variant;
  Table& table;

  void add(const std::string& name, const std::string& unit, double scale, const ReferenceValue& value) {
    if (value.values.empty()) return;
    const math::Extrapolation& limit = value.limit;
    std::vector<Field> fields = start_of_row(result, variant);
    append(fields, {{named_text("quantity", "quantity"), name}, {named_text("unit", "unit"), unit}});
    for (std::size_t i = 0; i < value.values.size(); ++i) {
      const double size = accuracy_settings(variant.study.study).reference_cell_sizes[i];
      const std::string cells = fmt::format("{:.6g}", 1e3 * size);
      fields.push_back(
          {significant_column(cells + " mm", "", 7, "cells_" + cells + "_mm"), scale * value.values[i]});
    }
    append(fields, {{number_column("order", "", 2, "order"), limit.justified ? limit.order : not_a_number},
                    {significant_column("extrapolated", "", 7, "extrapolated"),
                     limit.justified ? scale * limit.value : not_a_number},
                    {significant_column("uncertainty", "", 2, "uncertainty"), scale * limit.uncertainty},
                    {named_text("by", "method"),
                     limit.justified ? limit.method : "no extrapolation: " + limit.reason}});
    add_row(table, std::move(fields));
  }
};

/// A table of quantities, of which `add` adds those of a variant with a reference.
Table quantity_table(const AccuracyResult& result,
                     void (*add)(QuantityTable& to, const AccuracyReference& reference)) {
  Table table = table_with(result, {named_text("quantity", "quantity"), named_text("unit", "unit")});
  for (const VariantAccuracy& variant : result.variants) {
    QuantityTable to{result, variant, table};
    if (variant.reference) add(to, *variant.reference);
  }
  return table;
}

std::string remark_of(const AccuracyRow& row) {
  if (!row.computed()) return row.answer.failure;
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (!row.validity_warnings.empty()) add("validity warning: " + row.validity_warnings);
  if (row.baseline) add("the scene as it is");
  if (row.setting.reference) add("reference mesh");
  if (row.on_front) add("Pareto front");
  if (row.other_model) add("another model: a difference, no numerical error");
  return text;
}

/// The cost of a setting and its errors.
void add_setting(const VariantAccuracy& variant, const AccuracyRow& row, std::vector<Field>& fields) {
  const study::Study& study = variant.study.study;
  const RecordedSetting& setting = row.setting;
  append(fields, {{named_text("setting", "setting"), setting.label},
                  {significant_column("cell", "mm", 3, "cell_mm"), 1e3 * setting.cell},
                  {number_column("processor time", "s", 1, "processor_time_s"), setting.processor_time},
                  {number_column("wall time", "s", 1, "wall_time_s"), row.wall_time},
                  {significant_column("particle steps", "", 3, "particle_steps"), row.particle_steps},
                  {number_column("memory", "MB", 1, "memory_MB"), row.memory / 1e6}});
  for (std::size_t i = 0; i < study.gaps.size(); ++i) {
    const std::string gap = gap_text(study.gaps[i]);
    fields.push_back(
        {number_column("T error at " + gap + " cm", "K", 2, "temperature_error_" + gap + "_cm_K"),
         number_at(row.temperature_error, i)});
  }
  append(fields,
         {{number_column("T bound", "K", 2, "temperature_bound_K"), setting.temperature_bound},
          {quantity::critical_gap(), 100.0 * setting.critical_gap},
          {significant_column("its error", "cm", 2, "critical_gap_error_cm"), 100.0 * row.critical_gap_error},
          {significant_column("its bound", "cm", 2, "critical_gap_bound_cm"),
           100.0 * setting.critical_gap_bound},
          {number_column("p(t)", "%", 2, "bottom_pressure_error_percent"), 100.0 * row.pressure_error},
          {number_column("p peak", "%", 2, "bottom_pressure_peak_error_percent"),
           100.0 * row.peak_pressure_error}});
  for (std::size_t i = 0; i < study.gaps.size(); ++i) {
    // A gap whose time can be compared ignites on all reference meshes.
    if (variant.reference->ignition_time[i].values.empty()) continue;
    const std::string gap = gap_text(study.gaps[i]);
    fields.push_back(
        {number_column("ignition at " + gap + " cm", "ms", 3, "ignition_time_error_" + gap + "_cm_ms"),
         number_at(row.ignition_time_error, i, 1e3)});
  }
  const std::vector<double>& times = accuracy_settings(study).times;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const std::string at = fmt::format("{:.6g} ms", 1e3 * times[i]);
    const std::string key = fmt::format("temperature_error_{:.6g}_ms_K", 1e3 * times[i]);
    fields.push_back(
        {for_programs(number_column("T error at " + at, "K", 2, key)), number_at(row.error_at_times, i)});
  }
  append(fields, {{quantity::energy_drift(), row.answer.run.energy_drift},
                  {named_text("remark", "remark"), remark_of(row)}});
}

/// How wrong the own setting of a variant is: nothing but its name where that setting did not run soundly.
std::vector<Field> variant_fields(const VariantAccuracy& variant) {
  static const AccuracyRow none;
  const AccuracyRow* found = variant.baseline();
  const AccuracyRow* own = found ? found : &none;
  const RecordedSetting* half = cheapest_within(variant.record, 0.5 * own->setting.temperature_bound);
  const AccuracyRow* worst = own;
  for (const AccuracyRow& row : variant.rows)
    if (!row.other_model && row.largest_temperature_error > worst->largest_temperature_error) worst = &row;
  std::vector<Field> fields{
      {named_text("variant", "variant"), variant.name},
      {number_column("T bound", "K", 2, "temperature_bound_K"), own->setting.temperature_bound},
      {number_column("T distance", "K", 2, "temperature_distance_K"), own->largest_temperature_error},
      {quantity::critical_gap(), 100.0 * own->setting.critical_gap},
      {significant_column("its bound", "cm", 2, "critical_gap_bound_cm"),
       100.0 * own->setting.critical_gap_bound},
      {number_column("reference uncertain by", "K", 2, "reference_uncertainty_K"),
       variant.reference_uncertainty()},
      {number_column("processor time", "s", 1, "processor_time_s"), own->setting.processor_time},
      {named_text("cheapest with half the bound", "half_bound_setting"), half ? half->label : "none here"},
      {number_column("its time", "s", 1, "half_bound_processor_time_s"),
       half ? half->processor_time : not_a_number},
      {named_text("most distant setting", "most_distant_setting"), worst->setting.label},
      {number_column("its distance", "K", 2, "most_distant_K"), worst->largest_temperature_error}};
  if (found == nullptr) {
    const std::string reason =
        variant.reference ? "its own setting did not run soundly" : variant.no_reference;
    fields.front().cell = variant.name + ": " + reason;
    for (std::size_t i = 1; i < fields.size(); ++i) fields[i].cell = {};
  }
  return fields;
}

}  // namespace

Table reference_table(const AccuracyResult& result) {
  return quantity_table(result, [](QuantityTable& to, const AccuracyReference& reference) {
    const study::Study& study = to.variant.study.study;
    for (std::size_t gap = 0; gap < study.gaps.size(); ++gap) {
      const std::string at = " at " + gap_text(study.gaps[gap]) + " cm";
      to.add((reference.inert[gap] ? "T max without reaction" : "T max") + at, "K", 1.0,
             reference.temperature[gap]);
      to.add("ignition time" + at, "ms", 1e3, reference.ignition_time[gap]);
    }
    to.add("critical gap", "cm", 100.0, reference.critical_gap);
    to.add("peak pressure of the charge bottom", "MPa", 1e-6, reference.peak_pressure);
    for (std::size_t i = 0; i < reference.at_times.size(); ++i)
      to.add(fmt::format("T without reaction at {:.6g} ms, gap {} cm",
                         1e3 * accuracy_settings(study).times[i], gap_text(study.gaps.front())),
             "K", 1.0, reference.at_times[i]);
  });
}

Table point_table(const AccuracyResult& result) {
  return quantity_table(result, [](QuantityTable& to, const AccuracyReference& reference) {
    const std::string gap = ", gap " + gap_text(to.variant.study.study.gaps.front()) + " cm";
    for (std::size_t i = 0; i < reference.points.size(); ++i)
      to.add(to.variant.rows.front().points[i].name + gap, "K", 1.0, reference.points[i]);
  });
}

Table setting_table(const AccuracyResult& result) {
  Table table = table_with(result, {named_text("setting", "setting")});
  table.title = "Error against run time";
  for (const VariantAccuracy& variant : result.variants) {
    if (!variant.reference) continue;
    for (const AccuracyRow& row : variant.rows) {
      std::vector<Field> fields = start_of_row(result, variant);
      add_setting(variant, row, fields);
      add_row(table, std::move(fields));
    }
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
  for (const VariantAccuracy& variant : result.variants) add_row(table, variant_fields(variant));
  table.notes.push_back(
      "A bound is the distance from the finest grid and the uncertainty of the reference, the largest over "
      "the gaps; a distance is that from the limit of the grids, or from the finest where no limit is "
      "justified, and of settings with a validity warning too.");
  return table;
}

}  // namespace launchsafe::kinds
