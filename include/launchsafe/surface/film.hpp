// The gap's air as a resolved film that conducts into charge and steel (AirModel::film): the optimistic bound
// beside the reservoir, whose air never loses its heat.
#pragma once

#include "launchsafe/surface/skin.hpp"

namespace launchsafe::surface {

/// How finely columns are resolved. Both orders are second.
struct FilmNumerics {
  std::size_t charge_cells = 40;  ///< from 0.4 µm at the surface over a launch of 18 ms to 300 µm deep
  std::size_t gas_cells = 32;     ///< by mass, from 0.3 % of it at each wall
  std::size_t base_cells = 24;    ///< from 8 µm at the surface to 3.5 mm deep
  double tolerance = 1e-5;        ///< local error of a step, relative to the temperature
  int fixed_steps = 0;            ///< steps in each interval of the trace; 0: by the tolerance
};

/// Where the energy of one column came from and went to since the start, J/m2 of bottom:
/// charge + base + gas = work + friction + reaction + inflow.
struct FilmEnergy {
  double charge = 0;    ///< gained by the charge
  double base = 0;      ///< gained by the steel
  double gas = 0;       ///< enthalpy gained by the air
  double work = 0;      ///< integral of V dp over the air
  double friction = 0;  ///< friction heat in the charge, as deep as the column reaches
  double reaction = 0;  ///< heat of reaction in the charge, less what melted it
  double inflow = 0;    ///< enthalpy of air that came from other columns, less that of what left
  /// Difference of the two sides over the sum of magnitudes; 0 where nothing happened.
  double residual() const;
};

struct FilmHistory {
  SkinHistory skin;
  std::vector<FilmEnergy> energy;  ///< by station, up to the end of the trace or the step before ignition
};

/// Integrates one column of charge, air and steel for every station and a gap (m) > 0: in the air, with mass
/// m (kg/m2) as the coordinate and the pressure p of the trace the same everywhere,
///
///   c_p dT/dt = (1/rho) dp/dt + d/dm(rho k dT/dm),   rho = p/(R T),   R = c_p (gamma - 1)/gamma,
///
/// the energy of an ideal gas at small Mach number (Majda & Sethian, Combust. Sci. Technol. 42, 1985), with k
/// of materials::air_conductivity; in charge and base rho c dT/dt = k d2T/dx2 + sources. The air's mass is
/// p0 h/(R T0), so its density at rest is that of the ideal gas. Friction heats the charge evenly in depth
/// and the base draws on that too. Left out: radiation, dissociation, what a gas of such density has beyond
/// an ideal one, and the jump of temperature at walls nearer to each other than molecules fly. Below p0 the
/// air stays at p0, as in materials::adiabatic_temperature.
///
/// So the thinnest film is not the missing gap of integrate_skin: there friction heats the surface as if
/// nothing touched it (416 K on the 155 mm shell), here the base takes that heat (308 K).
///
/// The skin's temperature is that of the charge's surface; that of the air is the mean over its mass, and
/// over the stations by their areas. Arrhenius heat acts in the whole depth of the charge, and a station
/// ignites where its surface or any depth reaches the trigger: where the base cools the surface below what
/// friction alone would give, that is inside. From ignition on it is at T2 and its air as it was then.
FilmHistory integrate_film(const SkinModel& model, const trace::BottomTrace& trace, double gap,
                           const FilmNumerics& numerics = {});

}  // namespace launchsafe::surface
