#include "launchsafe/kinds/accuracy.hpp"

#include "launchsafe/scene/plan.hpp"
#include "study/synthetic_launch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

const std::string accuracy_text =
    "kind = \"accuracy\"\nscene = \"scene_155mm.toml\"\ngaps = \"0, 0.02, 0.039 cm\"\n"
    "reference_cell_sizes = \"2.5, 0.625, 1.25 mm\"\nlargest_gap = \"0.2 cm\"\n"
    "settings = [ { \"numerics.cell_size\" = \"2.5, 5 mm\", \"numerics.inertial_scaling\" = [1, 16] },\n"
    "             { friction.closure = [\"none\"] } ]\n" +
    constants_on_even_lattice + "station.width = \"1.3 cm\"\nstation.depth = \"1 cm\"\n";

constexpr double heated_by = 116.1;  // K, of the synthetic friction on an infinitely fine mesh

/// Kelvin of friction heat on a mesh: an error of the order 1.5 that is 2 K at 2.5 mm, and one of 1 K a
/// factor four of inertial scaling. A run costs what cells and steps cost.
run::MechanicsResult converging(const scene::Scene& scene) {
  const scene::CellRange mesh = scene::cells_of_charge(scene);
  const double scaling = scene.numerics.inertial_scaling;
  const double size = std::sqrt(mesh.shortest_x * mesh.shortest_r) / 2.5e-3;
  run::MechanicsResult result =
      synthetic_mechanics(scene, heated_by + 2.0 * std::pow(size, 1.5) + 0.5 * std::log2(scaling));
  result.processor_time = std::pow(size, -3.0) / std::sqrt(scaling);
  result.wall_time = 2.0 * result.processor_time;
  return result;
}

AccuracyResult result_of(
    const std::function<run::MechanicsResult(const scene::Scene&)>& mechanics = converging,
    const std::string& text = accuracy_text) {
  StudyOptions options = synthetic_options(2);
  options.runners.mechanics = [mechanics](const scene::Scene& scene, const run::RunOptions&) {
    return mechanics(scene);
  };
  return run_accuracy(study_of(text), options);
}

const AccuracyRow& row_of(const AccuracyResult& result, const std::string& label) {
  for (const AccuracyRow& row : result.rows) {
    if (row.label == label) return row;
  }
  ADD_FAILURE() << "no row " << label;
  static const AccuracyRow none;
  return none;
}

TEST(Accuracy, FindsTheOrderAndTheLimitOfAManufacturedError) {
  const AccuracyResult result = result_of();
  ASSERT_TRUE(result.reference) << result.no_reference;
  // Without a gap T max is the initial temperature and the friction heat: 300 + 116.1 K in the limit.
  const ReferenceValue& zero_gap = result.reference->temperature[0];
  EXPECT_TRUE(zero_gap.limit.justified) << zero_gap.limit.reason;
  EXPECT_NEAR(zero_gap.limit.order, 1.5, 0.02);
  EXPECT_NEAR(zero_gap.limit.value, 300.0 + heated_by, 0.02);
  ASSERT_EQ(zero_gap.values.size(), 3u);
  EXPECT_NEAR(zero_gap.values.front(), 300.0 + heated_by + 2.0 * std::pow(0.25, 1.5), 1e-3);
  EXPECT_FALSE(result.reference->critical_gap.values.empty());
}

TEST(Accuracy, MeasuresErrorsOfSettingsAgainstTheLimit) {
  const AccuracyResult result = result_of();
  const AccuracyRow& own = row_of(result, "cell_size 2.5 mm");
  EXPECT_TRUE(own.baseline);
  EXPECT_TRUE(own.reference_mesh);
  EXPECT_NEAR(own.temperature_error[0], 2.0, 0.03);
  EXPECT_GE(own.temperature_bound, own.largest_temperature_error);
  EXPECT_GT(own.critical_gap, 0);
  EXPECT_LT(own.critical_gap_error, 0) << "more friction heat, a smaller critical gap";
  EXPECT_GE(own.critical_gap_bound, std::abs(own.critical_gap_error));
  const AccuracyRow& scaled = row_of(result, "cell_size 2.5 mm, inertial_scaling 16");
  EXPECT_NEAR(scaled.temperature_error[0], 4.0, 0.03);  // 2 K and log2(16)/2 K
  EXPECT_FALSE(scaled.baseline);
}

TEST(Accuracy, TellsAnotherModelFromAnError) {
  const AccuracyResult result = result_of();
  const AccuracyRow& other = row_of(result, "closure none");
  EXPECT_TRUE(other.other_model);
  EXPECT_FALSE(other.comparable());
  EXPECT_EQ(std::ranges::count_if(result.rows, &AccuracyRow::comparable), std::ssize(result.rows) - 1);
}

