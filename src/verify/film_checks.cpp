#include "checks.hpp"
#include "launchsafe/materials/air_conductivity.hpp"
#include "launchsafe/surface/film.hpp"
#include "skin_scenes.hpp"

#include <cmath>
#include <numbers>
#include <utility>

namespace launchsafe::verify {
namespace {

/// From rest on as exp(t/tau).
trace::BottomTrace exponential_rise(int intervals, double duration, double tau) {
  constexpr double rest = 101325.0;  // Pa
  return pressed_bottom({{"S1", 0.0, 0.0, 0.01, false}}, intervals, duration,
                        with_integral([=](double t) { return rest * std::exp(t / tau); },
                                      [=](double t) { return rest * tau * std::expm1(t / tau); }));
}

Check conductivity(int temperature, double expected) {
  return {"conductivity of air at " + std::to_string(temperature) + " K",
          materials::air_conductivity(temperature),
          expected,
          0.02,
          "W/(m K)",
          "Incropera & DeWitt, table A.4; Sutherland's law keeps to 2 %",
          Tolerance::relative};
}

Check adiabat() {
  surface::SkinModel model = inert_film();
  model.charge_conductivity = model.base_conductivity = 0.0;
  const trace::BottomTrace trace = exponential_rise(60, 6e-3, 1e-3);
  return {"walls that conduct nothing, 40.9 MPa",
          surface::integrate_skin(model, trace, 4e-4).air_temperature.back(),
          300.0 * std::exp(6.0 * 0.4 / 1.4),
          1e-11,
          "K",
          "the adiabat T0 (p/p0)^(2/7)",
          Tolerance::relative};
}

/// Air so thin that it keeps the temperature of the walls gives the work p0 h/tau a second as heat.
Checks isotherm() {
  constexpr double thin = 1e-7, duration = 6e-3, tau = 1e-3;
  const surface::SkinModel model = inert_film();
  const trace::BottomTrace trace = exponential_rise(120, duration, tau);
  const surface::FilmHistory film = surface::integrate_film(model, trace, thin);
  const double flux = model.surface.air.initial_pressure * thin / tau;  // W/m2
  const double charge = std::sqrt(model.charge_conductivity * model.charge_density * model.specific_heat);
  const double base = std::sqrt(model.base_conductivity * model.base_density * model.base_specific_heat);
  return {{"heat of air compressed 403-fold in 0.1 um", film.energy[0].charge + film.energy[0].base,
           flux * duration, 1e-3, "J/m2", "isotherm: p0 h ln(p/p0)", Tolerance::relative},
          {"rise of the charge's surface under that heat",
           film.skin.temperature.back() - model.initial_temperature,
           2.0 * flux * std::sqrt(duration / std::numbers::pi) / (charge + base), 5e-3, "K",
           "two half-spaces under a constant flux between them, Carslaw & Jaeger 2.9", Tolerance::relative}};
}

Check conservation(const std::string& name, double gap) {
  const trace::BottomTrace trace = exponential_rise(60, 6e-3, 1e-3);
  return {name, surface::integrate_skin(inert_film(), trace, gap).energy_residual,
          0.0,  1e-12,
          "",   "conservation to round-off"};
}

Checks film_checks() {
  Checks checks{conductivity(300, 0.0263), conductivity(600, 0.0469), conductivity(1000, 0.0667), adiabat()};
  for (Check& check : isotherm()) checks.push_back(std::move(check));
  checks.push_back(conservation("energy made or lost, gap 0.1 mm", 1e-4));
  checks.push_back(conservation("the same, gap 4 mm", 4e-3));
  return checks;
}

}  // namespace

std::vector<Computation> film_computations() { return {{"film of air", film_checks}}; }

}  // namespace launchsafe::verify
