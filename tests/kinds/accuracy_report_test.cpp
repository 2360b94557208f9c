#include "launchsafe/kinds/accuracy.hpp"
#include "launchsafe/scene/plan.hpp"
#include "report/report_folder.hpp"
#include "study/synthetic_launch.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

/// Three meshes whose friction heat is off by 2 K times (cell/2.5 mm)^1.5; a run costs the cube of the
/// fineness.
AccuracyResult made_accuracy(bool fails = false) {
  StudyOptions options = synthetic_options(2);
  options.runners.mechanics = [fails](const scene::Scene& scene, const run::RunOptions&) {
    const double size = scene::fit_mesh(scene).dr / 2.5e-3;
    run::MechanicsResult result = synthetic_mechanics(scene, 116.1 + 2.0 * std::pow(size, 1.5));
    result.processor_time = std::pow(size, -3.0);
    if (fails && size < 0.3) result.status = run::RunStatus::non_finite;
    return result;
  };
  return run_accuracy(study_of("kind = \"accuracy\"\nscene = \"scene_155mm.toml\"\ngaps = \"0, 0.02 cm\"\n"
                               "reference_cell_sizes = \"0.625, 1.25, 2.5 mm\"\n"
                               "settings = [ { numerics.time_step_factor = [0.25] } ]\n" +
                               constants_on_even_lattice),
                      options);
}

const report::Cell& cell_of(const report::Table& table, std::size_t row, const std::string& key) {
  const auto keys = report::keys_of(table);
  const auto found = std::find(keys.begin(), keys.end(), key);
  EXPECT_NE(found, keys.end()) << key;
  return table.rows.at(row).at(static_cast<std::size_t>(found - keys.begin()));
}

TEST(AccuracyReport, HasARowForEverySettingWithItsErrorAndCost) {
  const report::Table table = kinds::setting_table(made_accuracy());
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_NEAR(std::get<double>(cell_of(table, 2, "temperature_error_0_cm_K")), 2.0, 0.05);
  EXPECT_NEAR(std::get<double>(cell_of(table, 2, "cell_mm")), 2.5, 0.1);
  EXPECT_NEAR(std::get<double>(cell_of(table, 2, "processor_time_s")), 1.0, 1e-6);
  EXPECT_GT(std::get<double>(cell_of(table, 2, "temperature_bound_K")), 2.0);
}

TEST(AccuracyReport, SaysWhatTheMeshesTendTo) {
  const report::Table table = kinds::reference_table(made_accuracy());
  EXPECT_EQ(std::get<std::string>(cell_of(table, 0, "quantity")), "T max at 0 cm");
  EXPECT_NEAR(std::get<double>(cell_of(table, 0, "order")), 1.5, 0.02);
  EXPECT_NEAR(std::get<double>(cell_of(table, 0, "extrapolated")), 416.1, 0.03);
}

TEST(AccuracyReport, WithoutAReferenceTheTablesAreEmptyAndTheReasonIsSaid) {
  const AccuracyResult result = made_accuracy(true);
  EXPECT_FALSE(result.no_reference.empty());
  EXPECT_TRUE(kinds::setting_table(result).rows.empty());
  EXPECT_TRUE(report::json_of(result)["reference"].empty());
}

TEST(AccuracyReport, JsonHoldsReferenceAndSettings) {
  const auto json = report::json_of(made_accuracy());
  EXPECT_EQ(json["reference"][0]["quantity"], "T max at 0 cm");
  EXPECT_EQ(json["settings"].size(), 4u);
}

}  // namespace
