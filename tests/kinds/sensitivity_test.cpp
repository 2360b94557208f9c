#include "launchsafe/kinds/sensitivity.hpp"

#include "launchsafe/study/case_answer.hpp"
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
std::string linear_text(const std::string& method) {
  return method + R"(kind = "sensitivity"
scene = "scene_155mm.toml"
gaps = "0 cm"
vary = [
  { key = "friction.localisation", distribution = "uniform", range = "900 to 1700" },
  { key = "kinetics.ignition_temperature", distribution = "uniform", range = "520 to 540 K" },
  { key = "peak_pressure", distribution = "uniform", range = "450 to 500 MPa" },
]
[set]
gap.exchange_time = "0.36 ms"
kinetics.set = "comp-b"
)";
}

const std::string wide_search = "largest_gap = \"0.2 cm\"\n";
/// Up to 0.001 cm nothing ignites: every critical gap is a bound, found at once.
const std::string no_search = R"(largest_gap = "0.001 cm"
accept = [
  { key = "largest_gap", value = "0.001 cm", because = "no gap is to be found" },
  { key = "friction.localisation", value = "900 to 1700", because = "the launch is synthetic" },
]
)";

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

void expect_holds(const math::Estimate& estimate, double expected, const std::string& what) {
  EXPECT_LE(estimate.lower, expected) << what;
  EXPECT_GE(estimate.upper, expected) << what;
  EXPECT_LT(estimate.upper - estimate.lower, 0.3) << what;
}

// The same margin as below, from 50 launches instead of 1 280: a polynomial of the first degree is exact.
TEST(Sensitivity, APolynomialFittedToFewLaunchesHasTheIndicesOfALinearMargin) {
  const StudyFile study = study_of(
      linear_text(no_search + "method = \"polynomial-chaos\"\nsamples = 20\nheld_out = 30\nseed = 7\n"));
  ASSERT_EQ(study.cases.size(), 50u);
  const SensitivityResult result = run_sensitivity(study, Counted().options);
  const OutputSensitivity& margin = output_of(result, SensitivityOutput::margin);
  ASSERT_EQ(margin.reason, "");
  ASSERT_TRUE(margin.fit);
  EXPECT_EQ(margin.fit->error.launches, 30u);
  EXPECT_LT(margin.fit->error.largest, 1e-3);
  const double friction = 54.6353 * 54.6353, trigger = 20.0 * 20.0, sum = friction + trigger;
  EXPECT_NEAR(margin.sobol.inputs[0].total.value, friction / sum, 1e-3);
  EXPECT_NEAR(margin.sobol.inputs[1].first.value, trigger / sum, 1e-3);
  EXPECT_NEAR(margin.sobol.inputs[2].total.value, 0.0, 1e-6);
  EXPECT_TRUE(samples_inputs(study.study, 49));
  // Critical gaps that are bounds are fitted by nothing.
  const OutputSensitivity& gap = output_of(result, SensitivityOutput::critical_gap);
  EXPECT_NE(gap.reason.find("are bounds"), std::string::npos);
  EXPECT_FALSE(gap.fit);
}

/// The same margin of two normal inputs, of which the one lowers and the other raises it.
std::string correlated_text(const std::string& method, const std::string& coefficient) {
  return method + R"(kind = "sensitivity"
scene = "scene_155mm.toml"
gaps = "0 cm"
design = "scrambled-sobol"
vary = [
  { key = "friction.localisation", distribution = "normal", mean = 1300, deviation = 80 },
  { key = "peak_pressure", distribution = "uniform", range = "450 to 500 MPa" },
  { key = "kinetics.ignition_temperature", distribution = "normal", mean = "530 K", deviation = "4 K" },
]
correlation = [ { between = ["friction.localisation", "kinetics.ignition_temperature"], coefficient = )" +
         coefficient + R"( } ]
[set]
gap.exchange_time = "0.36 ms"
kinetics.set = "comp-b"
)";
}

