// Of a load: its measured curve, which surfaces of the shell it acts on, when its launch is over, and how
// much of a measured one is noise.
#pragma once

#include "launchsafe/scene/input_error.hpp"
#include "launchsafe/scene/scene.hpp"

#include <filesystem>

namespace launchsafe::scene {

// --- measured chamber pressure from a CSV file: two columns under a header that names the units; and from
// what a pressure gauge recorded to a curve that a scene takes: its offset, the start of the launch, its
// noise ---

/// Pa; no load may be larger, whether it comes from a file or stands in a scene.
inline constexpr double largest_load = 10e9;
/// s; two points of a curve are further apart. No gauge is faster, and slopes stay finite.
inline constexpr double least_curve_interval = 1e-12;
/// s; times of a curve lie within this of 0, so that impulses stay finite.
inline constexpr double largest_curve_time = 1e6;

struct PressureCurve {
  std::vector<double> time;      ///< s, increasing, up to `largest_curve_time` on either side of 0
  std::vector<double> pressure;  ///< Pa, 0 to `largest_load`
};

/// Reads at least two points under a header such as "time_ms,pressure_MPa", "Time (ms);Pressure (bar)" or
/// "t [s]<tab>p [psi]". Columns may stand in either order. What separates them in the header, a semicolon, a
/// tab or else a comma, separates them everywhere. Cells may be in quotation marks. Between semicolons or
/// tabs, or in quotation marks, numbers may have decimal commas, then all of them. Lines that start with #
/// are left out; lines end with LF, CRLF or CR; a byte-order mark of UTF-8 is passed over. At most
/// `largest_curve` bytes.
Expected<PressureCurve> read_pressure_curve(const std::filesystem::path& file);

/// The same from text; `file` is only named in errors.
Expected<PressureCurve> parse_pressure_curve(const std::string& text, const std::string& file);

/// Like `parse_pressure_curve`, of a record as a gauge writes it: further columns are left out, and pressures
/// may be negative, down to -`largest_load`. `column`: name of the pressure's column in the header without
/// its unit; empty: the only one that is a pressure.
Expected<PressureCurve> parse_gauge_record(const std::string& text, const std::string& file,
                                           const std::string& column);

/// What the user says of a record; what is absent is found in it.
struct GaugeCleaning {
  std::optional<double> offset = {};   ///< Pa, that the gauge shows before the launch
  std::optional<double> trigger = {};  ///< Pa above the offset; where it is passed the launch begins
};

/// A cleaned curve, and what was done.
struct CleanedRecord {
  PressureCurve curve;            ///< its time is 0 where the launch begins
  double offset = 0.0;            ///< Pa, that was taken away
  double noise = 0.0;             ///< Pa, standard deviation of what is before the launch; 0 where unknown
  std::size_t quiet_points = 0;   ///< before the launch, that offset and noise are of
  double trigger = 0.0;           ///< Pa
  double start = 0.0;             ///< s, of the record, that is 0 now
  std::size_t points_before = 0;  ///< left out
  std::size_t points_below_zero = 0;   ///< noise about zero, set to 0
  double lowest = 0.0;                 ///< Pa, of these
  double peak = 0.0, peak_time = 0.0;  ///< Pa and s, of the curve
};

/// Takes the offset away, lets time begin at the trigger, and sets what noise left below zero to 0. All other
/// noise stays: what an average takes from a load counts as uncertainty where the scene averages
/// (load.smoothing), and would be stated nowhere if it were taken here.
///
/// The offset is the median of the points before the rise, which is where 2 % of the range is last passed
/// before the largest pressure; without at least ten such points it has to be given. The trigger is 1 % of
/// the peak, or five standard deviations of the noise where that is more. Errors, in the sense of the record:
/// no quiet points and no offset; an offset that differs from that of the quiet points by more than their
/// noise and a thousandth of the peak; a trigger that is never passed; a pressure further below zero than ten
/// standard deviations of the noise and 2 % of the peak, which is no noise.
Expected<CleanedRecord> clean(const PressureCurve& record, const GaugeCleaning& cleaning,
                              const std::string& file);

/// The curve as a CSV file that scenes take, with `remarks` (lines) above the header.
std::string csv_of(const PressureCurve& curve, const std::string& remarks);

// --- which surfaces face the chamber: its gas fills all that is open towards it, up to the driving band ---

enum class BodySide { x_begin, x_end, r_begin, r_end };

/// A part of a body's surface that the chamber pressure acts on.
struct ChamberFace {
  std::size_t body = 0;  ///< index into Scene::bodies
  BodySide side = BodySide::x_end;
  double begin = 0, end = 0;  ///< m: radii of a face across x, places along x of a side

