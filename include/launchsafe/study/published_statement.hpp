// What the text of a publication says of a launch, statement by statement, and whether a run agrees.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace launchsafe::study {

/// What a study's published number is used for; `input`: it follows from what the scene states.
enum class Use { held_out, selection, calibration, input };
std::string to_string(Use use);

/// What a statement is about; statement_traits says how each is computed.
enum class StatementQuantity {
  region,
  temperature,
  hottest_point,
  hottest_part,
  spread,
  fast_rise_begins,
  fast_rise_ends,
  reaches,
  ignition_time,
  ignition_point,
  peak_pressure,
  air_temperature,
  critical_gap,
  slope,
  intercept,
  not_computed
};

/// A [[statement]]; what it does not say is NaN or empty.
struct PublishedStatement {
  static constexpr double unsaid = std::numeric_limits<double>::quiet_NaN();
  StatementQuantity quantity = StatementQuantity::not_computed;
  std::vector<double> gaps;    ///< m, of which each it holds
  double time = unsaid;        ///< s
  std::string point;           ///< observation point or station
  double level = unsaid;       ///< K, a temperature that is reached
  double ratio = unsaid;       ///< of pressures of the air, >= 1
  std::string value;           ///< as written
  double low = unsaid;         ///< SI, of the value; both the same for one number
  double high = unsaid;        ///< SI
  std::string tolerance_text;  ///< as written
  double tolerance = 0;        ///< SI, of what was printed or read off
  Use use = Use::held_out;
  std::string source;  ///< place in the publication
  std::string remark;  ///< why it is not computed, or what else is to be said
};

}  // namespace launchsafe::study
