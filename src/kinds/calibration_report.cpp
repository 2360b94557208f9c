// Tables, page and files of a calibration.
#include "calibration_parts.hpp"
#include "launchsafe/report/case_tables.hpp"

namespace launchsafe::kinds {

using keys::megapascal;
using study::fitted_keys, study::StationConvergence;

namespace {

std::string calibration_remark(const CalibrationRow& row) {
  if (!row.failure.empty()) return row.failure;
  return row.calibratable ? std::string{}
                          : "not calibratable at gap 0; with the scene's exchange time and T1";
}

/// Whether the calibrated ignition temperature lies in the published bracket.
std::string bracket_check(const Study& study, const CalibrationRow& row) {
  const double value = row.calibrated.constants.ignition_temperature;
  const auto& own = settings_of<CalibrationSettings>(study);
  if (!std::isfinite(value) || !std::isfinite(own.ignition_lowest)) return {};
  return value >= own.ignition_lowest && value <= own.ignition_highest ? "inside" : "outside";
}

/// What tells one calibration from another.
const Quantities<CalibrationRow> calibration_setting_quantities{
    {quantity::cell_size, &CalibrationRow::cell_size},
    {quantity::closure, [](const CalibrationRow& row) { return study::to_string(row.closure); }},
    {quantity::kinetics, &CalibrationRow::kinetics}};

const Quantities<SurfaceConstants> constant_quantities{
    {quantity::localisation, &SurfaceConstants::localisation},
    {quantity::exchange_time, &SurfaceConstants::exchange_time},
    {quantity::ignition_temperature, &SurfaceConstants::ignition_temperature}};

Quantities<CalibrationRow> calibration_quantities(const Study& study) {
  const auto left_over = [](const char* name, const char* heading, const char* meaning) {
    return for_programs(
        Column{std::string(name) + "_computed_minus_published", heading, fixed(2, kelvin), meaning});
  };
  return joined<CalibrationRow>(
      {calibration_setting_quantities,
       of_part<CalibrationRow>(constant_quantities, &CalibrationRow::calibrated,
                               &CalibratedConstants::constants),
       {{"ignition_lowest", "T1 from", fixed(2, kelvin), "T max, untriggered, of the largest safe gap.",
         &CalibrationRow::calibrated, &CalibratedConstants::ignition_lowest},
        {"ignition_highest", "to", fixed(2, kelvin), "T max, untriggered, of the smallest igniting gap.",
         &CalibrationRow::calibrated, &CalibratedConstants::ignition_highest},
        {"published_bracket", "published bracket", text(), "Whether T1 lies in the published bracket.",
         [study](const CalibrationRow& row) { return bracket_check(study, row); }},
        {left_over("zero_gap", "without gap", "What the fit leaves of T max without a gap."),
         &CalibrationRow::calibrated, &CalibratedConstants::zero_gap_misfit},
        {left_over("wide_gap", "wide gap", "What the fit leaves of T max at the wide gap."),
         &CalibrationRow::calibrated, &CalibratedConstants::wide_gap_misfit},
        {"rms", "RMS", fixed(2, kelvin), "Root mean square over temperatures that nothing was fitted to.",
         &CalibrationRow::root_mean_square},
        {"spread_rms", "RMS of spreads", fixed(2, kelvin), "The same over the spreads.",
         &CalibrationRow::spread_root_mean_square},
        {quantity::selection_rms, &CalibrationRow::selection_root_mean_square},
        {"remark", "remark", text(), "What is to be known of the row.", calibration_remark}}});
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
          {"line_minus_published", "line - published", fixed(2),
           "The same of a straight line through the two fitted rows, the rival of the model.",
           [](const ComparedNumber& row) { return row.line - row.published; }},
          {quantity::used_for, &ComparedNumber::use}};
}

/// Every published number beside what one row computes: with what it was used for, and the model's rival.
Table compared_table(const CalibrationResult& result, const CalibrationRow& row) {
  Row facts{{"places", Row::array()}, {"without_rows", result.study.study.references.empty()}};
  for (const Placement& each : row.placements)
    facts["places"].push_back(
        fmt::format("{} at {} {} ({})", each.quantity, centimetres(each.gap), each.computed, each.published));
  return table_of(fmt::format("Against the published results: {}, {}, {}",
                              in_words(row.cell_size, quantity::cell_size.form),
                              study::to_string(row.closure), row.kinetics),
                  compared_quantities(), row.compared, said("calibration.note.compared", facts));
}

const Quantities<SelectionMisfit> selection_quantities{
    {quantity::subject, &SelectionMisfit::quantity},
    {"computed_minus_published", "computed - published", fixed(2, kelvin), "Difference.",
     &SelectionMisfit::misfit}};

const Quantities<Convergence> convergence_quantities{
    {quantity::closure, [](const Convergence& each) { return study::to_string(each.closure); }},
    {quantity::kinetics, &Convergence::kinetics},
    {"localisation_change", "localisation", fixed(1, percent), "Change from the coarsest to the finest mesh.",
     &Convergence::localisation_change},
    {"exchange_time_change", "exchange time", fixed(1, percent), "The same of the exchange time.",
     &Convergence::exchange_time_change}};

const Quantities<Placement> placement_quantities{
    {quantity::subject, &Placement::quantity},
    {quantity::gap, &Placement::gap},
    {"computed", "computed", text(), "Station where it was computed.", &Placement::computed},
    {"published", "published", text(), "Where it was published to be.", &Placement::published}};

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

struct FittedRow {
  const FittedLoad* load;
  std::size_t place;
};

Quantities<FittedRow> fitted_quantities() {
  Quantities<FittedRow> quantities{
      {"key", "key", text(), "Key of the scene.",
       [](const FittedRow& row) { return std::string(fitted_keys[row.place]); }},
      {"standard_deviation", "standard deviation", fixed(2, percent), "Of its logarithm.",
       [](const FittedRow& row) { return row.load->deviation(row.place); }}};
  for (std::size_t other = 0; other < fitted_keys.size(); ++other) {
    const std::string key(fitted_keys[other]);
    quantities.emplace_back(
        "correlation_" + key, "with " + key, fixed(2), "Correlation with it.",
        [other](const FittedRow& row) { return row.load->correlation(row.place, other); });
  }
  return quantities;
}

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
      {"base_change", "change of the base", significant(2, megapascal),
       "By which load.base would move as a sixth unknown.", &FittedLoad::base, &math::AddedUnknown::change},
      {"base_gain", "gain", significant(2), "By which the sum of squares would fall.", &FittedLoad::base,
       &math::AddedUnknown::gain},
      {"runs", "runs", count(), "Mechanical runs that it took.", &FittedLoad::runs},
      {quantity::reason, &FittedLoad::failure}};
  Row json = json_of(quantities, *result.load);
  json["covariance_of_logarithms"] = result.load->covariance;
  json["frozen_at"] = settings_of<CalibrationSettings>(result.study).frozen_at;
  return json;
}

