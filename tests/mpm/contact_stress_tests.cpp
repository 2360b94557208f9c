// Contact under demanding conditions: scaled inertia, corners, edges that faces leave, inner faces, blows,
// and what a user may ask of a launch.
#include "contact_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace {

using namespace launchsafe;
using namespace launchsafe::test_support;

/// What a computation with contact must keep to at all times.
struct ContactWatch {
  double initial = 0, scale = 0, drift = 0;  ///< J: of the ledger, and the largest energy
  double least_loss = 0;                     ///< J
  double deepest = 0;                        ///< m, smallest gap of faces that are free to part
  double least_pressure = 0, largest = 0;    ///< Pa
  bool sound = true;

  void look(const LoadedSimulation& simulation) {
    const mpm::EnergyBalance& e = simulation.energy();
    scale = std::max(scale, std::abs(e.kinetic) + e.internal);
    drift = std::max(drift, std::abs(ledger(e) - initial));
    least_loss = std::min(least_loss, e.contact);
    sound = sound && std::isfinite(e.kinetic) && !(simulation.events().distorted > 0.0);
    const mpm::Contact& contact = simulation.total_lagrangian()->contact();
    for (std::size_t f = 0; f < contact.faces(); ++f)
      for (const mpm::FaceState& node : contact.state_of(f, simulation.total_lagrangian()->nodes())) {
        deepest = std::min(deepest, node.gap);
        least_pressure = std::min(least_pressure, node.pressure);
        largest = std::max(largest, node.pressure);
      }
  }
};

ContactWatch watched(LoadedSimulation& simulation, double end) {
  ContactWatch watch;
  for (bool first = true; simulation.time() < end && watch.sound; first = false) {
    simulation.step(simulation.stable_time_step());
    if (first) watch.initial = ledger(simulation.energy());
    watch.look(simulation);
  }
  return watch;
}

ContactWatch watched_launch(const std::function<void(scene::Scene&)>& change) {
  scene::Scene shell = held_shell();
  shell.interfaces = {sliding("wall", 0.1), sliding("base", 0.1), sliding("nose", 0.1)};
  change(shell);
  LoadedSimulation simulation(shell);
  return watched(simulation, scene::end_time(shell.load));
}

void set_friction(scene::Scene& scene, double friction) {
  for (scene::Interface& faces : scene.interfaces) faces.friction = friction;
}

TEST(ContactStressTests, TheLedgerClosesWithScaledInertiaAndWithDamping) {
  // What is left is the third power of a step's strain: a few 1e-6 for the longest steps, as without contact.
  struct Case {
    double scaling, damping_time;
  };
  for (const Case& each : {Case{2, 0}, {16, 0}, {1, 1e-5}, {4, 1e-4}})
    for (const double friction : {0.0, 0.1}) {
      const ContactWatch watch = watched_launch([&](scene::Scene& shell) {
        set_friction(shell, friction);
        shell.numerics.inertial_scaling = each.scaling;
        shell.numerics.damping_time = each.damping_time;
      });
      EXPECT_LT(watch.drift / watch.scale, 1e-5) << each.scaling << ' ' << friction;
    }
  scene::Scene shell = held_shell();
  shell.numerics.inertial_scaling = 4.0;
  LoadedSimulation tied(shell);
  const ContactWatch watch = watched(tied, 2e-3);
  EXPECT_LT(watch.drift / watch.scale, 1e-5);
}

TEST(ContactStressTests, TheLedgerClosesWithSelectiveInertiaAsTheStepGetsShorter) {
  const auto drift = [](double friction, double time_step_factor) {
    const ContactWatch watch = watched_launch([&](scene::Scene& shell) {
      set_friction(shell, friction);
      shell.numerics.selective_inertia = 4.0;
      shell.numerics.time_step_factor = time_step_factor;
    });
    return watch.drift / watch.scale;
  };
  for (const double friction : {0.0, 0.1}) {
    const double whole = drift(friction, 0.6), half = drift(friction, 0.3);
    EXPECT_LT(whole, 1e-4) << friction;
    EXPECT_LT(half, 0.6 * whole) << friction;
  }
}

TEST(ContactStressTests, ATiedCornerTakesNoPart) {
  // Charge and body are one node there. Nothing in the shell is pressed by more than its load's peak.
  for (const char* smooth : {"wall", "base", "nose"}) {
    const ContactWatch watch =
        watched_launch([&](scene::Scene& shell) { shell.interfaces = {sliding(smooth, 0.0)}; });
    EXPECT_LT(watch.largest, 496e6) << smooth;
    EXPECT_GT(watch.least_loss / watch.scale, -1e-5) << smooth;
    EXPECT_GT(watch.deepest, -1e-7) << smooth;
  }
}

