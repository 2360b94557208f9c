// What the model of this version says, over all its laws: no truth, but a guard. Stored results are taken for
// results of this model as long as its version is the same, so numbers must not change without it.
//
// Where a change of numbers is meant: raise model_version, let this test write model_numbers.csv anew
// (LAUNCHSAFE_MODEL_NUMBERS=FILE in the environment names where to), and change `digest` with it.

#include "launchsafe/materials/ideal_gas.hpp"
#include "launchsafe/materials/kinetics.hpp"
#include "launchsafe/materials/mie_gruneisen.hpp"
#include "launchsafe/materials/steel.hpp"
#include "launchsafe/materials/vlw.hpp"
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "small_shell.hpp"
#include "support/visco_scram_update.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace launchsafe::run {
namespace {

/// Of the file with the numbers of this version, by `digest_of`.
constexpr std::uint64_t digest = 0xf22d1b345a9f005eU;

const char* const numbers_file = LAUNCHSAFE_SOURCE_DIR "/tests/run/model_numbers.csv";

/// FNV-1a, 64 bits (Fowler, Noll, Vo): against forgetting, not against malice.
std::uint64_t digest_of(const std::string& text) {
  std::uint64_t digest = 14695981039346656037U;
  for (const char letter : text) digest = (digest ^ static_cast<unsigned char>(letter)) * 1099511628211U;
  return digest;
}

struct Number {
  std::string name;
  double value = 0;
  double scale = 0;  ///< in its unit: of less than this nobody wants to know a share
};
using Numbers = std::vector<Number>;

// --- the laws by themselves, in small and large steps ---

void add_steel(Numbers& numbers) {
  using namespace materials;
  const JohnsonCookParameters strength;
  const MieGruneisenParameters volume;
  for (const double strain : {1e-3, 0.02, 0.3}) {
    for (const double temperature : {300.0, 900.0}) {
      const math::Deviator<double> trial{-strain * 1.6e11, strain * 2.4e11, strain * 0.8e11};
      const auto end = johnson_cook_return(strength, trial, 0.01, temperature, 1e-7);
      const std::string name = fmt::format("steel, strain {}, {} K: ", strain, temperature);
      numbers.push_back({name + "stress", math::von_mises(end.stress)});
      numbers.push_back({name + "plastic work", end.plastic_work});
    }
  }
  for (const double mu : {-0.2, -0.01, 0.005, 0.15}) {
    const auto end = mie_gruneisen_compress(volume, 0.001, 1e8, 1e3, mu, 50.0);
    const std::string name = fmt::format("steel, mu {}: ", mu);
    numbers.push_back({name + "pressure", end.pressure});
    numbers.push_back({name + "energy", end.energy});
    numbers.push_back({name + "bulk modulus", mie_gruneisen_bulk_modulus(volume, mu, end.pressure)});
  }
}

void add_cracks(Numbers& numbers) {
  using namespace test_support;
  for (const double strain : {1e-5, 2e-3, 0.05}) {
    for (const double pressure : {-1e7, 1e6, 3e8}) {
      for (const bool friction : {false, true}) {
        ViscoScramParameters law;
        if (!friction) law.face_friction = 0.0;
        ElementsState<double> state{};
        state.crack_radius = law.initial_crack_radius;
        Dissipation lost{};
        constexpr double step = 5e-6;  // s, past the fastest element's time
        const math::Deviator<double> de{-strain, 1.5 * strain, 0.4 * strain};
        math::Deviator<double> before{};
        for (int i = 0; i < 3; ++i) {
          before = total_deviator(state);
          lost = charge_update(step_of(law, step), state, de, pressure);
        }
        const auto elastic = (0.5 / law.shear_modulus()) * (total_deviator(state) - before);
        const std::string name =
            fmt::format("charge, strain {}, {} Pa, friction {}: ", strain, pressure, friction);
        numbers.push_back({name + "stress", math::von_mises(total_deviator(state))});
        numbers.push_back({name + "crack radius", state.crack_radius});
        numbers.push_back({name + "dissipation", lost.viscous + lost.crack});
        numbers.push_back({name + "inelastic strain", math::equivalent_strain(de - elastic)});
      }
    }
  }
}

void add_gases(Numbers& numbers) {
  using namespace materials;
  for (const double pressure : {101325.0, 1e7, 1.4e8})
    numbers.push_back(
        {fmt::format("air at {} Pa", pressure), adiabatic_temperature(AirParameters{}, pressure)});
  const ProductGas products(composition_b_gas(), 1780.0);
  for (const double temperature : {2500.0, 4000.0})
    numbers.push_back(
        {fmt::format("gas at {} K", temperature), products.at(temperature, 1.0 / 200.0).pressure});
  KineticsParameters kinetics;
  kinetics.ignition_temperature = 519.445;
  for (const double temperature : {450.0, 525.0, 700.0}) {
    numbers.push_back(
        {fmt::format("heating at {} K", temperature), arrhenius_heating(kinetics, 1780.0, temperature)});
    numbers.push_back({fmt::format("reaction at {} K", temperature), reaction_degree(kinetics, temperature)});
  }
}

// --- runs ---

/// Keys of a scene with their values as text.
using Keys = std::map<std::string, std::string>;

const Keys common{{"load.duration", "\"0.2 ms\""},
                  {"load.base", "\"0 Pa\""},
                  {"load.peak", "\"400 MPa\""},
                  {"load.peak_time", "\"0.15 ms\""},
                  {"load.shape", "\"power-exponential\""},
                  {"friction.localisation", "1508.09"},
                  {"kinetics.ignition_temperature", "\"519.445 K\""},
                  {"load.exponent", "3"},
                  {"numerics.cell_size", "\"5 mm\""},
                  {"output.trace_interval", "\"4 us\""},
                  {"numerics.energy_drift_limit", "0.5"},
                  {"gap.exchange_time", "\"10 us\""}};

/// Scenes that together pass through all that a run can do: each says in what it differs from the first.
const std::map<std::string, Keys> scenes{
    {"plain", {}},
    {"no barrel, yielding", {{"barrel", "\"none\""}, {"load.peak", "\"1.5 GPa\""}}},
    {"tension",
     {{"barrel", "\"none\""}, {"load.peak_time", "\"0.03 ms\""}, {"charge.tension_cutoff", "\"1 MPa\""}}},
    {"no cracks", {{"charge.flaw_size", "\"0 mm\""}}},
    {"still cracks", {{"charge.crack_growth", "false"}}},
    {"cracks without friction", {{"charge.face_friction", "0"}, {"charge.crack_radius", "\"300 um\""}}},
    {"no friction", {{"friction.closure", "\"none\""}}},
    {"printed kinetics",
     {{"kinetics.activation_temperature", "\"27000 K\""}, {"kinetics.ignition_temperature", "\"400 K\""}}},
    {"conduction", {{"physics.conduction", "\"on\""}}},
    {"bulk reaction", {{"physics.bulk_reaction", "\"on\""}}},
    {"scaled inertia", {{"numerics.inertial_scaling", "9"}, {"numerics.damping_time", "\"0.05 ms\""}}},
    {"selective inertia", {{"numerics.selective_inertia", "3"}}},
    {"two particles a cell",
     {{"numerics.particles_per_cell", "2"},
      {"numerics.pic_fraction", "0.1"},
      {"numerics.time_step_factor", "0.4"}}},
    {"measured load",
     {{"load.curve_time", "\"0, 0.1, 0.15, 0.2 ms\""}, {"load.curve_pressure", "\"0, 300, 400, 200 MPa\""}}}};

scene::Scene scene_with(Keys keys) {
  keys.insert(common.begin(), common.end());
  if (keys.contains("load.curve_time")) {
    for (const char* analytic : {"load.base", "load.peak", "load.peak_time", "load.shape", "load.exponent"})
      keys.erase(analytic);
  }
  std::string text;
  for (const auto& [key, value] : keys) text += fmt::format("{} = {}\n", key, value);
  text += testing::small_shell + testing::small_shell_base + testing::small_shell_point;
  const auto file = scene::caught([&] { return scene::parse_scene(text, "model.toml"); });
  EXPECT_TRUE(file) << (file ? "" : file.error().message());
  return file ? file->scene : scene::Scene{};
}

void add_skin(Numbers& numbers, const std::string& name, const GapResult& gap) {
  numbers.push_back({name + "T max", gap.at_points.temperature});
  numbers.push_back({name + "T max at stations", gap.at_stations.temperature});
  numbers.push_back({name + "ignition", gap.skin.ignition ? gap.skin.ignition->time : -1.0});
}

void add_run(Numbers& numbers, const std::string& title, const scene::Scene& scene) {
  const MechanicsResult result = run_mechanics(scene);
  ASSERT_EQ(result.status, RunStatus::completed) << title << ": " << result.reason;
  const trace::BottomTrace& bottom = result.trace;
  const std::string name = title + ": ";
  for (const double share : {0.25, 0.75, 1.0}) {
    const double pressure =
        trace::interpolate(bottom.time, bottom.bottom_pressure, share * scene::end_time(scene.load));
    numbers.push_back({name + fmt::format("bottom pressure at {}", share), pressure, 1e-3 * scene.load.peak});
  }
  numbers.push_back({name + "friction 0", bottom.friction.back()});
  const MonitorSample& last = result.monitor.back();
  numbers.push_back({name + "steps", static_cast<double>(result.steps)});
  const double small = 1e-3 * last.energy.internal;
  numbers.push_back({name + "internal energy", last.energy.internal});
  numbers.push_back({name + "plastic dissipation", last.energy.plastic, small});
  numbers.push_back({name + "viscous dissipation", last.energy.viscous, small});
  numbers.push_back({name + "crack dissipation", last.energy.crack, small});
  numbers.push_back({name + "largest crack radius", last.largest_crack_radius});
  for (const double gap : {0.0, 2e-4, 8e-4})
    add_skin(numbers, name + fmt::format("{} m: ", gap), evaluate_gap(scene, bottom, gap));
}

Numbers computed() {
  Numbers numbers;
  add_steel(numbers);
  add_cracks(numbers);
  add_gases(numbers);
  for (const auto& [title, keys] : scenes) add_run(numbers, title, scene_with(keys));
  const scene::Scene plain = scene_with({});
  add_skin(numbers, "coupled: ", run_with_skin(plain, 2e-4).gaps.at(0));
  // Load and constants of an early calibration: what a calibration finds is no part of the model.
  scene::Scene shell =
      scene::with_constants(scene::read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml"), nullptr)
          .scene;
  shell.load.shape = scene::LoadShape::power_exponential;
  shell.load.peak_time = 12.9641e-3;
  shell.surface.localisation = 1508.09;
  shell.surface.exchange_time = 3.04915e-4;
  shell.charge().kinetics.ignition_temperature = 519.445;
  shell.numerics.cell_size = 10e-3;
  shell.numerics.inertial_scaling = 16.0;
  shell.numerics.selective_inertia = 1.0;
  shell.load.duration = 18e-3;  // until the exit
  add_run(numbers, "155 mm", shell);
  return numbers;
}

// --- the file ---

const std::string version_line = fmt::format("# numbers of model version {}\n", model_version);

/// The file: a line for all numbers whose names begin alike, up to their last colon.
std::string table_of(const Numbers& numbers) {
  std::string text = version_line, line_subject = "none yet";
  for (const Number& number : numbers) {
    const std::size_t colon = number.name.rfind(": ");
    const bool alone = colon == std::string::npos;
    const std::string subject = alone ? "" : number.name.substr(0, colon);
    if (subject != line_subject) text += (&number == &numbers.front() ? "" : "\n") + subject;
    line_subject = subject;
    text += fmt::format(";{};{}", alone ? number.name : number.name.substr(colon + 2), number.value);
  }
  return text + '\n';
}

std::string stored_table() {
  std::ifstream file(numbers_file, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Numbers stored_numbers() {
  Numbers numbers;
  std::istringstream lines(stored_table());
  std::string line, subject, name, value;
  std::getline(lines, line);  // the version
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::getline(fields, subject, ';');
    if (!subject.empty()) subject += ": ";
    while (std::getline(fields, name, ';') && std::getline(fields, value, ';'))
      numbers.push_back({subject + name, std::strtod(value.c_str(), nullptr), 0.0});
  }
  return numbers;
}

TEST(ModelVersion, NamesTheNumbersThatAreStored) {
  EXPECT_TRUE(stored_table().starts_with(version_line));
  EXPECT_EQ(digest_of(stored_table()), digest)
      << "the numbers of a version do not change: raise model_version instead";
}

TEST(ModelVersion, BelongsToTheseNumbers) {
  const Numbers now = computed(), stored = stored_numbers();
  if (const char* file = std::getenv("LAUNCHSAFE_MODEL_NUMBERS")) std::ofstream(file) << table_of(now);
  ASSERT_EQ(now.size(), stored.size());
  // Compilers and processors round differently; a change of the model moves more than this.
  constexpr double share = 1e-6;
  for (std::size_t i = 0; i < now.size(); ++i) {
    ASSERT_EQ(now[i].name, stored[i].name);
    EXPECT_TRUE(std::isfinite(now[i].value)) << now[i].name;
    const double size = std::max(std::abs(stored[i].value), now[i].scale);
    EXPECT_NEAR(now[i].value, stored[i].value, share * size) << now[i].name;
  }
}

}  // namespace
}  // namespace launchsafe::run
