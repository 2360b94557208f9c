// The tables of an accuracy study.
#include "launchsafe/kinds/accuracy.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {

using study::RecordedSetting, study::ReferenceValue;

namespace {

const std::vector<double>& gaps_of(const VariantAccuracy& variant) { return variant.study.study.gaps; }
const std::vector<double>& times_of(const VariantAccuracy& variant) {
  return settings_of<AccuracySettings>(variant.study).times;
}
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
  if (row.on_front) add("Pareto front");
  if (row.other_model) add("another model: a difference, no numerical error");
  return text;
}

using SettingRow = PartOf<VariantAccuracy, const AccuracyRow*>;

/// One of a list, of which there is one for every gap, or time, of the variant.
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

/// Of settings that are compared at gaps, of which some may ignite, and at instants.
Quantities<SettingRow> setting_quantities(const std::vector<double>& gaps,
                                          const std::vector<double>& igniting_gaps,
                                          const std::vector<double>& times) {
  const auto of_row = [](const Quantities<AccuracyRow>& quantities) {
    return of_part<SettingRow>(quantities, &SettingRow::part);
  };
  Quantities<SettingRow> of_times;
  for (const double time : times)
    of_times.emplace_back(
        for_programs(Column{"temperature_error_" + digits_of(time, significant(6, millisecond)) + "_ms",
                            "T error at " + milliseconds(time), fixed(2, kelvin),
                            "Error of the hottest point then, first gap, without reaction."}),
        of_list(&AccuracyRow::error_at_times, times_of, time));
  return joined<SettingRow>(
      {of_row({{"setting", "setting", text(), "What is set otherwise than in the scene.",
                &AccuracyRow::setting, &RecordedSetting::label},
               {"cell", "cell", significant(3, keys::millimetre),
                "Size of the charge's smallest cells, as computed.", &AccuracyRow::setting,
                &RecordedSetting::cell},
               {processor_time, &AccuracyRow::setting, &RecordedSetting::processor_time},
               {quantity::wall_time, &AccuracyRow::wall_time},
               {"particle_steps", "particle steps", significant(3), "Particles times steps.",
                &AccuracyRow::particle_steps},
               {quantity::memory, &AccuracyRow::memory}}),
       by_gap(gaps, "T error", "temperature_error", fixed(2, kelvin), &AccuracyRow::temperature_error),
       of_row({{temperature_bound, &AccuracyRow::setting, &RecordedSetting::temperature_bound},
               {quantity::critical_gap, &AccuracyRow::setting, &RecordedSetting::critical_gap},
               {"critical_gap_error", "its error", significant(2, centimetre),
                "Critical gap minus the reference.", &AccuracyRow::critical_gap_error},
               {critical_gap_bound, &AccuracyRow::setting, &RecordedSetting::critical_gap_bound},
               {"bottom_pressure_error", "p(t)", fixed(2, percent),
                "Relative L2 difference of the bottom pressure from the finest mesh.",
                &AccuracyRow::pressure_error},
               {"bottom_pressure_peak_error", "p peak", fixed(2, percent), "Relative error of its peak.",
                &AccuracyRow::peak_pressure_error}}),
       by_gap(igniting_gaps, "ignition", "ignition_time_error", fixed(3, millisecond),
              &AccuracyRow::ignition_time_error),
       of_times,
       of_row({{quantity::energy_drift, &AccuracyRow::answer, &CaseAnswer::run, &RunSummary::energy_drift},
               {for_programs(
                    Column{"is_scene", "of the scene", text(), "Whether it is the setting of the scene."}),
                &AccuracyRow::baseline},
               {"remark", "remark", text(), "What is to be known of the setting.", remark_of}})});
}

/// How wrong the own setting of a variant is: nothing but its name where that setting did not run soundly.
struct VariantRow {
  const VariantAccuracy* variant;
  const AccuracyRow* own;                       ///< nullptr where it did not run soundly
  const RecordedSetting* half_bound = nullptr;  ///< the cheapest with half the bound
  const AccuracyRow* most_distant = nullptr;
};

