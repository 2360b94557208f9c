#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "scene/scene_text.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace launchsafe::scene {
namespace {

SceneFile shipped() { return read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml").value(); }

/// What a scene has that is not plausible, one clause each.
std::string validity_warnings_of(const Scene& scene) {
  std::string text;
  for (const Implausible& each : implausible_values(scene)) text += validity_warning(each) + "\n";
  return text;
}

std::set<std::string> implausible_keys(const Scene& scene) {
  std::set<std::string> keys;
  for (const Implausible& each : implausible_values(scene)) keys.insert(each.key);
  return keys;
}

/// The shipped scene with a few keys written otherwise.
SceneFile shipped_with(const std::vector<std::pair<std::string, std::string>>& edits) {
  SceneFile file = shipped();
  for (const auto& [key, value] : edits) {
    auto changed = with_written_key(file, key, value, {"edit", 1, 1});
    EXPECT_TRUE(changed) << key << " " << (changed ? "" : changed.error().message());
    if (changed) file = std::move(*changed);
  }
  return file;
}

TEST(Plausibility, EveryKeyHasARangeWithItsReasonOrAReasonWhyItHasNone) {
  for (const DocumentedKey& key : describe_keys()) {
    if (key.description.name.starts_with("accept.")) continue;
    EXPECT_FALSE(key.description.plausible.because.empty()) << key.description.name;
  }
  for (const DerivedQuantity& each : derived_quantities())
    EXPECT_FALSE(each.description.plausible.because.empty()) << each.description.name;
}

TEST(Plausibility, EveryDefaultAndTheShippedSceneArePlausible) {
  // What only the user can say has no default.
  for (const Key<Scene>& key : scene_keys())
    EXPECT_TRUE(key.standing == Standing::input || is_plausible(key, key.default_value())) << key.name;
  EXPECT_EQ(validity_warnings_of(shipped().scene), "");
}

TEST(Plausibility, SuggestsThePrefixOfTheUnitThatMakesAValuePlausible) {
  const auto suggestion = [](const std::string& key, const char* value) {
    for (const Implausible& each : implausible_values(shipped_with({{key, value}}).scene))
      if (each.key == key) return each.suggestion;
    return std::string("plausible");
  };
  EXPECT_EQ(suggestion("load.peak", "496 kPa"), "496 MPa");
  EXPECT_EQ(suggestion("charge.crack_radius", "30 mm"), "30 µm");
  EXPECT_EQ(suggestion("load.peak", "5 GPa"), "") << "nothing that a factor of a thousand mends";
  // What follows from keys stands nowhere.
  for (const Implausible& each : implausible_values(shipped_with({{"load.peak", "496 kPa"}}).scene))
    EXPECT_TRUE(each.key == "load.peak" || each.suggestion.empty()) << each.key;
}

// Each of these ended with every gap SAFE, or might have: the air does not heat, the skin is thick, nothing
// rubs, cracks, ignites or moves.
TEST(Plausibility, NamesTheKeyOfEveryValueThatNoLaunchHas) {
  const std::vector<std::pair<std::string, std::string>> edits{
      {"gap.exchange_time", "100 s"},
      {"gap.skin_thickness", "1 mm"},
      {"gap.air_specific_heat", "100 J/(kg K)"},
      {"gap.air_heat_ratio", "1.2"},
      {"gap.air_pressure", "90 kPa"},
      {"initial_temperature", "200 K"},
      {"friction.closure", "none"},
      {"friction.localisation", "0"},
      {"charge.sliding_friction", "0"},
      {"charge.crack_radius", "0 um"},
      {"charge.flaw_size", "0 mm"},
      {"charge.crack_growth", "false"},
      {"charge.toughness", "5e8 Pa m^0.5"},
      {"charge.density", "0.5 g/cm3"},
      {"charge.specific_heat", "10000 J/(kg K)"},
      {"charge.shear_moduli", "944, 0.1, 0.1, 0.1, 0.1 GPa"},
      {"charge.jwl.a", "1e17 Pa"},
      {"kinetics.ignition_temperature", "700 K"},
      {"kinetics.heat_of_reaction", "0 J/kg"},
      {"kinetics.activation_temperature", "50000 K"},
      {"steel.density", "0.78 g/cm3"},
      {"steel.yield_stress", "792 GPa"},
      {"load.peak", "496 Pa"},
      {"load.duration", "1 s"},
      {"numerics.energy_drift_limit", "100"},
      {"numerics.inertial_scaling", "1000"},
      {"numerics.time_step_factor", "1"},
      {"output.trace_interval", "5 ms"},
      {"body.base.x", "67.8 to 900 cm"},
  };
  for (const auto& [key, value] : edits) {
    // What has to change with it for the scene to be valid at all.
    std::vector<std::pair<std::string, std::string>> all{{key, value}};
    if (key == "body.base.x") all.insert(all.begin(), {"numerics.cell_size", "0.2 mm"});
    if (key == "load.peak") all.insert(all.begin(), {"load.base", "0 Pa"});
    const Scene scene = shipped_with(all).scene;
    EXPECT_TRUE(implausible_keys(scene).contains(key)) << key << " = " << value << "\n"
                                                       << validity_warnings_of(scene);
  }
}

TEST(Plausibility, JudgesWhatSeveralKeysMakeTogether) {
  using Edits = std::vector<std::pair<std::string, std::string>>;
  const std::vector<std::pair<std::set<std::string>, Edits>> edits{
      {{"gap.heat_law"}, {{"gap.air_heat_ratio", "1.3"}}},
      {{"load.exit_calibres", "load.launch_speed", "load.travel"}, {{"load.peak", "12 MPa"}}},
      {{"load.launch_speed"}, {{"load.peak", "180 MPa"}}},  // 281 m/s: 774 at 496 MPa
      {{"load.launch_speed"}, {{"load.peak", "790 MPa"}}},  // 1 232 m/s
      {{"load.exit_calibres", "load.launch_speed", "load.travel"},
       {{"load.steepness", "1.37"},
        {"load.peak_time", "11.39 ms"},
        {"load.muzzle_exit", "12 ms"},
        {"load.width", "0.21 ms"}}},
      {{"charge.bulk_sound_speed", "charge.poisson_ratio"}, {{"charge.jwl.r1", "16"}}},
      {{"charge.poisson_ratio"}, {{"charge.shear_moduli", "2, 2, 2, 2, 2 MPa"}}},
      {{"charge.heat_capacity"},
       {{"charge.density", "2.2 g/cm3"}, {"charge.specific_heat", "2000 J/(kg K)"}}},
      {{"steel.poisson_ratio"},
       {{"steel.density", "7.6 g/cm3"}, {"steel.sound_speed", "4 km/s"}, {"steel.shear_modulus", "90 GPa"}}},
      {{"kinetics.explosion_temperature"}, {{"kinetics.frequency", "1e10 1/s"}}},
      {{"physics.conduction"}, {{"physics.conduction", "off"}, {"numerics.cell_size", "0.625 mm"}}},
      {{"charge.largest_crack_radius"},
       {{"charge.crack_radius", "3 mm"}, {"charge.largest_crack_radius", "2 mm"}}},
  };
  for (const auto& [quantities, keys] : edits) {
    const Scene scene = shipped_with(keys).scene;
    EXPECT_EQ(implausible_keys(scene), quantities) << validity_warnings_of(scene);
  }
}

// (3 K - 2 G) / (2 (3 K + G)) with K = 10.297 GPa and G = 3.235 GPa; with 7830 kg/m3 (4610 m/s)^2 and 80 GPa.
TEST(Plausibility, DerivedQuantitiesOfTheShippedSceneAreThoseOfTheModel) {
  const Scene scene = shipped().scene;
  const RigidMotion launch = rigid_motion(scene, read_time(scene.load));
  const auto value = [&](const std::string& name) {
    for (const DerivedQuantity& each : derived_quantities()) {
      if (each.description.name == name) return each.value(scene, launch).value_or(-1.0);
    }
    return std::nan("");
  };
  EXPECT_NEAR(value("charge.bulk_sound_speed"), std::sqrt(10.297e9 / 1717.0), 0.5);
  EXPECT_NEAR(value("charge.poisson_ratio"), 0.3578, 1e-3);
  EXPECT_NEAR(value("steel.poisson_ratio"), 0.2930, 1e-3);
  EXPECT_NEAR(value("gap.heat_law"), 1.0, 1e-3);
  EXPECT_EQ(value("load.simulated_peak"), -1.0) << "the stated one is judged by itself";
  EXPECT_EQ(value("shell.length"), 0.74);
  // E/T = ln(Q Z E / (c T^2)) at 1 s: T = 452.2 K by hand.
  EXPECT_NEAR(value("kinetics.explosion_temperature"), 452.2, 0.5);
}

std::string with_curve(const std::string& times, const std::string& pressures, const std::string& more = "") {
  return fmt::format("load.curve_time = \"{}\"\nload.curve_pressure = \"{}\"\n{}", times, pressures, more) +
         with(small_scene, "[load]\nduration = \"1 ms\"\n", "load.duration = \"10 ms\"\n");
}

TEST(Plausibility, JudgesAMeasuredCurveByItsLargestPressureAndByWhatIsSimulated) {
  const auto keys_of = [](const std::string& text) {
    const auto file = parse_scene(text, "shell.toml");
    EXPECT_TRUE(file) << (file ? "" : file.error().message());
    return file ? implausible_keys(file->scene) : std::set<std::string>{};
  };
  using Keys = std::set<std::string>;
  // The small shell is light: 20 MPa launch it with 360 m/s.
  EXPECT_EQ(keys_of(with_curve("0, 5, 10 ms", "0, 20, 5 MPa")), Keys{});
  const Keys none{"load.launch_speed", "load.measured_peak", "load.travel"};
  EXPECT_EQ(keys_of(with_curve("0, 5, 10 ms", "0, 496, 100 Pa")), none) << "MPa labelled Pa";
  EXPECT_EQ(keys_of(with_curve("0, 5, 10 ms", "0, 496, 100 kPa")), none) << "MPa labelled kPa";
  EXPECT_EQ(keys_of(with_curve("0, 5, 10 ms", "0, 0, 0 MPa")), none) << "zero load";
  EXPECT_EQ(keys_of(with_curve("0, 20, 25, 30 ms", "0, 0, 20, 5 MPa")),
            (Keys{"load.launch_speed", "load.simulated_peak", "load.travel"}))
      << "the pulse comes after the end";
  EXPECT_EQ(keys_of(with_curve("0, 5, 10 ms", "0, 496, 100 Pa",
                               "load.rescale_to_peak = true\nload.peak = \"20 MPa\"\n")),
            (Keys{"load.measured_peak", "load.rescaling"}))
      << "a wrong label stays implausible where the curve is scaled";
  // Numbers of the analytic shape do nothing under a curve.
  EXPECT_EQ(keys_of("load.steepness = 99\n" + with_curve("0, 5, 10 ms", "0, 20, 5 MPa")), Keys{});
}

TEST(Plausibility, AValueThatIsAcceptedKeepsItsReason) {
  const std::string text =
      "accept = [{ key = \"gap.skin_thickness\", value = \"500 um\", because = \"a coated charge\" }]\n" +
      with(small_scene, "[gap]\n", "[gap]\nskin_thickness = \"0.5 mm\"\n");
  const auto file = parse_scene(text, "shell.toml");
  ASSERT_TRUE(file) << file.error().message();
  for (const Implausible& each : implausible_values(file->scene))
    EXPECT_EQ(each.accepted(), each.key == "gap.skin_thickness") << each.key;
  EXPECT_NE(accepted_text(implausible_values(file->scene)).find("gap.skin_thickness = 0.5 mm"),
            std::string::npos);
  const auto thin = with_written_key(*file, "gap.skin_thickness", "0.1 mm", {"edit", 1, 1});
  ASSERT_TRUE(thin);
  EXPECT_EQ(accepted_text(implausible_values(thin->scene)), "");
}

// An acceptance is of the value that it names.
TEST(Plausibility, AnAcceptanceIsVoidWhenTheValueChanges) {
  const std::string text = with(small_scene, "[gap]\n", "[gap]\nskin_thickness = \"0.5 mm\"\n");
  const auto warning_with = [&](const std::string& value) {
    const auto file = parse_scene("accept = [{ key = \"gap.skin_thickness\", value = \"" + value +
                                      "\", because = \"a coated charge\" }]\n" + text,
                                  "shell.toml");
    EXPECT_TRUE(file) << value << file.error().message();
    for (const Implausible& each : implausible_values(file->scene))
      if (each.key == "gap.skin_thickness")
        return each.accepted() ? std::string("none") : validity_warning(each);
    return std::string("not implausible");
  };
  for (const char* same : {"0.5 mm", "500 um", "0.05 cm", "0.4 to 0.6 mm"})
    EXPECT_EQ(warning_with(same), "none");
  for (const char* other : {"0.51 mm", "5 mm", "0.3 to 0.49 mm"})
    EXPECT_NE(warning_with(other).find(other), std::string::npos) << warning_with(other);
}

TEST(Plausibility, AcceptancesSurviveWritingAndChangeNoMechanicalRun) {
  SceneFile file = shipped();
  const std::string plain = to_toml(file.scene), mechanics = to_toml(mechanical_part(file.scene));
  EXPECT_EQ(plain.find("accept"), std::string::npos) << "scenes without acceptances are written as ever";
  file.scene.accepted = {{"gap.exchange_time", "3 ms", "an \"open\" gap, 50 % \\ 'wide'"},
                         {"load.peak", "620 MPa", "změřený přetlak"}};
  const auto again = parse_scene(to_toml(file.scene), "written.toml");
  ASSERT_TRUE(again) << again.error().message();
  ASSERT_EQ(again->scene.accepted.size(), 2u);
  EXPECT_EQ(again->scene.accepted[0].because, file.scene.accepted[0].because);
  EXPECT_EQ(to_toml(again->scene), to_toml(file.scene));
  EXPECT_NE(to_toml(file.scene), plain);
  EXPECT_EQ(to_toml(mechanical_part(file.scene)), mechanics);
}

TEST(Plausibility, RefusesAcceptancesThatNameNoKeyOrGiveNoReason) {
  const auto refused = [](const std::string& tables, std::string_view key) {
    expect_error(error_of("accept = " + tables + "\n" + small_scene), 1, key);
  };
  const auto entry = [](const std::string& key, const std::string& value, const std::string& because) {
    return "{ key = \"" + key + "\", value = \"" + value + "\", because = \"" + because + "\" }";
  };
  refused("[" + entry("gap.exchange_tim", "3 ms", "it is meant") + "]", "accept.key");
  refused("[{ key = \"gap.exchange_time\", value = \"3 ms\" }]", "accept.because");
  refused("[" + entry("gap.exchange_time", "3 ms", "") + "]", "accept.because");
  refused("[" + entry("gap.exchange_time", "3 ms", "12345678910") + "]", "accept.because");
  refused("[" + entry("gap.exchange_time", "3 ms", "TODO fill in reason") + "]", "accept.because");
  refused("[" + entry("gap.exchange_time", "3 ms", "two lines\\nof words") + "]", "accept.because");
  refused("[" + entry("load.peak", "620 MPa", "it is meant") + ", " +
              entry("load.peak", "620 MPa", "so it is") + "]",
          "accept.key");
  refused("\"gap.exchange_time\"", "accept");
  refused("[{ key = \"load.peak\", because = \"it is meant\" }]", "accept.value");
  refused("[" + entry("load.peak", "620", "it is meant") + "]", "accept.value");
  refused("[" + entry("load.peak", "1 to 900 MPa", "it is meant") + "]", "accept.value");
  refused("[" + entry("load.peak", "620 MPa", "it is meant") +
              ", { key = \"calibration\", because = \"all is "
              "alike\" }]",
          "accept.key");
}

TEST(Plausibility, RefusesWhatIsNoPhysicsAtAll) {
  const std::vector<std::pair<std::string, std::string>> edits{
      {"gap.air_specific_heat", "1e-300 J/(kg K)"},
      {"charge.jwl.a", "-1 GPa"},
      {"charge.jwl.b", "50 GPa"},
      {"charge.jwl.r1", "1"},
      {"charge.jwl.r2", "12"},
      {"charge.density", "1.2 kg/m3"},
      {"charge.density", "1717 g/cm3"},
      {"steel.density", "7.83 kg/m3"},
      {"kinetics.ignition_temperature", "1e6 K"},
      {"charge.shear_moduli", "-1, 1, 1, 1, 1 GPa"},
      {"gap.air_heat_ratio", "1"},
      {"gap.air_heat_ratio", "2"},
  };
  for (const auto& [key, value] : edits) {
    const auto changed = with_written_key(shipped(), key, value, {"edit", 3, 1});
    ASSERT_FALSE(changed) << key << " = " << value;
    EXPECT_TRUE(changed.error().key.starts_with(key.substr(0, key.rfind('.')))) << changed.error().message();
    EXPECT_EQ(changed.error().line, 3) << changed.error().message();
  }
}

}  // namespace
}  // namespace launchsafe::scene
