// What one case came to: the mechanics once, and a skin history for every gap.
#pragma once

#include "launchsafe/mpm/energy.hpp"
#include "launchsafe/scene/constants.hpp"
#include "launchsafe/surface/skin.hpp"

#include <map>
#include <memory>
#include <tuple>

namespace launchsafe::run {

using mpm::EnergyBalance, scene::model_version;

/// A member of a result as case files have it, described once.
template <class Member>
struct Stored {
  const char* name;
  Member member;
  const char* unit;  ///< "1" of pure numbers, "none" of text; values in memory are in SI
};
template <class Member>
Stored(const char*, Member, const char*) -> Stored<Member>;

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
  outside_gas_law
};
inline constexpr RunStatus last_status = RunStatus::outside_gas_law;
std::string to_string(RunStatus status);

/// The terms of the energy balance, of the whole shell.
inline constexpr std::array energy_terms{
    Stored{"kinetic_energy", &EnergyBalance::kinetic,
           "J"},  // kinetic energy relative to the frame, with the scaled inertia
    Stored{"internal_energy", &EnergyBalance::internal, "J"},  // integrated stress power
    Stored{"external_work", &EnergyBalance::external, "J"},    // work of the chamber pressure
    Stored{"body_force_work", &EnergyBalance::body_force,
           "J"},                                           // work of the accelerating frame's body force
    Stored{"damping_loss", &EnergyBalance::damping, "J"},  // taken out by damping and the PIC share
    Stored{"contact_loss", &EnergyBalance::contact,
           "J"},  // taken out by friction between bodies and where their faces meet
    Stored{"plastic_dissipation", &EnergyBalance::plastic, "J"},  // dissipated in steel
    Stored{"viscous_dissipation", &EnergyBalance::viscous,
           "J"},                                              // dissipated in the charge's Maxwell elements
    Stored{"crack_dissipation", &EnergyBalance::crack, "J"},  // dissipated by crack growth
    Stored{"hourglass", &EnergyBalance::hourglass,
           "J"},  // stored against hourglassing, part of the internal energy
    Stored{"charge_work", &EnergyBalance::charge_work,
           "J"},  // integrated stress power of the charge, part of the internal energy
    Stored{
        "charge_friction", &EnergyBalance::charge_friction,
        "J"},  // friction heat of the charge with localisation 1, of its total strain; no part of the balance
};

/// Elastic energy (J) that the bodies would hold under a hundredth of the load's peak, or of an atmosphere
/// where that is more: drift is not judged on less, where it would be the first cells' share in the first
/// steps, or round-off where there is no load.
double least_judged_energy(const scene::Scene& scene);

/// A row of the monitor history.
struct MonitorSample {
  double time = 0;       ///< s
  double time_step = 0;  ///< s
  EnergyBalance energy;
  double largest_plastic_strain = 0;
  double largest_crack_radius = 0;  ///< m
  double momentum = 0;  ///< kg m/s, axial, relative to the frame, of steel with its own inertial factor
};

inline bool is_finite(const MonitorSample& sample) {
  const auto has_energy = [&](const auto& term) { return std::isfinite(sample.energy.*term.member); };
  return std::ranges::all_of(energy_terms, has_energy) &&
         std::isfinite(sample.time + sample.time_step + sample.largest_plastic_strain +
                       sample.largest_crack_radius + sample.momentum);
}

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
  /// particle's neighbours are.
  std::vector<double> half_length_x, half_length_r;
  std::vector<double> burnt_share;  ///< of the particle's mass; empty where nothing burns
  std::vector<int> body;            ///< index into Scene::bodies
  /// m, both ends of every station that tiles the charge's bottom, at present, in the order of the trace.
  std::vector<double> bottom_x, bottom_r;
  std::vector<BottomSkin> skins;    ///< of the case's gaps; none where the mechanics ran alone
  std::vector<FaceSnapshot> faces;  ///< of those that can slide, in the order of MechanicsResult::interfaces
};

