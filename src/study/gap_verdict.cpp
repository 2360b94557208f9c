#include "launchsafe/study/gap_verdict.hpp"

#include "launchsafe/study/statement_text.hpp"

#include <algorithm>

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

void judge_rows(const Study& study, const std::shared_ptr<const CaseEvidence>& of_case,
                const CriticalGap& critical, std::vector<GapVerdict>& rows) {
  const std::optional<PressureInterval>& around = of_case->input.model_form.around;
  for (GapVerdict& row : rows) {
    Evidence& evidence = row.evidence;
    evidence.of_case = of_case;
    evidence.ignited = row.ignition.has_value();
    evidence.gap = row.gap;
    evidence.maximum_temperature = row.maximum.temperature;
    evidence.margin = row.margin;
    evidence.uncertainty = row.uncertainty.total();
    evidence.calibrated_margin =
        margin_as_calibrated(row.as_calibrated, row.margin + row.maximum.temperature);
    evidence.noise = row.uncertainty.load_curve;
    if (around) evidence.models = models_that_differ(*study.model_form, *around, row.gap, evidence.ignited);
    row.judgement = judge(evidence, critical);
  }
}

std::string reason_text(const GapVerdict& row) { return reason_text(row.evidence, row.judgement); }

double largest_safe_gap(const std::vector<GapVerdict>& rows) {
  double largest = not_a_number, first_other = no_ignition;
  for (const GapVerdict& each : rows)
    if (each.judgement.verdict != Verdict::safe) first_other = std::min(first_other, each.gap);
  for (const GapVerdict& each : rows)
    if (each.gap < first_other && !(each.gap <= largest)) largest = each.gap;
  return largest;
}

}  // namespace launchsafe::study
