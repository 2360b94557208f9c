// The programs of studies/library, run as a reader would, and what they print held against closed forms that
// are written out here anew.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace {

/// Numbers of a CSV table by the names in its first line.
using Columns = std::map<std::string, std::vector<double>>;

/// What a program prints; empty where it fails.
std::string output_of(const std::string& program) {
  std::FILE* pipe = popen(("\"" LAUNCHSAFE_EXAMPLES "/" + program + "\"").c_str(), "r");
  if (pipe == nullptr) return {};
  std::string text;
  std::array<char, 4096> part;
  while (const std::size_t count = std::fread(part.data(), 1, part.size(), pipe))
    text.append(part.data(), count);
  return pclose(pipe) == 0 ? text : std::string();
}

Columns columns_of(const std::string& program) {
  std::istringstream text(output_of(program));
  std::string line, field;
  std::vector<std::string> names;
  std::getline(text, line);
  for (std::istringstream head(line); std::getline(head, field, ',');) names.push_back(field);
  Columns columns;
  while (std::getline(text, line)) {
    std::istringstream row(line);
    for (const std::string& name : names)
      if (std::getline(row, field, ',')) columns[name].push_back(std::stod(field));
  }
  return columns;
}

/// Young's modulus (Pa) of bulk and shear modulus.
constexpr double young(double bulk, double shear) { return 9.0 * bulk * shear / (3.0 * bulk + shear); }

/// A pulse p0 ((t/tm) exp(1 - t/tm))^n runs through a bar of glass, 1 m long, at sqrt(E/rho), and is
/// reflected at the free end with the opposite sign (d'Alembert). The tolerance, 0.3 % of the peak, is for
/// the dispersion of a bar with a thickness, and for the particle that lies next to the middle.
TEST(LibraryExample, BarCarriesThePulseThereAndBackAfterDAlembert) {
  constexpr double peak = 1e5, peak_time = 1e-4, exponent = 13.578, middle = 0.50125,
                   tolerance = 0.003 * peak;
  const double speed = std::sqrt(young(40e9, 30e9) / 2500.0);
  const auto pressure = [&](double time) {
    const double share = std::max(time, 0.0) / peak_time;
    return peak * std::pow(share * std::exp(1.0 - share), exponent);
  };
  Columns bar = columns_of("bar");
  const auto &time = bar["time_s"], &stress = bar["stress_Pa"], &printed = bar["closed_form_Pa"];
  ASSERT_GE(time.size(), 100U);
  ASSERT_EQ(printed.size(), time.size());
  EXPECT_GT(time.back(), 4.4e-4);
  for (std::size_t k = 0; k < time.size(); ++k) {
    const double exact =
        pressure(time[k] - (1.0 + middle) / speed) - pressure(time[k] - (1.0 - middle) / speed);
    EXPECT_NEAR(stress[k], exact, tolerance) << "at " << time[k] << " s";
    EXPECT_NEAR(printed[k], exact, 1e-5 * peak) << "at " << time[k] << " s";
  }
  const auto [compression, tension] = std::minmax_element(stress.begin(), stress.end());
  EXPECT_LT(*compression, -0.98 * peak);  // rows are 0.04 of the peak time apart
  EXPECT_GT(*tension, 0.98 * peak);
}

/// Lame's solution for 1 MPa in a ring of 50/100 mm with free ends. Stresses within 0.1 % of the pressure,
/// the displacement within 0.1 %: twenty cells in the wall give 0.08 % at the bore.
TEST(LibraryExample, CylinderBearsThePressureAfterLame) {
  constexpr double pressure = 1e6, inside = 0.05, outside = 0.1, bulk = 166.4e9, shear = 80e9;
  const double modulus = young(bulk, shear), poisson = modulus / (2.0 * shear) - 1.0;
  const double mean = pressure / (std::pow(outside / inside, 2) - 1.0);
  Columns wall = columns_of("cylinder");
  const auto& radius = wall["radius_m"];
  ASSERT_EQ(radius.size(), 20U);
  ASSERT_EQ(wall["displacement_closed_form_m"].size(), 20U);
  for (std::size_t k = 0; k < radius.size(); ++k) {
    const double r = radius[k], ratio = std::pow(outside / r, 2);
    const double displacement = mean * r / modulus * (1.0 - poisson + (1.0 + poisson) * ratio);
    EXPECT_NEAR(wall["radial_Pa"][k], mean * (1.0 - ratio), 1e-3 * pressure) << r;
    EXPECT_NEAR(wall["hoop_Pa"][k], mean * (1.0 + ratio), 1e-3 * pressure) << r;
    EXPECT_NEAR(wall["displacement_m"][k], displacement, 1e-3 * displacement) << r;
    EXPECT_NEAR(wall["radial_closed_form_Pa"][k], mean * (1.0 - ratio), 1e-5 * pressure) << r;
    EXPECT_NEAR(wall["hoop_closed_form_Pa"][k], mean * (1.0 + ratio), 1e-5 * pressure) << r;
    EXPECT_NEAR(wall["displacement_closed_form_m"][k], displacement, 1e-5 * displacement) << r;
  }
}

