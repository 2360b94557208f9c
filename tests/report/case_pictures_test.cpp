// What the pictures of a case contain. Cases are small runs, or written by hand where a number is expected.
#include "launchsafe/report/case_pictures.hpp"

#include "launchsafe/run/run_case.hpp"
#include "launchsafe/scene/mesh.hpp"
#include "report/gnuplot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>

namespace launchsafe::report {
namespace {

/// A charge in a wall on a base; a slender one has its bottom enlarged.
scene::Scene cased_charge(double length = 0.02) {
  scene::Scene scene;
  scene.title = "a cased charge";
  scene.bodies = {{"charge", "charge", 0.0, length, 0.0, 0.01},
                  {"wall", "steel", 0.0, length, 0.01, 0.015},
                  {"base", "steel", length, length + 0.01, 0.0, 0.015}};
  scene.load.duration = 4e-5;
  scene.load.peak = 100e6;
  scene.load.peak_time = 4e-5;
  scene.load.shape = scene::LoadShape::power_exponential;
  scene.load.exponent = 2.0;
  scene.numerics.cell_size = 2.5e-3;
  scene.numerics.energy_drift_limit = 0.5;
  scene.output.trace_interval = 2e-6;
  scene.output.snapshot_times = {4e-5, 0.0, 2e-5};
  scene.surface.gaps = {0.0, 1e-4, 4e-4};
  return scene;
}

/// A scene with what it came to.
struct RunScene {
  scene::Scene scene;
  run::CaseResult result;

