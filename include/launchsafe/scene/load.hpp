// A load: its measured curve, which surfaces of the shell it acts on, when its launch is over, and what
// smoothing takes from a measured one.
#pragma once

#include "launchsafe/scene/input_error.hpp"
#include "launchsafe/scene/scene.hpp"

#include <filesystem>

namespace launchsafe::scene {

// --- measured chamber pressure from a CSV file; from what a gauge recorded to a curve that a scene takes ---

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
/// "t [s]<tab>p [psi]", the columns in either order. The header's separator, a semicolon, a tab or else a
/// comma, separates all lines; where it is no comma, numbers may have decimal commas. Lines that start with #
/// are left out; `file` is named in errors. Throws an InputError.
PressureCurve parse_pressure_curve(const std::string& text, const std::string& file);

/// The same of a record as a gauge writes it: further columns are left out, and pressures may be negative.
/// `column`: name of the pressure's column without its unit; empty: the only one that is a pressure.
PressureCurve parse_gauge_record(const std::string& text, const std::string& file, const std::string& column);

/// What the user says of a record; what is absent is found in it.
struct GaugeCleaning {
  std::optional<double> offset = {};   ///< Pa, that the gauge shows before the launch
  std::optional<double> trigger = {};  ///< Pa above the offset; where it is passed the launch begins
};

/// A cleaned curve, and what was done.
struct CleanedRecord {
  PressureCurve curve;                 ///< its time is 0 where the launch begins
  double offset = 0.0;                 ///< Pa, that was taken away
  std::size_t quiet_points = 0;        ///< before the launch, whose median the offset is
  double trigger = 0.0;                ///< Pa
  double start = 0.0;                  ///< s, of the record, that is 0 now
  std::size_t points_before = 0;       ///< left out
  std::size_t points_below_zero = 0;   ///< set to 0
  double lowest = 0.0;                 ///< Pa, of these
  double peak = 0.0, peak_time = 0.0;  ///< Pa and s, of the curve
};

/// Takes the offset away, lets time begin at the trigger, and sets pressures below zero to 0. The offset is
/// the median of the points before the rise, of which there have to be ten unless it is given; the trigger
/// is 1 % of the peak. Throws an InputError for a stated offset that those points contradict by more than a
/// thousandth of the peak, a trigger that is never passed, and a pressure further below zero than 5 % of it.
CleanedRecord clean(const PressureCurve& record, const GaugeCleaning& cleaning, const std::string& file);

/// The curve as a CSV file that scenes take, with `remarks` (lines) above the header.
std::string csv_of(const PressureCurve& curve, const std::string& remarks);

// --- which surfaces face the chamber: its gas fills all that is open towards it, up to the driving band ---

enum class BodySide { x_begin, x_end, r_begin, r_end };

/// A part of a body's surface that the chamber pressure acts on.
struct ChamberFace {
  std::size_t body = 0;  ///< index into Scene::bodies
  BodySide side = BodySide::x_end;
  double begin = 0, end = 0;  ///< m: radii of a face across x, places along x of a side

  bool operator==(const ChamberFace&) const = default;
  bool across_x() const { return side == BodySide::x_begin || side == BodySide::x_end; }
  /// Of the force of a pressure on it, along x or r.
  double direction() const { return side == BodySide::x_end || side == BodySide::r_end ? -1.0 : 1.0; }
};

struct Chamber {
  std::vector<ChamberFace> faces;  ///< in the order of the bodies, each from its begin on
  double band = 0;                 ///< m, base-side end of the annulus of full radius that seals the chamber
  bool sealed = false;             ///< what is drawn seals it; otherwise the rearmost faces alone are loaded
};

/// Gas fills what is open towards the base, and what lies between the barrel and a shell of less than the
/// full radius behind the band. The band is at `Load::obturation`, or at the foremost annulus of full radius.
/// A chamber is not sealed where gas passes the band or reaches the charge, nor where the updated-Lagrangian
/// form, which loads the rearmost faces alone, would have to load others. Nothing without bodies.
Chamber chamber_of(const Scene& scene);

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
/// Whether the simulation ends before the launch is over.
bool is_cut_short(const Load& load);
/// The same load in a barrel without end.
Load without_exit(Load load);

/// For people: "796 m/s after 5.26 m of travel, at 18 ms with 12.5 % of the peak pressure"; empty without an
/// exit.
std::string exit_text(const Scene& scene);
/// The same of the end of the simulation.
std::string end_text(const Scene& scene);
/// The launch in a sentence, of the exit, or of the end where there is none: "The shot leaves the barrel with
/// 796 m/s ..."
std::string launch_sentence(const Scene& scene);

// --- what smoothing and sampling take from a measured curve ---

/// Share of the largest pressure of a measured curve that its smoothing takes away; 0 without smoothing.
double peak_lost_to_smoothing(const Load& load);
/// Share of the largest point of a measured curve by which the peak beside it may be higher: a pulse that
/// bends one way there lies below the chords beside. 0 for fewer than four points, of which nothing follows.
double peak_missed_between_points(const Load& load);
/// For people: what smoothing takes from the peak of a measured curve; empty without smoothing.
std::string smoothing_text(const Load& load);

}  // namespace launchsafe::scene
