#include "launchsafe/scene/plan.hpp"
#include "launchsafe/scene/read_scene.hpp"

#include <gtest/gtest.h>

namespace launchsafe::scene {
namespace {

Scene shell_of_155mm() {
  const auto file = read_scene(LAUNCHSAFE_SOURCE_DIR "/studies/scene_155mm.toml");
  return file.scene;
}

TEST(Stations, OfThePublishedShellHaveThePublishedPointsInTheirMiddles) {
  const Scene scene = shell_of_155mm();
  const auto stations = stations_of(scene);
  ASSERT_EQ(stations.size(), scene.output.observation_points.size());
  for (std::size_t k = 0; k < stations.size(); ++k) {
    EXPECT_NEAR(0.5 * (stations[k].r_begin + stations[k].r_end), scene.output.observation_points[k].r, 1e-12);
    EXPECT_EQ(stations[k].name, "S" + std::to_string(k + 1));
    EXPECT_EQ(stations[k].x_end, 0.678);
    EXPECT_NEAR(stations[k].x_begin, 0.673, 1e-12);
  }
}

TEST(Stations, TileTheBottomWhateverTheirWidth) {
  Scene scene = shell_of_155mm();
  for (const double width : {0.8e-3, 3e-3, 7e-3, 26e-3, 65e-3, 0.2}) {
    scene.surface.station_width = width;
    const auto stations = stations_of(scene);
    ASSERT_FALSE(stations.empty());
    EXPECT_EQ(stations.front().r_end, 0.065);
    EXPECT_EQ(stations.back().r_begin, 0.0);
    for (std::size_t k = 1; k < stations.size(); ++k) EXPECT_EQ(stations[k].r_end, stations[k - 1].r_begin);
    // The nearest whole number of stations: no other is nearer to the width asked for.
    EXPECT_NEAR(static_cast<double>(stations.size()), std::max(1.0, 0.065 / width), 0.5 + 1e-9);
  }
}

TEST(Stations, OfAHollowChargeEndAtItsBore) {
  Scene scene = shell_of_155mm();
  scene.bodies[1].r_begin = 0.02;
  const auto stations = stations_of(scene);
  ASSERT_EQ(stations.size(), 9u);
  EXPECT_EQ(stations.back().r_begin, 0.02);
}

TEST(Stations, CountCellsInTheCornerAndWhereTheyAreLongest) {
  Scene scene = shell_of_155mm();
  scene.numerics.cell_size = 2.5e-3;
  scene.numerics.growth_x = scene.numerics.growth_r = 1.0;
  StationCells cells = cells_in_stations(scene);
  EXPECT_NEAR(cells.corner_x, 2.0, 1e-9);
  EXPECT_NEAR(cells.corner_r, 2.0, 1e-9);
  EXPECT_NEAR(cells.fewest_r, 2.0, 1e-9);
  scene.numerics.growth_r = 1.3;  // cells grow towards the axis, up to the width of a station
  cells = cells_in_stations(scene);
  EXPECT_GE(cells.corner_r, 2.0);
  EXPECT_GE(cells.fewest_r, 1.0);
  EXPECT_LT(cells.fewest_r, 1.2);
}

TEST(Stations, WiderOrDeeperThanTheChargeAreRefusedWhereTheyAreAskedFor) {
  const auto text = [](const std::string& key) {
    return "open_charge = true\nbody = [ { name = \"charge\", material = \"charge\", x = \"0 to 3 mm\", r = "
           "\"0 to 2 mm\" }, "
           "{ name = \"base\", x = \"3 to 6 mm\", r = \"0 to 2 mm\", material = \"steel\" }, "
           "{ name = \"wall\", x = \"0 to 6 mm\", r = \"2 to 3 mm\", material = \"steel\" } ]\n"
           "[load]\nduration = \"1 ms\"\npeak_time = \"0.5 ms\"\n[numerics]\ncell_size = \"1 "
           "mm\"\n[station]\n" +
           key;
  };
  for (const std::string key : {"width = \"2.1 mm\"", "depth = \"3.1 mm\""}) {
    const auto file = caught([&] { return parse_scene(text(key), "small.toml"); });
    ASSERT_FALSE(file) << key;
    EXPECT_NE(file.error().message().find("small.toml:9:"), std::string::npos) << file.error().message();
  }
  const auto usual = parse_scene(text(""), "small.toml");
  EXPECT_EQ(stations_of(usual.scene).size(), 1u);
}

}  // namespace
}  // namespace launchsafe::scene
