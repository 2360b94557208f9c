// Static stresses at the charge bottom against CalculiX, an independent program. Label `fem`.
//
// The expected numbers are those of CalculiX on a mesh with every element cut in four, of the closed form
// where there is one. The targets (StressTargets) are the project's: 1 % up to r = 5.75 cm, 4 % beside the
// wall, 3 % where the charge can slide on it, alternation at most 0.1 % of the pressure.
#include "launchsafe/verify/static_stress_comparison.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <ostream>

namespace launchsafe::verify {

/// What the names of tests show of a case.
static void PrintTo(const StaticCase& compared, std::ostream* stream) { *stream << compared.name; }

namespace {

bool is_installed() {
  const auto version = finite_element_version();
  return version || version.error().kind != store::Error::Kind::missing;
}

/// The finite elements' own error, seen when every element is cut in four and when the contact becomes rigid,
/// is at most a fifth of the tolerance for the particles.
void expect_convergence(const StaticComparison& comparison) {
  const StressTargets& targets = comparison.compared.targets;
  for (std::size_t k = 0; k < comparison.fine.means.size(); ++k) {
    const StressStation& station = comparison.compared.stations[k];
    const double allowed = 0.2 * (station.r < targets.inner_radius + 1e-9 ? targets.inner : targets.outer);
    const StressMeasures &coarse = comparison.coarse.means[k], &fine = comparison.fine.means[k];
    EXPECT_NEAR(coarse.pressure / fine.pressure, 1.0, allowed) << station.name;
    EXPECT_NEAR(coarse.von_mises / fine.von_mises, 1.0, allowed) << station.name;
    EXPECT_LE(comparison.fine.contact_correction, 0.2 * targets.inner);
    if (comparison.compared.exact.empty()) continue;
    const StressMeasures& exact = comparison.compared.exact[k];
    EXPECT_NEAR(fine.pressure / exact.pressure, 1.0, 1e-4) << station.name;
    EXPECT_NEAR(fine.von_mises / exact.von_mises, 1.0, 1e-4) << station.name;
  }
}

class StaticStress : public testing::TestWithParam<StaticCase> {};

TEST_P(StaticStress, AgreesWithFiniteElementsAtEveryPointAndMesh) {
  if (!is_installed()) GTEST_SKIP() << "skipped: ccx not installed";
  const auto comparison = compare_static_stresses(GetParam());
  ASSERT_TRUE(comparison) << comparison.error().message;
  ASSERT_EQ(comparison->meshes.size(), 2U);
  expect_convergence(*comparison);
  for (const std::string& missed : missed_targets(*comparison)) ADD_FAILURE() << missed;
}

std::string test_name(const testing::TestParamInfo<StaticCase>& info) {
  std::string name = info.param.name;
  for (char& letter : name)
    if (std::isalnum(static_cast<unsigned char>(letter)) == 0) letter = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Fem, StaticStress, testing::ValuesIn(static_cases()), test_name);

TEST(StaticStressOfATube, IsLamesInBothCodes) {
  if (!is_installed()) GTEST_SKIP() << "skipped: ccx not installed";
  const auto tube = compare_tube();
  ASSERT_TRUE(tube) << tube.error().message;
  EXPECT_NEAR(tube->exact_bore, 574.386e6, 500.0);  // model, section 10
  EXPECT_NEAR(tube->exact_outside, 474.386e6, 500.0);
  EXPECT_NEAR(tube->element_bore / tube->exact_bore, 1.0, 1e-4);
  EXPECT_NEAR(tube->element_outside / tube->exact_outside, 1.0, 1e-4);
  EXPECT_NEAR(tube->particle_bore / tube->exact_bore, 1.0, 5e-4);
  EXPECT_NEAR(tube->particle_outside / tube->exact_outside, 1.0, 5e-4);
}

}  // namespace
}  // namespace launchsafe::verify
