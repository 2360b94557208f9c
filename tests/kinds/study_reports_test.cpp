// The pages, tables and JSON of studies on a launch in closed form.
#include "launchsafe/kinds/calibration.hpp"
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/report/study_text.hpp"
#include "launchsafe/report/table.hpp"
#include "report/report_folder.hpp"
#include "study/synthetic_launch.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;
using report::json_of;

const std::string study_text =
    critical_text +
    "title = \"A test\"\ngaps = \"0, 0.03, 0.06 cm\"\n"
    "reference_line = { slope = 2702.1, intercept = \"416.1 K\" }\n"
    "reference = [{ gap = \"0 cm\", maximum_temperature = \"416.1 K\", point = \"G2\", "
    "calibrated = true }, { gap = \"0.03 cm\", maximum_temperature = \"492.9 K\" }]\n";

CriticalGapResult one_case() {
  return run_critical_gap(study_of(study_text + synthetic_constants), synthetic_options());
}

TEST(CriticalGapReport, JsonHasTheKeysThatOtherProgramsReadFrom) {
  const auto json = json_of(one_case());
  for (const char* key : {"critical_gap", "verdicts", "fit", "timing", "cases"})
    EXPECT_TRUE(json.contains(key)) << key;
  const auto& critical = json["critical_gap"];
  for (const char* key :
       {"critical_gap_cm", "critical_gap_lower_cm", "critical_gap_upper_cm", "critical_gap_kind", "reason"})
    EXPECT_TRUE(critical.contains(key)) << key;
  EXPECT_EQ(critical["critical_gap_kind"], "value");
  EXPECT_LE(critical["critical_gap_upper_cm"].get<double>() - critical["critical_gap_lower_cm"].get<double>(),
            1e-4);
  ASSERT_EQ(json["verdicts"].size(), 3u);
  for (const char* key :
       {"gap_cm", "peak_pressure_MPa", "crack_radius_um", "flaw_size_mm", "temperature_max_K",
        "temperature_max_place", "temperature_max_time_ms", "temperature_early_K", "spread_early_K",
        "margin_K", "uncertainty_K", "verdict", "reason", "ignition_cause"}) {
    EXPECT_TRUE(json["verdicts"][0].contains(key)) << key;
  }
  EXPECT_EQ(json["early_time_ms"], 10.0);
  ASSERT_EQ(json["comparison"].size(), 2u);
  EXPECT_EQ(json["comparison"][0]["used_for"], "fitted");
  EXPECT_EQ(json["comparison"][1]["used_for"], "held out");
  EXPECT_EQ(json["comparison"][1]["temperature_max_published_K"], 492.9);
  EXPECT_TRUE(json["verdicts"][0]["ignition_cause"].is_null());
  EXPECT_EQ(json["verdicts"][2]["ignition_place"], "S2");
  for (const char* key : {"wall_time_s", "runs", "reused", "updates_per_second"})
    EXPECT_TRUE(json["timing"].contains(key));
  EXPECT_TRUE(
      json["fit"][0]["slope_standard_error_K_per_cm"].is_null());  // two rows: no degree of freedom left
}

TEST(CriticalGapReport, TellsWhichSharesAreAssumedUntilTheStudyStatesThem) {
  const auto assumed = [](const std::string& keys) {
    return json_of(run_critical_gap(study_of(keys + study_text + synthetic_constants), synthetic_options()))
        .at("assumed");
  };
  const auto alone = assumed("");
  EXPECT_TRUE(alone.contains("numerical_uncertainty"));
  EXPECT_EQ(alone.size(), 1u) << "the study states the others";
  EXPECT_TRUE(assumed("numerical_uncertainty = { value = \"5 K\", because = \"a mesh study\" }\n").empty());
}

// The largest with all smaller ones: a gap that is not SAFE ends it, in whatever order they were asked.
TEST(CriticalGapReport, TellsTheLargestSafeGapOfTheComputedOnes) {
  const auto gap = [](double width, study::Verdict verdict) {
    study::GapVerdict row;
    row.gap = width;
    row.judgement.verdict = verdict;
    return row;
  };
  using enum study::Verdict;
  EXPECT_EQ(largest_safe_gap({gap(3e-4, safe), gap(1e-4, safe), gap(2e-4, indeterminate)}), 1e-4);
  EXPECT_EQ(largest_safe_gap({gap(0, safe), gap(2e-4, safe)}), 2e-4);
  EXPECT_TRUE(std::isnan(largest_safe_gap({gap(0, unsafe), gap(1e-4, safe)})));
}

