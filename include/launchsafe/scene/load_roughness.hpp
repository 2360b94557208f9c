// How much of a load's going up and down is noise of its measurement, and what smoothing does about it.
#pragma once

#include "launchsafe/scene/pressure_curve.hpp"
#include "launchsafe/scene/scene.hpp"

namespace launchsafe::scene {

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

/// What smoothing takes out of the integral of p |dp| besides noise, over what it leaves: swings of a
/// measured curve that stand above its noise are pressure, and heat. 0 without smoothing.
double work_lost_to_smoothing(const Load& load);

/// The shortest window (s) of some that leaves a measured curve with less than `least_roughness`; nothing
/// where the curve is not rough, no window helps, or a curve of more than 100 000 points would take long to
/// try.
std::optional<double> suggested_smoothing(const Load& load);

/// A swing of one frequency on a measured curve: of the gauge, its mount or the gas.
struct Ring {
  double frequency = 0;  ///< 1/s
  double amplitude = 0;  ///< Pa
};
/// What is left of a curve beside its moving average over a millisecond (a tenth of a shorter curve) is
/// searched, by its discrete Fourier transform, for lines that stand out from the spectrum around them, the
/// strongest first. None are in noise, and none count with an amplitude below 0.05 % of the peak: on the 155
/// mm shell a ring of 0.19 % of the pressure ignites the charge without a gap at 9.8 kHz, where the shell
/// swings along, and at 9.4 kHz it heats by half a kelvin. Sought are frequencies from one over that window
/// to 100 kHz or half the rate of the points.
std::vector<Ring> rings_of(const Load& load);
/// The strongest of them.
std::optional<Ring> ring_of(const Load& load);
/// The strongest ring of which smoothing takes more than a tenth away. Whether it is the gauge's own or
/// pressure no curve tells.
std::optional<Ring> smoothed_ring(const Load& load);
/// For people: "the record pressure.csv rings at 3.2 kHz with 1.5 % of its peak, which heats as pressure
/// does"; empty for none.
std::string ring_text(const Load& load);

/// What is to be known of a measured curve, for people: what smoothing takes from it, and its roughness;
/// empty for the analytic load.
std::string measured_load_text(const Load& load);

}  // namespace launchsafe::scene
