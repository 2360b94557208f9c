#include "launchsafe/mpm/nodes.hpp"

#include "launchsafe/math/pack.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

namespace launchsafe::mpm {
namespace {

int line_index(const std::vector<double>& lines, double place) {
  const auto after = std::lower_bound(lines.begin(), lines.end(), place);
  auto nearest = after == lines.end() ? after - 1 : after;
  if (nearest != lines.begin() && std::abs(*(nearest - 1) - place) < std::abs(*nearest - place)) --nearest;
  return static_cast<int>(nearest - lines.begin());
}

}  // namespace

Nodes make_nodes(const scene::Scene& scene, const scene::GridLines& lines, int index) {
  const scene::Body& body = scene.bodies[static_cast<std::size_t>(index)];
  Nodes n;
  n.body = index;
  n.first_x = line_index(lines.x, body.x_begin);
  n.first_r = line_index(lines.r, body.r_begin);
  n.columns = line_index(lines.x, body.x_end) - n.first_x + 1;
  n.rows = line_index(lines.r, body.r_end) - n.first_r + 1;
  const auto columns = static_cast<std::size_t>(n.columns);
  n.stride = (columns + math::pack_width) / math::pack_width * math::pack_width;
  // A Pack reads one node beyond its cells.
  const std::size_t size = n.stride * static_cast<std::size_t>(n.rows) + math::pack_width;
  for (NodeSums* sums : {&n.inside, &n.outside})
    for (auto* field : {&sums->momentum_x, &sums->momentum_r, &sums->force_x, &sums->force_r})
      field->assign(size, 0.0);
  for (auto* field : {&n.mass, &n.inertia, &n.inverse_inertia, &n.mass_share, &n.moves_r, &n.velocity_x,
                      &n.velocity_r, &n.change_x, &n.change_r, &n.displacement_x, &n.displacement_r})
    field->assign(size, 0.0);
  const double outer = scene::extent_of(scene).r_end;
  for (int j = 0; j < n.rows; ++j) {
    const double r = lines.r[static_cast<std::size_t>(n.first_r + j)];
    // In plane strain the half model's plane of symmetry takes the axis' place.
    const bool held = !(r > 0.0) || (scene.barrel == scene::Barrel::rigid && !(r < outer));
    if (!held) std::fill_n(n.moves_r.begin() + static_cast<std::ptrdiff_t>(n.index(0, j)), n.columns, 1.0);
  }
  return n;
}

std::vector<Tie> find_ties(const std::vector<Nodes>& nodes) {
  std::map<std::pair<int, int>, Tie> places;
  for (std::size_t b = 0; b < nodes.size(); ++b) {
    const Nodes& n = nodes[b];
    for (int j = 0; j < n.rows; ++j)
      for (int i = 0; i < n.columns; ++i) {
        const bool edge = i == 0 || j == 0 || i + 1 == n.columns || j + 1 == n.rows;
        if (edge) places[{n.first_x + i, n.first_r + j}].members.push_back({b, n.index(i, j), j});
      }
  }
  std::vector<Tie> ties;
  for (auto& [place, tie] : places)
    if (tie.members.size() > 1) ties.push_back(std::move(tie));
  return ties;
}

void bond(const std::vector<Tie>& ties, std::vector<Nodes>& nodes) {
  using Field = math::AlignedArray NodeSums::*;
  for (const Tie& tie : ties)
    for (const Field field :
         {&NodeSums::momentum_x, &NodeSums::momentum_r, &NodeSums::force_x, &NodeSums::force_r}) {
      double total = 0.0;
      for (const Tie::Member& m : tie.members)
        total += (nodes[m.nodes].inside.*field)[m.index] + (nodes[m.nodes].outside.*field)[m.index];
      for (const Tie::Member& m : tie.members) {
        Nodes& n = nodes[m.nodes];
        (n.inside.*field)[m.index] = 0.0;
        (n.outside.*field)[m.index] = 0.0;
        (n.written(m.row).*field)[m.index] = total;
      }
    }
}

}  // namespace launchsafe::mpm
