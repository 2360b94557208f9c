#include "launchsafe/run/axial_modes.hpp"

#include "launchsafe/run/cost.hpp"
#include "launchsafe/run/run_case.hpp"

#include <fmt/format.h>

#include <complex>

namespace launchsafe::run {
namespace {

constexpr double duration = 4e-3, rise = 2e-5, interval = 1e-5;  // s

scene::Scene struck(const scene::Scene& scene) {
  constexpr double step = 1e6;          // Pa, of which nothing yields
  constexpr double most_updates = 3e6;  // of particles: a tenth of a second
  scene::Scene result = scene;
  result.load = {};
  result.load.duration = duration;
  result.load.base = 0.0;
  result.load.peak = step;
  result.load.curve_time = {0.0, rise, duration};
  result.load.curve_pressure = {0.0, step, step};
  result.load.obturation = scene.load.obturation;
  result.load.mass_over_area = scene.load.mass_over_area;
  result.coupling = scene::Coupling::one_way;
  result.numerics.inertial_scaling = result.numerics.selective_inertia = 1.0;
  result.output = {};
  result.output.trace_interval = interval;
  // On the 155 mm shell cells of 1.25, 2.5, 5 and 10 mm have the same first eight modes, and those of 20 mm
  // within 25 1/s.
  while (cost_of(result).work > most_updates) {
    result.numerics.cell_size *= 2.0;
    result.numerics.largest_cell = std::max(result.numerics.largest_cell, result.numerics.cell_size);
  }
  return result;
}

/// Amplitude of the derivative of a history at a frequency, with Hann's window over all of it.
double amplitude_at(const std::vector<double>& time, const std::vector<double>& values, double frequency) {
  std::complex<double> sum = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double middle = 0.5 * (time[i] + time[i - 1]);
    const double window = 1.0 - std::cos(2.0 * std::numbers::pi * middle / time.back());
    sum += std::polar((values[i] - values[i - 1]) * window, 2.0 * std::numbers::pi * frequency * middle);
  }
  return std::abs(sum);
}

}  // namespace

std::vector<AxialMode> axial_modes(const scene::Scene& scene) {
  constexpr double lowest = 300.0, highest = 2e4, finest = 25.0, weakest = 0.05;  // 1/s, and a share
  if (!scene::has_charge(scene)) return {};
  const MechanicsResult answer = run_mechanics(struck(scene));
  if (answer.status != RunStatus::completed || answer.trace.samples() < 2) return {};
  std::vector<AxialMode> spectrum;
  for (double frequency = lowest; frequency < highest; frequency += finest)
    spectrum.push_back({frequency, amplitude_at(answer.trace.time, answer.trace.bottom_pressure, frequency)});
  const double strongest = std::ranges::max(spectrum, {}, &AxialMode::amplitude).amplitude;
  const auto reach = static_cast<std::ptrdiff_t>(mode_width / finest);
  const auto size = static_cast<std::ptrdiff_t>(spectrum.size());
  std::vector<AxialMode> modes;
  for (std::ptrdiff_t i = 1; i + 1 < size; ++i) {
    const auto begin = spectrum.begin() + std::max<std::ptrdiff_t>(0, i - reach);
    const auto end = spectrum.begin() + std::min(size, i + reach + 1);
    const auto here = spectrum.begin() + i;
    if (here->amplitude >= weakest * strongest &&
        std::ranges::max_element(begin, end, {}, &AxialMode::amplitude) == here)
      modes.push_back({here->frequency, here->amplitude / strongest});
  }
  return modes;
}

std::string ring_text(const scene::Scene& scene) {
  const std::string rings = scene::ring_text(scene.load);
  const std::vector<scene::Ring> all = scene::rings_of(scene::averaged(scene.load, 0.0));
  if (all.empty()) return rings;
  const std::vector<AxialMode> modes = axial_modes(scene);
  const auto ring =
      std::ranges::find_if(all, [&](const scene::Ring& each) { return mode_near(each, modes) != nullptr; });
  if (ring == all.end()) return rings;
  return fmt::format(
      "{}{}the shell swings along its axis at {:.3g} kHz, near a ring of the record at {:.3g} kHz", rings,
      rings.empty() ? "" : ", ", 1e-3 * mode_near(*ring, modes)->frequency, 1e-3 * ring->frequency);
}

const AxialMode* mode_near(const scene::Ring& ring, const std::vector<AxialMode>& modes) {
  const auto near = std::ranges::find_if(
      modes, [&](const AxialMode& mode) { return std::abs(ring.frequency - mode.frequency) <= mode_width; });
  return near == modes.end() ? nullptr : &*near;
}

}  // namespace launchsafe::run
