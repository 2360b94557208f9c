// The tables of an accuracy study.
#include "launchsafe/kinds/accuracy.hpp"
#include "study_keys.hpp"

namespace launchsafe::kinds {

namespace {

/// The value at a place; none where the list is shorter.
double value_at(const std::vector<double>& values, std::size_t place) {
  return place < values.size() ? values[place] : not_a_number;
}

/// A compared quantity, and what the reference meshes say of it.
struct ReferenceRow {
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
  for (std::size_t mesh = 0; mesh < sizes.size(); ++mesh) {
    const std::string cells = digits_of(sizes[mesh], quantity::cell_size.form);
    quantities.emplace_back("cells_" + cells + "_mm", cells + " mm", significant(7),
                            "Value on that reference mesh.", [mesh](const ReferenceRow& row) {
                              return shown_value(value_at(row.value->values, mesh), row.what.form);
                            });
  }
  return joined<ReferenceRow>(
      {quantities,
       {{"order", "observed order", fixed(2),
         "Power of the cell size with which the value converges; none where no limit is justified.",
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

std::string remark_of_setting(const AccuracyRow& row) {
  if (!row.computed()) return row.result.failure;
  std::string text;
  const auto add = [&text](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (!row.sound()) add("validity warning: " + row.warnings());
  if (row.baseline) add("the scene as it is");
  if (row.reference_mesh) add("reference mesh");
  if (row.other_model) add("another model: a difference, no numerical error");
  return text;
}

const Column temperature_bound{"temperature_bound", "T bound", report::up(fixed(2, kelvin)),
                               "By how much T max may be off, over all gaps."};
const Column critical_gap_bound{"critical_gap_bound", "its bound", report::up(significant(2, centimetre)),
                                "By how much that may be off."};
const Column processor_time{"processor_time", "processor time", fixed(1, second), "Of the run."};

Quantities<AccuracyRow> temperature_errors(const std::vector<double>& gaps) {
  Quantities<AccuracyRow> quantities;
  for (std::size_t gap = 0; gap < gaps.size(); ++gap)
    quantities.emplace_back("temperature_error_" + digits_of(gaps[gap], quantity::gap.form) + "_cm",
                            "T error at " + centimetres(gaps[gap]), fixed(2, kelvin), "Error at that gap.",
                            [gap](const AccuracyRow& row) { return value_at(row.temperature_error, gap); });
  return quantities;
}

Quantities<AccuracyRow> setting_quantities(const std::vector<double>& gaps) {
  return joined<AccuracyRow>(
      {{{"setting", "setting", text(), "What is set otherwise than in the scene.", &AccuracyRow::label},
        {"cell", "cell", significant(3, keys::millimetre),
         "Size of the charge's smallest cells, as computed.", &AccuracyRow::cell},
        {processor_time, &AccuracyRow::processor_time}},
       temperature_errors(gaps),
       {{temperature_bound, &AccuracyRow::temperature_bound},
        {quantity::critical_gap, &AccuracyRow::critical_gap},
        {"critical_gap_error", "its error", significant(2, centimetre), "Critical gap minus the reference.",
         &AccuracyRow::critical_gap_error},
        {critical_gap_bound, &AccuracyRow::critical_gap_bound},
        {quantity::energy_drift, &AccuracyRow::result, &CaseRow::run, &study::RunRow::energy_drift},
        {for_programs(Column{"is_scene", "of the scene", text(), "Whether it is the setting of the scene."}),
         &AccuracyRow::baseline},
        {"remark", "remark", text(), "What is to be known of the setting.", remark_of_setting}}});
}

}  // namespace

Table reference_table(const AccuracyResult& result) {
  std::vector<ReferenceRow> rows;
  const auto add = [&rows](std::string heading, const Form& form, const ReferenceValue& value) {
    if (!value.values.empty()) rows.push_back({{.heading = std::move(heading), .form = form}, &value});
  };
  if (result.reference) {
    const AccuracyReference& reference = *result.reference;
    const std::vector<double>& gaps = result.study.study.gaps;
    for (std::size_t gap = 0; gap < gaps.size(); ++gap)
      add((reference.inert[gap] ? "T max without reaction at " : "T max at ") + centimetres(gaps[gap]),
          quantity::temperature_max.form, reference.temperature[gap]);
    add("critical gap", quantity::critical_gap.form, reference.critical_gap);
  }
  const auto& sizes = settings_of<AccuracySettings>(result.study).reference_cell_sizes;
  return table_of("Reference meshes", reference_quantities(sizes), rows);
}

Table setting_table(const AccuracyResult& result) {
  return table_of(
      "Error against run time", setting_quantities(result.study.study.gaps),
      result.reference ? result.rows : std::vector<AccuracyRow>(),
      {"Error: the setting's value minus the extrapolated one (minus that of the finest mesh where no "
       "extrapolation is justified). Bound: distance from the finest mesh plus its uncertainty, the "
       "largest over the gaps."});
}

std::vector<ReportTable> accuracy_results() {
  const auto reference = keys::described(reference_quantities({1e-3}));
  return {{table_of({}, setting_quantities({0.0}), {}), "accuracy.csv", "settings"},
          {Table{.columns = reference}, "reference.csv", "reference"}};
}

}  // namespace launchsafe::kinds
