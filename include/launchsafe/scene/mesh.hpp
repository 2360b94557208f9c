// How the grid is fitted to the shell, and how many particles a body gets. Pure arithmetic: the plan counts
// with it and the mechanics builds with it, so both speak of the same mesh.
#pragma once

#include "launchsafe/scene/scene.hpp"

namespace launchsafe::scene {

/// Cells of the even grid of the updated-Lagrangian form. An axial grid line runs through `x_anchor` and a
/// radial one through r = 0 and r = radius.
struct Mesh {
  double dx = 0;        ///< axial cell length, m, at most the nominal cell size
  double dr = 0;        ///< radial cell length, m, at most the nominal cell size
  double x_anchor = 0;  ///< the charge bottom; without a charge the base of the scene, m
  double radius = 0;    ///< outer radius of the scene, m, a whole number of radial cells
};

/// Places in increasing order, m, each once: those closer than the tolerance are one.
std::vector<double> distinct(std::vector<double> places, double tolerance);

/// Index of the line next to a place, m.
std::size_t nearest_line(const std::vector<double>& lines, double place);

/// Lines of a rectilinear grid, increasing, m.
struct GridLines {
  std::vector<double> x, r;
};

/// The reference grid of the total-Lagrangian form: lines through all edges of all bodies, and between two
/// neighbouring edges cells whose length follows `numerics`: `cell_size` at the refined lines, growing away
/// from them by the ratio `growth_x` or `growth_r` from cell to cell up to `largest_cell`, along r no further
/// than a station of the charge's bottom is wide, so that every one has a cell. An interval gets the smallest
/// whole number of cells that keeps them from being longer than that.
GridLines grid_lines(const Scene& scene);

/// The lines of the grid over the shell at rest, whichever the form: those of `grid_lines`, or of the even
/// grid, from the last one at or before the shell to the first one at or behind it.
GridLines lines_at_rest(const Scene& scene);

/// Edges of the particles of one body: total-Lagrangian the grid's lines, updated-Lagrangian an even
/// division, each cut into `particles_per_cell`.
GridLines particle_edges(const Scene& scene, const Body& body);

/// Particles of one body in each direction, each at least 1. They tile the body exactly, whatever the grid.
struct ParticleCount {
  int nx = 0;
  int nr = 0;
  std::int64_t total() const { return static_cast<std::int64_t>(nx) * nr; }
};

/// Counts beyond this are not told apart: no computation of so many parts or steps is within reach.
inline constexpr std::int64_t most_counted = 1'000'000'000'000'000;

/// A count (>= 0) as a whole number; most_counted where it is larger, infinite or no number.
std::int64_t counted(double count);

/// Smallest whole number of parts no longer than `part` that make up `length`; at least 1. A part that
/// divides the length up to a relative 1e-9 counts as dividing it.
/// Extents are at most 10 m and cells at least 10 µm, so that the number is far below 2^31.
int parts_of(double length, double part);

/// The charge (without one, the whole scene) is a whole number of cells long and the outer radius a whole
/// number of cells wide, none larger than `scene.numerics.cell_size`. Needs at least one body and a cell size
/// > 0.
Mesh fit_mesh(const Scene& scene);

/// Radial edges of charge bodies that lie off the grid lines, for a message ("r = 6.5 cm at 65.42 cells");
/// empty where the grid runs along all of them. Off grid lines charge and wall share cells, which changes the
/// friction heat beside the wall by a share that refinement does not remove: constants calibrated on a grid
/// that fits do not carry over.
std::string charge_edges_off_grid(const Scene& scene);

/// Particles of one body with `particles_per_cell` >= 1 in each direction: of the lattice's cells in it or,
/// in the updated-Lagrangian form, the body's length over the cell's, rounded up.
ParticleCount particles_of(const Scene& scene, const Body& body);

/// Cells of the scene's grid, and the lengths of the shortest and longest ones in each direction, m.
struct CellRange {
  int nx = 0, nr = 0;
  double shortest_x = 0, longest_x = 0, shortest_r = 0, longest_r = 0;
  double shortest() const { return shortest_x < shortest_r ? shortest_x : shortest_r; }
};
CellRange cells_of(const Scene& scene);
/// Of the part of it that lies in a body.
CellRange cells_of(const Scene& scene, const Body& body);
/// Of the part in the charge, which stands for how fine a computation is; of all without a charge.
CellRange cells_of_charge(const Scene& scene);

/// How large a mesh is, from one look at its grid.
struct MeshSize {
  CellRange all;                        ///< as `cells_of` the scene
  std::vector<CellRange> cells;         ///< as `cells_of` every body, in their order
  std::vector<std::int64_t> particles;  ///< of every body
};
MeshSize mesh_size(const Scene& scene);

/// Particles of all bodies.
std::int64_t particle_count(const Scene& scene);

// The grid as a list that people can check: between which edges of bodies it has how many cells of what
// length.

/// The cells between two neighbouring places where bodies begin or end. Lengths in m.
struct GridInterval {
  const char* along = "";  ///< "x" or "r"
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

// Stations: the parts of the charge's bottom over which pressure and strain are averaged.

/// A box at the charge's bottom, m.
struct StationExtent {
  std::string name;  ///< "S1", "S2", ... from the largest radius inwards
  double x_begin = 0, x_end = 0, r_begin = 0, r_end = 0;
};

/// Stations that tile the charge's bottom: of equal width, the bottom's over the nearest whole number to
/// `surface.station_width` (at least one), and as deep as `surface.station_depth`. Of the published shell
/// they are 5 mm wide and have the published points in their middles. None without a charge.
std::vector<StationExtent> stations_of(const Scene& scene);

/// How many cells a station is deep and wide. In the corner of bottom and outer edge, where stresses are
/// singular and averages need them, as many as there would be of the cell there; along r also in the station
/// with the longest cell.
struct StationCells {
  double corner_x = 0, corner_r = 0, fewest_r = 0;
};
StationCells cells_in_stations(const Scene& scene);

}  // namespace launchsafe::scene
