#include "launchsafe/report/kinetics_text.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/scene/named_material.hpp"

#include <fmt/format.h>

namespace launchsafe::report {
namespace {

std::string numbers_text(const materials::KineticsParameters& kinetics) {
  return fmt::format("E/R {:.6g} K, {:.4g} 1/s, {:.5g} MJ/kg", kinetics.activation_temperature,
                     kinetics.frequency, 1e-6 * kinetics.heat_of_reaction);
}

}  // namespace

std::string runaway_text(const materials::KineticsParameters& kinetics, double specific_heat) {
  const auto milliseconds = [&](double from) {
    return significant(1e3 * materials::adiabatic_runaway_time(kinetics, specific_heat, from), 3);
  };
  return fmt::format("runs away by itself in {} ms from 519 K and in {} ms from 550 K", milliseconds(519.0),
                     milliseconds(550.0));
}

std::string flame_kinetics_note(const scene::Scene& scene) {
  const materials::Charge& charge = scene.charge();
  const std::string own = fmt::format("({}), which {}", numbers_text(charge.kinetics),
                                      runaway_text(charge.kinetics, charge.specific_heat));
  if (scene.combustion.kinetics == scene::effective_kinetics)
    return fmt::format("The flame lives on the charge's own, effective kinetics {}, as ignition does.", own);
  const materials::KineticsParameters flame = scene::flame_kinetics(scene);
  return fmt::format(
      "The flame lives on the decomposition \"{}\" ({}), which {}; ignition is decided by the charge's own, "
      "effective kinetics {}.",
      scene.combustion.kinetics, numbers_text(flame), runaway_text(flame, charge.specific_heat), own);
}

}  // namespace launchsafe::report