Table fitted_table(const CalibrationResult& result) {
  if (!has_load(result)) return {};
  std::vector<FittedRow> rows;
  for (std::size_t i = 0; i < fitted_keys.size(); ++i) rows.push_back({&*result.load, i});
  return table_of("How well the calibrated rows determine what is fitted", fitted_quantities(), rows,
                  said("calibration.note.fitted"));
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
  report.add({fitted_table(result), "", "fitted"});
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
                       calibration_quantities(result.study.study), result.rows,
                       said("calibration.note.calibrations")),
              "calibration.csv", "calibrations"});
  // By which a model is chosen among others.
  if (recommended != nullptr && recommended->selection.size() > 1)
    report.add(
        {table_of("Differences that choose among models", selection_quantities, recommended->selection,
                  said("calibration.note.selection", {{"rms_K", recommended->selection_root_mean_square}})),
         "", "selection", Shown::page});
  report.add({table_of("From the coarsest to the finest mesh", convergence_quantities, result.convergence),
              "", "convergence"});
  // Of the row that is recommended; the file has all.
  if (recommended != nullptr) report.add({compared_table(result, *recommended)});
  report.add({table_of_all(result.rows, compared_quantities(), &CalibrationRow::compared), "compared.csv",
              "compared", Shown::file});
  report.add({table_of_all(result.rows, placement_quantities, &CalibrationRow::placements), "", "placements",
              Shown::file});
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
          {table_of({}, fitted_quantities(), {}), "", "fitted"},
          {table_of({}, calibration_quantities({}), {}), "calibration.csv", "calibrations"},
          {table_of({}, selection_quantities, {}), "", "selection"},
          {table_of({}, convergence_quantities, {}), "", "convergence"},
          {table_of_all({}, compared_quantities(), &CalibrationRow::compared), "compared.csv", "compared"},
          {table_of_all({}, placement_quantities, &CalibrationRow::placements), "", "placements"},
          {report::run_table({}), "", "runs"}};
}

}  // namespace launchsafe::kinds
