// The film of air under gaps from nothing to a centimetre and loads from slow to sudden.
#include "law_tests.hpp"
#include "skin_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace launchsafe::verify::law_tests {

namespace {

constexpr double air_at_rest = 101325.0;  // Pa

/// A straight rise within `rise` (s) to `peak` (Pa), and half as long under it.
trace::BottomTrace risen(int intervals, double rise, double peak) {
  const double slope = (peak - air_at_rest) / rise;
  const auto integral = [=](double t) {
    const double rising = std::min(t, rise);
    return air_at_rest * t + slope * (0.5 * rising * rising + rise * (t - rising));
  };
  return pressed_bottom(
      {{"S1", 0.0, 0.0, 0.01, false}}, intervals, 1.5 * rise,
      with_integral([=](double t) { return air_at_rest + slope * std::min(t, rise); }, integral));
}

}  // namespace

void assess_film(Bounds& bounds, const HistoryLaw& law, double wide, double rise, double peak) {
  const surface::SkinModel model = inert_film();
  const double start = model.initial_temperature;
  double last[2] = {start, start};
  for (const int finer : {0, 1}) {
    const trace::BottomTrace trace = risen(finer == 0 ? 150 : 300, rise, peak);
    const surface::SkinHistory history = law(model, trace, wide);
    const bool complete =
        history.temperature.size() == trace.samples() && history.air_temperature.size() == trace.samples();
    bounds.never("samples are missing", !complete);
    if (!complete) return;
    for (std::size_t sample = 0; sample < trace.samples(); ++sample) {
      const double skin = history.temperature[sample], air = history.air_temperature[sample];
      const double adiabat =
          materials::adiabatic_temperature(model.surface.air, trace.bottom_pressure[sample]);
      bounds.never("a temperature that is not finite", !std::isfinite(skin) || !std::isfinite(air));
      bounds.at_most("air above its adiabat, K", std::max(0.0, air - adiabat), 1e-6);
      bounds.at_most("surface above the adiabat, K", std::max(0.0, skin - adiabat), 1e-6);
      bounds.at_most("surface below its start, K", std::max(0.0, start - skin), 1e-6);
    }
    last[finer] = history.temperature.back();
    bounds.never("an inert charge ignites", history.ignition.has_value());
    bounds.at_most("energy residual that the history itself states", history.energy_residual, 1e-11);
  }
  bounds.at_most("surface at the end on 150 samples against 300, K", std::abs(last[1] - last[0]),
                 1e-3 * (last[1] - start) + 1e-6);
}

StressTests film_tests() {
  StressTests tests;
  for (const double wide : {1e-12, 1e-9, 1e-6, 1e-4, 1e-3, 1e-2}) {
    for (const double rise : {1e-4, 1e-2}) {
      tests.push_back(stress_test(
          "stiff: film of air", fmt::format("gap {:g} m, 1 MPa to 1 GPa in {}", wide, duration_text(rise)),
          "Air and surface stay between their start and the adiabat, no energy is made or lost, "
          "and twice as "
          "many samples change nothing.",
          [wide, rise](Bounds& bounds) {
            for (const double peak : {1e6, 1e8, 1e9})
              assess_film(bounds, surface::integrate_skin, wide, rise, peak);
          }));
    }
  }
  return tests;
}

}  // namespace launchsafe::verify::law_tests
