// Box means of particle fields, from snapshots alone: whatever the mesh and however the step is formulated.
#include "launchsafe/verify/static_stress_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace launchsafe::verify {
namespace {

/// Where a particle's cell lay at rest, m.
struct Cell {
  double x_begin, x_end, r_begin, r_end;
};

/// Edges (m) of cells that fill their body without gaps, each with its particle in the middle: from the edge
/// of the body on, every centre gives the next edge.
std::vector<double> edges_around(std::vector<double> centres, double begin) {
  constexpr double same = 1e-9;  // m
  std::sort(centres.begin(), centres.end());
  std::vector<double> edges{begin};
  double last = begin - 1.0;
  for (const double centre : centres) {
    if (centre - last < same) continue;
    last = centre;
    edges.push_back(2.0 * centre - edges.back());
  }
  return edges;
}

/// The two edges between which the centre lies.
std::pair<double, double> around(const std::vector<double>& edges, double centre) {
  const auto after = std::upper_bound(edges.begin(), edges.end(), centre);
  return {*(after - 1), *after};
}

std::vector<Cell> cells_of(const scene::Scene& scene, const run::Snapshot& rest) {
  std::vector<Cell> cells(rest.x.size());
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
    std::vector<double> x, r;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (static_cast<std::size_t>(rest.body[k]) != body) continue;
      x.push_back(rest.x[k]);
      r.push_back(rest.r[k]);
    }
    const std::vector<double> edges_x = edges_around(x, scene.bodies[body].x_begin),
                              edges_r = edges_around(r, scene.bodies[body].r_begin);
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (static_cast<std::size_t>(rest.body[k]) != body) continue;
      const auto [x_begin, x_end] = around(edges_x, rest.x[k]);
      const auto [r_begin, r_end] = around(edges_r, rest.r[k]);
      cells[k] = {x_begin, x_end, r_begin, r_end};
    }
  }
  return cells;
}

/// Integral of r dr dx over the part of a cell that lies in a station's box, m3 per radian.
double weight_in_box(const Cell& cell, double bottom, double r) {
  const double length = std::min(cell.x_end, bottom) - std::max(cell.x_begin, bottom - stress_box);
  const double inner = std::max(cell.r_begin, r - 0.5 * stress_box),
               outer = std::min(cell.r_end, r + 0.5 * stress_box);
  return length > 0.0 && outer > inner ? 0.5 * length * (outer * outer - inner * inner) : 0.0;
}

/// Which particles a box mean is made of; weights sum to 1.
using Shares = std::vector<std::pair<std::size_t, double>>;

Shares shares_of(const scene::Scene& scene, const run::Snapshot& rest, const std::vector<Cell>& cells,
                 double r) {
  const double bottom = bottom_of(scene);
  const bool in_charge = scene::has_charge(scene);
  Shares shares;
  double total = 0.0;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const bool charge = scene::is_charge(scene, scene.bodies[static_cast<std::size_t>(rest.body[k])]);
    const double weight = charge == in_charge ? weight_in_box(cells[k], bottom, r) : 0.0;
    if (weight > 1e-12 * stress_box * stress_box * stress_box) shares.emplace_back(k, weight);
    total += weight;
  }
  for (auto& share : shares) share.second /= total;
  return shares;
}

StressMeasures mean_of(const Shares& shares, const run::Snapshot& at) {
  double pressure = 0.0;
  math::Deviator<double> deviator;
  for (const auto& [particle, weight] : shares) {
    pressure += weight * at.pressure[particle];
    deviator = deviator + weight * math::Deviator<double>{at.deviator_rr[particle], at.deviator_xx[particle],
                                                          at.deviator_rx[particle]};
  }
  return {pressure, math::von_mises(deviator)};
}

/// Rows of neighbours along r within the boxes of all stations, by their x.
std::map<long, std::vector<std::size_t>> rows_along_r(const StaticCase& compared, const run::Snapshot& rest,
                                                      const std::vector<Cell>& cells) {
  constexpr double same = 1e-8;  // m
  std::map<long, std::vector<std::size_t>> rows;
  for (const StressStation& station : compared.stations)
    for (const auto& [particle, weight] : shares_of(compared.scene, rest, cells, station.r)) {
      std::vector<std::size_t>& row = rows[std::lround(rest.x[particle] / same)];
      if (std::find(row.begin(), row.end(), particle) == row.end()) row.push_back(particle);
    }
  for (auto& [x, row] : rows)
    std::sort(row.begin(), row.end(), [&](std::size_t a, std::size_t b) { return rest.r[a] < rest.r[b]; });
  return rows;
}

double alternation_of(const StaticCase& compared, const run::Snapshot& rest, const std::vector<Cell>& cells,
                      const std::vector<double>& pressure) {
  double alternating = 0.0, whole = 0.0;
  for (const auto& [x, row] : rows_along_r(compared, rest, cells))
    for (std::size_t j = 2; j + 2 < row.size() && rest.r[row[j]] < alternation_radius; ++j) {
      const double p = pressure[row[j]];
      const double part = (pressure[row[j - 2]] - 4.0 * pressure[row[j - 1]] + 6.0 * p -
                           4.0 * pressure[row[j + 1]] + pressure[row[j + 2]]) /
                          16.0;
      alternating += part * part;
      whole += p * p;
    }
  return std::sqrt(alternating / whole);
}

}  // namespace

ParticleMeans particle_means(const StaticCase& compared, const std::vector<run::Snapshot>& snapshots) {
  const run::Snapshot& rest = snapshots.front();
  const std::vector<Cell> cells = cells_of(compared.scene, rest);
  const auto samples = static_cast<double>(snapshots.size() - 1);
  ParticleMeans result;
  result.particles = cells.size();
  for (const StressStation& station : compared.stations) {
    const Shares shares = shares_of(compared.scene, rest, cells, station.r);
    StressMeasures mean;
    for (std::size_t k = 1; k < snapshots.size(); ++k) {
      const StressMeasures now = mean_of(shares, snapshots[k]);
      mean.pressure += now.pressure / samples;
      mean.von_mises += now.von_mises / samples;
    }
    for (std::size_t k = 1; k < snapshots.size(); ++k) {
      const StressMeasures now = mean_of(shares, snapshots[k]);
      result.ringing_pressure =
          std::max(result.ringing_pressure, std::abs(now.pressure / mean.pressure - 1.0));
      result.ringing_von_mises =
          std::max(result.ringing_von_mises, std::abs(now.von_mises / mean.von_mises - 1.0));
    }
    result.means.push_back(mean);
  }
  std::vector<double> pressure(cells.size(), 0.0);
  for (std::size_t k = 1; k < snapshots.size(); ++k)
    for (std::size_t i = 0; i < pressure.size(); ++i) pressure[i] += snapshots[k].pressure[i] / samples;
  result.alternation = alternation_of(compared, rest, cells, pressure);
  return result;
}

}  // namespace launchsafe::verify
