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
  const Outcome key_as_file = run({"explain", "load.peak"});
  EXPECT_EQ(key_as_file.code, 2);
  const Outcome none = run({"explain", "--keys", "lode"});
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.err.find("\"lode\""), std::string::npos) << none.err;
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

}  // namespace
}  // namespace launchsafe::app
