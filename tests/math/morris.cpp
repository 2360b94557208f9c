#include "estimates.hpp"
#include "launchsafe/math/sensitivity.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

namespace {

namespace math = launchsafe::math;

using Function = std::function<double(const std::vector<double>&)>;

std::vector<double> evaluated(const math::MorrisDesign& design, const Function& function) {
  std::vector<double> outputs;
  for (std::size_t k = 0; k < design.evaluations(); ++k) outputs.push_back(function(design.point(k)));
  return outputs;
}

TEST(MorrisDesign, MovesEveryInputOnceByOneStepOnTheGrid) {
  const auto design = math::morris_design(50, 6, 4, 3);
  EXPECT_EQ(design.evaluations(), 250u);
  EXPECT_NEAR(design.step(), 0.6, 1e-15);  // 6/(2*5)
  for (const double value : design.points) {
    EXPECT_NEAR(5.0 * value, std::round(5.0 * value), 1e-14);
    EXPECT_TRUE(value >= 0.0 && value <= 1.0);
  }
  for (std::size_t trajectory = 0; trajectory < 50; ++trajectory) {
    std::vector<int> moves(4, 0);
    for (std::size_t step = 0; step < 4; ++step) {
      const std::size_t moved = design.changed[trajectory * 4 + step];
      ++moves.at(moved);
      const auto before = design.point(design.index(trajectory, step));
      const auto after = design.point(design.index(trajectory, step + 1));
      for (std::size_t input = 0; input < 4; ++input) {
        EXPECT_NEAR(std::abs(after[input] - before[input]), input == moved ? 0.6 : 0.0, 1e-15);
      }
    }
    EXPECT_EQ(moves, (std::vector<int>{1, 1, 1, 1}));
  }
}

TEST(MorrisDesign, UsesAllLevelsDirectionsAndOrdersAlike) {
  constexpr std::size_t trajectories = 6000;
  const auto design = math::morris_design(trajectories, 4, 3, 3);
  std::vector<int> level(4, 0), first_moved(3, 0);
  int upward = 0;
  for (std::size_t trajectory = 0; trajectory < trajectories; ++trajectory) {
    const auto start = design.point(design.index(trajectory, 0));
    const auto end = design.point(design.index(trajectory, 3));
    ++level.at(static_cast<std::size_t>(std::lround(3.0 * start[1])));
    ++first_moved.at(design.changed[trajectory * 3]);
    upward += end[1] > start[1];
  }
  for (const int count : level) EXPECT_NEAR(count, 1500, 170);  // five standard deviations of a binomial
  for (const int count : first_moved) EXPECT_NEAR(count, 2000, 185);
  EXPECT_NEAR(upward, 3000, 195);
}

TEST(MorrisDesign, GrowsByTrajectories) {
  auto longer = math::morris_design(20, 4, 3, 8);
  longer.points.resize(10 * 4 * 3);
  EXPECT_EQ(longer.points, math::morris_design(10, 4, 3, 8).points);
  EXPECT_NE(longer.points, math::morris_design(10, 4, 3, 9).points);
}

TEST(MorrisEffects, OfALinearFunctionAreItsCoefficients) {
  // Inputs from 2 to 5 and from 10 to 30: coefficient times range is -21, 2 and, for an idle third, 0.
  const auto function = [](const std::vector<double>& u) {
    return 100.0 - 7.0 * (2.0 + 3.0 * u[0]) + 0.1 * (10.0 + 20.0 * u[1]);
  };
  const auto design = math::morris_design(10, 4, 3, 1);
  const auto effects = math::morris_effects(design, evaluated(design, function));
  const double expected[] = {-21.0, 2.0, 0.0};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(effects[k].mu, expected[k], 1e-12);
    EXPECT_NEAR(effects[k].mu_star.value, std::abs(expected[k]), 1e-12);
    EXPECT_NEAR(effects[k].mu_star.lower, std::abs(expected[k]), 1e-12);
    EXPECT_NEAR(effects[k].mu_star.upper, std::abs(expected[k]), 1e-12);
    EXPECT_NEAR(effects[k].sigma, 0.0, 1e-12);
    EXPECT_EQ(effects[k].effects, 10u);
  }
}

