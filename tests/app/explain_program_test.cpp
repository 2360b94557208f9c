// What launchsafe explains of itself, and of files.
#include "program.hpp"

#include <nlohmann/json.hpp>

namespace launchsafe::app {
namespace {

using Json = nlohmann::json;

class ExplainedProgram : public Program {};

TEST_F(ExplainedProgram, ListsTheKeysThatHaveAWord) {
  const Json listed = Json::parse(run({"explain", "--keys", "oad.p", "--json"}).out);
  ASSERT_EQ(listed["keys"].size(), 2u);
  EXPECT_EQ(listed["keys"][0]["key"], "load.peak");
  EXPECT_EQ(listed["keys"][1]["key"], "load.peak_time");
  const std::string told = run({"explain", "--keys", "charge.crack_radius"}).out;
  EXPECT_NE(told.find("default: 30 µm  [P]"), std::string::npos) << told;
  const Outcome key_as_file = run({"explain", "load.peak"});
  EXPECT_EQ(key_as_file.code, 2);
  EXPECT_TRUE(key_as_file.says("launchsafe explain --keys load.peak"));
  const Outcome none = run({"explain", "--keys", "lode"});
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("\"lode\""), std::string::npos) << none.err;
}

TEST_F(ExplainedProgram, SuggestsTheNearestNameOfWhatItLists) {
  EXPECT_TRUE(run({"explain", "--keys", "load.peek"}).says("did you mean load.peak?"));
  EXPECT_TRUE(run({"explain", "--keys", "largest_gab"}).says("did you mean largest_gap?"));
  EXPECT_TRUE(run({"explain", "--results", "temprature_max_K"}).says("did you mean temperature_max_K?"));
}

TEST_F(ExplainedProgram, SaysOfASceneWhatIsNotPlausibleAsOfAStudyOfIt) {
  write("shell.toml", with(tiny_scene, "\"50 MPa\"", "\"500 kPa\""));
  write("study.toml",
        "kind = \"critical-gap\"\nscene = \"shell.toml\"\ngaps = \"0 cm\"\nearly_time = \"0.03 ms\"\n");
  const auto plausibility = [this](const char* file) {
    const std::string text = run({"explain", file}).out;
    const auto begin = text.find("\nPlausibility\n");
    EXPECT_NE(begin, std::string::npos) << text;
    return text.substr(begin, text.find("\nAcceptances\n", begin) - begin);
  };
  const std::string of_scene = plausibility("shell.toml");
  EXPECT_NE(of_scene.find("load.peak = 0.5 MPa is not plausible"), std::string::npos) << of_scene;
  EXPECT_NE(of_scene.find("did you mean \"500 MPa\"?"), std::string::npos) << of_scene;
  EXPECT_EQ(plausibility("study.toml"), of_scene);
}

TEST_F(ExplainedProgram, TellsTheEarliestAndTheLatestTimeOfAnExit) {
  write("shell.toml", with(tiny_scene, "[load]\n",
                           "[load]\nmuzzle_exit = \"0.08 ms\"\nmuzzle_exit_spread = \"0.01 ms\"\n"));
  const Json exit = Json::parse(run({"explain", "shell.toml", "--json"}).out)["load"]["muzzle_exit"];
  EXPECT_DOUBLE_EQ(exit["earliest_s"].get<double>(), 7e-5);
  EXPECT_DOUBLE_EQ(exit["latest_s"].get<double>(), 9e-5);
}

TEST_F(ExplainedProgram, IsAskedForOneThingAtATime) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"explain", "--keys", "--results"}, {"explain", "--keys", "--grid", "a.svg"}})
    EXPECT_EQ(run(arguments).code, 2) << arguments[1];
}

class WrongFile : public Program {};

/// A study in the place of a scene, a scene in that of a study, materials in the place of either.
TEST_F(WrongFile, IsRefusedInOneLine) {
  const std::string studies = LAUNCHSAFE_SOURCE_DIR "/studies/";
  const std::string scene = studies + "scene_155mm.toml", study = studies + "critical_gap_155mm.toml",
                    materials = studies + "materials/comp-b.toml";
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"run", study},
                                                    {"study", scene, "--dry-run"},
                                                    {"run", materials},
                                                    {"study", materials, "--dry-run"},
                                                    {"explain", materials}}) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(outcome.lines_of_error(), 1) << outcome.err;
  }
}

TEST_F(WrongFile, WithoutAKindNamesEveryKeyOnce) {
  write("study.toml", "knd = \"critical-gap\"\n");
  const std::string message = run({"study", "study.toml", "--dry-run"}).err;
  EXPECT_NE(message.find("did you mean kind?"), std::string::npos) << message;
  EXPECT_EQ(message.find("calibration,"), message.rfind("calibration,")) << message;
}

}  // namespace
}  // namespace launchsafe::app
