// One launch, as plain values in SI units: what is simulated and how. Reading it from a file is in
// `read_scene.hpp`.
#pragma once

#include "launchsafe/materials/friction_closure.hpp"
#include "launchsafe/materials/ideal_gas.hpp"
#include "launchsafe/materials/laws.hpp"

#include <memory>

namespace launchsafe::scene {

enum class Barrel { rigid, none };
/// auto: the plan decides from the scene's own numbers.
enum class Switch { automatic, on, off };
/// Which configuration gradients and transfer refer to: the one at rest, or the present one (uGIMP).
enum class Formulation { total_lagrangian, updated_lagrangian };
using materials::FrictionClosure, materials::word_of;
/// The analytic shapes of a load.
enum class LoadShape { bell, power_exponential };
/// The word of a shape in scene files and reports.
std::string word_of(LoadShape shape);

/// What bodies are made of: a law with its parameters, under the name that bodies refer to it by.
struct Material {
  std::string name;
  materials::Law law;
  std::string title = {};  ///< for people, such as "PBX 9501"; may be empty
};
/// One of each law, as it is by default, under the law's own name.
std::vector<Material> usual_materials();

/// A rectangle of one material in the (x, r) half plane; x grows from nose to base. Lengths in m.
struct Body {
  std::string name;
  std::string material = std::string(materials::Steel::name);  ///< name of one of the scene's materials
  double x_begin = 0, x_end = 0;
  double r_begin = 0, r_end = 0;
};

/// Pressure of the chamber on what faces it (load.hpp). Either a measured curve or, over time t, one of
/// the analytic shapes
///   bell                p0 + (peak - p0) exp(-|(t - t_m)/w|^a)
///   power-exponential   p0 + (peak - p0) ((t/t_m) exp(1 - t/t_m))^n, which is p0 before 0.
/// Where the shot leaves a muzzle, the pressure falls from then on by exp(-t/exit_decay) to p0, of a measured
/// curve to 0.
struct Load {
  LoadShape shape = LoadShape::bell;
  std::optional<double> duration;      ///< s, where not all of the launch is simulated: see `end_time`
  double peak = 496e6;                 ///< Pa
  double base = 101325.0;              ///< p0, Pa
  double peak_time = 10.98965e-3;      ///< t_m, s [C]
  double width = 2.890024e-3;          ///< w, s [C], of the bell alone: the pressure is 1/e of its peak there
  double steepness = 1.518591;         ///< a [C], of the bell alone
  double exponent = 13.578;            ///< n [A], of the power-exponential alone
  std::string curve_file;              ///< as the user wrote it
  std::vector<double> curve_time;      ///< s, increasing; empty for the analytic shape
  std::vector<double> curve_pressure;  ///< Pa, one for every time
  bool rescale_to_peak = false;        ///< scale the measured curve, smoothed, so that its maximum is `peak`
  double smoothing = 0.0;              ///< s; window over which a measured curve is averaged, 0 = as measured
  std::optional<double> muzzle_exit;   ///< s, when the shot leaves the barrel
  std::optional<double> muzzle_travel;  ///< m, after which it does: `muzzle_exit` follows from it
  double exit_decay = 1e-4;             ///< s, time constant of the pressure after the exit
  /// m/s at the exit, or at the end where there is none, as a range table has it: a check of what is typed,
  /// and no part of the launch.
  std::optional<double> expected_velocity;
  /// m, a place along x of the driving band up to which the pressure acts. None: the foremost annulus of full
  /// radius.
  std::optional<double> obturation;
};

/// When the simulation ends, s: at `duration` where that is stated, else when the launch is over (load.hpp).
double end_time(const Load& load);
/// When published values at the end of a launch are read, s: at the exit where there is one, else at the end.
double read_time(const Load& load);

using materials::Charge;
using materials::Steel;

/// The bottom gap, its air and the skin of the charge (model section 6).
struct Surface {
  std::vector<double> gaps{0.0};  ///< m
  materials::AirParameters air;
  double skin_thickness = 1e-4;        ///< h_ex, m
  double exchange_time = 2.809453e-4;  ///< tau_ex, s [C]
  /// Stations tile the charge's bottom by about this width and this depth, m.
  double station_width = 5e-3, station_depth = 5e-3;
  FrictionClosure friction = FrictionClosure::total_strain_rate;
  double localisation = 1276.794;  ///< [C]
};

struct Numerics {
  Formulation formulation = Formulation::total_lagrangian;
  /// Largest cell (m) at the edges of the charge that face the gap and the wall; everywhere else too where
  /// the growth is 1.
  double cell_size = 2.5e-3;
  /// Ratio of neighbouring cells away from these edges, by direction; 1 = even.
  double growth_x = 1.0, growth_r = 1.0;
  double largest_cell = 10e-3;  ///< m, where cells grow
  double hourglass_stiffness =
      0.1;                     ///< share of the hourglass modulus: that of shear, a fifth of it in a charge
  int particles_per_cell = 1;  ///< in each direction
  double time_step_factor = 0.5;  ///< CFL
  double inertial_scaling = 1.0;  ///< s >= 1
  /// >= 1; steps over those that the cells at rest allow: cells that allow less get the inertia for it. A
  /// scene file that does not state it has usual_selective_inertia.
  double selective_inertia = 1.0;
  double damping_time = 0.0;         ///< s; decay time of the relative velocity, 0 = no damping
  double pic_fraction = 0.0;         ///< share of PIC in the velocity update, 0 = pure FLIP
  double energy_drift_limit = 0.05;  ///< of the energy scale; past it the run is stopped and indeterminate
};

/// How two bodies hold each other where they touch.
enum class Condition { bonded, sliding };

/// The faces between a body and the charge. Faces that no interface speaks of are bonded.
///
/// Sliding faces bear no tension, may part and meet again, and resist sliding by Coulomb's law.
struct Interface {
  std::string body;  ///< name of the body that touches the charge
  Condition condition = Condition::bonded;
  std::optional<double> friction = {};  ///< Coulomb's coefficient; given where the faces can slide
  /// Name of the other body; empty: every charge that `body` touches. For checks of contact against closed
  /// forms, which have no charge; no file says it.
  std::string against = {};
  bool from_constants = false;  ///< a constants file holds the body so, and the scene says nothing of it
};
/// Largest coefficient of friction; beyond it faces stick for any load.
inline constexpr double largest_friction = 10.0;

struct ObservationPoint {
  std::string name;
  double x = 0, r = 0;  ///< m
};

/// Instants that a snapshot may be of, in the order in which a launch has them as a rule.
enum class Event { peak_pressure, ignition };
/// The words of all of them in files, by the event's number: "peak-pressure", ...
const std::vector<std::string>& event_words();
inline const std::string& word_of(Event event) { return event_words()[static_cast<std::size_t>(event)]; }

struct Output {
  double trace_interval = 2e-5;  ///< s
  std::vector<ObservationPoint> observation_points;
  std::vector<double> snapshot_times;  ///< s; full particle fields written at these times
  std::vector<Event> snapshot_events;  ///< and at these
  bool asks_for_snapshots() const { return !snapshot_times.empty() || !snapshot_events.empty(); }
  bool asks_for(Event event) const {
    return std::find(snapshot_events.begin(), snapshot_events.end(), event) != snapshot_events.end();
  }
};

struct Physics {
  Switch conduction = Switch::automatic;     ///< grid heat conduction
  Switch bulk_reaction = Switch::automatic;  ///< Arrhenius heat in the bulk of the charge
};

/// Whether what the skin does after its ignition acts on the mechanics.
enum class Coupling { one_way, two_way };
/// What follows ignition in a run with two-way coupling.
struct Combustion {
  double duration = 1e-3;      ///< s after the first ignition, at which the run ends
  double stop_pressure = 2e9;  ///< Pa on the charge's bottom, at which it ends before
};

struct Scene {
  std::string title;
  Barrel barrel = Barrel::rigid;
  bool open_charge = false;            ///< ends of the charge but its bottom need not bear on bodies
  double initial_temperature = 300.0;  ///< K
  std::vector<Body> bodies;
  std::vector<Interface> interfaces;
  Load load;
  std::vector<Material> materials = usual_materials();  ///< each name once; files fill the usual ones
  Surface surface;
  Numerics numerics;
  Output output;
  Physics physics;
  Coupling coupling = Coupling::one_way;
  Combustion combustion;