// a'Ca by hand: of a linear margin (-116.1/1700 K and 1) and two deviations (80 and 4 K). From 256 draws
// of a quasi-random sequence the variance is within some percent; all of it is that of the one input that
// both are.
TEST(Sensitivity, OfALinearMarginTheVarianceIsThatOfItsCorrelatedInputs) {
  const double friction = -116.1 / 1700.0 * 80.0, trigger = 4.0;
  for (const char* coefficient : {"-0.5", "0.6"}) {
    const double variance =
        friction * friction + trigger * trigger + 2.0 * std::stod(coefficient) * friction * trigger;
    for (const std::string& method :
         {std::string("samples = 128\n"),
          std::string("method = \"polynomial-chaos\"\nsamples = 128\nheld_out = 128\n")}) {
      const SensitivityResult result =
          run_sensitivity(study_of(correlated_text(no_search + method, coefficient)), Counted().options);
      const OutputSensitivity& margin = output_of(result, SensitivityOutput::margin);
      ASSERT_EQ(margin.reason, "");
      EXPECT_NEAR(margin.deviation * margin.deviation / variance, 1.0, 0.15) << coefficient << method;
      ASSERT_EQ(margin.sobol.inputs.size(), 2u);
      EXPECT_LE(margin.sobol.inputs[0].total.lower, 1.0) << coefficient << method;
      EXPECT_GE(margin.sobol.inputs[0].total.upper, 1.0) << coefficient << method;
      EXPECT_NEAR(margin.sobol.inputs[0].first.value, 1.0, 0.1) << coefficient << method;
      EXPECT_NEAR(margin.sobol.inputs[1].total.value, 0.0, 1e-3) << "the pressure";
      if (margin.fit)
        EXPECT_LT(margin.fit->error.largest, 1e-3) << "the inputs' own coordinates stay straight";
      const report::Report written = report_of(result);
      EXPECT_NE(answer(result).find("correlated as stated"), std::string::npos) << answer(result);
      EXPECT_NE(report::to_text(sensitivity_table(result), 400).find("are one input, whose share"),
                std::string::npos);
      EXPECT_NE(report::to_csv(sensitivity_table(result)).find("correlation " + std::string(coefficient)),
                std::string::npos)
          << report::to_csv(sensitivity_table(result));
      EXPECT_NE(written.json.find("\"coefficient\": " + std::string(coefficient)), std::string::npos);
    }
  }
}

/// Launches whose friction swings with the pressure: T max is no polynomial of low degree of it.
Counted swinging() {
  Counted counted;
  counted.options.runners.mechanics = [count = counted.runs](const scene::Scene& scene,
                                                             const run::RunOptions&) {
    ++*count;
    auto result = synthetic_mechanics(scene);
    const double factor = 1.0 + 0.3 * std::sin(6.0 * (scene.load.peak / 475e6 - 1.0) / 0.05);
    for (auto& closure : result.trace.friction)
      for (double& energy : closure) energy *= factor;
    return result;
  };
  return counted;
}

const std::string few_samples =
    no_search + "method = \"polynomial-chaos\"\nsamples = 24\nheld_out = 30\nseed = 3\n";

