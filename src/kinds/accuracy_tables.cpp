// The tables of an accuracy study.
#include "launchsafe/kinds/accuracy.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {

using study::RecordedSetting, study::ReferenceValue;

namespace {

const std::vector<double>& gaps_of(const VariantAccuracy& variant) { return variant.study.study.gaps; }
const std::vector<double>& cell_sizes_of(const VariantAccuracy& variant) {
  return settings_of<AccuracySettings>(variant.study).reference_cell_sizes;
}

/// The one that stands at the place of `key` in a list of keys; none where that is not there.
double value_at(const std::vector<double>& values, const std::vector<double>& keys, double key) {
  const auto place = static_cast<std::size_t>(std::ranges::find(keys, key) - keys.begin());
  return place < values.size() ? values[place] : not_a_number;
}

/// What all variants with a reference have, each once: they may differ.
template <class List>
std::vector<double> all_of_variants(const AccuracyResult& result, List list) {
  std::vector<double> all;
  for (const VariantAccuracy& variant : result.variants) {
    if (!variant.reference) continue;
    for (const double each : list(variant))
      if (std::ranges::find(all, each) == all.end()) all.push_back(each);
  }
  return all;
}

template <class Row>
Quantities<Row> with_variants(const AccuracyResult& result, const Quantities<Row>& quantities,
                              const VariantAccuracy* Row::*variant) {
  if (result.variants.size() == 1) return quantities;
  return joined<Row>({{{quantity::variant, variant, &VariantAccuracy::name}}, quantities});
}

/// A compared quantity, and what the reference meshes say of it.
struct ReferenceRow {
  const VariantAccuracy* variant;
  Column what;
  const ReferenceValue* value;

  /// Nothing where no limit is justified.
  const ReferenceRow* if_justified() const { return value->limit.justified ? this : nullptr; }
};

/// Numbers are in the unit of the row.
Quantities<ReferenceRow> reference_quantities(const std::vector<double>& sizes) {
  const auto in_unit = [](auto get) {
    return [get](const ReferenceRow& row) { return shown_value(get(*row.value), row.what.form); };
  };
  Quantities<ReferenceRow> quantities{{quantity::subject, &ReferenceRow::what, &Column::heading},
                                      {quantity::unit, &ReferenceRow::what, &Column::form, &Form::unit}};
  for (const double size : sizes) {
    const std::string cells = digits_of(size, quantity::cell_size.form);
    quantities.emplace_back(
        "cells_" + cells + "_mm", cells + " mm", significant(7), "Value on that reference mesh.",
        [size](const ReferenceRow& row) {
          return shown_value(value_at(row.value->values, cell_sizes_of(*row.variant), size), row.what.form);
        });
  }
  return joined<ReferenceRow>(
      {quantities,
       {{"order", "order", fixed(2), "Order at which the meshes converge; none where no limit is justified.",
         &ReferenceRow::if_justified, &ReferenceRow::value, &ReferenceValue::limit,
         &math::Extrapolation::order},
        {"extrapolated", "extrapolated", significant(7), "Limit of the meshes; none where none is justified.",
         &ReferenceRow::if_justified, in_unit([](const ReferenceValue& value) { return value.limit.value; })},
        {"uncertainty", "uncertainty", significant(2), "By how much the reference may be off.",
         in_unit([](const ReferenceValue& value) { return value.limit.uncertainty; })},
        {"method", "by", text(), "How the limit was found, or why there is none.",
         [](const ReferenceRow& row) {
           const math::Extrapolation& limit = row.value->limit;
           return limit.justified ? limit.method : "no extrapolation: " + limit.reason;
         }}}});
}

/// A table of quantities, of which `add_all` adds those of a variant with a reference by a function that
/// takes heading, form and value of each.
template <class AddAll>
Table quantity_table(const AccuracyResult& result, AddAll add_all) {
  std::vector<ReferenceRow> rows;
  for (const VariantAccuracy& variant : result.variants)
    if (variant.reference)
      add_all(variant, [&](std::string heading, const Form& form, const ReferenceValue& value) {
        if (!value.values.empty())
          rows.push_back({&variant, {.heading = std::move(heading), .form = form}, &value});
      });
  return table_of({},
                  with_variants(result, reference_quantities(all_of_variants(result, cell_sizes_of)),
                                &ReferenceRow::variant),
                  rows);
}

std::string remark_of(const AccuracyRow& row) {
  if (!row.computed()) return row.answer.failure;
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (!row.validity_warnings.empty()) add("validity warning: " + row.validity_warnings);
  if (row.baseline) add("the scene as it is");
  if (row.setting.reference) add("reference mesh");
  if (row.other_model) add("another model: a difference, no numerical error");
  return text;
}

using SettingRow = PartOf<VariantAccuracy, const AccuracyRow*>;

/// One of a list, of which there is one for every gap of the variant.
template <class Keys>
auto of_list(std::vector<double> AccuracyRow::*list, Keys keys, double key) {
  return [=](const SettingRow& row) { return value_at(row.part->*list, keys(*row.whole), key); };
}

const Column temperature_bound{"temperature_bound", "T bound", fixed(2, kelvin),
                               "By how much T max may be off, over all gaps."};
const Column critical_gap_bound{"critical_gap_bound", "its bound", significant(2, centimetre),
                                "By how much that may be off."};
const Column processor_time{"processor_time", "processor time", fixed(1, second), "Of the run."};

Quantities<SettingRow> by_gap(const std::vector<double>& gaps, const std::string& heading,
                              const std::string& name, const Form& form,
                              std::vector<double> AccuracyRow::*list) {
  Quantities<SettingRow> quantities;
  for (const double gap : gaps)
    quantities.emplace_back(name + "_" + digits_of(gap, quantity::gap.form) + "_cm",
                            heading + " at " + centimetres(gap), form, "Error at that gap.",
                            of_list(list, gaps_of, gap));
  return quantities;
}

Quantities<SettingRow> setting_quantities(const std::vector<double>& gaps) {
  const auto of_row = [](const Quantities<AccuracyRow>& quantities) {
    return of_part<SettingRow>(quantities, &SettingRow::part);
  };
  return joined<SettingRow>(
      {of_row({{"setting", "setting", text(), "What is set otherwise than in the scene.",
                &AccuracyRow::setting, &RecordedSetting::label},
               {"cell", "cell", significant(3, keys::millimetre),
                "Size of the charge's smallest cells, as computed.", &AccuracyRow::setting,
                &RecordedSetting::cell},
               {processor_time, &AccuracyRow::setting, &RecordedSetting::processor_time}}),
       by_gap(gaps, "T error", "temperature_error", fixed(2, kelvin), &AccuracyRow::temperature_error),
       of_row({{temperature_bound, &AccuracyRow::setting, &RecordedSetting::temperature_bound},
               {quantity::critical_gap, &AccuracyRow::setting, &RecordedSetting::critical_gap},
               {"critical_gap_error", "its error", significant(2, centimetre),
                "Critical gap minus the reference.", &AccuracyRow::critical_gap_error},
               {critical_gap_bound, &AccuracyRow::setting, &RecordedSetting::critical_gap_bound},
               {quantity::energy_drift, &AccuracyRow::answer, &CaseAnswer::run, &RunSummary::energy_drift},
               {for_programs(
                    Column{"is_scene", "of the scene", text(), "Whether it is the setting of the scene."}),
                &AccuracyRow::baseline},
               {"remark", "remark", text(), "What is to be known of the setting.", remark_of}})});
}

/// How wrong the own setting of a variant is: nothing but its name where that setting did not run soundly.
struct VariantRow {
  const VariantAccuracy* variant;
  const AccuracyRow* own;  ///< nullptr where it did not run soundly
};

VariantRow variant_row(const VariantAccuracy& variant) { return {&variant, variant.baseline()}; }

const Quantities<VariantRow> variant_quantities{
    {quantity::variant,
     [](const VariantRow& row) {
       if (row.own != nullptr) return row.variant->name;
       return row.variant->name + ": " +
              (row.variant->reference ? "its own setting did not run soundly" : row.variant->no_reference);
     }},
    {temperature_bound, &VariantRow::own, &AccuracyRow::setting, &RecordedSetting::temperature_bound},
    {"temperature_distance", "T distance", fixed(2, kelvin), "Distance of T max from the reference.",
     &VariantRow::own, &AccuracyRow::largest_temperature_error},
    {quantity::critical_gap, &VariantRow::own, &AccuracyRow::setting, &RecordedSetting::critical_gap},
    {critical_gap_bound, &VariantRow::own, &AccuracyRow::setting, &RecordedSetting::critical_gap_bound},
    {"reference_uncertainty", "reference uncertain by", fixed(2, kelvin),
     "By how much the reference of T max may itself be off.",
     [](const VariantRow& row) { return row.own ? row.variant->reference_uncertainty() : not_a_number; }},
    {processor_time, &VariantRow::own, &AccuracyRow::setting, &RecordedSetting::processor_time}};

}  // namespace

