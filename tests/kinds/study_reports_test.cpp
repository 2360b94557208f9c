// The pages, tables and JSON of studies on a launch in closed form.
#include "launchsafe/kinds/calibration.hpp"
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/kinds/read_study.hpp"
#include "report/report_folder.hpp"
#include "study/synthetic_launch.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;
using report::content_of, report::Folder, report::json_of;

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
  EXPECT_EQ(json["comparison"][0]["used_for"], "calibration");
  EXPECT_EQ(json["comparison"][1]["used_for"], "held out");
  EXPECT_EQ(json["comparison"][1]["temperature_max_published_K"], 492.9);
  EXPECT_TRUE(json["verdicts"][0]["ignition_cause"].is_null());
  EXPECT_EQ(json["verdicts"][2]["ignition_place"], "S2");
  for (const char* key : {"wall_time_s", "runs", "updates_per_second"})
    EXPECT_TRUE(json["timing"].contains(key));
  EXPECT_TRUE(
      json["fit"][0]["slope_standard_error_K_per_cm"].is_null());  // two rows: no degree of freedom left
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
      run_critical_gap(study_of(study_text + "peak_pressures = \"400, 496 MPa\"\n" + synthetic_constants),
                       synthetic_options());
  const auto json = json_of(result);
  EXPECT_EQ(json["cases"].size(), 2u);
  EXPECT_EQ(json["verdicts"].size(), 6u);
  EXPECT_TRUE(json["critical_gap"].is_null());
  EXPECT_NE(kinds::answer(result).find("400 MPa"), std::string::npos);
}

TEST(CriticalGapReport, ThePageOpensWithTheAnswerAndSaysHowToRemakeIt) {
  const CriticalGapResult result = one_case();
  const std::string page = report::to_markdown(kinds::report_of(result));
  EXPECT_TRUE(page.starts_with("# A test\n\nThe critical gap is 0.0")) << page.substr(0, 200);
  EXPECT_NE(page.find("launchsafe study some_study.toml -o DIR"), std::string::npos);
  EXPECT_NE(page.find("held out"), std::string::npos);
  EXPECT_NE(page.find("60 K for mesh, step and scaling, assumed"), std::string::npos);
  EXPECT_EQ(page.find(LAUNCHSAFE_SOURCE_DIR), std::string::npos) << "a path of this machine";
}

TEST(CriticalGapReport, WritesItsFiles) {
  const Folder folder;
  const CriticalGapResult result = one_case();
  const auto written = report::write_report(kinds::report_of(result), folder.path);
  ASSERT_TRUE(written) << written.error().message;
  for (const char* name : {"verdicts.csv", "verdicts.md", "study.json", "report.md"})
    EXPECT_TRUE(std::filesystem::exists(folder.path / name)) << name;
  for (const std::string& name : written->files)
    EXPECT_TRUE(std::filesystem::exists(folder.path / name)) << name;
  EXPECT_EQ(written->files, (std::vector<std::string>{"verdicts.csv", "verdicts.md", "temperature.svg",
                                                      "report.md", "study.json"}))
      << "runs are stored once, in the store";
  EXPECT_EQ(content_of(folder.path / "study.json").find(LAUNCHSAFE_SOURCE_DIR), std::string::npos);
  EXPECT_TRUE(report::write_report(kinds::report_of(result), folder.path))
      << "the same study may be written again";
}

TEST(CalibrationReport, SaysWhatTheEvidenceSupports) {
  const Folder folder;
  // The synthetic launch has one load, whatever the scene says.
  StudyFile shipped = *read_study(studies_folder / "calibrate_table8.toml");
  study::settings_of<kinds::CalibrationSettings>(shipped.study).fast_rise.clear();
  const CalibrationResult result = run_calibration(shipped, synthetic_options());
  const auto json = json_of(result);
  EXPECT_EQ(json["calibrations"].size(), result.rows.size());
  EXPECT_GE(json["calibrations"].size(), 6u);
  EXPECT_FALSE(json["hold_outs"].empty());
  EXPECT_FALSE(json["placements"].empty());
  ASSERT_TRUE(result.recommendation.row.has_value()) << result.recommendation.reason;
  EXPECT_FALSE(kinds::constants_table(result).rows.empty());
  const std::string page = report::to_markdown(kinds::report_of(result));
  EXPECT_NE(page.find("The scene should hold"), std::string::npos);
  EXPECT_NE(page.find("ignition time"), std::string::npos);
  const auto written = report::write_report(kinds::report_of(result), folder.path);
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_EQ(written->files.size(), 5u);
}

}  // namespace