/// A quantity of the particles, described once: case files, XDMF, pictures and tables go through the list.
struct SnapshotField : materials::StateField {
  std::vector<double> Snapshot::*values = nullptr;  ///< where it is; null for a law's, in Snapshot::state
  bool always = false;                ///< whether snapshots have it always, or where it is not empty
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

/// On how many particle steps limiters acted.
struct LimiterCounts {
  std::uint64_t crack_at_bound = 0, tension_cutoff = 0, hugoniot_guard = 0;
  LimiterCounts& operator+=(const LimiterCounts& other);
  bool operator==(const LimiterCounts&) const = default;
  bool acted() const { return *this != LimiterCounts{}; }
};
struct Limiter : Stored<std::uint64_t LimiterCounts::*> {
  const char* words;  ///< for people
};
inline constexpr std::array limiters{
    Limiter{{"crack_at_bound", &LimiterCounts::crack_at_bound, "1"}, "crack bound"},
    Limiter{{"tension_cutoff", &LimiterCounts::tension_cutoff, "1"}, "tension cut-off"},
    Limiter{{"hugoniot_guard", &LimiterCounts::hugoniot_guard, "1"}, "Hugoniot guard"}};
static_assert(sizeof(LimiterCounts) == limiters.size() * sizeof(std::uint64_t));

/// "crack bound 12, tension cut-off 3"; empty where none acted.
std::string to_string(const LimiterCounts& counts);

/// Mass of the bodies of one material, kg, summed over the particles.
struct MaterialMass {
  std::string material;
  double mass = 0;
};
/// Adds to the entry of a material, at the end where there is none.
void add_mass(std::vector<MaterialMass>& masses, const std::string& material, double mass);

/// A face of the charge on which a body can slide, until the end of the run.
struct InterfaceResult {
  std::string body;
  double overlap = 0;  ///< m, the largest by which the faces passed into each other
};
inline constexpr std::tuple stored_interface{
    Stored{"body", &InterfaceResult::body, "none"},     // the body that touches the charge
    Stored{"overlap", &InterfaceResult::overlap, "m"},  // largest by which the faces passed into each other
};

/// Plastic strain of steel beyond which a wall counts as yielded: that of the proof stress Rp0.2.
inline constexpr double yield_of_wall = 0.002;

struct MechanicsResult {
  RunStatus status = RunStatus::completed;
  std::string reason;   ///< when and where, if not completed
  double end_time = 0;  ///< s, reached
  std::uint64_t steps = 0;
  std::uint64_t particles = 0;
  double wall_time = 0;       ///< s
  double processor_time = 0;  ///< s: what other work on the machine disturbs least
  double particle_updates() const { return double(steps) * double(particles); }
  /// s, of processor time; of wall time where that is not known.
  double work_time() const { return processor_time > 0 ? processor_time : wall_time; }
  double update_rate() const { return work_time() > 0 ? particle_updates() / work_time() : 0; }  ///< 1/s
  std::vector<MaterialMass> masses;  ///< by material, in the order of the first body of each
  trace::BottomTrace trace;
  std::vector<MonitorSample> monitor;
  std::vector<Snapshot> snapshots;
  LimiterCounts limiters;
  std::vector<InterfaceResult> interfaces;  ///< none for bonded bodies
  double yielded_wall = 0;  ///< m, axial length of the steel beside the charge beyond `yield_of_wall`
  double largest_plastic_strain() const {  ///< of the steel at the end; NaN without a monitor history
    return monitor.empty() ? math::not_a_number : monitor.back().largest_plastic_strain;
  }
  double friction_over_work() const {  ///< friction heat of the charge over the net work done on it, or NaN
    const EnergyBalance end = monitor.empty() ? EnergyBalance{} : monitor.back().energy;
    return end.charge_work > 0.0 ? end.charge_friction / end.charge_work : math::not_a_number;
  }
};

/// 0 for a material without particles.
double mass_of(const MechanicsResult& mechanics, std::string_view material);

/// Largest absolute energy drift over the monitor's history, as a share of the run's largest energy (in the
/// first moments all energies are next to nothing); NaN without one.
double largest_energy_drift(const MechanicsResult& mechanics);

/// Why a run that burns ended.
enum class CombustionEnd { time, pressure, broke_off };

/// What followed the ignition of a gap in a run with two-way coupling; samples are those of the trace from
/// the one before ignition on. Of the whole shell.
struct CombustionHistory {
  std::vector<double> time, burnt_mass, gas_volume, gas_temperature, pressure, released, brought;
  std::vector<double> reaction_degree;  ///< of the skin, [sample * stations + station]
  double energy_residual = 0;
  CombustionEnd end = CombustionEnd::time;
  std::string reason;
  double energy_drift = 0, wall_time = 0;  ///< of the whole run, see `largest_energy_drift`
  std::vector<Snapshot> snapshots;         ///< from ignition on; of `run_case` only
  std::size_t samples() const { return time.size(); }
};
inline constexpr std::tuple stored_combustion{
    Stored{"reason", &CombustionHistory::reason, "none"},           // why it broke off
    Stored{"energy_drift", &CombustionHistory::energy_drift, "1"},  // largest energy drift of the run
    Stored{"wall_time", &CombustionHistory::wall_time, "s"},        // wall time of the run
    Stored{"energy_residual", &CombustionHistory::energy_residual,
           "1"},  // largest energy made or lost over the heat of reaction of what had burnt
    Stored{"time", &CombustionHistory::time, "s"},                        // time
    Stored{"burnt_mass", &CombustionHistory::burnt_mass, "kg"},           // mass of the gas
    Stored{"gas_volume", &CombustionHistory::gas_volume, "m3"},           // volume of the gas
    Stored{"gas_temperature", &CombustionHistory::gas_temperature, "K"},  // mean over the gas's mass
    Stored{"pressure", &CombustionHistory::pressure, "Pa"},               // mean over the bottom
    Stored{"released", &CombustionHistory::released, "J"},                // heat of reaction released
    Stored{"brought", &CombustionHistory::brought,
           "J"},  // heat above the initial temperature that the burnt part had before
};

/// One gap of a case.
struct GapResult {
  double gap = 0;  ///< m
  surface::SkinHistory skin;
  surface::Maximum at_stations;  ///< T_max over the stations, the whole bottom: what verdicts use
  surface::Maximum at_points;    ///< over the observation points; NaN without any
  surface::AirEnergy air;        ///< what the skin took from the air
  std::optional<CombustionHistory> combustion;  ///< of one that ignited, where the coupling is two-way
};

struct CaseResult {
  MechanicsResult mechanics;
  std::vector<GapResult> gaps;
};

}  // namespace launchsafe::run
