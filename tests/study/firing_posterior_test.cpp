#include "launchsafe/math/sampling.hpp"
#include "launchsafe/math/statistics.hpp"
#include "launchsafe/study/calibration_record.hpp"
#include "study/synthetic_launch.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace {

using namespace launchsafe;
using namespace launchsafe::study;

/// What the shell of the tests is believed to have: round numbers near the calibrated ones.
FiringPrior some_prior() {
  FiringPrior prior;
  prior.centre = {1500.0, 3e-4, 525.0};
  return prior;
}

surface::SkinModel some_model() {
  surface::SkinModel model = surface::skin_model(study_of(critical_text + synthetic_constants).scene.scene);
  model.surface.localisation = 1500.0;
  model.surface.exchange_time = 3e-4;
  model.kinetics.ignition_temperature = 525.0;
  return model;
}

/// The boundaries of one launch at some gaps (m), over twice the prior; each found once.
const surface::IgnitionBoundary& boundary_at(double gap) {
  static const trace::BottomTrace trace = synthetic_trace(496e6, friction_for(116.1));
  static std::map<double, surface::IgnitionBoundary> found;
  if (const auto known = found.find(gap); known != found.end()) return known->second;
  const FiringPrior widest = some_prior().widened(2.0);
  auto boundary = surface::IgnitionBoundary::find(some_model(), trace, gap, widest.log_products(),
                                                  widest.ignition_temperatures());
  EXPECT_TRUE(boundary);
  return found.emplace(gap, std::move(*boundary)).first->second;
}

FiredLaunch fired(const surface::IgnitionBoundary& boundary, int rounds, bool ignited) {
  return {boundary, 0.05, rounds, ignited};
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double each : values) sum += each;
  return sum / static_cast<double>(values.size());
}

// Without firings the posterior is the prior: its standard deviations within what a lattice of 25 and a cut
// at three standard deviations change.
TEST(FiringPosterior, IsThePriorWithoutFirings) {
  const Posterior posterior = posterior_of(some_prior(), {}, 25, 2000);
  ASSERT_EQ(posterior.size(), 2000u);
  double square = 0.0, temperature = 0.0, scatter = 0.0;
  for (const PosteriorPoint& each : posterior) {
    square += std::pow(std::log(each.constants.localisation / 1500.0), 2) / 2000.0;
    temperature += std::pow(each.constants.ignition_temperature - 525.0, 2) / 2000.0;
    scatter += std::pow(std::log(each.scatter / 0.05), 2) / 2000.0;
  }
  EXPECT_NEAR(std::sqrt(square), 0.4, 0.02);
  EXPECT_NEAR(std::sqrt(temperature), 30.0, 2.0);
  EXPECT_NEAR(std::sqrt(scatter), 0.7, 0.05);
}

TEST(FiringPosterior, RoundsWithoutIgnitionMakeItLessProbableAndIgnitionsMore) {
  const auto boundary = boundary_at(4e-4);
  const auto probability = [&](const std::vector<FiredLaunch>& launches) {
    return mean(ignition_probabilities(posterior_of(some_prior(), launches), boundary, 0.05));
  };
  const double before = probability({}), five = probability({fired(boundary, 5, false)}),
               fifty = probability({fired(boundary, 50, false)}),
               one = probability({fired(boundary, 1, true)});
  EXPECT_LT(five, before);
  EXPECT_LT(fifty, five);
  EXPECT_GT(one, before);
}

// What a flat prior would leave of a probability after n rounds without ignition is 1/(n + 2) (Laplace);
// rounds of one launch that are known to differ by a scatter must not prove much more than that.
TEST(FiringPosterior, FewRoundsProveLittle) {
  const auto boundary = boundary_at(4e-4);
  const Posterior one = posterior_of(some_prior().widened(2.0), {fired(boundary, 1, false)});
  EXPECT_GT(mean(ignition_probabilities(one, boundary, 0.0)), 0.05);
  // A launch of the very heat that was fired has to bear more heat than it had.
  EXPECT_GT(heat_factor(one, boundary, {1500.0, 3e-4, 525.0}), 1.1);
}