TEST(MorrisEffects, OfAnInteractionSpread) {
  // The effects of one factor of a product are the levels 0, 1/3, 2/3, 1 of the other: mean 1/2, variance
  // 5/36. Bounds at four standard errors of 2000 trajectories.
  const auto design = math::morris_design(2000, 4, 2, 1);
  const auto effects =
      math::morris_effects(design, evaluated(design, [](const auto& u) { return u[0] * u[1]; }));
  for (const auto& effect : effects) {
    EXPECT_NEAR(effect.mu, 0.5, 4.0 * std::sqrt(5.0 / 36.0 / 2000.0));
    EXPECT_EQ(effect.mu, effect.mu_star.value);
    EXPECT_NEAR(effect.sigma, std::sqrt(5.0 / 36.0), 0.015);
  }
}

TEST(MorrisEffects, OfOppositeSignsCancelInMuAlone) {
  // (u - 1/2)^2 on four levels: 0 to 2/3 gives -1/3, 1/3 to 1 gives +1/3.
  const auto design = math::morris_design(500, 4, 1, 1);
  const auto effects =
      math::morris_effects(design, evaluated(design, [](const auto& u) { return std::pow(u[0] - 0.5, 2); }));
  EXPECT_NEAR(effects[0].mu, 0.0, 4.0 / 3.0 / std::sqrt(500.0));
  EXPECT_NEAR(effects[0].mu_star.value, 1.0 / 3.0, 1e-14);
  EXPECT_NEAR(effects[0].sigma, 1.0 / 3.0, 0.01);
}

TEST(MorrisEffects, FailedEvaluationTakesOnlyTheEffectsItTouches) {
  const auto function = [](const std::vector<double>& u) { return u[0] + u[1] * u[2]; };
  const auto design = math::morris_design(6, 4, 3, 1);
  const auto whole = evaluated(design, function);
  auto outputs = whole;
  outputs[design.index(2, 1)] = std::nan("");  // between the first and second step of trajectory 2
  outputs[design.index(4, 0)] = -std::numeric_limits<double>::infinity();  // before the first of 4
  std::vector<std::size_t> left(3, 6);
  --left[design.changed[2 * 3 + 0]];
  --left[design.changed[2 * 3 + 1]];
  --left[design.changed[4 * 3 + 0]];
  const auto effects = math::morris_effects(design, outputs), before = math::morris_effects(design, whole);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(effects[k].effects, left[k]);
    EXPECT_TRUE(std::isfinite(effects[k].mu) && std::isfinite(effects[k].sigma));
    if (left[k] == 6) {
      EXPECT_TRUE(same(effects[k].mu_star, before[k].mu_star));
    }
  }
  EXPECT_NEAR(effects[0].mu, 1.0, 1e-14);
}

TEST(MorrisEffects, WithoutEffectsThereIsNothingToState) {
  const auto design = math::morris_design(1, 4, 2, 1);
  const auto none = math::morris_effects(design, std::vector<double>(3, std::nan("")));
  EXPECT_EQ(none[0].effects, 0u);
  EXPECT_TRUE(std::isnan(none[0].mu) && std::isnan(none[0].sigma) && std::isnan(none[0].mu_star.value));
  const auto single = math::morris_effects(design, {1.0, 2.0, 4.0});
  EXPECT_TRUE(std::isfinite(single[0].mu) && std::isfinite(single[0].mu_star.value));
  EXPECT_TRUE(std::isnan(single[0].sigma) && std::isnan(single[0].mu_star.lower));
}

TEST(MorrisEffects, IntervalHoldsTheTruthAsOftenAsItSays) {
  // The effects of the product are the levels of the other factor: mu* = 1/2.
  constexpr int seeds = 300;
  int held = 0;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const auto design = math::morris_design(12, 4, 2, seed);
    const auto outputs = evaluated(design, [](const auto& u) { return u[0] * u[1]; });
    for (const auto& effect : math::morris_effects(design, outputs, {0.95, 400, seed})) {
      held += holds(effect.mu_star, 0.5);
    }
  }
  EXPECT_NEAR(held / (2.0 * seeds), 0.95, 0.03);
}

}  // namespace