TEST(ContactStressTests, AChargePastTheEndOfItsWallIsHeldByTheRestOfIt) {
  for (const double friction : {0.0, 0.1, 10.0}) {
    scene::Scene shell = held_shell();
    shell.load.peak = 50e6;
    shell.bodies[2].x_begin = 0.2;
    shell.interfaces = {sliding("wall", friction), sliding("base", friction), sliding("nose", friction)};
    LoadedSimulation simulation(shell);
    const ContactWatch watch = watched(simulation, 2e-3);
    EXPECT_TRUE(watch.sound);
    EXPECT_LT(watch.drift / watch.scale, 1e-4);
    // Over the edge the charge bulges: sliding past it costs or gives the pressure on a cell times the
    // bulge's slope along it.
    EXPECT_GT(watch.least_loss / watch.scale, -2e-3);
    EXPECT_GT(watch.deepest, -1e-6);
    EXPECT_LT(watch.largest, 2.0 * 50e6);
    const mpm::Contact& contact = simulation.total_lagrangian()->contact();
    for (std::size_t f = 0; f < contact.faces(); ++f) {
      if (shell.interfaces[contact.interface_of(f)].body != "wall") continue;
      for (const mpm::FaceState& node : contact.state_of(f, simulation.total_lagrangian()->nodes()))
        if (node.place < 0.2 - 20e-3) {
          EXPECT_EQ(node.area, 0.0);
        }
    }
  }
}

TEST(ContactStressTests, LargeOverlapsAreNoBlow) {
  // The charge flows out past the wall and is driven back over its end: soon its cells are inverted, but
  // until then contact may not be a source of energy.
  const ContactWatch watch = watched_launch([](scene::Scene& shell) {
    set_friction(shell, 0.0);
    shell.bodies[2].x_end = 0.6;
  });
  EXPECT_GT(watch.least_loss / watch.scale, -0.1);
}

/// Force on the bottom of a charge with a bore, along the rod in it and across it, over the force on the
/// bottom without friction. The charge is in a smooth stiff tube; its body force grows from nothing.
struct RodForces {
  double bottom, along, across;
};
RodForces forces_round_a_rod(double friction) {
  const double whole = 1e6, area = 0.5 * (0.02 * 0.02 - 0.01 * 0.01);  // Pa, m2 per radian
  scene::Scene scene;
  scene.materials = {plain("stiff", 1e13, 0.0, 1e7), plain("soft", 2e9, 0.25, 1700.0)};
  scene.bodies = {{"tube", "stiff", 0.0, 0.1, 0.02, 0.03},
                  {"column", "soft", 0.0, 0.1, 0.01, 0.02},
                  {"base", "stiff", 0.1, 0.12, 0.0, 0.03},
                  {"rod", "stiff", 0.0, 0.1, 0.0, 0.01}};
  for (const char* body : {"tube", "base", "rod"}) {
    scene.interfaces.push_back(sliding(body, body[0] == 'r' ? friction : 0.0));
    scene.interfaces.back().against = "column";
  }
  scene.numerics.damping_time = 5e-5;
  scene.load = steady_pressure(0.0);
  LoadedSimulation simulation(scene);
  // Slower and slower, so that nothing slides back at the end.
  const int parts = 400;
  for (int part = 0; part < parts; ++part) {
    simulation.apply_body_force(1, whole / (1700.0 * 0.1) * (2.0 * (parts - part) - 1.0) / (parts * parts),
                                0.0);
    go_until(simulation, (part + 1) * 1.5e-3 / parts);
  }
  go_until(simulation, 1.7e-3);
  RodForces forces{};
  const mpm::Contact& contact = simulation.total_lagrangian()->contact();
  for (std::size_t f = 0; f < contact.faces(); ++f) {
    const auto nodes = contact.state_of(f, simulation.total_lagrangian()->nodes());
    const std::string& body = simulation.scene().interfaces[contact.interface_of(f)].body;
    if (body == "base") forces.bottom = normal_force(nodes) / (whole * area);
    if (body != "rod") continue;
    forces.across = normal_force(nodes) / (whole * area);
    for (const mpm::FaceState& node : nodes) forces.along += node.shear * node.area / (whole * area);
  }
  return forces;
}

