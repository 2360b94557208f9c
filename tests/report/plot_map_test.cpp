// Maps: which cells have a colour, numbers or contour lines, and the pictures themselves.
#include "launchsafe/report/plot.hpp"
#include "report/gnuplot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace launchsafe::report {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// z = x + 2y on a grid of so many points, 1 apart.
Plot plane(int columns = 4, int rows = 3) {
  Plot plot;
  plot.title = "a plane";
  plot.x = {"x [m]"};
  plot.y = {"y [m]"};
  Map map;
  for (int i = 0; i < columns; ++i) map.x.push_back(i);
  for (int j = 0; j < rows; ++j) map.y.push_back(j);
  for (const double y : map.y)
    for (const double x : map.x) map.values.push_back(x + 2 * y);
  map.label = "z [m]";
  plot.map = std::move(map);
  return plot;
}

TEST(PlotMap, EveryValueHasACellHalfWayToItsNeighbours) {
  const std::vector<std::string> cells = block_of(to_gnuplot(plane()), "cells");
  ASSERT_EQ(cells.size(), 12u);
  EXPECT_EQ(cells.front(), "0 0 -0.5 0.5 -0.5 0.5 0");
  EXPECT_EQ(cells[6], "2 1 1.5 2.5 0.5 1.5 4");
}

TEST(PlotMap, CellsOfALogarithmicAxisMeetHalfWayInThePicture) {
  Plot plot = plane(2, 2);
  plot.x.scale = Scale::logarithmic;
  plot.map->x = {1, 100};
  const std::vector<std::string> cells = block_of(to_gnuplot(plot), "cells");
  EXPECT_EQ(cells.front(), "1 0 0.1 10 -0.5 0.5 0") << "10 is half way from 1 to 100 in decades";
}

TEST(PlotMap, WhatHasNoValueHasNoColour) {
  Plot plot = plane();
  plot.map->values[5] = missing;
  plot.map->hatched = {{"more than that", Hatching::rising, {5}}, {"failed", Hatching::crossed, {}}};
  const std::string text = to_gnuplot(plot);
  EXPECT_EQ(block_of(text, "cells").size(), 11u);
  EXPECT_EQ(block_of(text, "hatched0"), std::vector<std::string>{"1 1 0.5 1.5 0.5 1.5"});
  EXPECT_NE(text.find("title \"more than that\""), std::string::npos);
  EXPECT_EQ(text.find("failed"), std::string::npos) << "nothing to tell in the legend";
}

TEST(PlotMap, HasNumbersWhereTheyHaveRoomAndContoursOtherwise) {
  const std::string coarse = to_gnuplot(plane()), fine = to_gnuplot(plane(40, 30));
  EXPECT_NE(coarse.find("sprintf"), std::string::npos);
  EXPECT_EQ(coarse.find("contour"), std::string::npos);
  EXPECT_EQ(fine.find("sprintf"), std::string::npos);
  EXPECT_NE(fine.find("set contour"), std::string::npos);
}

TEST(PlotMap, ContoursAreFoundInTheCoordinatesOfThePicture) {
  Plot plot = plane(40, 30);
  plot.x.scale = Scale::logarithmic;
  for (std::size_t i = 0; i < plot.map->x.size(); ++i) plot.map->x[i] = std::pow(10.0, 0.1 * double(i));
  const std::string text = to_gnuplot(plot);
  EXPECT_EQ(block_of(text, "grid_of_contours")[10], "1 0 10") << "the logarithm of 10";
  EXPECT_NE(text.find("$contours using (10**$1):2 with lines"), std::string::npos);
}

/// The levels of the contour lines in gnuplot's text; empty where there are none.
std::string levels_of(const std::string& gnuplot) {
  const std::string before = "levels discrete ";
  const std::size_t at = gnuplot.find(before);
  if (at == std::string::npos) return {};
  return gnuplot.substr(at + before.size(), gnuplot.find('\n', at) - at - before.size());
}

TEST(PlotMap, ContoursAreNoFinerThanTheUncertainty) {
  Plot plot = plane(40, 30);  // from 0 to 97
  EXPECT_EQ(levels_of(to_gnuplot(plot)), "20,40,60,80") << "about eight at most: 97/8, in one digit";
  plot.map->least_step = 25;
  EXPECT_EQ(levels_of(to_gnuplot(plot)), "30,60,90");
  plot.map->least_step = 0;
  plot.map->uncertainty.assign(plot.map->values.size(), 1.0);
  EXPECT_EQ(levels_of(to_gnuplot(plot)), "20,40,60,80");
  plot.map->uncertainty[7] = 45.0;
  EXPECT_EQ(levels_of(to_gnuplot(plot)), "50") << "the largest decides";
  plot.map->uncertainty[7] = 200.0;
  const std::string unknown = to_gnuplot(plot);
  EXPECT_EQ(unknown.find("$contours"), std::string::npos) << "no line is known";
}

