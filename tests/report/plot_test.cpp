#include "launchsafe/report/plot.hpp"

#include "report/gnuplot.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <limits>

namespace launchsafe::report {
namespace {

Plot sample() {
  Plot plot;
  plot.title = "T_max against gap";
  plot.x = {"gap [cm]"};
  plot.y = {"T max [K]"};
  plot.series = {{"computed", {0, 0.01, 0.02, 0.03}, {416, 442, 468, 493}}};
  return plot;
}

/// Tests that draw; skipped, and said so, where gnuplot is not installed.
class DrawnPlot : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!gnuplot_is_there()) GTEST_SKIP() << "gnuplot is not installed";
  }
};

TEST_F(DrawnPlot, IsAnSvgPictureOfItsSize) {
  const auto svg = to_svg(sample());
  ASSERT_TRUE(svg) << svg.error().message;
  EXPECT_TRUE(svg->starts_with("<?xml"));
  EXPECT_NE(svg->find("width=\"800\" height=\"560\""), std::string::npos);
  EXPECT_NE(svg->find("T_max against gap"), std::string::npos) << "underscores are no subscripts";
  EXPECT_NE(svg->find("computed"), std::string::npos);
}

TEST_F(DrawnPlot, TextIsNeverACommand) {
  const auto trap =
      std::filesystem::temp_directory_path() / ("launchsafe-trap-" + std::to_string(::getpid()));
  const std::string command = "touch " + trap.string();
  Plot plot = sample();
  plot.title = "a'; system(\"" + command + "\"); '";
  plot.x.label = "`" + command + "`";
  plot.y.label = "'\n!" + command + "\n'";
  plot.series[0].label = "@HOME ''\\";
  plot.horizontal_lines = {{450, "END_OF_DATA\n" + command + " $(x) %s"}};
  plot.vertical_lines = {{0.02, "\\\nsystem '" + command + "'"}};
  const auto svg = to_svg(plot);
  ASSERT_TRUE(svg) << svg.error().message;
  EXPECT_FALSE(std::filesystem::exists(trap));
  EXPECT_NE(svg->find("`touch"), std::string::npos) << "shown as it is";
  std::filesystem::remove(trap);
}

TEST_F(DrawnPlot, LeavesOutWhatCannotBeDrawn) {
  Plot plot = sample();
  plot.y.scale = Scale::logarithmic;
  plot.series[0].y = {416, std::numeric_limits<double>::quiet_NaN(), -1, 493};
  plot.series.push_back({"infinite", {0.01}, {std::numeric_limits<double>::infinity()}});
  plot.series.push_back({"none", {}, {}});
  const auto svg = to_svg(plot);
  EXPECT_TRUE(svg) << svg.error().message;
}

TEST_F(DrawnPlot, HasEveryStyle) {
  Plot plot = sample();
  for (const Style style : {Style::line, Style::dashed_line, Style::points, Style::steps,
                            Style::vertical_bars, Style::horizontal_bars, Style::filled_bars}) {
    plot.series.push_back({"style", {0, 0.02}, {400, 500}, style, {0, 0.01}, {500, 600}});
  }
  const auto svg = to_svg(plot);
  ASSERT_TRUE(svg) << svg.error().message;
}

TEST_F(DrawnPlot, LinesAcrossItAreNamed) {
  Plot plot = sample();
  plot.vertical_lines = {{0.5, "critical gap"}};
  plot.horizontal_lines = {{9000, "ignition temperature"}};
  const auto svg = to_svg(plot);
  ASSERT_TRUE(svg) << svg.error().message;
  for (const char* text : {">critical gap<", ">ignition temperature<", "> 9000<", "> 0.5<"})
    EXPECT_NE(svg->find(text), std::string::npos) << text << ": the axes reach the lines";
}

TEST_F(DrawnPlot, PanelsAreOnOnePictureEachWithItsOwnAxes) {
  Plot plot;
  plot.title = "both";
  plot.panels = {sample(), sample(), sample()};
  plot.panels[1].title = "second";
  plot.panels[1].y.scale = Scale::logarithmic;
  plot.panels[2].title = "third";
  const auto svg = to_svg(plot);
  ASSERT_TRUE(svg) << svg.error().message;
  for (const char* text : {">both<", ">second<", ">third<"})
    EXPECT_NE(svg->find(text), std::string::npos) << text;
  EXPECT_NE(svg->find("width=\"1600\" height=\"1160\""), std::string::npos)
      << "two rows of two panels of 800 by 560, and 40 for the title";
  plot.panels[1].series.clear();
  EXPECT_FALSE(to_svg(plot));
}

TEST_F(DrawnPlot, ASinglePointIsEnough) {
  Plot plot = sample();
  plot.series = {{"one", {0.0}, {300.0}, Style::points}};
  EXPECT_TRUE(to_svg(plot));
  plot.x.scale = plot.y.scale = Scale::logarithmic;
  plot.series = {{"one", {2.0}, {300.0}, Style::points}};
  EXPECT_TRUE(to_svg(plot));
}

