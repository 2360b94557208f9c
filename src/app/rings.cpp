#include "rings.hpp"

#include "launchsafe/run/axial_modes.hpp"
#include "launchsafe/scene/load_roughness.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace launchsafe::app {
namespace {

std::string kilohertz(double frequency) { return fmt::format("{:.3g} kHz", 1e-3 * frequency); }

}  // namespace

std::string rings_text(const scene::Load& load, const scene::Scene& shell) {
  const std::vector<scene::Ring> rings = scene::rings_of(load);
  if (rings.empty()) return {};
  constexpr std::size_t most_named = 3;
  const std::vector<run::AxialMode> modes = run::axial_modes(shell);
  std::string text = "\nRings of the record\n  the shell swings along its axis at";
  for (std::size_t i = 0; i < std::min(modes.size(), most_named); ++i)
    text += fmt::format("{}{}", i > 0 ? ", " : " ", kilohertz(modes[i].frequency));
  text += modes.size() > most_named ? " and higher\n" : "\n";
  for (const scene::Ring& ring : rings) {
    const run::AxialMode* mode = run::mode_near(ring, modes);
    text += fmt::format(
        "  a ring at {} with {:.2g} % of the peak is near {}\n", kilohertz(ring.frequency),
        100.0 * ring.amplitude / scene::PressureHistory(load).stated_peak(),
        mode == nullptr
            ? "none of these modes"
            : fmt::format("the mode at {}: the shell swings along, which heats the charge's bottom",
                          kilohertz(mode->frequency)));
  }
  return text;
}

nlohmann::ordered_json rings_json(const scene::Load& load, const scene::Scene& shell) {
  const std::vector<scene::Ring> rings = scene::rings_of(load);
  if (rings.empty()) return nullptr;
  nlohmann::ordered_json modes_json = nlohmann::ordered_json::array(), rings_json = modes_json;
  const std::vector<run::AxialMode> modes = run::axial_modes(shell);
  for (const run::AxialMode& mode : modes)
    modes_json.push_back({{"frequency_hz", mode.frequency}, {"share_of_strongest", mode.amplitude}});
  for (const scene::Ring& ring : rings) {
    const run::AxialMode* mode = run::mode_near(ring, modes);
    rings_json.push_back(
        {{"frequency_hz", ring.frequency},
         {"amplitude_pa", ring.amplitude},
         {"near_mode_hz", mode != nullptr ? nlohmann::ordered_json(mode->frequency) : nullptr}});
  }
  return {{"rings", rings_json}, {"axial_modes", modes_json}};
}

}  // namespace launchsafe::app
