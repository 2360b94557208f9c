#include "calibration_load_report.hpp"

#include "calibration_numbers.hpp"
#include "kind_texts.hpp"
#include "launchsafe/report/case_tables.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"

#include <fmt/format.h>

namespace launchsafe::kinds {

using report::Quantities;
using study::fitted_keys;
namespace quantity = report::quantity;

namespace {

bool has_load(const CalibrationResult& result) { return result.load && result.load->failure.empty(); }

/// One of the fitted keys.
struct FittedRow {
  const FittedLoad* load;
  std::size_t place;
};

Quantities<FittedRow> fitted_quantities() {
  Quantities<FittedRow> quantities{
      {{"key", "key", keys::text(), "Key of the scene."},
       [](const FittedRow& row) { return std::string(fitted_keys[row.place]); }},
      {{"standard_deviation", "standard deviation", keys::fixed(2, keys::percent), "Of its logarithm."},
       [](const FittedRow& row) { return row.load->deviation(row.place); }}};
  for (std::size_t other = 0; other < fitted_keys.size(); ++other) {
    const std::string key(fitted_keys[other]);
    quantities.emplace_back(
        report::Column{"correlation_" + key, "with " + key, keys::fixed(2), "Correlation with it."},
        [other](const FittedRow& row) { return row.load->correlation(row.place, other); });
  }
  return quantities;
}

}  // namespace

std::vector<report::Column> fitted_columns() { return keys::described(fitted_quantities()); }

report::Table fitted_table(const CalibrationResult& result) {
  if (!has_load(result)) return {};
  std::vector<FittedRow> rows;
  for (std::size_t i = 0; i < fitted_keys.size(); ++i) rows.push_back({&*result.load, i});
  report::Table table =
      report::table_of("How well the calibrated rows determine what is fitted", fitted_quantities(), rows);
  table.notes = said("calibration.note.fitted");
  return table;
}

std::string fit_text(const CalibrationResult& result) {
  if (!has_load(result)) return {};
  report::Row facts = load_json(result);
  facts.update(
      {{"temperature_weight_K", temperature_weight},
       {"instant_weight_ms", report::shown_value(instant_weight, keys::significant(6, keys::millisecond))}});
  return said_below("calibration.fit", facts);
}

std::string misfits_text(const CalibrationResult& result) {
  if (result.recommended() == nullptr) return {};
  const MisfitBound misfits = misfit_bound(*result.recommended());
  return said_below("calibration.misfits", {{"count", misfits.count},
                                            {"root_mean_square_K", misfits.root_mean_square},
                                            {"factor", misfits.factor},
                                            {"bound_K", misfits.bound()}});
}

nlohmann::ordered_json load_json(const CalibrationResult& result) {
  if (!result.load) return nullptr;
  const Quantities<FittedLoad> quantities{
      {quantity::load_peak_time(), &FittedLoad::peak_time},
      {quantity::load_width(), &FittedLoad::width},
      {quantity::load_steepness(), &FittedLoad::steepness},
      {{"numbers", "numbers", keys::count(), "Published numbers that were fitted to."}, &FittedLoad::numbers},
      {{"sum_of_squares", "sum of squares", keys::fixed(2), "Of what is left, over the weights."},
       &FittedLoad::sum_of_squares},
      {{"condition", "condition", keys::fixed(0), "Of the fit, in logarithms."}, &FittedLoad::condition},
      {{"base_change", "change of the base", keys::significant(2, keys::megapascal),
        "By which load.base would move as a sixth unknown."},
       &FittedLoad::base_change},
      {{"base_gain", "gain", keys::significant(2), "By which the sum of squares would fall."},
       &FittedLoad::base_gain},
      {{"runs", "runs", keys::count(), "Mechanical runs that it took."}, &FittedLoad::runs},
      {quantity::reason(), &FittedLoad::failure}};
  nlohmann::ordered_json json = report::json_of(quantities, *result.load);
  json["covariance_of_logarithms"] = result.load->covariance;
  json["frozen_at"] = settings_of<CalibrationSettings>(result.study.study).frozen_at;
  return json;
}

}  // namespace launchsafe::kinds
