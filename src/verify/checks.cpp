#include "checks.hpp"

#include <utility>

namespace launchsafe::verify {

std::vector<Check> Computation::run() const {
  std::vector<Check> checks = compute();
  for (Check& check : checks) check.group = group;
  return checks;
}

std::vector<Computation> computations() {
  using enum scene::Formulation;
  std::vector<Computation> all;
  const auto append = [&](std::vector<Computation> more, const char* prefix = "") {
    for (Computation& computation : more) {
      computation.group = prefix + computation.group;
      all.push_back(std::move(computation));
    }
  };
  append(material_computations());
  append(surface_computations());
  for (const scene::Formulation formulation : {total_lagrangian, updated_lagrangian}) {
    const char* const prefix = formulation == updated_lagrangian ? "updated-Lagrangian " : "";
    append(wave_computations(formulation), prefix);
    append(static_computations(formulation), prefix);
    append(launch_computations(formulation), prefix);
  }
  append(conduction_computations());
  return all;
}

}  // namespace launchsafe::verify
