// Tables, page and files of a calibration.
#include "calibration_parts.hpp"
#include "launchsafe/report/case_tables.hpp"

namespace launchsafe::kinds {

using study::StationConvergence;

namespace {

/// What tells one calibration from another.
const Quantities<CalibrationRow> calibration_setting_quantities{
    {quantity::cell_size, &CalibrationRow::cell_size},
    {quantity::closure, [](const CalibrationRow& row) { return study::to_string(row.closure); }}};

const Quantities<SurfaceConstants> constant_quantities{
    {quantity::localisation, &SurfaceConstants::localisation},
    {quantity::exchange_time, &SurfaceConstants::exchange_time},
    {quantity::ignition_temperature, &SurfaceConstants::ignition_temperature}};

Quantities<CalibrationRow> calibration_quantities() {
  return joined<CalibrationRow>(
      {calibration_setting_quantities,
       of_part<CalibrationRow>(constant_quantities, &CalibrationRow::calibrated,
                               &CalibratedConstants::constants),
       {{"ignition_lowest", "T1 from", fixed(2, kelvin), "T max, untriggered, of the largest safe gap.",
         &CalibrationRow::calibrated, &CalibratedConstants::ignition_lowest},
        {"ignition_highest", "to", fixed(2, kelvin), "T max, untriggered, of the smallest igniting gap.",
         &CalibrationRow::calibrated, &CalibratedConstants::ignition_highest},
        {"rms", "RMS", fixed(2, kelvin), "Root mean square over temperatures that nothing was fitted to.",
         &CalibrationRow::root_mean_square},
        {"remark", "remark", text(), "Why there are no constants.", &CalibrationRow::failure}}});
}

/// Numbers are in the unit of the row.
Quantities<ComparedNumber> compared_quantities() {
  const auto form = [](const ComparedNumber& row) { return fixed(2, row.in_seconds ? millisecond : kelvin); };
  const auto in_unit = [form](auto member) {
    return [=](const ComparedNumber& row) { return shown_value(std::invoke(member, row), form(row)); };
  };
  return {{quantity::subject, &ComparedNumber::quantity},
          {quantity::gap, &ComparedNumber::gap},
          {"computed", "computed", fixed(2), "Computed number.", in_unit(&ComparedNumber::computed)},
          {keys::always({"published", "published", fixed(2), "Published number."}),
           in_unit(&ComparedNumber::published)},
          {"computed_minus_published", "computed - published", fixed(2), "Their difference.",
           in_unit(&ComparedNumber::misfit)},
          {quantity::unit, [form](const ComparedNumber& row) { return form(row).unit; }},
          {quantity::used_for, &ComparedNumber::use}};
}

/// Every published number beside what one row computes: with what it was used for, and the model's rival.
Table compared_table(const CalibrationResult& result, const CalibrationRow& row) {
  const Row facts{{"without_rows", result.study.study.references.empty()}};
  return table_of(
      fmt::format("Against the published results: {}, {}", in_words(row.cell_size, quantity::cell_size.form),
                  study::to_string(row.closure)),
      compared_quantities(), row.compared, said("calibration.note.compared", facts));
}

Row stations_json(const StationConvergence& stations) {
  Row json = json_of<StationConvergence>(
      {{named("change_to_finer", quantity::change_to_finer), &StationConvergence::finer},
       {named("change_from_coarser", quantity::change_from_coarser), &StationConvergence::coarser}},
      stations);
  json["converge"] = stations.converges();
  return json;
}

/// What `list` of all rows has, in one table, for other programs.
template <class Compared>
Table table_of_all(const std::vector<CalibrationRow>& rows, const Quantities<Compared>& quantities,
                   std::vector<Compared> CalibrationRow::*list) {
  return table_of({}, with_whole(calibration_setting_quantities, quantities), parts_of<Compared>(rows, list));
}

/// A constant that was calibrated, beside that of the scene.
struct ConstantRow {
  std::string key, calibrated, in_scene;
  double difference = not_a_number;  ///< as a share of the calibrated one
};

const Quantities<ConstantRow> scene_quantities{
    {"key", "key", text(), "Key of the scene.", &ConstantRow::key},
    {"calibrated", "calibrated", text(), "Its calibrated value.", &ConstantRow::calibrated},
    {"in_the_scene_now", "in the scene now", text(), "What the scene has.", &ConstantRow::in_scene},
    {"difference", "difference", fixed(2, percent), "By how much the scene's is above the calibrated.",
     &ConstantRow::difference}};

bool has_load(const CalibrationResult& result) { return result.load && result.load->failure.empty(); }

Row load_json(const CalibrationResult& result) {
  if (!result.load) return nullptr;
  const Quantities<FittedLoad> quantities{
      {quantity::load_peak_time, &FittedLoad::bell, &Load::peak_time},
      {quantity::load_width, &FittedLoad::bell, &Load::width},
      {quantity::load_steepness, &FittedLoad::bell, &Load::steepness},
      {"numbers", "numbers", count(), "Published numbers that were fitted to.", &FittedLoad::numbers},
      {"sum_of_squares", "sum of squares", fixed(2), "Of what is left, over the weights.",
       &FittedLoad::sum_of_squares},
      {"condition", "condition", fixed(0), "Of the fit, in logarithms.", &FittedLoad::condition},
      {"runs", "runs", count(), "Mechanical runs that it took.", &FittedLoad::runs},
      {quantity::reason, &FittedLoad::failure}};
  Row json = json_of(quantities, *result.load);
  json["covariance_of_logarithms"] = result.load->covariance;
  json["frozen_at"] = settings_of<CalibrationSettings>(result.study).frozen_at;
  return json;
}

std::string fit_text(const CalibrationResult& result) {
  if (!has_load(result)) return {};
  Row facts = load_json(result);
  facts.update({{"temperature_weight_K", temperature_weight},
                {"instant_weight_ms", shown_value(instant_weight, significant(6, millisecond))}});
  return said_below("calibration.fit", facts);
}

}  // namespace

Table run_table(const std::vector<CalibrationRun>& runs) {
  return report::run_table(of_each(runs, [](const CalibrationRun& each) {
    return report::NamedRun{each.input.label, each.failure, &each.mechanics(), {}};
  }));
}

Table constants_table(const CalibrationResult& result) {
  if (!result.recommended()) return {};
  const CalibrationRow& row = *result.recommended();
  const SurfaceConstants &fitted = row.calibrated.constants, &now = result.in_scene;
  std::vector<ConstantRow> rows{{"friction.closure", study::to_string(row.closure),
                                 study::to_string(result.study.scene.scene.surface.friction)}};
  const auto add = [&rows](std::string key, double value, double held, const keys::Unit& unit = {}) {
    rows.push_back({std::move(key), in_words(value, significant(6, unit)),
                    in_words(held, significant(6, unit)), (held - value) / value});
  };
  add("friction.localisation", fitted.localisation, now.localisation);
  add("gap.exchange_time", fitted.exchange_time, now.exchange_time, millisecond);
  if (has_load(result)) {
    const Load &bell = *result.load->bell, &held = result.study.scene.scene.load;
    add("load.peak_time", bell.peak_time, held.peak_time, millisecond);
    add("load.width", bell.width, held.width, millisecond);
    add("load.steepness", bell.steepness, held.steepness);
  }
  add("kinetics.ignition_temperature", fitted.ignition_temperature, now.ignition_temperature, kelvin);
  return table_of("Constants the scene should hold", scene_quantities, rows,
                  said("calibration.note.constants", json_of(calibration_setting_quantities, row)));
}

std::string answer(const CalibrationResult& result) {
  Row facts{{"reason", result.reason}, {"load", load_json(result)}};
  if (const CalibrationRow* row = result.recommended()) {
    facts["row"] = json_of(calibration_setting_quantities, *row);
    facts["row"].update(json_of(constant_quantities, row->calibrated.constants));
  }
  return said("calibration.answer", facts).front();
}

Report report_of(const CalibrationResult& result) {
  Report report{result.study.study.title, answer(result), report::remaking_command(result.study)};
  if (const auto record = record_of(result))
    report.files.push_back({"calibration.json", study::to_json_text(*record)});
  report.say(said_below("calibration.stations", stations_json(result.stations)));
  report.add({constants_table(result), "", "constants"});
  report.say(fit_text(result));
  const CalibrationRow* recommended = result.recommended();
  if (recommended != nullptr) {
    const MisfitBound misfits = misfit_bound(*recommended);
    report.say(said_below("calibration.misfits", {{"count", misfits.count},
                                                  {"root_mean_square_K", misfits.root_mean_square},
                                                  {"factor", misfits.factor},
                                                  {"bound_K", misfits.bound()}}));
  }
  report.add({table_of("Calibrated constants, and how far they miss what nothing was fitted to",
                       calibration_quantities(), result.rows, said("calibration.note.calibrations")),
              "calibration.csv", "calibrations"});
  // Of the row that is recommended; the file has all.
  if (recommended != nullptr) report.add({compared_table(result, *recommended)});
  report.add({table_of_all(result.rows, compared_quantities(), &CalibrationRow::compared), "compared.csv",
              "compared", Shown::file});
  report.say("## Setup\n\n" + report::setup_text(result.study));
  report.add({run_table(result.runs), "", "runs", Shown::page});
  report.say(report::timing_sentence(result.timing));
  Row recommendation{{"reason", result.reason}, {"row", nullptr}};
  if (result.recommended_row) recommendation["row"] = *result.recommended_row;
  Row in_scene{{"closure", study::to_string(result.study.scene.scene.surface.friction)}};
  in_scene.update(json_of(constant_quantities, result.in_scene));
  report.json = study_json(result.study, report,
                           {{"recommendation", recommendation},
                            {"in_scene", in_scene},
                            {"load", load_json(result)},
                            {"stations", stations_json(result.stations)},
                            {"timing", report::timing_json(result.timing)}});
  return report;
}

std::vector<ReportTable> calibration_results() {
  return {{table_of({}, scene_quantities, {}), "", "constants"},
          {table_of({}, calibration_quantities(), {}), "calibration.csv", "calibrations"},
          {table_of_all({}, compared_quantities(), &CalibrationRow::compared), "compared.csv", "compared"},
          {report::run_table({}), "", "runs"}};
}

}  // namespace launchsafe::kinds
