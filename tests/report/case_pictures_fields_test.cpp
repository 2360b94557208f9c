// Pictures of fields over the section of a case.
#include "drawn_cases.hpp"

namespace launchsafe::report {
namespace {

TEST(CasePictures, OfFieldsAreNamedByFieldAndTheTimesThatWereAskedFor) {
  const RunScene run(cased_charge());
  const auto names = files(pictures(run.drawn(), "fields"));
  EXPECT_EQ(names, (std::vector<std::string>{"field_temperature_0ms.svg", "field_temperature_0.02ms.svg",
                                             "field_temperature_0.04ms.svg", "field_pressure_0.02ms.svg",
                                             "field_pressure_0.04ms.svg", "field_von_mises_0.02ms.svg",
                                             "field_von_mises_0.04ms.svg"}))
      << "nothing presses at first";
  const auto one = files(pictures(run.drawn({2e-5}), "fields"));
  EXPECT_EQ(one, (std::vector<std::string>{"field_temperature_0.02ms.svg", "field_pressure_0.02ms.svg",
                                           "field_von_mises_0.02ms.svg"}))
      << "cracks do not grow";
}

TEST(CasePictures, OfTheTemperatureShowTheSkinOfTheLargestGapThatDoesNotBurn) {
  RunScene run(cased_charge());
  const auto drawn = [&] {
    return std::get<CellPlot>(pictures(run.drawn({4e-5}), "fields").front().drawing);
  };
  const auto particles = static_cast<std::size_t>(scene::particle_count(run.scene));
  const CellPlot of_largest = drawn();
  ASSERT_EQ(of_largest.scales.size(), 1U) << "one scale for all";
  const auto& skin = run.result.gaps[2].skin;
  const std::size_t rings = of_largest.cells.size() - particles;
  EXPECT_EQ(rings, run.result.mechanics.trace.stations.size());
  const auto hottest =
      std::max_element(skin.temperature.end() - static_cast<std::ptrdiff_t>(rings), skin.temperature.end());
  EXPECT_NEAR(of_largest.scales[0].maximum, *hottest, 1e-6);
  const auto coldest =
      std::min_element(skin.temperature.end() - static_cast<std::ptrdiff_t>(rings), skin.temperature.end());
  EXPECT_NEAR(of_largest.scales[0].minimum, *coldest, 1e-6) << "the bulk, which is colder, is grey";
  EXPECT_TRUE(std::isnan(of_largest.cells.front().value));
  EXPECT_NEAR(2.0 * of_largest.cells.back().half_x, 1e3 * run.scene.surface.skin_thickness, 1e-9);
  EXPECT_TRUE(of_largest.window) << "all else is grey";
  EXPECT_NE(of_largest.title.find("0.04 cm"), std::string::npos) << of_largest.title;
  run.result.gaps[2].skin.ignition = {3e-5, 0, surface::IgnitionCause::trigger, 0.1};
  EXPECT_NE(drawn().title.find("0.01 cm"), std::string::npos);
  run.result.gaps.clear();
  EXPECT_EQ(files(pictures(run.drawn({4e-5}), "fields")).front(), "field_pressure_0.04ms.svg")
      << "the bulk alone does not warm by 1 %";
}

// Most of the section is within the colours; by hand, one cell of the charge presses as no other.
TEST(CasePictures, OfAFieldMarkWhatIsFarFromAllElse) {
  RunScene run(cased_charge(0.2));
  auto& snapshots = run.result.mechanics.snapshots;
  snapshots.back().pressure[0] = 1e12;
  const auto drawn = pictures(run.drawn({4e-5}), "fields");
  const auto& plot = std::get<CellPlot>(drawn[1].drawing);
  EXPECT_LT(plot.scales[0].maximum, 1e4) << "MPa";
  const std::string commands = to_gnuplot(plot);
  EXPECT_GE(block_of(commands, "above").size(), 2U) << "on both sides of the axis";
}

// The number of particles is that of the scene's grid.
TEST(CasePictures, OfFieldsShowEveryCellOnBothSidesOfTheAxis) {
  const RunScene run(cased_charge());
  const auto particles = static_cast<std::size_t>(scene::particle_count(run.scene));
  ASSERT_EQ(particles, 4U * 8 + 2 * 8 + 6 * 4) << "cells of 2.5 mm";
  for (const Picture& picture : pictures(run.drawn(), "fields")) {
    if (picture.file.starts_with("field_temperature")) continue;  // has the skin's cells too
    const std::string commands = to_gnuplot(std::get<CellPlot>(picture.drawing));
    std::size_t cells = 0, below_axis = 0;
    for (const char* name : {"cells0", "cells1", "grey"})
      for (const std::string& line : block_of(commands, name)) {
        double x = 0, r = 0;
        std::istringstream(line) >> x >> r;
        ++cells;
        below_axis += r < 0.0 ? 1 : 0;
      }
    EXPECT_EQ(cells, 2 * particles) << picture.file;
    EXPECT_EQ(below_axis, particles) << picture.file;
  }
}

// By hand, all presses a thousand times as hard at 0.02 ms: late in a launch stresses are released.
TEST(CasePictures, OfAFieldHaveTheColoursOfTheirOwnInstant) {
  RunScene run(cased_charge());
  for (double& pressure : run.result.mechanics.snapshots[1].pressure) pressure *= 1e3;
  std::vector<double> values;
  const run::Snapshot& last = run.result.mechanics.snapshots.back();
  for (std::size_t i = 0; i < last.x.size(); ++i)
    if (last.body[i] == 0) values.push_back(1e-6 * last.pressure[i]);
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  ASSERT_GT(*highest, *lowest);
  for (const auto& drawn : {run.drawn(), run.drawn({4e-5})})
    for (const Picture& picture : pictures(drawn, "fields")) {
      if (picture.file != "field_pressure_0.04ms.svg") continue;
      const auto& plot = std::get<CellPlot>(picture.drawing);
      ASSERT_EQ(plot.scales.size(), 2U);
      EXPECT_EQ(plot.scales[0].label, "charge: pressure [MPa]");
      EXPECT_EQ(plot.scales[1].label, "shell: pressure [MPa]");
      EXPECT_DOUBLE_EQ(plot.scales[0].minimum, *lowest) << "of less than 100 all count";
      EXPECT_DOUBLE_EQ(plot.scales[0].maximum, *highest);
    }
}

TEST(CasePictures, OfEventsAndOfWhatBurnsSayItInColoursOfTheirOwn) {
  RunScene run(cased_charge());
  auto& snapshots = run.result.mechanics.snapshots;
  ASSERT_EQ(snapshots.size(), 3U);
  run::Snapshot of_peak = snapshots[1];
  of_peak.time = 3e-5;
  of_peak.events = {scene::Event::peak_pressure};
  snapshots.insert(snapshots.begin() + 2, of_peak);
  run::Snapshot burning = snapshots[3];
  burning.events = {scene::Event::ignition};
  burning.burnt_share.assign(burning.x.size(), 0.5);
  burning.burnt_share[0] = 0.4;
  for (double& pressure : burning.pressure) pressure = 2e9;
  burning.pressure[0] = 1.9e9;
  run.result.gaps[2].combustion.emplace().snapshots = {burning};
  const auto drawn = pictures(run.drawn(), "fields");
  const auto names = files(drawn);
  const auto has = [&](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const char* name :
       {"field_pressure_0.02ms.svg", "field_pressure_peak-pressure.svg", "field_pressure_0.04ms.svg",
        "field_pressure_0.04cm_0.04ms_ignition.svg", "field_burnt_share_0.04cm_0.04ms_ignition.svg"})
    EXPECT_TRUE(has(name)) << name;
  EXPECT_FALSE(has("field_burnt_share_0.04ms.svg")) << "nothing burns in the launch";
  for (const Picture& picture : drawn) {
    const auto& plot = std::get<CellPlot>(picture.drawing);
    if (!picture.file.starts_with("field_pressure_")) continue;
    EXPECT_EQ(plot.scales[0].maximum == 2000.0, picture.gap.has_value()) << picture.file;
    if (picture.gap) {
      EXPECT_NE(plot.title.find("0.04 cm"), std::string::npos) << plot.title;
    }
  }
}

TEST(CasePictures, OfFieldsAreToScale) {
  const RunScene run(cased_charge(0.2));
  const std::string commands =
      to_gnuplot(std::get<CellPlot>(pictures(run.drawn({4e-5}), "fields").at(1).drawing));
  std::smatch size, at;
  ASSERT_TRUE(std::regex_search(commands, size, std::regex(R"(svg size (\d+),(\d+))")));
  ASSERT_TRUE(std::regex_search(
      commands, at,
      std::regex(R"(lmargin at screen (\S+)\nset rmargin at screen (\S+)\nset tmargin at screen (\S+)\n)"
                 R"(set bmargin at screen (\S+)\nset xrange \[(\S+):(\S+)\]\nset yrange \[(\S+):(\S+)\])")));
  const auto difference = [&](int from, int to) { return std::stod(at[to]) - std::stod(at[from]); };
  const double scale_x = difference(1, 2) * std::stod(size[1]) / difference(5, 6);  // pixels per mm
  const double scale_r = difference(4, 3) * std::stod(size[2]) / difference(7, 8);
  EXPECT_NEAR(scale_x / scale_r, 1.0, 1e-9);
}

}  // namespace
}  // namespace launchsafe::report