TEST(FiringPosterior, HeatFactorLeavesOneOfAHundredRounds) {
  const auto boundary = boundary_at(2e-4);
  const Posterior posterior = posterior_of(some_prior(), {fired(boundary_at(4e-4), 20, false)});
  const surface::SurfaceConstants constants{1500.0, 3e-4, 525.0};
  const double factor = heat_factor(posterior, boundary, constants);
  ASSERT_GT(factor, 1.0);
  // By the definition: rounds of the posterior that are closer to ignition than the launch is after the
  // factor.
  const double margin = boundary.log_heat_margin(constants) - std::log(factor);
  double closer = 0.0;
  for (const PosteriorPoint& each : posterior) {
    const double z = (margin - boundary.log_heat_margin(each.constants)) / each.scatter;
    closer += 0.5 * std::erfc(-z / std::numbers::sqrt2) / static_cast<double>(posterior.size());
  }
  EXPECT_NEAR(closer, firing_risk, 1e-6);
}

// Rounds that may have been colder than stated prove less, not more.
TEST(FiringPosterior, ALargerSpreadOfQuietRoundsNeverNeedsLessHeat) {
  const auto& boundary = boundary_at(2e-4);
  double before = 0.0;
  for (const double spread : {0.0, 0.05, 0.2, 0.8}) {
    const Posterior posterior = posterior_of(some_prior(), {{boundary_at(4e-4), spread, 20, false}});
    const double factor = heat_factor(posterior, boundary, some_prior().centre);
    EXPECT_GE(factor, before * (1.0 - 1e-3)) << spread;
    before = factor;
  }
}

// Nor do ignitions that may have been of hot rounds speak for safety.
TEST(FiringPosterior, ALargerSpreadOfIgnitionsNeverNeedsLessHeat) {
  const auto& boundary = boundary_at(2e-4);
  const auto factor_with = [&](double spread) {
    const Posterior posterior = posterior_of(
        some_prior(), {{boundary_at(3e-4), 0.05, 60, false}, {boundary_at(8e-4), spread, 3, true}});
    return heat_factor(posterior, boundary, some_prior().centre);
  };
  EXPECT_GE(factor_with(0.8), factor_with(0.0) * (1.0 - 1e-12));
}

TEST(FiringPosterior, WiderPriorNeedsMoreHeat) {
  const auto boundary = boundary_at(2e-4);
  const std::vector<FiredLaunch> launches{fired(boundary_at(4e-4), 10, false)};
  const surface::SurfaceConstants constants{1500.0, 3e-4, 525.0};
  EXPECT_GT(heat_factor(posterior_of(some_prior().widened(2.0), launches), boundary, constants),
            heat_factor(posterior_of(some_prior(), launches), boundary, constants));
}

TEST(FiringPosterior, DoesNotDependOnTheLattice) {
  const auto boundary = boundary_at(3e-4);
  const std::vector<FiredLaunch> launches{fired(boundary_at(4e-4), 10, false),
                                          fired(boundary_at(8e-4), 2, true)};
  const auto at = [&](int nodes) {
    return std::log(
        heat_factor(posterior_of(some_prior(), launches, nodes, 2000), boundary, some_prior().centre));
  };
  EXPECT_NEAR(at(13), at(25), 0.03);
  EXPECT_NEAR(at(25), at(33), 0.015);
}

// A gap of 0.8 mm bears more heat than none: where 1000 rounds of it did not ignite, one without a gap cannot
// have.
TEST(FiringPosterior, ContradictionShowsAsAnOutcomeThatNothingMakesProbable) {
  const auto without = boundary_at(0.0);
  const auto tail_of = [&](int quiet) {
    const Posterior posterior =
        posterior_of(some_prior(), {fired(without, 1, true), fired(boundary_at(8e-4), quiet, false)});
    return tail_probability(ignition_probabilities(posterior, without, 0.05), 1, 1);
  };
  EXPECT_LT(tail_of(1000), 0.01);
  EXPECT_GT(tail_of(1), 0.1);
}

// The binomial distribution of 4 rounds with 0.5: 1/16 for none or fewer, 5/16 for three or more.
TEST(FiringPosterior, TailIsThatOfTheBinomialDistribution) {
  EXPECT_NEAR(tail_probability({0.5}, 0, 4), 1.0 / 16.0, 1e-12);
  EXPECT_NEAR(tail_probability({0.5, 0.5}, 3, 4), 5.0 / 16.0, 1e-12);
}

