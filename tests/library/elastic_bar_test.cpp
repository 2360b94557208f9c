// The example of include/launchsafe/README.md, compiled and held against a closed form.
#include "launchsafe/run/run_case.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

namespace {

// example begin
launchsafe::run::MechanicsResult push_glass_bar(double pressure) {
  using namespace launchsafe;
  scene::Scene bar;
  bar.materials.push_back({"glass", materials::LinearElastic{.density = 2500, .bulk = 40e9, .shear = 30e9}});
  bar.bodies = {{"bar", "glass", 0.0, 0.1, 0.0, 0.01}};  // x from 0 to 0.1 m, r from 0 to 0.01 m
  bar.load.base = 0.0;
  bar.load.peak = pressure;
  bar.load.shape = scene::LoadShape::power_exponential;
  bar.load.duration = bar.load.peak_time = 2e-3;  // s
  return run::run_mechanics(bar);
}
// example end

std::string text_of(const std::string& file) {
  std::ifstream stream(std::string(LAUNCHSAFE_SOURCE_DIR) + "/" + file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A bar in a rigid barrel that is pushed slowly: the axial stress falls linearly from the base's pressure to
/// 0 at the nose, with (p x/L)^2/(2 (K + 4/3 G)) of stored energy per volume. Sound crosses the bar 100 times
/// while the pressure rises, which leaves waves of some thousandths.
TEST(LibraryExample, StoresTheEnergyOfTheClosedForm) {
  const double pressure = 10e6, modulus = 80e9;
  const auto result = push_glass_bar(pressure);
  ASSERT_EQ(result.status, launchsafe::run::RunStatus::completed) << result.reason;
  const double volume = 0.1 * std::numbers::pi * 0.01 * 0.01;
  const double stored = volume * pressure * pressure / (6.0 * modulus);
  EXPECT_NEAR(result.monitor.back().energy.internal, stored, 2e-3 * stored);
  EXPECT_NEAR(mass_of(result, "glass"), 2500.0 * volume, 1e-12 * 2500.0 * volume);
}

TEST(LibraryExample, StandsInTheMapOfModulesAsItIsCompiled) {
  const std::string source = text_of("tests/library/elastic_bar_test.cpp"), begin = "// example begin\n";
  const std::size_t first = source.find(begin) + begin.size();
  const std::string example = source.substr(first, source.find("// example end") - first);
  ASSERT_GT(example.size(), 100U);
  EXPECT_NE(text_of("include/launchsafe/README.md").find(example), std::string::npos);
}

}  // namespace
