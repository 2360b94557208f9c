// Which physics a scene needs, and why the rest is left out: decided from the scene's own numbers before
// anything runs.
#pragma once

#include "launchsafe/scene/scene.hpp"

namespace launchsafe::scene {

/// One term of the physics, in or out.
struct Term {
  bool in = false;
  bool forced = false;  ///< the user decided, not the plan
  std::string reason;   ///< with the numbers it rests on
  double value = 0;     ///< what was compared, in the unit that `reason` names
  double bound = 0;     ///< with what
};

/// How many particles the bodies of one material have.
struct MaterialParticles {
  std::string material;
  std::int64_t particles = 0;
};

/// What a case will allocate and execute.
struct Plan {
  Term conduction;        ///< grid heat conduction; value and bound: diffusion length over cell size
  Term bulk_reaction;     ///< Arrhenius heat in the bulk; value and bound: K of self-heating over the run
  Term air;               ///< the air of the gaps; value: largest gap, m
  Term cracks;            ///< crack strain in the charge; value: crack radius over flaw size
  Term crack_growth;      ///< value: largest growth speed, m/s
  Term crack_friction;    ///< friction of crack faces raises the toughness; value: coefficient
  Term surface;           ///< skin temperatures of the charge bottom; value: number of gaps
  Term friction_heat;     ///< value: localisation
  Term inertial_scaling;  ///< value: the factor
  Term coupling;          ///< runs on through ignition; value: s of combustion
  Term snapshots;         ///< value: their number

  std::vector<MaterialParticles> by_material;  ///< of the materials that bodies are made of
  std::int64_t particles() const;
  std::int64_t cells = 0;  ///< of the fitted grid over the shell at rest
  double time_step = 0;    ///< s, at rest: CFL h/c_L, with the inertial factors
  /// Duration over time_step, most_counted at most; compression stiffens, so a run takes some more.
  std::int64_t steps = 0;
  /// Particle updates of the run. Where the crack law divides steps, which cannot be foreseen, it is worth
  /// more.
  double work = 0;
  /// The same, at most, of the run of one gap that goes on from a checkpoint of the launch and, where it
  /// ignites, through combustion; 0 with one-way coupling.
  double coupled_work = 0;
  double memory = 0;  ///< bytes of particles and grid, estimated
};

/// A term under the names that people and programs read, in the order in which they do.
struct NamedTerm {
  std::string_view title, member;
  Term Plan::*term;
};
inline constexpr std::array<NamedTerm, 11> plan_terms{{
    {"skin of the bottom", "surface", &Plan::surface},
    {"air in the gap", "air", &Plan::air},
    {"friction heat", "friction_heat", &Plan::friction_heat},
    {"cracks", "cracks", &Plan::cracks},
    {"crack growth", "crack_growth", &Plan::crack_growth},
    {"crack friction", "crack_friction", &Plan::crack_friction},
    {"heat conduction", "conduction", &Plan::conduction},
    {"bulk reaction", "bulk_reaction", &Plan::bulk_reaction},
    {"inertial scaling", "inertial_scaling", &Plan::inertial_scaling},
    {"coupling", "coupling", &Plan::coupling},
    {"snapshots", "snapshots", &Plan::snapshots},
}};

/// Into so many parts checkpoints divide a launch (total-Lagrangian; other formulations have none).
inline constexpr double parts_of_launch = 16.0;
/// So long before ignition, as a share of the launch, the checkpoint lies at least from which a run goes on.
inline constexpr double share_before_ignition = 0.01;

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

/// Seconds of wall time at an update rate (particle updates per second, > 0).
double predicted_time(const Plan& plan, double update_rate);

/// What `launchsafe explain` prints: masses, load, mesh, what is in and what is left out, and what the run
/// will cost; the time too where an update rate (particle updates per second) is given.
std::string to_text(const Plan& plan, const Scene& scene, double update_rate = 0.0);

// Which launches take longer steps, with more inertia where a cell needs it, and how fast a load changes.

/// Largest pressures (Pa) by which a load rises and falls within a time window (s); before 0 it is none.
/// Sampled eight times a window, at its peak, and where a measured curve bends, so that less than an eighth
/// of a window is missed on the way up.
struct LargestChanges {
  double rise = 0.0, fall = 0.0;
};
LargestChanges largest_changes(const Load& load, double window);

/// Time (s) that sound takes through the charge, along its longest side.
double transit_time(const Scene& scene);

/// Whether the load changes too fast for selective inertia: by more than 80 % of its peak within 0.5 ms, or
/// the time that sound takes 2.5 times through a longer charge. What it does to temperatures was measured for
/// slower loads.
bool changes_too_fast_for_selective_inertia(const Scene& scene);

/// The `numerics.selective_inertia` of a launch that states none: 4, a quarter of the steps, where that was
/// measured against true inertia (reports/accuracy), else 1. Where its gap closes it is 2: T max is then that
/// of true inertia within 0.3 K where the charge is free from the start and within 2 % of its rise where it
/// rings, and 4 lowers it by 3 K. A measured curve has true inertia: more of it moves the shell's own
/// frequencies, and a ring of 1.5 % at 2.4 kHz that ignites the 155 mm shell without a gap leaves it at 416 K
/// with 4.
double usual_selective_inertia(const Scene& scene);

/// The scene with everything that cannot influence the mechanical run, its trace or its snapshots at its
/// default: title, file names and acceptances; gap, air (but for its initial pressure, below which no bottom
/// pressure is traced), exchange and localisation; numbers of the analytic load under a measured curve. The
/// plan's switches stand as decided, without what the decision rests on. Kinetics, heat conduction, friction
/// closure and specific heat of laws that do not heat themselves stay only where the plan, or a snapshot,
/// needs them, materials only where a body is made of them. Zeros have no sign. Names of bodies stay: a
/// failed run tells where it failed.
///
/// Scenes with equal mechanical parts share one mechanical run, bit by bit. The part of a valid scene is
/// valid.
Scene mechanical_part(const Scene& scene);

}  // namespace launchsafe::scene
