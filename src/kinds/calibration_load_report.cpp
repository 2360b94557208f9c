#include "calibration_load_report.hpp"

#include "calibration_numbers.hpp"
#include "launchsafe/report/case_tables.hpp"
#include "launchsafe/report/number.hpp"

#include <fmt/format.h>

#include <cmath>

namespace launchsafe::kinds {

using namespace study;
using namespace report;
namespace {

bool has_load(const CalibrationResult& result) { return result.load && result.load->failure.empty(); }

}  // namespace

std::string load_sentence(const FittedLoad& load) {
  return fmt::format(" The load has its peak at {} ms, a width of {} ms and a steepness of {}.",
                     significant(1e3 * load.peak_time, 6), significant(1e3 * load.width, 6),
                     significant(load.steepness, 6));
}

Table fitted_table(const CalibrationResult& result) {
  Table table;
  if (!has_load(result)) return table;
  table.title = "How well the calibrated rows determine what is fitted";
  table.columns = {text_column("key"),
                   number_column("standard deviation", "%", 2, "standard_deviation_percent")};
  for (const std::string key : fitted_keys)
    table.columns.push_back(number_column("with " + key, "", 2, "correlation_" + key));
  for (std::size_t i = 0; i < fitted_keys.size(); ++i) {
    std::vector<Cell> cells{std::string(fitted_keys[i]), 100.0 * result.load->deviation(i)};
    for (std::size_t j = 0; j < fitted_keys.size(); ++j) cells.emplace_back(result.load->correlation(i, j));
    table.rows.push_back(std::move(cells));
  }
  table.notes.push_back(
      "Correlations of their logarithms. The weights of the fit count as standard deviations of what is "
      "published, and larger ones where more than them is left.");
  return table;
}

std::string fit_text(const CalibrationResult& result) {
  if (!has_load(result)) return {};
  const FittedLoad& load = *result.load;
  std::string text = fmt::format(
      "The five are fitted to {} published numbers by least squares, with weights of {} K and {} ms. What is "
      "left has a sum of squares of {:.2f}; the condition of the fit, in their logarithms, is {:.0f}. It "
      "took {} "
      "mechanical runs.",
      load.numbers, temperature_weight, 1e3 * instant_weight, load.sum_of_squares, load.condition, load.runs);
  const std::string& frozen = settings_of<CalibrationSettings>(result.study.study).frozen_at;
  if (!frozen.empty()) text += fmt::format(" Rule and weights were frozen before the fit, at {}.", frozen);
  if (std::isfinite(load.base_gain)) {
    text += fmt::format(
        " As a sixth unknown the pressure at the start, `load.base`, would change by {:.2g} MPa and take "
        "{:.2g} "
        "from the sum of squares.",
        1e-6 * load.base_change, load.base_gain);
  }
  return text + "\n";
}

std::string misfits_text(const CalibrationResult& result) {
  if (result.recommended() == nullptr) return {};
  const MisfitBound misfits = misfit_bound(*result.recommended());
  if (misfits.count == 0) return {};
  return fmt::format(
      "The {} temperatures that nothing was fitted to are missed by {:.3g} K (RMS). The largest of so few is "
      "no "
      "bound: with Student's factor for {}, {:.3f}, 95 % of such misfits are below {:.3g} K. That, or half "
      "the "
      "distance of the two temperatures between which T1 lies if it is larger, is the fit uncertainty that "
      "the "
      "record gives to other studies.\n",
      misfits.count, misfits.root_mean_square, misfits.count, misfits.factor, misfits.bound());
}

nlohmann::ordered_json load_json(const CalibrationResult& result) {
  if (!result.load) return nullptr;
  const FittedLoad& load = *result.load;
  return {{"peak_time_ms", number(1e3 * load.peak_time)},
          {"width_ms", number(1e3 * load.width)},
          {"steepness", number(load.steepness)},
          {"numbers", load.numbers},
          {"sum_of_squares", number(load.sum_of_squares)},
          {"condition", number(load.condition)},
          {"covariance_of_logarithms", load.covariance},
          {"base_change_MPa", number(1e-6 * load.base_change)},
          {"base_gain", number(load.base_gain)},
          {"runs", load.runs},
          {"frozen_at", settings_of<CalibrationSettings>(result.study.study).frozen_at},
          {"reason", load.failure}};
}

}  // namespace launchsafe::kinds
