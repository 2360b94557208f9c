// What the samples of a sensitivity study say of the outputs themselves: quantiles, histograms, and how often
// the study's gap ignites. Only the samples of Saltelli's matrices A and B are draws from the distributions
// of the inputs; the mixed ones are made for differences.
#pragma once

#include "launchsafe/kinds/sensitivity.hpp"
#include "launchsafe/math/statistics.hpp"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace launchsafe::kinds {

/// The draws of one output.
struct OutputSample {
  /// SI, ascending. A critical gap that is no number is minus infinity where the launch ignites without a
  /// gap, and infinity where nothing ignites up to the end of the search: it has a rank and no value.
  std::vector<double> values;
  std::size_t missing = 0;  ///< draws of which nothing is known
  std::size_t ignites_at_zero() const;
  std::size_t none_ignites() const;
  /// The smallest draw that at least this share (0 to 1) of them does not exceed; NaN without draws.
  double quantile(double share) const;
};
OutputSample sample_of(const SensitivityResult& result, const OutputSensitivity& output);

/// The shares of the draws at which quantiles are told.
inline constexpr std::array quantile_shares{0.025, 0.05, 0.5, 0.95, 0.975};

/// How many draws ignite at the study's gap.
struct IgnitionShare {
  std::size_t igniting = 0, completed = 0, failed = 0;
  /// Of the probability, 95 %: its ends hold whatever the failed draws would have done.
  math::Interval interval{study::not_a_number, study::not_a_number};
};
IgnitionShare ignition_share(const SensitivityResult& result);

/// The same as a sentence, with the lower quantile of the critical gap.
std::string samples_text(const SensitivityResult& result);
nlohmann::ordered_json ignition_json(const SensitivityResult& result);

/// A row for every share, with the quantile of critical gap and T max.
report::Table quantile_table(const SensitivityResult& result);
/// A row for every interval of an output with the number of its draws, and rows for those without a number.
report::Table histogram_table(const SensitivityResult& result);
std::vector<report::Column> quantile_columns();
std::vector<report::Column> histogram_columns();
/// The histograms as steps; without panels where no output has two different numbers.
report::Plot histogram_plot(const SensitivityResult& result);

}  // namespace launchsafe::kinds
