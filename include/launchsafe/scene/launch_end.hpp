// When a launch is over: its load has fallen below a hundredth of its peak, or the shot has left the barrel
// and the pressure behind it is gone.
#pragma once

#include "launchsafe/scene/scene.hpp"

namespace launchsafe::scene {

/// Share of its peak, over its base, below which a load no longer heats: heat goes with the square of the
/// pressure, and a hundredth of the pressure is 1e-4 of the heat.
inline constexpr double share_when_over = 0.01;

/// When the launch is over, s, whatever `Load::duration` says: after a muzzle exit, at the end of its decay;
/// else the time after the peak from which an analytic load is below `share_when_over`, or the last point of
/// a measured curve.
double launch_end(const Load& load);

/// Pressure over the base, as a share of that at the peak, that is left at a time (s). The base of a measured
/// curve is 0.
double share_left(const Load& load, double time);

/// Travel of the projectile as one rigid body over its diameter.
double calibres_of(const Scene& scene, const RigidMotion& motion);

/// Whether the simulation ends before the launch is over.
bool is_cut_short(const Load& load);

/// The same load in a barrel without end.
Load without_exit(Load load);
/// The load of the same launch where it goes on for longer than it is simulated: until it is over where
/// `Load::duration` cuts it short, else in a barrel without end where it has a muzzle exit. None for others,
/// nor for what would go on for more than ten times as long.
std::optional<Load> longer_launch(Load load);

/// For people: "796 m/s after 5.26 m of travel, at 18 ms with 12.5 % of the peak pressure"; empty without an
/// exit.
std::string exit_text(const Scene& scene);
/// For people: "799 m/s after 6.2 m of travel, at 19.3 ms, where 1 % of the peak pressure is left".
std::string end_text(const Scene& scene);
/// The launch in a sentence, of the exit, or of the end where there is none: "The shot leaves the barrel with
/// 796 m/s ..."
std::string launch_sentence(const Scene& scene);

}  // namespace launchsafe::scene
