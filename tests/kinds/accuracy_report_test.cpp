#include "launchsafe/kinds/accuracy.hpp"
#include "launchsafe/scene/mesh.hpp"
#include "report/report_folder.hpp"
#include "study/synthetic_launch.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

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
                               "reference_cell_sizes = \"0.625, 1.25, 2.5 mm\"\ntimes = \"10 ms\"\n"
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
  const AccuracyResult result = made_accuracy();
  const report::Table table = kinds::setting_table(result);
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_NEAR(std::get<double>(cell_of(table, 2, "temperature_error_0_cm_K")), 2.0, 0.05);
  EXPECT_NEAR(std::get<double>(cell_of(table, 2, "processor_time_s")), 1.0, 1e-6);
  EXPECT_GT(std::get<double>(cell_of(table, 2, "temperature_bound_K")), 2.0);
  EXPECT_NE(std::get<std::string>(cell_of(table, 2, "remark")).find("the scene as it is"), std::string::npos);
  const report::Table times = kinds::time_table(result);
  EXPECT_TRUE(std::isfinite(std::get<double>(cell_of(times, 2, "temperature_error_10_ms_K"))));
}

TEST(AccuracyReport, SaysWhatTheMeshesTendTo) {
  const report::Table table = kinds::reference_table(made_accuracy());
  EXPECT_EQ(std::get<std::string>(cell_of(table, 0, "quantity")), "T max at 0 cm");
  EXPECT_NEAR(std::get<double>(cell_of(table, 0, "order")), 1.5, 0.02);
  EXPECT_NEAR(std::get<double>(cell_of(table, 0, "extrapolated")), 416.1, 0.03);
}

TEST(AccuracyReport, AnswersInOneScreen) {
  const std::string page = kinds::summary(made_accuracy());
  for (const char* part : {"How wrong is the critical gap?", "Why believe that?", "halve the error",
                           "launchsafe study", "observed order 1.5", "0.625, 1.25, 2.5 mm"})
    EXPECT_NE(page.find(part), std::string::npos) << part << "\n" << page;
  EXPECT_LT(std::count(page.begin(), page.end(), '\n'), 45);
}

TEST(AccuracyReport, WithoutAReferenceThereIsNoRecordAndTheReasonIsSaid) {
  const AccuracyResult result = made_accuracy(true);
  EXPECT_NE(kinds::answer(result).find("non-finite"), std::string::npos);
  EXPECT_NE(kinds::summary(result).find("no reference"), std::string::npos);
  EXPECT_TRUE(kinds::setting_table(result).rows.empty());
  EXPECT_TRUE(report::json_of(result)["reference"].empty());
  const report::Folder folder;
  const auto written = report::write_report(kinds::report_of(result), folder.path);
  ASSERT_TRUE(written);
  EXPECT_EQ(std::count(written->files.begin(), written->files.end(), "accuracy.json"), 0);
}

TEST(AccuracyReport, WritesARecordThatOtherStudiesCanRead) {
  const report::Folder folder;
  const AccuracyResult result = made_accuracy();
  ASSERT_TRUE(report::write_report(kinds::report_of(result), folder.path));
  const auto record =
      parse_accuracy_record(report::content_of(folder.path / "accuracy.json"), "accuracy.json");
  ASSERT_TRUE(record);
  EXPECT_EQ(record->settings.size(), 4u);
  EXPECT_NE(recorded_setting(*record, result.study.scene.scene), nullptr);
  const auto json = nlohmann::json::parse(report::content_of(folder.path / "study.json"));
  EXPECT_EQ(json["reference"][0]["quantity"], "T max at 0 cm");
  EXPECT_EQ(json["settings"].size(), 4u);
}

TEST(AccuracyReport, ThePictureShowsBoundsAndNamesTheFrontAlone) {
  const AccuracyResult result = made_accuracy();
  const report::Plot plot = kinds::error_plot(result);
  const report::Series* own = series_named(plot, "as in the scene");
  ASSERT_NE(own, nullptr);
  const AccuracyRow& row = result.rows[2];
  ASSERT_TRUE(row.baseline);
  EXPECT_EQ(own->style, report::Style::vertical_bars);
  EXPECT_EQ(own->y.front(), row.temperature_bound) << "the mark";
  EXPECT_EQ(own->upper.front(), row.temperature_bound);
  EXPECT_EQ(own->lower.front(), row.largest_temperature_error) << "the bar goes down to the distance";
  for (const AccuracyRow& each : result.rows) {
    const std::string& label = result.study.cases[each.index].label;
    if (!each.on_front) {
      EXPECT_EQ(series_named(plot, label), nullptr) << label;
    }
  }
  ASSERT_EQ(plot.horizontal_lines.size(), 1u);
  double uncertainty = 0;
  for (const ReferenceValue& value : result.reference->temperature)
    uncertainty = std::max(uncertainty, value.limit.uncertainty + value.inexactness);
  EXPECT_EQ(plot.horizontal_lines.front().at, uncertainty) << "nothing can be shown to be nearer";
}

TEST(AccuracyReport, WithoutABoundThePictureSaysSo) {
  AccuracyResult result = made_accuracy();
  result.record.unvaried = {"numerics.growth_x"};
  for (AccuracyRow& row : result.rows) row.temperature_bound = not_a_number;
  const report::Plot plot = kinds::error_plot(result);
  EXPECT_NE(plot.subtitle.find("no bound"), std::string::npos);
  const report::Series* own = series_named(plot, "as in the scene");
  ASSERT_NE(own, nullptr);
  EXPECT_EQ(own->y.front(), result.rows[2].largest_temperature_error);
}

TEST(AccuracyReport, ErrorsStandAgainstTheMeshAndOverTheLaunch) {
  const AccuracyResult result = made_accuracy();
  const report::Plot meshes = kinds::mesh_plot(result);
  const report::Series* own = series_named(meshes, "as in the scene");
  ASSERT_NE(own, nullptr);
  ASSERT_EQ(own->x.size(), 3u);
  EXPECT_NEAR(own->x[2], 2.5, 0.1) << "mm, from fine to coarse";
  EXPECT_NEAR(own->lower[2], 2.0, 0.05) << "2 K times (cell/2.5 mm)^1.5";
  ASSERT_NE(series_named(meshes, "time_step_factor 0.25"), nullptr) << "few enough to be named";
  const report::Plot launch = kinds::launch_plot(result);
  const report::Series* line = series_named(launch, "as in the scene");
  ASSERT_NE(line, nullptr);
  EXPECT_EQ(line->x, std::vector<double>{10.0}) << "ms";
  EXPECT_EQ(line->y.front(),
            bound_against(result.reference->at_times.front(), result.rows[2].measured.at_times.front()));
}

TEST(AccuracyReport, NoTwoNamedSettingsLookAlike) {
  AccuracyResult result = made_accuracy();
  result.rows.resize(20, result.rows[2]);
  for (AccuracyRow& row : result.rows) row.on_front = true;
  for (const report::Plot& plot : {kinds::error_plot(result), kinds::launch_plot(result)}) {
    std::set<std::pair<int, report::Mark>> looks;
    std::size_t named = 0;
    for (const report::Series& series : plot.series) {
      if (!series.mark || series.label == "reference meshes") continue;
      ++named;
      looks.emplace(*series.colour, *series.mark);
    }
    EXPECT_EQ(named, 20u);
    EXPECT_EQ(looks.size(), named);
  }
}

}  // namespace
