#include "launchsafe/scene/mesh.hpp"

#include <cmath>
#include <set>

namespace launchsafe::scene {
namespace {

/// Where a body begins and ends along one direction.
struct BodySpan {
  std::string body;
  double begin = 0, end = 0;
};

std::size_t nearest(const std::vector<double>& lines, double place) {
  const auto above = std::lower_bound(lines.begin(), lines.end(), place);
  const auto i = static_cast<std::size_t>(above - lines.begin());
  if (above == lines.begin()) return i;
  return above == lines.end() || place - lines[i - 1] < *above - place ? i - 1 : i;
}

std::vector<std::string> bodies_with_edge_at(double place, double cell, const std::vector<BodySpan>& spans) {
  std::vector<std::string> names;
  for (const BodySpan& span : spans)
    if (std::min(std::abs(span.begin - place), std::abs(span.end - place)) < 1e-3 * cell)
      names.push_back(span.body);
  return names;
}

GridInterval interval(const std::vector<double>& lines, std::size_t first, std::size_t last,
                      const std::vector<BodySpan>& spans) {
  GridInterval found;
  found.from = lines[first];
  found.to = lines[last];
  found.cells = static_cast<int>(last - first);
  found.shortest = found.to - found.from;
  for (std::size_t i = first; i < last; ++i) {
    found.shortest = std::min(found.shortest, lines[i + 1] - lines[i]);
    found.longest = std::max(found.longest, lines[i + 1] - lines[i]);
  }
  found.edge_before = bodies_with_edge_at(found.from, found.shortest, spans);
  found.edge_behind = bodies_with_edge_at(found.to, found.shortest, spans);
  return found;
}

std::vector<GridInterval> intervals(const std::vector<double>& lines, const std::vector<BodySpan>& spans,
                                    bool cut_at_edges) {
  std::set<std::size_t> ends{0, lines.size() - 1};
  if (cut_at_edges)
    for (const BodySpan& span : spans) ends.insert({nearest(lines, span.begin), nearest(lines, span.end)});
  std::vector<GridInterval> all;
  for (auto end = std::next(ends.begin()); end != ends.end(); ++end)
    all.push_back(interval(lines, *std::prev(end), *end, spans));
  return all;
}

}  // namespace

GridIntervals grid_intervals(const Scene& scene) {
  std::vector<BodySpan> along_x, along_r;
  for (const Body& body : scene.bodies) {
    along_x.push_back({body.name, body.x_begin, body.x_end});
    along_r.push_back({body.name, body.r_begin, body.r_end});
  }
  const GridLines lines = lines_at_rest(scene);
  const bool through_edges = scene.numerics.formulation == Formulation::total_lagrangian;
  return {intervals(lines.x, along_x, through_edges), intervals(lines.r, along_r, through_edges)};
}

}  // namespace launchsafe::scene
