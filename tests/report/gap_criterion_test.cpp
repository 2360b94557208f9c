#include "launchsafe/report/safety_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace launchsafe::report {
namespace {

Row row_of(double gap, bool safe, double margin, double uncertainty, double distance,
           double its_uncertainty) {
  return {{"gap_cm", gap},           {"verdict", safe ? "SAFE" : "INDETERMINATE"},
          {"margin_K", margin},      {"uncertainty_K", uncertainty},
          {"distance_cm", distance}, {"distance_uncertainty_cm", its_uncertainty}};
}

constexpr double ignition = 526.784;  // K, of the 155 mm shell

/// The rows of the 155 mm shell's main job, rounded.
const std::vector<Row> main_job{
    row_of(0.0, true, 103, 22, 0.0394, 0.0094), row_of(0.01, true, 77, 23, 0.0294, 0.0094),
    row_of(0.02, true, 51, 25, 0.0194, 0.0094), row_of(0.03, false, 26, 28, 0.0094, 0.0094),
    row_of(0.04, false, -265, 29, -0.001, 0.0094)};

double largest_under(const std::string& text, const std::vector<Row>& table = main_job) {
  const auto criterion = parse_criterion(text, "a standard", ignition);
  EXPECT_TRUE(criterion) << text;
  return largest_gap_under(*criterion, table).value_or(-1.0);
}

TEST(GapCriterion, TheLargestComputedGapThatMeetsIt) {
  EXPECT_EQ(largest_under("margin >= 2 uncertainty"), 0.02);
  EXPECT_EQ(largest_under("margin >= 3 uncertainty"), 0.01);
  EXPECT_EQ(largest_under("margin >= 90 K"), 0.0);
  EXPECT_EQ(largest_under("margin >= 200 K"), -1.0);
  EXPECT_EQ(largest_under("distance >= 3 uncertainty"), 0.01);
  EXPECT_EQ(largest_under("distance >= 0.2 mm"), 0.01);
  EXPECT_EQ(largest_under("margin >= 1 uncertainty and distance >= 0.03 cm"), 0.0);
}

TEST(GapCriterion, MayBeOfTheTemperatureAndIsReadWithBlanksOrWithout) {
  std::vector<Row> table = main_job;
  const double temperatures[] = {416.2, 442.6, 468.6, 495.2, 784.5};
  for (std::size_t i = 0; i < table.size(); ++i) table[i]["temperature_max_K"] = temperatures[i];
  EXPECT_EQ(largest_under("T max <= 450 K", table), 0.01);
  EXPECT_EQ(largest_under("T max<=450K and margin>=2 uncertainty", table), 0.01);
  EXPECT_EQ(largest_under("margin>=90K"), 0.0);
  EXPECT_EQ(largest_under("T max <= 450 K"), -1.0) << "no temperature, no gap";
}

TEST(GapCriterion, MayBeOfTheProbabilityWhereOneIsKnown) {
  std::vector<Row> table = main_job;
  for (Row& row : table) row["probability"] = row["gap_cm"] > 0.015 ? std::nan("") : 0.0377;
  EXPECT_EQ(largest_under("probability <= 0.05", table), 0.01);
  EXPECT_EQ(largest_under("probability<=1e-4", table), -1.0);
  EXPECT_EQ(largest_under("probability <= 0.05"), -1.0) << "none known";
}

TEST(GapCriterion, SafeIsAskedForAsWell) {
  EXPECT_EQ(largest_under("margin >= 1 K"), 0.02);  // 0.03 cm has 26 K and is INDETERMINATE
}

TEST(GapCriterion, AGapAboveOneThatFailsIsNotRecommended) {
  std::vector<Row> table = main_job;
  table[1]["verdict"] = "INDETERMINATE";
  EXPECT_EQ(largest_under("margin >= 2 uncertainty", table), 0.0);
}

TEST(GapCriterion, WithoutACriticalGapNoDistanceIsMet) {
  std::vector<Row> table = main_job;
  for (Row& row : table) row["distance_cm"] = row["distance_uncertainty_cm"] = nullptr;
  EXPECT_EQ(largest_under("distance >= 0.001 cm", table), -1.0);
}

TEST(GapCriterion, AnythingElseIsRefused) {
  for (const char* text : {"",
                           " ",
                           "and",
                           "margin",
                           "margin > 2 uncertainty",
                           "margin <= 2 uncertainty",
                           "margin = 2 uncertainty",
                           "margin ≥ 2 uncertainty",
                           "Margin >= 2 K",
                           "margin >= 0.5 uncertainty",
                           "margin >= 0 K",
                           "margin >= -2 K",
                           "margin >= -0 K",
                           "margin >= nan K",
                           "margin >= inf K",
                           "margin >= 1e400 K",
                           "probability <= 1",
                           "probability <= 5 %",
                           "probability >= 0.1",
                           "margin >= 5",
                           "margin >= 0x10 K",
                           "margin >= 2",
                           "margin >= two K",
                           "margin >= 2 cm",
                           "margin >= 2 C",
                           "margin >= 2 %",
                           "distance >= 2 K",
                           "distance >= 0.01",
                           "distance >= 1 m",
                           "distance >= -0.01 cm",
                           "gap <= 0.02 cm",
                           "margin >= 2 uncertainty and",
                           "and margin >= 2 K",
                           "margin >= 2 K and and distance >= 1 mm",
                           "margin >= 2 uncertainty or margin >= 3 K",
                           "margin >= 2 K, distance >= 1 mm",
                           "margin >= 2,5 K",
                           "not margin >= 2 K",
                           "margin >= 2 K distance >= 1 mm"}) {
    const auto parsed = parse_criterion(text, "a standard", ignition);
    ASSERT_FALSE(parsed) << text;
    EXPECT_EQ(parsed.error().key, "--criterion") << text;
  }
  for (const char* source : {"", " ", "\t\r\n"}) {
    const auto parsed = parse_criterion("margin >= 2 uncertainty", source, ignition);
    ASSERT_FALSE(parsed);
    EXPECT_EQ(parsed.error().key, "--criterion-source");
  }
}

TEST(GapCriterion, IsRefusedWithTheReason) {
  for (const auto& [text, why] : {std::pair{"margin >= 0.5 uncertainty", "is part of SAFE already"},
                                  {"T max >= 450 K", "that is small: <="},
                                  {"margin <= 20 K", "that is large: >="},
                                  {"margin >= 0 K", "more than 0"},
                                  {"probability <= 1", "below 1"},
                                  {"T max <= 526.784 K", "ignites at 526.784 K"},
                                  {"T max <= 9999 K and margin >= 2 K", "ignites at 526.784 K"}}) {
    const auto parsed = parse_criterion(text, "a standard", ignition);
    ASSERT_FALSE(parsed) << text;
    EXPECT_NE(parsed.error().found.find(why), std::string::npos) << parsed.error().found;
  }
}

TEST(GapCriterion, WordsAreToldOnOneLine) {
  const auto parsed =
      parse_criterion(" margin >=\n 2   K\tand distance >= 1 mm ", " works\n\n# standard  12\r", ignition);
  ASSERT_TRUE(parsed);
  EXPECT_EQ(parsed->text, "margin >= 2 K and distance >= 1 mm");
  EXPECT_EQ(parsed->source, "works # standard 12");
}

// Whatever the table and the criterion: what is recommended is SAFE, and so is every smaller computed gap.
TEST(GapCriterion, WhatIsRecommendedIsSafeWithAllThatIsSmaller) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-1.0, 5.0);
  std::bernoulli_distribution safe(0.8), known(0.9);
  const auto any = [&] { return known(random) ? number(random) : std::nan(""); };
  std::size_t recommended = 0;
  for (int i = 0; i < 20000; ++i) {
    std::vector<Row> table;
    for (int row = 0; row < 5; ++row)
      table.push_back(row_of(0.01 * row, safe(random), any(), any(), any(), any()));
    std::shuffle(table.begin(), table.end(), random);
    const char* texts[] = {"margin >= 1 uncertainty", "margin >= 0.1 K", "distance >= 1 uncertainty",
                           "distance >= 0.1 cm and margin >= 1 uncertainty"};
    const auto criterion = parse_criterion(texts[i % 4], "a standard", ignition);
    ASSERT_TRUE(criterion);
    const std::optional<double> largest = largest_gap_under(*criterion, table);
    if (!largest) continue;
    ++recommended;
    for (const Row& row : table)
      if (row["gap_cm"] <= *largest) {
        EXPECT_EQ(row["verdict"], "SAFE");
        EXPECT_TRUE(criterion->met_by(row));
      }
  }
  EXPECT_GT(recommended, 1000u);
}

}  // namespace
}  // namespace launchsafe::report