TEST(Plot, AMissingProgramIsAnErrorThatNamesIt) {
  const auto svg = to_svg(sample(), {}, "no-such-gnuplot");
  ASSERT_FALSE(svg);
  EXPECT_EQ(svg.error().kind, store::Error::Kind::missing);
  EXPECT_NE(svg.error().message.find("no-such-gnuplot"), std::string::npos);
}

TEST(Plot, AProgramThatFailsIsAnError) {
  for (const char* program : {"false", "true"}) {
    const auto svg = to_svg(sample(), {}, program);
    ASSERT_FALSE(svg);
    EXPECT_EQ(svg.error().kind, store::Error::Kind::failed);
  }
}

TEST(Plot, SeriesOfDifferentLengthsAreAnError) {
  Plot plot = sample();
  plot.series[0].y.pop_back();
  const auto svg = to_svg(plot);
  ASSERT_FALSE(svg);
  EXPECT_NE(svg.error().message.find("computed"), std::string::npos);
}

TEST(Plot, ALegendOfLongEntriesTakesNoRoomFromThePlot) {
  Plot plot = sample();
  plot.series.resize(3, plot.series[0]);
  EXPECT_NE(to_gnuplot(plot).find("maxcols 3 "), std::string::npos);
  EXPECT_NE(to_gnuplot(plot).find("size 800,560 "), std::string::npos);
  plot.series[0].label.assign(60,
                              'x');  // 60 letters of 8.4 pixels and their sample: one column in 800 pixels
  EXPECT_NE(to_gnuplot(plot).find("maxcols 1 "), std::string::npos);
  EXPECT_NE(to_gnuplot(plot).find("size 800,600 "), std::string::npos) << "two further lines of 20 pixels";
}

// By hand: the frame is 360 pixels high, and names are 24 apart. Pushed up, the upper one would stand at the
// frame's edge; pushed down, at its end: it stands half-way.
TEST(Plot, LinesAreNamedAtTheirEndsNoNameOnAnother) {
  Plot plot = sample();
  plot.named_in_place = true;
  plot.horizontal_lines = {{480, "ignition"}};
  plot.series.push_back({"near", {0, 0.03}, {416, 493.1}});
  plot.series.push_back({"marks", {0.02}, {450}, Style::points});
  const std::string text = to_gnuplot(plot);
  EXPECT_NE(text.find("set label \"ignition\" at graph 0, first 480 "), std::string::npos) << text;
  EXPECT_NE(text.find("set label \"marks\" at first 0.02, first 450 "), std::string::npos) << text;
  EXPECT_NE(text.find("pointtype 9 pointsize 0.7 linecolor rgb '#009e73' notitle"), std::string::npos)
      << "few points are not in the legend";
  const auto height_of = [&](const char* name) {
    const std::string words = std::string("set label \"") + name + "\" at graph 1, graph ";
    const std::size_t at = text.find(words);
    return at == std::string::npos ? 0.0 : std::stod(text.substr(at + words.size()));
  };
  EXPECT_NEAR(height_of("near") - height_of("computed"), 24.0 / 360, 1e-6);
  const double end = (1 + 0.05) / 1.1;  // 0.05 beyond the data on either side
  EXPECT_NEAR(height_of("near"), 0.5 * (1.0 + end), 1e-6);
  for (const char* leader :
       {"set arrow from first 0.03, first 493 to ", "set arrow from first 0.03, first 493.1 to "})
    EXPECT_NE(text.find(leader), std::string::npos) << leader;
}

TEST(Plot, PanelsBelowEachOtherHaveTheSameMargins) {
  Plot plot;
  plot.panels = {sample(), sample()};
  plot.columns = 1;
  for (Plot& panel : plot.panels) panel.named_in_place = true;
  plot.panels[1].series[0].label = "a long name of a line";
  const std::string text = to_gnuplot(plot);
  EXPECT_EQ(count_of(text, "set lmargin 10\n"), 2U);
  EXPECT_EQ(count_of(text, "set rmargin 20\n"), 2U) << "3 and 0.85 of 21 letters";
}

TEST(Plot, BandsLieBehindTheSeriesFromEdgeToEdge) {
  Plot plot = sample();
  plot.vertical_bands = {{0.01, 0.02, "where it may be"}};
  plot.horizontal_bands = {{420, 430, "known"}};
  const std::string text = to_gnuplot(plot);
  EXPECT_NE(text.find("$band0 << END_OF_DATA\n0.01 0\n0.01 1\n0.02 1\n0.02 0\n"), std::string::npos) << text;
  EXPECT_NE(text.find("$level0 << END_OF_DATA\n0 420\n0 430\n1 430\n1 420\n"), std::string::npos) << text;
  EXPECT_LT(text.find("$band0 using"), text.find("$series0 using")) << "what is drawn first is behind";
  EXPECT_NE(text.find("set label \"where it may be\""), std::string::npos);
}

