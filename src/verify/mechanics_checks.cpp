#include "launchsafe/verify/mechanics_checks.hpp"

#include "mechanics_scenes.hpp"

#include <utility>

namespace launchsafe::verify {

using mechanics::Checks;

Checks Computation::run() const {
  Checks checks = compute(formulation);
  if (formulation == scene::Formulation::updated_lagrangian)
    for (Check& check : checks) check.group = "updated-Lagrangian " + check.group;
  return checks;
}

std::vector<Computation> mechanics_computations() {
  using enum scene::Formulation;
  using Compute = Checks (*)(scene::Formulation);
  using Named = std::pair<const char*, Compute>;
  std::vector<Computation> all;
  for (const scene::Formulation formulation : {total_lagrangian, updated_lagrangian})
    for (const auto& [name, compute] :
         {Named{"longitudinal pulse", mechanics::longitudinal_pulse},
          Named{"pulse in a free bar", mechanics::free_bar_pulse},
          Named{"plateau in a free bar", mechanics::plateau_in_a_bar},
          Named{"thick-walled tube", mechanics::thick_walled_tube},
          Named{"setback of a column", mechanics::setback_column},
          Named{"rigid acceleration", mechanics::rigid_acceleration},
          Named{"energy of a pulse", mechanics::energy_of_a_pulse},
          Named{"lab frame against co-moving frame", mechanics::lab_against_co_moving}})
      all.push_back({name, formulation, compute});
  all.push_back({"free flight", updated_lagrangian, mechanics::free_flight});
  // Conduction is a scheme of its own on the bodies' particles.
  for (const auto& [name, compute] :
       {Named{"conduction from a hot face", mechanics::semi_infinite_conduction},
        Named{"conduction under a flux", mechanics::conduction_under_flux},
        Named{"conserved heat", mechanics::conduction_keeps_heat},
        Named{"conduction in long steps", mechanics::conduction_in_long_steps}})
    all.push_back({name, total_lagrangian, compute});
  return all;
}

std::vector<Check> mechanics_checks() {
  std::vector<Check> all;
  for (const Computation& computation : mechanics_computations())
    for (Check& check : computation.run()) all.push_back(std::move(check));
  return all;
}

}  // namespace launchsafe::verify
