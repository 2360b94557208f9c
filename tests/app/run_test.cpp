// launchsafe run: what it prints, what it writes, and how it ends.
#include "launchsafe/run/run_case.hpp"
#include "launchsafe/store/case_file.hpp"
#include "program.hpp"

#include <nlohmann/json.hpp>

namespace launchsafe::app {
namespace {

class RunProgram : public Program {};

TEST_F(RunProgram, PrintsATableAndWritesACaseFile) {
  write("shell.toml", tiny_scene);
  const Outcome outcome = run({"run", "shell.toml", "-o", "out/deep"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  for (const std::string part :
       {"a small shell", "9.019 m/s", "0.000933 m", "T max [K]", "G1", "net work done on it"}) {
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << " in\n" << outcome.out;
  }
  const store::StoredCase stored = store::read_case_file(folder() / "out/deep/shell.h5");
  EXPECT_EQ(stored.result.gaps.size(), 2u);
  EXPECT_EQ(stored.result.mechanics.status, run::RunStatus::completed);
}

TEST_F(RunProgram, WritesNothingWithoutBeingTold) {
  write("shell.toml", tiny_scene);
  EXPECT_EQ(run({"run", "shell.toml"}).code, 0);
  EXPECT_EQ(listing().size(), 3u);  // the scene, stdout, stderr
}

TEST_F(RunProgram, JsonIsOneObjectAndNothingElse) {
  write("shell.toml", tiny_scene);
  const Outcome outcome = run({"run", "shell.toml", "--json", "--quiet"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(outcome.err.empty()) << outcome.err;
  const auto object = nlohmann::json::parse(outcome.out);  // throws on anything after the object
  EXPECT_EQ(object["status"], "completed");
  ASSERT_EQ(object["gaps"].size(), 2u);
  EXPECT_EQ(object["gaps"][1]["gap_cm"], 0.01);
  EXPECT_EQ(object["gaps"][1]["at_observation_points"]["temperature_max_place"], "G1");
  EXPECT_TRUE(object["gaps"][1]["ignition"].is_null());
  EXPECT_GT(object["timing"]["updates_per_second"], 0.0);
  EXPECT_TRUE(object["energy"].contains("drift"));
  for (const char* key : {"largest_plastic_strain_percent", "yielded_wall_mm", "friction_over_work"})
    EXPECT_TRUE(object["effects"].contains(key)) << key;
  EXPECT_EQ(object["file"], "");
}

// A trace of three samples, and a launch of 9 m/s over a millimetre.
TEST_F(RunProgram, WarningsStandBeforeEveryTemperatureAndLeaveTheExitCode) {
  write("shell.toml", with(tiny_scene, "trace_interval = \"5 us\"", "trace_interval = \"50 us\""));
  const Outcome text = run({"run", "shell.toml", "-o", "out", "--quiet"});
  const Outcome json = run({"run", "shell.toml", "--json", "--quiet"});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_EQ(json.code, 0) << json.err;
  const store::StoredCase stored = store::read_case_file(folder() / "out/shell.h5");
  const scene::Scene scene = scene::parse_scene(stored.manifest.input_text, "shell.toml").scene;
  auto expected = run::validity_warnings(scene, stored.result.mechanics);
  EXPECT_FALSE(expected.empty());
  std::ranges::move(run::launch_warnings(scene), std::back_inserter(expected));
  const std::vector<std::string> listed = nlohmann::json::parse(json.out)["validity_warnings"];
  ASSERT_EQ(listed.size(), expected.size());
  for (std::size_t i = 0; i < listed.size(); ++i) {
    EXPECT_EQ(listed[i], expected[i].name + ": " + expected[i].text);
    EXPECT_LT(text.out.find("warning " + listed[i]), text.out.find("T max [K]")) << text.out;
  }
}

TEST_F(RunProgram, AResultThatIsThereIsLeftAsItWas) {
  write("shell.toml", tiny_scene);
  ASSERT_EQ(run({"run", "shell.toml", "-o", "out"}).code, 0);
  const std::string before = read("out/shell.h5");
  write("shell.toml", with(tiny_scene, "50 MPa", "60 MPa"));
  const Outcome outcome = run({"run", "shell.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(outcome.says("out/shell.h5")) << outcome.err;
  EXPECT_TRUE(outcome.out.empty()) << outcome.out;
  EXPECT_EQ(read("out/shell.h5"), before);
}

TEST_F(RunProgram, ARunPastItsEnergyBoundFails) {
  write("shell.toml", with(tiny_scene, "energy_drift_limit = 0.5", "energy_drift_limit = 1e-9"));
  const Outcome outcome = run({"run", "shell.toml", "-o", "out"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_EQ(store::read_case_file(folder() / "out/shell.h5").result.mechanics.status,
            run::RunStatus::energy_drift);
}

TEST_F(RunProgram, ExplainSaysWhatIsInAndWhatItCosts) {
  write("shell.toml", tiny_scene);
  const Outcome outcome = run({"explain", "shell.toml"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  const auto object = nlohmann::json::parse(run({"explain", "shell.toml", "--json"}).out);
  EXPECT_EQ(object["particles"]["charge"], 18);
  for (const auto& [name, term] : object["physics"].items())
    EXPECT_NE(outcome.out.find(term["reason"]), std::string::npos) << name;
}

}  // namespace
}  // namespace launchsafe::app
