// Cells of one column: charge from inside to its surface, air by mass, steel from its surface inward.
#pragma once

#include "launchsafe/surface/film.hpp"

#include <cstddef>
#include <vector>

namespace launchsafe::surface::detail {

/// Cells 0 to air_begin - 1 are charge, up to base_begin - 1 air, the rest steel. Face i lies between the
/// cells i and i + 1.
struct FilmGrid {
  std::size_t air_begin = 0, base_begin = 0;
  std::vector<double> capacity;     ///< J/(m2 K); of air at constant pressure
  std::vector<double> conductance;  ///< of faces inside the solids, W/(m2 K); 0 elsewhere
  std::vector<double> air_mass;     ///< of faces: air between the two centres, kg/m2; 0 inside the solids
  double charge_resistance = 0;     ///< of the half cell at the charge's surface, m2 K/W
  double base_resistance = 0;       ///< of that at the steel's
  double mass = 0;                  ///< of the air, kg/m2
  materials::Isentropes isentropes;
  std::size_t size() const { return capacity.size(); }
};

/// The cells for a gap (m) over a launch of `duration` (s). Where a cell ends is a smooth function of its
/// number, so that twice as many quarter the error.
FilmGrid film_grid(const SkinModel& model, double gap, double duration, const FilmNumerics& numerics);

}  // namespace launchsafe::surface::detail
