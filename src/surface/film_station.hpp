// One station's column over the intervals of a trace: step control, reaction and ignition.
#pragma once

#include "film_column.hpp"
#include "intervals.hpp"
#include "skin_equation.hpp"

#include <vector>

namespace launchsafe::surface::detail {

class FilmStation {
 public:
  /// No pressure below `lowest_pressure` (Pa) acts.
  FilmStation(const SkinModel& model, const FilmGrid& grid, const FilmNumerics& numerics,
              double start_pressure, double lowest_pressure);

  /// Over an interval of `length` s with friction heating (K/s). Nothing happens once it has ignited.
  void advance(const IntervalPressure& pressure, double length, double heating);

  /// Of the charge's surface, K; T2 from ignition on, NaN after a state that is not finite.
  double surface() const;
  /// Of the hottest depth below it, K; 0 once it has ignited.
  double hottest_depth() const;
  double mean_air() const;  ///< K
  bool failed() const { return failed_; }
  /// Compresses the air without conduction, by work that enters the account.
  void compress_to(double pressure) {
    energy_.work += column_.compress_to(pressure);
    close_account();
  }
  /// See FilmColumn::take_air.
  void take_air(double more, double enthalpy) {
    energy_.inflow += column_.take_air(more, enthalpy);
    close_account();
  }
  const FilmColumn& column() const { return column_; }
  bool ignited() const { return point_.ignited; }
  double ignition_time() const { return point_.ignition_time; }  ///< s after the begin of its interval
  double chemical_share() const { return point_.chemical_share; }
  const FilmEnergy& energy() const { return energy_; }

 private:
  bool try_step(const IntervalPressure& pressure, double length, double begin, double h, double heating);
  void react(double time, double h);
  void melt();
  void release_heat(double surface_before, double time, double h);
  void note(const SkinPoint& ignited, double time);
  double longest_step() const;
  void close_account();

  const SkinModel* model_;
  FilmNumerics numerics_;
  const FilmGrid* grid_;
  double lowest_pressure_;  // Pa
  Trigger trigger_;
  bool reacts_;
  FilmColumn column_;
  FilmColumn::Kept kept_;
  std::vector<double> warmed_;                // by conduction and friction in the last step, K/s
  std::vector<double> melted_, kept_melted_;  // by depth, what melting took as a fall of the temperature, K
  SkinPoint point_;                           // of the surface, or of where it ignited
  FilmEnergy energy_, start_;                 // J/m2
  double reaction_ = 0;                       // of the step under way, J/m2
  double error_ = 0;                          // of the last step over the tolerance
  double wanted_ = 0;                         // length of the next step, s; 0: none made yet
  bool failed_ = false;
};

}  // namespace launchsafe::surface::detail