VariantRow variant_row(const VariantAccuracy& variant) {
  VariantRow row{&variant, variant.baseline()};
  if (row.own == nullptr) return row;
  row.half_bound = cheapest_within(variant.record, 0.5 * row.own->setting.temperature_bound);
  row.most_distant = row.own;
  for (const AccuracyRow& each : variant.rows)
    if (!each.other_model && each.largest_temperature_error > row.most_distant->largest_temperature_error)
      row.most_distant = &each;
  return row;
}

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
    {processor_time, &VariantRow::own, &AccuracyRow::setting, &RecordedSetting::processor_time},
    {"half_bound_setting", "cheapest with half the bound", text(),
     "The cheapest setting with half the bound.",
     [](const VariantRow& row) {
       if (row.half_bound != nullptr) return Cell(row.half_bound->label);
       return row.own != nullptr ? Cell(std::string("none here")) : Cell();
     }},
    {"half_bound_processor_time", "its time", fixed(1, second), "Its processor time.",
     &VariantRow::half_bound, &RecordedSetting::processor_time},
    {"most_distant_setting", "most distant setting", text(), "The setting farthest from the reference.",
     &VariantRow::most_distant, &AccuracyRow::setting, &RecordedSetting::label},
    {"most_distant", "its distance", fixed(2, kelvin), "Its distance of T max.", &VariantRow::most_distant,
     &AccuracyRow::largest_temperature_error}};

}  // namespace

Table reference_table(const AccuracyResult& result) {
  return quantity_table(result, [](const VariantAccuracy& variant, const auto& add) {
    const std::vector<double>& gaps = gaps_of(variant);
    const AccuracyReference& reference = *variant.reference;
    for (std::size_t gap = 0; gap < gaps.size(); ++gap) {
      const std::string at = " at " + centimetres(gaps[gap]);
      add((reference.inert[gap] ? "T max without reaction" : "T max") + at, quantity::temperature_max.form,
          reference.temperature[gap]);
      add("ignition time" + at, quantity::ignition_time.form, reference.ignition_time[gap]);
    }
    add("critical gap", quantity::critical_gap.form, reference.critical_gap);
    add("peak pressure of the charge bottom", quantity::pressure.form, reference.peak_pressure);
    for (std::size_t i = 0; i < reference.at_times.size(); ++i)
      add(fmt::format("T without reaction at {}, gap {}", milliseconds(times_of(variant)[i]),
                      centimetres(gaps.front())),
          quantity::temperature_max.form, reference.at_times[i]);
  });
}

Table point_table(const AccuracyResult& result) {
  return quantity_table(result, [](const VariantAccuracy& variant, const auto& add) {
    const std::string gap = ", gap " + centimetres(gaps_of(variant).front());
    for (std::size_t i = 0; i < variant.reference->points.size(); ++i)
      add(variant.rows.front().points[i].name + gap, quantity::temperature_max.form,
          variant.reference->points[i]);
  });
}

Table setting_table(const AccuracyResult& result) {
  const auto rows = parts_of<AccuracyRow>(result.variants, [](const VariantAccuracy& variant) {
    return variant.reference ? std::span(variant.rows) : std::span<const AccuracyRow>();
  });
  // A gap whose time can be compared ignites on all reference meshes.
  const auto igniting_gaps_of = [](const VariantAccuracy& variant) {
    std::vector<double> gaps;
    for (std::size_t i = 0; i < gaps_of(variant).size(); ++i)
      if (!variant.reference->ignition_time[i].values.empty()) gaps.push_back(gaps_of(variant)[i]);
    return gaps;
  };
  const auto quantities =
      setting_quantities(all_of_variants(result, gaps_of), all_of_variants(result, igniting_gaps_of),
                         all_of_variants(result, times_of));
  return table_of("Error against run time", with_variants(result, quantities, &SettingRow::whole), rows,
                  said("accuracy.note.settings"));
}

Table variant_table(const AccuracyResult& result) {
  return table_of("How wrong each variant is with its own setting", variant_quantities,
                  of_each(result.variants, variant_row), said("accuracy.note.variants"));
}

std::vector<ReportTable> accuracy_results() {
  const auto reference = keys::described(reference_quantities({1e-3}));
  return {{table_of({}, setting_quantities({0.0}, {0.0}, {1e-3}), {}), "accuracy.csv", "settings"},
          {table_of({}, variant_quantities, {}), "variants.csv", "variants"},
          {Table{.columns = reference}, "reference.csv", "reference"},
          {Table{.columns = reference}, "points.csv", "points"}};
}

}  // namespace launchsafe::kinds
