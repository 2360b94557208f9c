// What the pictures of a case contain. Cases are small runs, or written by hand where a number is expected.
#include "drawn_cases.hpp"

namespace launchsafe::report {
namespace {

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
  EXPECT_EQ(first.label, "gap 0.04 cm");
  EXPECT_EQ(first.x, (std::vector<double>{2.5, 7.5}));
  EXPECT_EQ(first.y, (std::vector<double>{310, 320}));
  EXPECT_NEAR(plot_of(drawn, "profile_0.03ms.svg").series[0].y[0], 313.0, 1e-9) << "half way";
  const auto last = pictures(run.drawn(), "profile");
  EXPECT_EQ(plot_of(last, "profile.svg").series[0].y, (std::vector<double>{316, 330}));
  EXPECT_NE(plot_of(last, "profile.svg").title.find("differs by 14 K"), std::string::npos);
}

TEST(CasePictures, HaveWhatWasPublishedAsHollowPointsWhereItWas) {
  const RunScene run = written_by_hand();
  DrawnCase drawn = run.drawn({2e-5, 3e-5});
  const auto published_in = [](const Plot& plot, const std::string& label = "published") {
    const auto found =
        std::ranges::find_if(plot.series, [&](const Series& each) { return each.label.starts_with(label); });
    return found == plot.series.end() ? Series{} : *found;
  };
  const auto history = [&](const std::string& label = "published") {
    return published_in(plot_of(pictures(drawn, "histories"), "histories_0.04cm.svg").panels.at(0), label);
  };
  EXPECT_TRUE(history().x.empty()) << "nothing is known";
  drawn.early_time = 2e-5;
  drawn.published = {
      {.gap = 4e-4, .maximum_temperature = 335, .point = "S1", .early_temperature = 318, .early_point = "S2"},
      {.gap = 1e-4, .maximum_temperature = 310, .point = "S1"}};
  EXPECT_EQ(history().mark, Mark::open_square);
  EXPECT_EQ(history().label, "published at S2: S2 + 8.0 K") << "310 K are computed there";
  EXPECT_EQ(history().x, std::vector<double>{0.02}) << "ms";
  EXPECT_EQ(history().y, std::vector<double>{318});
  EXPECT_EQ(history("published at S1: S1 + 5.0 K").y, std::vector<double>{335});
  EXPECT_EQ(history("published at S1").mark, Mark::open_circle) << "another place, another mark";
  const auto profiles = pictures(drawn, "profile");
  EXPECT_EQ(published_in(plot_of(profiles, "profile_0.02ms.svg")).x, std::vector<double>{2.5});
  EXPECT_EQ(published_in(plot_of(profiles, "profile_0.02ms.svg")).y, std::vector<double>{318});
  EXPECT_EQ(published_in(plot_of(profiles, "profile_0.02ms.svg")).lower, std::vector<double>{310})
      << "the bar begins on the curve";
  EXPECT_EQ(plot_of(profiles, "profile_0.02ms.svg").title,
            "At 0.02 ms published minus computed temperatures are 8.0 K");
  EXPECT_EQ(plot_of(profiles, "profile_0.02ms.svg").subtitle,
            "a cased charge; hottest: published r 2.5, computed r 7.5 mm");
  EXPECT_TRUE(published_in(plot_of(profiles, "profile_0.03ms.svg")).x.empty()) << "of other times";
  drawn.published[0].ignition_time = 3e-5;
  EXPECT_EQ(history().y, std::vector<double>{318}) << "the burning skin says nothing of the gap";
}

TEST(CasePictures, OfTheSkinEndBeforeWhatBurns) {
  RunScene run = written_by_hand();
  run.result.gaps[0].skin.ignition = {3e-5, 0, surface::IgnitionCause::trigger, 0.1};
  const Series profile = plot_of(pictures(run.drawn(), "profile"), "profile.svg").series[0];
  EXPECT_EQ(profile.y, (std::vector<double>{310, 320}));
  EXPECT_EQ(profile.label, "gap 0.04 cm at ignition");
  const Plot history = plot_of(pictures(run.drawn(), "histories"), "histories_0.04cm.svg");
  EXPECT_EQ(history.title, "Gap 0.04 cm: S1 ignites at 0.03 ms");
  ASSERT_EQ(history.panels.size(), 2U) << "the skin above the load";
  for (const Series& pressure : history.panels[1].series)
    for (const Series& station : history.panels[0].series)
      EXPECT_NE(pressure.colour, station.colour) << "no colour means two things";
  EXPECT_TRUE(history.panels[0].vertical_lines.empty()) << "the title says when, and the curves end there";
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
  EXPECT_EQ(air.series[1].label, "gap 0.01 cm");
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
  EXPECT_EQ(plot_of(drawn, "combustion_pressure_0.04cm.svg").y.label,
            "mean pressure of the charge's bottom [MPa]");
  EXPECT_EQ(plot_of(drawn, "combustion_reaction_0.04cm.svg").series[0].y, (std::vector<double>{0.25, 0.75}))
      << "nearest to the axis";
  EXPECT_EQ(plot_of(drawn, "combustion_reaction_0.04cm.svg").title,
            "Gap 0.04 cm: the skin of 1 of 2 stations has burnt 0.01 ms after ignition");
  run.result.gaps[0].skin.ignition = {3e-5, 0, surface::IgnitionCause::trigger, 0.1};
  const Plot reaction = plot_of(pictures(run.drawn(), "combustion"), "combustion_reaction_0.04cm.svg");
  ASSERT_EQ(reaction.vertical_lines.size(), 1U);
  EXPECT_EQ(reaction.vertical_lines[0].label, "ignition at S1, 0.03 ms");
}

TEST(CasePictures, SayWhatACaseLacks) {
  RunScene run(cased_charge());
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
  CellPlot plot = std::get<CellPlot>(pictures(run.drawn({4e-5}), "fields").at(1).plot);
  for (ColourScale& scale : plot.scales) scale.minimum = -1e9, scale.maximum = 1e9;  // nothing is beyond
  const auto svg = to_svg(plot);
  ASSERT_TRUE(svg) << svg.error().message;
  // Colour bars are made of such shapes too, always as many: without the base its 24 cells are missing twice.
  std::erase_if(plot.cells, [](const FieldCell& cell) { return cell.x > 20.0; });
  const auto less = to_svg(plot);
  ASSERT_TRUE(less) << less.error().message;
  EXPECT_EQ(count_of(*svg, "<polygon"), count_of(*less, "<polygon") + 2 * 24);
  EXPECT_NE(svg->find("charge: pressure [MPa]"), std::string::npos);
  EXPECT_NE(svg->find("Pressure at 0.04 ms"), std::string::npos);
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
