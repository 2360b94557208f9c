// What `launchsafe explain` says of the grid of a scene, and its picture.
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
  scene::Scene scene_in(const std::string& file) const {
    auto read = scene::read_scene(folder() / file);
    EXPECT_TRUE(read);
    return read->scene;
  }
};

TEST_F(ExplainedGrid, HasTheLinesThatAreComputedOn) {
  const auto grid = grid_of("shell.toml");
  const scene::GridLines lines = scene::grid_lines(scene_in("shell.toml"));
  EXPECT_EQ(grid["x_lines_m"].get<std::vector<double>>(), lines.x);
  EXPECT_EQ(grid["r_lines_m"].get<std::vector<double>>(), lines.r);
}

TEST_F(ExplainedGrid, HasIntervalsAndBodiesThatAddUp) {
  const auto grid = grid_of("shell.toml");
  for (const std::string direction : {"x", "r"}) {
    std::size_t cells = 0;
    for (const auto& interval : grid[direction + "_intervals"]) {
      cells += interval["cells"].get<std::size_t>();
      EXPECT_LE(interval["smallest_cell_m"], interval["largest_cell_m"]);
      EXPECT_FALSE(interval["edge_before_of"].empty());
    }
    EXPECT_EQ(cells + 1, grid[direction + "_lines_m"].size());
  }
  EXPECT_EQ(grid["x_intervals"][1]["edge_behind_of"], (nlohmann::json{"filling", "wall", "base"}));
  std::int64_t particles = 0;
  for (const auto& body : grid["bodies"]) particles += body["particles"].get<std::int64_t>();
  EXPECT_EQ(particles, scene::particle_count(scene_in("shell.toml")));
}

TEST_F(ExplainedGrid, IsTheEvenOneOfTheUpdatedLagrangianForm) {
  write("even.toml",
        with(brief_scene(), "[numerics]\n", "[numerics]\nformulation = \"updated-lagrangian\"\n"));
  const auto lines = grid_of("even.toml")["x_lines_m"].get<std::vector<double>>();
  const scene::Mesh mesh = scene::fit_mesh(scene_in("even.toml"));
  ASSERT_EQ(lines.size(), 26u);
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) EXPECT_NEAR(lines[i + 1] - lines[i], mesh.dx, 1e-12);
  EXPECT_NE(run({"explain", "even.toml"}).out.find("need not run through edges"), std::string::npos);
}

TEST_F(ExplainedGrid, IsATableForPeople) {
  const std::string out = run({"explain", "shell.toml"}).out;
  for (const char* part : {"\nGrid\n  along  from [mm]  to [mm]  cells  smallest [mm]", "cup, filling, wall",
                           "filling, wall, base", "whole grid"})
    EXPECT_NE(out.find(part), std::string::npos) << part << " in\n" << out;
}

TEST_F(ExplainedGrid, IsDrawnWhereAskedFor) {
  const Outcome outcome = run({"explain", "shell.toml", "--grid", "grid.svg", "--json"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(nlohmann::json::parse(outcome.out).contains("grid"));
  EXPECT_TRUE(outcome.says("wrote grid.svg"));
  const std::string svg = read("grid.svg");
  EXPECT_TRUE(svg.starts_with("<?xml"));
  EXPECT_NE(svg.find(">filling (charge)<"), std::string::npos);
  EXPECT_NE(svg.find(">G1<"), std::string::npos);
  EXPECT_EQ(run({"explain", "shell.toml", "--grid", "grid.svg"}).code, 0) << "it is there already";
  EXPECT_EQ(read("grid.svg"), svg);
}

TEST_F(ExplainedGrid, IsNotDrawnWhereItMayNotBe) {
  write("study.toml", "kind = \"critical-gap\"\nscene = \"shell.toml\"\n");
  write("mine.svg", "mine");
  std::filesystem::create_directory(folder() / "folder.svg");
  std::filesystem::create_symlink("elsewhere.svg", folder() / "link.svg");
  const std::string too_long(300, 'a');
  struct Wrong {
    std::vector<std::string> arguments;
    std::string part;  ///< of the message
  };
  for (const Wrong& wrong :
       {Wrong{{"shell.toml", "--grid"}, "--grid"}, Wrong{{"shell.toml", "--grid", ""}, "--grid"},
        Wrong{{"shell.toml", "--grid", "--quiet"}, "--quiet"}, Wrong{{"--grid", "grid.svg"}, "allowed"},
        Wrong{{"--keys", "--grid", "grid.svg"}, "--grid"},
        Wrong{{"study.toml", "--grid", "grid.svg"}, "study.toml"},
        Wrong{{"shell.toml", "--grid", "grid.png"}, "grid.png"},
        Wrong{{"shell.toml", "--grid", "shell.toml/grid.svg"}, "shell.toml is no folder"},
        Wrong{{"shell.toml", "--grid", "mine.svg"}, "mine.svg is there"},
        Wrong{{"shell.toml", "--grid", "folder.svg"}, "folder.svg"},
        Wrong{{"shell.toml", "--grid", "link.svg"}, "link.svg is a link"},
        Wrong{{"shell.toml", "--grid", too_long + ".svg"}, "too long"},
        Wrong{{"shell.toml", "--grid", too_long + "/grid.svg"}, "is no folder"}}) {
    std::vector<std::string> arguments = wrong.arguments;
    arguments.insert(arguments.begin(), "explain");
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2) << wrong.part << outcome.err;
    EXPECT_TRUE(outcome.says(wrong.part)) << wrong.part << " in " << outcome.err;
    EXPECT_EQ(outcome.lines_of_error(), 1) << outcome.err;
    EXPECT_TRUE(outcome.out.empty()) << outcome.out;
  }
  EXPECT_FALSE(exists("grid.svg"));
  EXPECT_FALSE(exists("elsewhere.svg"));
  EXPECT_EQ(read("mine.svg"), "mine");
}

}  // namespace
}  // namespace launchsafe::app
