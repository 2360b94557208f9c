#include "launchsafe/kinds/accuracy.hpp"
#include "launchsafe/scene/plan.hpp"
#include "report/report_folder.hpp"
#include "study/synthetic_launch.hpp"

#include <fmt/format.h>
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
                               "reference_cell_sizes = \"0.625, 1.25, 2.5 mm\"\ntimes = \"10 ms\"\n"
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
  EXPECT_NE(std::get<std::string>(cell_of(table, 2, "remark")).find("the scene as it is"), std::string::npos);
  EXPECT_TRUE(std::isfinite(std::get<double>(cell_of(table, 2, "temperature_error_10_ms_K"))));
}

TEST(AccuracyReport, SaysWhatTheMeshesTendTo) {
  const report::Table table = kinds::reference_table(made_accuracy());
  EXPECT_EQ(std::get<std::string>(cell_of(table, 0, "quantity")), "T max at 0 cm");
  EXPECT_NEAR(std::get<double>(cell_of(table, 0, "order")), 1.5, 0.02);
  EXPECT_NEAR(std::get<double>(cell_of(table, 0, "extrapolated")), 416.1, 0.03);
}

TEST(AccuracyReport, WithoutAReferenceThereIsNoRecordAndTheReasonIsSaid) {
  const AccuracyResult result = made_accuracy(true);
  EXPECT_NE(kinds::answer(result).find("non-finite"), std::string::npos);
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

TEST(AccuracyReport, OfVariantsHasOneTableOnePictureAndARecordEach) {
  const AccuracyResult result = made_variants();
  const report::Report report = kinds::report_of(result);
  ASSERT_EQ(report.files.size(), 2u);
  EXPECT_EQ(report.files[0].name, "accuracy_own.json");
  EXPECT_EQ(report.files[1].name, "accuracy_one_gap.json");
  std::size_t pictures = 0, tables = 0;
  for (const auto& item : report.items) {
    const auto* table = std::get_if<report::ReportTable>(&item);
    if (table != nullptr && table->shown != report::Shown::file) ++tables;
    if (const auto* picture = std::get_if<report::Picture>(&item)) {
      ++pictures;
      ASSERT_EQ(picture->plot.panels.size(), 2u);
      EXPECT_EQ(picture->plot.panels[1].title, "one_gap: 2 K from its limit") << "it has no title of its own";
    }
  }
  EXPECT_EQ(tables, 1u);
  EXPECT_EQ(pictures, 1u);
  const report::Table summary = kinds::variant_table(result);
  ASSERT_EQ(summary.rows.size(), 2u);
  EXPECT_EQ(std::get<std::string>(cell_of(summary, 1, "variant")), "one_gap");
  const AccuracyRow& own = *result.variants[1].baseline();
  EXPECT_EQ(std::get<double>(cell_of(summary, 1, "temperature_bound_K")), own.setting.temperature_bound);
  EXPECT_EQ(std::get<std::string>(cell_of(summary, 1, "half_bound_setting")), "cell_size 1.25 mm")
      << "an error of 0.7 K and a reference known to 0.3 K, instead of 2 K";
}

TEST(AccuracyReport, RowsOfAllVariantsStandUnderTheKeysThatEachHas) {
  const report::Table table = kinds::setting_table(made_variants());
  ASSERT_EQ(table.rows.size(), 8u);
  EXPECT_EQ(std::get<std::string>(cell_of(table, 3, "variant")), "own");
  EXPECT_EQ(std::get<std::string>(cell_of(table, 4, "variant")), "one_gap");
  EXPECT_TRUE(std::holds_alternative<std::monostate>(cell_of(table, 6, "temperature_error_0_cm_K")));
  EXPECT_EQ(cell_of(table, 6, "temperature_error_0.02_cm_K"),
            cell_of(table, 2, "temperature_error_0.02_cm_K"));
}

TEST(AccuracyReport, ThePictureShowsDistancesAndWhatTheLimitIsKnownTo) {
  const VariantAccuracy result = made_accuracy().variants.front();
  const report::Plot plot = kinds::error_plot(result);
  const report::Series* own = series_named(plot, "as in the scene");
  ASSERT_NE(own, nullptr);
  const AccuracyRow& row = result.rows[2];
  ASSERT_TRUE(row.baseline);
  EXPECT_EQ(own->y, std::vector<double>{row.largest_temperature_error});
  EXPECT_TRUE(plot.title.ends_with("from its limit")) << plot.title;
  ASSERT_EQ(plot.horizontal_bands.size(), 1u);
  EXPECT_EQ(plot.horizontal_bands[0].to, result.reference->temperature.front().limit.uncertainty);
  EXPECT_TRUE(plot.subtitle.empty());
}

// By hand: another formulation is 7 K off; in the lab frame the charge ignites, whose skin would be 160 K
// hotter at 10 ms without reaction.
TEST(AccuracyReport, ThePictureTellsMethodsApartAndHasNoDistanceOfAFlame) {
  VariantAccuracy result = made_accuracy().variants.front();
  AccuracyRow other = result.rows[2], flame = other;
  other.baseline = flame.baseline = other.setting.reference = flame.setting.reference = false;
  other.setting.setting["numerics.formulation"] = "updated-lagrangian";
  other.largest_temperature_error = 7.0;
  flame.setting.setting["frame"] = "lab";
  flame.largest_temperature_error = not_a_number;
  flame.error_at_times = {160.0};
  result.rows.push_back(other);
  result.rows.push_back(flame);
  const report::Plot plot = kinds::error_plot(result);
  const report::Series *method = series_named(plot, "updated-lagrangian formulation"),
                       *ignites = series_named(plot, "lab frame, ignites (10 ms, no reaction)");
  ASSERT_TRUE(method && ignites);
  EXPECT_EQ(method->y, std::vector<double>{7.0});
  EXPECT_EQ(ignites->y, std::vector<double>{160.0});
  EXPECT_NE(method->colour, ignites->colour);
}

TEST(AccuracyReport, APanelIsNamedByWhatATitleOfItsOwnHasBehindAComma) {
  const report::Report report = kinds::report_of(made_accuracy(
      false, "[[variant]]\nname = \"own\"\n[[variant]]\nname = \"other\"\ntitle = \"Shell, bonded\"\n"));
  for (const auto& item : report.items)
    if (const auto* picture = std::get_if<report::Picture>(&item)) {
      EXPECT_TRUE(picture->plot.panels.at(0).title.starts_with("own: ")) << picture->plot.panels[0].title;
      EXPECT_TRUE(picture->plot.panels.at(1).title.starts_with("bonded: ")) << picture->plot.panels[1].title;
    }
}

TEST(AccuracyReport, PanelsOfVariantsHaveTheSameAxesAndOneLegend) {
  const report::Report report = kinds::report_of(made_variants());
  const auto picture = std::ranges::find_if(
      report.items, [](const auto& item) { return std::holds_alternative<report::Picture>(item); });
  ASSERT_NE(picture, report.items.end());
  const std::vector<report::Plot>& panels = std::get<report::Picture>(*picture).plot.panels;
  ASSERT_EQ(panels.size(), 2u);
  EXPECT_EQ(panels[0].x.minimum, panels[1].x.minimum);
  EXPECT_EQ(panels[0].y.maximum, panels[1].y.maximum);
  for (const report::Plot& panel : panels)
    for (const report::Series& each : panel.series) EXPECT_TRUE(each.label.empty()) << each.label;
  EXPECT_NE(series_named(std::get<report::Picture>(*picture).plot, "reference meshes"), nullptr);
}

// By hand: a limit known to 100 K, which no setting can be told from.
TEST(AccuracyReport, ThePictureTellsNoDistanceSmallerThanWhatTheLimitIsKnownTo) {
  VariantAccuracy result = made_accuracy().variants.front();
  for (auto& value : result.reference->temperature) value.limit.uncertainty = 100.0;
  for (AccuracyRow& row : result.rows) row.error_at_times = {1.0};
  const report::Plot plot = kinds::error_plot(result);
  for (const report::Series& series : plot.series)
    for (const double distance : series.y) EXPECT_EQ(distance, 100.0) << series.label;
  EXPECT_TRUE(plot.title == "As in the scene T max is within 100 K of its limit") << plot.title;
  EXPECT_LT(plot.y.minimum.value_or(100.0), 100.0) << "so that the edge is seen";
}

// By hand: limits known to 100 K, which no setting can be told from, of the second variant or of both.
TEST(AccuracyReport, APanelInWhichNothingIsToldApartIsWords) {
  AccuracyResult result = made_variants();
  const auto blur = [](VariantAccuracy& variant) {
    for (auto& value : variant.reference->temperature) value.limit.uncertainty = 100.0;
  };
  const auto drawn = [&]() -> std::optional<report::Plot> {
    const report::Report report = kinds::report_of(result);
    for (const auto& item : report.items)
      if (const auto* picture = std::get_if<report::Picture>(&item)) return picture->plot;
    EXPECT_EQ(report.remarks.size(), 1u);
    return std::nullopt;
  };
  blur(result.variants[1]);
  const auto plot = drawn();
  ASSERT_TRUE(plot);
  EXPECT_EQ(plot->panels.size(), 1u);
  EXPECT_TRUE(plot->subtitle.ends_with("; without a panel, as all settings are: one_gap")) << plot->subtitle;
  blur(result.variants[0]);
  EXPECT_FALSE(drawn());
}

TEST(AccuracyReport, WithoutABoundThePictureSaysSo) {
  VariantAccuracy result = made_accuracy().variants.front();
  result.record.unvaried = {"numerics.growth_x"};
  EXPECT_NE(kinds::error_plot(result).subtitle.find("no bound"), std::string::npos);
}

}  // namespace