// The errors of unseen launches are the judge: 1 of 100 is beyond on each side, of 200 no more than 8.
TEST(Sensitivity, LaunchesAreAddedUntilTheErrorIsWhatIsAsked) {
  const StudyFile study = study_of(linear_text(few_samples + "error_of_temperature = \"3 K\"\n"));
  const Counted counted = swinging();
  const SensitivityResult result = run_sensitivity(study, counted.options);
  const std::size_t added = result.answers.size() - 54;
  ASSERT_GT(added, 0u) << answer(result);
  EXPECT_EQ(result.study.cases.size(), result.answers.size());
  EXPECT_EQ(result.study.cases.label(54), "added 1");
  EXPECT_TRUE(samples_inputs(result.study.study, 53));
  EXPECT_FALSE(samples_inputs(result.study.study, 54));
  const auto errors = asked_errors(result);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_TRUE(errors[0].reached()) << errors[0].found;
  EXPECT_NE(answer(result).find("3 K asked"), std::string::npos) << answer(result);
  const report::Report written = report_of(result);
  ASSERT_FALSE(written.files.empty());
  const SurrogateRecord record = parse_surrogate(written.files.front().text, "surrogate.json").value();
  ASSERT_NE(record.predicted("temperature_max"), nullptr);
  EXPECT_EQ(record.held_out.size(), 30u);
  const Surrogate surrogate(record, *record.predicted("temperature_max"));
  int beyond = 0;
  const std::vector<double> unseen = math::unit_points(math::Design::monte_carlo, 200, 3, 99);
  for (std::size_t row = 0; row < 200; ++row) {
    const auto point = math::point_of_row(unseen, row, 3);
    const auto values = record.inputs.values_at(point);
    const double swing = 1.0 + 0.3 * std::sin(6.0 * (values[2] / 475e6 - 1.0) / 0.05);
    const Prediction prediction = surrogate.at(point);
    const double truth = 300.0 + 116.1 * values[0] / 1700.0 * swing;
    if (prediction.covered && std::abs(prediction.value - truth) > prediction.error) ++beyond;
  }
  EXPECT_LE(beyond, 8);
}

TEST(Sensitivity, AnErrorThatIsOutOfReachUsesUpTheLaunchesAndSaysSo) {
  const StudyFile study =
      study_of(linear_text(few_samples + "error_of_temperature = \"0.0001 K\"\nmost_samples = 26\n"));
  const SensitivityResult result = run_sensitivity(study, swinging().options);
  EXPECT_EQ(result.answers.size(), 26u + 30u);
  EXPECT_FALSE(asked_errors(result).at(0).reached());
  EXPECT_TRUE(result.any_indeterminate());
  EXPECT_NE(answer(result).find("the 26 launches that may be fitted are used up"), std::string::npos)
      << answer(result);
}

TEST(Sensitivity, AShardRunsTheDesignAlone) {
  const StudyFile study = study_of(linear_text(few_samples + "error_of_temperature = \"0.0001 K\"\n"));
  Counted counted = swinging();
  counted.options.shard = {1, 2};
  const SensitivityResult result = run_sensitivity(study, counted.options);
  EXPECT_EQ(result.answers.size(), 54u);
}

TEST(Sensitivity, APolynomialThatMissesWhatItHasNotSeenGivesNoIndices) {
  const StudyFile study = study_of(
      linear_text(no_search + "method = \"polynomial-chaos\"\nsamples = 20\nheld_out = 30\nseed = 7\n"));
  Counted counted;
  // T max jumps from launch to launch, as nothing that is smooth in the inputs does.
  counted.options.runners.mechanics = [](const scene::Scene& scene, const run::RunOptions&) {
    auto result = synthetic_mechanics(scene);
    const double jump = std::fmod(1e6 * scene.load.peak / 496e6, 1.0);
    for (auto& closure : result.trace.friction)
      for (double& energy : closure) energy *= 0.2 + jump;
    return result;
  };
  const SensitivityResult result = run_sensitivity(study, counted.options);
  const OutputSensitivity& hottest = output_of(result, SensitivityOutput::maximum_temperature);
  EXPECT_NE(hottest.reason.find("it has not seen"), std::string::npos) << hottest.reason;
}

