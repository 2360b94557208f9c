// Contour maps: what is filled, what is not, and the pictures themselves.
#include "launchsafe/report/contour.hpp"

#include "report/gnuplot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace launchsafe::report {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

struct Point {
  double x, y;
};
using Polygon = std::vector<Point>;

/// The polygons of all bands in gnuplot's text.
std::vector<Polygon> polygons_of(const std::string& gnuplot) {
  std::istringstream lines(gnuplot);
  std::vector<Polygon> polygons;
  bool in_band = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("$band")) {
      in_band = true;
      polygons.emplace_back();
    } else if (line == "END_OF_DATA") {
      in_band = false;
    } else if (in_band && line.empty()) {
      polygons.emplace_back();
    } else if (in_band) {
      std::istringstream numbers(line);
      Point point{};
      numbers >> point.x >> point.y;
      polygons.back().push_back(point);
    }
  }
  std::erase_if(polygons, [](const Polygon& polygon) { return polygon.empty(); });
  return polygons;
}

double area_of(const Polygon& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return 0.5 * std::abs(twice);
}

double area_of(const std::vector<Polygon>& polygons) {
  double area = 0;
  for (const Polygon& polygon : polygons) area += area_of(polygon);
  return area;
}

/// z = x + 2y on a grid of 4 x 3 points, cells of 1 x 1.
Contour plane() {
  Contour contour;
  contour.title = "a plane";
  contour.x = {"x [m]"};
  contour.y = {"y [m]"};
  contour.x_values = {0, 1, 2, 3};
  contour.y_values = {0, 1, 2};
  for (const double y : contour.y_values)
    for (const double x : contour.x_values) contour.z.push_back(x + 2 * y);
  contour.z_label = "z [m]";
  contour.levels = contour_levels(contour.z);
  return contour;
}

TEST(Contour, FillsAllCellsOnce) { EXPECT_NEAR(area_of(polygons_of(to_gnuplot(plane()))), 6.0, 1e-6); }

TEST(Contour, LeavesCellsWithAMissingCornerWhite) {
  Contour contour = plane();
  contour.z[5] = missing;  // x = 1, y = 1: a corner of four cells
  const auto polygons = polygons_of(to_gnuplot(contour));
  EXPECT_NEAR(area_of(polygons), 2.0, 1e-6);
  for (const Polygon& polygon : polygons) {
    for (const Point& point : polygon) EXPECT_GE(point.x, 2.0);
  }
}

TEST(Contour, FillsNothingWhereNoCellIsWhole) {
  Contour contour = plane();
  contour.z = {0, missing, 2, missing, missing, 3, missing, 5, 4, missing, 6, missing};
  const std::string text = to_gnuplot(contour);
  EXPECT_TRUE(polygons_of(text).empty());
  EXPECT_EQ(text.find("$lines"), std::string::npos);
  EXPECT_NE(text.find("set label \"6\" at first 2, first 2"), std::string::npos)
      << "a value that no colour shows stands beside its point";
}

TEST(Contour, BandsHoldTheirValues) {
  const std::string text = to_gnuplot(plane());
  const auto levels = contour_levels(plane().z);
  for (std::size_t band = 0; band + 1 < levels.size(); ++band) {
    const std::string name = "$band" + std::to_string(band) + " << END_OF_DATA\n";
    const std::size_t begin = text.find(name);
    ASSERT_NE(begin, std::string::npos) << band;
    const std::size_t end = text.find("END_OF_DATA", begin + name.size());
    for (const Polygon& polygon : polygons_of(text.substr(begin, end - begin))) {
      for (const Point& point : polygon) {
        EXPECT_GE(point.x + 2 * point.y, levels[band] - 1e-6);
        EXPECT_LE(point.x + 2 * point.y, levels[band + 1] + 1e-6);
      }
    }
  }
}

TEST(Contour, NeverLeavesTheRangeOfTheValues) {
  Contour contour = plane();
  contour.z = {0, 9, 0, 9, 9, 0, 9, 0, 0, 9, 0, 9};  // saddles in every cell
  contour.levels = contour_levels(contour.z);
  EXPECT_EQ(contour.levels.front(), 0.0);
  EXPECT_EQ(contour.levels.back(), 9.0);
  EXPECT_NEAR(area_of(polygons_of(to_gnuplot(contour))), 6.0, 0.2);
}

