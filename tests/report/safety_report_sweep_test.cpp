// Safety reports of several cases, and of sweeps.
#include "safety_report_files.hpp"

#include <fmt/format.h>

namespace launchsafe::report {
namespace {

/// Of two cases the second, which ignites at every gap.
void let_ignite(nlohmann::ordered_json& results) {
  auto& row = results["cases"][1];
  row["critical_gap_kind"] = "all-ignite";
  row["critical_gap_reads_as"] = row["critical_gap_with_bounds"] = "ignites without a gap";
  for (const char* key : {"critical_gap_cm", "critical_gap_lower_cm", "largest_safe_gap_cm"})
    row[key] = nullptr;
  for (const char* key : {"critical_gap_upper_cm", "critical_gap_at_least_cm", "critical_gap_at_most_cm"})
    row[key] = 0.0;
  for (std::size_t i = results["verdicts"].size() / 2; i < results["verdicts"].size(); ++i)
    results["verdicts"][i]["verdict"] = "UNSAFE";
}

TEST_F(SafetyReport, LeavesEveryRowOfEachOfSeveralCasesOut) {
  const path study = copy_of("critical_gap_155mm");
  move_to_pressures(study, {496.0, 510.0});
  change(study, let_ignite);
  const auto json = nlohmann::json::parse(file_of({study}, "report.json"));
  EXPECT_TRUE(json["answer"]["largest_safe_gap_cm"].is_null()) << "one case ignites at every gap";
  for (const auto& block : json["sections"][5]["blocks"]) {
    if (block["id"] != "curves") continue;
    ASSERT_EQ(block["rows"].size(), 6u) << "three curves a case";
    EXPECT_EQ(block["rows"][3]["case"], "510 MPa, 30 µm, 1 mm");
    EXPECT_GT(block["rows"][0]["left_out_rms_K"], block["rows"][0]["rms_K"]);
    return;
  }
  ADD_FAILURE() << "no table of rows left out";
}

TEST_F(SafetyReport, ASweepByItselfAllowsNoGap) {
  const auto json = nlohmann::json::parse(file_of({shipped("sweep_pressure_defect")}, "report.json"));
  EXPECT_TRUE(json["answer"]["largest_safe_gap_cm"].is_null());
  EXPECT_TRUE(json["answer"]["cases"].empty());
}

TEST_F(SafetyReport, ASweepOverMoreThanTwoQuantitiesShowsThePicturesThatItDrew) {
  const path study = copy_of("sweep_pressure_defect");
  const std::string first = read(study / "critical_gap.svg");
  write(study / "critical_gap_2.svg", first);
  auto manifest = nlohmann::ordered_json::parse(read(study / "manifest.json"));
  manifest["files"].push_back({{"name", "critical_gap_2.svg"}, {"sha256", store::sha256(first)}});
  write(study / "manifest.json", manifest.dump(2));
  ask(study, "\n\n# scene\n", "\n\n[[vary]]\nkey = 'flaw_size'\nvalues = '0.5, 1 mm'\n\n# scene\n");
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
        results["cases"].back()["case"] =
            fmt::format("{}, {} mm", cases[i]["case"].template get<std::string>(), size);
        for (std::size_t gap = 0; gap < gaps; ++gap) {
          results["verdicts"].push_back(verdicts[i * gaps + gap]);
          results["verdicts"].back()["flaw_size_mm"] = size;
        }
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
