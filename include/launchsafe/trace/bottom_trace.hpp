// What the mechanics hands to the surface: the history of the charge bottom, independent of any gap.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace launchsafe::trace {

/// An annulus of the charge's bottom, over which pressure and strain are averaged before the skin's
/// temperature is integrated; or an observation point, at which they are read. Verdicts rest on the annuli,
/// which tile the whole bottom.
struct Station {
  std::string name;          ///< "S1".. from the wall to the axis; of observation points that of the scene
  double x = 0, r = 0;       ///< initial position; of an annulus the middle of its width, on the bottom, m
  double area = 0;           ///< of the annulus, m2; 0 for observation points
  bool observation = false;  ///< false for an annulus
};

/// Samples at increasing times, the first at t = 0. Friction is kept as energy since the start, so thinning
/// the trace loses none of it; pressure as the value and as the mean over the interval that ends at the
/// sample.
struct BottomTrace {
  std::vector<Station> stations;
  std::vector<double> time;                  ///< s
  std::vector<double> chamber_pressure;      ///< Pa
  std::vector<double> bottom_pressure;       ///< Pa, area mean of the axial compression over the bottom row
  std::vector<double> mean_bottom_pressure;  ///< Pa, over the interval ending here (first entry: the value)
  /// [sample * stations + station]: friction energy since the start, J per m3 of charge, with localisation 1
  /// (bulk).
  std::vector<double> friction;

  std::size_t samples() const { return time.size(); }
  /// Of a station; empty for one that the trace has not.
  std::string name_of(std::size_t station) const {
    return station < stations.size() ? stations[station].name : std::string{};
  }
};

/// The same history `factor` (> 0) times as slow: that of a pulse so much longer, as the charge responds to
/// the pressure of a launch quasi-statically. Pressures and energies stay.
BottomTrace stretched(BottomTrace trace, double factor);

/// A history as far from `trace` as `other` is, on the other side: a^2/b for every pressure and energy a of
/// `trace` and b of `other`. Nothing where the two do not have the same samples and stations.
std::optional<BottomTrace> mirrored(const BottomTrace& trace, const BottomTrace& other);

/// The annuli alone, which tile the bottom: what is asked of them costs half without observation points.
BottomTrace of_rings(BottomTrace trace);

/// The samples up to a time (s) alone.
BottomTrace until(const BottomTrace& trace, double time);

/// Value at time t by linear interpolation between samples; held constant outside. NaN for a NaN time,
/// without samples, or where the sizes differ.
double interpolate(const std::vector<double>& time, const std::vector<double>& value, double t);

}  // namespace launchsafe::trace
