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
AccuracyResult made_accuracy(bool fails = false, const std::string& variants = {}) {
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
                               constants_on_even_lattice + variants),
                      options);
}

/// Two variants, of which the second compares one gap alone.
AccuracyResult made_variants() {
  return made_accuracy(false,
                       "[[variant]]\nname = \"own\"\n[[variant]]\nname = \"one_gap\"\ngaps = \"0.02 cm\"\n");
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

TEST(AccuracyReport, WithoutAReferenceThereIsNoRecordAndTheReasonIsSaid) {
  const AccuracyResult result = made_accuracy(true);
  EXPECT_FALSE(result.variants.front().no_reference.empty());
  EXPECT_TRUE(kinds::setting_table(result).rows.empty());
  EXPECT_TRUE(report::json_of(result)["reference"].empty());
  EXPECT_TRUE(kinds::report_of(result).files.empty());
}

TEST(AccuracyReport, WritesARecordThatOtherStudiesCanRead) {
  const AccuracyResult result = made_accuracy();
  const report::Report report = kinds::report_of(result);
  ASSERT_EQ(report.files.size(), 1u);
  EXPECT_EQ(report.files.front().name, "accuracy.json");
  const auto record = parse_accuracy_record(report.files.front().text, "accuracy.json");
  ASSERT_TRUE(record);
  EXPECT_EQ(record->settings.size(), 4u);
  EXPECT_NE(recorded_setting(*record, result.study.scene.scene), nullptr);
  const auto json = report::json_of(result);
  EXPECT_EQ(json["reference"][0]["quantity"], "T max at 0 cm");
  EXPECT_EQ(json["settings"].size(), 4u);
  EXPECT_FALSE(json["settings"][0].contains("variant"));
}

TEST(AccuracyReport, OfVariantsHasOneTableAndAPictureAndARecordEach) {
  const AccuracyResult result = made_variants();
  const report::Report report = kinds::report_of(result);
  ASSERT_EQ(report.files.size(), 2u);
  EXPECT_EQ(report.files[0].name, "accuracy_own.json");
  EXPECT_EQ(report.files[1].name, "accuracy_one_gap.json");
  std::size_t pictures = 0, tables = 0;
  for (const auto& item : report.items) {
    const auto* table = std::get_if<report::ReportTable>(&item);
    if (table != nullptr && table->shown != report::Shown::file) ++tables;
    if (std::holds_alternative<report::Picture>(item)) ++pictures;
  }
  EXPECT_EQ(tables, 1u);
  EXPECT_EQ(pictures, 2u);
  const report::Table summary = kinds::variant_table(result);
  ASSERT_EQ(summary.rows.size(), 2u);
  EXPECT_EQ(std::get<std::string>(cell_of(summary, 1, "variant")), "one_gap");
  const AccuracyRow& own = *result.variants[1].baseline();
  EXPECT_EQ(std::get<double>(cell_of(summary, 1, "temperature_bound_K")), own.setting.temperature_bound);
}

}  // namespace
