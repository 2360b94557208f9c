#include "launchsafe/kinds/sensitivity.hpp"

#include "study/synthetic_launch.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

/// The margin is T1 minus T max, and T max at gap 0 of the synthetic launch is 300 K + 116.1 K of friction in
/// proportion to the localisation: a linear function of the two inputs below, whatever the third is.
std::string linear_text(const std::string& more) {
  return more + R"(kind = "sensitivity"
scene = "scene_155mm.toml"
gaps = "0 cm"
vary = [
  { key = "friction.localisation", distribution = "uniform", range = "900 to 1700" },
  { key = "kinetics.ignition_temperature", distribution = "uniform", range = "520 to 540 K" },
  { key = "peak_pressure", distribution = "uniform", range = "450 to 500 MPa" },
]
[set]
gap.exchange_time = "0.36 ms"
)";
}

const std::string wide_search = "largest_gap = \"0.2 cm\"\n";
/// Up to 0.01 cm nothing ignites: every critical gap is a bound, found at once.
const std::string no_search = "largest_gap = \"0.01 cm\"\n";

struct Counted {
  StudyOptions options;
  std::shared_ptr<std::atomic<int>> runs = std::make_shared<std::atomic<int>>(0);
  Counted() {
    options.jobs = 2;
    options.runners = synthetic_runners();
    options.runners.mechanics = [count = runs](const scene::Scene& scene, const run::RunOptions&) {
      ++*count;
      return synthetic_mechanics(scene);
    };
  }
};

const OutputSensitivity& output_of(const SensitivityResult& result, SensitivityOutput which) {
  for (const OutputSensitivity& each : result.outputs) {
    if (each.output == which) return each;
  }
  ADD_FAILURE() << static_cast<int>(which);
  return result.outputs.front();
}

// 116.1 K at the shipped localisation; ranges of 800 and of 20 K: variances of a twelfth of their squares in
// K. A polynomial of the first degree is exact.
TEST(Sensitivity, APolynomialFittedToFewLaunchesHasTheIndicesOfALinearMargin) {
  const StudyFile study = study_of(linear_text(no_search + "samples = 20\nseed = 7\n"));
  ASSERT_EQ(study.cases.size(), 20u);
  const SensitivityResult result = run_sensitivity(study, Counted().options);
  const OutputSensitivity& margin = output_of(result, SensitivityOutput::margin);
  ASSERT_EQ(margin.reason, "");
  ASSERT_TRUE(margin.fit);
  EXPECT_EQ(margin.fit->points, 20u);
  EXPECT_LT(margin.fit->leave_one_out, 1e-3);
  const double range = 800.0 * 116.1 / scene::shipped_constants().front()->scene.surface.localisation;
  const double friction = range * range, trigger = 20.0 * 20.0, sum = friction + trigger;
  EXPECT_NEAR(margin.sobol.inputs[0].total.value, friction / sum, 1e-3);
  EXPECT_NEAR(margin.sobol.inputs[1].first.value, trigger / sum, 1e-3);
  EXPECT_NEAR(margin.sobol.inputs[2].total.value, 0.0, 1e-6);
  // Critical gaps that are bounds are fitted by nothing.
  const OutputSensitivity& gap = output_of(result, SensitivityOutput::critical_gap);
  EXPECT_EQ(gap.bounds, 20u);
  EXPECT_FALSE(gap.fit);
}

TEST(Sensitivity, APolynomialThatMissesWhatIsLeftOutGivesNoIndices) {
  const StudyFile study = study_of(linear_text(no_search + "samples = 20\nseed = 7\n"));
  Counted counted;
  // T max jumps from launch to launch, as nothing that is smooth in the inputs does.
  counted.options.runners.mechanics = [](const scene::Scene& scene, const run::RunOptions&) {
    auto result = synthetic_mechanics(scene);
    const double jump = std::fmod(1e6 * scene.load.peak / 496e6, 1.0);
    for (double& energy : result.trace.friction) energy *= 0.2 + jump;
    return result;
  };
  const SensitivityResult result = run_sensitivity(study, counted.options);
  const OutputSensitivity& hottest = output_of(result, SensitivityOutput::maximum_temperature);
  ASSERT_TRUE(hottest.fit);
  EXPECT_EQ(hottest.fit->reason, "");
  EXPECT_NE(hottest.reason, "");
  EXPECT_TRUE(hottest.sobol.inputs.empty());
}

// The first evaluation fails, and with it those that share its mechanical run.
TEST(Sensitivity, NoStatisticIsOverLessThanAllEvaluations) {
  const StudyFile study = study_of(linear_text(wide_search + "samples = 24\n"));
  Counted counted;
  const double failing = study.cases[0].scene.scene.load.peak;
  counted.options.runners.mechanics = [failing](const scene::Scene& scene, const run::RunOptions&) {
    run::MechanicsResult result = synthetic_mechanics(scene);
    if (scene.load.peak == failing) result.status = run::RunStatus::non_finite;
    return result;
  };
  const SensitivityResult result = run_sensitivity(study, counted.options);
  const auto json = nlohmann::json::parse(report_of(result).json);
  const auto failed = json["failed"].get<std::size_t>();
  EXPECT_GE(failed, 1u);
  EXPECT_EQ(json["evaluations"].size(), study.cases.size());
  for (const auto& row : json["indices"])
    for (const char* key : {"first_order", "first_order_lower", "total_order", "total_order_upper"})
      EXPECT_TRUE(row[key].is_null()) << row;
  for (const auto& row : json["outputs"]) {
    EXPECT_EQ(row["missing"], failed);
    EXPECT_NE(row["reason"], "");
    for (const char* key : {"mean", "standard_deviation", "leave_one_out"})
      EXPECT_TRUE(row[key].is_null()) << row;
  }
}

}  // namespace