TEST(Accuracy, DoesNotExtrapolateWhatDoesNotConverge) {
  // The meshes alternate: 2 K up, then 2 K down.
  const AccuracyResult result = result_of([](const scene::Scene& scene) {
    const double cell = scene.numerics.cell_size;
    return synthetic_mechanics(scene, heated_by + (cell > 1e-3 && cell < 2e-3 ? -2.0 : 2.0));
  });
  ASSERT_TRUE(result.reference);
  EXPECT_FALSE(result.reference->temperature[0].limit.justified);
  EXPECT_FALSE(result.reference->temperature[0].limit.reason.empty());
  EXPECT_EQ(result.reference->temperature[0].limit.value, result.reference->temperature[0].values.front());
  EXPECT_GE(row_of(result, "cell_size 2.5 mm").temperature_bound, 4.0);
}

TEST(Accuracy, AReferenceMeshThatFailsLeavesNoReference) {
  const AccuracyResult result = result_of([](const scene::Scene& scene) {
    run::MechanicsResult mechanics = converging(scene);
    if (scene.numerics.cell_size < 1e-3) {
      mechanics.status = run::RunStatus::energy_drift;
      mechanics.reason = "drifted";
    }
    return mechanics;
  });
  EXPECT_FALSE(result.reference);
  EXPECT_FALSE(result.no_reference.empty());
}

TEST(Accuracy, ASettingThatFailsIsARowWithoutNumbers) {
  const AccuracyResult result = result_of([](const scene::Scene& scene) {
    run::MechanicsResult mechanics = converging(scene);
    if (scene.numerics.inertial_scaling > 1.0) mechanics.status = run::RunStatus::non_finite;
    return mechanics;
  });
  ASSERT_TRUE(result.reference);
  const AccuracyRow& row = row_of(result, "cell_size 2.5 mm, inertial_scaling 16");
  EXPECT_FALSE(row.sound());
  EXPECT_TRUE(std::isnan(row.temperature_bound));
  EXPECT_TRUE(row_of(result, "cell_size 5 mm, inertial_scaling 1").sound());
}

TEST(Accuracy, ASettingWithAValidityWarningIsShownWithItsErrorAndNotRecommended) {
  const AccuracyResult result = result_of([](const scene::Scene& scene) {
    run::MechanicsResult mechanics = converging(scene);
    if (scene.numerics.inertial_scaling > 1.0) mechanics.monitor.back().energy.kinetic = 1.0;
    return mechanics;
  });
  ASSERT_TRUE(result.reference);
  const AccuracyRow& row = row_of(result, "cell_size 2.5 mm, inertial_scaling 16");
  EXPECT_FALSE(row.warnings().empty());
  EXPECT_TRUE(row.computed());
  EXPECT_FALSE(row.sound());
  EXPECT_NEAR(row.temperature_error[0], 4.0, 0.03);
  EXPECT_FALSE(row.comparable());
}

/// All meshes have an inertial scaling of 4, which makes 1 K; one setting has another value.
AccuracyResult scaled_meshes(const std::string& other) {
  std::string text = accuracy_text;
  text.replace(text.find("[1, 16]"), 7, other);
  return result_of(converging, text + "numerics.inertial_scaling = 4\n");
}

TEST(Accuracy, KnowsNoBoundWhereAllMeshesAreInexactAndNoSettingVariesThat) {
  const AccuracyResult result = scaled_meshes("[4, 16]");
  ASSERT_TRUE(result.reference) << result.no_reference;
  EXPECT_EQ(result.reference->unvaried, std::vector<std::string>{"numerics.inertial_scaling"});
  EXPECT_TRUE(std::isnan(result.reference_uncertainty()));
  for (const AccuracyRow& row : result.rows) EXPECT_TRUE(std::isnan(row.temperature_bound)) << row.label;
}

TEST(Accuracy, WidensBoundsByThreeTimesTheDifferenceThatTheExactValueMakes) {
  const AccuracyResult result = scaled_meshes("[1, 4]");
  ASSERT_TRUE(result.reference) << result.no_reference;
  EXPECT_TRUE(result.reference->unvaried.empty());
  // A scaling of 4 makes log2(4)/2 K = 1 K, on cells of 2.5 and 5 mm alike.
  const ReferenceValue& zero_gap = result.reference->temperature[0];
  EXPECT_NEAR(zero_gap.inexactness, 3.0, 0.01);
  const AccuracyRow& own = *result.baseline();
  EXPECT_GE(own.temperature_bound,
            zero_gap.inexactness + std::abs(own.temperature[0] - zero_gap.values.front()));
}

}  // namespace
