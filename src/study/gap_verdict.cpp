#include "launchsafe/study/gap_verdict.hpp"

namespace launchsafe::study {

std::string to_string(surface::IgnitionCause cause) {
  return cause == surface::IgnitionCause::trigger ? "T1" : "Arrhenius";
}

double GapVerdict::misfit() const {
  if (!reference || reference->ignited() || ignition) return not_a_number;
  return maximum.temperature - reference->maximum_temperature;
}

double GapVerdict::early_misfit() const {
  return reference ? early.temperature - reference->early_temperature : not_a_number;
}

}  // namespace launchsafe::study
