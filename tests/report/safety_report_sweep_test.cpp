// Safety reports of several cases, and of sweeps.
#include "safety_report_files.hpp"

#include <fmt/format.h>

namespace launchsafe::report {
namespace {

/// A second case with the same rows at another pressure.
void add_case(nlohmann::ordered_json& results) {
  const auto verdicts = results["verdicts"];
  results["cases"].push_back(results["cases"][0]);
  results["cases"][1]["case"] = "510 MPa, 30 um, 1 mm";
  results["cases"][1]["critical_gap_kind"] = "all-ignite";
  results["runs"].push_back(results["runs"][0]);
  results["runs"][1]["case"] = results["cases"][1]["case"];
  results["runs"][1]["stored_case"] = "";
  const auto curves = results["fit_curves"];
  for (auto row : curves) {
    row["case"] = results["cases"][1]["case"];
    results["fit_curves"].push_back(row);
  }
  for (auto row : verdicts) {
    row["peak_pressure_MPa"] = 510.0;
    row["verdict"] = "INDETERMINATE";
    results["verdicts"].push_back(row);
  }
}

TEST_F(SafetyReport, OfSeveralCasesTheWorstStandsOnPageOneAndEachIsLeftOneOut) {
  const path study = copy_of("critical_gap_155mm");
  change(study, add_case);
  const std::string page = file_of({study}, "report.md");
  EXPECT_TRUE(has(page, "Only this launch is covered: cracks of")) << "one of the two";
  EXPECT_TRUE(has(page, "The smallest critical gap found in 2 cases is 0.038"));
  EXPECT_TRUE(has(page, "In 1 of them no gap is safe"));
  EXPECT_TRUE(has(page, "no computed gap has the verdict SAFE in every case"));
  EXPECT_TRUE(has(file_of({study, shipped("closing_gap_155mm")}, "report.md"),
                  "what title and colours call SAFE is so only where the table says so too"))
      << "the picture of several cases is that of the study";
  const auto json = nlohmann::json::parse(file_of({study}, "report.json"));
  for (const auto& block : json["sections"][5]["blocks"]) {
    if (block["id"] != "curves") continue;
    ASSERT_EQ(block["rows"].size(), 6u) << "three curves a case";
    EXPECT_EQ(block["rows"][3]["case"], "510 MPa, 30 um, 1 mm");
    EXPECT_GT(block["rows"][0]["left_out_rms_K"], block["rows"][0]["rms_K"]);
    return;
  }
  ADD_FAILURE() << "no table of rows left out";
}

TEST_F(SafetyReport, ASweepByItselfRecommendsNothingAndSaysWhatIsExtrapolated) {
  const auto criterion = parse_criterion("margin >= 3 uncertainty", "works standard 12", 526.784);
  ASSERT_TRUE(criterion);
  const std::string page = file_of({copy_of("sweep_pressure_defect")}, "report.md", *criterion);
  EXPECT_TRUE(has(page, "no gap is recommended"));
  EXPECT_TRUE(has(page, "Only the 56 computed cases are covered"));
  EXPECT_TRUE(has(page, "No gap can be recommended: there are no verdicts of one launch"));
  EXPECT_TRUE(has(page, "The calibration is extrapolated in: peak pressure, gap, crack radius."));
  EXPECT_TRUE(has(page, "The verdicts rest on 2 values that somebody accepts"));
}

/// A sweep over temperature, made of that over pressure: 250 MPa stands for 250 K, and so on to 700; but none
/// for 300 K, at which the main job has bounds of its own.
void make_of_temperature(nlohmann::ordered_json& results) {
  nlohmann::ordered_json& axis = results["axes"][0];
  axis["name"] = axis["scene_key"] = "initial_temperature";
  axis["key"] = "initial_temperature_K";
  axis["unit"] = "K";
  for (auto& row : results["cases"]) {
    const double pressure = row["peak_pressure_MPa"];
    row["initial_temperature_K"] = pressure == 300.0 ? 299.0 : pressure;
    row["critical_gap_kind"] = "value";
    row["critical_gap_at_least_cm"] = row["initial_temperature_K"] == 700.0 ? 0.1234 : 0.2;
  }
}

// Issue 30, point 9: under the old load 336 K took a third of the critical gap at 300 K.
TEST_F(SafetyReport, TellsTheTemperatureOfEverySafeAndTheLeastGapAtTheHottest) {
  const path sweep = copy_of("sweep_pressure_defect");
  change(sweep, make_of_temperature);
  const auto page_one = [](const std::vector<path>& studies) {
    const std::string page = file_of(studies, "report.md");
    return page.substr(0, page.find("## 2."));
  };
  const std::string one = page_one({shipped("critical_gap_155mm"), sweep});
  EXPECT_TRUE(has(one, "are SAFE (at 300 K before launch)"));
  EXPECT_TRUE(has(one, " cm, at 300 K before launch."));
  EXPECT_TRUE(has(one, "Verdicts at 300 K before launch"));
  EXPECT_TRUE(has(one, "At 700 K before launch, the hottest of B, the critical gap is at least 0.1234 cm"));
  change(sweep, [](auto& results) { results["cases"].back()["critical_gap_at_least_cm"] = nullptr; });
  EXPECT_TRUE(
      has(page_one({shipped("critical_gap_155mm"), sweep}), "nothing says how small the critical gap"));
  change(sweep, [](auto& results) { results["cases"].back()["critical_gap_kind"] = "all-ignite"; });
  EXPECT_TRUE(has(page_one({shipped("critical_gap_155mm"), sweep}), "the hottest of B, no gap is safe."));
  EXPECT_TRUE(has(page_one({sweep}), "are SAFE (at 250 to 700 K before launch)"));
}

TEST_F(SafetyReport, ASweepOverMoreThanTwoQuantitiesShowsThePicturesThatItDrew) {
  const path study = copy_of("sweep_pressure_defect");
  const std::string first = read(study / "critical_gap.svg");
  write(study / "critical_gap_2.svg", first);
  auto manifest = nlohmann::ordered_json::parse(read(study / "manifest.json"));
  manifest["files"].push_back({{"name", "critical_gap_2.svg"}, {"sha256", store::sha256(first)}});
  write(study / "manifest.json", manifest.dump(2));
  change(study, [](auto& results) {
    results["axes"].push_back({{"name", "flaw_size"},
                               {"scene_key", "charge.flaw_size"},
                               {"key", "flaw_size_mm"},
                               {"unit", "mm"},
                               {"values", {0.5, 1.0}}});
    const auto cases = results["cases"], verdicts = results["verdicts"];
    results["cases"] = results["verdicts"] = nlohmann::ordered_json::array();
    results["pictures"] = {{{"file", "critical_gap.svg"}, {"shows", "Critical gap at flaw size 0.5 mm"}},
                           {{"file", "critical_gap_2.svg"}, {"shows", "Critical gap at flaw size 1 mm"}}};
    const std::size_t gaps = verdicts.size() / cases.size();
    for (std::size_t i = 0; i < cases.size(); ++i)
      for (const double size : {0.5, 1.0}) {
        results["cases"].push_back(cases[i]);
        results["cases"].back()["flaw_size_mm"] = size;
        for (std::size_t gap = 0; gap < gaps; ++gap) results["verdicts"].push_back(verdicts[i * gaps + gap]);
      }
  });
  const auto report = nlohmann::json::parse(file_of({study}, "report.json"));
  std::vector<std::string> files;
  for (const auto& block : report["sections"][2]["blocks"]) {
    if (block["kind"] != "figure") continue;
    files.push_back(block["file"]);
    const std::string size = files.back().find("_2") == std::string::npos ? "0.5 mm" : "1 mm";
    EXPECT_TRUE(has(block["caption"], "at flaw size " + size)) << block["caption"];
    EXPECT_TRUE(has(block["alternative"], "at flaw size " + size)) << block["alternative"];
  }
  EXPECT_EQ(files, (std::vector<std::string>{"critical_gap.svg", "critical_gap_2.svg"}));
}

}  // namespace
}  // namespace launchsafe::report