Table reference_table(const AccuracyResult& result) {
  return quantity_table(result, [](const VariantAccuracy& variant, const auto& add) {
    const std::vector<double>& gaps = gaps_of(variant);
    const AccuracyReference& reference = *variant.reference;
    for (std::size_t gap = 0; gap < gaps.size(); ++gap) {
      const std::string at = " at " + centimetres(gaps[gap]);
      add((reference.inert[gap] ? "T max without reaction" : "T max") + at, quantity::temperature_max.form,
          reference.temperature[gap]);
    }
    add("critical gap", quantity::critical_gap.form, reference.critical_gap);
  });
}

Table setting_table(const AccuracyResult& result) {
  const auto rows = parts_of<AccuracyRow>(result.variants, [](const VariantAccuracy& variant) {
    return variant.reference ? std::span(variant.rows) : std::span<const AccuracyRow>();
  });
  const auto quantities = setting_quantities(all_of_variants(result, gaps_of));
  return table_of("Error against run time", with_variants(result, quantities, &SettingRow::whole), rows,
                  said("accuracy.note.settings"));
}

Table variant_table(const AccuracyResult& result) {
  return table_of("How wrong each variant is with its own setting", variant_quantities,
                  of_each(result.variants, variant_row), said("accuracy.note.variants"));
}

std::vector<ReportTable> accuracy_results() {
  const auto reference = keys::described(reference_quantities({1e-3}));
  return {{table_of({}, setting_quantities({0.0}), {}), "accuracy.csv", "settings"},
          {table_of({}, variant_quantities, {}), "variants.csv", "variants"},
          {Table{.columns = reference}, "reference.csv", "reference"}};
}

}  // namespace launchsafe::kinds
