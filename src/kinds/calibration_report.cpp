// Tables, page and files of a calibration.
#include "calibration_parts.hpp"
#include "launchsafe/report/case_tables.hpp"

namespace launchsafe::kinds {
namespace {

/// A constant that was fitted, as people read it.
struct ConstantRow {
  std::string key, fitted, start;
  double deviation = not_a_number;  ///< standard deviation of its logarithm
};

const Quantities<ConstantRow> constant_quantities{
    {"key", "key", text(), "Key of the scene, or of a face of the charge.", &ConstantRow::key},
    {"fitted", "fitted", text(), "Its fitted value.", &ConstantRow::fitted},
    {"deviation", "standard deviation", fixed(2, percent), "How well the rows determine it.",
     &ConstantRow::deviation},
    {"start", "start", text(), "Where the search started.", &ConstantRow::start}};

/// Numbers are in the unit of the row.
const Quantities<FittedNumber> number_quantities{
    {quantity::gap, &FittedNumber::gap},
    {quantity::subject, &FittedNumber::quantity},
    {"computed", "computed", fixed(2), "Computed number.", &FittedNumber::computed},
    {"published", "published", fixed(2), "Published number.", &FittedNumber::published},
    {"computed_minus_published", "computed - published", fixed(2), "Their difference.",
     &FittedNumber::misfit},
    {quantity::unit, &FittedNumber::unit},
    {quantity::used_for,
     [](const FittedNumber& row) { return row.is_fitted ? study::Use::fitted : study::Use::check; }}};

std::vector<ConstantRow> constant_rows(const CalibrationResult& result) {
  std::vector<ConstantRow> rows;
  if (!result.constants) return rows;
  const std::size_t count = result.fitted.size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [name, key, start] = result.fitted[i];
    rows.push_back({name, scene::format_value(key, result.constants->values.at(name)),
                    scene::format_value(key, start),
                    std::sqrt(result.constants->covariance[i * (count + 1)])});
  }
  return rows;
}

/// The published numbers whose quantity begins so; of several of one quantity that which is missed most.
Row numbers_json(const Constants& constants, const std::string& begin) {
  Row list = Row::array();
  for (const FittedNumber& row : constants.rows) {
    const auto is_worse = [&](const FittedNumber& other) {
      return other.quantity == row.quantity && std::abs(other.misfit()) > std::abs(row.misfit());
    };
    if (row.quantity.starts_with(begin) && std::ranges::none_of(constants.rows, is_worse))
      list.push_back(json_of(number_quantities, row));
  }
  return list;
}

/// Where the charge's bottom is hottest without a gap, and where that was published to be.
Row places_json(const CalibrationResult& result) {
  const Scene& scene = result.constants->scene;
  const BottomTrace& trace = result.run.result.mechanics.trace;
  const auto history = surface::integrate_skin(surface::skin_model(scene), trace, 0.0);
  Row list = Row::array();
  for (const Reference& row : result.study.study.references)
    for (const auto& [time, place] : {std::pair{scene::read_time(scene.load), row.point},
                                      std::pair{result.study.study.early_time, row.early_point}}) {
      const trace::Station* published = keys::find_named(trace.stations, place);
      if (row.gap != 0.0 || published == nullptr) continue;
      const std::size_t hottest = surface::maximum_at_time(history, trace, time).station;
      list.push_back({{"time", report::milliseconds(time)},
                      {"computed", report::centimetres(trace.stations[hottest].r)},
                      {"published", report::centimetres(published->r)}});
    }
  return list;
}

/// What was found, for programs.
Row facts_of(const CalibrationResult& result) {
  Row facts{{"failure", result.failure}};
  if (!result.constants) return facts;
  const Constants& constants = *result.constants;
  for (const ConstantRow& row : constant_rows(result))
    facts["constants"].push_back(row.key + " " + row.fitted);
  facts.update({{"file", constants.name},
                {"lowest_K", constants.ignition_lowest},
                {"highest_K", constants.ignition_highest},
                {"middle_K", constants.scene.charge().kinetics.ignition_temperature},
                {"numbers", result.fit.residuals.size()},
                {"sum_of_squares", result.fit.sum_of_squares()},
                {"condition", result.fit.condition},
                {"temperatures", numbers_json(constants, "T at ")},
                {"spreads", numbers_json(constants, "spread")},
                {"places", places_json(result)},
                {"ignition", numbers_json(constants, "ignition time")},
                {"safe", numbers_json(constants, "largest T")}});
  facts["safe"][0]["ignites"] =
      constants.rows.back().computed >= constants.scene.charge().kinetics.burnt_temperature;
  return facts;
}

/// Rows that the fit did not have, as lines of a list.
std::string check_text(const Row& facts) {
  std::string text;
  for (const Row& row : facts["temperatures"])
    text += fmt::format("- {} differs most from the published one at {:.6g} cm, by {:.1f} K.\n",
                        report::text_of(row, "quantity"), row["gap_cm"].get<double>(),
                        row["computed_minus_published"].get<double>());
  for (const Row& row : facts["places"])
    text += fmt::format("- Without a gap the charge is hottest {} from the axis at {}; published: {}.\n",
                        report::text_of(row, "computed"), report::text_of(row, "time"),
                        report::text_of(row, "published"));
  for (const auto& [key, unit, decimals] : {std::tuple{"spreads", "K", 1}, {"ignition", "ms", 2}})
    for (const Row& row : facts[key])
      text += fmt::format("- The {} at {:.6g} cm is {:.{}f} {}; published: {:.{}f} {}.\n",
                          report::text_of(row, "quantity"), row["gap_cm"].get<double>(),
                          row["computed"].get<double>(), decimals, unit, row["published"].get<double>(),
                          decimals, unit);
  for (const Row& row : facts["safe"])
    text += fmt::format("- {:.6g} cm, the largest gap that is published not to ignite, {}.\n",
                        row["gap_cm"].get<double>(), row["ignites"] == true ? "ignites" : "does not ignite");
  return text;
}

std::string fit_text(const Row& facts) {
  return fmt::format(
      "The keys are fitted to {} published numbers by least squares; what is left, over the weights, has a "
      "sum of squares of {:.2f}. The condition of the fit, in logarithms, is {:.0f}. The ignition "
      "temperature is the middle between {:.2f} K, the highest at the largest gap that does not ignite, and "
      "{:.2f} K, that of the smallest gap that does, when it does.\n",
      facts["numbers"].get<std::size_t>(), facts["sum_of_squares"].get<double>(),
      facts["condition"].get<double>(), facts["lowest_K"].get<double>(), facts["highest_K"].get<double>());
}

std::vector<ReportTable> tables_of(const CalibrationResult& result) {
  std::vector<report::NamedRun> runs;
  if (!result.label.empty())
    runs.push_back({result.label, result.run.failure, &result.run.result.mechanics, {}});
  const std::vector<FittedNumber> rows = result.constants.value_or(Constants{}).rows;
  return {
      {table_of("Constants that were fitted", constant_quantities, constant_rows(result)), "", "constants"},
      {table_of("Against the published results", number_quantities, rows), "compared.csv", "compared"},
      {report::run_table(runs), "", "runs", Shown::page}};
}

}  // namespace

