// How a scene is computed: on which grid and particles, and with which terms.
#pragma once

#include "launchsafe/scene/scene.hpp"

namespace launchsafe::scene {

// --- how the grid is fitted to the shell, and how many particles a body gets. Pure arithmetic: the plan
// counts with it and the mechanics builds with it, so both speak of the same mesh ---

/// Cells of the even grid of the updated-Lagrangian form, none larger than the nominal cell size: the charge
/// (without one, the whole scene) is a whole number of them long, the outer radius a whole number wide.
struct Mesh {
  double dx = 0, dr = 0;  ///< cell lengths, m
  double x_anchor = 0;    ///< a grid line: the charge bottom; without a charge the base of the scene, m
  double radius = 0;      ///< a grid line: outer radius of the scene, m
};
/// Needs at least one body and a cell size > 0.
Mesh fit_mesh(const Scene& scene);

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
/// division, each cut into `particles_per_cell`. They tile the body exactly.
GridLines particle_edges(const Scene& scene, const Body& body);

/// Smallest whole number of parts no longer than `part` that make up `length`; at least 1. A part that
/// divides the length up to a relative 1e-9 counts as dividing it.
int parts_of(double length, double part);

/// Counts beyond this are not told apart: no computation of so many parts or steps is within reach.
inline constexpr std::int64_t most_counted = 1'000'000'000'000'000;
/// A count (>= 0) as a whole number; most_counted where it is larger, infinite or no number.
std::int64_t counted(double count);

/// Particles of one body in each direction, each at least 1.
struct ParticleCount {
  int nx = 0;
  int nr = 0;
  std::int64_t total() const { return static_cast<std::int64_t>(nx) * nr; }
};
ParticleCount particles_of(const Scene& scene, const Body& body);
/// Particles of all bodies.
std::int64_t particle_count(const Scene& scene);

/// Cells of the scene's grid, and the lengths of the shortest ones in each direction, m.
struct CellRange {
  int nx = 0, nr = 0;
  double shortest_x = 0, shortest_r = 0;
  double shortest() const { return shortest_x < shortest_r ? shortest_x : shortest_r; }
};
CellRange cells_of(const Scene& scene);
/// Of the part of it that lies in a body.
CellRange cells_of(const Scene& scene, const Body& body);
/// Of the part in the charge, which stands for how fine a computation is; of all without a charge.
CellRange cells_of_charge(const Scene& scene);

/// Radial edges of charge bodies that lie off the lines of an even grid, for a message ("r = 6.5 cm at 65.42
/// cells"); empty where the grid runs along all of them. Off grid lines charge and wall share cells, which
/// changes the friction heat beside the wall by a share that refinement does not remove.
std::string charge_edges_off_grid(const Scene& scene);

/// A station, a box at the charge's bottom over which pressure and strain are averaged, m.
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

// --- which physics a scene needs, and why the rest is left out: decided from the scene's own numbers before
// anything runs ---

/// One term of the physics, in or out, in the order in which people read them.
struct Term {
  std::string_view title, member;  ///< names for people and for programs
  bool in = false;
  bool forced = false;  ///< the user decided, not the plan
  std::string reason;   ///< the numbers that it rests on
};

/// How many particles the bodies of one material have.
struct MaterialParticles {
  std::string material;
  std::int64_t particles = 0;
};

/// What a case will allocate and execute.
struct Plan {
  std::vector<Term> terms;
  bool conducts = false;  ///< heat conduction on the grid
  bool reacts = false;    ///< Arrhenius heat in the bulk
  bool couples = false;   ///< a run goes on through ignition

  std::vector<MaterialParticles> by_material;  ///< of the materials that bodies are made of
  std::int64_t particles() const;
  std::int64_t cells = 0;  ///< of the fitted grid over the shell at rest
  double time_step = 0;    ///< s, at rest: CFL h/c_L, with the inertial factors
  /// Duration over time_step, most_counted at most; compression stiffens, so a run takes some more.
  std::int64_t steps = 0;
  /// Particle updates of the run. Where the crack law divides steps, which cannot be foreseen, it is worth
  /// more.
  double work = 0;
  /// The same, at most, of the run of one gap from the start and, where it ignites, through combustion; 0
  /// with one-way coupling.
  double coupled_work = 0;
  double memory = 0;  ///< bytes of particles and grid, estimated
};

/// Longitudinal sound speed at rest (m/s), sqrt((K + 4/3 G)/rho).
double longitudinal_speed(const materials::Law& law);
/// The largest over the materials that bodies are made of.
double longitudinal_speed(const Scene& scene);

/// Distance (m) that heat diffuses in a time (s): sqrt(k t/(rho c)).
double diffusion_length(const materials::Law& law, double time);

/// Hydrostatic setback pressure (Pa) at the charge bottom at the load's peak, rho L a of the rigid
/// projectile; 0 without a charge.
double setback_pressure(const Scene& scene);

/// Upper bound (K) of the bulk temperature of the charge. With p twice the setback pressure: the initial
/// temperature, adiabatic compression by p, and the heat of (1 + mu_d) p^2/G, all work of p on the strain p/G
/// of the slowest Maxwell element and its sliding friction. Localised heat is the surface's matter, not the
/// bulk's.
double bulk_temperature_bound(const Scene& scene);

Plan make_plan(const Scene& scene);

// Which launches take longer steps, with more inertia where a cell needs it, and how fast a load changes.

/// Largest pressures (Pa) by which a load rises and falls within a time window (s); before 0 it is none.
/// Sampled eight times a window, at its peak, and where a measured curve bends, so that less than an eighth
/// of a window is missed on the way up. A window below 8e-6 of the load is taken as long as that.
struct LargestChanges {
  double rise = 0.0, fall = 0.0;
};
LargestChanges largest_changes(const Load& load, double window);

/// Time (s) that sound takes through the charge, along its longest side.
double transit_time(const Scene& scene);

/// Whether the load changes too fast for selective inertia, whose effect was measured for slower loads: by
/// more than 80 % of its peak within 0.5 ms, or the time that sound takes 2.5 times through a longer charge.
bool changes_too_fast_for_selective_inertia(const Scene& scene);

/// The `numerics.selective_inertia` of a launch that states none: 4, a quarter of the steps, where that was
/// measured against true inertia (reports/accuracy), else 1. A measured curve has true inertia: more of it
/// moves the shell's own frequencies, near which swings of the curve may lie.
double usual_selective_inertia(const Scene& scene);

/// The scene with everything that cannot influence the mechanical run, its trace or its snapshots at its
/// default: title and file names; gap, air (but for its initial pressure, below which no bottom
/// pressure is traced), exchange and localisation; numbers of the analytic load under a measured curve. The
/// plan's switches stand as decided, without what the decision rests on. Kinetics, heat conduction, friction
/// closure and specific heat of laws that do not heat themselves stay only where the plan, or a snapshot,
/// needs them, materials only where a body is made of them. Names of bodies stay.
///
/// Scenes with equal mechanical parts share one mechanical run, bit by bit. The part of a valid scene is
/// valid.
Scene mechanical_part(const Scene& scene);

}  // namespace launchsafe::scene
