// Heat conduction through charge, air and steel of one column while the air is compressed, and one station's
// column over the intervals of a trace: step control, reaction and ignition.
#pragma once

#include "launchsafe/surface/skin_equation.hpp"

namespace launchsafe::surface::detail {

/// Cells 0 to air_begin - 1 are charge, up to base_begin - 1 air, the rest steel. Face i lies between the
/// cells i and i + 1.
struct FilmGrid {
  std::size_t air_begin = 0, base_begin = 0;
  std::vector<double> capacity;     ///< J/(m2 K); of air at constant pressure
  std::vector<double> conductance;  ///< of faces inside the solids, W/(m2 K); 0 elsewhere
  std::vector<double> air_mass;     ///< of faces: air between the two centres, kg/m2; 0 inside the solids
  double charge_resistance = 0;     ///< of the half cell at the charge's surface, m2 K/W
  double base_resistance = 0;       ///< of that at the steel's
  double mass = 0;                  ///< of the air, kg/m2
  materials::Isentropes isentropes;
  std::size_t size() const { return capacity.size(); }
};

/// The cells for a gap (m) over a launch of `duration` (s). Where a cell ends is a smooth function of its
/// number, so that twice as many quarter the error.
FilmGrid film_grid(const SkinModel& model, double gap, double duration, const FilmNumerics& numerics);

/// Pressures (Pa) at the begin of a step, at its inner stage and at its end.
using StagePressures = std::array<double, 3>;
/// Where the inner stage of a step lies, as a share of the step: 2 - sqrt 2.
inline constexpr double inner_stage = 0.585786437626904951;

/// What passed in one step, J/m2.
struct StepHeat {
  double work = 0;      ///< integral of V dp over the air
  double friction = 0;  ///< in the charge
};

/// The air is kept as potential temperature, which compression alone does not change (materials::Isentropes):
/// so without conductivity the adiabat is exact. The steps are TR-BDF2 (Bank et al., IEEE Trans. Electron
/// Devices 32, 1985): of second order, L-stable, and of second order also where the film is so thin that it
/// only follows the walls. The air's conductivity is taken, and its temperature expanded, at temperatures
/// carried forward from the stages before, which leaves each stage linear. What leaves a cell through a face
/// enters its neighbour.
class FilmColumn {
 public:
  /// With all parts at temperatures of their own (K) and the air at its pressure at rest.
  FilmColumn(const FilmGrid& grid, const materials::AirParameters& air, double charge, double base);

  /// One step of h seconds; `heating` (K/s) acts evenly in the charge. Returns the largest estimated error of
  /// a cell relative to its temperature; NaN where anything is.
  double step(double h, const StagePressures& pressures, double heating);
  /// Of the step that was last made.
  const StepHeat& heat() const { return heat_; }

  /// All that a step changes.
  struct State {
    std::vector<double> cells;   ///< solids: K above the reference; air: potential temperature, K
    std::vector<double> before;  ///< the same one step earlier
    double pressure = 0;         ///< Pa
    double last_step = 0;        ///< s
    double enthalpy = 0;         ///< J/m2, of the air as it is
  };
  const State& state() const { return now_; }
  void restore(const State& state) { now_ = state; }

  /// Compresses the air without conduction to a pressure (Pa); the work V dp that it takes, J/m2.
  double compress_to(double pressure);
  /// Mixes air into all cells, or takes as much of each away: `more` as a share of what the grid has, of a
  /// specific enthalpy (see below). What the air's enthalpy gains, J/m2.
  double take_air(double more, double enthalpy);
  double air_share() const { return air_share_; }  ///< of what the grid has
  /// J/m2, of as much as the grid has.
  double specific_enthalpy() const { return now_.enthalpy / air_share_; }
  double pressure() const { return now_.pressure; }  ///< Pa
  double air_volume() const;                         ///< m3/m2, without the covolume
  double covolume() const;                           ///< m3/m2
  double air_heat_capacity() const;                  ///< J/(m2 K), at constant pressure
  double exponent() const;                           ///< -d ln p/d ln volume without conduction

  double temperature(std::size_t cell) const { return reference_ + excess_of(cell); }
  /// For heat of reaction in a cell of the charge.
  void set_temperature(std::size_t cell, double temperature) { now_.cells[cell] = temperature - reference_; }
  /// Of the faces between charge and air and between air and steel, at which the flux from both sides is
  /// equal, K.
  double charge_surface() const;
  double base_surface() const;
  double mean_air() const;  ///< K, over the mass

  /// Heat (J/m2) of each part above a fixed state.
  double charge_heat() const { return heat_between(0, grid_->air_begin); }
  double base_heat() const { return heat_between(grid_->base_begin, grid_->size()); }
  double air_enthalpy() const { return now_.enthalpy; }

 private:
  using Cells = std::vector<double>;

  double factor(double pressure) const;
  double excess_of(std::size_t cell) const;
  double surface_between(std::size_t in, std::size_t out, double resistance) const;
  double heat_between(std::size_t begin, std::size_t end) const;
  template <class OfAir>
  double sum_of_air(OfAir of_air) const;
  bool is_air(std::size_t cell) const { return cell >= grid_->air_begin && cell < grid_->base_begin; }
  void expand_at(const Cells& state, double factor);
  void find_conductances(double pressure);
  void find_rates(Cells& rates) const;
  void extrapolate(const Cells& from, const Cells& to, double share, Cells& at) const;
  void factorise(double weight);
  void solve(Cells& values) const;
  void solve_stage(const Cells& about, double weight, Cells& state);
  double heat_of(const Cells& rates) const;
  double error_of(double h);
  double find_enthalpy(double pressure) const;

  const FilmGrid* grid_;
  materials::AirParameters air_;
  double reference_;      // K; round-off is that of the difference from it
  double air_share_ = 1;  // of the air that the grid has
  State now_;
  StepHeat heat_;
  // What a step works with; kept so that it allocates nothing.
  Cells conductance_, rate_begin_, rate_inner_, rate_end_, inner_, end_, guess_, known_, error_;
  Cells share_, inverse_;
  // About which a stage is linear: K above the reference, their slopes against the state, and J/(m2 K).
  Cells excess_, slope_, capacity_;
};

class FilmStation {
 public:
  /// `tolerance`: of FilmNumerics. No pressure below `lowest_pressure` (Pa) acts.
  FilmStation(const SkinModel& model, const FilmGrid& grid, double tolerance, double start_pressure,
              double lowest_pressure);

  /// Over an interval of `length` s with friction heating (K/s). Nothing happens once it has ignited.
  void advance(const IntervalPressure& pressure, double length, double heating);

  /// Of the charge's surface, K; T2 from ignition on, NaN after a state that is not finite.
  double surface() const;
  /// Of the hottest depth below it, K; 0 once it has ignited.
  double hottest_depth() const;
  /// Of both, K.
  double hottest() const { return std::max(surface(), hottest_depth()); }
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
  double tolerance_;
  const FilmGrid* grid_;
  double lowest_pressure_;  // Pa
  Trigger trigger_;
  bool reacts_;
  FilmColumn column_;
  FilmColumn::State kept_;
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
