// What launchsafe explains of itself, of files, and of the grid of a scene.
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "program.hpp"

#include <nlohmann/json.hpp>

namespace launchsafe::app {
namespace {

const std::string graded_scene =
    with(brief_scene(), "[numerics]\n", "[numerics]\ngrowth_x = 1.3\nlargest_cell = \"5 mm\"\n");

class ExplainedGrid : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write("shell.toml", graded_scene);
  }

  nlohmann::json grid_of(const std::string& file) {
    return nlohmann::json::parse(run({"explain", file, "--json"}).out)["grid"];
  }
  scene::Scene scene_in(const std::string& file) const { return scene::read_scene(folder() / file).scene; }
};

TEST_F(ExplainedGrid, HasTheLinesThatAreComputedOn) {
  const auto grid = grid_of("shell.toml");
  const scene::GridLines lines = scene::grid_lines(scene_in("shell.toml"));
  EXPECT_EQ(grid["x_lines_m"].get<std::vector<double>>(), lines.x);
  EXPECT_EQ(grid["r_lines_m"].get<std::vector<double>>(), lines.r);
}

TEST_F(ExplainedGrid, IsTheEvenOneOfTheUpdatedLagrangianForm) {
  write("even.toml",
        with(brief_scene(), "[numerics]\n", "[numerics]\nformulation = \"updated-lagrangian\"\n"));
  const auto lines = grid_of("even.toml")["x_lines_m"].get<std::vector<double>>();
  const scene::Mesh mesh = scene::fit_mesh(scene_in("even.toml"));
  ASSERT_EQ(lines.size(), 26u);
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) EXPECT_NEAR(lines[i + 1] - lines[i], mesh.dx, 1e-12);
}

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
