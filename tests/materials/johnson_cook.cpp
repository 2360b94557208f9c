#include "first_of.hpp"
#include "launchsafe/materials/steel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace {

using namespace launchsafe::materials;
using launchsafe::math::Deviator;
using launchsafe::math::Pack;
using launchsafe::test_support::first_of;
namespace math = launchsafe::math;

const double melting = JohnsonCookParameters{}.melting_temperature;
constexpr double strains[] = {0.0, 1e-300, 1e-6, 0.1, 10.0};

/// The published formula in long double, with the rate factor 1 below the reference rate and 0 from melting
/// on.
double published_flow_stress(const JohnsonCookParameters& k, long double strain, long double rate,
                             long double temperature) {
  const long double homologous = std::clamp<long double>(
      (temperature - k.room_temperature) / (k.melting_temperature - k.room_temperature), 0.0L, 1.0L);
  const long double hard = k.a + k.b * std::pow(strain, static_cast<long double>(k.n));
  const long double fast = 1.0L + k.c * std::log(std::max(rate / k.reference_rate, 1.0L));
  return static_cast<double>(hard * fast * (1.0L - std::pow(homologous, static_cast<long double>(k.m))));
}

template <class Number>
double flow_stress(double strain, double rate, double temperature) {
  return first_of(johnson_cook_flow_stress<Number>(JohnsonCookParameters{}, Number(strain), Number(rate),
                                                   Number(temperature)));
}

template <class Number>
JohnsonCookReturn<double> returned(Deviator<double> trial, double strain, double temperature, double dt) {
  const auto result = johnson_cook_return<Number>(JohnsonCookParameters{},
                                                  {Number(trial.rr), Number(trial.xx), Number(trial.rx)},
                                                  Number(strain), Number(temperature), Number(dt));
  return {{first_of(result.stress.rr), first_of(result.stress.xx), first_of(result.stress.rx)},
          first_of(result.plastic_strain_increment),
          first_of(result.plastic_work)};
}

/// A direction with all components.
const Deviator<double> oblique{0.3, -0.7, 0.4};

/// A trial stress of von Mises `q` (Pa) comes back in its own direction, on the yield surface of its new
/// strain and rate; its work is stress times strain; what is elastic stays as it is.
template <class Number>
void expect_return_to_the_yield_surface(double q, double strain, double temperature, double dt) {
  SCOPED_TRACE(testing::Message() << q << " Pa, strain " << strain << ", " << temperature << " K, " << dt
                                  << " s");
  const JohnsonCookParameters k;
  const double size = math::von_mises(oblique);
  const auto result = returned<Number>((q / size) * oblique, strain, temperature, dt);
  const double stress = math::von_mises(result.stress), flowed = result.plastic_strain_increment;
  ASSERT_TRUE(std::isfinite(stress + flowed + result.plastic_work));
  EXPECT_GE(flowed, 0.0);
  EXPECT_GE(result.plastic_work, 0.0);
  if (q <= johnson_cook_flow_stress(k, strain, 0.0, temperature)) {
    EXPECT_NEAR(stress, q, 4.0 * 2.3e-16 * q);
    EXPECT_EQ(flowed, 0.0);
    return;
  }
  const double flow = johnson_cook_flow_stress(k, strain + flowed, flowed / dt, temperature);
  // q - 3 G d cancels: round-off of both remains, also in the argument of the flow stress.
  EXPECT_NEAR(stress, flow, 1e-9 * flow + 1e-9 * std::min(q, 1e3 * k.a) + 8.0 * 2.3e-16 * q);
  EXPECT_NEAR(result.plastic_work, stress * flowed, 1e-12 * (q * flowed + 1e-300));
  EXPECT_LE(math::von_mises((1.0 / q) * (result.stress - (stress / size) * oblique)), 1e-14);
}

TEST(JohnsonCookFlowStress, IsThePublishedLawAtAnyStrainRateAndTemperature) {
  const JohnsonCookParameters k;
  for (const double rate : {0.0, 1e-12, 1.0, 1e9})
    for (const double strain : strains)
      for (const double t : {200.0, 298.0, 300.0, 1000.0, melting - 1e-9, melting, 5000.0})
        for (const double found :
             {flow_stress<double>(strain, rate, t), flow_stress<Pack>(strain, rate, t)}) {
          EXPECT_NEAR(found, published_flow_stress(k, strain, rate, t), 1e-12 * k.a) << rate << ' ' << t;
          if (t >= melting) {
            EXPECT_LE(found, 0.0) << t;
          }
        }
}

TEST(JohnsonCookReturn, EndsOnTheYieldSurfaceFromAnyTrialInAnyStep) {
  for (const double temperature : {0.0, 298.0, 1000.0, melting - 1.0, melting - 1e-9, melting, 1e4})
    for (const double q : {0.0, 1e-140, 1.0, 1e6, 7.9e8, 8e8, 1e9, 1e10, 1e12, 1e15, 1e18})
      for (const double strain : strains)
        for (const double dt : {1e-15, 1e-12, 1e-9, 1e-7, 1e-3, 1.0, 1e9}) {
          expect_return_to_the_yield_surface<double>(q, strain, temperature, dt);
          expect_return_to_the_yield_surface<Pack>(q, strain, temperature, dt);
        }
}

TEST(JohnsonCookReturn, OfWhatIsNotANumberIsNone) {
  // Above all such steel is not taken to be elastic.
  const double nan = std::nan("");
  for (const auto law : {returned<double>, returned<Pack>})
    for (const auto& [q, strain, temperature] : {std::array{nan, 0.0, 300.0}, std::array{1e9, nan, 300.0},
                                                 std::array{1e9, 0.0, nan}, std::array{1e8, 0.0, nan}})
      EXPECT_FALSE(std::isfinite(math::von_mises(law(q * oblique, strain, temperature, 1e-7).stress)))
          << q << ' ' << strain << ' ' << temperature;
}

}  // namespace