TEST(Contour, InterpolatesInTheCoordinatesOfTheAxes) {
  Contour contour;
  contour.x = {"x", Scale::logarithmic};
  contour.y = {"y"};
  contour.x_values = {1, 100};
  contour.y_values = {0, 1};
  contour.z = {0, 2, 0, 2};
  contour.levels = {0, 1, 2};
  const std::string text = to_gnuplot(contour);
  const std::size_t lines = text.find("$lines << END_OF_DATA\n");
  ASSERT_NE(lines, std::string::npos);
  EXPECT_TRUE(text.substr(lines + 22).starts_with("10 ")) << "half way between 1 and 100";
}

TEST(Contour, LevelsAreRoundAndHoldAllValues) {
  const auto levels = contour_levels({0.0123, missing, 0.0944, 0.05});
  ASSERT_GE(levels.size(), 4u);
  EXPECT_LE(levels.size(), 12u);
  EXPECT_LE(levels.front(), 0.0123);
  EXPECT_GE(levels.back(), 0.0944);
  EXPECT_NEAR(levels[1] - levels[0], 0.01, 1e-12);
  EXPECT_TRUE(contour_levels({missing}).empty());
  EXPECT_EQ(contour_levels({0.04, 0.04}).size(), 2u) << "a constant is one band";
}

TEST(Contour, ValuesThatDoNotFitTheGridAreAnError) {
  Contour contour = plane();
  contour.z.pop_back();
  EXPECT_FALSE(to_svg(contour));
  contour = plane();
  contour.x.scale = Scale::logarithmic;  // x = 0 has no place on it
  EXPECT_FALSE(to_svg(contour));
  contour = plane();
  std::swap(contour.x_values[0], contour.x_values[1]);
  EXPECT_FALSE(to_svg(contour));
}

TEST(Contour, AMissingProgramIsAnErrorThatNamesIt) {
  const auto svg = to_svg(plane(), "no-such-gnuplot");
  ASSERT_FALSE(svg);
  EXPECT_EQ(svg.error().kind, store::Error::Kind::missing);
}

class DrawnContour : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!gnuplot_is_there()) GTEST_SKIP() << "gnuplot is not installed";
  }
};

TEST_F(DrawnContour, HasColourBarLabelsAndMarks) {
  Contour contour = plane();
  contour.marks = {{"computed", Mark::circle, {0, 1}, {0, 1}},
                   {"more than that", Mark::up_triangle, {3}, {2}}};
  const auto svg = to_svg(contour);
  ASSERT_TRUE(svg) << svg.error().message;
  for (const char* text : {"a plane", "x [m]", "y [m]", "z [m]", "computed", "more than that"})
    EXPECT_NE(svg->find(text), std::string::npos) << text;
  EXPECT_NE(to_gnuplot(contour).find("boxed"), std::string::npos) << "labels on the lines";
}

TEST_F(DrawnContour, IsTheSameEveryTime) {
  const auto first = to_svg(plane()), second = to_svg(plane());
  ASSERT_TRUE(first && second);
  EXPECT_EQ(*first, *second);
}

TEST_F(DrawnContour, WorksWithoutAnyValue) {
  Contour contour = plane();
  contour.z.assign(contour.z.size(), missing);
  contour.levels = contour_levels(contour.z);
  contour.marks = {{"bound", Mark::up_triangle, {1}, {1}}};
  const auto svg = to_svg(contour);
  EXPECT_TRUE(svg) << svg.error().message;
  EXPECT_EQ(to_gnuplot(contour).find("cbrange"), std::string::npos);
}

TEST_F(DrawnContour, WorksOnADenseGrid) {
  Contour contour = plane();
  contour.x_values.clear();
  contour.y_values.clear();
  contour.z.clear();
  for (int i = 0; i < 80; ++i) contour.x_values.push_back(i);
  for (int j = 0; j < 60; ++j) contour.y_values.push_back(j);
  for (const double y : contour.y_values)
    for (const double x : contour.x_values) contour.z.push_back(std::hypot(x, y));
  contour.levels = contour_levels(contour.z);
  const auto svg = to_svg(contour);
  ASSERT_TRUE(svg) << svg.error().message;
  EXPECT_LT(svg->size(), 4'000'000u);
}

}  // namespace
}  // namespace launchsafe::report