TEST(PlotMap, BrokenLinesShowWhereTheUncertaintyMovesContours) {
  Plot plot = plane(40, 30);
  EXPECT_EQ(to_gnuplot(plot).find("$lower"), std::string::npos);
  plot.map->uncertainty.assign(plot.map->values.size(), 4.0);
  const std::string text = to_gnuplot(plot);
  EXPECT_EQ(block_of(text, "grid_of_contours")[2], "2 0 2");
  EXPECT_EQ(block_of(text, "grid_of_lower")[2], "2 0 -2");
  EXPECT_EQ(block_of(text, "grid_of_upper")[2], "2 0 6");
  EXPECT_NE(text.find("sprintf('> %g', $3)"), std::string::npos) << "of which line they are";
}

TEST(PlotMap, NumbersStandWithTheirUncertainty) {
  Plot plot = plane();
  plot.map->uncertainty.assign(plot.map->values.size(), 0.5);
  const std::string text = to_gnuplot(plot);
  EXPECT_EQ(block_of(text, "cells")[6], "2 1 1.5 2.5 0.5 1.5 4 0.5");
  EXPECT_NE(text.find("+-%.2g"), std::string::npos);
  plot.map->uncertainty.pop_back();
  EXPECT_FALSE(to_svg(plot)) << "one for every value, or none";
}

TEST(PlotMap, ColoursOfSeveralMapsCanBeMadeToCompare) {
  Plot plot = plane();
  plot.map->minimum = -5;
  plot.map->maximum = 20;
  EXPECT_NE(to_gnuplot(plot).find("set cbrange [-5:20]"), std::string::npos);
}

TEST(PlotMap, ValuesThatDoNotFitTheGridAreAnError) {
  Plot plot = plane();
  plot.map->values.pop_back();
  EXPECT_FALSE(to_svg(plot));
  plot = plane();
  plot.x.scale = Scale::logarithmic;  // x = 0 has no place on it
  EXPECT_FALSE(to_svg(plot));
  plot = plane();
  std::swap(plot.map->x[0], plot.map->x[1]);
  EXPECT_FALSE(to_svg(plot));
  EXPECT_FALSE(to_svg(plane(4, 1)));
}

class DrawnMap : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!gnuplot_is_there()) GTEST_SKIP() << "gnuplot is not installed";
  }
};

TEST_F(DrawnMap, HasColourBarNumbersAndLegend) {
  Plot plot = plane();
  plot.map->values[5] = missing;
  plot.map->hatched = {{"more than that", Hatching::rising, {5}}};
  const auto svg = to_svg(plot);
  ASSERT_TRUE(svg) << svg.error().message;
  for (const char* text : {">a plane<", ">x [m]<", ">y [m]<", ">z [m]<", ">more than that<", ">7<"})
    EXPECT_NE(svg->find(text), std::string::npos) << text;
}

TEST_F(DrawnMap, WorksWithNoValueOneOrEqualOnes) {
  for (Plot plot : {plane(), plane(40, 30)}) {
    plot.map->values.assign(plot.map->values.size(), 3.0);
    plot.map->minimum = plot.map->maximum = 3.0;
    auto svg = to_svg(plot);
    EXPECT_TRUE(svg) << svg.error().message;
    plot.map->values.assign(plot.map->values.size(), missing);
    plot.map->values.front() = 3.0;
    svg = to_svg(plot);
    EXPECT_TRUE(svg) << svg.error().message;
    plot = plane(static_cast<int>(plot.map->x.size()), static_cast<int>(plot.map->y.size()));
    plot.map->values.assign(plot.map->values.size(), missing);
    plot.map->hatched = {{"bound", Hatching::rising, {1}}};
    svg = to_svg(plot);
    EXPECT_TRUE(svg) << svg.error().message;
  }
}

TEST_F(DrawnMap, ShowsUncertaintyAlsoWhereItLeavesNoContour) {
  for (const double uncertainty : {0.5, 15.0, 200.0}) {
    for (Plot plot : {plane(), plane(40, 30)}) {
      plot.map->uncertainty.assign(plot.map->values.size(), uncertainty);
      const auto svg = to_svg(plot);
      ASSERT_TRUE(svg) << svg.error().message;
      EXPECT_EQ(svg->find("less the uncertainty") != std::string::npos,
                plot.map->x.size() > 4 && uncertainty < 100.0);
    }
  }
}

TEST_F(DrawnMap, ContoursLeaveOutWhatHasNoValue) {
  Plot plot = plane(40, 30);
  for (std::size_t j = 0; j < 30; ++j)
    for (std::size_t i = 20; i < 40; ++i) plot.map->values[40 * j + i] = missing;
  const auto svg = to_svg(plot);
  ASSERT_TRUE(svg) << svg.error().message;
  EXPECT_NE(svg->find("> 60<"), std::string::npos) << "a level";
  EXPECT_LT(svg->size(), 1'000'000u);
}

}  // namespace
}  // namespace launchsafe::report
