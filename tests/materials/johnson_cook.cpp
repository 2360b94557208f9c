#include "launchsafe/materials/johnson_cook.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace launchsafe::materials;
using launchsafe::math::Deviator;
namespace math = launchsafe::math;

TEST(JohnsonCookFlowStress, IsThePublishedLaw) {
  const JohnsonCookParameters k;
  EXPECT_NEAR(johnson_cook_flow_stress(k, 0.0, 1.0, 298.0), 792e6, 1e-6);
  EXPECT_NEAR(johnson_cook_flow_stress(k, 1.0, 1.0, 298.0), 1302e6, 1e-6);
  EXPECT_NEAR(johnson_cook_flow_stress(k, 0.0, 1000.0, 298.0) / 792e6, 1.0 + 0.014 * std::log(1000.0), 1e-14);
  EXPECT_NEAR(johnson_cook_flow_stress(k, 0.0, 1.0, 1045.5) / 792e6, 1.0 - std::pow(0.5, 1.03), 1e-14);
  EXPECT_EQ(johnson_cook_flow_stress(k, 0.1, 1.0, 1793.0), 0.0);
  EXPECT_EQ(johnson_cook_flow_stress(k, 0.0, 1e-6, 298.0), johnson_cook_flow_stress(k, 0.0, 1.0, 298.0));
}

TEST(JohnsonCookReturn, FindsTheRootThatABracketingSolverFinds) {
  const JohnsonCookParameters k;
  for (const double q : {0.8e9, 0.9e9, 1.5e9, 5e9}) {
    for (const double strain : {0.0, 1e-6, 1e-3, 0.3}) {
      for (const double dt : {1e-9, 1e-7, 1e-5}) {
        const Deviator<double> trial{0.0, 0.0, q / std::sqrt(3.0)};
        const auto result = johnson_cook_return(k, trial, strain, 350.0, dt);
        const auto excess = [&](double d) {
          return q - 3.0 * k.shear_modulus * d - johnson_cook_flow_stress(k, strain + d, d / dt, 350.0);
        };
        const double high = q / (3.0 * k.shear_modulus);
        double root = 0.0;
        if (excess(0.0) > 0.0) {
          std::uintmax_t most = 200;
          const auto bracket = boost::math::tools::toms748_solve(
              excess, 0.0, high, boost::math::tools::eps_tolerance<double>(50), most);
          root = 0.5 * (bracket.first + bracket.second);
        }
        EXPECT_NEAR(result.plastic_strain_increment, root, 2e-9 * high) << q << " " << strain << " " << dt;
      }
    }
  }
}

TEST(JohnsonCookReturn, MoltenSteelBearsNoShear) {
  const JohnsonCookParameters k;
  const auto result = johnson_cook_return(k, Deviator<double>{1e9, -4e8, 3e8}, 0.01, 2000.0, 1e-7);
  EXPECT_LE(math::von_mises(result.stress), 1.0);
}

TEST(JohnsonCookReturn, MoltenSteelTakesNoWork) {
  // q - 3 G (q/(3 G)) may round to less than nothing; the work must not.
  const JohnsonCookParameters k;
  for (int n = 1; n <= 1000; ++n) {
    const auto result = johnson_cook_return(k, Deviator<double>{0.0, 0.0, 1e6 * n}, 0.0, 1793.0, 1e-7);
    EXPECT_GE(result.plastic_work, 0.0) << n;
    EXPECT_GE(result.stress.rx, 0.0) << n;
  }
}

}  // namespace
