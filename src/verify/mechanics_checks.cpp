#include "launchsafe/verify/mechanics_checks.hpp"

#include "mechanics_scenes.hpp"

namespace launchsafe::verify {

std::vector<Computation> mechanics_computations() {
  return {{"longitudinal pulse", mechanics::longitudinal_pulse},
          {"pulse in a free bar", mechanics::free_bar_pulse},
          {"plateau in a free bar", mechanics::plateau_in_a_bar},
          {"thick-walled tube", mechanics::thick_walled_tube},
          {"setback of a column", mechanics::setback_column},
          {"rigid acceleration", mechanics::rigid_acceleration},
          {"free flight", mechanics::free_flight},
          {"energy of a pulse", mechanics::energy_of_a_pulse},
          {"lab frame against co-moving frame", mechanics::lab_against_co_moving},
          {"conduction from a hot face", mechanics::semi_infinite_conduction},
          {"conduction under a flux", mechanics::conduction_under_flux},
          {"conserved heat", mechanics::conduction_keeps_heat},
          {"conduction in long steps", mechanics::conduction_in_long_steps}};
}

std::vector<Check> mechanics_checks() {
  std::vector<Check> all;
  for (const Computation& computation : mechanics_computations())
    for (Check& check : computation.run()) all.push_back(std::move(check));
  return all;
}

}  // namespace launchsafe::verify
