#include "launchsafe/report/plot.hpp"

#include "report/gnuplot.hpp"

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
  EXPECT_NE(svg->find("width=\"800\" height=\"1720\""), std::string::npos)
      << "three panels of 800 by 560, and 40 for the title";
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

TEST(Plot, BandsLieBehindTheSeriesFromEdgeToEdge) {
  Plot plot = sample();
  plot.vertical_bands = {{0.01, 0.02, "where it may be"}};
  const std::string text = to_gnuplot(plot);
  EXPECT_NE(text.find("$band0 << END_OF_DATA\n0.01 0\n0.01 1\n0.02 1\n0.02 0\n"), std::string::npos) << text;
  EXPECT_LT(text.find("$band0 using"), text.find("$series0 using")) << "what is drawn first is behind";
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

TEST_F(DrawnPlot, NothingToDrawIsAnError) {
  Plot plot = sample();
  plot.series.clear();
  EXPECT_FALSE(to_svg(plot));
  plot.series = {{"gone", {std::numeric_limits<double>::quiet_NaN()}, {1.0}}};
  EXPECT_FALSE(to_svg(plot));
}

}  // namespace
}  // namespace launchsafe::report
