#include "launchsafe/report/case_tables.hpp"
#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/read_scene.hpp"
#include "report/gnuplot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <regex>

namespace launchsafe::report {
namespace {

scene::Scene scene_of(const char* file) {
  auto read = scene::read_scene(std::string(LAUNCHSAFE_SOURCE_DIR "/studies/") + file);
  EXPECT_TRUE(read);
  return read->scene;
}

/// A shell so stout that it is drawn once.
scene::Scene stout_scene() { return scene_of("stability/small_shell.toml"); }

struct Rectangle {
  double x, y, width, height;
};

std::vector<Rectangle> bodies_in(const std::string& svg) {
  const std::regex pattern(
      R"re(<rect x="([-\d.]+)" y="([-\d.]+)" width="([-\d.]+)" height="([-\d.]+)" class="body")re");
  std::vector<Rectangle> bodies;
  for (auto match = std::sregex_iterator(svg.begin(), svg.end(), pattern); match != std::sregex_iterator();
       ++match)
    bodies.push_back(
        {std::stod((*match)[1]), std::stod((*match)[2]), std::stod((*match)[3]), std::stod((*match)[4])});
  return bodies;
}

/// A name as it stands beside its point.
struct Name {
  double x, y;
};

std::vector<Name> names_in(const std::string& svg) {
  const std::regex pattern(R"re(<text x="([-\d.]+)" y="([-\d.]+)" font-size="12" text-anchor="start")re");
  std::vector<Name> names;
  for (auto match = std::sregex_iterator(svg.begin(), svg.end(), pattern); match != std::sregex_iterator();
       ++match)
    names.push_back({std::stod((*match)[1]), std::stod((*match)[2])});
  return names;
}

TEST(SectionDrawing, HasOneLineForEveryLineOfTheGrid) {
  scene::Scene scene = stout_scene();
  for (const auto formulation :
       {scene::Formulation::total_lagrangian, scene::Formulation::updated_lagrangian}) {
    scene.numerics.formulation = formulation;
    const scene::GridLines lines = scene::lines_at_rest(scene);
    const std::string svg = section_svg(scene);
    EXPECT_EQ(count_of(svg, "class=\"x\""), lines.x.size());
    EXPECT_EQ(count_of(svg, "class=\"r\""), lines.r.size());
  }
}

TEST(SectionDrawing, IsToScale) {
  const scene::Scene scene = stout_scene();
  const std::vector<Rectangle> bodies = bodies_in(section_svg(scene));
  ASSERT_EQ(bodies.size(), scene.bodies.size());
  const double scale = bodies[0].width / (scene.bodies[0].x_end - scene.bodies[0].x_begin);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const scene::Body& body = scene.bodies[i];
    EXPECT_NEAR(bodies[i].width, scale * (body.x_end - body.x_begin), 0.02) << body.name;
    EXPECT_NEAR(bodies[i].height, scale * (body.r_end - body.r_begin), 0.02) << body.name;
    EXPECT_NEAR(bodies[i].x - bodies[0].x, scale * (body.x_begin - scene.bodies[0].x_begin), 0.02)
        << body.name;
    EXPECT_NEAR(bodies[0].y - bodies[i].y, scale * (body.r_end - scene.bodies[0].r_end), 0.02) << body.name;
  }
}

TEST(SectionDrawing, NamesBodiesPointsAxesAndTheAxisOfSymmetry) {
  scene::Scene scene = stout_scene();
  const std::string svg = section_svg(scene);
  for (const char* part :
       {">a small shell<", ">nose (steel)<", ">charge<", ">wall (steel)<", ">base (steel)<", ">S1<", ">G1<",
        ">G2<", ">G3<", ">gap, not to scale<", ">chamber pressure<", ">x [mm]<", ">r [mm]<",
        ">axis of symmetry<", ">40<", ">20<"})
    EXPECT_EQ(count_of(svg, part) > 0, true) << part;
  EXPECT_EQ(count_of(svg, "class=\"symmetry\""), 1u);
  scene.symmetry = scene::Symmetry::plane_strain;
  EXPECT_EQ(count_of(section_svg(scene), ">plane of symmetry<"), 1u);
}

TEST(SectionDrawing, EnlargesTheBottomOfASlenderShell) {
  const scene::Scene scene = scene_of("scene_155mm.toml");
  const std::string svg = section_svg(scene);
  EXPECT_EQ(count_of(svg, "enlarged 4.4 times"), 1u);
  EXPECT_EQ(count_of(svg, "class=\"window\""), 1u);
  const std::vector<Rectangle> bodies = bodies_in(svg);
  ASSERT_EQ(bodies.size(), 2 * scene.bodies.size());
  EXPECT_GT(bodies[5].height, 2 * bodies[1].height);
  // Every point once with its name, and once as a dot in the whole; one more dot in the legend.
  const std::size_t points = scene.output.observation_points.size();
  ASSERT_EQ(points, scene::stations_of(scene).size());
  EXPECT_EQ(count_of(svg, ">S13, G13<"), 1u) << "one place under both names";
  EXPECT_EQ(names_in(svg).size(), points);
  EXPECT_EQ(count_of(svg, "<circle"), 2 * points + 1);
  EXPECT_EQ(count_of(section_svg(stout_scene()), "class=\"window\""), 0u);
}

TEST(SectionDrawing, NamesOfPointsThatLieCloseDoNotOverlap) {
  scene::Scene scene = stout_scene();
  scene.output.observation_points.clear();
  for (int i = 0; i < 12; ++i)
    scene.output.observation_points.push_back({"P" + std::to_string(i), 0.039 - 1e-5 * i, 1e-4 * i});
  const std::string svg = section_svg(scene);
  const std::vector<Name> names = names_in(svg);
  ASSERT_EQ(names.size(), 12u + scene::stations_of(scene).size());
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_TRUE(std::abs(names[i].x - names[k].x) > 13.0 || std::abs(names[i].y - names[k].y) > 12.0)
          << i << " and " << k;
  EXPECT_EQ(count_of(svg, "want of room"), 0u);
}

TEST(SectionDrawing, CountsThePointsWhoseNamesHaveNoRoom) {
  scene::Scene scene = stout_scene();
  scene.output.observation_points.assign(200, {"P", 0.039, 0.01});
  const std::string svg = section_svg(scene);
  const std::size_t named = names_in(svg).size();
  const std::size_t all = 200u + scene::stations_of(scene).size();
  EXPECT_LT(named, all);
  EXPECT_EQ(count_of(svg, "want of room: " + std::to_string(all - named) + " points"), 1u);
  EXPECT_EQ(count_of(svg, "<circle"), all + 1) << "all are marked";
}

TEST(SectionDrawing, TextIsNeverMarkup) {
  scene::Scene scene = stout_scene();
  scene.title = "<script>alert(\"1\")</script> & \n more";
  scene.output.observation_points[0].name = "G<1>";
  const std::string svg = section_svg(scene);
  EXPECT_EQ(count_of(svg, "<script"), 0u);
  EXPECT_EQ(count_of(svg, "&#60;script&#62;alert(&#34;1&#34;)&#60;/script&#62; &#38;   more"), 1u);
  EXPECT_EQ(count_of(svg, ">G&#60;1&#62;<"), 1u);
}

TEST(SectionDrawing, TakesShellsOfAnyShape) {
  scene::Scene scene;
  scene.numerics.cell_size = 1e-3;
  for (const auto& [length, radius] : {std::pair{1e-3, 1.0}, std::pair{10.0, 1e-3}, std::pair{0.1, 0.1}}) {
    scene.bodies = {{"bar", "steel", 0.0, length, 0.0, radius}};
    const std::string svg = section_svg(scene);
    EXPECT_EQ(count_of(svg, "nan") + count_of(svg, "inf"), 0u);
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
    const Rectangle bar = bodies_in(svg).front();
    EXPECT_LT(bar.x + bar.width, 1000.0);
    EXPECT_GT(bar.x, 0.0);
  }
}

}  // namespace
}  // namespace launchsafe::report
