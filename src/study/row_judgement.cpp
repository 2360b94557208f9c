#include "launchsafe/study/row_judgement.hpp"

#include <fmt/format.h>

#include <utility>

namespace launchsafe::study {

Evidence evidence_of(const GapVerdict& row, const std::string& failure, const run::LimiterCounts& limiters) {
  Evidence evidence;
  evidence.completed = failure.empty();
  evidence.failure = failure;
  evidence.ignited = row.ignition.has_value();
  evidence.gap = row.gap;
  evidence.maximum_temperature = row.maximum.temperature;
  evidence.margin = row.margin;
  evidence.uncertainty = row.uncertainty.total();
  evidence.limited = run::to_string(limiters);
  constexpr double least_told = 0.1;  // K
  if (row.uncertainty.load_curve >= least_told)
    evidence.noise =
        fmt::format("noise and smoothing of the measured curve count {:.2g} K", row.uncertainty.load_curve);
  return evidence;
}

void judge_row(Evidence evidence, const CriticalGap& critical, GapVerdict& row) {
  row.judgement = judge(evidence, critical);
  row.evidence = std::move(evidence);
}

}  // namespace launchsafe::study
