// What `launchsafe explain` says of the grid of a scene.
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

TEST_F(ExplainedGrid, IsTheEvenOneOfTheUpdatedLagrangianForm) {
  write("even.toml",
        with(brief_scene(), "[numerics]\n", "[numerics]\nformulation = \"updated-lagrangian\"\n"));
  const auto lines = grid_of("even.toml")["x_lines_m"].get<std::vector<double>>();
  const scene::Mesh mesh = scene::fit_mesh(scene_in("even.toml"));
  ASSERT_EQ(lines.size(), 26u);
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) EXPECT_NEAR(lines[i + 1] - lines[i], mesh.dx, 1e-12);
}

}  // namespace
}  // namespace launchsafe::app
