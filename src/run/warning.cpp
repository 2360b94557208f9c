#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/load.hpp"

#include <fmt/format.h>

namespace launchsafe::run {
namespace {

/// m/s. Howitzers and guns launch between them; mortars and low zones are slower, tank guns faster, and no
/// published launch is of either.
constexpr double least_velocity = 300.0, largest_velocity = 1200.0;
/// Travel over the outer diameter. Howitzers have barrels of 20 calibres or more, and mortars of 12; a launch
/// that is over sooner has its muzzle exit or its pressure wrong.
constexpr double fewest_calibres = 10.0;

}  // namespace

const std::vector<WarningKind>& warning_kinds() {
  static const std::vector<WarningKind> kinds{
      {"energy", false, "The history of the energies is missing or not finite."},
      {"cells", false,
       "Cells or samples do not resolve stations, stress waves or cracks, or faces pass into each other."},
      {"limiters", false, "Limiters of the material laws acted on more than 0.1 % of the particle steps."},
      {"bottom", false,
       "The charge does not bear on its base as statics asks, or a part of it ends before its bottom."},
      {"load", false, "The simulation does not cover the launch that the load states."},
      {"inertia", false, "Scaled or selective inertia moves the charge in ways that were not measured."},
      {"bulk-reaction", false,
       "Friction heats the bulk of the charge above ignition, and its reaction is left out."},
      {"low-velocity", true, "The projectile launches with less than 300 m/s."},
      {"high-velocity", true, "The projectile launches with more than 1200 m/s."},
      {"short-travel", true, "The projectile travels fewer than ten calibres in the barrel."},
      {"shell-yields", true,
       "The wall beside the charge yields over more than a third of the charge's length."},
      {"large-cracks", true,
       "Cracks are larger than ten flaw sizes or the charge, or run away by half a flaw size."},
  };
  return kinds;
}

bool is_acceptable(const std::string& name) {
  return std::ranges::any_of(warning_kinds(),
                             [&](const WarningKind& kind) { return kind.acceptable && kind.name == name; });
}

std::vector<Warning> launch_warnings(const scene::Scene& scene) {
  const scene::RigidMotion launch = scene::rigid_motion(scene, scene::read_time(scene.load));
  const double calibres = launch.travel / (2.0 * scene::extent_of(scene).r_end);
  std::vector<Warning> warnings;
  if (!(launch.velocity >= least_velocity))
    warnings.push_back({"low-velocity", fmt::format("the projectile launches with {:.4g} m/s, less than {:g}",
                                                    launch.velocity, least_velocity)});
  if (launch.velocity > largest_velocity)
    warnings.push_back(
        {"high-velocity", fmt::format("the projectile launches with {:.4g} m/s, more than {:g}",
                                      launch.velocity, largest_velocity)});
  if (!(calibres >= fewest_calibres))
    warnings.push_back({"short-travel", fmt::format("the projectile travels {:.3g} calibres, fewer than {:g}",
                                                    calibres, fewest_calibres)});
  return warnings;
}

}  // namespace launchsafe::run