// By hand: the series runs below the name of the first line and through that of the second, at the left.
TEST(Plot, NamesOfLinesAcrossStandWhereNothingIsDrawn) {
  Plot plot;
  plot.named_in_place = true;
  plot.series = {{"", {0, 1, 2}, {9.8, 10, 0}, Style::line}};
  plot.horizontal_lines = {{5, "free"}, {9.5, "in the way"}};
  plot.vertical_lines = {{0.5, "from here"}};
  const std::string text = to_gnuplot(plot);
  const auto how = [&](const char* name) {
    const std::size_t at = text.find(fmt::format("set label \"{}\" at ", name));
    return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
  };
  EXPECT_NE(how("free").find("graph 0, first 5 left offset 1, 0.8"), std::string::npos) << how("free");
  EXPECT_NE(how("in the way").find("graph 0, first 9.5 left offset 1, -0.8"), std::string::npos)
      << how("in the way") << ": below its line, above which the series runs";
  EXPECT_NE(how("from here").find("graph 0.9144"), std::string::npos)
      << how("from here") << ": a line of 20 in 360 pixels below 0.97, where the series runs";
}

// By hand: the frame is 672 pixels wide, the name 80 pixels; the band begins 31 pixels to the right.
TEST(Plot, NoNameStandsOnTheEdgeOfABandOrOnAMark) {
  Plot plot;
  plot.named_in_place = true;
  plot.x = {.label = "x", .minimum = 0.0, .maximum = 1.0};
  plot.series = {{"", {0, 1}, {0, 0}, Style::line}, {"", {0, 1}, {10, 10}, Style::line}};
  plot.vertical_lines = {{0.5, "from here"}};
  const auto side = [&] { return to_gnuplot(plot).find(" right offset -1, ") != std::string::npos; };
  EXPECT_FALSE(side());
  plot.vertical_bands = {{0.546, 0.9, ""}};
  EXPECT_TRUE(side());
  plot.vertical_bands.clear();
  Series marks{.style = Style::points, .colour = 0};
  for (double y = 0.0; y <= 10.0; y += 0.25) marks.add(0.546, y);
  plot.series.push_back(marks);
  EXPECT_TRUE(side());
}

TEST(Plot, PanelsHaveOneLegendOfThePlotsSeries) {
  Plot plot;
  plot.panels = {sample(), sample()};
  for (Plot& panel : plot.panels) panel.series[0].label.clear();
  plot.series = {{"computed", {-1}, {-1}, Style::points}};
  const std::string text = to_gnuplot(plot);
  EXPECT_EQ(count_of(text, "title \"computed\""), 1U);
  EXPECT_NE(text.find("size 1600,634 "), std::string::npos) << "40 for the title and 34 for the legend";
}

TEST(Plot, ALogarithmicAxisOfFewDecadesHasTicsBetweenPowersOfTen) {
  Plot plot = sample();
  plot.y = {.label = "y", .scale = Scale::logarithmic, .minimum = 3.0, .maximum = 40.0};
  EXPECT_NE(to_gnuplot(plot).find("ytics add"), std::string::npos);
  plot.y.maximum = 400.0;
  EXPECT_EQ(to_gnuplot(plot).find("ytics add"), std::string::npos);
}

TEST(Plot, BarsNeedTheirEnds) {
  Plot plot = sample();
  plot.series[0].style = Style::vertical_bars;
  plot.series[0].lower = {1, 2, 3, 4};
  EXPECT_FALSE(to_svg(plot));
}

TEST(Plot, BarsAreDrawnAsTheyAre) {
  Plot plot = sample();
  plot.series = {{"one", {1, 2}, {10, 20}, Style::horizontal_bars}};
  plot.series[0].lower = {-4, std::numeric_limits<double>::quiet_NaN()};
  plot.series[0].upper = {6, 3};
  const std::string text = to_gnuplot(plot);
  EXPECT_NE(text.find("1 10 -4 6\n2 20 2 3\n"), std::string::npos) << "an end that is missing is the point";
  EXPECT_NE(text.find("with xerrorbars"), std::string::npos);
}

TEST(Plot, TicsCanBeNamed) {
  Plot plot = sample();
  plot.x.tics = {{0.01, "one"}, {0.02, "it's \"two\""}};
  EXPECT_NE(to_gnuplot(plot).find("set xtics (\"one\" 0.01, \"it\\047s \\042two\\042\" 0.02)"),
            std::string::npos);
}

TEST(Plot, ASeriesMayChooseItsMark) {
  Plot plot = sample();
  plot.series[0].mark = Mark::down_triangle;
  EXPECT_NE(to_gnuplot(plot).find("pointtype 11"), std::string::npos);
}

TEST_F(DrawnPlot, NothingToDrawIsAnError) {
  Plot plot = sample();
  plot.series.clear();
  EXPECT_FALSE(to_svg(plot));
  plot.series = {{"gone", {std::numeric_limits<double>::quiet_NaN()}, {1.0}}};
  EXPECT_FALSE(to_svg(plot));
}

TEST_F(DrawnPlot, LimitsThatLeaveNothingAreAnError) {
  Plot plot = sample();
  plot.x.minimum = 5;
  plot.x.maximum = 5;
  EXPECT_FALSE(to_svg(plot));
  plot = sample();
  plot.y.scale = Scale::logarithmic;
  plot.y.minimum = 0;
  EXPECT_FALSE(to_svg(plot));
}

}  // namespace
}  // namespace launchsafe::report
