// Conduction, waves and free flight: whole simulations over their mesh and step.
#include "error_against_time_parts.hpp"
#include "mechanics_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace launchsafe::verify::parts {
namespace {

std::vector<Setting> conduction_steps() {
  constexpr double cell = 0.25e-6;  // m: leaves an error of 3e-5
  std::vector<Setting> settings;
  for (const int steps : {5, 10, 20, 40, 80}) {
    settings.push_back({"step " + time_text(1e-3 / steps), 1e-3 / steps,
                        [=] { return mechanics::half_space_error(cell, steps); }});
  }
  return settings;
}

/// With the square of the spacing the first-order error of the step falls as that of the spacing does.
std::vector<Setting> conduction_spacings() {
  std::vector<Setting> settings;
  for (const int division : {1, 2, 4, 8}) {
    const double cell = 8e-6 / division;
    settings.push_back({fmt::format("cell {:g} um", 1e6 * cell), cell,
                        [=] { return mechanics::half_space_error(cell, 20 * division * division); }});
  }
  return settings;
}

std::vector<Setting> wave_meshes(double mechanics::WaveError::*error) {
  std::vector<Setting> settings;
  for (const int cells : {25, 50, 100, 200, 400}) {
    settings.push_back({fmt::format("cell {:g} mm", 1e3 / cells), 1.0 / cells, [=] {
                          return mechanics::longitudinal_error(scene::Formulation::total_lagrangian, cells).*
                                 error;
                        }});
  }
  return settings;
}

std::vector<Setting> flight_meshes(double mechanics::FlightDrift::*drift) {
  std::vector<Setting> settings;
  // No length divides the block's 50 and 20 mm, so that particles cross cells at all times.
  for (const double cell : {7.3e-3, 3.7e-3, 1.9e-3}) {
    settings.push_back({fmt::format("cell {:g} mm", 1e3 * cell), cell,
                        [=] { return mechanics::drift_in_flight(cell, 0.1).*drift; }});
  }
  return settings;
}

}  // namespace

std::vector<ErrorSeries> mechanics_series() {
  constexpr double exact = std::numeric_limits<double>::infinity();
  const std::string conduction = "conduction", wave = "bar wave", flight = "free flight";
  const std::string strip = "1 ms of a strip of 0.1 mm", pulse = "a pulse over 0.9 m of a strip";
  const std::string erfc = "erfc of the half space, relative L2", alembert = "d'Alembert, relative L2";
  const std::string second = "uGIMP on smooth fields and the leapfrog are of second order";
  const std::string block = "a block of 50 mm flies 0.1 m at 500 m/s";
  const std::string balance = "exact at any mesh: a uniform velocity and a stress in balance";
  return {with_settings({conduction, "temperature, by step", strip + " in cells of 0.25 um", erfc, "",
                         "backward Euler is of first order", 1.0, 1e-12},
                        conduction_steps),
          with_settings(
              {conduction, "temperature, by cell", strip + ", the step going with the square of the cell",
               erfc, "", "finite volumes are of second order", 2.0, 1e-12},
              conduction_spacings),
          with_settings({wave, "velocity", pulse, alembert, "", second, 2.0, 1e-12},
                        [] { return wave_meshes(&mechanics::WaveError::velocity); }),
          with_settings({wave, "stress", pulse, alembert, "", second, 2.0, 1e-12},
                        [] { return wave_meshes(&mechanics::WaveError::stress); }),
          with_settings({flight, "momentum", block, "kept", "", balance, exact, 1e-12},
                        [] { return flight_meshes(&mechanics::FlightDrift::momentum); }),
          with_settings({flight, "kinetic energy", block, "kept", "", balance, exact, 1e-12},
                        [] { return flight_meshes(&mechanics::FlightDrift::kinetic); }),
          with_settings(
              {flight, "place of the centre of mass", block, "speed times time", "", balance, exact, 1e-12},
              [] { return flight_meshes(&mechanics::FlightDrift::place); })};
}

}  // namespace launchsafe::verify::parts