TEST(CriticalGapReport, NothingThatFailedIsANumber) {
  StudyOptions options = synthetic_options();
  options.runners.mechanics = [](const scene::Scene&, const run::RunOptions&) -> run::MechanicsResult {
    throw std::runtime_error("broken");
  };
  const auto json = json_of(run_critical_gap(study_of(study_text + synthetic_constants), options));
  for (const char* key : {"critical_gap_cm", "critical_gap_lower_cm", "critical_gap_upper_cm"})
    EXPECT_TRUE(json["critical_gap"][key].is_null()) << key;
  EXPECT_EQ(json["critical_gap"]["critical_gap_kind"], "indeterminate");
  EXPECT_TRUE(json["verdicts"][0]["temperature_max_K"].is_null());
  EXPECT_EQ(json["verdicts"][0]["verdict"], "INDETERMINATE");
  EXPECT_TRUE(json["fit"].empty());
}

TEST(CriticalGapReport, SeveralCasesHaveNoSingleCriticalGap) {
  const CriticalGapResult result =
      run_critical_gap(study_of(study_text + vary({{"peak_pressure", "400, 496 MPa"}}) + synthetic_constants),
                       synthetic_options());
  const auto json = json_of(result);
  EXPECT_EQ(json["cases"].size(), 2u);
  EXPECT_EQ(json["verdicts"].size(), 6u);
  EXPECT_TRUE(json["critical_gap"].is_null());
  EXPECT_NE(kinds::answer(result).find("400 MPa"), std::string::npos);
}

TEST(CriticalGapReport, NamesNoPathOfThisMachine) {
  for (const std::string& text :
       {report::to_markdown(kinds::report_of(one_case())), json_of(one_case()).dump()})
    EXPECT_EQ(text.find(LAUNCHSAFE_SOURCE_DIR), std::string::npos);
}

// What a cause moves the critical gap by is less than a wide bracket: with 0.005 cm the shipped study had a
// lower bound of 0.0317 cm, and with 0.0001 cm one of 0.0273 cm.
TEST(CriticalGapReport, AWideToleranceRaisesNoLowerBound) {
  const auto bounds_with = [](const std::string& tolerance) {
    const std::string key = "tolerance = \"" + tolerance + "\"\n";
    return run_critical_gap(study_of(key + study_text + synthetic_constants), synthetic_options())
        .details.front()
        .critical;
  };
  const CriticalGap fine = bounds_with("0.0001 cm"), wide = bounds_with("0.01 cm");
  ASSERT_TRUE(std::isfinite(fine.bounds.at_least));
  EXPECT_EQ(wide.bounds.at_least, fine.bounds.at_least);
  EXPECT_EQ(wide.lower, fine.lower);
}

TEST(CriticalGapReport, ThePictureIsThatOfSafetyReports) {
  const CriticalGapResult result = one_case();
  const report::Plot plot = kinds::temperature_plot(result);
  std::vector<double> inert;
  for (const report::Series& series : plot.series)
    if (series.style == report::Style::vertical_bars)
      inert.insert(inert.end(), series.x.begin(), series.x.end());
  std::ranges::sort(inert);
  ASSERT_EQ(inert, (std::vector<double>{0.0, 3.0e-4 * 100.0})) << "those that do not ignite";
  const GapVerdict& row = result.details.front().verdicts[1];
  const report::Series* computed = series_named(plot, study::to_string(row.judgement.verdict));
  ASSERT_NE(computed, nullptr) << "in the colour of its verdict";
  EXPECT_NEAR(computed->upper.back(),
              std::min(computed->y.back() + row.uncertainty.total(), plot.y.maximum.value_or(0.0)), 1e-9);
  // The model form moves towards ignition alone; the study states 1 K.
  EXPECT_NEAR(computed->y.back() - computed->lower.back(), row.uncertainty.total() - 1.0, 1e-9);
  ASSERT_NE(series_named(plot, "UNSAFE: ignites"), nullptr);
  const CriticalGap& critical = result.details.front().critical;
  ASSERT_EQ(plot.vertical_bands.size(), 1u);
  // The same words and ends as in a safety report: rounded away from the value.
  const auto measured = report::measured_gap(100.0 * critical.value, 100.0 * critical.bounds.at_least,
                                             100.0 * critical.bounds.at_most);
  ASSERT_TRUE(measured);
  EXPECT_EQ(plot.vertical_bands[0].from, std::max(0.0, measured->lower()));
  EXPECT_EQ(plot.vertical_bands[0].to, measured->upper());
  EXPECT_TRUE(plot.title.ends_with(measured->text("cm"))) << plot.title;
  ASSERT_EQ(plot.vertical_lines.size(), 1u);
  EXPECT_EQ(plot.vertical_lines[0].label, "critical gap");
}

