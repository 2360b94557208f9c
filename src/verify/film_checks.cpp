#include "launchsafe/materials/air_conductivity.hpp"
#include "launchsafe/surface/film.hpp"
#include "skin_scenes.hpp"

#include <cmath>
#include <numbers>

namespace launchsafe::verify {

namespace {

const std::string film_group = "film of air";

/// From rest on as exp(t/tau).
trace::BottomTrace exponential_rise(int intervals, double duration, double tau) {
  constexpr double rest = 101325.0;  // Pa
  return pressed_bottom({{"S1", 0.0, 0.0, 0.01, false}}, intervals, duration,
                        with_integral([=](double t) { return rest * std::exp(t / tau); },
                                      [=](double t) { return rest * tau * std::expm1(t / tau); }));
}

void add_conductivity(std::vector<Check>& checks) {
  const auto add = [&](double temperature, double expected) {
    checks.push_back({film_group,
                      "conductivity of air at " + std::to_string(static_cast<int>(temperature)) + " K",
                      materials::air_conductivity(temperature), expected, 0.02, "W/(m K)",
                      "Incropera & DeWitt, table A.4; Sutherland's law keeps to 2 %", false});
  };
  add(300.0, 0.0263);
  add(600.0, 0.0469);
  add(1000.0, 0.0667);
}

void add_adiabat(std::vector<Check>& checks) {
  surface::SkinModel model = inert_film();
  model.charge_conductivity = model.base_conductivity = 0.0;
  const trace::BottomTrace trace = exponential_rise(60, 6e-3, 1e-3);
  checks.push_back({film_group, "walls that conduct nothing, 40.9 MPa",
                    surface::integrate_skin(model, trace, 4e-4).air_temperature.back(),
                    300.0 * std::exp(6.0 * 0.4 / 1.4), 1e-11, "K", "the adiabat T0 (p/p0)^(2/7)", false});
}

/// Air so thin that it keeps the temperature of the walls gives the work p0 h/tau a second as heat.
void add_isotherm(std::vector<Check>& checks) {
  constexpr double thin = 1e-7, duration = 6e-3, tau = 1e-3;
  const surface::SkinModel model = inert_film();
  const trace::BottomTrace trace = exponential_rise(120, duration, tau);
  const surface::FilmHistory film = surface::integrate_film(model, trace, thin);
  const double flux = model.surface.air.initial_pressure * thin / tau;  // W/m2
  checks.push_back({film_group, "heat of air compressed 403-fold in 0.1 um",
                    film.energy[0].charge + film.energy[0].base, flux * duration, 1e-3, "J/m2",
                    "isotherm: p0 h ln(p/p0)", false});
  const double charge = std::sqrt(model.charge_conductivity * model.charge_density * model.specific_heat);
  const double base = std::sqrt(model.base_conductivity * model.base_density * model.base_specific_heat);
  checks.push_back({film_group, "rise of the charge's surface under that heat",
                    film.skin.temperature.back() - model.initial_temperature,
                    2.0 * flux * std::sqrt(duration / std::numbers::pi) / (charge + base), 5e-3, "K",
                    "two half-spaces under a constant flux between them, Carslaw & Jaeger 2.9", false});
}

void add_ledger(std::vector<Check>& checks) {
  for (const double gap : {1e-4, 4e-3}) {
    const trace::BottomTrace trace = exponential_rise(60, 6e-3, 1e-3);
    checks.push_back({film_group, gap < 1e-3 ? "energy made or lost, gap 0.1 mm" : "the same, gap 4 mm",
                      surface::integrate_skin(inert_film(), trace, gap).energy_residual, 0.0, 1e-12, "",
                      "conservation to round-off", true});
  }
}

}  // namespace

std::vector<Check> film_checks() {
  std::vector<Check> checks;
  add_conductivity(checks);
  add_adiabat(checks);
  add_isotherm(checks);
  add_ledger(checks);
  return checks;
}

}  // namespace launchsafe::verify