TEST(ContactStressTests, ARodInTheChargeCarriesItByFriction) {
  // Janssen for a ring that rubs on its inside: the mean axial stress at depth z is rho a/m (1 - exp(-m z)),
  // m = 2 mu k r_in/(r_out^2 - r_in^2), k = nu/(1 - nu). Sections bend a little, by more the larger mu.
  for (const auto& [friction, allowed] : {std::pair{0.05, 0.003}, {0.1, 0.004}, {0.2, 0.006}}) {
    const double ratio = 0.25 / 0.75;
    const double depth = 2.0 * friction * ratio * 0.01 / (0.02 * 0.02 - 0.01 * 0.01) * 0.1;
    const RodForces forces = forces_round_a_rod(friction);
    EXPECT_NEAR(forces.bottom, (1.0 - std::exp(-depth)) / depth, allowed) << friction;
    EXPECT_NEAR(forces.bottom + forces.along, 1.0, 2e-4) << friction;
    EXPECT_LE(forces.along, friction * forces.across) << friction;
  }
}

TEST(ContactStressTests, ASmoothRodCarriesNothing) {
  // Its pressure is k rho a z: half of k rho a L times L r_in in all.
  const RodForces forces = forces_round_a_rod(0.0);
  EXPECT_NEAR(forces.bottom, 1.0, 2e-4);
  EXPECT_EQ(forces.along, 0.0);
  EXPECT_NEAR(forces.across, 0.5 * (0.25 / 0.75) * 0.1 * 0.01 / (0.5 * (0.02 * 0.02 - 0.01 * 0.01)), 5e-3);
}

/// A load that jumps between nothing and 496 MPa.
void saw_load(scene::Scene& shell, double period) {
  for (int k = 0; k * period / 2 < scene::end_time(shell.load) + period; ++k) {
    shell.load.curve_time.push_back(k * period / 2);
    shell.load.curve_pressure.push_back(k % 2 == 0 ? 1e5 : 496e6);
  }
}

struct DemandingLaunch {
  const char* name;
  std::function<void(scene::Scene&)> change;
  double overlap =
      1e-6;  ///< m, at most; more only where a charge bulges past a rim, and then with a validity warning
};

class DemandingLaunches : public testing::TestWithParam<DemandingLaunch> {};

TEST_P(DemandingLaunches, KeepTheLedgerAndTheFaces) {
  for (const double friction : {0.0, 0.1, 10.0}) {
    const ContactWatch watch = watched_launch([&](scene::Scene& shell) {
      set_friction(shell, friction);
      GetParam().change(shell);
    });
    EXPECT_TRUE(watch.sound) << friction;
    EXPECT_LT(watch.drift / watch.scale, 1e-4) << friction;
    EXPECT_GT(watch.least_loss / watch.scale, -1e-5) << friction;
    EXPECT_GT(watch.deepest, -GetParam().overlap) << friction;
    EXPECT_GE(watch.least_pressure, 0.0) << friction;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Contact, DemandingLaunches,
    testing::Values(
        DemandingLaunch{"PressureToAndFroIn200us", [](scene::Scene& s) { saw_load(s, 2e-4); }},
        DemandingLaunch{"PressureGoneIn10us",
                        [](scene::Scene& s) {
                          s.load.curve_time = {0, 1e-3, 1.01e-3, 1};
                          s.load.curve_pressure = {1e5, 496e6, 0, 0};
                        }},
        DemandingLaunch{"PressureAtOnce", [](scene::Scene& s) { s.load = steady_pressure(496e6, 2e-3); }},
        DemandingLaunch{
            "OneCellLong",
            [](scene::Scene& s) { s.bodies[0].x_end = s.bodies[1].x_begin = s.bodies[2].x_begin = 0.675; }},
        DemandingLaunch{"OneCellWide",
                        [](scene::Scene& s) { s.bodies[1].r_end = s.bodies[2].r_begin = 0.004; }},
        DemandingLaunch{"StrongGrading",
                        [](scene::Scene& s) {
                          s.numerics.growth_x = s.numerics.growth_r = 2.0;
                          s.numerics.cell_size = 2e-3;
                          s.numerics.largest_cell = 0.05;
                        }},
        DemandingLaunch{"BaseWithAHole", [](scene::Scene& s) { s.bodies[3].r_begin = 0.03; }, 5e-4},
        DemandingLaunch{"NoseSmallerThanTheCharge",
                        [](scene::Scene& s) {
                          s.bodies[0].r_end = 0.03;
                          s.load.peak = 200e6;  // past 400 MPa the charge flows out round it
                        },
                        1e-5},
        DemandingLaunch{"LongestProvedSteps", [](scene::Scene& s) { s.numerics.time_step_factor = 0.68; }}),
    [](const auto& each) { return std::string(each.param.name); });

}  // namespace
