#include "calibration_load_report.hpp"

#include "calibration_numbers.hpp"
#include "launchsafe/report/case_tables.hpp"
#include "launchsafe/report/number.hpp"
#include "launchsafe/report/quantities.hpp"

#include <fmt/format.h>

#include <cmath>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

bool has_load(const CalibrationResult& result) { return result.load && result.load->failure.empty(); }

}  // namespace

std::string load_sentence(const FittedLoad& load) {
  return fmt::format(" The load has its peak at {}, a width of {} and a steepness of {}.",
                     milliseconds(load.peak_time), milliseconds(load.width),
                     in_words(load.steepness, keys::significant(6)));
}

namespace {

/// One of the fitted keys.
struct FittedRow {
  const FittedLoad* load;
  std::size_t place;
};

Quantities<FittedRow> fitted_quantities() {
  Quantities<FittedRow> quantities{
      {{"key", "key", keys::text(), "Key of the scene."},
       [](const FittedRow& row) { return std::string(fitted_keys[row.place]); }},
      {{"standard_deviation", "standard deviation", keys::fixed(2, percent), "Of its logarithm."},
       [](const FittedRow& row) { return row.load->deviation(row.place); }}};
  for (std::size_t other = 0; other < fitted_keys.size(); ++other) {
    const std::string key(fitted_keys[other]);
    quantities.emplace_back(
        Column{"correlation_" + key, "with " + key, keys::fixed(2), "Correlation with it."},
        [other](const FittedRow& row) { return row.load->correlation(row.place, other); });
  }
  return quantities;
}

}  // namespace

std::vector<Column> fitted_columns() { return keys::described(fitted_quantities()); }

Table fitted_table(const CalibrationResult& result) {
  if (!has_load(result)) return {};
  std::vector<FittedRow> rows;
  for (std::size_t i = 0; i < fitted_keys.size(); ++i) rows.push_back({&*result.load, i});
  Table table = table_of("How well the calibrated rows determine what is fitted", fitted_quantities(), rows);
  table.notes.push_back(
      "Correlations of their logarithms. The weights of the fit count as standard deviations of what is "
      "published, and larger ones where more than them is left.");
  return table;
}

std::string fit_text(const CalibrationResult& result) {
  if (!has_load(result)) return {};
  const FittedLoad& load = *result.load;
  std::string text = fmt::format(
      "The five are fitted to {} published numbers by least squares, with weights of {} and {}. What is "
      "left has a sum of squares of {:.2f}; the condition of the fit, in their logarithms, is {:.0f}. It "
      "took {} "
      "mechanical runs.",
      load.numbers, in_words(temperature_weight, keys::significant(6, kelvin)), milliseconds(instant_weight),
      load.sum_of_squares, load.condition, load.runs);
  const std::string& frozen = settings_of<CalibrationSettings>(result.study.study).frozen_at;
  if (!frozen.empty()) text += fmt::format(" Rule and weights were frozen before the fit, at {}.", frozen);
  if (std::isfinite(load.base_gain)) {
    text += fmt::format(
        " As a sixth unknown the pressure at the start, `load.base`, would change by {} and take "
        "{:.2g} "
        "from the sum of squares.",
        in_words(load.base_change, keys::significant(2, megapascal)), load.base_gain);
  }
  return text + "\n";
}

std::string misfits_text(const CalibrationResult& result) {
  if (result.recommended() == nullptr) return {};
  const MisfitBound misfits = misfit_bound(*result.recommended());
  if (misfits.count == 0) return {};
  return fmt::format(
      "The {} temperatures that nothing was fitted to are missed by {} (RMS). The largest of so few is "
      "no "
      "bound: with Student's factor for {}, {:.3f}, 95 % of such misfits are below {}. That, or half "
      "the "
      "distance of the two temperatures between which T1 lies if it is larger, is the fit uncertainty that "
      "the "
      "record gives to other studies.\n",
      misfits.count, in_words(misfits.root_mean_square, keys::significant(3, kelvin)), misfits.count,
      misfits.factor, in_words(misfits.bound(), keys::significant(3, kelvin)));
}

nlohmann::ordered_json load_json(const CalibrationResult& result) {
  if (!result.load) return nullptr;
  const Quantities<FittedLoad> quantities{
      {quantity::load_peak_time(), &FittedLoad::peak_time},
      {quantity::load_width(), &FittedLoad::width},
      {quantity::load_steepness(), &FittedLoad::steepness},
      {{"numbers", "numbers", count(), "Published numbers that were fitted to."}, &FittedLoad::numbers},
      {{"sum_of_squares", "sum of squares", keys::fixed(2), "Of what is left, over the weights."},
       &FittedLoad::sum_of_squares},
      {{"condition", "condition", keys::fixed(0), "Of the fit, in logarithms."}, &FittedLoad::condition},
      {{"base_change", "change of the base", keys::significant(2, megapascal),
        "By which load.base would move as a sixth unknown."},
       &FittedLoad::base_change},
      {{"base_gain", "gain", keys::significant(2), "By which the sum of squares would fall."},
       &FittedLoad::base_gain},
      {{"runs", "runs", count(), "Mechanical runs that it took."}, &FittedLoad::runs},
      {quantity::reason(), &FittedLoad::failure}};
  nlohmann::ordered_json json = json_of(quantities, *result.load);
  json["covariance_of_logarithms"] = result.load->covariance;
  json["frozen_at"] = settings_of<CalibrationSettings>(result.study.study).frozen_at;
  return json;
}

}  // namespace launchsafe::kinds