  /// The first material of a law, which the law's keys speak of. The usual one where there is none; the
  /// second form then adds it.
  template <class Law>
  const Material& material() const {
    static const Material usual{std::string(Law::name), Law{}};
    for (const Material& material : materials)
      if (std::holds_alternative<Law>(material.law)) return material;
    return usual;
  }
  template <class Law>
  Material& material() {
    for (Material& material : materials)
      if (std::holds_alternative<Law>(material.law)) return material;
    return materials.emplace_back(Material{std::string(Law::name), Law{}});
  }
  /// Its parameters.
  template <class Law>
  const Law& parameters() const {
    return std::get<Law>(material<Law>().law);
  }
  template <class Law>
  Law& parameters() {
    return std::get<Law>(material<Law>().law);
  }
  const Steel& steel() const { return parameters<Steel>(); }
  Steel& steel() { return parameters<Steel>(); }
  const Charge& charge() const { return parameters<Charge>(); }
  Charge& charge() { return parameters<Charge>(); }
};

/// Takes away what is there for people alone, titles.
void clear_remarks(Scene& scene);

/// The material of a name; none where the scene has none of that name.
const Material* find_material(const Scene& scene, std::string_view name);
/// The law of a body's material, which the scene must have.
const materials::Law& law_of(const Scene& scene, const Body& body);
/// A body's material for people: "charge (PBX 9501)" where it has a title.
std::string material_text(const Scene& scene, const Body& body);
/// Whether a body is made of the material of that name.
bool is_used(const Scene& scene, std::string_view material);
/// The materials that bodies are made of, in the scene's order.
std::vector<Material> used_materials(const Scene& scene);
/// Whether a body is of that law.
template <class Law>
bool has_law(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [&scene](const Body& body) {
    const Material* material = find_material(scene, body.material);
    return material != nullptr && std::holds_alternative<Law>(material->law);
  });
}
/// Whether a body is of an explosive: the charge, whose bottom is looked at.
bool is_charge(const Scene& scene, const Body& body);
bool has_charge(const Scene& scene);

