// A small change of an input moves the bounds of a critical gap by little more than the critical gap itself:
// 1 % of it or 0.0002 cm, whichever is more. Launches of the 155 mm shell, minutes: label `continuity`.
#include "computed_rows.hpp"
#include "program.hpp"

#include <fmt/format.h>

#include <iostream>
#include <random>

namespace launchsafe::app {
namespace {

using study::CaseRow;

/// A number of the scene with what it is written in, and the range in which it is random.
struct Input {
  std::string key, unit;
  double lowest, highest;
};
const std::vector<Input> inputs{
    {"load.peak", " MPa", 420, 530},
    {"load.muzzle_exit", " ms", 17, 18.6},
    {"initial_temperature", " K", 240, 330},
    {"charge.density", " g/cm3", 1.68, 1.75},
    {"charge.crack_radius", " um", 20, 50},
    {"charge.flaw_size", " mm", 0.6, 1},
    {"charge.specific_heat", " J/(kg K)", 1720, 1840},
    {"charge.jwl.a", " GPa", 77810, 77810},
    {"charge.shear_moduli", " MPa", 0.98, 1.02},  // all of them, times that
    {"steel.yield_stress", " MPa", 640, 690},
    {"numerics.cell_size", " mm", 2.5, 2.5},
};
constexpr std::array shear_moduli{944.0, 173.8, 521.2, 908.5, 687.5};  // MPa

std::string written(const Input& input, double value) {
  std::string number = fmt::format("{:.10g}", value);
  if (input.key == "charge.shear_moduli") {
    std::vector<std::string> all;
    for (const double modulus : shear_moduli) all.push_back(fmt::format("{:.10g}", value * modulus));
    number = fmt::format("{}", fmt::join(all, ", "));
  }
  return fmt::format("{} = \"{}{}\"\n", input.key, number, input.unit);
}

class Continuity : public testing::TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    // Other loads than that of the scene have other velocities.
    std::ofstream(folder() / "shell.toml")
        << with(shipped("scene_155mm.toml"), "expected_velocity", "# expected_velocity");
  }
  CaseRow row_of(const std::string& constants, const std::string& set) const {
    const std::string text =
        "kind = \"critical-gap\"\nscene = \"shell.toml\"\ngaps = \"0 cm\"\nconstants = \"" + constants +
        "\"\n[set]\n" + set;
    const auto rows = computed_rows(text, folder());
    EXPECT_TRUE(rows) << rows.error().message() << text;
    if (!rows) return {};
    EXPECT_TRUE(rows->front().failure.empty() && rows->front().incomplete.empty())
        << rows->front().failure << rows->front().incomplete << text;
    return rows->front();
  }
};

/// m, by how much a number grew; 0 where both are infinite.
double growth(double before, double after) { return before == after ? 0.0 : after - before; }

/// m, by how much a bound may move.
double allowed(const CaseRow& before, const CaseRow& after) {
  const double gap = gap_or_bound(before.critical);
  return std::abs(growth(gap, gap_or_bound(after.critical))) + std::max(0.01 * gap, 2e-6);
}

void expect_continuous(const CaseRow& before, const CaseRow& after, const std::string& change) {
  const double most = allowed(before, after);
  EXPECT_LE(std::abs(growth(before.bounds.at_least, after.bounds.at_least)), most) << change;
  EXPECT_LE(std::abs(growth(before.bounds.at_most, after.bounds.at_most)), most) << change;
}

/// One of the inputs of a random scene changes by one per mille; cells become smaller.
TEST_F(Continuity, OfRandomPairs) {
  constexpr std::size_t pairs = 100;
  std::mt19937_64 engine(68);  // whose numbers the standard fixes
  const auto uniform = [&engine](double lowest, double highest) {
    return lowest + (highest - lowest) * static_cast<double>(engine() >> 11) * 0x1p-53;
  };
  for (std::size_t pair = 0; pair < pairs; ++pair) {
    const std::size_t changed = pair % inputs.size();
    std::string before, after;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const double value = uniform(inputs[i].lowest, inputs[i].highest);
      const double factor = i != changed ? 1.0 : inputs[i].key == "numerics.cell_size" ? 0.999 : 1.001;
      before += written(inputs[i], value);
      after += written(inputs[i], factor * value);
    }
    expect_continuous(row_of("155mm_coarse", before), row_of("155mm_coarse", after),
                      fmt::format("pair {}, {} of\n{}", pair, inputs[changed].key, before));
  }
}

TEST_F(Continuity, OfListedPairs) {
  const CaseRow before = row_of("155mm", "");
  const auto print = [](const std::string& name, const CaseRow& row, double most) {
    std::cout << fmt::format("{:36} {:9.5f} {:9.5f} {:9.5f} {:9.5f}\n", name, 100.0 * row.critical.value,
                             100.0 * row.bounds.at_least, 100.0 * row.bounds.at_most, 100.0 * most);
  };
  std::cout << fmt::format("{:36} {:>9} {:>9} {:>9} {:>9}\n", "cm", "critical", "at least", "at most",
                           "may move");
  print("the shipped scene", before, 0.0);
  for (const std::string change :
       {std::string("load.muzzle_exit = \"18.001 ms\"\n"), std::string("initial_temperature = \"300.3 K\"\n"),
        std::string("charge.crack_radius = \"29 um\"\n"), std::string("charge.density = \"1.716 g/cm3\"\n"),
        std::string("load.peak = \"496.5 MPa\"\n")}) {
    const CaseRow after = row_of("155mm", change);
    print(change.substr(0, change.size() - 1), after, allowed(before, after));
    expect_continuous(before, after, change);
  }
  // Finer cells narrow the bounds, or leave them.
  const std::string finer = "numerics.cell_size = \"1 mm\"\n";
  const CaseRow after = row_of("155mm", finer);
  const double most = allowed(before, after);
  print(finer.substr(0, finer.size() - 1), after, most);
  EXPECT_GE(growth(before.bounds.at_least, after.bounds.at_least), -most);
  EXPECT_LE(growth(before.bounds.at_most, after.bounds.at_most), most);
}

}  // namespace
}  // namespace launchsafe::app