std::string answer(const CalibrationResult& result) {
  if (!result.failure.empty()) return fmt::format("No constants: {}.", result.failure);
  if (!result.constants) return "No constants: nothing was computed.";
  std::string text;
  for (const ConstantRow& row : constant_rows(result)) text += row.key + " " + row.fitted + ", ";
  return fmt::format(
      "{}ignition temperature {}: {}.", text,
      in_words(result.constants->scene.charge().kinetics.ignition_temperature, significant(6, kelvin)),
      result.constants->name);
}

Report report_of(const CalibrationResult& result) {
  const Row facts = facts_of(result);
  Report report{result.study.study.title, answer(result), report::remaking_command(result.study)};
  const std::vector<ReportTable> tables = tables_of(result);
  if (result.constants) report.say(check_text(facts));
  report.add(tables[0]);
  if (result.constants) report.say(fit_text(facts));
  report.add(tables[1]);
  report.say("## Setup\n\n" + report::setup_text(result.study));
  report.add(tables[2]);
  report.say("This computation " + report::timing_text(result.timing) + ".\n");
  if (result.constants) report.files.push_back({result.constants->name, scene::to_toml(*result.constants)});
  report.json =
      study_json(result.study, report, {{"found", facts}, {"timing", report::timing_json(result.timing)}});
  return report;
}

std::vector<ReportTable> calibration_results() { return tables_of({}); }

}  // namespace launchsafe::kinds