/// Whether the faces can part and slide.
bool can_slide(const Interface& faces);
/// The interfaces that can slide, by the names of their bodies. All others do nothing.
std::vector<Interface> sliding_interfaces(const Scene& scene);
/// The interface that speaks of two bodies (indices into Scene::bodies); none where they are bonded.
const Interface* interface_between(const Scene& scene, std::size_t a, std::size_t b);

/// The smallest rectangle around all bodies, the charges, or those that a rule chooses; nothing at 0 without
/// any.
struct Extent {
  double x_begin = 0, x_end = 0, r_begin = 0, r_end = 0;
};
Extent extent_of(const Scene& scene);
Extent charge_extent(const Scene& scene);
Extent extent_where(const Scene& scene, const std::function<bool(const Body&)>& choose);
/// The round-off of lengths that users write in decimals, m: places closer than this are one.
double length_tolerance(const Scene& scene);

/// Masses in kg, of the whole shell.
double mass_of(const Scene& scene, std::string_view material);
double total_mass(const Scene& scene);
/// Area by which the chamber pressure drives the projectile along x, m2: that of the faces towards the base
/// less that of those towards the nose.
double base_area(const Scene& scene);

/// Axial acceleration (m/s2) of the whole projectile as one rigid body under a pressure (Pa) of the chamber.
double rigid_acceleration(const Scene& scene, double pressure);
/// How fast (m/s) and how far (m) the load has driven the whole projectile as one rigid body at a time (s),
/// where nothing holds it back.
struct RigidMotion {
  double velocity = 0, travel = 0, time = 0;
};
RigidMotion rigid_motion(const Scene& scene, double time);
/// For people: "796 m/s after 5.26 m of travel".
std::string rigid_motion_text(const Scene& scene, double time);

/// Chamber pressure (Pa) at time t (s); monotone cubic (PCHIP) through a measured curve of at
/// least two points at increasing times, held constant outside it. Curves of two or three points are joined
/// by straight lines. With `smoothing` it is the moving average of that, centred, over a window no longer
/// than the curve, whose ends are mirrored: impulse is kept, peaks fall. Only then is it rescaled.
class PressureHistory {
 public:
  explicit PressureHistory(const Load& load);
  double at(double time) const;
  /// Largest pressure until the end of the simulation, Pa, and when it is, s.
  double peak() const { return largest().second; }
  double peak_time() const { return largest().first; }
  /// Largest pressure of the whole load as stated, Pa, whatever the end: `load.peak` of the analytic
  /// shape, the largest point of a measured curve before smoothing, in the scale of `at`.
  double stated_peak() const;
  /// When the launch is over, s, whatever `Load::duration` says: see scene::launch_end.
  double launch_end() const;
  /// Times from 0 to the end of the simulation, both included, at which the curvature of a measured curve
  /// changes: what it does is seen at these. For the analytic shape only the ends, its peak, and the exit.
  std::vector<double> marks() const;
  /// The motion of a body of 1 kg/m2 that it drives from rest until a time (s).
  RigidMotion drive(double until) const;

 private:
  double in_barrel(double time) const;        ///< Pa, as it would go on without the exit
  std::pair<double, double> largest() const;  ///< its time, s, and the largest pressure, Pa
  double exit() const { return load_.muzzle_exit.value_or(std::numeric_limits<double>::infinity()); }
  bool is_measured() const { return !load_.curve_time.empty(); }

  Load load_;
  std::function<double(double)> curve_;  ///< between its first and its last point; none of an analytic shape
  double scale_ = 1.0;
  double exit_pressure_ = 0.0, pressure_outside_ = 0.0;  ///< Pa
};

}  // namespace launchsafe::scene