// 116.1 K at localisation 1700: slope 0.0682941 K; ranges of 800 and of 20 K: variances (54.6353^2 and
// 20^2)/12.
TEST(Sensitivity, IndicesOfALinearMarginAreItsSharesOfTheVariance) {
  const StudyFile study = study_of(linear_text(no_search + "method = \"sobol\"\nsamples = 256\nseed = 7\n"));
  ASSERT_EQ(study.cases.size(), 256u * 5u);
  Counted counted;
  const SensitivityResult result = run_sensitivity(study, counted.options);
  const OutputSensitivity& margin = output_of(result, SensitivityOutput::margin);
  EXPECT_EQ(margin.reason, "");
  EXPECT_EQ(margin.missing, 0u);
  const double friction = 54.6353 * 54.6353, trigger = 20.0 * 20.0, sum = friction + trigger;
  expect_holds(margin.sobol.inputs[0].first, friction / sum, "localisation first");
  expect_holds(margin.sobol.inputs[0].total, friction / sum, "localisation total");
  expect_holds(margin.sobol.inputs[1].first, trigger / sum, "trigger first");
  expect_holds(margin.sobol.inputs[1].total, trigger / sum, "trigger total");
  EXPECT_NEAR(margin.sobol.inputs[2].total.value, 0.0, 1e-6);
  EXPECT_NEAR(margin.mean, 530.0 - 388.782, 1.0);
  EXPECT_NEAR(margin.deviation, std::sqrt(sum / 12.0), 1.0);
  // T1 is nothing to T max.
  const OutputSensitivity& temperature = output_of(result, SensitivityOutput::maximum_temperature);
  EXPECT_NEAR(temperature.sobol.inputs[1].total.value, 0.0, 1e-9);
}

TEST(Sensitivity, ThermalInputsNeedNoMechanicalRunsOfTheirOwn) {
  const StudyFile study = study_of(linear_text(wide_search + "method = \"sobol\"\nsamples = 16\n"));
  Counted counted;
  run_sensitivity(study, counted.options);
  // A, B, and A with the pressure of B, which is the only mechanical input: its values are those of B.
  EXPECT_EQ(*counted.runs, 2 * 16);
}

TEST(Sensitivity, ABoundIsNoNumber) {
  // A bound says nothing of what it depends on.
  const StudyFile study = study_of(linear_text(no_search + "method = \"sobol\"\nsamples = 16\n"));
  Counted counted;
  const SensitivityResult result = run_sensitivity(study, counted.options);
  const OutputSensitivity& critical = output_of(result, SensitivityOutput::critical_gap);
  EXPECT_EQ(critical.bounds, study.cases.size());
  EXPECT_EQ(
      critical.reason,
      "80 of 80 critical gaps are bounds, not numbers (the first without a number: no ignition up to 0.001 "
      "cm, where the search ended)");
  EXPECT_TRUE(critical.sobol.inputs.empty());
  EXPECT_EQ(output_of(result, SensitivityOutput::margin).reason, "");
}

// The first evaluation fails, and with it those that share its mechanical run.
TEST(Sensitivity, NoStatisticIsOverLessThanAllEvaluations) {
  for (const std::string method : {"method = \"sobol\"\nsamples = 32\n",
                                   "method = \"polynomial-chaos\"\nsamples = 24\nheld_out = 30\n"}) {
    const StudyFile study = study_of(linear_text(wide_search + method));
    Counted counted;
    const double failing = study.cases[0].scene.scene.load.peak;
    counted.options.runners.mechanics = [failing](const scene::Scene& scene, const run::RunOptions&) {
      run::MechanicsResult result = synthetic_mechanics(scene);
      if (scene.load.peak == failing) result.status = run::RunStatus::non_finite;
      return result;
    };
    const SensitivityResult result = run_sensitivity(study, counted.options);
    EXPECT_TRUE(result.any_indeterminate());
    const auto json = nlohmann::json::parse(report_of(result).json);
    const auto failed = json["failed"].get<std::size_t>();
    EXPECT_GE(failed, 1u);
    EXPECT_EQ(json["evaluations"].size(), study.cases.size());
    for (const auto& row : json["indices"])
      for (const char* key : {"first_order", "first_order_lower", "total_order", "total_order_upper"})
        EXPECT_TRUE(row[key].is_null()) << method << row;
    for (const auto& row : json["outputs"]) {
      EXPECT_EQ(row["missing"], failed);
      EXPECT_NE(row["reason"], "");
      for (const char* key : {"mean", "standard_deviation", "leave_one_out", "held_out_error"})
        EXPECT_TRUE(row[key].is_null()) << method << row;
    }
    for (const auto& row : json["quantiles"])
      EXPECT_TRUE(row["critical_gap_cm"].is_null() && row["temperature_max_K"].is_null()) << method << row;
  }
}

}  // namespace