/// A truth of the prior by quantiles from four numbers in (0, 1).
PosteriorPoint truth_at(const FiringPrior& prior, const std::vector<double>& unit, std::size_t place) {
  const auto normal = [&](std::size_t i) {
    return math::quantile(math::Distribution::normal(0.0, 1.0, -3.0, 3.0), unit[4 * place + i]);
  };
  return {{prior.centre.localisation * std::exp(normal(0) * prior.log_localisation),
           prior.centre.exchange_time * std::exp(normal(1) * prior.log_exchange_time),
           prior.centre.ignition_temperature + normal(2) * prior.ignition_temperature},
          prior.scatter * std::exp(normal(3) * prior.log_scatter)};
}

/// How a campaign of some gaps, five rounds each, ends under a truth.
std::vector<FiredLaunch> campaign(const std::vector<surface::IgnitionBoundary>& boundaries,
                                  const PosteriorPoint& truth, math::SplitMix64& random) {
  constexpr int rounds = 5;
  constexpr double spread = 0.05;
  std::vector<FiredLaunch> launches;
  for (const surface::IgnitionBoundary& boundary : boundaries) {
    const double probability = ignition_probabilities({truth}, boundary, spread).front();
    int ignited = 0;
    for (int round = 0; round < rounds; ++round)
      ignited += static_cast<double>(random.below(1'000'000)) < 1e6 * probability;
    if (ignited > 0) launches.push_back({boundary, spread, ignited, true});
    if (ignited < rounds) launches.push_back({boundary, spread, rounds - ignited, false});
  }
  return launches;
}

/// How often the middle 90 % of the posterior hold the margin of the truth at a gap that was not fired.
double coverage(const std::vector<PosteriorPoint>& truths, std::uint64_t seed) {
  const std::vector<surface::IgnitionBoundary> boundaries{boundary_at(0.0), boundary_at(3e-4),
                                                          boundary_at(8e-4)};
  const surface::IgnitionBoundary elsewhere = boundary_at(2e-4);
  math::SplitMix64 random(seed);
  int held = 0;
  for (const PosteriorPoint& truth : truths) {
    const Posterior posterior = posterior_of(some_prior(), campaign(boundaries, truth, random), 17);
    std::vector<double> margins;
    for (const PosteriorPoint& each : posterior) margins.push_back(elsewhere.log_heat_margin(each.constants));
    const double margin = elsewhere.log_heat_margin(truth.constants);
    held += margin >= quantile_of(margins, 0.05) && margin <= quantile_of(margins, 0.95);
  }
  return held / static_cast<double>(truths.size());
}

// Of truths that the prior draws, intervals of 90 % hold 90 %; 200 of them tell that to +-4.2 % (two standard
// deviations).
TEST(FiringPosterior, IntervalsHoldNineOfTenTruths) {
  constexpr std::size_t truths = 200;
  const std::vector<double> unit = math::unit_points(math::Design::scrambled_sobol, truths, 4, 1);
  std::vector<PosteriorPoint> drawn;
  for (std::size_t i = 0; i < truths; ++i) drawn.push_back(truth_at(some_prior(), unit, i));
  const double share = coverage(drawn, 1);
  RecordProperty("share", std::to_string(share));
  EXPECT_GE(share, 0.85);
  EXPECT_LE(share, 0.95);
}

// Of one truth an interval may hold more or less than 90 %: more where the prior has it, less at its edges.
TEST(FiringPosterior, IntervalsHoldTheCentreOfThePriorMoreOftenThanItsEdges) {
  constexpr std::size_t campaigns = 100;
  const auto share_at = [](double deviations) {
    PosteriorPoint truth{some_prior().centre, some_prior().scatter};
    truth.constants.localisation *= std::exp(deviations * some_prior().log_localisation);
    return coverage(std::vector<PosteriorPoint>(campaigns, truth), 2);
  };
  const double centre = share_at(0.0), low = share_at(-2.0), high = share_at(2.0);
  RecordProperty("centre", std::to_string(centre));
  RecordProperty("two_deviations_less", std::to_string(low));
  RecordProperty("two_deviations_more", std::to_string(high));
  EXPECT_GE(centre, 0.9);
  EXPECT_GE(centre, std::min(low, high));
}

}  // namespace
