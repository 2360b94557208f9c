#include "film_grid.hpp"

#include <algorithm>
#include <cmath>

namespace launchsafe::surface::detail {

namespace {

struct Solid {
  double density, specific_heat, conductivity;  // kg/m3, J/(kg K), W/(m K)
};

/// Thicknesses (m) of cells from the surface inward, growing exponentially to a depth that heat does not
/// reach: at 8 sqrt(alpha t) a jump at the surface has come down to erfc(4) = 1.5e-8 of itself.
std::vector<double> cells_of(const Solid& solid, double duration, std::size_t count) {
  constexpr double reach = 8.0, grading = 4.5, least_depth = 1e-6;
  const double diffusivity = solid.conductivity / (solid.density * solid.specific_heat);
  const double depth = std::max(reach * std::sqrt(diffusivity * duration), least_depth);
  const auto edge = [&](std::size_t k) {
    return depth * std::expm1(grading * static_cast<double>(k) / static_cast<double>(count)) /
           std::expm1(grading);
  };
  std::vector<double> cells;
  for (std::size_t k = 0; k < count; ++k) cells.push_back(edge(k + 1) - edge(k));
  return cells;
}

/// Shares of the mass, finer toward both walls.
std::vector<double> shares_of_air(std::size_t count) {
  constexpr double grading = 2.3;
  const auto edge = [&](std::size_t k) {
    const double share = 2.0 * static_cast<double>(k) / static_cast<double>(count) - 1.0;
    return 0.5 * (1.0 + std::tanh(grading * share) / std::tanh(grading));
  };
  std::vector<double> shares;
  for (std::size_t k = 0; k < count; ++k) shares.push_back(edge(k + 1) - edge(k));
  return shares;
}

}  // namespace

FilmGrid film_grid(const SkinModel& model, double gap, double duration, const FilmNumerics& numerics) {
  const Solid charge{model.charge_density, model.specific_heat, model.charge_conductivity};
  const Solid steel{model.base_density, model.base_specific_heat, model.base_conductivity};
  const materials::AirParameters& air = model.surface.air;
  const double volume =
      materials::specific_gas_constant(air) * air.initial_temperature / air.initial_pressure;
  const double mass = gap / (volume + air.covolume);
  std::vector<double> inside = cells_of(charge, duration, numerics.charge_cells);
  std::reverse(inside.begin(), inside.end());
  const std::vector<double> shares = shares_of_air(numerics.gas_cells);
  const std::vector<double> beyond = cells_of(steel, duration, numerics.base_cells);

  FilmGrid grid;
  grid.isentropes = materials::Isentropes(air);
  grid.air_begin = inside.size();
  grid.base_begin = grid.air_begin + shares.size();
  for (const double dx : inside) grid.capacity.push_back(charge.density * charge.specific_heat * dx);
  for (const double share : shares) grid.capacity.push_back(air.specific_heat * mass * share);
  for (const double dx : beyond) grid.capacity.push_back(steel.density * steel.specific_heat * dx);
  grid.conductance.assign(grid.size() - 1, 0.0);
  grid.air_mass.assign(grid.size() - 1, 0.0);
  for (std::size_t k = 0; k + 1 < inside.size(); ++k)
    grid.conductance[k] = 2.0 * charge.conductivity / (inside[k] + inside[k + 1]);
  for (std::size_t k = 0; k + 1 < beyond.size(); ++k)
    grid.conductance[grid.base_begin + k] = 2.0 * steel.conductivity / (beyond[k] + beyond[k + 1]);
  for (std::size_t k = 0; k <= shares.size(); ++k) {
    const double before = k > 0 ? shares[k - 1] : 0.0, after = k < shares.size() ? shares[k] : 0.0;
    grid.air_mass[grid.air_begin - 1 + k] = 0.5 * mass * (before + after);
  }
  grid.charge_resistance = 0.5 * inside.back() / charge.conductivity;
  grid.base_resistance = 0.5 * beyond.front() / steel.conductivity;
  grid.mass = mass;
  return grid;
}

}  // namespace launchsafe::surface::detail
