#include "launchsafe/study/gap_verdict.hpp"

#include <fmt/format.h>

namespace launchsafe::study {

std::string to_string(surface::IgnitionCause cause) {
  return cause == surface::IgnitionCause::trigger ? "T1" : "Arrhenius";
}

double GapVerdict::misfit() const {
  if (!reference || reference->ignited() || ignition) return not_a_number;
  return until_exit.temperature - reference->maximum_temperature;
}

double GapVerdict::early_misfit() const {
  return reference ? early.temperature - reference->early_temperature : not_a_number;
}

void judge_row(const std::string& failure, const run::LimiterCounts& limiters, const CriticalGap& critical,
               GapVerdict& row) {
  Evidence& evidence = row.evidence;
  evidence.completed = failure.empty();
  evidence.failure = failure;
  evidence.ignited = row.ignition.has_value();
  evidence.gap = row.gap;
  evidence.maximum_temperature = row.maximum.temperature;
  evidence.margin = row.margin;
  evidence.uncertainty = row.uncertainty.total();
  evidence.calibrated_margin = margin_as_calibrated(row.as_calibrated, row.margin + row.maximum.temperature);
  evidence.limited = run::to_string(limiters);
  constexpr double least_told = 0.1;  // K
  if (row.uncertainty.load_curve >= least_told)
    evidence.noise =
        fmt::format("noise and smoothing of the measured curve count {:.2g} K", row.uncertainty.load_curve);
  row.judgement = judge(evidence, critical);
}

}  // namespace launchsafe::study
