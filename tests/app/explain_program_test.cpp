// What launchsafe explains of itself: keys and schemas.
#include "launchsafe/scene/read_scene.hpp"
#include "program.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <set>

namespace launchsafe::app {
namespace {

using Json = nlohmann::json;

class ExplainedProgram : public Program {};

/// Every key below a schema: what has a type or alternatives, and is no table.
void for_each_key(const Json& schema, const std::string& name,
                  const std::function<void(const std::string&, const Json&)>& visit) {
  if (schema.contains("example")) return visit(name, schema);
  if (schema.contains("items")) return for_each_key(schema["items"], name, visit);
  if (schema.contains("additionalProperties") && schema["additionalProperties"].is_object())
    return for_each_key(schema["additionalProperties"], name + ".NAME", visit);
  if (schema.contains("anyOf") && !schema.contains("properties"))
    for (const Json& each : schema["anyOf"]) for_each_key(each, name, visit);
  if (!schema.contains("properties")) return;
  for (const auto& [key, value] : schema["properties"].items())
    for_each_key(value, name.empty() ? key : name + "." + key, visit);
}

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

TEST_F(ExplainedProgram, SaysThatNoVerdictIsSafeWhereNobodyAcceptsAValue) {
  write("shell.toml", with(tiny_scene, "\"0.5\"\nbecause", "\"0.6\"\nbecause"));
  const std::string told = run({"explain", "shell.toml"}).out;
  EXPECT_NE(told.find("No verdict that rests on these can be SAFE as it stands"), std::string::npos) << told;
  EXPECT_NE(told.find("\naccept = [\n  { key = \"numerics.energy_drift_limit\", value = \"0.5\""),
            std::string::npos)
      << told;
}

TEST_F(ExplainedProgram, HasEveryKeyOfAReaderInItsSchemaWithUnitRangeAndExample) {
  const Json schema = Json::parse(run({"explain", "--schema", "scene"}).out);
  EXPECT_EQ(schema["$schema"], "http://json-schema.org/draft-04/schema#");
  std::set<std::string> found;
  for_each_key(schema, "", [&](const std::string& name, const Json& key) {
    found.insert(name);
    for (const char* part : {"description", "unit", "range", "example"})
      EXPECT_FALSE(key[part].get<std::string>().empty()) << name << ": " << part;
    EXPECT_NE(key["example"], "\"\"") << name;
  });
  for (const scene::DocumentedKey& key : scene::describe_keys())
    EXPECT_TRUE(found.contains(key.description.name)) << key.description.name;
  for (const char* number :
       {"material.NAME.density", "material.NAME.kinetics.frequency", "material.NAME.yield_stress"})
    EXPECT_TRUE(found.contains(number)) << number;
  const Json& faces = schema["properties"]["interface"]["additionalProperties"];
  EXPECT_EQ(faces["anyOf"], Json::parse(R"([{"required": ["condition"]}, {"required": ["contact"]}])"));
  EXPECT_TRUE(faces["properties"].contains("friction"));
}

TEST_F(ExplainedProgram, TellsTheEarliestAndTheLatestTimeOfAnExit) {
  write("shell.toml", with(tiny_scene, "[load]\n",
                           "[load]\nmuzzle_exit = \"0.08 ms\"\nmuzzle_exit_spread = \"0.01 ms\"\n"));
  const Json exit = Json::parse(run({"explain", "shell.toml", "--json"}).out)["load"]["muzzle_exit"];
  EXPECT_DOUBLE_EQ(exit["earliest_s"].get<double>(), 7e-5);
  EXPECT_DOUBLE_EQ(exit["latest_s"].get<double>(), 9e-5);
}

TEST_F(ExplainedProgram, TellsAllStudiesInOneSchema) {
  const Json schema = Json::parse(run({"explain", "--schema", "study"}).out);
  EXPECT_EQ(schema["required"], Json({"kind", "scene"}));
  EXPECT_FALSE(schema["additionalProperties"]);
  for (const char* table : {"set", "vary", "variant", "group", "settings", "reference"})
    EXPECT_TRUE(schema["properties"].contains(table)) << table;
  for_each_key(schema, "", [&](const std::string& name, const Json& key) {
    for (const char* part : {"description", "unit", "range", "example"})
      EXPECT_FALSE(key[part].get<std::string>().empty()) << name << ": " << part;
  });
}

TEST_F(ExplainedProgram, IsAskedForOneThingAtATime) {
  for (const std::vector<std::string>& arguments :
       std::vector<std::vector<std::string>>{{"explain", "--schema", "scene", "--keys"},
                                             {"explain", "--schema", "recipe"},
                                             {"explain", "--schema", "scene", "shell.toml"},
                                             {"explain", "--schema", "scene", "--grid", "a.svg"}})
    EXPECT_EQ(run(arguments).code, 2) << arguments[1];
}

class WrongFile : public Program {};

/// A study in the place of a scene, a scene in that of a study, materials in the place of either.
TEST_F(WrongFile, IsToldByWhatItHolds) {
  const std::string studies = LAUNCHSAFE_SOURCE_DIR "/studies/";
  const std::string scene = studies + "scene_155mm.toml", study = studies + "critical_gap_155mm.toml",
                    materials = studies + "materials/comp-b.toml";
  const auto expect = [&](const std::vector<std::string>& arguments, const std::string& said) {
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_TRUE(outcome.says(said)) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  expect({"run", study}, "found a study, which launchsafe study computes; allowed: a scene");
  expect({"study", scene, "--dry-run"}, "found a scene, which launchsafe run computes; allowed: a study");
  expect({"run", materials}, "found materials");
  expect({"study", materials, "--dry-run"}, "found materials");
  expect({"explain", materials}, "found materials");
}

TEST_F(WrongFile, WithoutAKindNamesEveryKeyOnce) {
  write("study.toml", "knd = \"critical-gap\"\n");
  const std::string message = run({"study", "study.toml", "--dry-run"}).err;
  EXPECT_NE(message.find("did you mean kind?"), std::string::npos) << message;
  EXPECT_EQ(message.find("calibration,"), message.rfind("calibration,")) << message;
}

}  // namespace
}  // namespace launchsafe::app
