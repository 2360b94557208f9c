#include "launchsafe/report/safety_report.hpp"

#include <gtest/gtest.h>

namespace launchsafe::report {
namespace {

/// Rows by hand: 0 and 0.01 cm do not ignite, 0.04 cm does; the critical gap is 0.03 cm, at least 0.02.
Row tables() {
  const auto row = [](double gap, const char* verdict, double temperature) {
    return Row{
        {"gap_cm", gap}, {"verdict", verdict}, {"temperature_max_K", temperature}, {"uncertainty_K", 30.0}};
  };
  Row ignited = row(0.04, "UNSAFE", 784.0);
  ignited["ignition_cause"] = "self-heating";
  return {{"verdicts", {row(0.0, "SAFE", 310.0), row(0.01, "INDETERMINATE", 400.0), ignited}},
          {"comparison", Row::array({{{"gap_cm", 0.0},
                                      {"temperature_max_place", "S13"},
                                      {"temperature_max_published_place", "G2"},
                                      {"temperature_max_published_K", 311.0}}})},
          {"cases", Row::array({{{"critical_gap_kind", "value"},
                                 {"critical_gap_cm", 0.03},
                                 {"critical_gap_at_least_cm", 0.02},
                                 {"critical_gap_at_most_cm", 0.04},
                                 {"critical_gap_with_bounds", "0.030 ± 0.010 cm"},
                                 {"largest_safe_gap_cm", 0.0}}})}};
}

/// The default scene begins at 300 K.
scene::Scene scene_of_300K() { return {}; }

const Series* named(const Plot& plot, const std::string& label) {
  const auto found = std::ranges::find(plot.series, label, &Series::label);
  return found == plot.series.end() ? nullptr : &*found;
}

TEST(VerdictPlot, HasAColourForEachVerdictAndBarsThatEndWhereTheLaunchBegan) {
  const Plot plot = verdict_plot(tables(), scene_of_300K());
  EXPECT_NE(plot.title.find("0.030 ± 0.010 cm"), std::string::npos);
  const Series *safe = named(plot, "SAFE"), *open = named(plot, "INDETERMINATE");
  ASSERT_TRUE(safe && open);
  EXPECT_NE(safe->colour, open->colour);
  EXPECT_EQ(safe->lower, std::vector{300.0}) << "310 K less 30 K would be colder than the launch began";
  EXPECT_EQ(open->lower, std::vector{370.0});
  EXPECT_EQ(open->upper, std::vector{430.0});
  const Series* ignited = named(plot, "UNSAFE: ignites");
  ASSERT_TRUE(ignited);
  EXPECT_EQ(ignited->x, std::vector{0.04});
  EXPECT_LT(ignited->y.at(0), *plot.y.maximum) << "how hot a burning skin is says nothing of the gap";
  EXPECT_GT(ignited->y.at(0), plot.horizontal_lines.at(0).at);
  ASSERT_FALSE(plot.y.tics.empty());
  EXPECT_LT(plot.y.tics.back().at, plot.horizontal_lines.at(0).at) << "no scale where it stands";
  EXPECT_NE(named(plot, "published, " + scene::time_text(scene::read_time(scene_of_300K().load))), nullptr);
  ASSERT_EQ(plot.vertical_bands.size(), 1u);
  EXPECT_LE(plot.vertical_bands[0].from, 0.02);
  EXPECT_GE(plot.vertical_bands[0].to, 0.04);
  EXPECT_FALSE(plot.x.maximum);
}

TEST(VerdictPlot, EndsALittleBeyondTheGapsHoweverWideTheBoundsAre) {
  Row rows = tables();
  rows["cases"][0]["critical_gap_at_most_cm"] = 0.37;
  const Plot plot = verdict_plot(rows, scene_of_300K());
  EXPECT_DOUBLE_EQ(plot.x.maximum.value_or(0.0), 1.3 * 0.04);
  EXPECT_NE(plot.subtitle.find("0.37 cm"), std::string::npos);
}

TEST(VerdictPlot, IsNotGreenWhereSomethingIsAccepted) {
  const auto colour = [](const Row& rows, const char* label) {
    const Plot plot = verdict_plot(rows, scene_of_300K());
    const Series* safe = named(plot, label);
    return safe ? safe->colour : std::nullopt;
  };
  const auto green = colour(tables(), "SAFE");
  ASSERT_TRUE(green);
  Row accepted = tables();
  accepted["cases"][0]["accepted"] = "calibre, because ...";
  EXPECT_NE(colour(accepted, "SAFE, as somebody accepts").value(), *green);
}

// A finite number is drawn whatever its kind: here ignition without a gap.
TEST(VerdictPlot, DrawsTheCriticalGapWithoutBounds) {
  Row rows = tables();
  rows["cases"][0] = {{"critical_gap_kind", "all-ignite"}, {"critical_gap_cm", 0.0}};
  const Plot plot = verdict_plot(rows, scene_of_300K());
  ASSERT_EQ(plot.vertical_lines.size(), 1u);
  EXPECT_EQ(plot.vertical_lines[0].at, 0.0);
  EXPECT_TRUE(plot.vertical_bands.empty());
}

TEST(VerdictPlot, ABarWhoseEndIsNotKnownGoesOn) {
  Row rows = tables();
  rows["verdicts"][1]["uncertainty_K"] = nullptr;
  const Plot plot = verdict_plot(rows, scene_of_300K());
  EXPECT_EQ(named(plot, "INDETERMINATE")->upper, std::vector{*plot.y.maximum});
}

}  // namespace
}  // namespace launchsafe::report
