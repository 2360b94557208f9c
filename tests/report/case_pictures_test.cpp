// What the pictures of a case contain. Cases are small runs, or written by hand where a number is expected.
#include "drawn_cases.hpp"
#include "facts_in_text.hpp"

namespace launchsafe::report {
namespace {

TEST(CasePictures, HaveUnitsOnAllAxesAndColourBars) {
  const RunScene run(cased_charge());
  for (const PictureKind& each : picture_kinds()) {
    if (!each.lacks(run.drawn()).empty()) continue;
    for (const Picture& picture : each.pictures(run.drawn())) {
      if (const auto* plot = std::get_if<Plot>(&picture.drawing)) {
        for (const Plot& panel : plot->panels.empty() ? std::vector{*plot} : plot->panels)
          for (const PlotAxis* axis : {&panel.x, &panel.y})
            EXPECT_TRUE(axis->label.ends_with("]")) << picture.file << ": " << axis->label;
        EXPECT_EQ(plot->subtitle, "a cased charge");
        continue;
      }
      const auto& cells = std::get<CellPlot>(picture.drawing);
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
  EXPECT_NE(plot_of(last, "profile.svg").title.find("14 K"), std::string::npos);
}

TEST(CasePictures, OfTheSkinEndBeforeWhatBurns) {
  RunScene run = written_by_hand();
  run.result.gaps[0].skin.ignition = {3e-5, 0, surface::IgnitionCause::trigger, 0.1};
  const Series profile = plot_of(pictures(run.drawn(), "profile"), "profile.svg").series[0];
  EXPECT_EQ(profile.y, (std::vector<double>{310, 320}));
  EXPECT_EQ(profile.label, "gap 0.04 cm at ignition");
  const Plot history = plot_of(pictures(run.drawn(), "histories"), "histories_0.04cm.svg");
  EXPECT_TRUE(launchsafe::testing::in_order(history.title, {"0.04 cm", "S1", "0.03 ms"}));
  ASSERT_EQ(history.panels.size(), 2U) << "the skin above the load";
  for (const Series& pressure : history.panels[1].series)
    for (const Series& station : history.panels[0].series)
      EXPECT_NE(pressure.colour, station.colour) << "no colour means two things";
  EXPECT_TRUE(history.panels[0].vertical_lines.empty()) << "the title says when, and the curves end there";
  EXPECT_EQ(history.panels[0].series[0].x.size(), 2U);
  EXPECT_EQ(history.panels[1].series[0].x.size(), 3U);
  EXPECT_EQ(history.panels[0].x.maximum, history.panels[1].x.maximum) << "on one time axis";
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
            (std::vector<std::string>{"combustion_mass_0.04cm.svg", "combustion_pressure_0.04cm.svg"}));
  EXPECT_EQ(plot_of(drawn, "combustion_mass_0.04cm.svg").series[0].y, (std::vector<double>{1, 2})) << "g";
  EXPECT_EQ(plot_of(drawn, "combustion_pressure_0.04cm.svg").series[0].y, (std::vector<double>{20, 30}))
      << "MPa";
  run.result.gaps[0].skin.ignition = {3e-5, 0, surface::IgnitionCause::trigger, 0.1};
  const Plot mass = plot_of(pictures(run.drawn(), "combustion"), "combustion_mass_0.04cm.svg");
  ASSERT_EQ(mass.vertical_lines.size(), 1U);
  EXPECT_TRUE(launchsafe::testing::in_order(mass.vertical_lines[0].label, {"S1", "0.03 ms"}));
}

TEST(CasePictures, SayWhatACaseLacks) {
  RunScene run(cased_charge());
  run.result.mechanics.snapshots.clear();
  EXPECT_NE(kind("fields").lacks(run.drawn()).find("output.snapshots"), std::string::npos);
  run.result.gaps.clear();
  for (const char* word : {"histories", "profile"}) EXPECT_NE(kind(word).lacks(run.drawn()), "") << word;
  EXPECT_EQ(kind("pressure").lacks(run.drawn()), "");
}

TEST(CaseTables, HoldTheNumbersOfEveryGapsSkin) {
  const RunScene run(cased_charge());
  const DrawnCase drawn = run.drawn({2e-5});
  const auto skins = kind("histories").tables(drawn);
  ASSERT_EQ(skins.size(), 3U);
  EXPECT_EQ(skins[2].csv, "histories_0.04cm.csv");
  const surface::SkinHistory& skin = run.result.gaps[2].skin;
  ASSERT_EQ(skins[2].table.rows.size(), skin.time.size());
  EXPECT_EQ(skins[2].table.rows.back()[0], Cell(1e3 * skin.time.back()));
  EXPECT_EQ(skins[2].table.rows.back().back(), Cell(skin.temperature.back()));
  EXPECT_EQ(keys_of(skins[2].table)[1], run.result.mechanics.trace.stations[0].name + "_K");
}

}  // namespace
}  // namespace launchsafe::report
