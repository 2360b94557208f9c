// The air of a gap that closes: columns of charge, air and base whose thickness somebody else states.
#pragma once

#include "launchsafe/surface/film_station.hpp"

namespace launchsafe::surface {

/// The air of a column as the motion of its faces sees it.
struct EnclosedAir {
  double pressure = 0;         ///< Pa
  double volume = 0;           ///< m3/m2, without the covolume
  double exponent = 0;         ///< -d ln p/d ln volume of an isentropic change
  double volume_at_walls = 0;  ///< m3/m2, at the same pressure and the temperature of the walls
  /// m/s: over the opening it is the rate at which conduction brings the mean temperature near to that of the
  /// walls. It is that of the interval before, and where that tells none what a film of even heating has:
  /// k/(h m c_p) times 12 between two walls, 3 at one.
  double exchange = 0;
};

/// Columns of one gap that are advanced in turns with the motion of its faces: conduction over an interval
/// under the pressures that the faces had in it, then the isentropic change that gives the air its volume
/// between them. Equations and steps are those of integrate_film, but air may also be stretched
/// below its pressure at rest. The charge is resolved in depth, friction heats it evenly, and a column
/// ignites at its surface or in any depth. It ends there: what burns is not followed, and its air is from
/// then on compressed without conduction.
class GapColumns {
 public:
  /// As a surface asks. Short intervals resolve what the air does; within one the error of a step says
  /// little (1e-6 changes a launch by 0.005 K).
  static FilmNumerics numerics_of(const scene::Surface& surface);

  /// `gap` (m, > 0) at rest, where the air has the model's initial state, and `duration` (s) of the launch.
  GapColumns(const SkinModel& model, std::size_t columns, double gap, double duration,
             const FilmNumerics& numerics = numerics_of({}));
  // Columns refer to the model and the grid.
  GapColumns(const GapColumns&) = delete;
  GapColumns& operator=(const GapColumns&) = delete;

  /// An interval of `length` (s) whose pressure (Pa) went from `begin` to `end` with a `mean`; friction heats
  /// the charge by `heating` (K/s).
  void advance(std::size_t column, double length, double begin, double end, double mean, double heating);
  /// Gives the air of a column the volume of an opening (m), without conduction.
  EnclosedAir fit(std::size_t column, double opening);
  /// The same of all columns, which had one pressure (Pa) and share their air: it flows until each fills its
  /// opening at one pressure, what leaves with the mean enthalpy of its column, what enters with the mean of
  /// what left. Volumes and exchange are means over the area.
  EnclosedAir fit_together(double pressure, const std::vector<double>& openings,
                           const std::vector<double>& areas);

  const detail::FilmStation& operator[](std::size_t column) const { return columns_[column]; }

 private:
  /// Air at the begin of an interval, and since then.
  struct Interval {
    double length = 0;     ///< s
    double opening = 0;    ///< m, at the begin
    EnclosedAir air = {};  ///< at the begin
  };

  double temperature_of_walls(const detail::FilmColumn& film) const;
  double usual_exchange(const detail::FilmColumn& film) const;
  static double exchange_of(const Interval& interval, const EnclosedAir& conducted, double opening,
                            double usual);
  void move_air(const std::vector<double>& openings, const std::vector<double>& areas);

  SkinModel model_;
  detail::FilmGrid grid_;
  std::vector<detail::FilmStation> columns_;
  std::vector<Interval> intervals_;
  Interval shared_;  ///< of the air of all columns, where they share it
};

}  // namespace launchsafe::surface
