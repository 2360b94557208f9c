// The grid as a list that people can check: between which edges of bodies it has how many cells of what
// length.
#pragma once

#include "launchsafe/scene/mesh.hpp"

#include <string>
#include <vector>

namespace launchsafe::scene {

/// The cells between two neighbouring places where bodies begin or end. Lengths in m.
struct GridInterval {
  double from = 0, to = 0;
  int cells = 0;
  double shortest = 0, longest = 0;                   ///< of its cells
  std::vector<std::string> edge_before, edge_behind;  ///< names of the bodies with an edge at `from`, at `to`
};

struct GridIntervals {
  std::vector<GridInterval> x, r;
};

/// The intervals of `lines_at_rest` in either direction, increasing, which together are the whole grid. Lines
/// of the even grid of the updated-Lagrangian form need not run through edges of bodies: it is one interval.
GridIntervals grid_intervals(const Scene& scene);

}  // namespace launchsafe::scene