  explicit RunScene(scene::Scene of) : scene(std::move(of)), result(run::run_case(scene)) {}
  DrawnCase drawn(std::vector<double> times = {}) const { return {scene, result, std::move(times)}; }
};

const PictureKind& kind(const std::string& word) {
  const auto& kinds = picture_kinds();
  return *std::find_if(kinds.begin(), kinds.end(),
                       [&](const PictureKind& each) { return each.word == word; });
}

std::vector<CasePicture> pictures(const DrawnCase& drawn, const std::string& word) {
  EXPECT_EQ(kind(word).lacks(drawn), "");
  return kind(word).pictures(drawn);
}

std::vector<std::string> files(const std::vector<CasePicture>& drawn) {
  std::vector<std::string> names;
  for (const CasePicture& picture : drawn) names.push_back(picture.file);
  return names;
}

const Plot& plot_of(const std::vector<CasePicture>& drawn, const std::string& file) {
  for (const CasePicture& picture : drawn)
    if (picture.file == file) return std::get<Plot>(picture.plot);
  ADD_FAILURE() << "no picture " << file;
  static const Plot none;
  return none;
}

TEST(CasePictures, OfFieldsAreNamedByFieldAndTheTimesThatWereAskedFor) {
  const RunScene run(cased_charge());
  const auto names = files(pictures(run.drawn(), "fields"));
  EXPECT_EQ(names.size(), 3U * 3U);
  for (const char* name :
       {"field_temperature_0ms.svg", "field_pressure_0.02ms.svg", "field_von_mises_0.04ms.svg"})
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  const auto one = files(pictures(run.drawn({2e-5}), "fields"));
  EXPECT_EQ(one, (std::vector<std::string>{"field_temperature_0.02ms.svg", "field_pressure_0.02ms.svg",
                                           "field_von_mises_0.02ms.svg"}))
      << "cracks do not grow";
}

TEST(CasePictures, OfTheTemperatureShowTheSkinOfTheLargestGapThatDoesNotBurn) {
  RunScene run(cased_charge());
  const auto drawn = [&] { return std::get<CellPlot>(pictures(run.drawn({4e-5}), "fields").front().plot); };
  const auto particles = static_cast<std::size_t>(scene::particle_count(run.scene));
  const CellPlot of_largest = drawn();
  ASSERT_EQ(of_largest.scales.size(), 1U) << "one scale for all";
  const auto& skin = run.result.gaps[2].skin;
  const std::size_t rings = of_largest.cells.size() - particles;
  EXPECT_EQ(rings, run.result.mechanics.trace.stations.size());
  const auto hottest =
      std::max_element(skin.temperature.end() - static_cast<std::ptrdiff_t>(rings), skin.temperature.end());
  EXPECT_NEAR(of_largest.scales[0].maximum, *hottest, 1e-6);
  EXPECT_NE(of_largest.title.find("Gap 0.04 cm at 0.04 ms"), std::string::npos) << of_largest.title;
  run.result.gaps[2].skin.ignition = {3e-5, 0, surface::IgnitionCause::trigger, 0.1};
  EXPECT_NE(drawn().title.find("Gap 0.01 cm"), std::string::npos);
  run.result.gaps.clear();
  EXPECT_EQ(files(pictures(run.drawn({4e-5}), "fields")).front(), "field_pressure_0.04ms.svg")
      << "the bulk alone does not warm by 1 %";
}

// 98 of 100 values are within the colours; by hand, one cell of the charge presses as no other.
TEST(CasePictures, OfAFieldMarkWhatIsFarFromAllElse) {
  RunScene run(cased_charge(0.2));
  auto& snapshots = run.result.mechanics.snapshots;
  snapshots.back().pressure[0] = 1e12;
  const auto drawn = pictures(run.drawn({4e-5}), "fields");
  const auto& plot = std::get<CellPlot>(drawn[1].plot);
  EXPECT_LT(plot.scales[0].maximum, 1e4) << "MPa";
  const std::string commands = to_gnuplot(plot);
  EXPECT_GE(block_of(commands, "whole_beyond").size(), 2U) << "on both sides of the axis";
  EXPECT_NE(commands.find("crosses: beyond the colours"), std::string::npos);
}

// The number of particles is that of the scene's grid.
TEST(CasePictures, OfFieldsShowEveryCellOnBothSidesOfTheAxis) {
  const RunScene run(cased_charge());
  const auto particles = static_cast<std::size_t>(scene::particle_count(run.scene));
  ASSERT_EQ(particles, 4U * 8 + 2 * 8 + 6 * 4) << "cells of 2.5 mm";
  for (const CasePicture& picture : pictures(run.drawn(), "fields")) {
    if (picture.file.starts_with("field_temperature")) continue;  // has the skin's cells too
    const std::string commands = to_gnuplot(std::get<CellPlot>(picture.plot));
    std::size_t cells = 0, below_axis = 0;
    for (const char* name : {"whole_cells0", "whole_cells1", "whole_grey"})
      for (const std::string& line : block_of(commands, name)) {
        double x = 0, r = 0;
        std::istringstream(line) >> x >> r;
        ++cells;
        below_axis += r < 0.0 ? 1 : 0;
      }
    EXPECT_EQ(cells, 2 * particles) << picture.file;
    EXPECT_EQ(below_axis, particles) << picture.file;
    EXPECT_EQ(count_of(commands, "boxxyerror"), 2U) << picture.file << ": charge, and shell or grey";
  }
}

TEST(CasePictures, OfFieldsHaveOneOutlineForEveryBodyWhichAtRestIsItsRectangle) {
  const RunScene run(cased_charge());
  const auto plot = std::get<CellPlot>(pictures(run.drawn({0.0}), "fields").front().plot);
  ASSERT_EQ(plot.outlines.size(), run.scene.bodies.size());
  for (std::size_t i = 0; i < plot.outlines.size(); ++i) {
    const scene::Body& body = run.scene.bodies[i];
    const std::vector<Place>& path = plot.outlines[i].path;
    const auto by_x = [](const Place& a, const Place& b) { return a.x < b.x; };
    const auto by_r = [](const Place& a, const Place& b) { return a.r < b.r; };
    const auto [left, right] = std::minmax_element(path.begin(), path.end(), by_x);
    const auto [low, high] = std::minmax_element(path.begin(), path.end(), by_r);
    EXPECT_NEAR(left->x, 1e3 * body.x_begin, 1e-9) << body.name;
    EXPECT_NEAR(right->x, 1e3 * body.x_end, 1e-9) << body.name;
    EXPECT_NEAR(low->r, 1e3 * body.r_begin, 1e-9) << body.name;
    EXPECT_NEAR(high->r, 1e3 * body.r_end, 1e-9) << body.name;
    EXPECT_EQ(plot.outlines[i].open_at_axis, body.r_begin == 0.0) << body.name;
  }
  const std::string commands = to_gnuplot(plot);
  EXPECT_EQ(count_of(commands, "$whole_outline"), 2 * run.scene.bodies.size()) << "data and plot";
  const auto charge = block_of(commands, "whole_outline0"), wall = block_of(commands, "whole_outline1");
  EXPECT_EQ(std::count(charge.begin(), charge.end(), ""), 0) << "one line around both halves";
  EXPECT_EQ(std::count(wall.begin(), wall.end(), ""), 1) << "a line on each side of the axis";
  EXPECT_EQ(charge.front(), charge.back());
}

TEST(CasePictures, OfAFieldHaveTheSameColoursAtAllSnapshots) {
  const RunScene run(cased_charge());
  std::vector<double> values;
  for (const run::Snapshot& shot : run.result.mechanics.snapshots)
    for (std::size_t i = 0; i < shot.x.size(); ++i)
      if (shot.body[i] == 0) values.push_back(1e-6 * shot.pressure[i]);
  ASSERT_EQ(values.size(), 3U * 32);
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  ASSERT_GT(*highest, *lowest);
  std::size_t seen = 0;
  for (const auto& drawn : {run.drawn(), run.drawn({0.0})})
    for (const CasePicture& picture : pictures(drawn, "fields")) {
      if (!picture.file.starts_with("field_pressure_")) continue;
      ++seen;
      const auto& plot = std::get<CellPlot>(picture.plot);
      ASSERT_EQ(plot.scales.size(), 2U);
      EXPECT_EQ(plot.scales[0].label, "charge: pressure [MPa]");
      EXPECT_EQ(plot.scales[1].label, "shell: pressure [MPa]");
      EXPECT_DOUBLE_EQ(plot.scales[0].minimum, *lowest) << "of less than 100 all count";
      EXPECT_DOUBLE_EQ(plot.scales[0].maximum, *highest);
    }
  EXPECT_EQ(seen, 4U);
}

TEST(CasePictures, OfEventsAndOfWhatBurnsSayItAndHaveColoursOfTheirOwn) {
  RunScene run(cased_charge());
  auto& snapshots = run.result.mechanics.snapshots;
  ASSERT_EQ(snapshots.size(), 3U);
  run::Snapshot of_peak = snapshots[1];
  of_peak.time = 3e-5;
  of_peak.events = {scene::Event::peak_pressure, scene::Event::largest_slip};
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
  for (const char* name : {"field_pressure_0.02ms.svg", "field_pressure_peak-pressure_largest-slip.svg",
                           "field_pressure_0.04ms.svg", "field_pressure_0.04cm_0.04ms_ignition.svg",
                           "field_burnt_share_0.04cm_0.04ms_ignition.svg"})
    EXPECT_TRUE(has(name)) << name;
  EXPECT_FALSE(has("field_burnt_share_0.04ms.svg")) << "nothing burns in the launch";
  for (const CasePicture& picture : drawn) {
    const auto& plot = std::get<CellPlot>(picture.plot);
    if (!picture.file.starts_with("field_pressure_")) continue;
    if (!picture.gap) {
      EXPECT_LT(plot.scales[0].maximum, 2000.0) << picture.file;
      continue;
    }
    EXPECT_DOUBLE_EQ(plot.scales[0].maximum, 2000.0);
    EXPECT_EQ(
        plot.title,
        "Pressure at 0.04 ms, ignition, gap of 0.04 cm burning: 1900 to 2000 MPa in 98 % of the charge");
  }
}

double number_after(const std::string& text, const std::string& words) {
  const std::size_t at = text.find(words);
  EXPECT_NE(at, std::string::npos) << words;
  return std::stod(text.substr(at + words.size()));
}

/// Pixels per mm along x and r of the panel whose commands begin at `text`.
std::pair<double, double> scales_of_panel(const std::string& text, double width, double height) {
  const double left = number_after(text, "lmargin at screen "),
               right = number_after(text, "rmargin at screen ");
  const double top = number_after(text, "tmargin at screen "),
               bottom = number_after(text, "bmargin at screen ");
  const auto span = [&](const std::string& words) {
    const double begin = number_after(text, words);
    return number_after(text.substr(text.find(words) + words.size()), ":") - begin;
  };
  return {(right - left) * width / span("xrange ["), (top - bottom) * height / span("yrange [")};
}

TEST(CasePictures, OfFieldsAreToScaleAndEnlargeTheBottomOfASlenderShell) {
  for (const double length : {0.02, 0.2}) {
    const RunScene run(cased_charge(length));
    const auto plot = std::get<CellPlot>(pictures(run.drawn({0.0}), "fields").front().plot);
    EXPECT_EQ(plot.enlargement.has_value(), length > 0.1);
    const std::string commands = to_gnuplot(plot);
    std::smatch size;
    ASSERT_TRUE(std::regex_search(commands, size, std::regex(R"(svg size (\d+),(\d+))")));
    const double width = std::stod(size[1]), height = std::stod(size[2]);
    const auto whole = scales_of_panel(commands, width, height);
    EXPECT_NEAR(whole.first / whole.second, 1.0, 1e-9);
    if (!plot.enlargement) continue;
    EXPECT_LT(plot.enlargement->x_begin, 200.0) << "mm, the bottom";
    EXPECT_GT(plot.enlargement->x_end, 200.0);
    const auto part = scales_of_panel(commands.substr(commands.find("$whole_outline2 using")), width, height);
    EXPECT_NEAR(part.first / part.second, 1.0, 1e-9);
    EXPECT_GT(part.first, 1.5 * whole.first);
  }
}

TEST(CasePictures, HaveUnitsOnAllAxesAndColourBars) {
  const RunScene run(cased_charge());
  for (const PictureKind& each : picture_kinds()) {
    if (!each.lacks(run.drawn()).empty()) continue;
    for (const CasePicture& picture : each.pictures(run.drawn())) {
      if (const auto* plot = std::get_if<Plot>(&picture.plot)) {
        for (const Plot& panel : plot->panels.empty() ? std::vector{*plot} : plot->panels)
          for (const PlotAxis* axis : {&panel.x, &panel.y})
            EXPECT_TRUE(axis->label.ends_with("]")) << picture.file << ": " << axis->label;
        EXPECT_EQ(plot->subtitle, "a cased charge");
        continue;
      }
      const auto& cells = std::get<CellPlot>(picture.plot);
      const std::string commands = to_gnuplot(cells);
      EXPECT_NE(commands.find("\"x [mm]\""), std::string::npos);
      EXPECT_NE(commands.find("\"r [mm]\""), std::string::npos);
      for (const ColourScale& scale : cells.scales) EXPECT_TRUE(scale.label.ends_with("]")) << scale.label;
    }
  }
}

TEST(CasePictures, OfHistoriesAreOneAGapAndTheProfileIsOneForAll) {
  const RunScene run(cased_charge());
  EXPECT_EQ(files(pictures(run.drawn(), "histories")),
            (std::vector<std::string>{"histories_0cm.svg", "histories_0.01cm.svg", "histories_0.04cm.svg"}));
  EXPECT_EQ(files(pictures(run.drawn(), "profile")), std::vector<std::string>{"profile.svg"});
}

/// Stations at 7.5 and 2.5 mm and an observation point; the skins are 300 K, then 320, 310 and 999 K.
RunScene written_by_hand() {
  RunScene run(cased_charge());
  trace::BottomTrace& trace = run.result.mechanics.trace;
  trace.stations = {
      {"S1", 0.02, 0.0075, 1e-4, false}, {"S2", 0.02, 0.0025, 1e-4, false}, {"G", 0, 0, 0, true}};
  trace.time = {0.0, 2e-5, 4e-5};
  trace.chamber_pressure = {101325, 50e6, 100e6};
  trace.bottom_pressure = {101325, 20e6, 10e6};
  run::GapResult gap;
  gap.gap = gap.skin.gap = 4e-4;
  gap.skin.time = trace.time;
  gap.skin.air_temperature = {300, 1000, 900};
  gap.skin.temperature = {300, 300, 300, 320, 310, 999, 330, 316, 999};
  run.result.gaps = {gap};
  return run;
}

TEST(CasePictures, OfProfilesGoFromTheAxisToTheWallWithoutObservationPoints) {
  const RunScene run = written_by_hand();
  const auto drawn = pictures(run.drawn({2e-5, 3e-5}), "profile");
  EXPECT_EQ(files(drawn), (std::vector<std::string>{"profile_0.02ms.svg", "profile_0.03ms.svg"}));
  const Series& first = plot_of(drawn, "profile_0.02ms.svg").series.front();
  EXPECT_EQ(first.label, "0.04 cm");
  EXPECT_EQ(first.x, (std::vector<double>{2.5, 7.5}));
  EXPECT_EQ(first.y, (std::vector<double>{310, 320}));
  EXPECT_NEAR(plot_of(drawn, "profile_0.03ms.svg").series[0].y[0], 313.0, 1e-9) << "half way";
  const auto last = pictures(run.drawn(), "profile");
  EXPECT_EQ(plot_of(last, "profile.svg").series[0].y, (std::vector<double>{316, 330}));
  EXPECT_NE(plot_of(last, "profile.svg").title.find("by up to 14 K"), std::string::npos);
}

TEST(CasePictures, OfTheSkinEndBeforeWhatBurns) {
  RunScene run = written_by_hand();
  run.result.gaps[0].skin.ignition = {3e-5, 0, surface::IgnitionCause::trigger, 0.1};
  const Series profile = plot_of(pictures(run.drawn(), "profile"), "profile.svg").series[0];
  EXPECT_EQ(profile.y, (std::vector<double>{310, 320}));
  EXPECT_EQ(profile.label, "0.04 cm, igniting at 0.03 ms");
  const Plot history = plot_of(pictures(run.drawn(), "histories"), "histories_0.04cm.svg");
  EXPECT_EQ(history.title, "Gap 0.04 cm: S1 ignites at 0.03 ms");
  ASSERT_EQ(history.panels.size(), 2U) << "the skin above the load";
  EXPECT_EQ(history.panels[0].vertical_lines.size(), 1U);
  EXPECT_EQ(history.panels[0].series[0].x.size(), 2U);
  EXPECT_EQ(history.panels[1].series[0].x.size(), 3U);
  EXPECT_EQ(history.panels[0].x.maximum, history.panels[1].x.maximum) << "on one time axis";
}

TEST(CasePictures, OfHistoriesNameAFewStations) {
  RunScene run = written_by_hand();
  auto& stations = run.result.mechanics.trace.stations;
  stations.clear();
  for (int i = 0; i < 13; ++i)
    stations.push_back({"S" + std::to_string(i + 1), 0.02, 0.013 - 0.001 * i, 1e-4, false});
  run::GapResult& gap = run.result.gaps[0];
  gap.skin.temperature.assign(3 * stations.size(), 300.0);
  gap.at_stations.station = 3;
  const auto drawn = pictures(run.drawn(), "histories");
  std::vector<std::string> names;
  for (const Series& series : plot_of(drawn, "histories_0.04cm.svg").panels.at(0).series)
    if (!series.label.empty()) names.push_back(series.label.substr(0, series.label.find(',')));
  EXPECT_EQ(names, (std::vector<std::string>{"stations between", "S13", "S7", "S4", "S1"}));
  EXPECT_EQ(plot_of(drawn, "histories_0.04cm.svg").panels[0].series.size(), 13U);
}

TEST(CasePictures, OfTheAirHaveALineForGapsThatDiffer) {
  const RunScene reservoir(cased_charge());
  const Plot same = plot_of(pictures(reservoir.drawn(), "air"), "air.svg");
  ASSERT_EQ(same.series.size(), 1U) << "the reservoir's state follows from the pressure alone";
  EXPECT_EQ(same.series[0].label, "every gap");
  EXPECT_TRUE(same.title.ends_with(", whatever the gap")) << same.title;
  RunScene run = written_by_hand();
  run.result.gaps.push_back(run.result.gaps[0]);
  run.result.gaps[1].gap = 1e-4;
  run.result.gaps[1].skin.air_temperature = {300, 500, 450};
  const Plot air = plot_of(pictures(run.drawn(), "air"), "air.svg");
  ASSERT_EQ(air.series.size(), 2U);
  EXPECT_EQ(air.series[1].label, "0.01 cm");
  EXPECT_EQ(air.title, "The gap's air reaches 1000 K");
}

TEST(CasePictures, OfEnergiesHaveTheTermsThatAreMoreThanRoundOff) {
  const RunScene run(cased_charge());
  const Plot energy = plot_of(pictures(run.drawn(), "energy"), "energy.svg");
  std::vector<std::string> names;
  for (const Series& series : energy.series) names.push_back(series.label);
  EXPECT_NE(std::find(names.begin(), names.end(), "internal"), names.end());
  EXPECT_EQ(std::find(names.begin(), names.end(), "taken out by contact"), names.end()) << "all is bonded";
  EXPECT_EQ(energy.series[0].y.back(), std::abs(run.result.mechanics.monitor.back().energy.external));
}

TEST(CasePictures, OfTheAirOfGapsThatCloseAreAgainstTime) {
  RunScene run = written_by_hand();
  run.scene.surface.model = scene::GapModel::closing;
  EXPECT_NE(kind("air").lacks(run.drawn()).find("none of its gaps closed"), std::string::npos);
  run::GapResult& gap = run.result.gaps[0];
  run::ClosingHistory& closing = gap.closing.emplace();
  closing.time = gap.skin.time;
  closing.opening = {1e-4, 5e-5, 1e-5};
  closing.gas_pressure = {1e5, 2e5, 1e7};
  closing.contact_time = closing.time[2];
  const std::vector<CasePicture> drawn = pictures(run.drawn(), "air");
  ASSERT_EQ(drawn.size(), 1U);
  const std::vector<Plot> panels = plot_of(drawn, "air_0.04cm.svg").panels;
  ASSERT_EQ(panels.size(), 3U);
  EXPECT_NEAR(panels[0].series[0].y[1], 50.0, 1e-9);
  EXPECT_NEAR(panels[1].series[0].y[2], 10.0, 1e-9);
  EXPECT_EQ(panels[2].series[0].y, gap.skin.air_temperature);
  EXPECT_EQ(panels[0].vertical_lines.back().at, panels[0].series[0].x[2]);
}

TEST(CasePictures, OfCombustionAreForGapsThatBurnt) {
  RunScene run = written_by_hand();
  EXPECT_NE(kind("combustion").lacks(run.drawn()), "");
  run::CombustionHistory burning;
  burning.time = {3e-5, 4e-5};
  burning.burnt_mass = {0.001, 0.002};
  burning.pressure = {20e6, 30e6};
  burning.reaction_degree = {0.5, 0.25, 0, 1, 0.75, 0};
  run.result.gaps[0].combustion = burning;
  const auto drawn = pictures(run.drawn(), "combustion");
  EXPECT_EQ(files(drawn),
            (std::vector<std::string>{"combustion_mass_0.04cm.svg", "combustion_pressure_0.04cm.svg",
                                      "combustion_reaction_0.04cm.svg"}));
  EXPECT_EQ(plot_of(drawn, "combustion_mass_0.04cm.svg").series[0].y, (std::vector<double>{1, 2})) << "g";
  EXPECT_EQ(plot_of(drawn, "combustion_pressure_0.04cm.svg").series[0].y, (std::vector<double>{20, 30}))
      << "MPa";
  EXPECT_EQ(plot_of(drawn, "combustion_reaction_0.04cm.svg").series[0].y, (std::vector<double>{0.25, 0.75}))
      << "nearest to the axis";
}

TEST(CasePictures, SayWhatACaseLacks) {
  RunScene run(cased_charge());
  for (run::Snapshot& shot : run.result.mechanics.snapshots) shot.half_length_r.clear();
  EXPECT_NE(kind("fields").lacks(run.drawn()).find("older program"), std::string::npos);
  run.result.mechanics.snapshots.clear();
  EXPECT_NE(kind("fields").lacks(run.drawn()).find("output.snapshots"), std::string::npos);
  run.result.gaps.clear();
  for (const char* word : {"histories", "profile", "air"})
    EXPECT_NE(kind(word).lacks(run.drawn()), "") << word;
  EXPECT_EQ(kind("pressure").lacks(run.drawn()), "");
}

TEST(CasePictures, OfFieldsAreRefusedWhereTheGridIsAnother) {
  RunScene run(cased_charge());
  run.scene.numerics.cell_size = 5e-3;
  EXPECT_NE(kind("fields").lacks(run.drawn()).find("grid"), std::string::npos);
}

TEST(CasePictures, AreDrawnWithAFilledShapeForEveryCell) {
  if (!gnuplot_is_there()) GTEST_SKIP() << "gnuplot is not installed";
  const RunScene run(cased_charge());
  const CasePicture picture = pictures(run.drawn({4e-5}), "fields").front();
  const auto svg = to_svg(picture);
  ASSERT_TRUE(svg) << svg.error().message;
  // Colour bars are made of such shapes too, always as many: without the base its 24 cells are missing twice.
  CellPlot without_base = std::get<CellPlot>(picture.plot);
  std::erase_if(without_base.cells, [](const FieldCell& cell) { return cell.x > 20.0; });
  const auto less = to_svg(without_base);
  ASSERT_TRUE(less) << less.error().message;
  EXPECT_EQ(count_of(*svg, "<polygon"), count_of(*less, "<polygon") + 2 * 24);
  EXPECT_NE(svg->find("temperature [K]"), std::string::npos);
  EXPECT_NE(svg->find("Gap 0.04 cm at 0.04"), std::string::npos);
}

TEST(CaseTables, HoldTheNumbersOfSnapshotsAndOfEveryGapsSkin) {
  const RunScene run(cased_charge());
  const DrawnCase drawn = run.drawn({2e-5});
  const auto fields = kind("fields").tables(drawn);
  ASSERT_EQ(fields.size(), 1U) << "of the time that is asked for";
  EXPECT_EQ(fields[0].file, "field_0.02ms.csv");
  const run::Snapshot& shot = run.result.mechanics.snapshots[1];
  const Table& particles = fields[0].table;
  ASSERT_EQ(particles.rows.size(), shot.x.size());
  const std::vector<std::string> keys = keys_of(particles);
  const auto cell = [&](std::size_t row, const char* key) {
    return particles.rows[row].at(
        static_cast<std::size_t>(std::find(keys.begin(), keys.end(), key) - keys.begin()));
  };
  EXPECT_EQ(cell(0, "body"), Cell("charge"));
  EXPECT_EQ(cell(particles.rows.size() - 1, "body"), Cell("base"));
  EXPECT_EQ(cell(3, "r_mm"), Cell(1e3 * shot.r[3]));
  EXPECT_EQ(cell(3, "half_length_x_mm"), Cell(1e3 * shot.half_length_x[3]));
  EXPECT_EQ(cell(3, "pressure_MPa"), Cell(1e-6 * shot.pressure[3]));
  EXPECT_EQ(cell(3, "deviator_rx_MPa"), Cell(1e-6 * shot.deviator_rx[3]));
  EXPECT_EQ(cell(3, "burnt_share"), Cell()) << "nothing burns";
  const auto skins = kind("histories").tables(drawn);
  ASSERT_EQ(skins.size(), 3U);
  EXPECT_EQ(skins[2].file, "histories_0.04cm.csv");
  const surface::SkinHistory& skin = run.result.gaps[2].skin;
  ASSERT_EQ(skins[2].table.rows.size(), skin.time.size());
  EXPECT_EQ(skins[2].table.rows.back()[0], Cell(1e3 * skin.time.back()));
  EXPECT_EQ(skins[2].table.rows.back().back(), Cell(skin.temperature.back()));
  EXPECT_EQ(keys_of(skins[2].table)[1], run.result.mechanics.trace.stations[0].name + "_K");
}

}  // namespace
}  // namespace launchsafe::report
