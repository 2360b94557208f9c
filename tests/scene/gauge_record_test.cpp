// Records of pressure gauges, and what is made of them. Expected numbers are those that the records were made
// with.
#include "launchsafe/scene/load.hpp"
#include "launchsafe/scene/quantity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace launchsafe::scene {
namespace {

constexpr double gauge_offset = 0.4e6, gauge_noise = 0.2e6, gauge_start = 1e-3, gauge_peak = 300e6,
                 gauge_rise = 4e-3;

/// A pulse of `peak` after `start`, on an offset with normal noise, from -1 ms to 11 ms every 5 us.
PressureCurve gauge_pulse(double noise_deviation = gauge_noise) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal(0.0, noise_deviation);
  PressureCurve record;
  for (int i = 0; i < 2400; ++i) {
    const double time = -1e-3 + 5e-6 * i, since = std::max(0.0, time - gauge_start) / gauge_rise;
    record.time.push_back(time);
    record.pressure.push_back(gauge_offset + gauge_peak * std::pow(since * std::exp(1.0 - since), 3.0) +
                              (noise_deviation > 0.0 ? normal(generator) : 0.0));
  }
  return record;
}

CleanedRecord cleaned(const PressureCurve& record, const GaugeCleaning& cleaning = {}) {
  const auto result = caught([&] { return clean(record, cleaning, "gauge.csv"); });
  EXPECT_TRUE(result) << (result ? "" : result.error().message());
  return result ? *result : CleanedRecord{};
}

TEST(GaugeRecord, OffsetIsTheMedianBeforeTheRise) {
  const CleanedRecord found = cleaned(gauge_pulse());
  EXPECT_GT(found.quiet_points, 150u);
  // The median of n normal values is off by 1.25 deviations over root n.
  EXPECT_NEAR(found.offset, gauge_offset,
              5.0 * 1.25 * gauge_noise / std::sqrt(static_cast<double>(found.quiet_points)));
}

TEST(GaugeRecord, TimeBeginsWhereTheTriggerIsPassed) {
  const CleanedRecord found = cleaned(gauge_pulse(0.0), {.trigger = 30e6});
  EXPECT_EQ(found.curve.time.front(), 0.0);
  EXPECT_GE(found.curve.pressure.front(), 30e6);
  EXPECT_LT(found.curve.pressure.front(), 31.5e6);  // slopes are below 0.3 MPa in 5 us there
  EXPECT_NEAR(found.start + found.peak_time, gauge_start + gauge_rise, 5e-6);
  EXPECT_NEAR(found.peak, gauge_peak, 1e-4 * gauge_peak);
}

TEST(GaugeRecord, NoiseBelowZeroIsSetToZeroAndCounted) {
  PressureCurve record = gauge_pulse();
  for (std::size_t i = 2390; i < 2400; ++i)
    record.pressure[i] = gauge_offset - (i % 2 == 0 ? 1.0 : -1.0) * gauge_noise;
  const CleanedRecord found = cleaned(record);
  EXPECT_EQ(found.points_below_zero, 5u);
  EXPECT_NEAR(found.lowest, -gauge_noise, 0.2 * gauge_noise);
  for (const double pressure : found.curve.pressure) EXPECT_GE(pressure, 0.0);
}

TEST(GaugeRecord, AGaugeThatDriftsFarBelowItsOffsetIsRefused) {
  PressureCurve record = gauge_pulse();
  for (std::size_t i = 2200; i < 2400; ++i) record.pressure[i] -= 100e6;  // of 52 to 80 MPa
  const auto result = caught([&] { return clean(record, {}, "gauge.csv"); });
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().key, "pressure");
}

TEST(GaugeRecord, WithoutQuietPointsTheOffsetHasToBeGiven) {
  PressureCurve record = gauge_pulse();
  record.time.erase(record.time.begin(), record.time.begin() + 600);
  record.pressure.erase(record.pressure.begin(), record.pressure.begin() + 600);
  const auto result = caught([&] { return clean(record, {}, "gauge.csv"); });
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message().find("--offset"), std::string::npos) << result.error().message();
  EXPECT_EQ(cleaned(record, {.offset = gauge_offset}).offset, gauge_offset);
}

// The quiet points show 0.4 MPa; a thousandth of the peak are 0.3 MPa.
TEST(GaugeRecord, AnOffsetThatTheQuietPointsContradictIsRefused) {
  for (const double offset : {gauge_offset - 0.25e6, gauge_offset + 0.25e6})
    EXPECT_EQ(cleaned(gauge_pulse(), {.offset = offset}).offset, offset);
  for (const double offset : {-8e6, 0.0, 0.8e6, 20e6}) {
    const auto result = caught([&] { return clean(gauge_pulse(), {.offset = offset}, "gauge.csv"); });
    ASSERT_FALSE(result) << offset;
    const std::string message = result.error().message();
    EXPECT_NE(message.find("--offset"), std::string::npos) << message;
    EXPECT_NE(message.find("0.4"), std::string::npos) << message;
    EXPECT_NE(message.find(pressure_text(offset)), std::string::npos) << message;
  }
}

TEST(GaugeRecord, ATriggerThatIsNeverPassedIsRefused) {
  EXPECT_FALSE(caught([&] { return clean(gauge_pulse(), {.trigger = 400e6}, "gauge.csv"); }));
}

TEST(GaugeRecord, TakesOneOfSeveralColumnsAndPressuresBelowZero) {
  const std::string text =
      "\xEF\xBB\xBFTime (ms);P breech (bar);P base (bar);T (K)\n0.0;-1.5;2.5;293\n0.5;10.0;20.0;293\n";
  const auto record = parse_gauge_record(text, "gauge.csv", {"P breech"});
  EXPECT_EQ(record.time, (std::vector<double>{0.0, 0.5e-3}));
  EXPECT_EQ(record.pressure, (std::vector<double>{-1.5e5, 10e5}));
  const auto several = caught([&] { return parse_gauge_record(text, "gauge.csv", {}); });
  ASSERT_FALSE(several);
  EXPECT_NE(several.error().message().find("\"P breech\" or \"P base\""), std::string::npos)
      << several.error().message();
  EXPECT_FALSE(caught([&] { return parse_gauge_record(text, "gauge.csv", {"T"}); }));
}

TEST(GaugeRecord, ALoadStillRefusesPressuresBelowZeroAndSaysWhatCleansThem) {
  const auto load =
      caught([&] { return parse_pressure_curve("time_ms,pressure_MPa\n0,-0.1\n1,5\n", "gauge.csv"); });
  ASSERT_FALSE(load);
  EXPECT_NE(load.error().message().find("import-curve"), std::string::npos) << load.error().message();
}

TEST(GaugeRecord, IsWrittenAsACurveThatReadsBack) {
  const CleanedRecord found = cleaned(gauge_pulse());
  const auto read = parse_pressure_curve(csv_of(found.curve, "two\nremarks"), "pressure.csv");
  ASSERT_EQ(read.time.size(), found.curve.time.size());
  for (std::size_t i = 0; i < read.time.size(); ++i)
    EXPECT_NEAR(read.pressure[i], found.curve.pressure[i], 1e-8 * gauge_peak);
}

}  // namespace
}  // namespace launchsafe::scene
