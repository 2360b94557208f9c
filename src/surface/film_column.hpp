// Heat conduction through charge, air and steel of one column while the air is compressed.
#pragma once

#include "film_grid.hpp"

#include <array>
#include <vector>

namespace launchsafe::surface::detail {

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
  struct Kept {
    std::vector<double> state, before;
    double pressure = 0, last_step = 0, enthalpy = 0;
  };
  void keep(Kept& kept) const;
  void restore(const Kept& kept);

  /// Compresses the air without conduction to a pressure (Pa); the work V dp that it takes, J/m2.
  double compress_to(double pressure);
  /// Mixes air into all cells, or takes as much of each away: `more` as a share of what the grid has, of a
  /// specific enthalpy (see below). What the air's enthalpy gains, J/m2.
  double take_air(double more, double enthalpy);
  double air_share() const { return air_share_; }                      ///< of what the grid has
  double specific_enthalpy() const { return enthalpy_ / air_share_; }  ///< J/m2, of as much as the grid has
  double pressure() const { return pressure_; }                        ///< Pa
  double air_volume() const;                                           ///< m3/m2, without the covolume
  double covolume() const;                                             ///< m3/m2
  double air_heat_capacity() const;                                    ///< J/(m2 K), at constant pressure
  double exponent() const;  ///< -d ln p/d ln volume without conduction

  double temperature(std::size_t cell) const { return reference_ + excess_of(cell); }
  /// For heat of reaction in a cell of the charge.
  void set_temperature(std::size_t cell, double temperature) { state_[cell] = temperature - reference_; }
  /// Of the faces between charge and air and between air and steel, at which the flux from both sides is
  /// equal, K.
  double charge_surface() const;
  double base_surface() const;
  double mean_air() const;  ///< K, over the mass

  /// Heat (J/m2) of each part above a fixed state.
  double charge_heat() const;
  double base_heat() const;
  double air_enthalpy() const { return enthalpy_; }

 private:
  using Cells = std::vector<double>;

  double factor(double pressure) const;
  double excess_of(std::size_t cell) const;
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
  double pressure_;       // Pa
  double enthalpy_;       // J/m2, of the air as it is
  double air_share_ = 1;  // of the air that the grid has
  Cells state_;           // solids: K above the reference; air: potential temperature, K
  Cells before_;          // the same one step earlier
  double last_step_ = 0;  // s
  StepHeat heat_;
  // What a step works with; kept so that it allocates nothing.
  Cells conductance_, rate_begin_, rate_inner_, rate_end_, inner_, end_, guess_, known_, error_;
  Cells share_, inverse_;
  // About which a stage is linear: K above the reference, their slopes against the state, and J/(m2 K).
  Cells excess_, slope_, capacity_;
};

}  // namespace launchsafe::surface::detail
