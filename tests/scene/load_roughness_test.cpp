#include "launchsafe/scene/load.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

namespace launchsafe::scene {
namespace {

constexpr double duration = 18e-3;  // s

/// A curve measured at equal intervals over the launch.
Load measured(std::size_t points, const std::function<double(double)>& pressure) {
  Load load;
  load.duration = duration;
  for (std::size_t i = 0; i < points; ++i) {
    load.curve_time.push_back(duration * static_cast<double>(i) / static_cast<double>(points - 1));
    load.curve_pressure.push_back(pressure(load.curve_time.back()));
  }
  return load;
}

double pulse(double time) {
  Load load;
  load.shape = LoadShape::power_exponential;
  return PressureHistory(load).at(time);
}

/// Two humps of 400 and 300 MPa, 3 ms wide (standard deviation 1.3 ms), with a dip between.
double two_humps(double time) {
  const auto hump = [time](double peak, double centre) {
    return peak * std::exp(-0.5 * std::pow((time - centre) / 1.3e-3, 2));
  };
  return hump(400e6, 6e-3) + hump(300e6, 12e-3);
}

double step(double time) { return time < 9e-3 ? 100e6 : 300e6; }

/// The pulse with white noise, a share of its peak, at a rate (1/s).
Load noisy(double share, double rate) {
  std::mt19937 generator(7);
  std::normal_distribution<double> noise(0.0, share * 496e6);
  return measured(static_cast<std::size_t>(duration * rate) + 1,
                  [&](double time) { return std::max(0.0, pulse(time) + noise(generator)); });
}

/// Integral of p |dp| between the points of a curve.
double work_of(const Load& load) {
  double work = 0.0;
  for (std::size_t i = 1; i < load.curve_time.size(); ++i)
    work += 0.5 * std::abs(std::pow(load.curve_pressure[i], 2) - std::pow(load.curve_pressure[i - 1], 2));
  return work;
}

TEST(LoadRoughness, OfTheAnalyticLoadIsNone) {
  EXPECT_EQ(load_roughness(Load{}), 0.0);
  EXPECT_EQ(measured_load_text(Load{}), "");
}

TEST(LoadRoughness, OfASmoothCurveIsNoneHoweverManyPointsItHas) {
  for (const std::size_t points : {5u, 10u, 20u, 100u, 500u, 2000u}) {
    EXPECT_LT(load_roughness(measured(points, pulse)), 1e-3) << points;
    EXPECT_LT(load_roughness(measured(points, step)), 1e-3) << points;
  }
  for (const std::size_t points : {20u, 100u, 500u, 2000u})
    EXPECT_LT(load_roughness(measured(points, two_humps)), 1e-3) << points;
  EXPECT_EQ(load_roughness(measured(2, [](double) { return 0.0; })), 0.0);
  EXPECT_EQ(load_roughness(measured(50, [](double) { return 100e6; })), 0.0);
}

// The estimate against what the noise really adds, which is known here. Extremes of noise that stay in the
// noiseless curve make the estimate smaller.
TEST(LoadRoughness, OfANoisyCurveIsAboutWhatTheNoiseAdds) {
  const double noiseless = work_of(measured(2000, pulse));
  for (const double rate : {10e3, 50e3}) {
    for (const auto& [share, least_part] : {std::pair(0.01, 0.9), {0.05, 0.7}}) {
      const Load load = noisy(share, rate);
      const double part = (1.0 + load_roughness(load)) * noiseless / work_of(load);
      EXPECT_GT(part, least_part) << share << " " << rate;
      EXPECT_LT(part, 1.05) << share << " " << rate;
    }
  }
}

TEST(LoadRoughness, GrowsWithNoiseAndWithItsRate) {
  EXPECT_GT(load_roughness(noisy(0.01, 10e3)), 0.2);
  EXPECT_GT(load_roughness(noisy(0.05, 10e3)), 2.0 * load_roughness(noisy(0.01, 10e3)));
  EXPECT_GT(load_roughness(noisy(0.05, 50e3)), 2.0 * load_roughness(noisy(0.01, 50e3)));
  EXPECT_GT(load_roughness(noisy(0.01, 50e3)), 2.0 * load_roughness(noisy(0.01, 10e3)));
}

// Steps of an 8-bit recorder with a range of 600 MPa: the way up and down stays monotonic. With half a step
// of noise the last digit flickers, which is roughness.
TEST(LoadRoughness, OfDigitisedValuesIsNoneUnlessTheyFlicker) {
  constexpr double digit = 600e6 / 256;
  const auto digitised = [](double pressure) { return digit * std::round(pressure / digit); };
  EXPECT_LT(load_roughness(measured(900, [&](double time) { return digitised(pulse(time)); })), 1e-3);
  std::mt19937 generator(3);
  std::normal_distribution<double> noise(0.0, 0.5 * digit);
  const auto flickering = [&](double time) {
    return std::max(0.0, digitised(pulse(time) + noise(generator)));
  };
  EXPECT_GT(load_roughness(measured(900, flickering)), 0.1);
}

TEST(LoadRoughness, CountsOnlyWhatIsSimulated) {
  Load load = noisy(0.05, 10e3);
  for (std::size_t i = 0; i < load.curve_time.size(); ++i)
    if (load.curve_time[i] < 9e-3) load.curve_pressure[i] = pulse(load.curve_time[i]);
  load.duration = 9e-3;
  EXPECT_LT(load_roughness(load), 1e-3);
}

TEST(LoadRoughness, IsTakenAwayBySmoothing) {
  const Load rough = noisy(0.01, 50e3);
  double last = load_roughness(rough);
  for (const double window : {0.1e-3, 0.4e-3, 1.6e-3}) {
    Load load = rough;
    load.smoothing = window;
    EXPECT_LT(load_roughness(load), 0.5 * last) << window;
    last = load_roughness(load);
  }
  const auto suggested = suggested_smoothing(rough);
  ASSERT_TRUE(suggested);
  Load load = rough;
  load.smoothing = *suggested;
  EXPECT_LT(load_roughness(load), least_roughness);
  EXPECT_LT(peak_lost_to_smoothing(load), 0.05);
  EXPECT_NE(measured_load_text(rough).find("load.smoothing = \""), std::string::npos);
  EXPECT_NE(measured_load_text(load).find("from the peak"), std::string::npos);
  EXPECT_FALSE(suggested_smoothing(measured(100, pulse)));
}

/// The pulse with a sine of a frequency (1/s) and a share of the peak, where there is pressure.
Load ringing(double frequency, double share, std::size_t points, double noise_share = 0.0) {
  std::mt19937 generator(5);
  std::normal_distribution<double> noise(0.0, noise_share > 0.0 ? noise_share * 496e6 : 1.0);
  return measured(points, [&](double time) {
    const double pressure = pulse(time);
    const double ring = share * 496e6 * std::sin(2.0 * std::numbers::pi * frequency * time);
    return std::max(0.0,
                    pressure + (pressure > 20e6 ? ring : 0.0) + (noise_share > 0.0 ? noise(generator) : 0.0));
  });
}

// Expected is the sine that was added. It begins with the pressure, so that its mean square over the record
// is smaller, and its amplitude is found too small by less than a third.
TEST(LoadRoughness, NamesTheFrequencyAndTheSizeOfARing) {
  for (const double frequency : {1.5e3, 3.2e3, 9e3, 20e3})
    for (const std::size_t points : {1801u, 9001u}) {
      const auto ring = ring_of(ringing(frequency, 0.015, points));
      ASSERT_TRUE(ring) << frequency << " " << points;
      EXPECT_NEAR(ring->frequency, frequency, 1.0 / duration) << points;
      EXPECT_LE(ring->amplitude, 1.01 * 0.015 * 496e6) << frequency << " " << points;
      EXPECT_GE(ring->amplitude, 0.67 * 0.015 * 496e6) << frequency << " " << points;
    }
  const auto noisy_ring = ring_of(ringing(3.2e3, 0.015, 9001, 0.01));
  ASSERT_TRUE(noisy_ring);
  EXPECT_NEAR(noisy_ring->frequency, 3.2e3, 1.0 / duration);
  Load load = ringing(3.2e3, 0.015, 1801);
  load.curve_file = "pressure.csv";
  EXPECT_NE(measured_load_text(load).find("the record pressure.csv rings at 3.2 kHz"), std::string::npos)
      << measured_load_text(load);
}

TEST(LoadRoughness, SeesNoRingInNoisePulsesAndStepsOrBehindAnAverageOverIt) {
  EXPECT_FALSE(ring_of(Load{}));
  EXPECT_FALSE(ring_of(noisy(0.01, 100e3)));
  EXPECT_FALSE(ring_of(noisy(0.05, 20e3)));
  for (const auto& shape : {pulse, two_humps, step}) EXPECT_FALSE(ring_of(measured(2000, shape)));
  Load averaged = ringing(3.2e3, 0.015, 1801);
  averaged.smoothing = 1.0 / 3.2e3;
  EXPECT_FALSE(ring_of(averaged)) << ring_text(averaged);
}

TEST(LoadRoughness, TellsARingThatSmoothingTakesAwayAndWhichWindowDoes) {
  Load load = ringing(3.2e3, 0.015, 1801);
  EXPECT_NE(measured_load_text(load).find("load.smoothing = \"0.31"), std::string::npos)
      << measured_load_text(load);
  EXPECT_FALSE(smoothed_ring(load));
  load.smoothing = 1.0 / 3.2e3;
  const auto gone = smoothed_ring(load);
  ASSERT_TRUE(gone);
  EXPECT_NEAR(gone->frequency, 3.2e3, 1.0 / duration);
  EXPECT_NE(measured_load_text(load).find("it took away a ring at 3.2 kHz"), std::string::npos);
  Load noise = noisy(0.01, 50e3);
  noise.smoothing = 0.2e-3;
  EXPECT_FALSE(smoothed_ring(noise)) << "noise is no ring";
}

// An average over a tenth of a millisecond leaves 0.97 of a sine at 1.5 kHz and a fiftieth of one at 9.8 kHz.
TEST(LoadRoughness, TellsAWeakRingThatSmoothingTakesAwayBesideAStrongOneThatStays) {
  Load load = ringing(1.5e3, 0.02, 1801);
  for (std::size_t i = 0; i < load.curve_time.size(); ++i)
    load.curve_pressure[i] *= 1.0 + 0.003 * std::sin(2.0 * std::numbers::pi * 9.8e3 * load.curve_time[i]);
  EXPECT_NEAR(ring_of(load)->frequency, 1.5e3, 1.0 / duration);
  load.smoothing = 0.1e-3;
  ASSERT_TRUE(ring_of(load));
  const auto gone = smoothed_ring(load);
  ASSERT_TRUE(gone);
  EXPECT_NEAR(gone->frequency, 9.8e3, 1.0 / duration);
}

/// The pulse with a ring of a share of its peak that rises from 1.8 to 3 kHz between 3 and 12 ms.
Load chirping(double share, const Load& record) {
  Load load = record;
  for (std::size_t i = 0; i < load.curve_time.size(); ++i) {
    const double since = load.curve_time[i] - 3e-3;
    const double turns = 1.8e3 * since + 0.5 * (1.2e3 / 9e-3) * since * since;
    if (since > 0.0 && since < 9e-3)
      load.curve_pressure[i] += share * pulse(load.curve_time[i]) * std::sin(2.0 * std::numbers::pi * turns);
  }
  return load;
}

// Expected are the frequencies of the ring that was added.
TEST(LoadRoughness, TellsARingOfMovingFrequencyThatSmoothingTakesAway) {
  for (const Load& record : {measured(901, pulse), noisy(0.005, 50e3)}) {
    for (const double window : {0.1e-3, 0.42e-3}) {
      const auto gone = smoothed_ring(averaged(chirping(0.015, record), window));
      ASSERT_TRUE(gone) << window;
      EXPECT_GE(gone->frequency, 1.8e3) << window;
      EXPECT_LE(gone->frequency, 3.0e3) << window;
      EXPECT_FALSE(smoothed_ring(averaged(record, window))) << window;
    }
  }
}

// A quiet half second behind the launch, which is not simulated, hides no ring.
TEST(LoadRoughness, SeesTheRingsOfWhatIsSimulatedAlone) {
  Load load = ringing(3.2e3, 0.003, 1801);
  for (double time = duration + 1e-5; time < 0.5; time += 1e-5) {
    load.curve_time.push_back(time);
    load.curve_pressure.push_back(0.0);
  }
  const auto ring = ring_of(load);
  ASSERT_TRUE(ring);
  EXPECT_NEAR(ring->frequency, 3.2e3, 1.0 / duration);
}

// Expected are the peak of the pulse, 496 MPa, and no more than what a fine curve can miss of it.
TEST(PeakBetweenPoints, IsNoHigherThanWhatIsSaidToBeMissed) {
  for (const double interval : {2e-3, 1e-3, 0.5e-3, 0.2e-3, 20e-6}) {
    for (const double shift : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      Load load;
      for (double time = shift * interval; time < duration; time += interval) {
        load.curve_time.push_back(time);
        load.curve_pressure.push_back(pulse(time));
      }
      const double most = (1.0 + peak_missed_between_points(load)) * std::ranges::max(load.curve_pressure);
      EXPECT_GE(most, 496e6 * (1.0 - 1e-9)) << interval << " " << shift;
      EXPECT_LE(most, 496e6 * (1.0 + 0.12 * interval / 1e-3)) << interval << " " << shift;
      load.rescale_to_peak = true;
      EXPECT_EQ(peak_missed_between_points(load), 0.0) << "its peak is stated";
    }
  }
}

// At 9.8 kHz so small a ring ignites the 155 mm shell without a gap.
TEST(LoadRoughness, SeesARingOfATenthOfAPercent) {
  const auto ring = ring_of(ringing(9.8e3, 0.001, 1801));
  ASSERT_TRUE(ring);
  EXPECT_NEAR(ring->frequency, 9.8e3, 1.0 / duration);
}

}  // namespace
}  // namespace launchsafe::scene