TEST(CriticalGapReport, AnIndeterminateCriticalGapIsWordsInThePicture) {
  CriticalGapResult result = one_case();
  result.answers.front().critical = CriticalGap{};
  const report::Plot plot = kinds::temperature_plot(result);
  EXPECT_TRUE(plot.vertical_bands.empty());
  EXPECT_TRUE(plot.vertical_lines.empty());
  EXPECT_TRUE(plot.title.ends_with("indeterminate")) << plot.title;
}

TEST(CriticalGapReport, SixCasesHaveTheirCriticalGapsInAPictureOfTheirOwn) {
  CriticalGapResult result = run_critical_gap(
      study_of(study_text + vary({{"peak_pressure", "400, 450, 496 MPa"}, {"flaw_size", "1, 2 mm"}}) +
               synthetic_constants),
      synthetic_options());
  ASSERT_EQ(result.details.size(), 6u);
  // Known to less than they differ by, or there is no picture.
  for (study::CaseAnswer& answer : result.answers)
    answer.critical.bounds.at_least = answer.critical.value - 1e-6;
  result.answers[1].critical = CriticalGap{};
  const report::Plot temperatures = kinds::temperature_plot(result);
  ASSERT_EQ(temperatures.panels.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_TRUE(temperatures.panels[i].title.starts_with(result.details[i].input.label + ": "))
        << temperatures.panels[i].title;
  EXPECT_TRUE(temperatures.title.ends_with(" of 6 cases ignite at a computed gap")) << temperatures.title;
  const auto pictures = kinds::gap_pictures(result).pictures;
  ASSERT_EQ(pictures.size(), 1u);
  const report::Plot& plot = pictures.front().plot;
  EXPECT_NEAR(plot.series[0].y[0], 100.0 * result.answers[0].critical.value, 1e-12) << "400 MPa, 1 mm";
  EXPECT_TRUE(std::isnan(plot.series[1].y[0])) << "400 MPa, 2 mm";
  EXPECT_NE(report::to_markdown(kinds::report_of(result)).find("critical_gap.svg"), std::string::npos);
  EXPECT_EQ(report::to_markdown(kinds::report_of(one_case())).find("critical_gap.svg"), std::string::npos);
}

TEST(CalibrationReport, HoldsWhatTheEvidenceSupports) {
  // The synthetic launch has one load, whatever the scene says.
  StudyFile shipped = *read_study(studies_folder / "calibrate_table8.toml");
  kinds::settings_of<kinds::CalibrationSettings>(shipped.study).load_fitted = false;
  const CalibrationResult result = run_calibration(shipped, synthetic_options());
  const auto json = json_of(result);
  EXPECT_EQ(json["calibrations"].size(), result.rows.size());
  EXPECT_GE(json["calibrations"].size(), 6u);
  EXPECT_FALSE(json["compared"].empty());
  EXPECT_FALSE(json["placements"].empty());
  ASSERT_TRUE(result.recommended_row.has_value()) << result.reason;
  EXPECT_FALSE(kinds::constants_table(result).rows.empty());
  EXPECT_EQ(report::render_report(kinds::report_of(result)).files.size(), 5u);
}

}  // namespace