  bool across_x() const { return side == BodySide::x_begin || side == BodySide::x_end; }
  /// Of the force of a pressure on it, along x or r.
  double direction() const { return side == BodySide::x_end || side == BodySide::r_end ? -1.0 : 1.0; }
};

struct Chamber {
  std::vector<ChamberFace> faces;  ///< in the order of the bodies, each from its begin on
  double band = 0;                 ///< m, base-side end of the ring of full radius that seals the chamber
  /// What the drawing leaves open, for people, and files are refused for; empty where it is clear. Otherwise
  /// the rearmost faces alone are loaded.
  std::string unclear;
};

/// Gas fills what is open towards the base, and what lies between the barrel and a shell of less than the
/// full radius behind the band. The band is at `Load::obturation`, or at the foremost ring of full radius.
/// What has the full radius lies against the barrel. Nothing without bodies.
Chamber chamber_of(const Scene& scene);

/// Whether the chamber pressure acts on the rearmost faces alone, as on a flat base of full radius.
bool acts_on_rear_alone(const Scene& scene, const Chamber& chamber);

/// For people: area and force along x at a pressure (Pa), and how much that is of pi R^2 p.
std::string chamber_text(const Scene& scene, double pressure);

// --- when a launch is over: its load has fallen below a hundredth of its peak, or the shot has left the
// barrel and the pressure behind it is gone ---

/// Share of its peak, over its base, below which a load no longer heats: heat goes with the square of the
/// pressure, and a hundredth of the pressure is 1e-4 of the heat.
inline constexpr double share_when_over = 0.01;

/// When the launch is over, s, whatever `Load::duration` says: after a muzzle exit, at the end of its decay;
/// else the time after the peak from which an analytic load is below `share_when_over`, or the last point of
/// a measured curve.
double launch_end(const Load& load);

/// Pressure over the base, as a share of that at the peak, that is left at a time (s). The base of a measured
/// curve is 0.
double share_left(const Load& load, double time);

/// Travel of the projectile as one rigid body over its diameter.
double calibres_of(const Scene& scene, const RigidMotion& motion);

/// Whether the simulation ends before the launch is over.
bool is_cut_short(const Load& load);

/// The same load in a barrel without end.
Load without_exit(Load load);
/// The load of the same launch where it goes on for longer than it is simulated: until it is over where
/// `Load::duration` cuts it short, else in a barrel without end where it has a muzzle exit. None for others,
/// nor for what would go on for more than ten times as long.
std::optional<Load> longer_launch(Load load);

/// For people: "796 m/s after 5.26 m of travel, at 18 ms with 12.5 % of the peak pressure"; empty without an
/// exit.
std::string exit_text(const Scene& scene);
/// For people: "799 m/s after 6.2 m of travel, at 19.3 ms, where 1 % of the peak pressure is left".
std::string end_text(const Scene& scene);
/// The launch in a sentence, of the exit, or of the end where there is none: "The shot leaves the barrel with
/// 796 m/s ..."
std::string launch_sentence(const Scene& scene);

// --- how much of a measured load's swings is noise, and what smoothing does about it ---

/// The shortest window of smoothing, as a share of the curve's length: averages over shorter ones would be
/// round-off, and no curve has points so near to each other.
inline constexpr double least_smoothing_share = 1e-6;

/// Roughness from which on the friction heat of a load is off by more than a kelvin or so.
inline constexpr double least_roughness = 0.01;

/// The same load averaged over another window (s).
Load averaged(Load load, double window);
/// The whole of a measured curve as a load.
Load load_of_curve(const PressureCurve& curve);

/// The integral of p |dp| over the simulated time, of the history that is simulated, over that of the same
/// curve without noise, minus 1; 0 for the analytic load. Where strain follows pressure, as it does in a
/// launch, friction on the total strain rate heats with this integral, so that a share roughness / (1 +
/// roughness) of the rise is false.
///
/// Without noise means without swings that are smaller than eight standard deviations of the measured points
/// about a cubic through their four neighbours, or than a hundredth of the peak: humps and steps that are
/// larger, or take more points than these, are pressure. A swing that is left out wrongly adds less than
/// twice the threshold over the peak. The extremes of strong noise stay in, so that the integral without
/// noise is too large, by some 5 % for noise of 1 % of the peak, by a quarter for 5 %.
double load_roughness(const Load& load);

/// Share of the largest pressure of a measured curve that its smoothing takes away; 0 without smoothing.
double peak_lost_to_smoothing(const Load& load);

/// Share of the largest point of a measured curve by which the peak beside it may be higher: a pulse that
/// bends one way there lies below the chords beside. 0 for fewer than four points, of which nothing follows.
double peak_missed_between_points(const Load& load);

/// What smoothing takes out of the integral of p |dp| besides noise, over what it leaves: swings of a
/// measured curve that stand above its noise are pressure, and heat. 0 without smoothing.
double work_lost_to_smoothing(const Load& load);

/// The shortest window (s) of some that leaves a measured curve with less than `least_roughness`; nothing
/// where the curve is not rough, no window helps, or a curve of more than 100 000 points would take long to
/// try.
std::optional<double> suggested_smoothing(const Load& load);

/// Swings of a measured curve about one frequency: of the gauge, its mount or the gas.
struct Ring {
  double frequency = 0;  ///< 1/s
  double amplitude = 0;  ///< Pa, of a sine with their power within a twentieth of the frequency
};
/// What the simulated part of a curve has beside its average over 1.25 ms (a tenth of a shorter part) is
/// searched, by its discrete Fourier transform, for frequencies that have more than white noise and the pulse
/// itself, and more than those around them, the strongest first. None count below 0.05 % of the peak: on the
/// 155 mm shell a ring of 0.19 % of the pressure ignites the charge without a gap at 9.8 kHz, where the shell
/// swings along, and at 9.4 kHz it heats by half a kelvin. Sought are frequencies from 0.9 kHz to 2048 in
/// that part, or half the rate of the points.
std::vector<Ring> rings_of(const Load& load);
/// The strongest of them.
std::optional<Ring> ring_of(const Load& load);
/// The strongest swings of which smoothing takes more than a tenth away and that are no white noise, also
/// where many frequencies have as much. Whether they are the gauge's own or pressure no curve tells.
std::optional<Ring> smoothed_ring(const Load& load);
/// For people: "the record pressure.csv rings at 3.2 kHz with 1.5 % of its peak, which heats as pressure
/// does"; empty for none.
std::string ring_text(const Load& load);

/// What is to be known of a measured curve, for people: what smoothing takes from it, and its roughness;
/// empty for the analytic load.
std::string measured_load_text(const Load& load);

}  // namespace launchsafe::scene
