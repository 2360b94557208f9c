#include "launchsafe/mpm/nodes.hpp"

#include <map>
#include <numeric>

namespace launchsafe::mpm {
namespace {

int line_index(const std::vector<double>& lines, double place) {
  return static_cast<int>(scene::nearest_line(lines, place));
}

/// The bodies at one place in sets that hold each other. Without faces that part, all do.
std::vector<Tie> parts_of_tie(const Tie& tie, const std::vector<Nodes>& nodes,
                              const std::function<bool(std::size_t, std::size_t)>& parts) {
  const std::size_t count = tie.members.size();
  const auto any_parts = [&] {
    for (std::size_t a = 0; a < count; ++a)
      for (std::size_t b = 0; b < a; ++b)
        if (parts(tie.members[a].nodes, tie.members[b].nodes)) return true;
    return false;
  };
  if (!any_parts()) return {tie};
  std::vector<std::size_t> set(count);
  std::iota(set.begin(), set.end(), std::size_t{0});
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const std::size_t one = tie.members[a].nodes, two = tie.members[b].nodes;
      if (parts(one, two) || side_towards(nodes[one], nodes[two]) == Side::none) continue;
      const std::size_t from = std::max(set[a], set[b]), to = std::min(set[a], set[b]);
      std::replace(set.begin(), set.end(), from, to);
    }
  std::vector<Tie> found;
  for (std::size_t s = 0; s < count; ++s) {
    Tie part;
    for (std::size_t a = 0; a < count; ++a)
      if (set[a] == s) part.members.push_back(tie.members[a]);
    if (!part.members.empty()) found.push_back(std::move(part));
  }
  return found;
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
  for (auto* field : {&n.mass, &n.inertia_x, &n.inertia_r, &n.inverse_inertia_x, &n.inverse_inertia_r,
                      &n.mass_share, &n.radially_free, &n.velocity_x, &n.velocity_r, &n.velocity_increment_x,
                      &n.velocity_increment_r, &n.displacement_x, &n.displacement_r})
    field->assign(size, 0.0);
  const double outer = scene::extent_of(scene).r_end;
  for (int j = 0; j < n.rows; ++j) {
    const double r = lines.r[static_cast<std::size_t>(n.first_r + j)];
    const bool held = !(r > 0.0) || (scene.barrel == scene::Barrel::rigid && !(r < outer));
    if (!held)
      std::fill_n(n.radially_free.begin() + static_cast<std::ptrdiff_t>(n.index(0, j)), n.columns, 1.0);
  }
  return n;
}

std::vector<Tie> find_ties(const std::vector<Nodes>& nodes,
                           const std::function<bool(std::size_t, std::size_t)>& parts) {
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
    for (Tie& part : parts_of_tie(tie, nodes, parts))
      if (part.members.size() > 1) ties.push_back(std::move(part));
  return ties;
}

Side side_towards(const Nodes& of, const Nodes& other) {
  const auto overlap = [](int a, int a_count, int b, int b_count) {
    return std::min(a + a_count, b + b_count) - std::max(a, b) > 1;  // more than one common line of nodes
  };
  const int x_end = of.first_x + of.columns - 1, r_end = of.first_r + of.rows - 1;
  if (overlap(of.first_r, of.rows, other.first_r, other.rows)) {
    if (x_end == other.first_x) return Side::x_end;
    if (of.first_x == other.first_x + other.columns - 1) return Side::x_begin;
  }
  if (overlap(of.first_x, of.columns, other.first_x, other.columns)) {
    if (r_end == other.first_r) return Side::r_end;
    if (of.first_r == other.first_r + other.rows - 1) return Side::r_begin;
  }
  return Side::none;
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
