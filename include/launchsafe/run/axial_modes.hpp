// At which frequencies a shell swings along its axis.
#pragma once

#include "launchsafe/scene/load_roughness.hpp"

namespace launchsafe::run {

/// A line in the spectrum of the pressure at the charge's bottom, with which all bodies swing.
struct AxialMode {
  double frequency = 0;  ///< 1/s
  double amplitude = 0;  ///< after a blow, over that of the strongest mode; 0 to 1
};

/// How near to a mode a ring makes the shell swing along, 1/s. On the 155 mm shell, with modes
/// at 2.5, 3.4, 5.1 and 9.7 kHz, rings of 1.5 % of the peak at 2.4 and 3.2 kHz and one of 0.2 % at 9.8 kHz
/// ignite the charge without a gap; at 4.8 and 9.4 kHz they do not.
inline constexpr double mode_width = 250.0;

/// Those from 0.3 to 20 kHz, the lowest first, by a run of 4 ms with true inertia and the scene's mesh, or
/// one so coarse that it takes a tenth of a second, under a pressure that rises to 1 MPa within 20 us and
/// stays: the lines of what the derivative of the pressure at the charge's bottom holds under Hann's window.
/// None is weaker than a twentieth of the strongest, nor nearer to a stronger one than `mode_width`, which a
/// run of 4 ms resolves. Empty for a scene without charge, or where the run fails.
std::vector<AxialMode> axial_modes(const scene::Scene& scene);

/// For people: scene::ring_text, and of the rings of the record, smoothed or not, the strongest that is near
/// a mode; empty for none.
std::string ring_text(const scene::Scene& scene);

/// A mode to which a ring of the load is near; nullptr for none.
const AxialMode* mode_near(const scene::Ring& ring, const std::vector<AxialMode>& modes);

}  // namespace launchsafe::run