/// The generalised Maxwell solid of the charge under a constant rate of shear, from its constants as printed.
struct MaxwellSolid {
  double stress = 0;  ///< sum of 2 G tau rate (1 - exp(-t/tau)), Pa
  double heat = 0;    ///< of its dashpots, the integral of the sum of S_n^2/(G_n tau_n), J/m3
};
MaxwellSolid maxwell_solid(double rate, double time) {
  MaxwellSolid solid;
  solid.stress = 2.0 * 0.944e9 * rate * time;  // the first element does not relax
  constexpr std::array<double, 4> moduli{0.1738e9, 0.5212e9, 0.9085e9, 0.6875e9};
  constexpr std::array<double, 4> relaxation_rates{7320.0, 73200.0, 732000.0, 2e6};
  for (std::size_t n = 0; n < moduli.size(); ++n) {
    const double tau = 1.0 / relaxation_rates[n], viscosity = moduli[n] * tau;
    const double once = -std::expm1(-time / tau), twice = -std::expm1(-2.0 * time / tau);
    solid.stress += 2.0 * viscosity * rate * once;
    solid.heat += 4.0 * viscosity * rate * rate * (time - 2.0 * tau * once + 0.5 * tau * twice);
  }
  return solid;
}

/// Cracks below K' grow by dc/dt = v/(1 + m/2) (K/K')^m with K^2 = pi c (3/2) S:S = 3 pi c s^2 under a shear
/// stress s, m = 10, v = 300 m/s, K'^2 = 1.2 K0^2. So 1/c^4 falls by 200 (3 pi/K'^2)^5 times the integral of
/// s^10, which is taken here by Simpson's rule.
double crack_radius_at(double rate, double time) {
  constexpr int intervals = 2000;
  double integral = 0.0;
  for (int k = 0; k <= intervals; ++k) {
    const double weight = k == 0 || k == intervals ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
    integral += weight * std::pow(maxwell_solid(rate, time * k / intervals).stress, 10);
  }
  integral *= time / (3.0 * intervals);
  const double factor = 200.0 * std::pow(3.0 * std::numbers::pi / (1.2 * 5e5 * 5e5), 5);
  return std::pow(std::pow(30e-6, -4) - factor * integral, -0.25);
}

/// Until cracks of 30 um have grown by a tenth, at a strain of 0.7 %, they give the solid less than 4e-5 of
/// its strain, of which relaxation makes no more than 1e-4 of stress and heat.
TEST(LibraryExample, ExplosiveParticleFollowsItsClosedFormsUntilItsCracksRun) {
  constexpr double rate = 1000.0;
  Columns particle = columns_of("explosive_particle");
  const auto &strain = particle["strain"], &radius = particle["crack_radius_m"];
  ASSERT_GE(strain.size(), 100U);
  ASSERT_EQ(particle["temperature_K"].size(), strain.size());
  std::size_t compared = 0;
  for (; compared < strain.size() && strain[compared] < 0.00701; ++compared) {
    const std::size_t k = compared;
    const double time = strain[k] / rate, grown = crack_radius_at(rate, time) - 30e-6;
    const MaxwellSolid solid = maxwell_solid(rate, time);
    EXPECT_NEAR(particle["stress_Pa"][k], solid.stress, 1e-4 * solid.stress) << strain[k];
    EXPECT_NEAR(particle["uncracked_stress_Pa"][k], solid.stress, 1e-6 * solid.stress) << strain[k];
    EXPECT_NEAR(particle["heat_J_per_m3"][k], solid.heat, 1e-3 * solid.heat) << strain[k];
    EXPECT_NEAR(radius[k] - 30e-6, grown, 2e-3 * grown + 1e-11) << strain[k];  // printed to 1e-11 m
  }
  EXPECT_GE(compared, 25U);
}

/// Then the cracks run: their radius never falls, the stress does, and heat is no more than the work, the
/// integral of S:de = 2 s de, and warms a charge of 1717 kg/m3 and 1780 J/(kg K).
TEST(LibraryExample, ExplosiveParticleLosesItsStressAndKeepsItsEnergy) {
  Columns particle = columns_of("explosive_particle");
  const auto &strain = particle["strain"], &stress = particle["stress_Pa"];
  const auto &radius = particle["crack_radius_m"], &heat = particle["heat_J_per_m3"];
  ASSERT_GE(strain.size(), 100U);
  ASSERT_EQ(particle["temperature_K"].size(), strain.size());
  EXPECT_TRUE(std::is_sorted(radius.begin(), radius.end()));
  EXPECT_GT(radius.back(), 1e-3);
  EXPECT_LT(stress.back(), 0.2 * *std::max_element(stress.begin(), stress.end()));
  double work = stress[0] * strain[0];
  for (std::size_t k = 1; k < strain.size(); ++k) {
    work += (stress[k] + stress[k - 1]) * (strain[k] - strain[k - 1]);
    EXPECT_GE(heat[k], heat[k - 1]) << strain[k];
    EXPECT_LT(heat[k], work) << strain[k];
    EXPECT_NEAR(particle["temperature_K"][k], 300.0 + heat[k] / (1717.0 * 1780.0), 1e-5) << strain[k];
  }
}

}  // namespace
