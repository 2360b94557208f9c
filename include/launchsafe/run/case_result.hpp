// What one case came to: the mechanics once, and a skin history for every gap.
#pragma once

#include "launchsafe/math/numbers.hpp"
#include "launchsafe/surface/air_energy.hpp"
#include "launchsafe/surface/film.hpp"

#include <map>
#include <memory>

namespace launchsafe::run {

/// How a mechanical run ended. Everything but `completed` makes every verdict on it indeterminate.
enum class RunStatus {
  completed,
  non_finite,
  energy_drift,
  time_step_collapse,
  particles_left_grid,
  interrupted,
  timed_out,
  cells_distorted,
  outside_gas_law,
  flame_beyond_sound
};
inline constexpr RunStatus last_status = RunStatus::flame_beyond_sound;
std::string to_string(RunStatus status);

/// Running sums of the energy balance, J (axisymmetric: of the whole shell; plane strain: per metre, half
/// model).
struct EnergyBalance {
  double kinetic = 0;     ///< of the motion relative to the frame, with the scaled inertia
  double internal = 0;    ///< stress power integrated
  double external = 0;    ///< work of the chamber pressure
  double body_force = 0;  ///< work of the accelerating frame's body force (co-moving frame only)
  double damping = 0;     ///< taken out by damping, the PIC share and FLIP's filter
  /// Taken out by friction between bodies, where their faces close, and by gas between them.
  double contact = 0;
  double plastic = 0;    ///< dissipated in steel
  double viscous = 0;    ///< dissipated in the charge's Maxwell elements
  double crack = 0;      ///< dissipated by crack growth
  double hourglass = 0;  ///< stored against hourglassing, part of the internal energy
  double scale() const;  ///< what drift is measured against, > 0
  double drift() const;  ///< (kinetic + internal + damping + contact - external - body_force)/scale
};

/// Elastic energy (J) that the bodies would hold under a hundredth of the load's peak, or of an atmosphere
/// where that is more: drift is not judged on less, where it would be the first cells' share in the first
/// steps, or round-off where there is no load.
double least_judged_energy(const scene::Scene& scene);

/// Impulse (N s) of a hundredth of an atmosphere on the base over the launch: likewise for momentum.
double least_judged_impulse(const scene::Scene& scene);

/// A row of the monitor history.
struct MonitorSample {
  double time = 0;       ///< s
  double time_step = 0;  ///< s
  EnergyBalance energy;
  double largest_plastic_strain = 0;
  double largest_crack_radius = 0;  ///< m
  double momentum = 0;  ///< kg m/s, axial, relative to the frame, of steel with its own inertial factor
};

/// The skin of a gap along the charge's bottom at one instant, by the stations that tile it.
struct BottomSkin {
  double gap = 0;                       ///< m
  std::vector<double> temperature;      ///< K, of the skin, which holds the heat of its sliding layers
  std::vector<double> reaction_degree;  ///< of the skin; empty but in a run that goes on through combustion
};

/// A face of the charge on which a body can slide, at one instant, by the nodes of the charge's face.
struct FaceSnapshot {
  std::string body;
  std::vector<double> x, r;      ///< m, at present
  std::vector<double> slip;      ///< m, of the body against the charge since the start: along x or along r
  std::vector<double> pressure;  ///< Pa, of contact, compression positive
  std::vector<double> shear;     ///< Pa, on the body, in the direction of the slip
  std::vector<double> opening;   ///< m, by which the faces have parted
};

/// Particle fields at one instant: body after body, in each row after row from the axis outward, in each row
/// from the nose to the base (scene::particles_of counts both).
struct Snapshot {
  double time = 0;
  std::vector<scene::Event> events;  ///< that it is of; none where it is of a time alone
  std::vector<double> x, r, velocity_x, velocity_r, density, pressure, von_mises, temperature;
  /// What laws show of their state (materials::StateField), by name: 0 for bodies whose law has it not, and
  /// no entry where none has it.
  std::map<std::string, std::vector<double>, std::less<>> state;
  /// Stress deviator, Pa; tt = -(rr + xx). Stresses, positive in tension, are sigma_ii = deviator_ii -
  /// pressure and sigma_rx = deviator_rx.
  std::vector<double> deviator_rr, deviator_xx, deviator_rx;
  /// m, of the particle's cell at present: its half lengths at rest, stretched as the distances between the
  /// particle's neighbours are; empty in files that are older than this.
  std::vector<double> half_length_x, half_length_r;
  std::vector<double> burnt_share;  ///< of the particle's mass; empty where nothing burns
  std::vector<int> body;            ///< index into Scene::bodies
  /// m, both ends of every station that tiles the charge's bottom, at present, in the order of the trace;
  /// empty in files that are older than this.
  std::vector<double> bottom_x, bottom_r;
  std::vector<BottomSkin> skins;    ///< of the case's gaps; none where the mechanics ran alone
  std::vector<FaceSnapshot> faces;  ///< of those that can slide, in the order of MechanicsResult::interfaces
};

/// A quantity of the particles, described once: case files, XDMF, pictures and tables go through the list.
struct SnapshotField : materials::StateField {
  std::vector<double> Snapshot::*values = nullptr;  ///< where it is; null for a law's, in Snapshot::state
  bool always = false;                ///< whether files have it always, or where it was recorded
  std::string_view title = {};        ///< of pictures; the meaning where there is none
  std::string_view description = {};  ///< in files, likewise
};

/// All of them, in the order in which files list them and pictures are drawn.
const std::vector<SnapshotField>& snapshot_fields();

/// Its values in a snapshot, in SI, as many as particles; empty where the snapshot has not got it.
const std::vector<double>& values_of(const Snapshot& snapshot, const SnapshotField& field);
/// Likewise, to be filled.
std::vector<double>& values_of(Snapshot& snapshot, const SnapshotField& field);

/// Whether particles of a body have it.
bool has_field(const scene::Scene& scene, const scene::Body& body, const SnapshotField& field);

/// On how many particle-steps limiters acted; a verdict that depended on one says so.
struct LimiterCounts {
  std::uint64_t crack_at_bound = 0;  ///< a crack was at its largest radius
  std::uint64_t tension_cutoff = 0;  ///< the charge's tension cut-off acted
  std::uint64_t hugoniot_guard = 0;  ///< the guard of the Hugoniot pole acted
};

/// "crack bound 12, tension cut-off 3"; empty where none acted.
std::string to_string(const LimiterCounts& limiters);

/// Mass of the bodies of one material, kg, summed over the particles.
struct MaterialMass {
  std::string material;
  double mass = 0;
};
/// Adds to the entry of a material, at the end where there is none.
void add_mass(std::vector<MaterialMass>& masses, const std::string& material, double mass);

/// How one body that can slide on the charge did so until the end of the run, by the nodes of the charge's
/// face.
struct InterfaceResult {
  std::string body;
  bool along_x = false;               ///< a side of the charge; otherwise one of its ends
  double face = 0;                    ///< m, at rest: r of a side, x of an end
  double friction_work = 0;           ///< J, turned into heat (as EnergyBalance: of the whole shell)
  std::vector<double> place;          ///< m, at rest: x along a side, r along an end
  std::vector<double> friction_heat;  ///< J/m2, since the start
  std::vector<double> slid;           ///< m, since the start, to and fro added up
  std::vector<double> largest_gap;    ///< m, by which the faces parted
  std::vector<double> overlap;        ///< m, by which they passed into each other
  std::vector<double> bonded;         ///< 1 where the bond still holds
};

/// States of a launch from which runs of single gaps go on.
class Checkpoints;

struct MechanicsResult {
  RunStatus status = RunStatus::completed;
  std::string reason;   ///< when and where, if not completed
  double end_time = 0;  ///< s, reached
  std::uint64_t steps = 0;
  std::uint64_t steps_before = 0;  ///< of them, up to the checkpoint from which this run went on
  std::uint64_t particles = 0;
  double wall_time = 0;       ///< s
  double processor_time = 0;  ///< s, of the run's threads: what other work on the machine disturbs least
  /// Particles times the steps that this run computed.
  double particle_updates() const { return double(steps - steps_before) * double(particles); }
  /// s, of processor time; of wall time where that is not known.
  double work_time() const { return processor_time > 0 ? processor_time : wall_time; }
  double update_rate() const { return work_time() > 0 ? particle_updates() / work_time() : 0; }  ///< 1/s
  std::vector<MaterialMass> masses;  ///< by material, in the order of the first body of each
  trace::BottomTrace trace;
  std::vector<MonitorSample> monitor;
  std::vector<Snapshot> snapshots;
  LimiterCounts limiters;
  std::vector<InterfaceResult> interfaces;         ///< none for bodies that are bonded for good
  std::shared_ptr<const Checkpoints> checkpoints;  ///< in memory only, where they were asked for
};

/// 0 for a material without particles.
double mass_of(const MechanicsResult& mechanics, std::string_view material);

/// J/m2, the largest heat of friction on the end of the charge at `bottom` (m); 0 where nothing slides there.
double friction_heat_at_bottom(const MechanicsResult& mechanics, double bottom);

/// m, the widest gap between that end and the body it can slide on, likewise.
double opening_at_bottom(const MechanicsResult& mechanics, double bottom);

/// Largest absolute energy drift over the monitor's history, as a share of the run's largest energy (in the
/// first moments all energies are next to nothing); NaN without one.
double largest_energy_drift(const MechanicsResult& mechanics);

/// Why a run that burns ended.
enum class CombustionEnd { time, pressure, broke_off, burnt_through };

/// What followed the ignition of a gap in a run with two-way coupling; samples are those of the trace from
/// the one before ignition on. Of the whole shell (plane strain: per metre).
struct CombustionHistory {
  std::vector<double> time;             ///< s
  std::vector<double> burnt_mass;       ///< kg
  std::vector<double> burnt_depth;      ///< m, the largest
  std::vector<double> gas_volume;       ///< m3
  std::vector<double> gas_temperature;  ///< K, mean over the gas's mass
  std::vector<double> pressure;         ///< Pa, mean over the bottom
  /// J, of what has burnt: released by the reaction, kept back of the heat of reaction, and brought along as
  /// heat above the initial temperature, from air, friction and slow reaction.
  std::vector<double> released, kept_back, brought;
  std::vector<double> reaction_degree;  ///< of the skin, [sample * stations + station]
  double skin_flame_speed = 0;          ///< m/s, at the first station that ignited
  double bulk_flame_speed = 0;          ///< m/s, behind the skin there
  double complete_time = 0;             ///< s, when the skin of some station had burnt; NaN if none had
  /// Largest energy made or lost in burning particles, as a share of the heat of reaction of what had burnt.
  double energy_residual = 0;
  CombustionEnd end = CombustionEnd::time;
  std::string reason;               ///< why it broke off
  double energy_drift = 0;          ///< largest of the whole run, see `largest_energy_drift`
  double wall_time = 0;             ///< s, of the whole run
  std::vector<Snapshot> snapshots;  ///< from ignition on; of `run_case` only
  std::size_t samples() const { return time.size(); }
};

/// How a closing gap closed (scene::GapModel::closing). Means are over the area of the charge's bottom.
struct ClosingHistory {
  double gap = 0;                            ///< m, at rest
  std::vector<double> time;                  ///< s, those of the trace
  std::vector<double> opening;               ///< m, mean
  std::vector<double> gas_pressure;          ///< Pa, mean
  double smallest_opening = 0;               ///< m, anywhere
  double contact_time = math::not_a_number;  ///< s, when the faces first met anywhere
  double approach_speed = 0;                 ///< m/s, the largest anywhere until then
  int contacts = 0;                          ///< how often they met after nowhere touching
  double largest_gas_pressure = 0;           ///< Pa, anywhere
  double largest_gas_temperature = 0;        ///< K, mean over the air at one place
  surface::FilmEnergy energy;                ///< J/m2, means
  double work_on_gas = 0;  ///< J/m2, mean, that the faces did beyond the surrounding pressure
};

/// One gap of a case.
struct GapResult {
  double gap = 0;  ///< m
  surface::SkinHistory skin;
  surface::Maximum at_stations;  ///< T_max over the stations, the whole bottom: what verdicts use
  surface::Maximum at_points;    ///< over the observation points; NaN without any
  surface::AirEnergy air;        ///< what the skin took from the air; NaN in files that are older than this
  double sampling_error = 0;     ///< K, |T_max - T_max on the thinned trace|
  bool with_mechanics = false;   ///< integrated inside the mechanics rather than on its trace
  std::optional<ClosingHistory> closing;        ///< where the gap closes
  std::optional<CombustionHistory> combustion;  ///< of one that ignited, where the coupling is two-way
};

struct CaseResult {
  MechanicsResult mechanics;
  std::vector<GapResult> gaps;
};

}  // namespace launchsafe::run
