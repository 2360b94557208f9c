// Every series of error against run time: the observed orders are what the theory of its method says.
#include "launchsafe/verify/error_against_time.hpp"

#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace {

using launchsafe::verify::ErrorSeries;
using launchsafe::verify::MeasuredSetting;

class ErrorAgainstTime : public testing::TestWithParam<ErrorSeries> {};

void expect_complete(const std::vector<MeasuredSetting>& rows) {
  for (const MeasuredSetting& row : rows) {
    EXPECT_FALSE(row.text.empty());
    EXPECT_TRUE(std::isfinite(row.error)) << row.text;
    EXPECT_GE(row.error, 0.0) << row.text;
    EXPECT_GT(row.processor_time, 0.0) << row.text;
  }
  EXPECT_TRUE(std::isnan(rows.front().order));
  for (std::size_t k = 1; k < rows.size(); ++k) EXPECT_LT(rows[k].size, rows[k - 1].size);
}

/// Exact methods: nothing but round-off at any setting, and no order made of it.
void expect_exact(const ErrorSeries& series, const std::vector<MeasuredSetting>& rows) {
  for (const MeasuredSetting& row : rows) {
    EXPECT_LE(row.error, series.round_off) << row.text;
    EXPECT_TRUE(std::isnan(row.order)) << row.text;
  }
}

/// The error falls at every setting, in the end with the order that `series.theory` gives. The last two
/// orders are averaged: a step control changes its number of steps by whole ones.
void expect_order(const ErrorSeries& series, const std::vector<MeasuredSetting>& rows) {
  for (std::size_t k = 1; k < rows.size(); ++k) EXPECT_LT(rows[k].error, rows[k - 1].error) << rows[k].text;
  const double last = 0.5 * (rows.back().order + rows[rows.size() - 2].order);
  EXPECT_NEAR(last, series.order, 0.1) << series.theory;
}

/// Without an order, the finest setting still is far better than the coarsest.
void expect_bounded(const std::vector<MeasuredSetting>& rows) {
  EXPECT_LT(rows.back().error, 1e-2 * rows.front().error);
  EXPECT_LT(rows.back().error, 1e-4);
}

TEST_P(ErrorAgainstTime, FallsAsTheMethodsTheorySays) {
  const ErrorSeries& series = GetParam();
  const std::vector<MeasuredSetting> rows = measured(series);
  ASSERT_GE(rows.size(), 3U);
  expect_complete(rows);
  if (std::isnan(series.order)) {
    expect_bounded(rows);
  } else if (std::isinf(series.order)) {
    expect_exact(series, rows);
  } else {
    expect_order(series, rows);
  }
}

/// "bar_wave_velocity": part and quantity in letters and digits.
std::string series_name(const testing::TestParamInfo<ErrorSeries>& info) {
  std::string name;
  for (const char letter : info.param.part + " " + info.param.quantity) {
    const bool plain = std::isalnum(static_cast<unsigned char>(letter)) != 0;
    if (plain) name += letter;
    if (!plain && !name.empty() && name.back() != '_') name += '_';
  }
  return name;
}

INSTANTIATE_TEST_SUITE_P(Parts, ErrorAgainstTime, testing::ValuesIn(launchsafe::verify::error_series()),
                         series_name);

TEST(ErrorSeries, CoverEveryPartWithAnExactSolutionAndSayWhatTheyAre) {
  std::set<std::string> parts, names;
  for (const ErrorSeries& series : launchsafe::verify::error_series()) {
    parts.insert(series.part);
    EXPECT_TRUE(names.insert(series.part + ": " + series.quantity).second) << series.quantity;
    EXPECT_FALSE(series.work.empty() || series.reference.empty() || series.theory.empty()) << series.quantity;
    EXPECT_GT(series.round_off, 0.0) << series.quantity;
  }
  EXPECT_EQ(parts, (std::set<std::string>{"skin equation", "exchange with the air", "Visco-SCRAM",
                                          "conduction", "bar wave", "free flight", "shape functions"}));
}

TEST(ErrorSeries, MoreStepsTakeMoreTime) {
  for (const ErrorSeries& series : launchsafe::verify::error_series()) {
    if (series.part != "exchange with the air") continue;
    const std::vector<MeasuredSetting> rows = measured(series);
    // From 4 to 1024 steps of one point.
    EXPECT_GT(rows.back().processor_time, 50.0 * rows.front().processor_time);
    EXPECT_LT(rows.back().processor_time, 1000.0 * rows.front().processor_time);
  }
}

}  // namespace
